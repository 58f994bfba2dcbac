//! [`connected_groups`]: finds groups of moving blocks that are in contact.

use std::collections::BTreeMap;

use super::super::joint::Joint;
use crate::mechanics::analysis::{Analysis, Motion};
use crate::mechanics::scene::{BlockId, BodyId};

/// A block is at rest if the speed of its fastest point is at most this fraction of the largest speed of all blocks.
/// Slower motions are numerical noise of the solver or not visible.
const REST_TOL: f64 = 1e-3;

/// Groups the motions of the moving blocks into rigid bodies. Two blocks in contact belong to the same rigid body if
/// the contact between them is not in `joints`. The rigid bodies are in the order of their first blocks in the scene.
pub(crate) fn rigid_bodies(analysis: &Analysis, frame: usize, joints: &[Joint]) -> Vec<Vec<Motion>> {
    let mut separated = vec![false; analysis.frames[frame].contacts.len()];
    for joint in joints {
        separated[joint.contact] = true;
    }
    connected_groups(analysis, frame, |contact| !separated[contact])
}

/// Groups the motions of the moving blocks into connected components. Two blocks are connected if `joins` returns true
/// for the index of a contact between them. The groups are in the order of their first blocks in the scene.
pub(crate) fn connected_groups(analysis: &Analysis, frame: usize, joins: impl Fn(usize) -> bool) -> Vec<Vec<Motion>> {
    let motions: BTreeMap<BlockId, Motion> = moving(analysis, frame).map(|m| (m.block, *m)).collect();
    let mut neighbours: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
    for (number, contact) in analysis.frames[frame].contacts.iter().enumerate() {
        if let ([BodyId::Block(a), BodyId::Block(b)], true) = (contact.interface.bodies, joins(number)) {
            neighbours.entry(a).or_default().push(b);
            neighbours.entry(b).or_default().push(a);
        }
    }
    let mut seen = vec![false; analysis.scene.blocks.len()];
    let mut groups = Vec::new();
    for first in motions.keys() {
        let (mut group, mut stack) = (Vec::new(), vec![*first]);
        while let Some(block) = stack.pop() {
            let Some(motion) = motions.get(&block).filter(|_| !seen[block.0]) else {
                continue;
            };
            seen[block.0] = true;
            group.push(*motion);
            stack.extend(neighbours.get(&block).into_iter().flatten());
        }
        if !group.is_empty() {
            group.sort_by_key(|m| m.block);
            groups.push(group);
        }
    }
    groups
}

/// Returns the motions of the blocks that move visibly: the speed of their fastest point exceeds [`REST_TOL`] times
/// the largest speed in the frame.
pub(crate) fn moving(analysis: &Analysis, frame: usize) -> impl Iterator<Item = &Motion> {
    let (scene, motions) = (&analysis.scene, &analysis.frames[frame].mechanism);
    let speed = |m: &Motion| m.fastest(scene);
    let fastest = motions.iter().map(speed).fold(0.0, f64::max);
    motions.iter().filter(move |m| m.fastest(scene) > REST_TOL * fastest)
}
