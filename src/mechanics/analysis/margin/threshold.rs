//! Finds the value of friction or kernel at which a component begins or ceases to stand: the *threshold*.
//!
//! Steps of growing size from 0 find two values between which the threshold lies. Newton's method predicts
//! it, and [`Path::search`] confirms it by verdicts on both sides.
//!
//! Newton's method for a threshold: searches for the parameter value at which the least residual, the smallest sum
//! of unbalanced forces, becomes 0. The search starts where the component falls.

use super::interval::{END_TOL, End, Exclusion, Interval};
use super::path::Path;
use super::search::{Beyond, Bracket, CONFIRMATION_TOL};
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::solve::Tangent;

/// Returns the interval of values, from 0 to `max_value`, at which a component stands. `outward` is −1 if it stands
/// above a least sufficient value, such as the least friction, and 1 if it stands below a largest admissible value.
pub(super) fn threshold(trial: &mut Trial, path: &Path, outward: f64) -> Interval {
    let (setting, max_value) = (&path.setting, path.max_value);
    let is_upper = outward > 0.0;
    let interval = |end: End| {
        if is_upper {
            Interval::Between { low: End::natural(0.0), high: end }
        } else {
            Interval::Between { low: end, high: End::Unbounded }
        }
    };
    let mut last = (0.0, trial.decide(&setting(0.0)));
    let stands_at_zero = last.1.0 == Verdict::Stable;
    match last.1 {
        (Verdict::Unstable, motion) if is_upper => return Interval::excluded_by(motion),
        (Verdict::Undecided, _) if is_upper => return Interval::Undecided,
        (Verdict::Stable, _) if !is_upper => return interval(End::natural(0.0)),
        _ => {}
    }
    // Take larger and larger steps away from 0, until the component no longer stands, or begins to stand.
    let mut value = max_value.min(1.0);
    let mut found = trial.decide(&setting(value));
    while (found.0 == Verdict::Stable) == stands_at_zero {
        if value >= max_value {
            return match found {
                _ if is_upper => interval(End::Unbounded),
                (Verdict::Unstable, motion) => Interval::Empty(vec![Exclusion::below(value, motion)]),
                _ => Interval::Undecided,
            };
        }
        last = (value, found);
        value = (value * 10.0).min(max_value);
        found = trial.decide(&setting(value));
    }
    // The component stands at `inside`, and does not stand at `outside`.
    let (inside, (outside, verdict)) = if is_upper { (last.0, (value, found)) } else { (value, last) };
    let root = path.newton_root(trial, [inside, outside]);
    let bracket = Bracket { inside, beyond: Some(Beyond::new(outside, verdict)) };
    interval(path.search(trial, bracket, outward, root))
}

/// The largest number of steps for one threshold, including steps that do not go to a root.
const MAX_STEPS: usize = 24;

/// Newton's method has also converged if the roots of two tangents, one of them much closer to the threshold, differ
/// by at most this, relative to their size.
const ROOT_TOL: f64 = 1e-7;

/// The error of a least residual, relative to the largest load: a few times the solver's tolerance.
const RESIDUAL_NOISE: f64 = 2e-9;

/// If the component stands at the root of a tangent, the next tangent is computed at this fraction of the bracket from
/// its stable end. The error of the root of this next tangent falls with the square of this fraction.
const APPROACH_SHARE: f64 = 1.0 / 16.0;

/// In Newton's method a component counts as stable if the least residual is at most this fraction of the largest
/// load.
const MAX_STABLE_RESIDUAL: f64 = 1e-8;

/// A least residual above this fraction of the largest load cannot be noise of the solver.
const MIN_SURE_RESIDUAL: f64 = 1e-6;

/// The bracket of Newton's method.
struct NewtonBracket {
    /// A value at which the component stands.
    inside: f64,
    /// A value at which the component falls.
    outside: f64,
    /// The tangent at `outside`.
    tangent: Tangent,
    /// The last value that was tested and at which the component stands, with the tangent there.
    standing: Option<(f64, Tangent)>,
}

impl NewtonBracket {
    /// Solves for the least residual at `value`, and moves one end of the bracket there. Returns true if the component
    /// falls at `value`; `None` if the program could not be solved.
    fn test(&mut self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, value: f64) -> Option<bool> {
        let tangent = trial.tangent(&setting(value))?;
        // A residual below `MIN_SURE_RESIDUAL` may be noise of the solver. The component then counts as falling only if
        // the motion proves it.
        let falls = match tangent.residual_sum {
            residual if residual <= MAX_STABLE_RESIDUAL => false,
            residual if residual < MIN_SURE_RESIDUAL => trial.proved_motion(&tangent, &setting(value)).is_some(),
            _ => true,
        };
        if falls {
            (self.outside, self.tangent) = (value, tangent);
        } else {
            (self.inside, self.standing) = (value, Some((value, tangent)));
        }
        Some(falls)
    }

    /// Tests a value like [`NewtonBracket::test`], but only if it lies inside the bracket. `None` if the program could
    /// not be solved.
    fn test_within(&mut self, trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, value: f64) -> Option<()> {
        if self.contains(value) {
            self.test(trial, setting, value)?;
        }
        Some(())
    }

    fn contains(&self, value: f64) -> bool {
        (value - self.inside) * (value - self.outside) < 0.0
    }
}

impl Path<'_> {
    /// Finds the threshold with Newton's method: the value at which the least residual becomes 0. The search starts at
    /// `outside`, where the component falls; it stands at `inside`. `None` if the method does not converge.
    ///
    /// If the component stands at the root of a tangent, the root of another tangent, closer to the threshold, must
    /// agree with this root. Adds the forces and the motion that confirm the threshold to the cache of `trial`.
    pub(super) fn newton_root(&self, trial: &mut Trial, [inside, outside]: [f64; 2]) -> Option<f64> {
        let setting = &self.setting;
        let mut bracket = NewtonBracket { inside, outside, tangent: trial.tangent(&setting(outside))?, standing: None };
        let mut falling = Vec::new();
        // `reached`: the last root at which the component stands, and the parameter value at which its tangent was
        // computed. `share`: where the next value is if the root of the tangent lies outside the bracket: its distance
        // from the inner end, as a fraction of the bracket.
        let (mut reached, mut share): (Option<[f64; 2]>, f64) = (None, 0.5);
        for _ in 0..MAX_STEPS {
            if bracket.tangent.residual_sum <= MAX_STABLE_RESIDUAL {
                return None;
            }
            let (inside, outside) = (bracket.inside, bracket.outside);
            let size = inside.max(outside);
            let root = trial.root(&bracket.tangent, setting, [outside, inside]);
            // Compute by how much the parameter must change to change the least residual by 1.
            let change_per_residual = (root - outside).abs() / bracket.tangent.residual_sum;
            let is_within = bracket.contains(root);
            let is_near = is_within || (root - inside).abs() <= 4.0 * MAX_STABLE_RESIDUAL * change_per_residual;
            let agrees = |[other, tangent_at]: [f64; 2]| {
                tangent_at != outside
                    && (root - other).abs() <= (ROOT_TOL * size).max(RESIDUAL_NOISE * change_per_residual)
            };
            falling.push((outside, bracket.tangent.clone()));
            // The method has converged in two cases: the bracket is narrow, or the root of the tangent agrees with the
            // falling end of the bracket or with the root of another tangent.
            let is_bracketed = (inside - outside).abs() <= END_TOL * size;
            let is_root = (root - outside).abs() <= END_TOL * size || reached.is_some_and(agrees);
            if is_bracketed || (is_near && is_root) {
                let edge = if is_near { root } else { inside };
                self.cache_both_sides(trial, edge, (outside - inside).signum(), falling, bracket.standing);
                return Some(edge);
            }
            // Go to the root of the tangent (Newton's step). If the root lies outside the bracket, go to a value inside
            // the bracket.
            if !is_within {
                let falls = bracket.test(trial, setting, inside + share * (outside - inside))?;
                share = if falls && reached.is_some() { APPROACH_SHARE } else { 0.5 };
            } else if !bracket.test(trial, setting, root)? {
                (reached, share) = (Some([root, outside]), APPROACH_SHARE);
                // The component stands at the root. Test whether it falls just beyond the root.
                let just_beyond = root + 0.4 * END_TOL * size * (outside - root).signum();
                bracket.test_within(trial, setting, just_beyond)?;
            }
        }
        None
    }

    /// Adds the motion of a value just beyond the threshold, and the forces of a value just inside it, to the cache of
    /// `trial`. They come from earlier Newton steps or from new tangents.
    fn cache_both_sides(
        &self,
        trial: &mut Trial,
        edge: f64,
        outward: f64,
        falling: Vec<(f64, Tangent)>,
        standing: Option<(f64, Tangent)>,
    ) {
        let setting = &self.setting;
        let distance = |value: f64| (value - edge).abs() / self.size(edge);
        let mut at = |distance: f64| {
            let value = (edge + outward * distance * self.size(edge)).clamp(self.min_value, self.max_value);
            Some((value, trial.tangent(&setting(value))?))
        };
        // Choose a falling value that is close enough to confirm the threshold, but far enough from it for a strong
        // proof.
        let is_near = |(value, _): &(f64, Tangent)| (2.0 * END_TOL..CONFIRMATION_TOL).contains(&distance(*value));
        let falls = falling.into_iter().rev().find(is_near).or_else(|| at(16.0 * END_TOL));
        let standing = standing.filter(|(value, _)| distance(*value) <= END_TOL);
        let stands = standing.or_else(|| at(-END_TOL));
        for (tangent, verdict) in [(falls, Verdict::Unstable), (stands, Verdict::Stable)] {
            if let Some((value, tangent)) = tangent {
                trial.cache_tangent(&tangent, &setting(value), verdict);
            }
        }
    }
}
