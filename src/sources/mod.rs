//! Makes scene files from drawings, contact lists and assemblies, or from the dimensions of a common structure.

#[cfg(feature = "import")]
pub mod import;

pub mod starter;
