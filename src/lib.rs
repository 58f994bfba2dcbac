//! Does a structure of dry-laid blocks stand, how do the forces run, and a figure that shows it.

pub mod geometry;
pub mod scene;
pub mod interface;
pub mod effect;
pub mod program;
pub mod solve;
pub mod proof;
pub mod resultant;
pub mod analysis;
pub mod drawing;
pub mod figure;
pub mod output;

pub use analysis::Analysis;
pub use scene::Scene;
