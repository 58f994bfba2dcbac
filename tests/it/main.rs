//! All integration tests in one program. They test what a person or another program sees of drystone.

#![allow(
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test fails by a panic; the exceptions of these lints for #[test] do not include helper functions"
)]

mod accuracy;
mod agreement;
mod assembly;
mod book;
mod bound;
mod capacity;
mod certificate;
mod capacity_figure;
mod brought;
mod built;
mod circle;
mod claims;
mod column;
mod conditions;
mod costly;
mod edge;
mod drawings;
mod falls;
mod features;
mod freebody;
mod gallery;
mod hard;
mod healing;
mod import;
mod laboratory;
mod labels;
mod intervals;
mod joint_marks;
mod keys;
mod flow;
mod kinds;
mod laws;
mod layers;
mod leaders;
mod lines;
mod links;
mod loads;
mod notes;
mod pebbles;
mod oracle;
mod pages;
mod peers;
mod margins;
mod mechanism;
mod movement;
mod pictures;
mod pipes;
mod placement;
mod plan;
mod polygons;
mod preview;
mod print;
mod problems;
mod mutant;
mod program;
mod random;
mod removable;
mod round;
mod report;
mod scenes;
mod sensitivity;
mod sensitivity_figure;
mod session;
mod sinks;
mod small;
mod source;
mod starters;
mod snapshot;
mod statics;
mod strangers;
mod true_places;
mod structure;
mod vehicle;
mod visible;
mod walls;
mod wedging;
mod validation;
mod words;
