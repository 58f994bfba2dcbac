//! Pages of shapes and text, and the files they are written to. Knows nothing of mechanics.

pub mod drawing;

#[cfg(feature = "report")]
pub mod chart;

pub mod output;
