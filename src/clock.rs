//! Re-exports `Instant`, the clock with which this crate measures durations and checks deadlines.
//!
//! All modules import `Instant` from this module. The clock of the standard library panics in a browser, so the clock
//! of the crate `web-time` replaces it there.

#[cfg(not(target_family = "wasm"))]
pub(crate) use std::time::Instant;

#[cfg(target_family = "wasm")]
pub(crate) use web_time::Instant;
