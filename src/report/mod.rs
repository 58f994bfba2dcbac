//! What other programs and people read: the [`result`] of an analysis as JSON, and what [`accuracy`] costs as a page.
//!
//! The names in it are a contract. Fields are added, never renamed; pictures are not made here.

pub mod accuracy;
pub mod book;
pub mod result;
