//! Computes whether a structure of dry-laid rigid blocks stands and which forces act in it, and draws the structure
//! with these forces.
//!
//! The model is plane statics. A scene has blocks with outlines of any shape, ground, friction, loads, and robots
//! that hold blocks. For every step of a construction, the analysis computes a verdict with its proof and the force
//! at every interface. If the structure falls, it also computes the missing forces and the motion. Figures show all
//! of this.
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
//! This example builds the same scene in code. An error names the path of the faulty entry; for a file, it also names
//! the line.
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
//! # What a verdict means
//!
//! *Stable* means that equilibrium is **possible**: there are forces that the contacts and robots can exert and that
//! balance every block. It does not mean that
//!
//! - these forces occur. With friction, a structure for which equilibrium is possible may still slide apart while it is
//!   built ([Gilbert06](doc::references)). The forces may also be due to wedging: blocks that press against each other
//!   although no load requires it;
//! - the blocks are strong enough. They are rigid and never break, and their edges bear any pressure;
//! - the structure survives a shock. The model has no dynamics: no impact and no earthquake.
//!
//! There is no cohesion. Sticking forces only show which force is missing in a structure that falls.
//!
//! # From a scene to a picture
//!
// The row of an optional module appears only if the module's feature is on; otherwise its link would be broken.
//! | function or module | output | input |
//! |---|---|---|
//! | [`Scene::from_json`] | [`Scene`], checked | text |
//! | [`Scene::builder`] | [`Scene`], checked | method calls, one for each entry of a scene file |
//! | [`starter`] | a scene file | a few lengths and counts |
#![cfg_attr(
    feature = "import",
    doc = "| [`import`](mod@import) | a scene file | a drawing: SVG, DXF, GeoJSON or WKT |"
)]
//! | [`interface`](internals::interface) | pairs of bodies that touch, and where | a scene |
//! | [`assemble`](internals::effect::assemble) | [`Assembly`](internals::assembly::Assembly): bodies, contacts, grips | a frame, with the effects that it needs |
//! | [`program`](internals::program) | the equilibrium equations in dimensionless numbers | an assembly |
//! | [`solve`](internals::solve) | forces, or a motion | a program |
//! | [`proof`](internals::proof) | the errors of these forces or this motion | an assembly, and forces or a motion |
//! | [`resultant`](internals::resultant) | one force per interface | the forces at the interface's ends |
//! | [`Analysis`] | verdict, forces, failures, motion and margins | a scene |
//! | [`figure::forces`] | [`drawing::Drawing`] | an analysis |
//! | [`output::svg::write`] | SVG text | a drawing |
#![cfg_attr(feature = "png", doc = "| [`output::png::render`] | PNG bytes | SVG text |")]
#![cfg_attr(feature = "pdf", doc = "| [`output::pdf::write`] | a PDF page | a drawing |")]
#![cfg_attr(
    feature = "report",
    doc = "| [`study`](internals::study::study) | times and errors of accuracy levels and tolerances | scenes |"
)]
//! | [`result::to_json`] | JSON for other programs | an analysis |
//! | [`session::Session`] | a verdict after every step | blocks placed and held one by one |
#![cfg_attr(
    feature = "snapshot",
    doc = "| [`snapshot`] | a comparison with stored references | scenes and their figures |"
)]
//! | [`text`] | escaped text for each output format | untrusted text |
//!
//! [`doc::design`] gives the reasons for this structure, [`doc::conventions`] axes, units and signs, and
//! [`doc::numerics`] tolerances and numerical difficulties.

// Some code is used only by the command line or by another optional feature. The compiler would report it as unused if
// that feature is off. With all features, no code is unused.
#![cfg_attr(not(feature = "cli"), allow(dead_code, unused_imports, unused_macros))]

// Structs with public fields are `#[non_exhaustive]` if later versions may add fields. Users start from the default
// value and call one setter method for each field. These macros define the setter methods for all modules below.

/// Defines one setter method for each listed field.
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

/// Defines one setter method for each listed field of type `Option`. The method takes the value without `Some`.
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

/// Declares an enum whose values users choose by name: each value with its documentation, its name and a line of help.
macro_rules! words {
    ($(#[$meta:meta])* $vis:vis enum $name:ident {
        $($(#[$about:meta])* $value:ident = $word:literal $(, $help:literal)?;)*
    }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        $vis enum $name {
            $($(#[$about])* $value,)*
        }

        impl crate::text::Word for $name {
            fn all() -> Vec<$name> {
                vec![$($name::$value),*]
            }

            fn word(self) -> &'static str {
                match self {
                    $($name::$value => $word),*
                }
            }

            fn help(self) -> &'static str {
                match self {
                    $($name::$value => concat!($($help)?)),*
                }
            }
        }
    };
}

/// Declares what users ask for: a struct whose fields are options of the command line and keys of JSON. Each field has
/// its documentation, its type, the expression that reads it from the keys that were given, and how `clap` declares it.
/// The default of a field is what the expression gives without keys. With `pub`, each field gets a setter method.
macro_rules! request {
    ($(#[$meta:meta])* pub struct $name:ident($given:ident) {
        $($(#[$about:meta])* pub $field:ident: $type:ty = $read:expr, $clap:ident($($args:tt)*);)*
    }) => {
        request! {
            @declare ($(#[$meta])* #[non_exhaustive]) (pub) $name($given)
            $($(#[$about])* (pub) $field: $type = $read, $clap($($args)*);)*
        }

        impl $name {
            $($(#[$about])* #[must_use] pub fn $field(mut self, $field: impl Into<$type>) -> Self {
                self.$field = $field.into();
                self
            })*
        }
    };
    ($(#[$meta:meta])* pub(crate) struct $name:ident($given:ident) {
        $($(#[$about:meta])* $field:ident: $type:ty = $read:expr, $clap:ident($($args:tt)*);)*
    }) => {
        request! {
            @declare ($(#[$meta])*) (pub(crate)) $name($given)
            $($(#[$about])* (pub(crate)) $field: $type = $read, $clap($($args)*);)*
        }
    };
    (@declare ($(#[$meta:meta])*) ($vis:vis) $name:ident($given:ident)
        $($(#[$about:meta])* ($field_vis:vis) $field:ident: $type:ty = $read:expr, $clap:ident($($args:tt)*);)*
    ) => {
        $(#[$meta])*
        #[cfg_attr(feature = "cli", derive(clap::Args), group(skip))]
        $vis struct $name {
            $($(#[$about])* #[cfg_attr(feature = "cli", $clap($($args)*))] $field_vis $field: $type,)*
        }

        impl $name {
            /// Reads the options from the keys that were given.
            pub(crate) fn read($given: &mut crate::read::Given<'_, '_>) -> $name {
                $name { $($field: $read),* }
            }
        }

        impl Default for $name {
            fn default() -> $name {
                $name::read(&mut crate::read::Given::none())
            }
        }
    };
}

// Blank lines between the modules keep them in this order. Without blank lines the formatter would sort them.

#[doc(hidden)]
pub mod text;

mod read;

#[doc(hidden)]
pub mod geometry;

mod clock;

mod mechanics;

mod pictures;

mod sources;

mod products;

mod entry;

#[doc(hidden)]
pub mod internals;

// The short paths of the public modules, for users of the crate. Code of the crate names the folder:
// `crate::mechanics::scene`.
#[cfg(feature = "certificate")]
pub use mechanics::certificate;
pub use mechanics::{analysis, scene, session};
pub use pictures::{drawing, output};
#[cfg(feature = "snapshot")]
pub use products::snapshot;
pub use products::{figure, report, result};
#[cfg(feature = "import")]
pub use sources::import;
pub use sources::starter;

#[cfg(feature = "wasm")]
pub use entry::wasm;

/// The crate nalgebra, which defines the types of [`scene::Point`] and [`scene::Vector`]. Its version is part of this
/// crate's interface: a different version of nalgebra comes only with a new version of this crate.
pub use nalgebra;

pub use analysis::Analysis;
pub use scene::Scene;

/// Background: the design, the conventions, the file formats, the numerical methods, their accuracy and the references.
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

    // `inline.md` and `validation.md` define the same picture links, and the first definition counts. In this
    // documentation the links contain the pictures themselves; in the repository they lead to the picture files.
    #[doc = include_str!("../assets/validation/inline.md")]
    #[doc = include_str!("doc/validation.md")]
    pub mod validation {}

    #[doc = include_str!("doc/performance.md")]
    pub mod performance {}

    #[doc = include_str!("doc/import.md")]
    pub mod import {}

    #[doc = include_str!("doc/snapshot.md")]
    pub mod snapshot {}

    #[doc = include_str!("doc/certificate.md")]
    pub mod certificate {}

    #[doc = include_str!("doc/placement.md")]
    pub mod placement {}

    #[doc = include_str!("doc/questions.md")]
    pub mod questions {}

    #[doc = include_str!("doc/references.md")]
    pub mod references {}
}

/// Compiles and runs the examples of the README as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
