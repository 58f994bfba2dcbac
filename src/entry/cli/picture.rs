//! [`Picture`]: the options for picture files, which `render`, `batch` and `shapes` share.

use std::io::Read as _;
use std::path::PathBuf;
use std::sync::Arc;

use crate::entry::cli::error::CliError;
use crate::entry::value::{Background, between, millimetres};
use crate::pictures::drawing::Drawing;
use crate::pictures::output::animation::Step;
use crate::pictures::output::attachment::{MAX_BYTES, attached};
use crate::pictures::output::fonts::Fonts;
pub(crate) use crate::pictures::output::format::Format;
use crate::pictures::output::format::{Animate, FormatError, Settings};
use crate::pictures::output::page_width;
use crate::pictures::output::png::{self, Compression, PngError, Size};
use crate::pictures::output::svg::{self, Words};
use crate::read::file;
use crate::text::{Word, typed_word};

request! {
    /// Format, size, background and text of a picture.
    #[derive(Clone, Debug)]
    pub(crate) struct Picture(given) {
        /// Format, if the output is a folder or standard output [default: svg]
        format: Option<Format> = None, arg(long, value_parser = typed_word::<Format>(), value_name = "FORMAT");
        /// Width of a PNG or GIF in pixels [default of an animation: 800]
        width: Option<u32> = given.whole("width", [0, u32::MAX]),
            arg(long, value_name = "PX", conflicts_with_all = ["scale", "width_mm"]);
        /// Pixels of a PNG per unit of the drawing [default: 2]
        scale: Option<f64> = given.number("scale"),
            arg(long, value_name = "FACTOR", conflicts_with = "width_mm");
        /// Width in print in millimetres; 84 is one column of a journal, 174 two
        width_mm: Option<f64> = given.value("width_mm", millimetres),
            arg(long, value_name = "MM", value_parser = millimetres);
        /// Pixels of a PNG per inch, with --width-mm [default: 300]
        dpi: Option<f64> = given.value("dpi", dots), arg(long, value_name = "DPI", value_parser = dots);
        /// Colour of the page: white, #rrggbb, or none for a transparent page; outlines around arrows keep the page
        /// colour of the theme [default: the page colour of the theme]
        background: Option<Background> = given.value("background", str::parse), arg(long, value_name = "COLOUR");
        /// How an SVG contains text: with names of fonts, with fonts in the file, or as outlines [default: embed]
        text: Option<Words> = given.word("text"), arg(long, value_parser = typed_word::<Words>(), value_name = "FORM");
        /// A font file (.ttf, .otf, .ttc) for scripts that the built-in fonts lack; may be given several times. Without
        /// it, drystone writes these characters as code points wherever it lays out the text itself
        fonts: Vec<PathBuf> = given.list("font", |r, node, at| r.text(node, at).map(PathBuf::from)).unwrap_or_default(),
            arg(long = "font", value_name = "FILE", env = "DRYSTONE_FONT", hide_env_values = true);
        /// The compression of a PNG.
        compression: Compression = Compression::default(), arg(skip);
        /// The scene file that the picture carries.
        source: Option<Arc<[u8]>> = None, arg(skip);
    }
}

/// A drawing, and the same drawing in a dark theme if an SVG follows the colours that its reader prefers.
pub(crate) struct Drawn {
    pub(crate) drawing: Drawing,
    pub(crate) dark: Option<Drawing>,
}

impl From<Drawing> for Drawn {
    fn from(drawing: Drawing) -> Drawn {
        Drawn { drawing, dark: None }
    }
}

impl Word for Format {
    fn all() -> Vec<Format> {
        Format::ALL.to_vec()
    }

    fn word(self) -> &'static str {
        self.ending()
    }

    fn help(self) -> &'static str {
        Format::help(self)
    }
}

impl Word for Words {
    fn all() -> Vec<Words> {
        vec![Words::Names, Words::Embedded, Words::Outlines]
    }

    fn word(self) -> &'static str {
        match self {
            Words::Names => "names",
            Words::Embedded => "embed",
            Words::Outlines => "paths",
        }
    }

    fn help(self) -> &'static str {
        match self {
            Words::Names => "A small file; the reader's program sets the text in its own fonts",
            Words::Embedded => "Looks the same in every browser, and can be searched; about 12 kB larger",
            Words::Outlines => "For all other programs: looks the same everywhere, but the text cannot be searched",
        }
    }
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

    /// Puts the scene file into the picture, unless it is larger than a picture can carry.
    pub(crate) fn carrying(&self, file: &[u8]) -> Picture {
        Picture { source: (file.len() <= MAX_BYTES).then(|| file.into()), ..self.clone() }
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

    /// Returns a drawing as the bytes of a file in this format.
    pub(crate) fn bytes(&self, drawing: impl Into<Drawn>, format: Format, fonts: &Fonts) -> Result<Vec<u8>, CliError> {
        let Drawn { drawing, dark } = drawing.into();
        let drawing = Background::under(self.background, drawing);
        let dark = dark.map(|dark| Background::under(self.background, dark));
        let settings = Settings {
            size: self.size(),
            width_mm: self.width_mm,
            words: self.text.unwrap_or(Words::Embedded),
            compression: self.compression,
            dark: dark.as_ref(),
            source: self.source.as_deref(),
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
        let step =
            |(drawing, seconds)| Step { svg: svg::for_pixels(&Background::under(self.background, drawing)), seconds };
        let steps: Vec<Step> = drawings.into_iter().map(step).collect();
        let bytes = animate(&steps, self.size(), fonts).map_err(png_error)?;
        Ok(attached(bytes, self.source.as_deref()))
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
        // The bound 0 of a width that the layout chooses says nothing about a height that is a multiple of it.
        if width == 0.0 && !matches!(self.size(), Size::Scale(_)) {
            return Ok(());
        }
        png::check(width, height, self.size()).map_err(png_error)
    }

    /// Returns the built-in fonts and the fonts of `--font`.
    pub(crate) fn fonts(&self) -> Result<Fonts, CliError> {
        let read = |path: &PathBuf| {
            let mut bytes = Vec::new();
            let read = file::open(path).and_then(|mut font| font.read_to_end(&mut bytes));
            read.map(|_| bytes).map_err(|error| CliError::not_read(path.display(), error))
        };
        let files = self.fonts.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        Fonts::with(files).map_err(|number| {
            let name = self.fonts[number].display();
            CliError::from(format!("--font {name}: it is not a font; give a .ttf, .otf or .ttc file"))
        })
    }

    /// True if drystone itself lays out the text of a picture in this format; false if the program that shows the
    /// picture does.
    pub(crate) fn draws_words(&self, format: Format) -> bool {
        format.lays_out_words(self.text.unwrap_or(Words::Embedded))
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
        FormatError::Write(why) => CliError::not_written("the picture", why),
    }
}

fn png_error(error: PngError) -> CliError {
    format_error(FormatError::from(error))
}

fn dots(typed: &str) -> Result<f64, String> {
    let wrong = || "it must be a number of pixels per inch, such as 300 or 600, from 1 to 10000".into();
    between(typed, [1.0, 10_000.0], wrong)
}
