//! [`unit`]: the length in which a figure measures its arrows and letters, from the sizes of its blocks.

use super::view;
use crate::scene::{Block, BlockId, Scene};

/// Blocks are uneven in size if their mean area is more than this many times the median area.
const UNEVEN_RATIO: f64 = 3.0;

/// The unit edge in metres. On a lattice it is the side of a cell, unless the blocks are far larger. Otherwise it is a
/// typical size, 0.6·√area of the median block, which is about the edge of a regular hexagon of that area. If the mean area
/// is far larger, the mean is used. With `zoom` only the neighbourhood of that block counts.
pub(crate) fn unit(scene: &Scene, zoom: Option<BlockId>) -> f64 {
    let near = zoom.map(|block| view::around(scene, block));
    let shown = |b: &&Block| near.is_none_or(|near| near.intersects(b.body.polygon.bounds()));
    let mut sizes: Vec<f64> = scene
        .blocks
        .iter()
        .filter(shown)
        .map(|b| b.body.polygon.area().sqrt())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let squares: f64 = sizes.iter().map(|s| s * s).sum();
    let mean = libm::sqrt(squares / sizes.len().max(1) as f64);
    // In a zoomed picture the block itself must be visible, however large its neighbours are.
    let middle = if zoom.is_some() { 0 } else { sizes.len() / 2 };
    let middle = sizes.get(middle).copied().unwrap_or(1.0);
    // Small stones next to a very large block: arrows as long as a small stone would be nearly invisible.
    let uneven = zoom.is_none() && mean > UNEVEN_RATIO * middle;
    let typical = 0.6 * if uneven { mean } else { middle };
    match scene.lattice {
        Some(lattice) if typical < 1.5 * lattice.side => lattice.side,
        _ => typical,
    }
}
