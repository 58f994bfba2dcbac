//! Motions for the proof that a frame falls: contacts open a little more than in the motion of the analysis, or stay closed
//! exactly.

use super::check::LARGEST_STEP;
use super::stand::MAX_AT_ONCE;
use super::{FrameForm, MotionForm, Step};
use crate::geometry::{Point, Vector};
use crate::mechanics::program::{Column, Force, Program, Scale, columns};
use crate::mechanics::proof::{Motion, net_power};
use crate::mechanics::solve::{Conditioning, Effort, Status, least_cost};
use crate::mechanics::statics::assembly::Assembly;

/// A force up to this share of the heaviest load counts as 0 if bodies are corrected at once; a velocity up to this share
/// of the largest one likewise.
pub(super) const NEGLIGIBLE: f64 = 1e-7;

/// Returns the motion of each body; zero for bodies without an entry, which are at rest.
pub(super) fn motion_of_all(assembly: &Assembly, mechanism: &[Motion]) -> Vec<Motion> {
    let listed = assembly.bodies.iter().map(|body| {
        let moving = mechanism.iter().find(|motion| motion.block == body.block);
        moving.copied().unwrap_or(Motion { block: body.block, velocity: Vector::zeros(), spin: 0.0 })
    });
    listed.collect()
}

/// Returns a motion in which every contact opens a little more than in the motion of the analysis, so that rounding does
/// not close it. No contact closes, and the sum of all openings is the largest if each counts up to 1. `None` if the
/// program has no result.
pub(super) fn opening_motion(assembly: &Assembly, mechanism: &[Motion]) -> Option<Vec<Motion>> {
    let mut motions = motion_of_all(assembly, mechanism);
    for component in assembly.components() {
        let own: Vec<usize> = component
            .bodies
            .iter()
            .filter_map(|body| assembly.bodies.iter().position(|other| other.block == body.block))
            .collect();
        if own.iter().all(|body| motions[*body].velocity == Vector::zeros() && motions[*body].spin == 0.0) {
            continue;
        }
        let program = Program::new(&component, Scale::from_assembly(&component));
        // Each contact force may be arbitrarily large without a cost, and up to 1 with a gain. In the kinematic dual, no
        // contact closes, and an opening counts up to 1.
        let mut columns = columns(&program);
        let rays = columns.iter().filter(|column| matches!(column.force, Force::Ray { .. }));
        let rays: Vec<Column> = rays.copied().collect();
        let rays = rays.into_iter().map(|mut ray| {
            ray.limit = 1.0;
            ray
        });
        columns.extend(rays);
        let cost = |column: &Column| {
            let is_gain = matches!(column.force, Force::Ray { .. }) && column.limit.is_finite();
            if is_gain { -1.0 } else { 0.0 }
        };
        let none = vec![0.0; program.loads.len()];
        let solved = least_cost(&none, &columns, Conditioning::Full, &mut Effort::default(), cost);
        if solved.status != Status::Solved {
            return None;
        }
        // Scale the motion of the analysis up until its sum with the opening motion does work.
        let listed: Vec<Motion> = own.iter().map(|body| motions[*body]).collect();
        let opening = component.bodies.iter().zip(solved.y.chunks_exact(3)).map(|(body, y)| Motion {
            block: body.block,
            velocity: -Vector::new(y[0], y[1]),
            spin: -y[2] / program.scale.length,
        });
        let opening: Vec<Motion> = opening.collect();
        let (gain, loss) = (net_power(&component, &listed), net_power(&component, &opening));
        let factor = if gain > 0.0 { (2.0 * loss.abs() / gain).max(1.0) } else { 1.0 };
        for (k, body) in own.iter().enumerate() {
            motions[*body].velocity = listed[k].velocity * factor + opening[k].velocity;
            motions[*body].spin = listed[k].spin * factor + opening[k].spin;
        }
    }
    Some(motions)
}

/// Adds a motion. The motion of a held body is given at its grip point, which stands still exactly if the robot has no
/// limit. With `still`, velocities that are nearly 0 become 0, and contacts that nearly stay closed stay so exactly.
pub(super) fn with_motion(bare: &FrameForm, assembly: &Assembly, motions: &[Motion], still: bool) -> FrameForm {
    let speed = |motion: &Motion| motion.velocity.norm().max(motion.spin.abs() * assembly.length);
    let negligible = NEGLIGIBLE * motions.iter().map(speed).fold(0.0, f64::max);
    let rests = |motion: &Motion| still && speed(motion) <= negligible;
    let motions: Vec<Motion> = motions
        .iter()
        .map(|motion| if rests(motion) { Motion { velocity: Vector::zeros(), spin: 0.0, ..*motion } } else { *motion })
        .collect();
    let steps = if still { still_steps(bare, assembly, &motions, negligible) } else { Vec::new() };
    let forms = assembly.bodies.iter().zip(&motions).enumerate().map(|(number, (body, motion))| {
        let grip = assembly.grips.iter().position(|grip| grip.body == number);
        let form = grip.map(|grip| &bare.grips[grip]);
        let grip = grip.map(|grip| &assembly.grips[grip]);
        let at = grip.map_or(body.centroid, |grip| grip.at);
        let mut velocity = motion.about(body.centroid, at);
        let mut spin = motion.spin;
        if let Some(grip) = grip {
            velocity.x = if grip.limits.fx.is_finite() { velocity.x } else { 0.0 };
            velocity.y = if grip.limits.fy.is_finite() { velocity.y } else { 0.0 };
            spin = if grip.limits.torque.is_finite() { spin } else { 0.0 };
        }
        let at = form.map_or(Some([at.x, at.y]), |form| form.at);
        MotionForm { body: bare.placed[number], at, velocity: [velocity.x, velocity.y], spin }
    });
    let moving = forms.filter(|motion| motion.velocity != [0.0; 2] || motion.spin != 0.0);
    FrameForm { motion: Some(moving.collect()), still: steps, ..bare.clone() }
}

/// Returns, for each group of moving bodies, the components that have no power along the motion and shall have none at all.
fn still_steps(bare: &FrameForm, assembly: &Assembly, motions: &[Motion], negligible: f64) -> Vec<Step> {
    let moves = |body: usize| motions[body].velocity != Vector::zeros() || motions[body].spin != 0.0;
    let velocity = |body: usize, at: Point| motions[body].about(assembly.bodies[body].centroid, at);
    // The bodies that each component joins.
    let mut closed: Vec<(usize, Vec<usize>)> = Vec::new();
    for (k, contact) in assembly.contacts.iter().enumerate() {
        let bodies: Vec<usize> = std::iter::once(contact.on).chain(contact.from).filter(|body| moves(*body)).collect();
        let mut slides = true;
        for (i, at) in contact.points.iter().enumerate().take(bare.contacts[k].points.len()) {
            let from = contact.from.map_or(Vector::zeros(), |from| velocity(from, *at));
            let relative = velocity(contact.on, *at) - from;
            let sliding = relative.dot(&contact.tangent()).abs();
            let opening = relative.dot(&contact.normal);
            if opening <= negligible {
                closed.push((3 * k + i, bodies.clone()));
            }
            if opening - contact.friction * sliding <= negligible {
                slides &= sliding > negligible || contact.friction == 0.0;
            }
        }
        if !slides {
            closed.push((3 * k + 2, bodies));
        }
    }
    for (k, grip) in assembly.grips.iter().enumerate() {
        let limits = [grip.limits.fx, grip.limits.fy, grip.limits.torque];
        let held = (0..3).filter(|i| limits[*i].is_infinite() && moves(grip.body));
        closed.extend(held.map(|i| (3 * (assembly.contacts.len() + k) + i, vec![grip.body])));
    }
    closed.retain(|(_, bodies)| !bodies.is_empty());
    let mut steps: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
    for (component, bodies) in closed {
        // Join the groups that share a body with this component.
        let (joined, rest): (Vec<_>, Vec<_>) =
            steps.into_iter().partition(|(group, _)| group.iter().any(|body| bodies.contains(body)));
        let mut group: Vec<usize> = joined.iter().flat_map(|(group, _)| group.clone()).chain(bodies).collect();
        group.sort_unstable();
        group.dedup();
        let components = joined.into_iter().flat_map(|(_, components)| components).chain([component]).collect();
        steps = rest;
        steps.push((group, components));
    }
    steps.retain(|(group, components)| group.len() <= MAX_AT_ONCE && components.len() <= LARGEST_STEP);
    for body in steps.iter_mut().flat_map(|(group, _)| group) {
        *body = bare.placed[*body];
    }
    steps
}
