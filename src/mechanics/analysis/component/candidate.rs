//! Forces or a motion that somebody proposes, and the verdict that they prove.

use super::Case;
use crate::analysis::{Options, Verdict};
use crate::assembly::Assembly;
use crate::geometry::Vector;
use crate::program::Scale;
use crate::proof::{Motion, Proof};
use crate::scene::BlockId;
use crate::solve::Amounts;

/// Judges what was found for a whole assembly.
pub(in crate::mechanics::analysis) struct Candidate<'a> {
    case: Case<'a>,
    options: Options,
}

impl<'a> Candidate<'a> {
    /// For an assembly whose amounts and velocities are in the numbers of a scale.
    pub fn new(assembly: &'a Assembly, scale: Scale, options: Options) -> Candidate<'a> {
        Candidate {
            case: Case {
                scale,
                ..Case::new(assembly, options)
            },
            options,
        }
    }

    /// Stable where the amounts balance every body; unstable where what they leave unbalanced is a motion of one of the
    /// components that outweighs the band within which forces are believed. A motion of less is for the ladder to judge.
    pub fn verdict(&self, amounts: &Amounts, left: &[f64]) -> Option<Verdict> {
        let forces = self.case.carried_plainly(amounts);
        if self.case.believes(&forces) {
            return Some(Verdict::Stable);
        }
        // The blocks move against what is left to be given.
        let motion: Vec<f64> = left.iter().map(|v| -v).collect();
        let (speed, motions) = self.case.moved(&motion);
        if speed == 0.0 {
            return None;
        }
        let assembly = self.case.assembly;
        for component in assembly.components() {
            let case = Case {
                scale: self.case.scale,
                ..Case::new(&component, self.options)
            };
            let own = component.bodies.iter();
            let own: Vec<Motion> = own.map(|b| of_block(&motions, b.block)).collect();
            let proof = case.mechanism(&own);
            let moves = matches!(proof, Proof::Mechanism { power, .. } if power > 0.0);
            if moves && case.convinces(&own, &proof) && case.outweighs_the_band(&own, &proof) {
                return Some(Verdict::Unstable);
            }
        }
        None
    }
}

/// The motion of a block; motions stand in the order of the blocks.
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
