//! [`AppliedForce`]: a weight or a load, as a force that acts on a block from outside the structure.

use super::{BlockId, Load, Point, Scene, Vector};
use crate::geometry::{cross, quarter_turn};

/// A given force on a block: its weight or a load. Contact forces and the forces of robots are not applied forces.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct AppliedForce {
    /// The block on which the force acts.
    pub block: BlockId,
    /// The reason why the force acts.
    pub cause: ForceCause,
    /// The point where the force acts, metres.
    pub at: Point,
    /// The force, N.
    pub force: Vector,
    /// A torque that acts together with the force, N·m, anticlockwise positive.
    pub torque: f64,
}

/// The reason why a force acts on a block. When causes are sorted, weights come before loads, and the loads keep the
/// order of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum ForceCause {
    /// The weight of the block, at its centroid.
    Weight,
    /// A load that the scene lists, with its index in [`Scene::loads`].
    Load(usize),
}

impl Scene {
    /// Returns the weight and the loads of each block, indexed by block. The list of a block begins with its weight,
    /// unless this force is 0.
    ///
    /// Mechanisms, figures and reports take the forces from this list. A new effect that applies a force to blocks must
    /// therefore add the force here too.
    pub fn applied_forces(&self) -> Vec<Vec<AppliedForce>> {
        let weight = |(number, block): (usize, &super::Block)| AppliedForce {
            block: BlockId(number),
            cause: ForceCause::Weight,
            at: block.centroid,
            force: self.down() * block.weight,
            torque: 0.0,
        };
        let weights = self.blocks.iter().enumerate().map(weight);
        let mut forces: Vec<Vec<AppliedForce>> =
            weights.map(|weight| if weight.force.norm() > 0.0 { vec![weight] } else { Vec::new() }).collect();
        for (number, load) in self.loads.iter().enumerate() {
            forces[load.block.0].push(AppliedForce {
                block: load.block,
                cause: ForceCause::Load(number),
                at: load.at,
                force: load.force,
                torque: load.torque,
            });
        }
        forces
    }
    /// Returns the id that the file gives a load; `None` if it gives none.
    pub(crate) fn load_id(&self, load: &Load) -> Option<&str> {
        self.load_ids.get(load.entry)?.as_deref()
    }

    /// Returns the loads on the placed blocks as people list them: each load, and for each pressure its resultant. The
    /// resultant acts on the block that carries the largest part.
    pub(crate) fn loads_on(&self, placed: &[BlockId]) -> Vec<Load> {
        let mut is_placed = vec![false; self.blocks.len()];
        placed.iter().for_each(|block| is_placed[block.0] = true);
        let mut listed: Vec<Load> = Vec::new();
        for load in self.loads.iter().filter(|load| is_placed[load.block.0]) {
            match listed.last_mut().filter(|last| load.spread.is_some() && last.entry == load.entry) {
                Some(sum) => *sum = resultant(sum, load),
                None => listed.push(*load),
            }
        }
        listed
    }
}

/// Returns the load that is equivalent to two loads together. It acts on the block with the larger force.
fn resultant(first: &Load, second: &Load) -> Load {
    let force = first.force + second.force;
    let share = second.force.norm() / (first.force.norm() + second.force.norm());
    let at: Point = first.at + (second.at - first.at) * share;
    let moment = |load: &Load| cross(load.at - at, load.force) + load.torque;
    let moment = moment(first) + moment(second);
    let block = if share > 0.5 { second.block } else { first.block };
    // The force alone has this moment if it acts on a parallel line through the moved point.
    let away = quarter_turn(force) * (-moment / force.norm_squared());
    if away.iter().all(|x| x.is_finite()) {
        Load { force, at: at + away, torque: 0.0, block, ..*first }
    } else {
        Load { force, at, torque: moment, block, ..*first }
    }
}
