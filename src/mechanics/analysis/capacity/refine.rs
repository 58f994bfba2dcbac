//! Refines a polygon of carried forces: solves for the farthest force in further directions until every edge is known.
//!
//! Between two neighbouring farthest forces lies either an edge or another vertex. The farthest force along the normal
//! of their chord decides. If it is not farther than the chord, the chord is an edge; otherwise it is a new vertex.
//! Reference: Kamenev 1992; Lotov, Bushenkov and Kamenev 2004 (estimate refinement).

use super::probe::{CarriedForce, Farthest, HalfPlane, Probe, RELATIVE_TOL};
use crate::geometry::{Vector, cross, range_of};

/// The farthest force in a direction, and the half-plane of the motion that excludes farther forces, if this motion has
/// a proof.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub carried: CarriedForce,
    pub half_plane: Option<HalfPlane>,
}

/// The tolerance is at least this fraction of the heaviest load, because the solver is not more accurate.
const MIN_TOL_PER_LOAD: f64 = 2e-9;

/// Forces whose distance is at most this fraction of the size of a set differ only by rounding.
pub(super) const ROUNDING_TOL: f64 = 1e-12;

/// The error of a program may increase the tolerance by at most this multiple of the tolerance.
const NOISE_PER_TOLERANCE: f64 = 30.0;

/// The largest depth of the recursion.
const MAX_DEPTH: usize = 24;

/// The largest number of additional directions in one refinement. Each direction needs at least one linear program.
const MAX_SAMPLES: usize = 500;

/// Returns the distance, N, below which two forces count as equal, for a set of forces of this size, N.
pub(super) fn tolerance(probe: &Probe, size: f64) -> f64 {
    (RELATIVE_TOL * size).max(MIN_TOL_PER_LOAD * probe.heaviest())
}

/// Returns the size of a set of forces, N: the larger side of its bounding box.
pub(super) fn size(samples: &[Sample]) -> f64 {
    let extent = |axis: usize| {
        let (low, high) = range_of(samples.iter().map(|s| s.carried.force[axis]));
        (high - low).max(0.0)
    };
    extent(0).max(extent(1))
}

/// Returns the farthest carried force that has a proof, in this direction or at a small angle to it. `None` if no force
/// was proved. `reach` is the largest magnitude of each component of the force, N.
pub(super) fn sample(probe: &Probe, direction: Vector, reach: Option<f64>) -> Option<Sample> {
    // If this direction gives no proof, try slightly rotated directions. Their forces belong to the set, too.
    [0.0, 1e-3, -1e-3, 2e-2, -2e-2].into_iter().find_map(|angle| {
        let (sin, cos) = libm::sincos(angle);
        let turned = Vector::new(cos * direction.x - sin * direction.y, sin * direction.x + cos * direction.y);
        match probe.farthest(turned, reach) {
            Farthest::At { carried: Some(carried), half_plane } => Some(Sample { carried, half_plane }),
            _ => None,
        }
    })
}

/// Adds samples between neighbouring samples until all edges between them are known. The directions of `start` run
/// anticlockwise. If `is_closed`, the last sample is also a neighbour of the first. Returns all samples, anticlockwise
/// too.
pub(super) fn refine(probe: &Probe, start: Vec<Sample>, is_closed: bool, reach: Option<f64>) -> Vec<Sample> {
    let mut search = Search { probe, reach, tolerance: tolerance(probe, size(&start)), count: 0, samples: Vec::new() };
    let pairs = if is_closed { start.len() } else { start.len().saturating_sub(1) };
    for (k, first) in start.iter().enumerate() {
        search.samples.push(first.clone());
        if k < pairs {
            search.refine_between(first, &start[(k + 1) % start.len()], MAX_DEPTH);
        }
    }
    search.samples
}

struct Search<'a> {
    probe: &'a Probe,
    reach: Option<f64>,
    tolerance: f64,
    count: usize,
    samples: Vec<Sample>,
}

impl Search<'_> {
    /// Adds the samples between two neighbouring samples, recursively.
    fn refine_between(&mut self, from: &Sample, to: &Sample, depth: usize) {
        let [a, b] = [from, to].map(|sample| sample.carried.force);
        let chord = b - a;
        let length = chord.norm();
        if length <= self.tolerance || depth == 0 || self.count >= MAX_SAMPLES {
            return;
        }
        // If the boundary of one sample's half-plane passes through both forces, the edge between the forces is already
        // known.
        let touches = |half_plane: &Option<HalfPlane>, force: Vector| {
            let half_plane = half_plane.as_ref();
            half_plane.is_some_and(|half_plane| half_plane.beyond(force) <= self.tolerance)
        };
        if touches(&from.half_plane, b) || touches(&to.half_plane, a) {
            return;
        }
        // The forces run anticlockwise, so the outside is to the right of the chord.
        let normal = Vector::new(chord.y, -chord.x) / length;
        self.count += 1;
        let Some(next) = sample(self.probe, normal, self.reach) else {
            return;
        };
        let force = next.carried.force;
        let farther = cross(chord, force - a) / -length;
        // The distance of the new force from the boundary of its own half-plane is the error of its linear program.
        // Such an error must not become a new vertex.
        let error = next.half_plane.as_ref().map_or(0.0, |half_plane| half_plane.beyond(force).abs());
        if farther <= self.tolerance + (2.0 * error).min(NOISE_PER_TOLERANCE * self.tolerance) {
            // The chord is an edge, because the new force is not farther out. Keep the new sample if it contains the
            // half-plane of this edge.
            if next.half_plane.is_some() {
                self.samples.push(next);
            }
            return;
        }
        self.refine_between(from, &next, depth - 1);
        self.samples.push(next.clone());
        self.refine_between(&next, to, depth - 1);
    }
}
