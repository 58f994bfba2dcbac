//! Draws pages of shapes and text, and writes them to files. No file of this folder depends on the mechanics.

pub mod drawing;

#[cfg(feature = "report")]
pub mod chart;

pub mod output;
