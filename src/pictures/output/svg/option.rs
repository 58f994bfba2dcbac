//! [`Options`]: the options of an SVG file.

use crate::output::fonts::Fonts;

/// How words are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Words {
    /// As words, in fonts by their names: small, and set by whoever opens the file in what he has of them.
    #[default]
    Names,
    /// As words, with the letters that are used in the file: for browsers.
    #[cfg(feature = "embed")]
    Embedded,
    /// As outlines: the same everywhere, and no text for searching or editing any more.
    #[cfg(feature = "png")]
    Outlines,
}

/// What else there is to choose.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Width in print, mm; where nothing is given a pixel is a 96th of an inch.
    pub width_mm: Option<f64>,
    /// How words are written.
    pub words: Words,
    /// The fonts in which words become outlines.
    pub fonts: Fonts,
    /// What the names of its elements begin with, letters and digits; made from the drawing's content where nothing is
    /// said. Two drawings of the same content on one page need marks of their own.
    pub mark: Option<String>,
}

impl Options {
    setters! {
        words: Words, "How words are written.";
        fonts: Fonts, "The fonts in which words become outlines.";
    }

    optional_setters! {
        width_mm: f64, "Width in print, mm.";
        mark: String, "What the names of its elements begin with, letters and digits.";
    }
}
