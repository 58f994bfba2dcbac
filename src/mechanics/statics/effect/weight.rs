//! Weight: each block's own weight at its centroid, along gravity. Adds no unknown. Source:
//! [Vallat23](crate::doc::references) §2.0.1.

use super::{Applicability, EffectName, FrameContext, counted};
use crate::assembly::Assembly;

/// Name in results.
pub const NAME: EffectName = EffectName::Weight;

/// Called for when some placed block has weight and gravity has a direction.
pub fn called_for(situation: &FrameContext) -> Applicability {
    let scene = situation.scene;
    let weights = situation.frame.placed.iter();
    let weights = weights.map(|b| scene.blocks[b.0].weight);
    match weights.filter(|weight| *weight > 0.0).count() {
        _ if scene.gravity.norm() == 0.0 => Applicability::not("there is no gravity"),
        0 => Applicability::not("no placed block has weight"),
        1 => Applicability::For("1 block has weight".to_owned()),
        n => Applicability::For(format!("{} have weight", counted(n, "block"))),
    }
}

/// Gives every body its weight, and the assembly the direction of gravity.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    assembly.pull = situation.scene.down();
    for body in &mut assembly.bodies {
        body.weight = situation.scene.blocks[body.block.0].weight;
    }
}
