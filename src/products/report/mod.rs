//! Reports for people: many scenes on one page (`page`), scenes in an mdBook (`book`), and the study of `accuracy`.
//!
//! The module `entry` collects the text, numbers and drawings of one scene. The modules `html`, `markdown` and `print`
//! write them in three formats. The module [`result`](crate::result) writes results as JSON for programs.

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
