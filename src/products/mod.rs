//! What people and programs receive: results, sentences, figures, reports. Joins mechanics and pictures.

pub mod result;

pub mod wording;

pub mod figure;

#[cfg(feature = "report")]
pub mod study;

pub mod report;

#[cfg(feature = "snapshot")]
pub mod snapshot;
