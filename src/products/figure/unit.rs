//! [`unit()`]: computes the unit length, a typical size of the blocks. Arrows and labels are scaled with this length.

use crate::geometry::{Bounds, Point};
use crate::mechanics::scene::{Block, BlockId, Scene};

/// Blocks differ much in size if √(mean area) is more than this multiple of √area of the median block.
const UNEVEN_RATIO: f64 = 3.0;

/// Returns the unit length in metres: 0.6·√A, about the edge of a regular hexagon of area A. On a lattice, it is the
/// side of a cell, unless 0.6·√A is at least 1.5 times this side. A is the median area of the blocks, or the mean area
/// if its root is more than [`UNEVEN_RATIO`] times the root of the median area. In a picture zoomed to a block, A is
/// the area of the smallest block in the zoomed view.
pub(crate) fn unit(scene: &Scene, zoom: Option<BlockId>) -> f64 {
    let near = zoom.map(|block| zoomed_view(scene, block));
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

/// Distance from a block to the edge of its zoomed view, as a fraction of the block's larger side.
const ZOOM_PADDING: f64 = 0.5;

/// Returns a box around a block, in metres: the bounding box of the block, enlarged on all sides by half of its longer
/// side.
pub(crate) fn zoomed_view(scene: &Scene, block: BlockId) -> Bounds {
    let bounds = scene.blocks[block.0].body.polygon.bounds();
    bounds.grown(ZOOM_PADDING * bounds.width().max(bounds.height()))
}

/// True if a point lies in a box or on its boundary.
pub(crate) fn contains(bounds: Bounds, p: Point) -> bool {
    (bounds.min.x..=bounds.max.x).contains(&p.x) && (bounds.min.y..=bounds.max.y).contains(&p.y)
}
