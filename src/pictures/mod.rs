//! Pages of shapes and text, and the files to which they are written. This folder does not use the mechanics.

pub mod drawing;

#[cfg(feature = "report")]
pub mod chart;

pub mod output;
