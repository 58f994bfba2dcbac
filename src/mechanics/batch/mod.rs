//! Passes many scenes to several threads, and returns the answers in the order of the input.
//!
//! 1. [`Records`] reads lines and files one at a time.
//! 2. [`in_order`] passes them to several threads. A [`Capacity`] limits the records in progress.
//! 3. `in_order` passes one answer for each record to its caller, in the order of the records. A record that could not
//!    be read also gets an answer.
//!
//! This module only handles bytes. [`result`](crate::products::result) writes what an answer says about a scene.

mod queue;
mod record;

pub use queue::{ByteSize, Capacity, in_order};
pub use record::{Input, Record, Records};
