//! Loads: forces and torques on blocks beside their weight. Add no unknown.

use super::{Applicability, EffectName, FrameContext, counted};
use crate::assembly::{Assembly, about};

/// Name in results.
pub const NAME: EffectName = EffectName::Loads;

/// Called for when the scene lists a load on a placed block.
pub fn called_for(situation: &FrameContext) -> Applicability {
    let scene = situation.scene;
    if scene.loads.is_empty() {
        return Applicability::not("the scene lists no loads");
    }
    let mut placed = vec![false; scene.blocks.len()];
    for block in &situation.frame.placed {
        placed[block.0] = true;
    }
    match scene.loads.iter().filter(|l| placed[l.block.0]).count() {
        0 => Applicability::not("no listed load acts on a placed block"),
        1 => Applicability::For("1 load acts on a placed block".to_owned()),
        n => Applicability::For(format!("{} act on placed blocks", counted(n, "load"))),
    }
}

/// Adds the listed loads of every placed block to its body.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    let numbers = assembly.numbers(situation.scene.blocks.len());
    for load in &situation.scene.loads {
        if let Some(number) = numbers[load.block.0] {
            let body = &mut assembly.bodies[number];
            let more = about(body.centroid, load.at, load.force, load.torque);
            body.listed = body.listed.and(more);
        }
    }
}
