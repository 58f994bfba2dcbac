//! What other programs read: the [`result`] of an analysis as JSON.
//!
//! The names in it are a contract. Fields are added, never renamed; pictures are not made here.

pub mod result;
