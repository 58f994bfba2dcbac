//! Decides whether a structure stands, and why. Leads from a scene file to an analysis, and uses no module that draws.
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
