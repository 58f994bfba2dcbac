//! Finds the value of friction or kernel at which a component begins or ceases to stand: the *threshold*.
//!
//! Steps of growing size from 0 find two values between which the threshold lies. Newton's method ([`super::newton`])
//! predicts it, and [`Path::search`] confirms it by verdicts on both sides.

use super::exclusion::Exclusion;
use super::interval::{End, Interval};
use super::search::{Beyond, Bracket, END_TOL, MAX_VALUE, Path, Predictor};
use super::trial::{Setting, Trial};
use crate::mechanics::analysis::Verdict;

/// The largest number of times that an end is moved inward by [`sharpened`]. Each time costs a program.
const MAX_SHARPENINGS: usize = 8;

/// Returns the interval of values, from 0 to `max_value`, at which a component stands. `outward` is −1 if it stands
/// above a least sufficient value, such as the least friction, and 1 if it stands below a largest admissible value.
pub(super) fn threshold(trial: &mut Trial, setting: &dyn Fn(f64) -> Setting, max_value: f64, outward: f64) -> Interval {
    let path = Path {
        predictor: Predictor::Tangent,
        setting,
        min_value: 0.0,
        max_value,
        typical_small: 1.0,
        typical_large: max_value / MAX_VALUE,
        load_ratio: 0.0,
    };
    let is_upper = outward > 0.0;
    let interval = |end: End| match is_upper {
        true => Interval::Between { low: End::natural(0.0), high: end },
        false => Interval::Between { low: end, high: End::Unbounded },
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
    let end = path.search(trial, bracket, outward, root);
    interval(if trial.has_slight_loads() { sharpened(trial, &path, end, outward) } else { end })
}

/// Moves an end inward if a mechanism proves a fall just inside it, and returns the end. The verdict there is stable
/// only within the tolerance of a proof by forces; a mechanism has no such tolerance. This matters if some loads are
/// slight.
fn sharpened(trial: &mut Trial, path: &Path, end: End, outward: f64) -> End {
    let End::At { mut value, mut mechanism } = end else {
        return end;
    };
    for _ in 0..MAX_SHARPENINGS {
        let inside = (value - outward * END_TOL * path.size(value)).clamp(path.min_value, path.max_value);
        let setting = (path.setting)(inside);
        let Some(tangent) = trial.tangent(&setting) else {
            break;
        };
        let Some(motion) = trial.proved_motion(&tangent, &setting) else {
            break;
        };
        let root = trial.root(&tangent, path.setting, [inside, inside + (inside - value)]);
        let is_inward = (root - inside) * (inside - value) > 0.0;
        value = (if is_inward { root } else { inside }).clamp(path.min_value, path.max_value);
        mechanism = motion;
    }
    End::At { value, mechanism }
}
