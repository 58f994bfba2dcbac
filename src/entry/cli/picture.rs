//! [`Picture`]: the options for picture files, which `render`, `batch` and `shapes` share.

use std::fs;
use std::path::PathBuf;

use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};

use crate::entry::cli::error::CliError;
use crate::pictures::drawing::{Colour, Drawing};
use crate::pictures::output::animation::Step;
use crate::pictures::output::fonts::Fonts;
pub(crate) use crate::pictures::output::format::Format;
use crate::pictures::output::format::{Animate, FormatError, Settings};
use crate::pictures::output::page_width;
use crate::pictures::output::pdf;
use crate::pictures::output::png::{self, Compression, PngError, Size};
use crate::pictures::output::svg::{self, Words};

/// Format, size, background and text of a picture.
#[derive(Clone, Debug, Args)]
pub(crate) struct Picture {
    /// Format, if the output is a folder or standard output [default: svg]
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Format>,
    /// Width of a PNG or GIF in pixels [default of an animation: 800]
    #[arg(long, value_name = "PX", conflicts_with_all = ["scale", "width_mm"])]
    width: Option<u32>,
    /// Pixels of a PNG per unit of the drawing [default: 2]
    #[arg(long, value_name = "FACTOR", conflicts_with = "width_mm")]
    scale: Option<f64>,
    /// Width in print in millimetres; 84 is one column of a journal, 174 two
    #[arg(long, value_name = "MM", value_parser = millimetres)]
    width_mm: Option<f64>,
    /// Pixels of a PNG per inch, with --width-mm [default: 300]
    #[arg(long, value_name = "DPI", value_parser = dots)]
    dpi: Option<f64>,
    /// Colour of the page: white, #rrggbb, or none for a transparent page; outlines around arrows keep the page
    /// colour of the theme [default: the page colour of the theme]
    #[arg(long, value_name = "COLOUR", value_parser = background)]
    background: Option<Background>,
    /// How an SVG contains text: with names of fonts, with fonts in the file, or as outlines [default: names]
    #[arg(long, value_enum, value_name = "FORM")]
    text: Option<TextForm>,
    /// A font file (.ttf, .otf, .ttc) for scripts that the built-in fonts lack; may be given several times. Without
    /// it, drystone writes these characters as code points wherever it lays out the text itself
    #[arg(long = "font", value_name = "FILE")]
    fonts: Vec<PathBuf>,
    /// The compression of a PNG.
    #[arg(skip)]
    compression: Compression,
}

impl ValueEnum for Format {
    fn value_variants<'a>() -> &'a [Format] {
        &Format::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.ending()).help(self.help()))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TextForm {
    /// A small file; the reader's program sets the text in its own fonts
    Names,
    /// For browsers: text that looks the same everywhere and can be searched
    Embed,
    /// For all other programs: looks the same everywhere, but the text cannot be searched
    Paths,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Background {
    Clear,
    Plain(Colour),
}

impl Picture {
    /// Returns the format that `--format` selects; `None` without this option.
    pub(crate) fn requested_format(&self) -> Option<Format> {
        self.format
    }

    /// Sets the width in pixels if the format has pixels and the command line gives no size.
    pub(crate) fn or_width(mut self, pixels: u32, format: Format) -> Picture {
        let sized = self.width.is_some() || self.scale.is_some() || self.width_mm.is_some();
        if format.has_pixels() && !sized {
            self.width = Some(pixels);
        }
        self
    }

    /// Selects fast PNG compression, for a command that writes many pictures. The files become larger.
    pub(crate) fn of_many(self) -> Picture {
        Picture { compression: Compression::Quick, ..self }
    }

    /// Refuses options that do not apply to a format.
    pub(crate) fn check(&self, format: Format) -> Result<(), CliError> {
        let mut wrong = Vec::new();
        if !format.has_pixels() && (self.width.is_some() || self.scale.is_some()) {
            wrong.push(
                "--width and --scale are in pixels, which only a PNG or GIF has; give --width-mm, write a PNG, or leave them out",
            );
        }
        if self.dpi.is_some() && (!format.has_pixels() || self.width_mm.is_none()) {
            wrong.push("--dpi is for a PNG with a width in print; write a PNG and give --width-mm, or leave out --dpi");
        }
        if self.text.is_some() && format != Format::Svg {
            wrong.push(
                "--text is for an SVG; a PNG contains no text, a PDF always contains its fonts, and LaTeX sets the text of TikZ. Leave out --text",
            );
        }
        if wrong.is_empty() { Ok(()) } else { Err(CliError::CommandLine(wrong.join("\n"))) }
    }

    /// Returns the drawing with the background that `--background` selects.
    fn on_page(&self, drawing: Drawing) -> Drawing {
        Drawing {
            background: match self.background {
                Some(Background::Clear) => None,
                Some(Background::Plain(colour)) => Some(colour),
                None => drawing.background,
            },
            ..drawing
        }
    }

    /// Returns a drawing as the bytes of a file in this format.
    pub(crate) fn bytes(&self, drawing: Drawing, format: Format, fonts: &Fonts) -> Result<Vec<u8>, CliError> {
        let drawing = self.on_page(drawing);
        let settings = Settings {
            size: self.size(),
            width_mm: self.width_mm,
            words: self.words(),
            compression: self.compression,
            fonts,
        };
        format.write(&drawing, &settings).map_err(format_error)
    }

    /// Returns an animation as the bytes of a file. Each drawing comes with the number of seconds for which it is
    /// shown. All drawings must have the same size.
    pub(crate) fn animated(
        &self,
        drawings: Vec<(Drawing, f64)>,
        animate: Animate,
        fonts: &Fonts,
    ) -> Result<Vec<u8>, CliError> {
        if let Some((drawing, _)) = drawings.first() {
            self.check_png((drawing.width, drawing.height))?;
        }
        let step = |(drawing, seconds)| Step { svg: svg::for_pixels(&self.on_page(drawing)), seconds };
        let steps: Vec<Step> = drawings.into_iter().map(step).collect();
        animate(&steps, self.size(), fonts).map_err(png_error)
    }

    /// Returns the layout width of a figure in pixels, computed from `--width-mm`; `None` without this option. In
    /// print, text is then as large as a footnote, and names in blocks are slightly smaller.
    pub(crate) fn page(&self) -> Option<f64> {
        self.width_mm.map(page_width)
    }

    /// Returns the largest ratio of height to width that a figure on an A4 page may have: the ratio of the page itself.
    /// With `--width-mm`, a narrow figure may have a larger ratio, up to a height of 247 mm, which is the height
    /// between the margins of the page.
    pub(crate) fn page_ratio(&self) -> f64 {
        let page = 297.0 / 210.0;
        self.width_mm.map_or(page, |mm| (247.0 / mm).max(page))
    }

    /// Returns an error if the PNG of a drawing would be too large. The arguments are the width and height of the
    /// drawing, or lower bounds of them.
    pub(crate) fn check_png(&self, (width, height): (f64, f64)) -> Result<(), CliError> {
        png::check(width, height, self.size()).map_err(png_error)
    }

    /// Returns the built-in fonts and the fonts of `--font`.
    pub(crate) fn fonts(&self) -> Result<Fonts, CliError> {
        let mut files = Vec::new();
        for path in &self.fonts {
            files.push(
                fs::read(path)
                    .map_err(|error| CliError::NotRead { what: path.display().to_string(), why: error.to_string() })?,
            );
        }
        Fonts::with(files).map_err(|number| {
            let name = self.fonts[number].display();
            CliError::CommandLine(format!("--font {name}: it is not a font; give a .ttf, .otf or .ttc file"))
        })
    }

    /// True if drystone itself lays out the text of a picture in this format; false if the program that shows the
    /// picture does.
    pub(crate) fn draws_words(&self, format: Format) -> bool {
        format.lays_out_words(self.words())
    }

    fn words(&self) -> Words {
        match self.text {
            None | Some(TextForm::Names) => Words::Names,
            Some(TextForm::Embed) => Words::Embedded,
            Some(TextForm::Paths) => Words::Outlines,
        }
    }

    /// Returns the size that the options select. The default is two pixels per unit of the drawing, which is sharp on
    /// high-resolution screens and gives a small file.
    fn size(&self) -> Size {
        match (self.width, self.scale, self.width_mm) {
            (Some(width), _, _) => Size::Width(width),
            (None, Some(scale), _) => Size::Scale(scale),
            (None, None, Some(width_mm)) => Size::Print { width_mm, dpi: self.dpi.unwrap_or(300.0) },
            (None, None, None) => Size::Scale(2.0),
        }
    }
}

/// If an error says that a figure with several steps is too large, adds to its message the advice to split the figure.
/// Returns any other error unchanged.
pub(super) fn or_split(complaint: CliError, steps: usize) -> CliError {
    match complaint {
        CliError::CommandLine(why) if steps > 1 => CliError::CommandLine(format!(
            "{why}; or split its {steps} steps: --pages writes pages, --panels a file for each"
        )),
        other => other,
    }
}

/// Converts an error of an output format. A size out of range becomes an error of the command line, and any other error
/// means that the picture cannot be written.
fn format_error(error: FormatError) -> CliError {
    match error {
        FormatError::Size(why) => CliError::CommandLine(why),
        FormatError::Write(why) => CliError::NotWritten { what: "the picture".into(), why },
    }
}

fn png_error(error: PngError) -> CliError {
    format_error(FormatError::from(error))
}

fn millimetres(typed: &str) -> Result<f64, String> {
    between(typed, pdf::MIN_SIDE_MM, pdf::MAX_SIDE_MM, "a width in millimetres, such as 84 or 174")
}

fn dots(typed: &str) -> Result<f64, String> {
    between(typed, 1.0, 10_000.0, "a number of pixels per inch, such as 300 or 600")
}

fn between(typed: &str, least: f64, most: f64, what: &str) -> Result<f64, String> {
    match typed.parse::<f64>() {
        Ok(number) if (least..=most).contains(&number) => Ok(number),
        _ => Err(format!("it must be {what}, from {least} to {most}")),
    }
}

fn background(typed: &str) -> Result<Background, String> {
    let hex = |digits: &str| {
        let sound = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
        sound.then(|| u32::from_str_radix(digits, 16).ok()).flatten()
    };
    match typed {
        "none" => Ok(Background::Clear),
        "white" => Ok(Background::Plain(Colour::WHITE)),
        _ => match typed.strip_prefix('#').and_then(hex) {
            Some(value) => Ok(Background::Plain(Colour::hex(value))),
            None => Err("give none, white or #rrggbb, such as #f4f1ea; in a shell, put the colour in quotes".into()),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_background_is_none_or_a_colour_of_six_digits() {
        assert_eq!(background("none"), Ok(Background::Clear));
        assert_eq!(background("#F4f1ea"), Ok(Background::Plain(Colour([0xf4, 0xf1, 0xea]))));
        for wrong in ["", "#", "#fff", "#+12345", "f4f1ea", "#f4f1e", "#f4f1eag", "red", "#ünï"] {
            assert!(background(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn widths_are_limited_to_possible_pages() {
        assert_eq!(millimetres("84"), Ok(84.0));
        for wrong in ["0", "-84", "nan", "inf", "84mm", "1e9", ""] {
            let refused = millimetres(wrong).expect_err(wrong);
            assert!(refused.contains("from 2 to 5080"), "{refused}");
        }
    }
}
