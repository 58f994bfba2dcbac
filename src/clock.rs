//! The clock: measures how long something took, and tells whether a deadline has passed.
//!
//! Everything that needs the time takes it from here. The clock of the standard library panics in a browser, so that there
//! it is the one of the crate `web-time`, which asks the browser.

#[cfg(not(target_family = "wasm"))]
pub(crate) use std::time::Instant;

#[cfg(target_family = "wasm")]
pub(crate) use web_time::Instant;
