//! Weight: gravity acts on each block at its centroid. The effect adds no unknowns to the linear program.
//!
//! Source: [Vallat23](crate::doc::references) §2.0.1.

use super::{Applicability, Effect, EffectName, FrameContext, counted};
use crate::mechanics::statics::assembly::Assembly;

/// The weight of the blocks. Applies if there is gravity and a placed block has weight; sets the weight of each body
/// and the direction of gravity.
pub(super) struct Weight;

impl Effect for Weight {
    fn name(&self) -> EffectName {
        EffectName::Weight
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let scene = context.scene;
        let weights = context.frame.placed.iter();
        let weights = weights.map(|b| scene.blocks[b.0].weight);
        match weights.filter(|weight| *weight > 0.0).count() {
            _ if scene.gravity.norm() == 0.0 => Applicability::skipped("there is no gravity"),
            0 => Applicability::skipped("no placed block has weight"),
            1 => Applicability::Applies("1 block has weight".to_owned()),
            n => Applicability::Applies(format!("{} have weight", counted(n, "block"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        assembly.pull = context.scene.down();
        for body in &mut assembly.bodies {
            body.weight = context.scene.blocks[body.block.0].weight;
        }
    }
}
