//! [`Format`]: the formats in which the command line writes a drawing. Each format is declared here once, with its ending,
//! its help and its writer; the writer itself has a file of its own.

use super::animation::{self, Step};
use super::fonts::Fonts;
use super::pdf::{self, PdfError};
use super::png::{self, Compression, PngError, Size};
use super::svg::{self, OutlineError, Words};
use super::tikz;
use crate::drawing::Drawing;

/// A format in which a drawing is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    Svg,
    Png,
    Gif,
    Pdf,
    Tikz,
}

/// The options of all formats; each writer takes those that concern it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings<'f> {
    /// Size of a picture in pixels.
    pub size: Size,
    /// Width in print, mm.
    pub width_mm: Option<f64>,
    /// How an SVG writes words.
    pub words: Words,
    /// How hard a PNG is compressed.
    pub compression: Compression,
    /// Fonts for words that the writer lays out itself.
    pub fonts: &'f Fonts,
}

/// Why a drawing could not be written.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FormatError {
    /// The requested size is out of range; another one helps.
    #[error("{0}")]
    Size(String),
    /// The writer failed.
    #[error("{0}")]
    Write(String),
}

/// A writer of pictures that follow one another.
pub(crate) type Animate = fn(&[Step], Size, &Fonts) -> Result<Vec<u8>, PngError>;

/// What is known about a format, and how a drawing is written in it.
struct Declaration {
    /// File ending, without its dot; also the name on the command line.
    ending: &'static str,
    /// One line of help.
    help: &'static str,
    /// Whether the file is text, which a terminal can show.
    is_text: bool,
    /// Whether the picture consists of pixels, so that a width in pixels makes sense.
    has_pixels: bool,
    /// Whether the writer lays out words in the fonts of [`Settings::fonts`]; otherwise the program that opens the file
    /// does.
    lays_out_words: bool,
    write: fn(&Drawing, &Settings<'_>) -> Result<Vec<u8>, FormatError>,
}

impl Format {
    /// All formats, in the order in which help lists them.
    pub(crate) const ALL: [Format; 5] = [
        Format::Svg,
        Format::Png,
        Format::Gif,
        Format::Pdf,
        Format::Tikz,
    ];

    fn declaration(self) -> Declaration {
        match self {
            Format::Svg => Declaration {
                ending: "svg",
                help: "Drawn in lines, with titles that tell the numbers",
                is_text: true,
                has_pixels: false,
                lays_out_words: false,
                write: write_svg,
            },
            Format::Png => Declaration {
                ending: "png",
                help: "Drawn in pixels, from that SVG",
                is_text: false,
                has_pixels: true,
                lays_out_words: true,
                write: write_png,
            },
            Format::Gif => Declaration {
                ending: "gif",
                help: "Drawn in pixels of at most 255 colours, for animations in any program",
                is_text: false,
                has_pixels: true,
                lays_out_words: true,
                write: write_gif,
            },
            Format::Pdf => Declaration {
                ending: "pdf",
                help: "Drawn in lines, for print, from that SVG",
                is_text: false,
                has_pixels: false,
                lays_out_words: true,
                write: |drawing, settings| {
                    Ok(pdf::write_in(drawing, settings.width_mm, settings.fonts)?)
                },
            },
            Format::Tikz => Declaration {
                ending: "tikz",
                help: "Drawn in TikZ, to be set by LaTeX in the fonts of its document",
                is_text: true,
                has_pixels: false,
                lays_out_words: false,
                write: |drawing, settings| Ok(tikz::write(drawing, settings.width_mm).into_bytes()),
            },
        }
    }

    /// The file ending, without its dot; also the name on the command line.
    pub(crate) fn ending(self) -> &'static str {
        self.declaration().ending
    }

    /// The format of a file ending in small letters.
    pub(crate) fn from_ending(ending: &str) -> Option<Format> {
        Format::ALL
            .into_iter()
            .find(|format| format.ending() == ending)
    }

    /// One line of help.
    pub(crate) fn help(self) -> &'static str {
        self.declaration().help
    }

    /// How pictures that follow one another are written in this format; `None` for a format that holds one picture.
    pub(crate) fn animate(self) -> Option<Animate> {
        match self {
            Format::Png => Some(animation::apng),
            Format::Gif => Some(animation::gif),
            Format::Svg | Format::Pdf | Format::Tikz => None,
        }
    }

    /// Whether a picture in this format consists of pixels.
    pub(crate) fn has_pixels(self) -> bool {
        self.declaration().has_pixels
    }

    /// Whether words are laid out here, in the given fonts, and not by the program that opens the file.
    pub(crate) fn lays_out_words(self, words: Words) -> bool {
        self.declaration().lays_out_words || (self == Format::Svg && words == Words::Outlines)
    }

    /// Why the format is not written to a terminal; `None` for a format that can be read there.
    pub(crate) fn unreadable(self) -> Option<String> {
        let declaration = self.declaration();
        let name = declaration.ending.to_ascii_uppercase();
        (!declaration.is_text).then(|| {
            format!("a {name} is not for reading on a terminal; send it to a file with -o")
        })
    }

    /// The bytes of a drawing in this format.
    pub(crate) fn write(
        self,
        drawing: &Drawing,
        settings: &Settings<'_>,
    ) -> Result<Vec<u8>, FormatError> {
        (self.declaration().write)(drawing, settings)
    }
}

fn write_svg(drawing: &Drawing, settings: &Settings<'_>) -> Result<Vec<u8>, FormatError> {
    let options = svg::Options {
        width_mm: settings.width_mm,
        words: settings.words,
        fonts: settings.fonts.clone(),
        mark: None,
    };
    Ok(svg::write_with(drawing, &options)?.into_bytes())
}

fn write_png(drawing: &Drawing, settings: &Settings<'_>) -> Result<Vec<u8>, FormatError> {
    // A picture that is too large is refused before its SVG is written, which takes far more memory than the drawing.
    png::check(drawing.width, drawing.height, settings.size)?;
    let svg = svg::for_pixels(drawing);
    Ok(png::render_in(
        &svg,
        settings.size,
        settings.fonts,
        settings.compression,
    )?)
}

fn write_gif(drawing: &Drawing, settings: &Settings<'_>) -> Result<Vec<u8>, FormatError> {
    png::check(drawing.width, drawing.height, settings.size)?;
    let still = Step {
        svg: svg::for_pixels(drawing),
        seconds: 1.0,
    };
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
