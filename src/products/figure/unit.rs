//! [`unit()`]: computes the unit length, a typical size of the blocks. Arrows and labels are scaled with this length.

use super::view;
use crate::geometry::Bounds;
use crate::mechanics::scene::{Block, BlockId, Scene};

/// Blocks differ much in size if √(mean area) is more than this multiple of √area of the median block.
const UNEVEN_RATIO: f64 = 3.0;

/// Returns the unit length in metres: 0.6·√A, about the edge of a regular hexagon of area A. On a lattice, it is the
/// side of a cell, unless 0.6·√A is at least 1.5 times this side. A is the median area of the blocks, or the mean area
/// if its root is more than [`UNEVEN_RATIO`] times the root of the median area. In a picture zoomed to a block, A is
/// the area of the smallest block in the zoomed view.
pub(crate) fn unit(scene: &Scene, zoom: Option<BlockId>) -> f64 {
    let near = zoom.map(|block| view::zoomed_view(scene, block));
    let shown = |b: &&Block| near.is_none_or(|near| near.intersects(b.body.polygon.bounds()));
    let mut sizes: Vec<f64> = scene.blocks.iter().filter(shown).map(|b| b.body.polygon.area().sqrt()).collect();
    sizes.sort_by(f64::total_cmp);
    let squares: f64 = sizes.iter().map(|s| s * s).sum();
    let mean = libm::sqrt(squares / sizes.len().max(1) as f64);
    // A zoomed picture uses its smallest block, because small blocks must be visible next to large neighbours.
    let middle = if zoom.is_some() { 0 } else { sizes.len() / 2 };
    let middle = sizes.get(middle).copied().unwrap_or(1.0);
    // If there are small blocks next to a very large block, arrows as long as a small block would be nearly invisible.
    let uneven = zoom.is_none() && mean > UNEVEN_RATIO * middle;
    let typical = 0.6 * if uneven { mean } else { middle };
    match scene.lattice {
        Some(lattice) if typical < 1.5 * lattice.side => lattice.side,
        _ => typical,
    }
}

/// Length of the longest arrow of a load, as a fraction of the longer side of the structure.
const LONGEST_LOAD: f64 = 0.1;
/// Width of the shaft of a load's arrow, as a fraction of the length of the longest arrow. In some figures, shafts may
/// be wider.
pub(crate) const LOAD_SHAFT: f64 = 0.055;

/// Returns the length in metres of the longest arrow in figures that draw loads and missing forces, and no contact
/// forces, as arrows. It is a tenth of the longer side of the structure, and at least the unit length.
pub(crate) fn longest_load(scene: &Scene, zoom: Option<BlockId>) -> f64 {
    let edge = unit(scene, zoom);
    let blocks = scene.blocks.iter();
    let all = blocks.map(|b| b.body.polygon.bounds());
    let longer = all.reduce(Bounds::union).map_or(edge, |b| b.width().max(b.height()));
    edge.max(LONGEST_LOAD * longer)
}
