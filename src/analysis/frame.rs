//! What a frame's groups say together.

use super::{FrameAnalysis, Verdict};
use crate::effect::{Situation, mechanism, sticking};
use crate::proof::Proof;

/// The worst of the numbers of two proofs; of two kinds, the mechanism.
pub(super) fn worst(a: Proof, b: Proof) -> Proof {
    match (a, b) {
        (
            Proof::Forces {
                worst_imbalance: i,
                worst_share: r,
                worst_pull: p,
                worst_slip: s,
            },
            Proof::Forces {
                worst_imbalance: j,
                worst_share: q,
                worst_pull: t,
                worst_slip: u,
            },
        ) => Proof::Forces {
            worst_imbalance: i.max(j),
            worst_share: r.max(q),
            worst_pull: p.max(t),
            worst_slip: s.max(u),
        },
        (
            Proof::Mechanism {
                power: p,
                worst_violation: v,
            },
            Proof::Mechanism {
                power: q,
                worst_violation: w,
            },
        ) => Proof::Mechanism {
            power: p.min(q),
            worst_violation: v.max(w),
        },
        (Proof::Mechanism { .. }, _) => a,
        _ => b,
    }
}

/// Writes what only the outcome tells.
pub(super) fn settle(analysis: &mut FrameAnalysis, situation: &Situation) {
    let unstable = analysis.verdict == Verdict::Unstable;
    if analysis.verdict != Verdict::Undecided {
        analysis.doubt.clear();
    }
    analysis
        .effects
        .push(sticking::report(situation, !analysis.failures.is_empty()));
    analysis.effects.push(mechanism::report(unstable));
    if !analysis.unsupported.is_empty() {
        let names: Vec<&str> = analysis
            .unsupported
            .iter()
            .take(10)
            .map(|b| situation.scene.blocks[b.0].id.as_str())
            .collect();
        let more = match analysis.unsupported.len() - names.len() {
            0 => String::new(),
            n => format!(" and {n} more"),
        };
        analysis.notices.push(format!(
            "no sticking at the points where forces act could hold {}{more}",
            names.join(", ")
        ));
    }
}
