//! What other programs and people read: the [`result`](crate::result) of an analysis as JSON, a report of many scenes as one [`page`], and
//! what [`accuracy`] costs.
//!
//! The names in results are a contract. Fields are added, never renamed; pictures are not made here.

#[cfg(feature = "report")]
pub mod accuracy;
#[cfg(feature = "report")]
pub mod book;
#[cfg(feature = "report")]
pub mod entry;
#[cfg(feature = "report")]
mod html;
#[cfg(feature = "report")]
mod markdown;
#[cfg(feature = "report")]
pub mod page;
#[cfg(feature = "report")]
mod print;
