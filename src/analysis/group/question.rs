//! Questions about a group beside what [`solved`] finds out.

use super::{Case, Findings, solved};
use crate::analysis::{Options, Verdict};
use crate::effect::{Plan, Situation};
use crate::geometry::cross;
use crate::interface::Interface;
use crate::program::{Group, assemble};
use crate::proof::Motion;
use crate::scene::{Frame, Scene};
use crate::solve::{Care, Effort, Reach, balance, leftover, reach};

/// Whether one group stands, and how it begins to move where it falls: the verdict of [`solved`] without the rest.
///
/// What must stick is not sought, unless nothing else decides. A mechanism so weak that forces within their band might
/// balance after all is believed only once the least leftover is known to be more.
pub(in crate::analysis) fn judged(
    scene: &Scene,
    frame: &Frame,
    interfaces: &[&Interface],
    plan: &Plan,
    group: &Group,
    length: f64,
) -> (Verdict, Vec<Motion>) {
    let case = Case::of(
        scene,
        frame,
        interfaces,
        plan,
        group,
        length,
        Options::default(),
    );
    let program = assemble(scene, frame, interfaces, plan, group, case.scale);
    if let Some(found) = case.at_once(&program, plan) {
        return (found.verdict, found.mechanism);
    }
    let generous = program.without_lavish_limits();
    let first = balance(generous.as_ref().unwrap_or(&program), Care::Quick);
    if let Some(amounts) = &first.forces {
        let proof = case.carried(&program, amounts).proof;
        if proof.holds() && program.allows(&amounts.grip) {
            return (Verdict::Stable, Vec::new());
        }
    }
    let mut effort = Effort::default();
    if let Some(y) = first.motion
        && let Some((motion, proof)) = case.falling(&program, &y, &mut effort)
        && case.outweighs_the_band(&motion, &proof)
    {
        return (Verdict::Unstable, motion);
    }
    if let Some(left) = leftover(&program) {
        if case.carried(&program, &left.forces).proof.holds() {
            return (Verdict::Stable, Vec::new());
        }
        if let Some((motion, _)) = case.falling(&program, &left.motion, &mut effort) {
            return (Verdict::Unstable, motion);
        }
    }
    let situation = Situation {
        scene,
        frame,
        interfaces,
    };
    let found = solved(&situation, plan, group, length, Options::default());
    (found.verdict, found.mechanism)
}

/// Whether some group stands only by wedging; `None` where no group surely does and some group's springs do not settle.
///
/// Robots act, they do not yield: what they give is what was found for the verdict, and the contacts follow.
pub(in crate::analysis) fn only_by_wedging<'a>(
    scene: &Scene,
    frame: &Frame,
    interfaces: &[&Interface],
    plan: &Plan,
    groups: impl Iterator<Item = (&'a Group, &'a Findings)>,
    length: f64,
) -> Option<bool> {
    let mut only = Some(false);
    for (group, found) in groups {
        let case = Case::of(
            scene,
            frame,
            interfaces,
            plan,
            group,
            length,
            Options::default(),
        );
        let mut program = assemble(scene, frame, interfaces, plan, group, case.scale);
        for (grip, (force, torque)) in std::mem::take(&mut program.grips).iter().zip(&found.grips) {
            let force = force / case.scale.force;
            let moment = cross(grip.arm, force) + torque / case.scale.moment();
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
