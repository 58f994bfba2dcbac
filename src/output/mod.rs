//! From a [`Drawing`](crate::drawing::Drawing) to files: SVG text, and PNG bytes made from that text.
//!
//! The SVG is the figure; the PNG is a picture of it, so that the two cannot disagree. Same drawing, same bytes, on
//! every machine: no clock, no path, no font but our own.

pub mod file;
pub mod png;
pub mod svg;
