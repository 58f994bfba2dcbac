//! All integration tests in one program: what a person or another program sees of drystone.

mod gallery;
mod layers;
mod problems;
mod program;
