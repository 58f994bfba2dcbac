//! Passes many scenes to several threads, and returns the answers in the order of the input.
//!
//! 1. [`Records`] reads lines and files one at a time.
//! 2. [`in_order`] passes them to several threads. The records in progress never exceed its [`Capacity`].
//! 3. It returns one answer for each record, in the order of the records, even for records that could not be read.
//!
//! This module only handles bytes. [`result`](crate::result) writes what an answer says about a scene.

mod queue;
mod record;

pub use queue::{ByteSize, Capacity, in_order};
pub use record::{Input, Record, Records};
