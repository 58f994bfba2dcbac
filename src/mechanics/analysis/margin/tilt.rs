//! Finds the tilts at which a component stands: the angles by which gravity may rotate.
//!
//! Changed gravity has two components: one along the original direction and one across it. The pairs of components at
//! which a structure stands form a convex set in a plane. Tilts form a circle in this plane. If only weights act and no
//! robot has a finite limit, the set is a cone, and the tilts follow from the interval of horizontal loads. Otherwise
//! the circle may enter and leave the set several times. At the tilt θ, a mechanism has the power A cos θ + B sin θ +
//! C, so it excludes a whole arc of tilts. The ends of these arcs are tried next.

use super::interval::{End, Interval};
use super::linear::linear;
use super::search::{CONFIRMATION_TOL, END_TOL, OFFSET_GROWTH, Path, Predictor};
use super::threshold::MAX_SHARPENINGS;
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::LimitDistance;
use crate::mechanics::proof::Motion;

/// A range between two stable tilts is not searched further if it is narrower than this, degrees.
pub(super) const MIN_ARC: f64 = 1e-6;
/// The step of the first search, degrees. A right angle is no multiple of it, because many structures are exactly at
/// their limit of stability at right angles.
const SEARCH_STEP: f64 = 77.7;
/// The largest number of steps of one search. Each step excludes an arc of tilts by a mechanism.
pub(super) const MAX_CUTS: usize = 200;

/// Returns the interval of tilts around 0, in degrees, at which a component stands. It must stand at tilt 0.
/// `horizontal` is its interval of horizontal loads.
pub(super) fn around_present(trial: &mut Trial, horizontal: &Interval) -> Interval {
    match horizontal {
        Interval::Between { low, high } if !trial.is_loaded() && !trial.is_limited() => {
            let low = limit_of_weights(trial, -1.0, low);
            let high = limit_of_weights(trial, 1.0, high);
            // The stable directions of gravity form a convex cone. A cone that reaches half a turn on one side, but not
            // on the other, is a half-plane: it ends at half a turn, where the mechanism of the other end begins.
            match (low, high) {
                (End::Unbounded, high) if high != End::Unbounded => {
                    Interval::Between { low: end_of_half_plane(-1.0, &high), high }
                }
                (low, End::Unbounded) if low != End::Unbounded => {
                    Interval::Between { high: end_of_half_plane(1.0, &low), low }
                }
                (low, high) => Interval::Between { low, high },
            }
        }
        _ => around(trial, 0.0),
    }
}

/// Returns the end of a half-plane of stable directions of gravity on one side (`side` is −1 or 1), in degrees. Its
/// other end is `other`, at tilt 0.
fn end_of_half_plane(side: f64, other: &End) -> End {
    let half_turn = side * 180.0;
    match other {
        End::Unbounded => End::Unbounded,
        End::At { mechanism, .. } => End::At { value: half_turn, mechanism: mechanism.clone() },
        End::Unconfirmed { beyond, .. } => End::Unconfirmed { stands: half_turn, beyond: beyond + side * 360.0 },
    }
}

/// Returns the interval of tilts, in degrees, at which a component stands, around the tilt `from`. It must stand at
/// `from`.
pub(super) fn around(trial: &mut Trial, from: f64) -> Interval {
    let [low, high] = [-1.0, 1.0].map(|outward| {
        let mut search = TiltSearch { trial: &mut *trial, from, outward };
        search.end()
    });
    Interval::Between { low, high }
}

/// A search for the end of the stable tilts in one direction, from the tilt `from`, at which the component stands. The
/// *distance* of a tilt is its angle from `from` in this direction, from 0 to 360 degrees.
struct TiltSearch<'t, 'a> {
    trial: &'t mut Trial<'a>,
    from: f64,
    outward: f64,
}

/// The first end of the stable tilts in one direction, as a distance from the start, in degrees.
enum StableEnd {
    At(f64, Vec<Motion>),
    /// The component stands at the first distance; at the second it falls or is undecided.
    Unconfirmed(f64, f64),
}

impl TiltSearch<'_, '_> {
    fn end(&mut self) -> End {
        let mut reached = 0.0;
        // A search that does not start at tilt 0 belongs to a frame of which some component does not stand at tilt 0. If
        // the search goes towards 0, its first step ends exactly at 0, so that it does not jump over tilts near 0.
        let to_zero = -self.outward * self.from;
        let mut next = if to_zero > 0.0 { to_zero } else { SEARCH_STEP };
        loop {
            let stable_end = match self.decide(next) {
                (Verdict::Unstable, motion) => Some(self.edge(reached, next, motion)),
                (Verdict::Stable, _) => self.fall_between(reached, next),
                (Verdict::Undecided, _) => {
                    // The verdict is undecided, so try a tilt between the last stable tilt and this tilt.
                    let other = 0.5 * (reached + next) + 0.137 * (next - reached);
                    match self.decide(other) {
                        (Verdict::Unstable, motion) => Some(self.edge(reached, other, motion)),
                        (Verdict::Stable, _) => {
                            let stable_end = self.fall_between(reached, other);
                            stable_end.or(Some(StableEnd::Unconfirmed(other, next)))
                        }
                        (Verdict::Undecided, _) => Some(StableEnd::Unconfirmed(reached, other)),
                    }
                }
            };
            match stable_end {
                Some(stable_end) => return self.to_end(stable_end),
                None if next >= 360.0 => return End::Unbounded,
                None => (reached, next) = (next, (next + SEARCH_STEP).min(360.0)),
            }
        }
    }

    fn to_end(&self, stable_end: StableEnd) -> End {
        let tilt = |distance: f64| {
            let tilt = self.from + self.outward * distance;
            if tilt.abs() < 1e-9 { 0.0 } else { tilt }
        };
        match stable_end {
            StableEnd::At(distance, mechanism) => End::At { value: tilt(distance), mechanism },
            StableEnd::Unconfirmed(stands, beyond) => End::Unconfirmed { stands: tilt(stands), beyond: tilt(beyond) },
        }
    }

    /// Finds the first tilt beyond which the component falls. It lies between the distances `stands` and `falls` from
    /// the start, in degrees. The component stands at `stands`, and falls at `falls` by `motion`.
    fn edge(&mut self, stands: f64, falls: f64, motion: Vec<Motion>) -> StableEnd {
        let (mut stands, mut falls, mut motion) = (stands, falls, motion);
        // If the last mechanism excluded hardly any tilts, bisect in the next step.
        let mut is_slow = false;
        for _ in 0..MAX_CUTS {
            // The mechanism was found at `falls`. It excludes every tilt from `bound` to `falls`.
            let arc = excluded_arc(self.trial, self.from + self.outward * falls, &motion);
            let bound = arc.map_or(stands, |arc| self.first_excluded(arc, falls));
            // The mechanism may exclude even `stands`: that verdict holds only within the tolerance of a proof by
            // forces, and a mechanism has no such tolerance. Search again from the start.
            if stands - bound > MIN_ARC {
                stands = 0.0;
            }
            if bound - stands <= MIN_ARC {
                return self.sharpened(bound, stands.min(bound), motion);
            }
            let size = tilt_scale(self.from + self.outward * bound);
            let near = offsets().map(|step| (bound - step * size).max(0.5 * (stands + bound)));
            // If the verdicts near `bound` are undecided, a tilt farther inside may still narrow the search.
            let far = [0.5, 0.75, 0.25].map(|share| stands + share * (bound - stands));
            let mut distances: Vec<(f64, bool)> = near.map(|distance| (distance, true)).collect();
            let first_far = if is_slow { 0 } else { distances.len() };
            distances.splice(first_far..first_far, far.map(|distance| (distance, false)));
            let mut inside = None;
            for (distance, is_near) in distances {
                match self.decide(distance) {
                    (Verdict::Undecided, _) => {}
                    (verdict, mechanism) => {
                        inside = Some((distance, is_near, verdict, mechanism));
                        break;
                    }
                }
            }
            match inside {
                None => return StableEnd::Unconfirmed(stands, bound),
                Some((distance, is_near, Verdict::Stable, _)) => match self.fall_between(stands, distance) {
                    Some(stable_end) => return stable_end,
                    None if is_near => return self.sharpened(bound, distance, motion),
                    None => (stands, is_slow) = (distance, false),
                },
                Some((distance, is_near, _, mechanism)) => {
                    (falls, motion) = (distance, mechanism);
                    is_slow = is_near;
                }
            }
        }
        StableEnd::Unconfirmed(stands, falls)
    }

    /// Returns the end at the distance `bound`, moved inward if the component falls even at `stands`, just inside it.
    /// The verdict there is stable only within the tolerance of a proof by forces, which may be more than 0.0001
    /// degrees. A mechanism has no such tolerance, and excludes an arc that begins farther inside.
    fn sharpened(&mut self, bound: f64, stands: f64, motion: Vec<Motion>) -> StableEnd {
        let (mut bound, mut motion) = (bound, motion);
        let mut inside = stands;
        for _ in 0..MAX_SHARPENINGS {
            let tilt = self.from + self.outward * inside;
            let Some(found) = self.trial.sure_fall(&tilted(tilt, 1.0)) else {
                break;
            };
            let Some(arc) = excluded_arc(self.trial, tilt, &found) else {
                break;
            };
            let closer = self.first_excluded(arc, inside);
            if closer >= bound {
                break;
            }
            let step = END_TOL * tilt_scale(tilt);
            (bound, motion, inside) = (closer, found, (closer - step).max(0.0));
        }
        StableEnd::At(bound, motion)
    }

    /// Returns the distance at which an arc of excluded tilts begins, seen from the start of the search. The arc
    /// contains the distance `inside_arc`.
    fn first_excluded(&self, [low, high]: [f64; 2], inside_arc: f64) -> f64 {
        let tilt = if self.outward > 0.0 { low } else { high };
        ((tilt - self.from) * self.outward).clamp(0.0, inside_arc)
    }

    /// Finds the first tilt at which the component ceases to stand, between the distances `from` and `to` from the
    /// start, in degrees. The component stands at both. `None` if it stands at all tilts between them.
    ///
    /// The gravity vectors under which the component stands form a convex set. If the set contains both ends of an
    /// arc and the intersection of the tangents there, it contains the triangle of these points, and therefore the
    /// arc. If the set is a cone, it contains every arc of less than half a turn between two of its directions.
    /// Otherwise the arc is bisected.
    fn fall_between(&mut self, from: f64, to: f64) -> Option<StableEnd> {
        let width = to - from;
        let is_cone = !self.trial.is_loaded() && !self.trial.is_limited();
        if width <= MIN_ARC || (is_cone && width < 179.0) {
            return None;
        }
        let middle = 0.5 * (from + to);
        if width < 170.0 {
            let beyond_the_arc = 1.0 / libm::cos(0.5 * width.to_radians());
            let tilt = self.from + self.outward * middle;
            let apex = self.trial.decide(&tilted(tilt, beyond_the_arc)).0;
            if apex == Verdict::Stable {
                return None;
            }
        }
        match self.decide(middle) {
            (Verdict::Stable, _) => self.fall_between(from, middle).or_else(|| self.fall_between(middle, to)),
            (Verdict::Unstable, motion) => Some(self.edge(from, middle, motion)),
            (Verdict::Undecided, _) => Some(StableEnd::Unconfirmed(from, middle)),
        }
    }

    fn decide(&mut self, distance: f64) -> (Verdict, Vec<Motion>) {
        let tilt = self.from + self.outward * distance;
        self.trial.decide_at(&tilted(tilt, 1.0), LimitDistance::AtLimit)
    }
}

/// Returns the setting with gravity rotated by an angle in degrees, positive to the right, and multiplied by `stretch`.
pub(super) fn tilted(degrees: f64, stretch: f64) -> Setting {
    let angle = degrees.to_radians();
    Setting { along: stretch * libm::cos(angle), across: stretch * libm::sin(angle), ..Setting::default() }
}

/// Returns the first and the last tilt, in degrees, at which a motion proves a fall. The tilt `tilt`, at which the
/// motion was found, lies between them. `None` if the motion proves a fall at every tilt.
pub(super) fn excluded_arc(trial: &Trial, tilt: f64, motion: &[Motion]) -> Option<[f64; 2]> {
    let power = |along: f64, across: f64| {
        let setting = Setting { along, across, ..Setting::default() };
        trial.power(&setting, motion)
    };
    let constant = power(0.0, 0.0);
    let [along, across] = [power(1.0, 0.0) - constant, power(0.0, 1.0) - constant];
    let size = libm::hypot(along, across);
    // The power is positive where size · cos(θ − middle) + constant > 0.
    if constant >= size {
        return None;
    }
    let middle = libm::atan2(across, along).to_degrees();
    let half = libm::acos((-constant / size).clamp(-1.0, 1.0)).to_degrees();
    let offset = tilt - middle;
    let offset = offset - 360.0 * (offset / 360.0).round();
    let half = half.max(offset.abs());
    Some([tilt - offset - half, tilt - offset + half])
}

/// Returns growing distances from the end of an interval of tilts, as fractions of [`tilt_scale`].
pub(super) fn offsets() -> impl Iterator<Item = f64> {
    std::iter::successors(Some(0.5 * END_TOL), |step| Some(step * OFFSET_GROWTH))
        .take_while(|step| *step <= CONFIRMATION_TOL)
}

/// Returns the angle, in degrees, to which distances from a tilt are relative: the magnitude of the tilt, but at least
/// 1 and at most 90.
pub(super) fn tilt_scale(tilt: f64) -> f64 {
    tilt.abs().clamp(1.0, 90.0)
}

/// Returns the largest tilt on one side (`side` is −1 or 1), for a component with only weights and no finite robot
/// limits. Up to 90°, the tangent of this tilt is the largest horizontal load. Beyond 90°, a second linear program
/// gives the largest upward fraction of the weights, whose arctangent is added to 90°.
fn limit_of_weights(trial: &mut Trial, side: f64, horizontal: &End) -> End {
    let tilt = |share: f64| libm::atan(share).to_degrees();
    match horizontal {
        End::At { value, mechanism } => End::At { value: tilt(*value), mechanism: mechanism.clone() },
        End::Unconfirmed { stands, beyond } => End::Unconfirmed { stands: tilt(*stands), beyond: tilt(*beyond) },
        End::Unbounded => {
            let line = Path {
                predictor: Predictor::Plane,
                setting: &|share| Setting { along: -share, across: side, ..Setting::default() },
                min_value: 0.0,
                max_value: f64::INFINITY,
                typical_small: 1.0,
                typical_large: 1.0,
                load_ratio: 0.0,
            };
            let alone = |_: f64| Setting { along: -1.0, ..Setting::default() };
            match linear(trial, &line, 0.0, true, &alone) {
                Interval::Between { high: End::At { value, mechanism }, .. } => {
                    End::At { value: side * (90.0 + tilt(value)), mechanism }
                }
                Interval::Between { high: End::Unbounded, .. } => End::Unbounded,
                _ => End::Unconfirmed { stands: side * 90.0, beyond: side * 180.0 },
            }
        }
    }
}
