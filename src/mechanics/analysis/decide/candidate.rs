//! Route 0: proves a verdict from forces or a motion that were computed elsewhere, without solving a program.

use super::Component;
use crate::geometry::Vector;
use crate::mechanics::analysis::{Options, Verdict};
use crate::mechanics::program::Scale;
use crate::mechanics::proof::{Motion, Proof};
use crate::mechanics::scene::BlockId;
use crate::mechanics::solve::Amounts;
use crate::mechanics::statics::assembly::Assembly;

/// Tries to prove a verdict on a whole assembly from given forces and velocities.
pub(in crate::mechanics::analysis) struct Candidate<'a> {
    component: Component<'a>,
    options: Options,
}

impl<'a> Candidate<'a> {
    /// Creates a candidate for an assembly. Forces and velocities are in the units of `scale`.
    pub fn new(assembly: &'a Assembly, scale: Scale, options: Options) -> Candidate<'a> {
        Candidate { component: Component { scale, ..Component::new(assembly, options) }, options }
    }

    /// Returns *stable* if the forces `amounts` balance every body. Returns *unstable* if the motion along the
    /// unbalanced load is, for some component, a mechanism that no admissible forces can stop. Returns `None`
    /// otherwise. `residual` is minus the unbalanced load: three rows for each body, in program units.
    pub fn verdict(&self, amounts: &Amounts, residual: &[f64]) -> Option<Verdict> {
        let forces = self.component.prove_without_cleaning(amounts);
        if self.component.accepts(&forces) {
            return Some(Verdict::Stable);
        }
        // The blocks move in the direction of the unbalanced load.
        let motion: Vec<f64> = residual.iter().map(|v| -v).collect();
        let (speed, motions) = self.component.to_motions(&motion);
        if speed == 0.0 {
            return None;
        }
        let assembly = self.component.assembly;
        for assembly in assembly.components() {
            let part = Component { scale: self.component.scale, ..Component::new(&assembly, self.options) };
            let part_motion = assembly.bodies.iter();
            let part_motion: Vec<Motion> = part_motion.map(|b| motion_of_block(&motions, b.block)).collect();
            let proof = part.check_mechanism(&part_motion);
            let moves = matches!(proof, Proof::Mechanism { power, .. } if power > 0.0);
            if moves && part.accepts_motion(&part_motion, &proof) && part.exceeds_force_tolerance(&part_motion, &proof)
            {
                return Some(Verdict::Unstable);
            }
        }
        None
    }
}

/// Returns the motion of a block from `motions`, which are sorted by block. A block that is not in the list is at rest.
fn motion_of_block(motions: &[Motion], block: BlockId) -> Motion {
    match motions.binary_search_by_key(&block, |motion| motion.block) {
        Ok(index) => motions[index],
        Err(_) => Motion { block, velocity: Vector::zeros(), spin: 0.0 },
    }
}
