//! The ways to use the library without Rust code: the command line, the Python module, and the module for browsers.

// Only Python and JavaScript send JSON.
#[cfg(any(feature = "cli", feature = "wasm"))]
#[cfg_attr(not(any(feature = "python", feature = "wasm")), allow(dead_code))]
mod value;
#[cfg(any(feature = "cli", feature = "wasm"))]
#[cfg_attr(not(any(feature = "python", feature = "wasm")), allow(dead_code))]
mod request;

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "python")]
pub mod python;
#[cfg(feature = "wasm")]
pub mod wasm;
