//! [`strands`]: computes the paths of the forces through the blocks of a frame. The width of each strand shows the
//! exact force at its beginning and at its end.
//!
//! In each block a strand joins a point where a force enters to a point where a force leaves. If the true lines of
//! action meet in the block, [`path`] computes the strands. Otherwise every force that enters is
//! divided among the forces that leave, in proportion to their magnitudes. The widths of all strands of a force add
//! up to its magnitude. The axis of a strand stays in its block if possible.

use super::path::{self, LineOfAction, TruePath, curve, moved_inside};
use crate::geometry::{Point, Polygon, Vector, quarter_turn};
use crate::mechanics::analysis::{ActingForce, Contact, Failure, ForceKind, SolvedFrame, by_block};
use crate::mechanics::scene::{AppliedForce, BlockId, BodyId, Scene};
use crate::products::figure::bearing::pressing;

/// If the component of a force along gravity is at most this fraction of the force, the component across gravity
/// decides whether the force enters or leaves the block.
const ALONG_GRAVITY_TOL: f64 = 1e-6;
/// Missing forces below this fraction of the largest missing force have no strands, because the strands of a small
/// missing force would be as visible as those of a large one. Their arrows are enough.
const LEAST_MISSING: f64 = 0.1;
/// Points whose distance is at most this fraction of the block's size coincide.
const SAME_PLACE: f64 = 1e-6;
/// At a foot, at most this fraction of the width of a strand lies outside the joint.
const OUTSIDE_SHARE: f64 = 0.15;
/// Distance from a missing force at which a point is tested to find the side on which the block lies. It is a fraction
/// of the total width of the strands of this force.
const SIDE_SHARE: f64 = 0.5;

/// The kind of force that a strand shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StrandKind {
    /// Force that the block transmits.
    Carried,
    /// The weight of the block, on the path to the forces that carry it.
    Weight,
    /// Force from or to a point where a force is missing.
    Missing,
}

/// A line of force through a block.
#[derive(Clone, Debug)]
pub(crate) struct Strand {
    /// The block through which the strand runs.
    pub on: BlockId,
    pub kind: StrandKind,
    pub from: ForceKind,
    pub to: ForceKind,
    /// The axis of the strand, metres, from the point where the force enters the block to the point where it leaves.
    pub axis: Vec<Point>,
    /// The width of the strand at each point of the axis, N. A point that occurs twice has two widths, before and after
    /// a step.
    pub widths: Vec<f64>,
    /// The forces at the beginning and at the end of the strand, N. They are smaller than the widths if another strand
    /// covers the middle of this one: a weight that acts on the line of action of another force is drawn on both sides
    /// of this force.
    pub amounts: [f64; 2],
    /// True if the strand runs along true lines of action; false if it is schematic.
    pub exact: bool,
}

/// Returns the strands of all blocks of a frame, in placing order. `metres_per_newton` is the scale of the widths. If a
/// force is divided into several strands, their axes are offset so that the strands lie next to each other.
pub(crate) fn strands(solved: SolvedFrame<'_>, metres_per_newton: f64) -> Vec<Strand> {
    let scene = solved.scene;
    let true_places = acting(solved, 0.0);
    let acting = acting(solved, metres_per_newton);
    let mut all = Vec::new();
    for id in &solved.frame().placed {
        let forces = &acting[id.0];
        let distribution = ForceDistribution {
            on: *id,
            polygon: &scene.blocks[id.0].body.polygon,
            down: scene.down(),
            metres_per_newton,
        };
        // A strand that was moved has no true lines of action.
        let is_moved = forces.iter().zip(&true_places[id.0]).any(|(drawn, own)| drawn.at != own.at);
        match true_lines(scene, *id, forces).filter(|_| !is_moved) {
            Some(exact) => all.extend(exact),
            None => all.extend(distribution.strands(forces)),
        }
    }
    all
}

/// Returns the forces on each block, indexed by block: weight, loads, forces of contacts and robots, and missing
/// forces. The force of a joint acts where its strand has space in the joint.
fn acting(solved: SolvedFrame<'_>, metres_per_newton: f64) -> Vec<Vec<ActingForce>> {
    let SolvedFrame { scene, found, .. } = solved;
    let frame = solved.frame();
    let at = |contact: &Contact| within_joint(contact, metres_per_newton * contact.amount());
    let mut forces = pressing(solved, at);
    let missing: Vec<ActingForce> = found.failures.iter().flat_map(Failure::acting).collect();
    let largest = missing.iter().map(|acting| acting.force.norm()).fold(0.0, f64::max);
    forces.extend(missing.iter().filter(|acting| acting.force.norm() >= LEAST_MISSING * largest));
    let applied = scene.applied_forces();
    let mut given: Vec<ActingForce> =
        frame.placed.iter().flat_map(|id| &applied[id.0]).map(AppliedForce::acting).collect();
    given.sort_by_key(|acting| acting.kind == ForceKind::Weight);
    forces.extend(given);
    forces.retain(|acting| acting.force.norm() > 0.0);
    by_block(forces, scene.blocks.len())
}

/// Returns the point of a joint at which a strand of the given width, metres, ends. This is the point of the resultant.
/// At the ground, if a large part of the strand would lie outside the joint, the point moves inward until the strand
/// lies inside.
fn within_joint(contact: &Contact, width: f64) -> Point {
    let (interface, at) = (&contact.interface, contact.resultant.at);
    let (middle, tangent) = (interface.middle(), interface.tangent());
    let along = (at - middle).dot(&tangent);
    let room = 0.5 * interface.length() - 0.5 * width;
    let is_foot = matches!(interface.bodies[1], BodyId::Ground(_));
    let is_outside = along.abs() > room + OUTSIDE_SHARE * width && room > 0.0;
    if is_foot && is_outside { middle + tangent * along.clamp(-room, room) } else { at }
}

/// Returns the strands of a block along true lines of action. Apart from its weight and its loads, exactly two forces
/// must act on the block, both from contacts or robots, and no load may have a torque. Otherwise, or if no path along
/// true lines exists, returns `None`.
fn true_lines(scene: &Scene, on: BlockId, forces: &[ActingForce]) -> Option<Vec<Strand>> {
    let presses = |f: &&ActingForce| matches!(f.kind, ForceKind::Contact(_) | ForceKind::Robot(_));
    let given = |f: &&ActingForce| f.kind.is_applied();
    let turned = |load: &crate::mechanics::scene::Load| load.block == on && load.torque != 0.0;
    let pressing: Vec<&ActingForce> = forces.iter().filter(presses).collect();
    let [one, other] = pressing[..] else {
        return None;
    };
    // The path begins at the joint whose force has the larger downward component.
    let along = |f: &ActingForce| f.force.dot(&scene.down());
    let (first, second) = if along(one) < along(other) { (other, one) } else { (one, other) };
    let loads: Vec<LineOfAction> = forces.iter().filter(given).map(line_of_action).collect();
    if loads.len() + 2 != forces.len() || scene.loads.iter().any(turned) {
        return None;
    }
    let polygon = &scene.blocks[on.0].body.polygon;
    let path = path::path(polygon, line_of_action(first), line_of_action(second), &loads)?;
    let given: Vec<&ActingForce> = forces.iter().filter(given).collect();
    let ends = [first.kind, second.kind];
    let same_place = SAME_PLACE * polygon.area().sqrt();
    Some(exact_strands(on, ends, path, &given, same_place))
}

/// Returns the strands along a true path from one joint to another: one strand for the path, and one for each load that
/// joins it. `loads` are the forces to which the indices in the path refer. Points whose distance is at most
/// `same_place` metres coincide.
///
/// A weight that acts on the path itself needs no strand that leads to the path. From its point of action on, it is
/// drawn on both sides of the path, so that a reader can distinguish it from the force that the block transmits.
fn exact_strands(
    on: BlockId,
    [from, to]: [ForceKind; 2],
    path: TruePath,
    loads: &[&ActingForce],
    same_place: f64,
) -> Vec<Strand> {
    let strand = |kind: ForceKind, corners: &[Point], amounts: &[f64]| Strand {
        on,
        kind: if kind == ForceKind::Weight { StrandKind::Weight } else { StrandKind::Carried },
        from: kind,
        to,
        axis: corners.windows(2).flatten().copied().collect(),
        widths: amounts.iter().flat_map(|w| [*w; 2]).collect(),
        amounts: [amounts[0], amounts[amounts.len() - 1]],
        exact: true,
    };
    let mut strands = Vec::new();
    let mut core = path.amounts.clone();
    for (number, (load, corner)) in path.joins.iter().enumerate() {
        let load = loads[*load];
        let amount = load.force.norm();
        let on_path = (load.at - corner).norm() <= same_place;
        let joining = if on_path && load.kind == ForceKind::Weight {
            let behind = number + 1;
            core[behind..].iter_mut().for_each(|w| *w = (*w - amount).max(0.0));
            Strand {
                amounts: [amount; 2],
                ..strand(ForceKind::Weight, &path.corners[behind..], &path.amounts[behind..])
            }
        } else {
            strand(load.kind, &[load.at, *corner], &[amount])
        };
        strands.push(joining);
    }
    strands.push(strand(from, &path.corners, &core));
    strands
}

fn line_of_action(acting: &ActingForce) -> LineOfAction {
    LineOfAction { at: acting.at, force: acting.force }
}

/// Divides the forces that enter a block among the forces that leave it.
struct ForceDistribution<'a> {
    on: BlockId,
    polygon: &'a Polygon,
    /// The direction of gravity.
    down: Vector,
    metres_per_newton: f64,
}

impl ForceDistribution<'_> {
    /// True if a force enters the block, so that a strand begins there. A force enters if its component along gravity
    /// is positive, and leaves the block otherwise. For a force perpendicular to gravity, the sign of its component
    /// across gravity decides.
    fn enters(&self, acting: &ActingForce) -> bool {
        let along = acting.force.dot(&self.down);
        if along.abs() > ALONG_GRAVITY_TOL * acting.force.norm() {
            return along > 0.0;
        }
        acting.force.dot(&quarter_turn(self.down)) > 0.0
    }

    /// Returns one strand for each pair of a force that enters the block and a force that leaves it.
    fn strands(&self, forces: &[ActingForce]) -> Vec<Strand> {
        let (ins, outs): (Vec<&ActingForce>, Vec<&ActingForce>) = forces.iter().partition(|f| self.enters(f));
        let sum = |side: &[&ActingForce]| side.iter().map(|f| f.force.norm()).sum::<f64>();
        let (entering, leaving) = (sum(&ins), sum(&outs));
        if ins.is_empty() || outs.is_empty() {
            return Vec::new();
        }
        let mut strands = Vec::new();
        for from in &ins {
            for to in &outs {
                let (start, end) = (from.force.norm(), to.force.norm());
                let widths = [start * end / leaving, end * start / entering];
                // A strand begins in the direction of the force that enters. It ends in the direction opposite to the
                // force that leaves.
                let first = self.end(from, from.force, &outs, to, leaving);
                let last = self.end(to, -to.force, &ins, from, entering);
                strands.push(self.strand(from, to, [first, last], widths));
            }
        }
        strands
    }

    /// Returns the position and the direction of one end of a strand, where the force `acting` acts. The strand has the
    /// direction of `force`: this is `acting.force` at the beginning of a strand, and its opposite at the end.
    /// `partner` is the force at the other end of the strand. The strands to all `partners` lie side by side, in the
    /// order of their positions across `force`; those of a missing force lie on one side of the point. `sum` is the sum
    /// of the magnitudes of all `partners`, N.
    fn end(
        &self,
        acting: &ActingForce,
        force: Vector,
        partners: &[&ActingForce],
        partner: &ActingForce,
        sum: f64,
    ) -> (Point, Vector) {
        let at = acting.at;
        let (along, width) = (force / force.norm(), force.norm());
        let aside = quarter_turn(along);
        let place = |p: &ActingForce| (p.at - at).dot(&aside);
        let share = |p: &ActingForce| p.force.norm() / sum;
        let own = place(partner);
        let mut before = 0.0;
        for other in partners {
            let earlier = place(other) < own;
            let alike = place(other) == own && core::ptr::from_ref(*other) < core::ptr::from_ref(partner);
            if earlier || alike {
                before += share(other);
            }
        }
        let is_missing = acting.kind.is_failure();
        let side = if is_missing { self.side(at, aside * (width * self.metres_per_newton)) } else { 0.0 };
        let middle = width * (before + 0.5 * share(partner) - 0.5 + 0.5 * side);
        (at + aside * (middle * self.metres_per_newton), along)
    }

    /// Returns the side of the point `at` on which the strands of a missing force lie, so that they do not cover the
    /// other body. The function tests one point on each side of `at`, along `across`. The result is 1 if only the point
    /// in the direction of `across` is in the block, -1 if only the opposite point is, and 0 otherwise.
    fn side(&self, at: Point, across: Vector) -> f64 {
        let inside = |sign: f64| self.polygon.contains(at + across * (sign * SIDE_SHARE));
        match (inside(1.0), inside(-1.0)) {
            (true, false) => 1.0,
            (false, true) => -1.0,
            _ => 0.0,
        }
    }

    fn strand(&self, from: &ActingForce, to: &ActingForce, ends: [(Point, Vector); 2], widths: [f64; 2]) -> Strand {
        let kind = match from.kind {
            _ if from.kind.is_failure() || to.kind.is_failure() => StrandKind::Missing,
            ForceKind::Weight => StrandKind::Weight,
            _ => StrandKind::Carried,
        };
        let mut axis = curve(self.polygon, ends);
        let last = (axis.len() - 1) as f64;
        let width = |i: usize| widths[0] + (widths[1] - widths[0]) * i as f64 / last;
        let steps: Vec<f64> = (0..axis.len()).map(width).collect();
        if kind == StrandKind::Missing {
            let metres: Vec<f64> = steps.iter().map(|w| w * self.metres_per_newton).collect();
            moved_inside(self.polygon, &mut axis, &metres);
        }
        Strand { on: self.on, kind, from: from.kind, to: to.kind, widths: steps, axis, amounts: widths, exact: false }
    }
}
