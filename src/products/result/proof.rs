//! [`ProofNumbers`]: the numbers of a proof, as written in a result.

use serde::Serialize;

use super::Number;
use crate::mechanics::analysis::Proof;

#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum ProofNumbers {
    Forces { worst_imbalance: Number, worst_share: Number, worst_pull: Number, worst_slip: Number },
    Mechanism { power: Number, worst_violation: Number, no_balance_below: BalanceBound },
}

/// The sum of forces, relative to the loads of the moving blocks, below which no forces balance. `"unbounded"` if no
/// forces balance at all.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum BalanceBound {
    Sum(Number),
    Unbounded(&'static str),
}

impl ProofNumbers {
    pub(super) fn new(proof: Proof) -> ProofNumbers {
        match proof {
            Proof::Forces { worst_imbalance, worst_share, worst_pull, worst_slip } => ProofNumbers::Forces {
                worst_imbalance: Number(worst_imbalance),
                worst_share: Number(worst_share),
                worst_pull: Number(worst_pull),
                worst_slip: Number(worst_slip),
            },
            Proof::Mechanism { power, worst_violation } => ProofNumbers::Mechanism {
                power: Number(power),
                worst_violation: Number(worst_violation),
                no_balance_below: match proof.excluded_force_sum() {
                    sum if sum.is_finite() => BalanceBound::Sum(Number(sum)),
                    _ => BalanceBound::Unbounded("unbounded"),
                },
            },
        }
    }
}
