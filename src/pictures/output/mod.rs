//! Writes a [`Drawing`](crate::drawing::Drawing) to a file: as SVG, as PNG, GIF or PDF (all made from the SVG), or as TikZ.
//!
//! The SVG is the figure. PNG and PDF are made from it by resvg's reader, so that they cannot disagree with it. The same
//! drawing gives the same bytes on every machine: no clock, no path and no font of the machine enters a file.
//!
//! # Size in print
//!
//! A pixel of a drawing is a 96th of an inch, ¾ pt, unless a width in millimetres is given. Letters shrink with the
//! figure: words of s pixels in a drawing of w pixels are s·(width / w)·72/25.4 pt high when it is printed `width` mm
//! wide. A column of a journal is about 84 mm wide, two of them 174 mm; letters below 6 pt are hard to read.

#[cfg(feature = "png")]
pub mod animation;
#[cfg(feature = "file")]
pub mod file;
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
/// Pixels of a drawing per inch, where no other size is given.
pub const PIXELS_PER_INCH: f64 = 96.0;
