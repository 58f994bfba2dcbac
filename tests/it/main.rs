//! All integration tests in one program: what a person or another program sees of drystone.

mod gallery;
mod hard;
mod laws;
mod oracle;
mod pictures;
mod problems;
mod scenes;
mod statics;
mod structure;
