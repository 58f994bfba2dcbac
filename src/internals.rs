//! Re-exports modules that are not part of the public interface. They may change with any version.
//!
//! These modules are public, but hidden in the documentation, because this crate's own tests, benchmarks and program
//! use them. Please do not use them from other crates.

#[cfg(feature = "cli")]
pub use crate::entry::cli;
pub use crate::mechanics::statics::{assembly, effect, interface, resultant};
pub use crate::mechanics::{program, proof, solve};
#[cfg(feature = "report")]
pub use crate::pictures::chart;
#[cfg(feature = "report")]
pub use crate::products::study;
pub use crate::{geometry, text};
