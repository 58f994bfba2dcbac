//! From a [`Drawing`](crate::drawing::Drawing) to files: SVG text, and PNG and PDF bytes made from that text.
//!
//! The SVG is the figure; the others are pictures of it, so that they cannot disagree. The program spares itself the text
//! where it wants pixels alone, and a test holds each of them to those of the SVG. Same drawing, same bytes, on
//! every machine: no clock, no path, no font but our own and those that are given.
//!
//! # Size in print
//!
//! A pixel of a drawing is a 96th of an inch, ¾ pt, unless a width in millimetres is asked for. Letters shrink with the
//! figure: words of s pixels in a drawing of w pixels are s·(width / w)·72/25.4 pt high when it is printed `width` mm
//! wide. A column of a journal is about 84 mm wide, two of them 174 mm; letters below 6 pt are hard to read.

#[cfg(feature = "file")]
pub mod file;
pub mod fonts;
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
/// Pixels of a drawing per inch, where no other size is asked for.
pub const PIXELS_PER_INCH: f64 = 96.0;
