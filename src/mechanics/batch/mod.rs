//! Many scenes, one after the other: records in, one line of JSON out for each, in the order in which they came.
//!
//! [`Records`] reads lines and files one at a time; [`in_order`] has several threads answer them, holds no more than
//! its [`Capacity`] has place for, and hands the answers on in order. Invariant: as many answers as records, in their order,
//! whatever is wrong with one of them. What an answer says is made by [`result`](crate::result); nothing
//! here knows of scenes.
//!
//! ```
//! use std::io::Cursor;
//! use std::ops::ControlFlow;
//! use drystone::batch::{Input, Records, Capacity, in_order};
//!
//! let text = Cursor::new("a\nbb\n\nccc");
//! let records = Records::new(vec![Input::lines(None, Box::new(text))]);
//! let mut described = Vec::new();
//! in_order(records, Capacity::new(2), |record| (record.line, record.bytes.map(|b| b.len())), |answer| {
//!     described.extend(answer);
//!     ControlFlow::Continue(())
//! });
//! assert_eq!(described, [(Some(1), Ok(1)), (Some(2), Ok(2)), (Some(3), Ok(0)), (Some(4), Ok(3))]);
//! ```

mod queue;
mod record;

pub use queue::{ByteSize, Capacity, in_order};
pub use record::{Input, LONGEST, Record, Records};
