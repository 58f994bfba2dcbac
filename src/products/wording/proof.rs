//! Describes the proof of a verdict in words and numbers.

use super::number::{digits, rough};
use crate::mechanics::analysis::Proof;

/// Describes a proof in a few words, for one line of a table: `forces balance to 3e-12`.
pub fn short(proof: Proof) -> String {
    match proof {
        Proof::Forces { worst_imbalance, worst_pull, worst_slip, .. } => {
            format!("forces balance to {}", rough(worst_imbalance.max(worst_pull).max(worst_slip)))
        }
        Proof::Mechanism { power, .. } => {
            let ruled_out = match proof.excluded_force_sum() {
                sum if sum.is_finite() => format!("no balance below {} loads", rough(sum)),
                _ => "no balance at all".into(),
            };
            format!("motion of power {}: {ruled_out}", digits(power))
        }
    }
}

/// Returns the numbers that characterize a proof, each with a label that says what it measures.
pub fn numbers(proof: Proof) -> Vec<(&'static str, String)> {
    match proof {
        Proof::Forces { worst_imbalance, worst_pull, worst_slip, .. } => vec![
            ("worst imbalance of a block, relative to the forces on it", rough(worst_imbalance)),
            ("worst pull at a contact, relative to the forces at this contact", rough(worst_pull)),
            ("worst excess over a friction limit or robot limit, relative to the force there", rough(worst_slip)),
        ],
        Proof::Mechanism { power, worst_violation } => vec![
            (
                "power of the loads along the motion, less what robots can absorb, relative to the loads of the moving blocks",
                digits(power),
            ),
            (
                "worst speed against a contact or robot, relative to the speed of the fastest point",
                rough(worst_violation),
            ),
            (
                "lower bound on the sum of balancing forces, relative to the loads of the moving blocks",
                match proof.excluded_force_sum() {
                    sum if sum.is_finite() => rough(sum),
                    _ => "unbounded".into(),
                },
            ),
        ],
    }
}

/// Explains in one or more sentences what a proof shows, for readers who do not know the method.
pub fn sentence(proof: Proof) -> String {
    match proof {
        Proof::Forces { worst_imbalance, worst_pull, worst_slip, .. } => {
            let worst = worst_imbalance.max(worst_pull).max(worst_slip);
            let band = rough(Proof::IMBALANCE_TOL);
            if proof.holds() {
                format!(
                    "The listed forces hold every block at rest. This was checked from the outlines and weights alone: \
                     the forces balance exactly if each force changes by at most {} times its size. The limit is \
                     {band}.",
                    rough(worst)
                )
            } else {
                format!(
                    "The best forces found do not prove that the structure stands: to balance and to respect the \
                     contacts, they would have to change by {} times their size. The limit is {band}.",
                    rough(worst)
                )
            }
        }
        Proof::Mechanism { .. } => {
            let ruled_out = match proof.excluded_force_sum() {
                sum if sum.is_finite() => format!(
                    "so no forces balance the structure if their sum is less than {} times the loads of the moving blocks",
                    rough(sum)
                ),
                _ => "so no forces balance the structure, however large".into(),
            };
            let weak = if proof.holds() {
                ""
            } else {
                " The power of the loads is too small for a proof, or blocks move too fast against a contact or robot."
            };
            format!(
                "There is a motion that no contact resists, and along which the loads do work, more than robots can absorb if there are any, {ruled_out}.{weak}"
            )
        }
    }
}
