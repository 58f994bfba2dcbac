//! All integration tests in one program: what a person or another program sees of drystone.

mod gallery;
mod laws;
mod layers;
mod pictures;
mod problems;
mod program;
mod statics;
mod structure;
