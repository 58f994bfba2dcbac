//! Does a structure of dry-laid blocks stand, how do the forces run, and a figure that shows it.

pub mod geometry;
pub mod scene;
pub mod interface;
pub mod effect;
pub mod program;
pub mod solve;
pub mod analysis;
pub mod drawing;
pub mod output;
pub mod figure;
