//! Motions of a group: from the solver's velocities to the scene's units, freed of the solver's error, with their proofs.

use super::{Case, Findings};
use crate::analysis::Verdict;
use crate::effect::Plan;
use crate::geometry::Vector;
use crate::program::{Program, load_on};
use crate::proof::{self, Motion, Proof};
use crate::scene::BodyId;
use crate::solve::{Effort, opened};

impl Case<'_> {
    /// The motion near a given one, freed from the solver's error, with its proof if that convinces.
    ///
    /// A violation is believed to be rounding only after the change: one of the solver's, however small, may be what the
    /// motion of a wedge into its notch lives on.
    pub(super) fn falling(
        &self,
        program: &Program,
        y: &[f64],
        effort: &mut Effort,
    ) -> Option<(Vec<Motion>, Proof)> {
        let (fastest, mut motion) = self.moved(y);
        let mut proof = self.mechanism(&motion);
        if motion.is_empty() {
            return None;
        }
        if proof.rules_out().is_finite() {
            let unit: Vec<f64> = y.iter().map(|v| v / fastest).collect();
            (_, motion) = self.moved(&opened(program, &unit, effort)?);
            proof = self.mechanism(&motion);
        }
        self.believes(&proof).then_some((motion, proof))
    }

    /// Whether a proved motion does more work than forces within the proof's band could take up.
    pub(super) fn outweighs_the_band(&self, motion: &[Motion], proof: &Proof) -> bool {
        let ways: f64 = motion
            .iter()
            .map(|m| m.velocity.norm() + m.spin.abs() * self.yardstick.length)
            .sum();
        matches!(proof, Proof::Mechanism { power, .. } if *power > 2.0 * Proof::BAND * ways)
    }

    /// A group that touches no ground and is held by nobody falls with the sum of its loads, all blocks alike.
    pub(super) fn falls_free(&self, plan: &Plan) -> Option<Findings> {
        let grounded = self
            .touching()
            .iter()
            .any(|i| matches!(i.bodies[1], BodyId::Ground(_)));
        if grounded || !self.group.holds.is_empty() {
            return None;
        }
        let total = self.group.blocks.iter().fold(Vector::zeros(), |sum, b| {
            sum + load_on(self.scene, plan, *b).0
        });
        if total.norm() <= Proof::BAND * self.yardstick.force {
            return None;
        }
        let velocity = total.normalize();
        let mechanism: Vec<Motion> = self
            .group
            .blocks
            .iter()
            .map(|block| Motion {
                block: *block,
                velocity,
                spin: 0.0,
            })
            .collect();
        let proof = proof::mechanism(
            self.scene,
            self.frame,
            &mechanism,
            &self.touching(),
            self.yardstick,
        );
        Some(Findings {
            verdict: Verdict::Unstable,
            doubt: String::new(),
            contacts: vec![([0.0; 2], 0.0); self.group.interfaces.len()],
            grips: Vec::new(),
            failures: Vec::new(),
            total_sticking: 0.0,
            unsupported: true,
            mechanism,
            proof,
            effort: Effort::default(),
        })
    }

    pub(super) fn mechanism(&self, motion: &[Motion]) -> Proof {
        proof::mechanism(
            self.scene,
            self.frame,
            motion,
            &self.touching(),
            self.yardstick,
        )
    }

    /// The speed of the fastest point in pure numbers, and motions in the scene's units, that point with speed 1.
    pub(super) fn moved(&self, y: &[f64]) -> (f64, Vec<Motion>) {
        let all = self
            .group
            .blocks
            .iter()
            .enumerate()
            .map(|(k, block)| Motion {
                block: *block,
                velocity: Vector::new(y[3 * k], y[3 * k + 1]),
                // Pure velocities are per unit of length.
                spin: y[3 * k + 2] / self.scale.length,
            });
        let all: Vec<Motion> = all.collect();
        let fastest = all
            .iter()
            .map(|m| m.fastest(self.scene))
            .fold(0.0, f64::max);
        if fastest == 0.0 {
            return (0.0, Vec::new());
        }
        let moved = all.iter().map(|m| Motion {
            block: m.block,
            velocity: m.velocity / fastest,
            spin: m.spin / fastest,
        });
        (fastest, moved.collect())
    }
}
