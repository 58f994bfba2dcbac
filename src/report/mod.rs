//! What other programs and people read: the [`result`] of an analysis as JSON, a report of many scenes as one [`page`], and
//! what [`accuracy`] costs.
//!
//! The names in results are a contract. Fields are added, never renamed; pictures are not made here.

pub mod accuracy;
pub mod book;
pub mod entry;
mod html;
mod markdown;
pub mod page;
mod print;
pub mod result;
