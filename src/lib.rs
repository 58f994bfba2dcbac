//! Does a structure of dry-laid blocks stand, how do the forces run, and a figure that shows it.

pub mod analysis;
pub mod effect;
pub mod geometry;
pub mod interface;
pub mod program;
pub mod proof;
pub mod report;
pub mod resultant;
pub mod scene;
pub mod solve;

pub use analysis::Analysis;
pub use scene::Scene;
