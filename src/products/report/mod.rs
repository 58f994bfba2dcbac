//! Writes reports for people: a report on one or more scenes (`page`), figures in the chapters of an mdBook (`book`),
//! and accuracy studies (`accuracy`).
//!
//! For `page`, the module `entry` collects the text, numbers and drawings of one scene. The modules `html`, `markdown`
//! and `print` write them as HTML, Markdown and PDF. The module [`result`](crate::products::result) writes results as JSON for
//! programs.

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
