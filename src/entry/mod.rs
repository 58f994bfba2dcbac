//! The ways to use the library without Rust code: the command line, the Python module, and the module for browsers.

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "python")]
pub mod python;
#[cfg(feature = "wasm")]
pub mod wasm;
