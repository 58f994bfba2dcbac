//! [`Chain`]: a sequence of blocks in which forces pass from one joint to the next, such as the blocks of an arch.

use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::analysis::{FrameAnalysis, SolvedFrame};
use crate::mechanics::scene::{BlockId, BodyId};

use super::super::bearing::bearings;

/// A chain has at least this many blocks.
const MIN_BLOCKS: usize = 3;
/// Largest number of chains that are drawn. If there are more, the chains with the greatest thrust are drawn.
const MAX_CHAINS: usize = 3;
/// A chain whose thrust is below this fraction of its largest force is not drawn. Its rays would nearly lie on the
/// load line.
const MIN_THRUST_SHARE: f64 = 0.15;

/// A sequence of blocks from left to right. Forces press on each block in exactly two joints.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Chain {
    pub blocks: Vec<BlockId>,
    /// The indices of the contacts before, between and after the blocks.
    pub joints: Vec<usize>,
    /// For each joint, the force on the body that follows the joint, N.
    pub forces: Vec<Vector>,
    /// The horizontal thrust H at the crown, N: the component of the force in the highest joint perpendicular to
    /// gravity. If loads act sideways on the blocks, other joints have another thrust.
    pub crown_thrust: f64,
}

impl Chain {
    /// Returns the largest component of the joint forces perpendicular to gravity, N. `across` is the unit vector
    /// perpendicular to gravity.
    fn most_across(&self, across: Vector) -> f64 {
        let amounts = self.forces.iter().map(|f| f.dot(&across).abs());
        amounts.fold(0.0, f64::max)
    }

    fn largest(&self) -> f64 {
        self.forces.iter().map(|f| f.norm()).fold(0.0, f64::max)
    }
}

/// Returns the chains of blocks that have a horizontal thrust, sorted by decreasing thrust. At most [`MAX_CHAINS`]
/// chains are returned.
pub(crate) fn chains(solved: SolvedFrame<'_>) -> Vec<Chain> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let bearings = bearings(solved);
    let mut joints: Vec<Vec<usize>> = vec![Vec::new(); scene.blocks.len()];
    for (number, contact) in frame_analysis.contacts.iter().enumerate() {
        if bearings[number].is_some() {
            contact.acting().iter().for_each(|acting| joints[acting.on.0].push(number));
        }
    }
    let across = quarter_turn(scene.down());
    let mut chains: Vec<Chain> = Vec::new();
    for block in solved.frame().placed.iter().filter(|b| joints[b.0].len() == 2) {
        for first in joints[block.0].clone() {
            let before = frame_analysis.contacts[first].other(BodyId::Block(*block));
            if !matches!(before, BodyId::Block(b) if joints[b.0].len() == 2) {
                chains.extend(follow_chain(*block, first, &joints, frame_analysis));
            }
        }
    }
    // Each chain has been found twice, once from each end. Keep the copy that runs from left to right, if it is long
    // enough and has a thrust.
    let place = |joint: usize| across.dot(&frame_analysis.contacts[joint].resultant.at.coords);
    chains.retain(|chain| {
        let ends = (chain.joints[0], chain.joints[chain.joints.len() - 1]);
        chain.blocks.len() >= MIN_BLOCKS
            && place(ends.0) < place(ends.1)
            && chain.most_across(across) > MIN_THRUST_SHARE * chain.largest()
    });
    chains.sort_by(|a, b| b.most_across(across).total_cmp(&a.most_across(across)));
    chains.truncate(MAX_CHAINS);
    let height = |joint: usize| -scene.down().dot(&frame_analysis.contacts[joint].resultant.at.coords);
    for chain in &mut chains {
        let joints = chain.joints.iter().zip(&chain.forces);
        let crown = joints.max_by(|a, b| height(*a.0).total_cmp(&height(*b.0)));
        chain.crown_thrust = crown.map_or(0.0, |(_, force)| force.dot(&across).abs());
    }
    chains
}

/// Follows a chain of blocks from the joint `first` of the block `start` to the other end of the chain. Returns `None`
/// if the blocks form a closed ring.
fn follow_chain(start: BlockId, first: usize, joints: &[Vec<usize>], frame_analysis: &FrameAnalysis) -> Option<Chain> {
    let mut chain = Chain {
        blocks: Vec::new(),
        joints: vec![first],
        forces: vec![frame_analysis.contacts[first].force_on(BodyId::Block(start))],
        crown_thrust: 0.0,
    };
    let (mut block, mut joint) = (start, first);
    loop {
        chain.blocks.push(block);
        joint = *joints[block.0].iter().find(|j| **j != joint)?;
        let next = frame_analysis.contacts[joint].other(BodyId::Block(block));
        chain.joints.push(joint);
        chain.forces.push(frame_analysis.contacts[joint].force_on(next));
        match next {
            BodyId::Block(next) if joints[next.0].len() == 2 => block = next,
            _ => return Some(chain),
        }
        if chain.blocks.len() > joints.len() {
            return None;
        }
    }
}
