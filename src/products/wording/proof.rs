//! Describes proofs in words and numbers.

use super::number::{digits, rough};
use crate::analysis::Proof;

/// Describes a proof in a few words, for one line of a table.
pub fn short(proof: Proof) -> String {
    match proof {
        Proof::Forces {
            worst_imbalance,
            worst_pull,
            worst_slip,
            ..
        } => {
            format!(
                "forces balance to {}",
                rough(worst_imbalance.max(worst_pull).max(worst_slip))
            )
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

/// Returns the numbers of a proof, each with a label.
pub fn numbers(proof: Proof) -> Vec<(&'static str, String)> {
    match proof {
        Proof::Forces {
            worst_imbalance,
            worst_pull,
            worst_slip,
            ..
        } => vec![
            (
                "worst imbalance of a block, relative to the forces on it",
                rough(worst_imbalance),
            ),
            (
                "worst pull at a contact, relative to its own forces",
                rough(worst_pull),
            ),
            (
                "worst slip at a contact, or excess of a robot, relative to its own force",
                rough(worst_slip),
            ),
        ],
        Proof::Mechanism {
            power,
            worst_violation,
        } => vec![
            (
                "power of the loads along the motion, relative to the loads of the moving blocks",
                digits(power),
            ),
            (
                "worst speed against a contact or robot, relative to the fastest point",
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

/// Explains a proof to a reader who does not know such proofs.
pub fn sentence(proof: Proof) -> String {
    match proof {
        Proof::Forces {
            worst_imbalance,
            worst_pull,
            worst_slip,
            ..
        } => {
            let worst = worst_imbalance.max(worst_pull).max(worst_slip);
            let band = rough(Proof::IMBALANCE_TOL);
            if proof.holds() {
                format!(
                    "The listed forces hold every block at rest. This was checked from the outlines and weights alone: \
                     the forces balance exactly if each changes by at most {} of its own amount. The limit is {band}.",
                    rough(worst)
                )
            } else {
                format!(
                    "The best forces found do not balance: they would have to change by {} of their own amounts. The limit \
                     is {band}.",
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
                " The power of the loads is too small for a proof."
            };
            format!(
                "There is a motion along which the loads do work and that no contact or robot resists, {ruled_out}.{weak}"
            )
        }
    }
}
