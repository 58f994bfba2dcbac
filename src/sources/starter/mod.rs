//! Generates the scene files of common structures from their dimensions and numbers of blocks.
//!
//! These scene files are starting points for users (`drystone new arch`), benchmarks and tests. The coordinates of
//! faces that touch are rounded to the same values, so rounding does not open any joint. Lengths are in metres, x
//! points right, y up.

mod arch;
mod lattice;
mod masonry;

pub use arch::Arch;
pub use lattice::LatticePile;
pub use masonry::{Doorway, Tower, Wall};

use crate::mechanics::scene::format::{BlockEntry, GroundEntry, Pair};

/// Coordinates are rounded to this many significant digits of the smallest length of the structure. The numbers are
/// short, and the rounding error is far smaller than any block.
const SIGNIFICANT_DIGITS: f64 = 4.0;

/// Rounds a coordinate, in metres, to the place of the fourth significant digit of `least`, the smallest length of the
/// structure in metres.
fn rounded(x: f64, least: f64) -> f64 {
    let decimals = SIGNIFICANT_DIGITS - 1.0 - libm::floor(libm::log10(least));
    let power = libm::pow(10.0, decimals.clamp(0.0, 15.0));
    let whole = (x * power).round() / power;
    // Adding 0 turns −0 into 0.
    whole + 0.0
}

/// Returns the four corners of the rectangle with the opposite corners `from` and `to`, in metres.
fn rectangle(from: Pair, to: Pair) -> Vec<Pair> {
    vec![from, [to[0], from[1]], to, [from[0], to[1]]]
}

fn block(id: String, polygon: Vec<Pair>) -> BlockEntry {
    BlockEntry { id: Some(id), polygon: Some(polygon), ..BlockEntry::default() }
}

/// Returns ground from x = `left` to x = `right`, in metres. It is `depth` metres thick, with its surface at y = 0.
fn floor(left: f64, right: f64, depth: f64) -> GroundEntry {
    GroundEntry { polygon: Some(rectangle([left, -depth], [right, 0.0])), ..GroundEntry::default() }
}

/// Density of stone, kg/m³.
const STONE_DENSITY: f64 = 2500.0;
