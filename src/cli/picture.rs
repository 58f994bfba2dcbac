//! [`Picture`]: how a drawing becomes a file's bytes, the part that `render` and `shapes` share.

use clap::{Args, ValueEnum};

use crate::cli::complaint::Complaint;
use crate::drawing::Drawing;
use crate::output::png::{self, PngError, Size};
use crate::output::svg;

/// Format and size of a picture.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Picture {
    /// Format where the output's name does not tell: in a folder, or on standard output [default: svg]
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Format>,
    /// Width of a PNG in pixels
    #[arg(long, value_name = "PX", conflicts_with = "scale")]
    width: Option<u32>,
    /// Pixels of a PNG per unit of the drawing [default: 2]
    #[arg(long, value_name = "FACTOR")]
    scale: Option<f64>,
}

/// What a picture is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Drawn in lines, with titles that tell the numbers
    Svg,
    /// Drawn in pixels, from that SVG
    Png,
}

impl Format {
    /// The file ending, without its dot.
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Png => "png",
        }
    }
}

impl Picture {
    /// The format asked for.
    pub(crate) fn asked(&self) -> Option<Format> {
        self.format
    }

    /// Refuses a size in pixels for a format that has none.
    pub(crate) fn check(&self, format: Format) -> Result<(), Complaint> {
        if format == Format::Svg && (self.width.is_some() || self.scale.is_some()) {
            let why = "--width and --scale count pixels, and an SVG has none; write a PNG, or leave them out";
            return Err(Complaint::CommandLine(why.into()));
        }
        Ok(())
    }

    /// The bytes of a drawing.
    pub(crate) fn bytes(&self, drawing: &Drawing, format: Format) -> Result<Vec<u8>, Complaint> {
        let svg = svg::write(drawing);
        match format {
            Format::Svg => Ok(svg.into_bytes()),
            Format::Png => png::render(&svg, self.size()).map_err(|error| match error {
                PngError::Size { .. } => Complaint::CommandLine(error.to_string()),
                _ => Complaint::NotWritten {
                    what: "the picture".into(),
                    why: error.to_string(),
                },
            }),
        }
    }

    /// Two pixels per unit where nothing is said: sharp on screens that have two, and still small.
    fn size(&self) -> Size {
        match (self.width, self.scale) {
            (Some(width), _) => Size::Width(width),
            (None, Some(scale)) => Size::Scale(scale),
            (None, None) => Size::Scale(2.0),
        }
    }
}
