//! [`segments`]: computes the line of thrust as straight segments, block by block.
//!
//! Where possible, a segment lies on the true line of action of a force. In a block between two bodies the line of
//! thrust is a funicular polygon. Its construction, in [`BlockForces::funicular`]:
//!
//! 1. It starts at the first joint, along the line of action of that joint's force.
//! 2. Where it meets the line of action of a load or of the weight, it continues along the resultant of both forces.
//! 3. Step 2 is repeated for every load. The polygon must end at the second joint, along the line of action of that
//!    joint's force.
//!
//! The polygon is only drawn if all its vertices and segments lie in or near the block. The order of the loads is not
//! known, so all orders are tried, and finally the resultant of all loads. There is no such polygon if more than two
//! bodies press on the block, if forces are parallel on different lines, or if the forces do not balance. The path is
//! then schematic: a straight line between the two joints, or a straight line from every joint and load to a common
//! point. The line of thrust therefore has no gaps.

use super::bearing::pressing;
use crate::geometry::{Point, Polygon, Vector, cross, quarter_turn};
use crate::mechanics::analysis::{ActingForce, ForceKind, SolvedFrame, Verdict, by_block};
use crate::mechanics::scene::{AppliedForce, Block, BlockId};

/// A line passes through a point if their distance is below this fraction of the block's size. Forces have a relative
/// accuracy of about 1e-9, so rounding errors are far smaller.
const LENGTH_TOL: f64 = 1e-6;
/// Forces on a block are in equilibrium if their resultant is at most this fraction of the sum of their magnitudes.
const BALANCE_TOL: f64 = 1e-6;
/// A line of action may run outside the block by this fraction of the mean thickness of the block, and still counts as
/// inside.
const NEARLY_INSIDE: f64 = 0.06;
/// Up to this number of loads on a block, every order of the loads and the weight is tried: at most 4! orders. If the
/// block has more loads, only their sum is used.
const MAX_ORDERED_LOADS: usize = 3;
/// A schematic path between two forces is a single straight line if the larger force is at most this multiple of the
/// smaller force.
const SIMILAR_RATIO: f64 = 4.0;

/// A straight segment of the line of thrust.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ThrustSegment {
    /// The block through which the segment runs.
    pub on: BlockId,
    /// The kind of the force. The resultant of a joint's force and the loads that the line has met so far counts as
    /// [`ForceKind::Weight`].
    pub kind: ForceKind,
    /// The point at which the segment begins, metres.
    pub from: Point,
    /// The point at which the segment ends, metres.
    pub to: Point,
    /// The force that the segment shows, N. It acts along the segment unless the segment is schematic.
    pub force: Vector,
    /// True if the segment lies on a line of action; false if it is schematic.
    pub through: bool,
    /// True if the segment leaves its block.
    pub leaves: bool,
}

/// Returns the segments of the line of thrust of a frame, block by block in placing order. In a frame that falls, the
/// line may leave the blocks.
pub(crate) fn segments(solved: SolvedFrame<'_>) -> Vec<ThrustSegment> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let may_leave = frame_analysis.verdict == Verdict::Unstable;
    let pressing = by_block(pressing(solved, |contact| contact.resultant.at), scene.blocks.len());
    let applied = scene.applied_forces();
    let mut segments = Vec::new();
    for id in &solved.frame().placed {
        let forces = BlockForces {
            id: *id,
            block: &scene.blocks[id.0],
            pressing: pressing[id.0].iter().map(line_of_action).collect(),
            loads: loads(&applied[id.0]),
            may_leave,
        };
        match forces.path() {
            Some(path) => segments.extend(path),
            None => segments.extend(forces.schematic()),
        }
    }
    segments
}

/// A force with its line of action.
#[derive(Clone, Copy, Debug)]
struct LineOfAction {
    kind: ForceKind,
    /// A point on the line, metres.
    at: Point,
    /// The point where the force acts on the block, metres. A torque shifts the line away from this point.
    entry: Point,
    force: Vector,
}

/// Returns the line of action of a force with its torque.
fn line_of_action(acting: &ActingForce) -> LineOfAction {
    let ActingForce { kind, at: entry, force, torque, .. } = *acting;
    LineOfAction { kind, at: shifted_by_torque(entry, force, torque), entry, force }
}

/// Returns the lines of action of the weight and the loads of a block. A load that is only a torque shifts the line of
/// action of the weight.
fn loads(applied: &[AppliedForce]) -> Vec<LineOfAction> {
    let (forces, torques): (Vec<ActingForce>, Vec<ActingForce>) =
        applied.iter().map(AppliedForce::acting).partition(|acting| acting.force.norm() > 0.0);
    let turned = |acting: ActingForce| match acting.kind {
        ForceKind::Weight => ActingForce { torque: torques.iter().map(|acting| acting.torque).sum(), ..acting },
        _ => acting,
    };
    forces.into_iter().map(|acting| line_of_action(&turned(acting))).collect()
}

/// Returns a point on the line of action of a force at `at` combined with a torque. The combination acts along a line
/// that is shifted perpendicular to the force by torque / force.
fn shifted_by_torque(at: Point, force: Vector, torque: f64) -> Point {
    let squared = force.norm_squared();
    if torque == 0.0 || squared <= 0.0 {
        return at;
    }
    at + quarter_turn(force) * (-torque / squared)
}

/// One block and the forces on it.
struct BlockForces<'a> {
    id: BlockId,
    block: &'a Block,
    /// The forces of other bodies and robots.
    pressing: Vec<LineOfAction>,
    /// The weight and the loads.
    loads: Vec<LineOfAction>,
    /// Whether the line may run outside the block, by up to the size of the block.
    may_leave: bool,
}

impl BlockForces<'_> {
    fn polygon(&self) -> &Polygon {
        &self.block.body.polygon
    }

    fn size(&self) -> f64 {
        self.polygon().bounds().diagonal()
    }

    /// Returns the funicular polygon of a block on which one or two forces of other bodies or robots act. Returns
    /// `None` for any other number of such forces, if the forces do not balance, or if no funicular polygon lies in or
    /// near the block.
    fn path(&self) -> Option<Vec<ThrustSegment>> {
        let (first, last) = match &self.pressing[..] {
            [one] => (one, None),
            [one, other] => (one, Some(other)),
            _ => return None,
        };
        if !self.balances() {
            return None;
        }
        let orders = if self.loads.len() <= MAX_ORDERED_LOADS + 1 { permutations(&self.loads) } else { Vec::new() };
        let together = self.total_load().map(|sum| vec![sum]);
        orders.into_iter().chain(together).find_map(|loads| self.funicular(first, &loads, last))
    }

    /// True if the forces on the block are in equilibrium. In a structure that falls, the forces may be out of balance.
    fn balances(&self) -> bool {
        let (mut sum, mut moment, mut all) = (Vector::zeros(), 0.0, 0.0);
        for line in self.pressing.iter().chain(&self.loads) {
            sum += line.force;
            moment += cross(line.at - self.block.centroid, line.force);
            all += line.force.norm();
        }
        sum.norm() <= BALANCE_TOL * all && moment.abs() <= BALANCE_TOL * all * self.size()
    }

    /// Returns the resultant of the weight and all loads of the block. Returns `None` if only one of these forces acts,
    /// or if their sum is zero.
    fn total_load(&self) -> Option<LineOfAction> {
        let centroid = self.block.centroid;
        let force: Vector = self.loads.iter().map(|l| l.force).sum();
        let moments = self.loads.iter().map(|l| cross(l.at - centroid, l.force));
        let line = LineOfAction {
            kind: ForceKind::Weight,
            at: shifted_by_torque(centroid, force, moments.sum()),
            entry: centroid,
            force,
        };
        (self.loads.len() > 1 && force.norm() > 0.0).then_some(line)
    }

    /// Returns the funicular polygon from the joint `first` to the joint `last`, or to the last load if `last` is
    /// `None`. The polygon meets the lines of action of `loads` in their order. Returns `None` if the polygon misses
    /// `last`, leaves the block or turns back.
    fn funicular(
        &self,
        first: &LineOfAction,
        loads: &[LineOfAction],
        last: Option<&LineOfAction>,
    ) -> Option<Vec<ThrustSegment>> {
        let tolerance = LENGTH_TOL * self.size();
        let sum: f64 = self.pressing.iter().map(|l| l.force.norm()).sum();
        let (mut at, mut force, mut kind) = (first.at, first.force, first.kind);
        let mut path = Vec::new();
        for (number, load) in loads.iter().enumerate() {
            let vertex = intersection(at, force, load, tolerance)?;
            let ends_here = last.is_none() && number + 1 == loads.len();
            if ends_here && load.kind == ForceKind::Load {
                // The block has no second joint, so the line of thrust ends at the point where the last load acts.
                path.extend(self.segment(load.kind, (load.at, at), load.force));
                continue;
            }
            path.extend(self.segment(kind, (at, vertex), force));
            if load.kind == ForceKind::Load {
                path.extend(self.segment(load.kind, (load.at, vertex), load.force));
            }
            at = vertex;
            force += load.force;
            // After the last load, the force in the line is the force of the second joint.
            kind = match last {
                Some(last) if number + 1 == loads.len() => last.kind,
                _ => ForceKind::Weight,
            };
            // A resultant of zero has no line of action.
            if !ends_here && force.norm() <= BALANCE_TOL * sum {
                return None;
            }
        }
        if let Some(last) = last {
            let miss = cross(last.at - at, force).abs() / force.norm().max(f64::MIN_POSITIVE);
            // Allow ten times the tolerance, because each intersection adds a rounding error.
            if miss > 10.0 * tolerance {
                return None;
            }
            let force = if loads.is_empty() { force } else { last.force };
            path.extend(self.segment(kind, (at, last.at), force));
        }
        let inside = path.iter().all(|s| !s.leaves || self.may_leave && self.nearby(s.from) && self.nearby(s.to));
        (inside && runs_onward(&path, tolerance)).then_some(path)
    }

    /// Creates a segment on a true line of action; `None` if the two points coincide.
    fn segment(&self, kind: ForceKind, (from, to): (Point, Point), force: Vector) -> Option<ThrustSegment> {
        let leaves = !self.within(from, to);
        let segment = ThrustSegment { on: self.id, kind, from, to, force, through: true, leaves };
        ((to - from).norm() > LENGTH_TOL * self.size()).then_some(segment)
    }

    /// True if a point is at most as far from the block as the block is large.
    fn nearby(&self, point: Point) -> bool {
        self.polygon().distance(point) <= self.size()
    }

    /// True if the segment between two points lies in or near the block. Nine points on the segment are tested.
    fn within(&self, from: Point, to: Point) -> bool {
        let near = NEARLY_INSIDE * self.polygon().area() / self.size();
        (0..=8).all(|i| {
            let p = from + (to - from) * (f64::from(i) / 8.0);
            self.polygon().distance(p) <= near
        })
    }

    /// Returns a schematic path for a block without a funicular polygon. If two forces of similar size act on the
    /// block besides its weight, the path is the straight line between them, as wide as the larger force. Otherwise a
    /// straight line leads from each force to a common point. The weight is not shown.
    fn schematic(&self) -> Vec<ThrustSegment> {
        let all = self.pressing.iter().chain(&self.loads);
        let given = all.filter(|l| l.kind != ForceKind::Weight && l.force.norm() > 0.0);
        let given: Vec<&LineOfAction> = given.collect();
        let piece = |line: &LineOfAction, to: Point| {
            let segment = self.segment(line.kind, (line.entry, to), line.force)?;
            Some(ThrustSegment { through: false, leaves: segment.leaves && self.may_leave, ..segment })
        };
        if let [one, other] = given[..] {
            let [strong, weak] = if one.force.norm() < other.force.norm() { [other, one] } else { [one, other] };
            if strong.force.norm() <= SIMILAR_RATIO * weak.force.norm() {
                return piece(strong, weak.entry).into_iter().collect();
            }
        }
        let meeting = self.meeting(&given);
        given.iter().filter_map(|line| piece(line, meeting)).collect()
    }

    /// Returns the common point of a schematic path: the mean of the points at which the forces act, weighted with the
    /// magnitudes of the forces. If this mean lies outside the block, or for fewer than three forces, returns the
    /// centroid of the block.
    fn meeting(&self, given: &[&LineOfAction]) -> Point {
        let sum: f64 = given.iter().map(|line| line.force.norm()).sum();
        let centroid = self.block.centroid;
        let arms = given.iter().map(|line| (line.entry - centroid) * line.force.norm());
        let mean = centroid + arms.sum::<Vector>() / sum.max(f64::MIN_POSITIVE);
        if given.len() > 2 && self.polygon().contains(mean) { mean } else { centroid }
    }
}

/// True if no segment of the path points backwards, compared with the straight line from the beginning to the end of
/// the path. A path that turns back would cover itself. Segments of loads are side branches and are not tested.
fn runs_onward(path: &[ThrustSegment], tolerance: f64) -> bool {
    let main = || path.iter().filter(|s| s.kind != ForceKind::Load);
    let (Some(first), Some(last)) = (main().next(), main().next_back()) else {
        return true;
    };
    let chord = last.to - first.from;
    main().all(|s| (s.to - s.from).dot(&chord) >= -tolerance * chord.norm())
}

/// Returns the intersection of the line of action of `force` through `at` and the line of action of a load. If the two
/// lines coincide within `near` metres, returns the point on the line that is nearest to the point `load.at`. Returns
/// `None` for other parallel lines.
fn intersection(at: Point, force: Vector, load: &LineOfAction, near: f64) -> Option<Point> {
    let (a, b) = (force.normalize(), load.force.normalize());
    let sine = cross(a, b);
    let between = load.at - at;
    // Treat nearly parallel lines as parallel: rounding errors would determine the position of their intersection.
    if sine.abs() < LENGTH_TOL {
        let off = cross(between, a).abs();
        return (off <= near).then(|| at + a * between.dot(&a));
    }
    let corner = at + a * (cross(between, b) / sine);
    corner.coords.iter().all(|c| c.is_finite()).then_some(corner)
}

/// Returns all permutations of a few loads. The first permutation has the order of `loads`.
fn permutations(loads: &[LineOfAction]) -> Vec<Vec<LineOfAction>> {
    let Some((first, rest)) = loads.split_first() else {
        return vec![Vec::new()];
    };
    let mut all = Vec::new();
    for order in permutations(rest) {
        for place in 0..=order.len() {
            let mut longer = order.clone();
            longer.insert(place, *first);
            all.push(longer);
        }
    }
    all
}

#[cfg(test)]
mod tests;
