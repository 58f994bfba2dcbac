//! [`Key`]: what makes a component the same as one of an earlier frame.

use crate::assembly::Assembly;
use crate::scene::{BlockId, RobotId};

/// What makes one component the same as one of an earlier frame: its blocks, which robot holds which block where (by the bits
/// of the coordinates), and the bits of L.
pub(super) type Key = (Vec<BlockId>, Vec<(RobotId, BlockId, [u64; 2])>, u64);

/// The key of a component.
pub(super) fn key(component: &Assembly) -> Key {
    let blocks = component.bodies.iter().map(|body| body.block);
    let holds = component.grips.iter().map(|grip| {
        let block = component.bodies[grip.body].block;
        (
            grip.robot,
            block,
            [grip.at.x.to_bits(), grip.at.y.to_bits()],
        )
    });
    (
        blocks.collect(),
        holds.collect(),
        component.length.to_bits(),
    )
}
