//! Reports for people: many scenes on one [`page`], scenes in an mdBook ([`book`]), and the [`accuracy`] study.
//!
//! [`entry`] collects the text, numbers and drawings of one scene. `html`, `markdown` and `print` write it in three
//! formats. [`result`](crate::result) writes results as JSON for programs.

#[cfg(feature = "report")]
pub mod accuracy;
#[cfg(feature = "report")]
pub mod book;
#[cfg(feature = "report")]
pub mod entry;
#[cfg(feature = "report")]
mod head;
#[cfg(feature = "report")]
mod html;
#[cfg(feature = "report")]
mod markdown;
#[cfg(feature = "report")]
pub mod page;
#[cfg(feature = "report")]
mod print;
