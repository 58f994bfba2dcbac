//! Output for people and for other programs: results, sentences, figures and reports. These modules use both mechanics
//! and pictures.
//!
//! The modules are listed in the order of dependency. Each module uses only the modules above it.

pub mod wording;

#[cfg(feature = "report")]
pub mod study;

pub mod result;

pub mod figure;

pub mod report;

#[cfg(feature = "snapshot")]
pub mod snapshot;

#[cfg(feature = "cli")]
pub(crate) mod vary;
