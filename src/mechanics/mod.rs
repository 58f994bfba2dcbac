//! Decides whether a structure stands, and explains why. Contains all steps from a scene file to its analysis, but no
//! drawing.
//!
//! The modules are listed in the order of dependency: each uses only those above it.

pub mod scene;

pub mod statics;

pub mod proof;

pub mod program;

pub mod solve;

pub mod wedge;

pub mod analysis;

pub mod vary;

pub mod session;

pub mod batch;

#[cfg(feature = "certificate")]
pub mod certificate;

mod exact;
