//! Questions about a component beside what [`solved`](super::solved) finds out.

use super::{Case, Findings};
use crate::analysis::{Options, Verdict};
use crate::assembly::Assembly;
use crate::geometry::cross;
use crate::program::Program;
use crate::proof::Motion;
use crate::solve::{Reach, reach};

/// Whether a component stands, and how it begins to move where it falls: the verdict of [`solved`](super::solved) without
/// the rest.
pub(in crate::analysis) fn judged(assembly: &Assembly) -> (Verdict, Vec<Motion>) {
    let case = Case::of(assembly, Options::default());
    let program = Program::of(assembly, case.scale);
    if let Some(found) = case.in_closed_form(&program) {
        return (found.verdict, found.mechanism);
    }
    // A motion that less limited robots cannot stop is a mechanism all the same.
    if let Some(generous) = program.without_lavish_limits() {
        let decision = case.decided(&generous);
        let allowed = || program.allows(&decision.amounts.grip);
        match decision.verdict {
            Verdict::Unstable => return (Verdict::Unstable, decision.mechanism),
            Verdict::Stable if allowed() => return (Verdict::Stable, Vec::new()),
            _ => {}
        }
    }
    let decision = case.decided(&program);
    (decision.verdict, decision.mechanism)
}

/// Whether some component stands only by wedging; `None` where none surely does and some component's springs do not
/// settle.
///
/// Robots act, they do not yield: what they give is what was found for the verdict, and the contacts follow.
pub(in crate::analysis) fn only_by_wedging<'a>(
    components: impl Iterator<Item = (&'a Assembly, &'a Findings)>,
) -> Option<bool> {
    let mut only = Some(false);
    for (assembly, found) in components {
        let case = Case::of(assembly, Options::default());
        let mut program = Program::of(assembly, case.scale);
        let held = &found.forces.grips;
        for (grip, held) in std::mem::take(&mut program.grips).iter().zip(held) {
            let force = held.force / case.scale.force;
            let moment = cross(grip.arm, force) + held.torque / case.scale.moment();
            let row = 3 * grip.block;
            for (offset, given) in [force.x, force.y, moment].into_iter().enumerate() {
                program.need[row + offset] -= given;
            }
        }
        match reach(&program) {
            Reach::FromRest => {}
            Reach::OnlyWedged => return Some(true),
            Reach::Unclear => only = None,
        }
    }
    only
}
