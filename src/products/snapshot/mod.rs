//! Snapshots: structures and their pictures under test. What was found out about a scene, its SVG and its pixels are kept beside
//! it as references; a check makes them anew and says in words what is not as it was.
//!
//! How to use it stands in [`doc::snapshot`](crate::doc::snapshot): `drystone snapshot DIR` on the command line,
//! [`assert_scene!`], [`assert_scenes!`] and [`assert_figure!`] in tests.
//!
//! | | makes | from |
//! |---|---|---|
//! | [`setting`] | what is checked, how wide, how precisely | `drystone-snapshots.toml` |
//! | [`discovery`] | which scenes there are, and where their references lie | folders |
//! | [`fact`] | what changed in verdict and forces | an analysis, a text |
//! | [`element`] | what changed in the drawing | two SVG |
//! | [`picture`] | what changed in the pixels | two pictures |
//! | [`check`](mod@check) | what is not as its reference says | all of these |
//! | [`store`] | references, `.new.*` and `.diff.png` on disk | findings |
//! | [`review`], [`ci`] | a page to look at, JUnit XML, annotations | a report |

pub mod assertion;
pub mod check;
pub mod ci;
pub mod discovery;
pub mod element;
pub mod fact;
pub mod picture;
pub mod review;
pub mod setting;
pub mod store;

pub use check::{CheckOutcome, Finding, Layer, Snapshot, State, check};
pub use discovery::{DiscoveryError, Job, discover};
pub use setting::Settings;

// Macros live at the root of a crate, by a rule of the language; here they stand where they belong.
pub use crate::{assert_figure, assert_scene, assert_scenes};
