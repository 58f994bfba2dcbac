//! Re-exports `Instant`, the clock with which this crate measures durations and checks deadlines.
//!
//! All modules take `Instant` from here. The clock of the standard library panics in a browser. There, the clock of the
//! crate `web-time` is used, which asks the browser.

#[cfg(not(target_family = "wasm"))]
pub(crate) use std::time::Instant;

#[cfg(target_family = "wasm")]
pub(crate) use web_time::Instant;
