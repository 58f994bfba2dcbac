//! Snapshot tests for scenes and their pictures.
//!
//! The facts of a scene (verdict and forces), its SVG and its pixels are stored in reference files next to the scene
//! file. A check computes them again and describes every difference in words. Users run checks with
//! `drystone snapshot DIR` on the command line, or with [`assert_scene!`], [`assert_scenes!`] and [`assert_figure!`] in
//! tests; [`doc::snapshot`](crate::doc::snapshot) is the user guide.
//!
//! | module | result | input |
//! |---|---|---|
//! | [`setting`] | the settings: layers, widths, tolerances | `drystone-snapshots.toml` |
//! | [`discovery`] | the scenes, and orphaned references | folders |
//! | [`reference`](mod@reference) | the reference files of a scene | settings |
//! | [`fact`] | differences in verdict and forces | an analysis and a text |
//! | [`svg`] | differences in the drawing | two SVG texts |
//! | [`picture`] | differences in the pixels | two pictures |
//! | [`check`](mod@check) | the findings: all references that differ | all of these |
//! | [`store`] | files: references, `.new.*` and `.diff.png` | findings |
//! | [`review`], [`summary`], [`ci`] | a review page, Markdown, JUnit XML, annotations, JSON | findings |

pub mod assertion;
pub mod check;
pub mod ci;
pub mod discovery;
pub mod fact;
mod layer;
pub mod outcome;
pub mod picture;
pub mod reference;
pub mod review;
pub mod setting;
pub mod store;
pub mod summary;
pub mod svg;

pub use check::check;
pub use discovery::{Job, discover};
pub use layer::{Layer, UnreadableReference};
pub use outcome::{CheckOutcome, Finding, Snapshot, State};
pub use setting::Settings;

// Rust exports macros at the root of the crate. This module exports them too, because users look for them here.
pub use crate::{assert_figure, assert_scene, assert_scenes};
