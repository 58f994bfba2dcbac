//! Formats numbers and writes the sentences about verdicts, failures, margins and proofs.
//!
//! The terminal, figure captions and reports describe the same results. They all use the functions below, one file
//! per subject, so each kind of result has its wording in one place. The sentences are plain text and may contain
//! names from scene files. Code that writes them to an output escapes them with the function for that format in
//! [`text`](crate::text).

#[cfg(any(feature = "report", feature = "cli"))]
pub mod answer;
pub mod capacity;
pub mod failure;
pub mod margin;
pub mod number;
pub mod question;
pub mod sensitivity;
pub mod verdict;
