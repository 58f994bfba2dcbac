//! Checks the numbers of a scene: each must be finite and within ±10¹². Some numbers must also be either 0 or at least
//! 10⁻³⁰ in size, and some must not be negative.

use super::finding::Findings;
use super::problem;
use crate::read::Trail;

/// The largest absolute value of any number in a scene file, in any unit.
pub(super) const MAX_MAGNITUDE: f64 = 1e12;

/// The smallest absolute value other than 0, in any unit. A weight is a product of several numbers, and its square
/// must not underflow. Coordinates may be smaller: compared with other coordinates they are rounding noise.
pub(super) const MIN_MAGNITUDE: f64 = 1e-30;

/// Smallest extent of a body or a cell, in the units of the file. Areas and moments are products of several lengths,
/// which must not underflow.
pub(super) const SMALLEST_EXTENT: f64 = 1e-30;

/// True if all numbers are finite and within ±10¹². Otherwise reports the first number that is not.
pub(super) fn is_sane(findings: &mut Findings, at: &Trail<'_>, numbers: &[f64]) -> bool {
    for x in numbers {
        if !x.is_finite() {
            findings.add(at, problem::message::not_finite(*x));
            return false;
        }
        if x.abs() > MAX_MAGNITUDE {
            findings.add(at, problem::message::absurd(*x, MAX_MAGNITUDE, findings.units));
            return false;
        }
    }
    true
}

/// True if the numbers are finite, within ±10¹², and not tiny: the largest absolute value is 0 or at least 10⁻³⁰.
/// Otherwise reports the first problem. `numbers` is a single number, or the components of one vector.
pub(super) fn is_amount(findings: &mut Findings, at: &Trail<'_>, numbers: &[f64]) -> bool {
    if !is_sane(findings, at, numbers) {
        return false;
    }
    let largest = numbers.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    if largest > 0.0 && largest < MIN_MAGNITUDE {
        findings.add(at, problem::message::tiny(largest, MIN_MAGNITUDE, findings.units));
        return false;
    }
    true
}

/// Returns `number`, the value of the key `key`, if it is present and valid: either 0, or from 10⁻³⁰ to 10¹². Reports
/// an invalid number and returns `None`. `entry` is the path of the object that contains the key.
pub(super) fn at_least_zero(findings: &mut Findings, entry: &Trail<'_>, key: &str, number: Option<f64>) -> Option<f64> {
    let x = number?;
    let at = entry.key(key);
    if !is_amount(findings, &at, &[x]) {
        return None;
    }
    if x < 0.0 {
        findings.add(&at, problem::message::negative(key, x));
        return None;
    }
    Some(x)
}
