//! Does a structure of dry-laid blocks stand, how do the forces run, and a figure that shows it.

pub mod analysis;
pub mod drawing;
pub mod effect;
pub mod figure;
pub mod geometry;
pub mod interface;
pub mod output;
pub mod program;
pub mod proof;
pub mod report;
pub mod resultant;
pub mod scene;
pub mod solve;

pub use analysis::Analysis;
pub use scene::Scene;
