//! Loads: forces and torques on blocks in addition to their weight. The effect adds no unknowns to the linear program.

use super::{Applicability, Effect, EffectName, FrameContext, counted};
use crate::mechanics::statics::assembly::{Assembly, load_about};

/// The loads that the scene lists. Applies if one of them acts on a placed block; adds the loads to the load vectors of
/// the bodies.
pub(super) struct Loads;

impl Effect for Loads {
    fn name(&self) -> EffectName {
        EffectName::Loads
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let scene = context.scene;
        if scene.loads.is_empty() {
            return Applicability::skipped("the scene lists no loads");
        }
        let mut placed = vec![false; scene.blocks.len()];
        for block in &context.frame.placed {
            placed[block.0] = true;
        }
        let mut acting: Vec<usize> = scene.loads.iter().filter(|l| placed[l.block.0]).map(|l| l.entry).collect();
        acting.dedup();
        match acting.len() {
            0 => Applicability::skipped("no listed load acts on a placed block"),
            1 => Applicability::Applies("1 load acts on a placed block".to_owned()),
            n => Applicability::Applies(format!("{} act on placed blocks", counted(n, "load"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        let body_of_block = assembly.body_of_block(context.scene.blocks.len());
        for load in &context.scene.loads {
            if let Some(number) = body_of_block[load.block.0] {
                let body = &mut assembly.bodies[number];
                let more = load_about(body.centroid, load.at, load.force, load.torque);
                let sum = if load.is_fixed { &mut body.fixed } else { &mut body.listed };
                *sum = sum.plus(more);
            }
        }
    }
}
