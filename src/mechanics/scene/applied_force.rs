//! [`AppliedForce`]: a weight or a load, as a force that acts on a block from outside the structure.

use super::{BlockId, Point, Scene, Vector};

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
}
