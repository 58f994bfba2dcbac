//! Proves results of linear programs: that their forces balance a component, or that it falls by their motion.

use super::Component;
use super::verdict_only::{VERDICT_ONLY, decide_without_non_binding_limits};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::Program;
use crate::mechanics::proof::{Forces, Motion, Proof};
use crate::mechanics::solve::{Amounts, Effort};
use crate::mechanics::statics::assembly::Assembly;

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
    let found = component.prove_forces(amounts);
    component.accepts(&found.proof).then_some((found.forces, found.proof))
}

/// Decides a component, and returns forces in newtons that balance it, with their proof. `None` if the component falls
/// or is undecided.
pub(in crate::mechanics::analysis) fn decided_forces(assembly: &Assembly) -> Option<(Forces, Proof)> {
    let component = Component::new(assembly, VERDICT_ONLY);
    let program = Program::new(assembly, component.scale);
    let decision = decide_without_non_binding_limits(&component, &program);
    if decision.verdict != Verdict::Stable {
        return None;
    }
    let found = component.prove_forces(&decision.amounts);
    component.accepts(&found.proof).then_some((found.forces, found.proof))
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
