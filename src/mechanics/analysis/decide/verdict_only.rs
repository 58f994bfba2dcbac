//! Computes only the verdict of a component, for margins and capacities. A margin needs the verdicts of many similar
//! components, most of them near the limit of stability.

use super::programs::Decision;
use super::{Component, LimitDistance, ProofCache};
use crate::mechanics::analysis::{Options, Verdict};
use crate::mechanics::program::Program;
use crate::mechanics::proof::{Forces, Motion};
use crate::mechanics::solve::{Amounts, Effort, is_late};
use crate::mechanics::statics::assembly::Assembly;

/// Returns the verdict of a component, and its mechanism if it falls.
///
/// Forces and motions of similar components are tried as proofs first. If none holds, the component is decided as in
/// [`decide_component`](super::decide_component), but the forces of least sum and the failures are not computed. Forces
/// or a motion that a program finds are added to the cache. After the deadline, the verdict is undecided.
pub(in crate::mechanics::analysis) fn decide_verdict(
    assembly: &Assembly,
    limit_distance: LimitDistance,
    cache: &mut ProofCache,
) -> (Verdict, Vec<Motion>) {
    let cached = verdict_from_cache(assembly, cache);
    if cached.0 != Verdict::Undecided || is_late() {
        return cached;
    }
    let component = Component { limit_distance, ..Component::new(assembly, VERDICT_ONLY) };
    let program = Program::new(assembly, component.scale);
    if let Some(found) = component.in_closed_form(&program) {
        return (found.verdict, found.mechanism);
    }
    let decision = decide_without_non_binding_limits(&component, &program);
    match decision.verdict {
        Verdict::Stable => cache.add_forces(assembly, component.prove_forces(&decision.amounts).forces),
        Verdict::Unstable => cache.add_motion(decision.mechanism.clone()),
        Verdict::Undecided => {}
    }
    (decision.verdict, decision.mechanism)
}

/// Returns the error of the most accurate known forces that balance an assembly, as `Proof::force_error` defines it.
/// Known forces are those in the cache, and those that the balance equations alone determine. `None` if no such forces
/// are known.
pub(in crate::mechanics::analysis) fn least_force_error(assembly: &Assembly, cache: &ProofCache) -> Option<f64> {
    let component = Component::new(assembly, VERDICT_ONLY);
    let program = Program::new(assembly, component.scale);
    let determinate = component.in_closed_form(&program);
    let determinate = determinate.and_then(|found| found.proof.force_error());
    let cached = cache.least_error(&component);
    cached.into_iter().chain(determinate).min_by(f64::total_cmp)
}

/// Returns the verdict that the forces and motions in the cache prove, and the mechanism if the verdict is unstable.
/// Solves no program. The verdict is undecided if they prove nothing, or if the deadline has passed.
pub(in crate::mechanics::analysis) fn verdict_from_cache(
    assembly: &Assembly,
    cache: &ProofCache,
) -> (Verdict, Vec<Motion>) {
    if is_late() {
        return (Verdict::Undecided, Vec::new());
    }
    let component = Component::new(assembly, VERDICT_ONLY);
    if cache.balances(&component) {
        return (Verdict::Stable, Vec::new());
    }
    match cache.falls(&component) {
        Some(motion) => (Verdict::Unstable, motion),
        None => (Verdict::Undecided, Vec::new()),
    }
}

/// The options for margins and capacities, which need only the verdict.
pub(super) const VERDICT_ONLY: Options = Options { verdict_only: true, ..Options::PLAIN };

/// Computes only the verdict of a component. First ignores the limits of robots that are far above the loads. Uses all
/// limits if this gives no decision.
pub(super) fn decide_without_non_binding_limits(component: &Component, program: &Program) -> Decision {
    // A motion that stronger robots cannot stop is a mechanism with the real limits, too.
    if let Some(generous) = program.without_non_binding_limits() {
        let decision = component.decide_by_programs(&generous);
        let allowed = || program.allows(&decision.amounts.grip);
        match decision.verdict {
            Verdict::Unstable => return decision,
            Verdict::Stable if allowed() => return decision,
            _ => {}
        }
    }
    component.decide_by_programs(program)
}

/// The results of a program exactly at the limit of stability, in program units.
#[derive(Debug)]
pub(in crate::mechanics::analysis) struct LimitResults<'a> {
    /// The linear program.
    pub program: &'a Program,
    /// Forces that balance at the limit, and the component at the limit.
    pub forces: Option<(&'a Amounts, &'a Assembly)>,
    /// The motion by which the component begins to fall, and the component well beyond the limit.
    pub motion: Option<(&'a [f64], &'a Assembly)>,
}

/// Adds the forces and the motion of a program at the limit of stability to the cache. Returns these forces in newtons;
/// `None` if the program gave no forces.
pub(in crate::mechanics::analysis) fn add_limit_to_cache(
    results: &LimitResults,
    cache: &mut ProofCache,
) -> Option<Forces> {
    let component = |assembly| Component { scale: results.program.scale, ..Component::new(assembly, VERDICT_ONLY) };
    if let Some((y, assembly)) = results.motion {
        let mut effort = Effort::default();
        let found = component(assembly).prove_motion(results.program, y, &mut effort);
        if let Some((motion, _)) = found {
            cache.add_motion(motion);
        }
    }
    let (amounts, assembly) = results.forces?;
    let forces = component(assembly).prove_forces(amounts).forces;
    cache.add_forces(assembly, forces.clone());
    Some(forces)
}
