//! [`Options`]: the options for writing an SVG file.

use crate::pictures::output::fonts::Fonts;

/// How text is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Words {
    /// As text, with the names of the fonts. The file is small, but its look depends on the fonts of the reader.
    #[default]
    Names,
    /// As text, with the used glyphs embedded in the file; for browsers.
    #[cfg(feature = "embed")]
    Embedded,
    /// As outlines. The file looks the same everywhere, but its text cannot be searched or edited.
    #[cfg(feature = "png")]
    Outlines,
}

/// The options of an SVG file.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Width in print, mm; for `None` one pixel is 1/96 inch.
    pub width_mm: Option<f64>,
    /// How text is written.
    pub words: Words,
    /// The fonts for text that is embedded or written as outlines.
    pub fonts: Fonts,
    /// The prefix of the ids of all elements. It consists of letters and digits. For `None`, the prefix is a hash of
    /// the drawing and the options. If a page contains the same drawing twice, each copy needs a different prefix.
    pub mark: Option<String>,
}

impl Options {
    setters! {
        words: Words, "How text is written.";
        fonts: Fonts, "The fonts for text that is embedded or written as outlines.";
    }

    optional_setters! {
        width_mm: f64, "Width in print, mm.";
        mark: String, "The prefix of the ids of all elements, of letters and digits.";
    }
}
