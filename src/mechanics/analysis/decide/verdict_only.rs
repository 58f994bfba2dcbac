//! Computes only the verdict of a component, for margins and capacities, and proves the forces and motions of linear
//! programs at the limit of stability. A margin needs the verdicts of many similar components, most of them near this
//! limit.
//!
//! Route 0: proves a verdict from forces or a motion that were computed elsewhere, without solving a program.

use super::{Component, LimitDistance, Outcome, ProofCache};
use crate::geometry::Vector;
use crate::mechanics::analysis::{Options, Verdict};
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::{Forces, Motion, Proof};
use crate::mechanics::scene::BlockId;
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
    let found = decide_without_non_binding_limits(&component, &program);
    match found.verdict {
        Verdict::Stable => cache.add_forces(assembly, found.forces),
        Verdict::Unstable => cache.add_motion(found.mechanism.clone()),
        Verdict::Undecided => {}
    }
    (found.verdict, found.mechanism)
}

/// Returns a mechanism of all components of an assembly that fall.
#[cfg(feature = "certificate")]
pub(crate) fn mechanism_of(assembly: &Assembly) -> Vec<Motion> {
    let fresh = |component| decide_verdict(&component, LimitDistance::Unknown, &mut ProofCache::default()).1;
    assembly.components().into_iter().flat_map(fresh).collect()
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
const VERDICT_ONLY: Options = Options { verdict_only: true, ..Options::PLAIN };

/// Computes only the verdict of a component. First ignores the limits of robots that are far above the loads. Uses all
/// limits if this gives no decision.
fn decide_without_non_binding_limits(component: &Component, program: &Program) -> Outcome {
    // A motion that stronger robots cannot stop is a mechanism with the real limits, too.
    if let Some(generous) = program.without_non_binding_limits() {
        let found = component.decide_by_programs(&generous);
        match found.verdict {
            Verdict::Unstable => return found,
            Verdict::Stable if program.allows(&found.amounts.grip) => return found,
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
    let component = |assembly| in_scale_of(assembly, results.program);
    if let Some((y, assembly)) = results.motion {
        let mut effort = Effort::default();
        let found = component(assembly).prove_motion(results.program, y, &mut effort);
        if let Some((motion, _)) = found {
            cache.add_motion(motion);
        }
    }
    let (amounts, assembly) = results.forces?;
    let forces = component(assembly).prove_forces(amounts.clone()).forces;
    cache.add_forces(assembly, forces.clone());
    Some(forces)
}

/// Converts `amounts`, the forces of a linear program, to newtons. Returns them with the proof that they balance every
/// body; `None` if this proof fails.
///
/// `program` is the linear program of `assembly`, in any scale.
pub(in crate::mechanics::analysis) fn proved_forces(
    assembly: &Assembly,
    program: &Program,
    amounts: &Amounts,
) -> Option<(Forces, Proof)> {
    let component = in_scale_of(assembly, program);
    let found = component.prove_forces(amounts.clone());
    component.accepts(&found.proof).then_some((found.forces, found.proof))
}

/// Decides a component, and returns forces in newtons that balance it, with their proof. `None` if the component falls
/// or is undecided.
pub(in crate::mechanics::analysis) fn decided_forces(assembly: &Assembly) -> Option<(Forces, Proof)> {
    let component = Component::new(assembly, VERDICT_ONLY);
    let program = Program::new(assembly, component.scale);
    let found = decide_without_non_binding_limits(&component, &program);
    (found.verdict == Verdict::Stable).then_some((found.forces, found.proof))
}

/// Corrects the velocities `y`, the result of a linear program, so that they violate no contact. Returns the corrected
/// motion, with one entry for each body, and the proof that the component falls by it. `None` if no such motion is
/// found, or if its proof is too weak.
pub(in crate::mechanics::analysis) fn proved_motion(
    assembly: &Assembly,
    program: &Program,
    y: &[f64],
) -> Option<(Vec<Motion>, Proof)> {
    in_scale_of(assembly, program).prove_motion(program, y, &mut Effort::default())
}

/// Converts the velocities `y`, the result of a linear program, to a motion of each body, without correction. Returns
/// the motion with the proof that the component falls by it. `None` if the motion violates a contact by more than
/// rounding, or if the proof is too weak.
pub(in crate::mechanics::analysis) fn proved_exact_motion(
    assembly: &Assembly,
    program: &Program,
    y: &[f64],
) -> Option<(Vec<Motion>, Proof)> {
    let component = in_scale_of(assembly, program);
    let (_, motion) = component.to_motions(y);
    let proof = component.check_mechanism(&motion);
    let is_exact = matches!(proof, Proof::Mechanism { worst_violation, .. } if worst_violation <= MAX_ROUNDING);
    (is_exact && component.accepts_motion(&motion, &proof)).then_some((motion, proof))
}

/// A motion violates contacts only by rounding if the violation is at most this; the fastest point has speed 1. Forces
/// of a thousand times the loads could then change a limit by at most 1e-10 of the loads. Long chains of blocks have a
/// rounding of 1e-14, so with a tenth of this value more motions would need a correction. With ten times this value,
/// errors as large as the openings that [`repair_motion`](crate::mechanics::solve::repair_motion) adds would count as rounding.
const MAX_ROUNDING: f64 = 1e-13;

fn in_scale_of<'a>(assembly: &'a Assembly, program: &Program) -> Component<'a> {
    Component { scale: program.scale, ..Component::new(assembly, VERDICT_ONLY) }
}

/// Tries to prove a verdict on a whole assembly from given forces and velocities.
pub(in crate::mechanics::analysis) struct Candidate<'a> {
    component: Component<'a>,
    options: Options,
}

impl<'a> Candidate<'a> {
    /// Creates a candidate for an assembly. Forces and velocities are in the units of `scale`.
    pub fn new(assembly: &'a Assembly, scale: Scale, options: Options) -> Candidate<'a> {
        Candidate { component: Component { scale, ..Component::new(assembly, options) }, options }
    }

    /// Returns *stable* if the forces `amounts` balance every body. Returns *unstable* if the motion along the
    /// unbalanced load is, for some component, a mechanism that no admissible forces can stop. Returns `None`
    /// otherwise. `residual` is minus the unbalanced load: three rows for each body, in program units.
    pub fn verdict(&self, amounts: &Amounts, residual: &[f64]) -> Option<Verdict> {
        let forces = self.component.prove_without_cleaning(amounts);
        if self.component.accepts(&forces) {
            return Some(Verdict::Stable);
        }
        // The blocks move in the direction of the unbalanced load.
        let motion: Vec<f64> = residual.iter().map(|v| -v).collect();
        let (speed, motions) = self.component.to_motions(&motion);
        if speed == 0.0 {
            return None;
        }
        let assembly = self.component.assembly;
        for assembly in assembly.components() {
            let part = Component { scale: self.component.scale, ..Component::new(&assembly, self.options) };
            let part_motion = assembly.bodies.iter();
            let part_motion: Vec<Motion> = part_motion.map(|b| motion_of_block(&motions, b.block)).collect();
            let proof = part.check_mechanism(&part_motion);
            let moves = matches!(proof, Proof::Mechanism { power, .. } if power > 0.0);
            if moves && part.accepts_motion(&part_motion, &proof) && part.exceeds_force_tolerance(&part_motion, &proof)
            {
                return Some(Verdict::Unstable);
            }
        }
        None
    }
}

/// Returns the motion of a block from `motions`, which are sorted by block. A block that is not in the list is at rest.
fn motion_of_block(motions: &[Motion], block: BlockId) -> Motion {
    match motions.binary_search_by_key(&block, |motion| motion.block) {
        Ok(index) => motions[index],
        Err(_) => Motion { block, velocity: Vector::zeros(), spin: 0.0 },
    }
}
