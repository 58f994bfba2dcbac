//! Does a structure of dry-laid rigid blocks stand, how do the forces run, and a figure that shows it.
//!
//! Plane statics: blocks with outlines of any shape, ground, friction, robots that hold blocks, and loads go in. Out comes,
//! for every step of a construction, a verdict with its proof, the force at every interface, what would have to stick where
//! it falls, the motion by which it does, and a figure of all that.
//!
//! ```
//! use drystone::{Analysis, Scene, analysis::Verdict, figure, output};
//!
//! let scene = Scene::from_json(r#"{ "drystone": 1, "title": "A lintel", "friction": 0.6,
//!     "ground": [{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }],
//!     "blocks": [{ "id": "left",   "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]] },
//!                { "id": "right",  "polygon": [[5, 0], [6, 0], [6, 3], [5, 3]] },
//!                { "id": "lintel", "polygon": [[0, 3], [6, 3], [6, 4], [0, 4]] }] }"#)?;
//! let analysis = Analysis::new(&scene);
//! assert_eq!(analysis.frames[0].verdict, Verdict::Stable);
//!
//! let drawing = figure::forces(&analysis, &figure::Options::default());
//! let svg = output::svg::write(&drawing);
//! let png = output::png::render(&svg, output::png::Size::Width(800))?;
//! assert!(svg.starts_with("<svg") && png.starts_with(b"\x89PNG"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The same scene made in code; what is wrong with it is told by its path, as that of a file is by its line:
//!
//! ```
//! use drystone::{Analysis, Scene, scene::format::BlockEntry};
//!
//! let post = [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [0.0, 3.0]];
//! let scene = Scene::builder()
//!     .title("A lintel")
//!     .friction(0.6)
//!     .ground([[-1.0, -1.0], [7.0, -1.0], [7.0, 0.0], [-1.0, 0.0]])
//!     .block(BlockEntry::new("left").polygon(post))
//!     .block(BlockEntry::new("right").polygon(post).at([5.0, 0.0]))
//!     .block(BlockEntry::new("lintel").polygon([[0.0, 3.0], [6.0, 3.0], [6.0, 4.0], [0.0, 4.0]]))
//!     .build()?;
//! assert_eq!(Analysis::new(&scene).frames[0].contacts.len(), 4);
//! # Ok::<(), drystone::scene::SceneError>(())
//! ```
//!
//! # What a verdict says, and what it does not
//!
//! *Stable* says that a balance of forces **exists**: some set of forces that contacts and robots can give holds every block
//! at rest. It does not say that
//!
//! - this is the balance that nature finds. With friction, a structure for which a balance exists may still slide apart as
//!   it is built ([Gilbert06](doc::references)); a balance that lives on wedging, blocks pressed against each other by nothing
//!   but their own tightness, counts as one;
//! - the blocks are strong enough. They are rigid and never break, and their edges bear any pressure;
//! - it survives a knock. Nothing here moves in time: no impact, no earthquake, no settling ground.
//!
//! And there is no cohesion: nothing sticks, unless it is said to fail by as much.
//!
//! # From a scene to a picture
//!
//! One noun per stage, and one verb that makes it:
//!
//! | | makes | from |
//! |---|---|---|
//! | [`Scene::from_json`] | [`Scene`], checked | text |
//! | [`Scene::builder`] | [`Scene`], checked | calls that read like the file |
//! | [`starter`] | a scene file | a few lengths and counts |
//! | [`import`](mod@import) | a scene file | a drawing: SVG, GeoJSON or WKT |
//! | [`interface`] | what touches what | a scene |
//! | [`effect::assemble`] | [`assembly::Assembly`]: bodies, contacts, grips | a frame, by the effects it calls for |
//! | [`program`] | the balance in pure numbers | an assembly |
//! | [`solve`] | forces, or a motion | a program |
//! | [`proof`] | how well that is proved | an assembly and forces alone |
//! | [`resultant`] | one force per interface | its corner forces |
//! | [`Analysis`] | all that was found out | all of the above |
//! | [`figure::forces`] | [`drawing::Drawing`] | an analysis |
//! | [`output::svg::write`] | SVG text | a drawing |
//! | [`output::png::render`] | PNG bytes | that text |
//! | [`output::pdf::write`] | a PDF page | a drawing, through that text |
//! | [`study::study`] | times and errors of solvers and tolerances | scenes |
//! | [`result::to_json`] | JSON for other programs | an analysis |
//! | [`session::Session`] | a verdict after every step | blocks placed and held one by one |
//! | [`snapshot`] | a comparison with stored references | scenes and their figures |
//! | [`text`] | escaped text for each output format | untrusted text |
//!
//! Why it is built so stands in [`doc::design`]; axes, units and signs in [`doc::conventions`]; tolerances and traps in
//! [`doc::numerics`].

// What only the program or another feature uses is no fault where these are left out; with all of them nothing is unused.
#![cfg_attr(not(feature = "cli"), allow(dead_code, unused_imports))]

// Blank lines keep the order of reading: the formatter would sort them.

// Types that callers fill and that will grow are `#[non_exhaustive]`: from outside they begin with their default, and each
// field has a method that gives back what it was called on. These macros write them, for every room below.

/// Methods that set a field.
macro_rules! setters {
    ($($field:ident: $type:ty, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            pub fn $field(mut self, $field: $type) -> Self {
                self.$field = $field;
                self
            }
        )*
    };
}

/// Methods that set a field that may be left out.
macro_rules! optional_setters {
    ($($field:ident: $type:ty, $doc:literal;)*) => {
        $(
            #[doc = $doc]
            pub fn $field(mut self, $field: $type) -> Self {
                self.$field = Some($field);
                self
            }
        )*
    };
}

#[doc(hidden)]
pub mod text;

#[doc(hidden)]
pub mod geometry;

mod mechanics;

mod pictures;

mod sources;

mod products;

mod entry;

#[doc(hidden)]
pub mod internals;

// Every module of a group is also named by its short path, `crate::scene` for `crate::mechanics::scene`.
pub use mechanics::{analysis, scene, session};
pub use pictures::{drawing, output};
#[cfg(feature = "snapshot")]
pub use products::snapshot;
pub use products::{figure, report, result};
#[cfg(feature = "import")]
pub use sources::import;
pub use sources::starter;

#[cfg(feature = "cli")]
use entry::cli;
#[cfg(feature = "python")]
use entry::python;
#[cfg(feature = "cli")]
use mechanics::batch;
use mechanics::statics::{assembly, effect, interface, resultant};
use mechanics::{program, proof, solve};
#[cfg(feature = "report")]
use pictures::chart;
#[cfg(feature = "report")]
use products::study;
use products::wording;

/// The nalgebra of [`scene::Point`] and [`scene::Vector`], whose version is part of this crate's interface: another one
/// comes with another version of this crate.
pub use nalgebra;

pub use analysis::Analysis;
pub use scene::Scene;

/// What stands between the lines of code: why, by which conventions, how precisely, from which drawings, and after whom.
pub mod doc {
    #[doc = include_str!("doc/architecture.md")]
    pub mod architecture {}

    #[doc = include_str!("doc/design.md")]
    pub mod design {}

    #[doc = include_str!("doc/cli.md")]
    pub mod cli {}

    #[doc = include_str!("doc/library.md")]
    pub mod library {}

    #[doc = include_str!("doc/conventions.md")]
    pub mod conventions {}

    #[doc = include_str!("doc/format.md")]
    pub mod format {}

    #[doc = include_str!("doc/result.md")]
    pub mod result {}

    #[doc = include_str!("doc/numerics.md")]
    pub mod numerics {}

    #[doc = include_str!("doc/accuracy.md")]
    #[doc = include_str!("../assets/accuracy.svg")]
    pub mod accuracy {}

    #[doc = include_str!("doc/performance.md")]
    pub mod performance {}

    #[doc = include_str!("doc/import.md")]
    pub mod import {}

    #[doc = include_str!("doc/snapshot.md")]
    pub mod snapshot {}

    #[doc = include_str!("doc/claims.md")]
    pub mod claims {}

    #[doc = include_str!("doc/references.md")]
    pub mod references {}
}

/// The examples of the README are tested like all others.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
