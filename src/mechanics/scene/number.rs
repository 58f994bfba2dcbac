//! The allowed numbers of a scene: finite, within ±10¹², not tiny without being 0, and not negative where a negative number
//! makes no sense.

use super::finding::Findings;
use super::path::Trail;
use super::problem;

/// Largest amount of any number of a scene file, in whatever unit.
pub(super) const LARGEST: f64 = 1e12;

/// Smallest amount but 0, in whatever unit: a weight is a product of several, and its square is still to be a number.
/// Coordinates may be smaller: next to others they are rounding noise.
pub(super) const SMALLEST: f64 = 1e-30;

/// Smallest extent of a body or a cell, in metres: its area and moments are products of several.
pub(super) const SMALLEST_EXTENT: f64 = 1e-30;

/// Whether all numbers are finite and within ±10¹². Reports the first one that is not.
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

/// Whether an amount, or each component of a vector, is in the allowed range, and either 0 or not too small to calculate
/// with. Reports the first one that is not.
pub(super) fn is_amount(findings: &mut Findings, at: &Trail<'_>, numbers: &[f64]) -> bool {
    if !is_sane(findings, at, numbers) {
        return false;
    }
    let largest = numbers.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    if largest > 0.0 && largest < SMALLEST {
        findings.add(at, problem::number::tiny(largest, SMALLEST));
        return false;
    }
    true
}

/// An optional number of an entry that must be at least 0; `None` if it is absent or not allowed.
pub(super) fn at_least_zero(
    findings: &mut Findings,
    entry: &Trail<'_>,
    key: &str,
    number: Option<f64>,
) -> Option<f64> {
    let x = number?;
    let at = entry.key(key);
    if !is_amount(findings, &at, &[x]) {
        return None;
    }
    if x < 0.0 {
        findings.add(&at, problem::number::negative(key, x));
        return None;
    }
    Some(x)
}
