//! Proofs in words.

use super::number::{digits, rough};
use crate::analysis::Proof;

/// A proof in few words, for a line of a table.
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

/// Its numbers, each with its name.
pub fn numbers(proof: Proof) -> Vec<(&'static str, String)> {
    match proof {
        Proof::Forces {
            worst_imbalance,
            worst_pull,
            worst_slip,
            ..
        } => vec![
            (
                "worst imbalance of a block, in parts of its own forces",
                rough(worst_imbalance),
            ),
            (
                "worst pull at a contact, in parts of its own forces",
                rough(worst_pull),
            ),
            (
                "worst slip at a contact, or excess of a robot, in parts of its own force",
                rough(worst_slip),
            ),
        ],
        Proof::Mechanism {
            power,
            worst_violation,
        } => vec![
            (
                "power of the loads along the motion, in parts of what moves",
                digits(power),
            ),
            (
                "worst speed against which a contact or robot could act, in parts of the fastest",
                rough(worst_violation),
            ),
            (
                "no balance with less force than, in loads of what moves",
                match proof.excluded_force_sum() {
                    sum if sum.is_finite() => rough(sum),
                    _ => "any".into(),
                },
            ),
        ],
    }
}

/// What the numbers mean, for a reader who has never seen such a proof.
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
                    "The forces listed here, summed again from the outlines and weights alone, hold every block at rest: \
                     changed by at most {} of their own amounts they do so exactly. More than {band} would not be believed.",
                    rough(worst)
                )
            } else {
                format!(
                    "The best forces found do not balance: each would have to change by {} of its own amount, and more than \
                     {band} is not believed.",
                    rough(worst)
                )
            }
        }
        Proof::Mechanism { .. } => {
            let ruled_out = match proof.excluded_force_sum() {
                sum if sum.is_finite() => format!(
                    "so no forces balance it whose sum is less than {} times the loads of what moves",
                    rough(sum)
                ),
                _ => "so no forces balance it, however large".into(),
            };
            let believed = if proof.holds() {
                ""
            } else {
                " That is too little to be believed."
            };
            format!(
                "There is a motion along which the loads do work and no contact or robot can object, {ruled_out}.{believed}"
            )
        }
    }
}
