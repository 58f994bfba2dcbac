//! Makes scene files from drawings, contact lists and assemblies, or from a few lengths and counts.

#[cfg(feature = "import")]
pub mod import;

pub mod starter;
