//! Makes scene files from drawings, or from a few lengths and counts.

#[cfg(feature = "import")]
pub mod import;

pub mod starter;
