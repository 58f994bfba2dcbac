//! Route 0: proves a verdict from forces or a motion that were computed elsewhere, without solving a program.

use super::Component;
use crate::analysis::{Options, Verdict};
use crate::assembly::Assembly;
use crate::geometry::Vector;
use crate::program::Scale;
use crate::proof::{Motion, Proof};
use crate::scene::BlockId;
use crate::solve::Amounts;

/// Forces and velocities of a whole assembly, to be proved.
pub(in crate::mechanics::analysis) struct Candidate<'a> {
    component: Component<'a>,
    options: Options,
}

impl<'a> Candidate<'a> {
    /// Creates a checker that tries to prove a verdict on an assembly. The forces and velocities to check will be in
    /// the units of `scale`.
    pub fn new(assembly: &'a Assembly, scale: Scale, options: Options) -> Candidate<'a> {
        Candidate {
            component: Component {
                scale,
                ..Component::new(assembly, options)
            },
            options,
        }
    }

    /// Returns *stable* if the forces `amounts` balance every body. Returns *unstable* if the motion along the
    /// unbalanced load is a mechanism that no admissible forces can stop. Otherwise `None`. `left` is minus the
    /// unbalanced load: three rows for each body, in program units.
    pub fn verdict(&self, amounts: &Amounts, left: &[f64]) -> Option<Verdict> {
        let forces = self.component.prove_without_cleaning(amounts);
        if self.component.believes(&forces) {
            return Some(Verdict::Stable);
        }
        // The blocks move in the direction of the unbalanced load.
        let motion: Vec<f64> = left.iter().map(|v| -v).collect();
        let (speed, motions) = self.component.moved(&motion);
        if speed == 0.0 {
            return None;
        }
        let assembly = self.component.assembly;
        for assembly in assembly.components() {
            let part = Component {
                scale: self.component.scale,
                ..Component::new(&assembly, self.options)
            };
            let own = assembly.bodies.iter();
            let own: Vec<Motion> = own.map(|b| of_block(&motions, b.block)).collect();
            let proof = part.mechanism(&own);
            let moves = matches!(proof, Proof::Mechanism { power, .. } if power > 0.0);
            if moves && part.convinces(&own, &proof) && part.exceeds_force_tolerance(&own, &proof) {
                return Some(Verdict::Unstable);
            }
        }
        None
    }
}

/// Returns the motion of a block from `motions`, which are sorted by block. A block that is not in the list is at rest.
fn of_block(motions: &[Motion], block: BlockId) -> Motion {
    match motions.binary_search_by_key(&block, |motion| motion.block) {
        Ok(place) => motions[place],
        Err(_) => Motion {
            block,
            velocity: Vector::zeros(),
            spin: 0.0,
        },
    }
}
