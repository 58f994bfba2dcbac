//! [`Reference`]: computes the true verdict, the total force and the largest force of a linear program, with a
//! certificate. The total is given only if at least twelve digits are certain.
//!
//! 1. If a balance without adhesion has a certified optimum ([`optimum`]), the program is stable. Its value is the
//!    least total force.
//! 2. Otherwise adhesion is allowed, and its total is minimised. A certified optimum above 0 means unstable, and a
//!    certified optimum of 0 means stable, without a value for the total force.
//! 3. Otherwise a motion that even adhesion does not resist proves the program unstable.
//! 4. Otherwise the reference is undecided.
//!
//! Every f64 of the program counts as exact. An exact rational simplex method would also certify the result, but the
//! length of its numbers grows with the size of the program.

use super::double::Double;
use super::least::largest_of_unique;
use super::optimum::{OPTIMALITY_TOL, entries, optimum, power, product};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::{Column, Program, adhesion_columns, columns};
use crate::mechanics::solve::{Conditioning, Effort, Status, dual};

/// Largest relative gap of a certificate whose value counts as known to twelve digits.
const MAX_GAP: f64 = 1e-12;
/// A motion is only a proof if its power, relative to the largest load, is above this multiple of its largest
/// violation. The factor is far above the rounding errors of the solver.
const MIN_POWER_OVER_VIOLATION: f64 = 1e6;
/// If the power of a motion is below this, relative to the largest velocity, it may be a rounding error.
const MIN_POWER: f64 = 1e-9;

/// The true solution of one program, in its scaled numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// The exact verdict, without a tolerance; `Undecided` if nothing could be certified.
    pub verdict: Verdict,
    /// The least total force if the part stands; the least total adhesion if it falls and adhesion could hold it.
    pub total: Option<f64>,
    /// The largest resultant of the unique forces (the optimal forces with the least sum of squares), if the part
    /// stands. `None` if it could not be certified.
    pub largest: Option<f64>,
    /// The largest possible relative error of `total`: the duality gap, plus the residuals of both solutions.
    pub gap: f64,
}

impl Reference {
    /// Computes the true verdict, the total force and the largest force of a program, with a bound on the error of the
    /// total force.
    pub fn new(program: &Program) -> Reference {
        let unknown = Reference { verdict: Verdict::Undecided, total: None, largest: None, gap: 0.0 };
        let admissible = columns(program);
        if let Some(optimum) = optimum(&program.loads, &admissible, |c| c.cost) {
            let value = optimum.value;
            return Reference {
                verdict: Verdict::Stable,
                total: (optimum.gap <= MAX_GAP).then_some(value.near()),
                largest: largest_of_unique(program, &admissible, &optimum),
                gap: optimum.gap,
            };
        }
        let mut all = admissible;
        all.extend(adhesion_columns(program));
        let adheres = |c: &Column| if c.force.is_adhesion() { 1.0 } else { 0.0 };
        if let Some(optimum) = optimum(&program.loads, &all, adheres) {
            let largest = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let least = optimum.value.near();
            return match least > OPTIMALITY_TOL * largest {
                // The total is certainly positive if its relative error is below 1; the limit 0.5 leaves a factor of
                // 2. A small total among large forces may be known to fewer than twelve digits. Then only the verdict
                // is reported.
                true if optimum.gap < 0.5 => Reference {
                    verdict: Verdict::Unstable,
                    total: (optimum.gap <= MAX_GAP).then_some(least),
                    gap: optimum.gap,
                    ..unknown
                },
                true => unknown,
                // No adhesion is needed, but the program without adhesion has no certified optimum: the structure
                // stands exactly at its limit.
                false => Reference { verdict: Verdict::Stable, ..unknown },
            };
        }
        Reference {
            verdict: match falls_despite_adhesion(&program.loads, &all) {
                true => Verdict::Unstable,
                false => Verdict::Undecided,
            },
            ..unknown
        }
    }
}

/// True if the solver finds a motion along which the loads have power, and which not even adhesion resists.
fn falls_despite_adhesion(loads: &[f64], all: &[Column]) -> bool {
    let adheres = |c: &Column| if c.force.is_adhesion() { 1.0 } else { 0.0 };
    let solved = dual(loads, all, Conditioning::Full, &mut Effort::default(), adheres);
    let y: Vec<Double> = solved.y.iter().map(|v| Double::from(*v)).collect();
    let size = y.iter().fold(0.0, |m: f64, v| m.max(v.abs().near()));
    let violation = all.iter().map(|c| product(&entries(c), &y).near()).fold(0.0, f64::max);
    let power = power(loads, &y).near();
    let largest = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    solved.status == Status::Unbounded
        && power / largest > MIN_POWER_OVER_VIOLATION * violation
        && power > MIN_POWER * size
}
