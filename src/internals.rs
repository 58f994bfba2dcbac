//! The rooms that are not part of the public interface, and may change with any version.
//!
//! They are reachable here, and hidden in the documentation, for this crate's own tests, benchmarks and program. Nobody
//! else should name them.

#[path = "text/mod.rs"]
pub mod text;

#[path = "geometry/mod.rs"]
pub mod geometry;

#[path = "interface/mod.rs"]
pub mod interface;

#[path = "assembly/mod.rs"]
pub mod assembly;

#[path = "effect/mod.rs"]
pub mod effect;

#[path = "program/mod.rs"]
pub mod program;

#[path = "solve/mod.rs"]
pub mod solve;

#[path = "proof/mod.rs"]
pub mod proof;

#[path = "resultant/mod.rs"]
pub mod resultant;

#[cfg(feature = "report")]
#[path = "chart/mod.rs"]
pub mod chart;

#[cfg(feature = "report")]
#[path = "study/mod.rs"]
pub mod study;

#[cfg(feature = "cli")]
#[path = "cli/mod.rs"]
pub mod cli;
