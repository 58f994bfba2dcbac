//! Ways in for people and other languages.

#[cfg(feature = "cli")]
pub mod cli;
