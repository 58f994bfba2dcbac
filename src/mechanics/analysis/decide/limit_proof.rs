//! Proves the results of a linear program at the limit of stability.

use super::Component;
use super::verdict_only::{VERDICT_ONLY, decide_without_idle_limits};
use crate::analysis::Verdict;
use crate::assembly::Assembly;
use crate::program::Program;
use crate::proof::{Forces, Motion, Proof};
use crate::solve::{Amounts, Effort};

/// Returns forces in newtons that balance a component, with their proof. `None` if the forces do not balance it.
///
/// `program` is the program of the component, in any scale.
pub(in crate::mechanics::analysis) fn proved_forces(
    assembly: &Assembly,
    program: &Program,
    amounts: &Amounts,
) -> Option<(Forces, Proof)> {
    let component = in_scale_of(assembly, program);
    let found = component.prove_forces(amounts);
    component
        .believes(&found.proof)
        .then_some((found.forces, found.proof))
}

/// Decides a component as a whole. Returns the forces that balance it, with their proof; `None` if it was not shown to
/// stand.
pub(in crate::mechanics::analysis) fn decided_forces(
    assembly: &Assembly,
) -> Option<(Forces, Proof)> {
    let component = Component::new(assembly, VERDICT_ONLY);
    let program = Program::new(assembly, component.scale);
    let decision = decide_without_idle_limits(&component, &program);
    if decision.verdict != Verdict::Stable {
        return None;
    }
    let found = component.prove_forces(&decision.amounts);
    component
        .believes(&found.proof)
        .then_some((found.forces, found.proof))
}

/// Returns the motion that is nearest to the velocities `y` of a program and that no contact opposes, one entry for
/// each body. Also returns the proof that the component falls by this motion. `None` if the proof is too weak.
pub(in crate::mechanics::analysis) fn proved_motion(
    assembly: &Assembly,
    program: &Program,
    y: &[f64],
) -> Option<(Vec<Motion>, Proof)> {
    in_scale_of(assembly, program).prove_motion(program, y, &mut Effort::default())
}

fn in_scale_of<'a>(assembly: &'a Assembly, program: &Program) -> Component<'a> {
    Component {
        scale: program.scale,
        ..Component::new(assembly, VERDICT_ONLY)
    }
}
