//! Computes the set of forces that a block can carry. If the simplex method does not find the whole set and the set is
//! unbounded, its recession cone is computed first.
//!
//! An unbounded set has a *recession cone*: any force of this cone may be added to any force of the set. The cone is
//! the set of forces that are carried without loads. The set has a farthest force exactly in those directions that form
//! an angle of at least 90° with every direction of the cone.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::probe::{Farthest, Probe};
use super::refine::{Sample, refine, sample, size};
use crate::geometry::Vector;
use crate::mechanics::solve::{Amounts, ForcePolygon};

/// The samples of a set, and the unit directions in which it is unbounded.
pub(super) struct SampledSet {
    pub samples: Vec<Sample>,
    pub rays: Vec<Vector>,
}

/// Two directions within this angle, in radians, count as equal.
pub(super) const SAME_DIRECTION: f64 = 1e-7;

/// The largest angle between neighbouring directions before the refinement, radians.
const MAX_STEP: f64 = 1.1;

/// Additional directions near the two ends of an interval of directions, as fractions of the interval. The last
/// vertices before an unbounded edge may be many times farther away than the other vertices. Only directions near the
/// ends of the interval find them.
const NEAR_OUTER: [f64; 3] = [1e-4, 1e-3, 1e-2];

/// The components of a force on an unbounded edge are limited to this multiple of the largest other force or load.
const MAX_FORCE_PER_SIZE: f64 = 10.0;

/// Each component of the corner of a half-plane or a strip is limited to this multiple of the distance of its edge from
/// the force 0. The value is above 1 so that rounding cannot hide the nearest force.
const NEAREST_REACH: f64 = 1.05;

/// Computes the set of forces that the block of a probe can carry. `None` if no force is carried, if a program has no
/// result, or if a necessary force has no proof.
pub(super) fn sample_set(probe: &Probe) -> Option<SampledSet> {
    let axes = [0.0, FRAC_PI_2, PI, 3.0 * FRAC_PI_2];
    let mut start = Vec::new();
    for angle in axes {
        match probe.farthest(unit(angle), None) {
            Farthest::At { carried: Some(carried), half_plane } => start.push(Sample { carried, half_plane }),
            Farthest::At { carried: None, .. } => start.push(sample(probe, unit(angle), None)?),
            Farthest::Unbounded => break,
            Farthest::None => return None,
        }
    }
    if start.len() == axes.len() {
        let samples = refine(probe, start, true, None);
        let rays = Vec::new();
        return Some(SampledSet { samples, rays });
    }
    unbounded(probe)
}

/// Computes a set of carried forces from the polygon that the simplex method finds, and refines the set where a corner
/// or an edge has no proof. `None` if the simplex method finds no polygon, or if too few corners and edges have a
/// proof.
pub(super) fn from_polygon(probe: &Probe) -> Option<SampledSet> {
    let ForcePolygon { corners, far } = probe.polygon()?;
    let proved: Vec<Option<Sample>> = corners
        .iter()
        .map(|corner| {
            let carried = probe.carried(&corner.forces)?;
            let half_plane = probe.half_plane(carried.force, corner.normal, &corner.motion);
            Some(Sample { carried, half_plane })
        })
        .collect();
    let Some([first_far, last_far]) = far else {
        let start: Vec<Sample> = proved.into_iter().flatten().collect();
        let samples = (start.len() >= 3).then(|| refine(probe, start, true, None))?;
        let rays = Vec::new();
        return Some(SampledSet { samples, rays });
    };
    // The unbounded edges begin at the first and the last corner. Each of these two edges needs two proofs: one of its
    // motion, and one of a force far along the edge.
    let ray = |corner: &Option<Sample>, far: &Amounts| {
        let corner = corner.as_ref().filter(|c| c.half_plane.is_some())?;
        let along = probe.carried(far)?.force - corner.carried.force;
        Some(libm::atan2(along.y, along.x))
    };
    let to = ray(proved.first()?, &first_far)?;
    let from = ray(proved.last()?, &last_far)?;
    let width = (to - from + SAME_DIRECTION).rem_euclid(TAU) - SAME_DIRECTION;
    let rays = (width < PI - SAME_DIRECTION).then(|| Cone::Between(from, from + width).rays())?;
    let samples = refine(probe, proved.into_iter().flatten().collect(), false, None);
    Some(SampledSet { samples, rays })
}

/// Computes an unbounded set of carried forces. `None` if its recession cone was not found, or if a necessary force has
/// no proof.
fn unbounded(probe: &Probe) -> Option<SampledSet> {
    let cone = Cone::from_probe(probe)?;
    let around = probe.heaviest();
    if cone == Cone::Everything {
        let rays = [0.0, FRAC_PI_2, PI, 3.0 * FRAC_PI_2].map(unit).to_vec();
        // The recession cone contains every force. So if one force is carried with the real loads, all forces are
        // carried. Prove one force.
        let samples = vec![sample(probe, unit(0.0), Some(around))?];
        return Some(SampledSet { samples, rays });
    }
    let mut samples = Vec::new();
    for (from, to) in cone.normals() {
        // First compute samples in the inner directions of the interval. Their forces determine the size of the set,
        // because the forces may be far larger than the loads.
        let count = ((to - from) / MAX_STEP).ceil().max(2.0);
        let inner = (1..count as usize).map(|k| k as f64 / count);
        let shares = NEAR_OUTER.into_iter().chain(inner);
        let shares = shares.chain(NEAR_OUTER.into_iter().rev().map(|share| 1.0 - share));
        let angles = shares.map(|share| from + (to - from) * share);
        let mut inside: Vec<Sample> = if to - from > SAME_DIRECTION {
            angles.filter_map(|a| sample(probe, unit(a), None)).collect()
        } else {
            Vec::new()
        };
        let norms = inside.iter().map(|s| s.carried.force.norm());
        let largest = norms.fold(size(&inside).max(around), f64::max);
        // Then compute samples at the two ends of the interval. These directions are at right angles to the unbounded
        // edges.
        let reach = Some(MAX_FORCE_PER_SIZE * largest);
        let first = sample(probe, unit(from), reach)?;
        if to - from > SAME_DIRECTION {
            inside.insert(0, first);
            inside.push(sample(probe, unit(to), reach)?);
            samples.extend(refine(probe, inside, false, reach));
        } else {
            // Any force on this edge can serve as its corner. Choose one that is about as small as possible.
            let nearest = first.half_plane.as_ref().and_then(|line| {
                let reach = (NEAREST_REACH * line.limit.abs()).max(1e-3 * around);
                sample(probe, unit(from), Some(reach))
            });
            samples.push(nearest.unwrap_or(first));
        }
    }
    let rays = cone.rays();
    Some(SampledSet { samples, rays })
}

/// The directions in which a set is unbounded, as angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Cone {
    /// All directions from the first angle anticlockwise to the second, which is at most π larger.
    Between(f64, f64),
    /// A direction and its opposite.
    Line(f64),
    /// All directions.
    Everything,
}

impl Cone {
    /// Computes the recession cone of a probe: the forces, with components of at most 1, that are carried without
    /// loads. `None` if no direction was found in which the set is unbounded.
    fn from_probe(probe: &Probe) -> Option<Cone> {
        let homogeneous = probe.without_loads();
        let reach = Some(1.0);
        let start = (0..8).map(|k| 0.1 + f64::from(k) * TAU / 8.0);
        let start = start.filter_map(|a| sample(&homogeneous, unit(a), reach));
        let samples = refine(&homogeneous, start.collect(), true, reach);
        let far = samples.iter().map(|s| s.carried.force);
        let far = far.filter(|force| force.amax() > 0.5);
        let mut angles: Vec<f64> = far.map(|f| libm::atan2(f.y, f.x)).collect();
        angles.sort_by(f64::total_cmp);
        // The largest gap between neighbouring angles lies outside the cone, unless the cone contains all directions.
        let next = |k: usize| match angles.get(k + 1) {
            Some(next) => *next,
            None => angles[0] + TAU,
        };
        let widest = (0..angles.len()).max_by(|a, b| {
            let gap = |k: usize| next(k) - angles[k];
            gap(*a).total_cmp(&gap(*b))
        })?;
        let (last, first) = (angles[widest], next(widest) - TAU);
        let width = last - first;
        // If all directions lie at two opposite angles, the cone is a line.
        let is_between = |a: &f64| {
            let from = (a - first).rem_euclid(TAU);
            from > SAME_DIRECTION && from < width - SAME_DIRECTION
        };
        if width > PI + SAME_DIRECTION {
            Some(Cone::Everything)
        } else if width > PI - SAME_DIRECTION && !angles.iter().any(is_between) {
            Some(Cone::Line(first))
        } else if width > PI - SAME_DIRECTION {
            Some(Cone::Between(first, first + PI))
        } else {
            Some(Cone::Between(first, last))
        }
    }

    /// Returns the directions in which the set of carried forces is bounded, as intervals of angles in radians.
    fn normals(self) -> Vec<(f64, f64)> {
        match self {
            Cone::Everything => Vec::new(),
            Cone::Line(a) => [a + FRAC_PI_2, a + 3.0 * FRAC_PI_2].map(|n| (n, n)).to_vec(),
            Cone::Between(from, to) => vec![(to + FRAC_PI_2, from + 3.0 * FRAC_PI_2)],
        }
    }

    fn rays(self) -> Vec<Vector> {
        match self {
            Cone::Everything => Vec::new(),
            Cone::Line(a) => vec![unit(a), unit(a + PI)],
            Cone::Between(from, to) if to - from <= SAME_DIRECTION => vec![unit(0.5 * (from + to))],
            Cone::Between(from, to) if to - from >= PI - SAME_DIRECTION => {
                vec![unit(from), unit(from + FRAC_PI_2), unit(from + PI)]
            }
            Cone::Between(from, to) => vec![unit(from), unit(to)],
        }
    }
}

fn unit(angle: f64) -> Vector {
    let (sin, cos) = libm::sincos(angle);
    // Remove rounding: the unit vector along one axis gets exactly 0 as its other component.
    let plain = |v: f64| if v.abs() < 1e-15 { 0.0 } else { v };
    Vector::new(plain(cos), plain(sin))
}
