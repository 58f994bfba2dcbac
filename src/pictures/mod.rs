//! Draws pages of shapes and text, and writes them to files. This folder does not use the mechanics.

pub mod drawing;

#[cfg(feature = "report")]
pub mod chart;

pub mod output;
