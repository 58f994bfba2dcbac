//! Does a structure stand, and why: from a scene file to an analysis. Knows nothing of pictures.
//!
//! The modules are listed in the order of dependency: each uses only those above it.

pub mod scene;

pub mod statics;

pub mod program;

pub mod solve;

pub mod proof;

pub mod analysis;

pub mod session;

pub mod batch;
