//! Which numbers a scene may hold: finite, not absurdly large, and not negative where that makes no sense.

use super::finding::Findings;
use super::path::Trail;
use super::problem;

/// Largest amount of any number of a scene file, in whatever unit.
pub(super) const LARGEST: f64 = 1e12;

/// Whether all of some numbers are finite and within reason; notes the first that is not.
pub(super) fn is_sane(findings: &mut Findings, at: &Trail<'_>, numbers: &[f64]) -> bool {
    for x in numbers {
        if !x.is_finite() {
            findings.add(at, problem::number::not_finite(*x));
            return false;
        }
        if x.abs() > LARGEST {
            findings.add(at, problem::number::absurd(*x, LARGEST));
            return false;
        }
    }
    true
}

/// An optional number of an entry that has to be sane and at least 0; `None` where it is absent or wrong.
pub(super) fn at_least_zero(
    findings: &mut Findings,
    entry: &Trail<'_>,
    key: &str,
    number: Option<f64>,
) -> Option<f64> {
    let x = number?;
    let at = entry.key(key);
    if !is_sane(findings, &at, &[x]) {
        return None;
    }
    if x < 0.0 {
        findings.add(&at, problem::number::negative(key, x));
        return None;
    }
    Some(x)
}
