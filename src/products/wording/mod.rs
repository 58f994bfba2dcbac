//! Words: how numbers are printed, and the sentences about what was found. The one place for both.
//!
//! A terminal's table, the captions of figures and reports say the same things to different readers. Each says them with
//! the functions below, one file per subject, so that a failure, a margin or a proof has its wording in one place. All
//! sentences are plain text that may hold names from files: what writes them out passes them through its sink in
//! [`text`](crate::text).

pub mod effect;
pub mod failure;
pub mod margin;
pub mod number;
pub mod proof;
pub mod verdict;
