//! Computes which additional forces a block can carry for all values of uncertain quantities: tilt, horizontal load,
//! friction. The result is the intersection of the sets for a few extreme values.
//!
//! If the loads are linear in a parameter, the values at which the frame stands under a fixed force form an interval. A
//! force that is carried at both ends of a range is therefore carried at every value between them:
//!
//! - *Horizontal load*: the loads are linear in it, so the two ends of the range are enough.
//! - *Friction*: more friction only adds admissible forces, so the lowest value is enough.
//! - *Tilt*: the loads rotate, so they are not linear in the angle and the ends alone are not enough. The tip of the
//!   gravity vector moves on an arc. The arc is divided into pieces of at most 1°, and the tangents at the ends of each
//!   piece meet at a corner outside the arc. In this corner gravity has the direction of the middle of the piece, and
//!   its strength is multiplied by 1/cos(half the piece). The two ends of the range and these corners enclose the arc,
//!   so they are enough. Gravity at a corner is too strong by at most 4·10⁻⁵, so the result is on the safe side.
//! - *Several ranges*: the loads are linear in gravity at a fixed horizontal fraction, and linear in the fraction at
//!   fixed gravity. All combinations of the extreme values of both therefore enclose every case.
//!
//! Ranges of tilt wider than 90° are refused. A range cannot be given for a quantity in which the loads or the contacts
//! are not linear, such as the position of a corner.

use super::cone::SAME_DIRECTION;
use super::refine;
use super::region::{RAY_LENGTH_PER_SIZE, axes, corners, half_planes, set_edges, square};
use super::{CapacityEdge, CapacityError, CapacityShape, CapacityVertex, Cases, LoadCapacity, decided};
use crate::geometry::{Vector, cross, in_half_plane, quarter_turn, sin_cos_degrees};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::margin::{END_TOL, Setting};
use crate::mechanics::statics::assembly::{Assembly, load_about};

/// The longest piece into which an arc of tilts is divided, degrees.
const MAX_ARC_DEGREES: f64 = 1.0;

/// Computes the load capacity in each extreme case with the function `capacity_of_case`, and returns the intersection
/// of these sets of forces.
pub(super) fn intersected(
    assembly: &Assembly,
    cases: &Cases,
    capacity_of_case: impl Fn(&Assembly) -> Result<LoadCapacity, CapacityError>,
) -> Result<LoadCapacity, CapacityError> {
    let changed = extremes(assembly, cases)?;
    let mut all = Vec::with_capacity(changed.len());
    for (number, assembly) in changed.iter().enumerate() {
        let mut capacity = capacity_of_case(assembly)?;
        for edge in &mut capacity.edges {
            edge.case = number;
        }
        let is_empty = capacity.shape() == CapacityShape::Empty;
        all.push(capacity);
        // If one case carries no additional force, the intersection over all cases is empty.
        if is_empty {
            break;
        }
    }
    let count = changed.len();
    match all.pop() {
        Some(only) if all.is_empty() => Ok(LoadCapacity { cases: count, ..only }),
        Some(last) if last.shape() == CapacityShape::Empty => Ok(LoadCapacity { cases: count, ..last }),
        Some(last) => {
            all.push(last);
            intersection(&all)
        }
        None => Err(CapacityError::Undecided),
    }
}

/// Returns one assembly for each extreme case, with the gravity and the friction of this case.
pub(in crate::mechanics) fn extremes(assembly: &Assembly, cases: &Cases) -> Result<Vec<Assembly>, CapacityError> {
    cases.check()?;
    let tilt = cases.tilt.unwrap_or([0.0; 2]);
    let across = cases.horizontal_load.unwrap_or([0.0; 2]);
    let mut shares = across.to_vec();
    shares.dedup();
    let mut all = Vec::new();
    for (degrees, strength) in gravities(tilt) {
        let turned = Setting::tilted(degrees, strength);
        for share in &shares {
            let changed = Setting {
                friction: cases.friction.map(|[least, _]| least),
                along: turned.along - turned.across * share,
                across: turned.across + turned.along * share,
                ..turned
            };
            all.push(changed.apply(assembly));
        }
    }
    Ok(all)
}

/// Returns gravity vectors whose convex hull contains gravity at every tilt between `from` and `to`, in degrees. Each
/// vector is given by its tilt in degrees and by the factor that multiplies the strength of gravity.
fn gravities([from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    if from == to {
        return vec![(from, 1.0)];
    }
    let pieces = ((to - from) / MAX_ARC_DEGREES).ceil().max(1.0);
    let piece = (to - from) / pieces;
    let strength = 1.0 / sin_cos_degrees(0.5 * piece).1;
    let mut all = vec![(from, 1.0), (to, 1.0)];
    all.extend((0..pieces as usize).map(|k| (from + (k as f64 + 0.5) * piece, strength)));
    all
}

impl LoadCapacity {
    /// True if an assembly, which is the frame in another condition, carries the force of each corner, just inside it, so that
    /// it carries all forces of this set. False if this is not known, as for unbounded sets.
    pub(in crate::mechanics::analysis) fn holds_for(&self, assembly: &Assembly) -> bool {
        let is_plain = self.rays.is_empty() && self.robot.is_none() && self.ranges == Cases::default();
        let Some(body) = assembly.bodies.iter().position(|body| body.block == self.block) else { return false };
        let [at] = self.at[..] else { return false };
        let centre = self.vertices.iter().map(|v| v.force).sum::<Vector>() / self.vertices.len().max(1) as f64;
        is_plain
            && self.vertices.iter().all(|vertex| {
                let mut loaded = assembly.clone();
                let own = &mut loaded.bodies[body];
                let force = vertex.force + (centre - vertex.force) * END_TOL;
                own.fixed = own.fixed.plus(load_about(own.centroid, at, force, 0.0));
                let factor = loaded.load_factor;
                decided(&loaded.with_load_factor(factor).components()).0 == Verdict::Stable
            })
    }

    /// Returns the forces that a block carries in both of two conditions. `None` if their intersection was not found.
    pub(in crate::mechanics::analysis) fn and(self, other: LoadCapacity) -> Option<LoadCapacity> {
        let cases = self.cases + other.cases;
        let is_empty = |own: &LoadCapacity| own.shape() == CapacityShape::Empty;
        let both = match (is_empty(&self), is_empty(&other)) {
            (true, _) => self,
            (_, true) => other,
            _ => intersection(&[self, other]).ok()?,
        };
        Some(LoadCapacity { cases, ..both })
    }
}

/// Returns the intersection of several load capacities: the forces that belong to each of these sets.
fn intersection(all: &[LoadCapacity]) -> Result<LoadCapacity, CapacityError> {
    let forces = || all.iter().flat_map(|c| c.vertices.iter().map(|v| v.force));
    let centre = forces().next().unwrap_or_else(Vector::zeros);
    let size = forces().map(|f| (f - centre).norm()).fold(0.0, f64::max);
    let size = size.max(1e-9 * centre.norm()).max(f64::MIN_POSITIVE);
    let far = RAY_LENGTH_PER_SIZE * size;
    let slack = refine::ROUNDING_TOL * size;
    let planes: Vec<(Vector, f64)> = all
        .iter()
        .flat_map(|capacity| {
            let own: Vec<Vector> = capacity.vertices.iter().map(|v| v.force).collect();
            half_planes(&own, &capacity.rays, far, slack)
        })
        .collect();
    let lines: Vec<CapacityEdge> = all.iter().flat_map(|c| c.edges.clone()).collect();
    let (forces, rays) = match intersect_parallel(&planes, size) {
        Some(set) => set,
        None => intersect_to_polygon(&planes, centre, far).ok_or(CapacityError::Undecided)?,
    };
    let tolerance = 1e-7 * size;
    let vertices = corners(&forces, &rays, tolerance).into_iter().map(|k| CapacityVertex {
        force: forces[k],
        torque: 0.0,
        contacts: Vec::new(),
        proof: None,
    });
    let mut capacity =
        LoadCapacity { vertices: vertices.collect(), rays, edges: Vec::new(), cases: all.len(), ..all[0].clone() };
    if capacity.shape() == CapacityShape::Empty {
        // Each case has a nonempty set of carried forces, but the sets have no force in common.
        capacity.mechanism = lines.first().map_or(Vec::new(), |l| l.mechanism.clone());
        return Ok(capacity);
    }
    set_edges(&mut capacity, &lines, size);
    Ok(capacity)
}

/// Returns the intersection of half-planes whose boundaries are all parallel, as corners and rays: everything, a
/// half-plane, a strip, a line or the empty set. `None` if two boundaries meet. `size` is the size of the sets, N.
fn intersect_parallel(planes: &[(Vector, f64)], size: f64) -> Option<(Vec<Vector>, Vec<Vector>)> {
    let Some((normal, _)) = planes.first() else {
        return Some((Vec::new(), axes().to_vec()));
    };
    if planes.iter().any(|(other, _)| cross(*normal, *other).abs() > SAME_DIRECTION) {
        return None;
    }
    let limit = |sign: f64| {
        let same = planes.iter().filter(|(other, _)| sign * other.dot(normal) > 0.0);
        same.map(|(_, limit)| *limit).reduce(f64::min)
    };
    // The set is the forces F with −below ≤ normal · F ≤ above.
    let above = limit(1.0)?;
    let along = quarter_turn(*normal);
    Some(match limit(-1.0) {
        None => (vec![normal * above], vec![along, -*normal, -along]),
        Some(below) if above + below < -1e-9 * size => (Vec::new(), Vec::new()),
        Some(below) => (vec![normal * above, normal * -below], vec![along, -along]),
    })
}

/// Returns the intersection of half-planes as forces and rays. The boundaries of at least two half-planes must meet.
/// The forces include all corners; the list of forces is empty if the intersection is empty. `None` if the corners are
/// so far from `centre`, compared with `far`, that they cannot be distinguished from rays.
fn intersect_to_polygon(planes: &[(Vector, f64)], centre: Vector, far: f64) -> Option<(Vec<Vector>, Vec<Vector>)> {
    let mut ring = square(centre, 0.5 * far);
    for (normal, limit) in planes {
        ring = in_half_plane(&ring, |force| normal.dot(force) - limit);
    }
    let is_far = |force: &&Vector| (*force - centre).amax() > 0.2 * far;
    let near: Vec<Vector> = ring.iter().filter(|f| !is_far(f)).copied().collect();
    let Some(middle) = near.first() else {
        return ring.is_empty().then(|| (Vec::new(), Vec::new()));
    };
    let outside = ring.iter().filter(is_far);
    let mut directions: Vec<Vector> = outside.map(|f| (f - middle).normalize()).collect();
    let rays = widest(&mut directions);
    Some((near, rays))
}

/// Sorts directions anticlockwise, and returns the first and the last. All directions must lie within one half-plane.
/// Returns one direction if the first and the last are nearly equal, and an empty list if there are no directions.
fn widest(directions: &mut [Vector]) -> Vec<Vector> {
    let mean: Vector = directions.iter().sum();
    let turn = |d: &Vector| libm::atan2(mean.x * d.y - mean.y * d.x, mean.dot(d));
    directions.sort_by(|a, b| turn(a).total_cmp(&turn(b)));
    match (directions.first(), directions.last()) {
        (Some(first), Some(last)) if (first - last).norm() > 1e-4 => vec![*first, *last],
        (Some(first), _) => vec![*first],
        _ => Vec::new(),
    }
}
