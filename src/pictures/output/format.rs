//! [`Format`]: the file formats in which the command line writes a drawing. This file lists the properties
//! of each format, such as its file ending and help text, and calls the module that writes it: `svg`, `png`,
//! `animation`, `pdf` or `tikz`.

use super::animation::{self, Step};
use super::attachment::attached;
use super::fonts::Fonts;
use super::pdf::{self, PdfError};
use super::png::{self, Compression, PngError, Size};
use super::svg::{self, OutlineError, Words};
use super::tikz;
use crate::pictures::drawing::Drawing;

/// A format in which a drawing is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Svg,
    Png,
    Gif,
    Pdf,
    Tikz,
}

/// The options of all formats. Each writer uses some of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings<'f> {
    /// Size of a picture in pixels.
    pub size: Size,
    /// Width in print, mm.
    pub width_mm: Option<f64>,
    /// How an SVG contains text.
    pub words: Words,
    /// The compression of a PNG.
    pub compression: Compression,
    /// The drawing in a dark theme, for an SVG that follows the colours that a reader prefers.
    pub dark: Option<&'f Drawing>,
    /// The scene file that an SVG, PNG or PDF carries.
    pub source: Option<&'f [u8]>,
    /// Fonts for text that the writer lays out.
    pub fonts: &'f Fonts,
}

/// Why a drawing could not be written.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FormatError {
    /// The requested size is out of range.
    #[error("{0}")]
    Size(String),
    /// The writer failed.
    #[error("{0}")]
    Write(String),
}

/// A function that writes an animation.
pub(crate) type Animate = fn(&[Step], Size, &Fonts) -> Result<Vec<u8>, PngError>;

/// The properties of a format, and its writer.
struct Declaration {
    /// File ending, without its dot; also the name on the command line.
    ending: &'static str,
    /// One line of help.
    help: &'static str,
    /// Whether the file is text, which a terminal can show.
    is_text: bool,
    /// Whether the picture consists of pixels, so that a width in pixels makes sense.
    has_pixels: bool,
    /// Whether the writer lays out text in the fonts of [`Settings::fonts`]. If not, the program that opens the file
    /// lays out the text.
    lays_out_words: bool,
    write: fn(&Drawing, &Settings<'_>) -> Result<Vec<u8>, FormatError>,
}

impl Format {
    /// All formats, in the order in which help lists them.
    pub(crate) const ALL: [Format; 5] = [Format::Svg, Format::Png, Format::Gif, Format::Pdf, Format::Tikz];

    fn declaration(self) -> Declaration {
        match self {
            Format::Svg => Declaration {
                ending: "svg",
                help: "Vector graphics, with titles that show the numbers",
                is_text: true,
                has_pixels: false,
                lays_out_words: false,
                write: write_svg,
            },
            Format::Png => Declaration {
                ending: "png",
                help: "Pixel image, made from the SVG",
                is_text: false,
                has_pixels: true,
                lays_out_words: true,
                write: write_png,
            },
            Format::Gif => Declaration {
                ending: "gif",
                help: "Pixel image with at most 255 colours, for animations in any program",
                is_text: false,
                has_pixels: true,
                lays_out_words: true,
                write: write_gif,
            },
            Format::Pdf => Declaration {
                ending: "pdf",
                help: "Vector graphics for print, made from the SVG",
                is_text: false,
                has_pixels: false,
                lays_out_words: true,
                write: |drawing, settings| {
                    Ok(pdf::write_in(drawing, settings.width_mm, settings.fonts, settings.source)?)
                },
            },
            Format::Tikz => Declaration {
                ending: "tikz",
                help: "TikZ code for LaTeX, in the fonts of the document",
                is_text: true,
                has_pixels: false,
                lays_out_words: false,
                write: |drawing, settings| Ok(tikz::write(drawing, settings.width_mm).into_bytes()),
            },
        }
    }

    /// Returns the file ending without its dot, which is also the name on the command line.
    pub(crate) fn ending(self) -> &'static str {
        self.declaration().ending
    }

    /// Returns the format with this file ending, or `None` if there is no such format. `ending` must be in lower case
    /// and without a dot.
    pub(crate) fn from_ending(ending: &str) -> Option<Format> {
        Format::ALL.into_iter().find(|format| format.ending() == ending)
    }

    /// Returns the description of the format in the help of the command line.
    pub(crate) fn help(self) -> &'static str {
        self.declaration().help
    }

    /// Returns the function that writes an animation in this format; `None` for a format without animations.
    pub(crate) fn animate(self) -> Option<Animate> {
        match self {
            Format::Png => Some(animation::apng),
            Format::Gif => Some(animation::gif),
            Format::Svg | Format::Pdf | Format::Tikz => None,
        }
    }

    /// True if a picture in this format consists of pixels.
    pub(crate) fn has_pixels(self) -> bool {
        self.declaration().has_pixels
    }

    /// True if the writer of this format lays out text with [`Settings::fonts`]. False if the program that opens the
    /// file lays out the text. `words` is how an SVG contains its text.
    pub(crate) fn lays_out_words(self, words: Words) -> bool {
        self.declaration().lays_out_words || (self == Format::Svg && words == Words::Outlines)
    }

    /// Returns an error message that says that this format cannot be shown on a terminal, or `None` for a text format.
    pub(crate) fn unreadable(self) -> Option<String> {
        let declaration = self.declaration();
        let name = declaration.ending.to_ascii_uppercase();
        (!declaration.is_text).then(|| format!("a {name} cannot be shown on a terminal; write it to a file with -o"))
    }

    /// Converts a drawing to the bytes of a file in this format.
    pub(crate) fn write(self, drawing: &Drawing, settings: &Settings<'_>) -> Result<Vec<u8>, FormatError> {
        let bytes = (self.declaration().write)(drawing, settings)?;
        Ok(attached(bytes, settings.source))
    }
}

fn write_svg(drawing: &Drawing, settings: &Settings<'_>) -> Result<Vec<u8>, FormatError> {
    let options =
        svg::Options { width_mm: settings.width_mm, words: settings.words, fonts: settings.fonts.clone(), mark: None };
    let svg = match settings.dark {
        Some(dark) => svg::write_pair(drawing, dark, &options)?,
        None => svg::write_with(drawing, &options)?,
    };
    Ok(svg.into_bytes())
}

fn write_png(drawing: &Drawing, settings: &Settings<'_>) -> Result<Vec<u8>, FormatError> {
    // Check the size before the SVG is written, because the SVG takes far more memory than the drawing.
    png::check(drawing.width, drawing.height, settings.size)?;
    let svg = svg::for_pixels(drawing);
    Ok(png::render_in(&svg, settings.size, settings.fonts, settings.compression)?)
}

fn write_gif(drawing: &Drawing, settings: &Settings<'_>) -> Result<Vec<u8>, FormatError> {
    png::check(drawing.width, drawing.height, settings.size)?;
    let still = Step { svg: svg::for_pixels(drawing), seconds: 1.0 };
    Ok(animation::gif(&[still], settings.size, settings.fonts)?)
}

impl From<OutlineError> for FormatError {
    fn from(error: OutlineError) -> FormatError {
        FormatError::Write(error.to_string())
    }
}

impl From<PngError> for FormatError {
    fn from(error: PngError) -> FormatError {
        match error {
            PngError::Size { .. } => FormatError::Size(error.to_string()),
            PngError::Svg(_) | PngError::Encode(_) => FormatError::Write(error.to_string()),
        }
    }
}

impl From<PdfError> for FormatError {
    fn from(error: PdfError) -> FormatError {
        match error {
            PdfError::Size { .. } => FormatError::Size(error.to_string()),
            PdfError::Write(_) => FormatError::Write(error.to_string()),
        }
    }
}
