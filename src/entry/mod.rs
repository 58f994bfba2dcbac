//! The entry points: the command line, and interfaces for other languages.

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "python")]
pub mod python;
