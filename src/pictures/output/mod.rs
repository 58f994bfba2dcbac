//! Writes a [`Drawing`](crate::pictures::drawing::Drawing) in the format SVG, PNG, GIF, PDF or TikZ.
//!
//! PNG, GIF and PDF are made from the SVG with resvg, so all show the same picture. The same drawing gives the same
//! bytes on every machine: files do not depend on the time, on paths or on installed fonts.
//!
//! # Size in print
//!
//! A pixel of a drawing is 1/96 inch (¾ pt), unless a width in millimetres is given. Text is scaled with the figure. If
//! a drawing of w pixels is printed `width` mm wide, text of s pixels is s·(width / w)·72/25.4 pt high. A column of a
//! journal is about 84 mm wide, two columns 174 mm. Text below 6 pt is hard to read.

#[cfg(feature = "png")]
pub mod animation;
#[cfg(feature = "file")]
pub mod file;
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) mod attachment;
pub mod fonts;
#[cfg(feature = "cli")]
pub(crate) mod format;
#[cfg(feature = "pdf")]
pub mod pdf;
#[cfg(feature = "png")]
pub mod png;
pub mod svg;
pub mod tikz;
#[cfg(feature = "png")]
mod tree;

/// Millimetres per inch.
pub const MM_PER_INCH: f64 = 25.4;
/// Pixels of a drawing per inch, if no width is given.
pub const PIXELS_PER_INCH: f64 = 96.0;
/// The scale of a figure that is laid out for print. Text of 12.5 pixels (9.4 points) becomes 7.5 points high.
const PRINT_SCALE: f64 = 0.8;

/// Converts the width of a printed figure, in millimetres, to the width of its layout in pixels. In a figure of this
/// width, text has the size of printed footnotes, and names in blocks are slightly smaller.
pub(crate) fn page_width(millimetres: f64) -> f64 {
    millimetres / MM_PER_INCH * PIXELS_PER_INCH / PRINT_SCALE
}
