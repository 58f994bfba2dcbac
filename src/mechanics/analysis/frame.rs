//! Combines the proofs of the components of a frame, and adds the effect reports and notices of the whole frame.
//!
//! [`SolveReport`]: the method that decided a frame, the number of linear programs solved, and the time.
//!
//! [`Key`]: recognises components that occur unchanged in several frames, so that each is decided only once.

use super::{FrameAnalysis, Method, Verdict};
use crate::mechanics::program::UnknownCounts;
use crate::mechanics::proof::Proof;
use crate::mechanics::scene::{BlockId, RobotId};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect::report::{self, AdhesionSearch};
use crate::mechanics::statics::effect::{EffectName, FrameContext};
use crate::text::first_of;

/// Returns the weaker of two proofs. If both are of the same kind, the result has the worse value of each error. If
/// only one is a proof by a mechanism, the result is that proof.
pub(super) fn weaker_proof(a: Proof, b: Proof) -> Proof {
    match (a, b) {
        (
            Proof::Forces { worst_imbalance: i, worst_share: r, worst_pull: p, worst_slip: s },
            Proof::Forces { worst_imbalance: j, worst_share: q, worst_pull: t, worst_slip: u },
        ) => Proof::Forces {
            worst_imbalance: i.max(j),
            worst_share: r.max(q),
            worst_pull: p.max(t),
            worst_slip: s.max(u),
        },
        (Proof::Mechanism { power: p, worst_violation: v }, Proof::Mechanism { power: q, worst_violation: w }) => {
            Proof::Mechanism { power: p.min(q), worst_violation: v.max(w) }
        }
        (Proof::Mechanism { .. }, _) => a,
        _ => b,
    }
}

/// Completes the analysis of a frame: adds the number of unknowns of each effect, the reports on adhesion and
/// mechanism, and the notices. Removes the reasons for an undecided verdict if the frame is stable or unstable.
pub(super) fn complete_frame(
    analysis: &mut FrameAnalysis,
    context: &FrameContext,
    counts: &UnknownCounts,
    verdict_only: bool,
) {
    let unstable = analysis.verdict == Verdict::Unstable;
    if analysis.verdict != Verdict::Undecided {
        analysis.doubts.clear();
    }
    // Set the number of unknowns of each simulated effect.
    for report in analysis.effects.iter_mut().filter(|r| r.simulated) {
        report.unknowns = counts.get(report.effect);
    }
    let blocks = context.frame.placed.len();
    // Report whether adhesion was computed: only if the frame falls and its failures are requested.
    let search = match verdict_only {
        true if unstable => AdhesionSearch::NotRequested,
        _ if analysis.failures.is_empty() => AdhesionSearch::NotNeeded,
        _ => AdhesionSearch::Found,
    };
    analysis.effects.push(report::sticking(blocks, search, counts.get(EffectName::Sticking)));
    analysis.effects.push(report::mechanism(unstable));
    add_notices(analysis, context, verdict_only);
}

/// Adds notices about results that were not computed or not proved, and about blocks that no adhesion can hold.
fn add_notices(analysis: &mut FrameAnalysis, context: &FrameContext, verdict_only: bool) {
    match (verdict_only, analysis.verdict) {
        (true, Verdict::Stable) => analysis.notices.push(
            "only the verdict was asked for: where more than one set of forces balances, any of them is shown".into(),
        ),
        (true, Verdict::Unstable) => analysis
            .notices
            .push("only the verdict was asked for: the failures and the forces were not computed".into()),
        _ => {}
    }
    if analysis.verdict == Verdict::Stable && !analysis.least_force {
        analysis
            .notices
            .push("the forces shown balance every block; it was not proved that their sum is the least".into());
    }
    if !analysis.unsupported.is_empty() {
        let names = first_of(analysis.unsupported.iter().map(|b| context.scene.blocks[b.0].id.as_str()), 10);
        analysis.notices.push(format!("no sticking at the points where forces act could hold {names}"));
    }
}

/// How a frame was solved.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolveReport {
    /// The method that decided the hardest component: the greatest [`Method`] of all components.
    pub method: Method,
    /// The total number of solver iterations of the programs that `programs` counts.
    pub iterations: usize,
    /// The number of linear programs solved for the verdict and forces of this frame; 0 if closed forms or results of
    /// earlier frames decided every component.
    pub programs: usize,
    /// The number of components. Blocks in different components cannot influence each other.
    pub groups: usize,
    /// The number of components whose results come from an earlier frame.
    pub reused: usize,
    /// The wall time for the whole frame, in seconds.
    pub seconds: f64,
    /// The wall time of each stage.
    pub stages: Stages,
}

/// The wall time of each stage of a frame, in seconds. An effect that is not simulated adds no unknowns and takes no
/// time in any stage.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Stages {
    /// Assembling the frame: contacts, loads and grips from the contributions of all effects.
    pub assembly: f64,
    /// Solving and proving: verdict, forces, failures and mechanism.
    pub solution: f64,
    /// Checking whether the frame stands only by wedging.
    pub wedging: f64,
    /// Computing the margins.
    pub margins: f64,
    /// Computing the placement tolerance.
    pub placement: f64,
}

/// Components of one scene with the same key have the same results. The key contains the blocks, each hold (robot,
/// block, and the bits of the grip point's coordinates), and the bits of the component's length L.
pub(super) type Key = (Vec<BlockId>, Vec<(RobotId, BlockId, [u64; 2])>, u64);

/// Returns the key of a component: its blocks, its holds and its length L.
pub(super) fn key(component: &Assembly) -> Key {
    let blocks = component.bodies.iter().map(|body| body.block);
    let holds = component.grips.iter().map(|grip| {
        let block = component.bodies[grip.body].block;
        (grip.robot, block, [grip.at.x.to_bits(), grip.at.y.to_bits()])
    });
    (blocks.collect(), holds.collect(), component.length.to_bits())
}
