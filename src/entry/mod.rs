//! The entry points: the command line, and the Python module.

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "python")]
pub mod python;
