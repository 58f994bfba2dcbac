//! [`Key`]: recognises components that occur unchanged in several frames, so that each is decided only once.

use crate::mechanics::scene::{BlockId, RobotId};
use crate::mechanics::statics::assembly::Assembly;

/// Components of one scene with the same key have the same results. The key contains the blocks, each hold (robot,
/// block, and the bits of the grip point's coordinates), and the bits of the component's length L.
pub(super) type Key = (Vec<BlockId>, Vec<(RobotId, BlockId, [u64; 2])>, u64);

/// Returns the key of a component: its blocks, its holds and its length L.
pub(super) fn key(component: &Assembly) -> Key {
    let blocks = component.bodies.iter().map(|body| body.block);
    let holds = component.grips.iter().map(|grip| {
        let block = component.bodies[grip.body].block;
        (grip.robot, block, [grip.at.x.to_bits(), grip.at.y.to_bits()])
    });
    (blocks.collect(), holds.collect(), component.length.to_bits())
}
