//! [`Reference`]: what is true of a program, to twelve digits at least, with a certificate that needs no trust.
//!
//! An interior-point answer tells which columns belong to the face of optima. That guess may be wrong and costs nothing:
//! on the face, forces and velocities are systems of equations, solved here in [`Double`]s, and the answer is believed
//! only if, in the same precision, the forces balance and press, the velocities respect every column's cost, and both
//! sums agree. By duality no program whatever can then do better. Every f64 of the program is taken as exact. An exact
//! rational simplex would certify no more, and its numbers grow with the cube of the blocks.

use super::double::Double;
use super::least::largest_of_unique;
use super::skyline::Skyline;
use crate::analysis::Verdict;
use crate::program::{Column, Force, Program, columns, sticking_columns};
use crate::solve::{Choice, Conditioning, Effort, SolverSettings, Status, dual};

/// What is true of one program, pure numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// The verdict without any band; `Undecided` where nothing could be certified.
    pub verdict: Verdict,
    /// Least total force where it stands, least total sticking where it falls and sticking could hold it.
    pub total: Option<f64>,
    /// The largest resultant of the unique forces where it stands.
    pub largest: Option<f64>,
    /// How far the truth can be from `total`, relative: the gap between the sum of the forces and the bound by the
    /// velocities, and what both leave undone.
    pub gap: f64,
}

/// An optimum on its face, certified.
pub(super) struct Optimum {
    pub value: Double,
    pub gap: f64,
    /// Columns that may be used at no loss.
    pub face: Vec<usize>,
    /// Whether some robot is at its limit.
    pub limited: bool,
}

/// The relative mistake that a certificate may leave open.
///
/// The arithmetic has 32 digits, but the columns are f64: where the exact geometry leaves a choice, the rounding of its
/// columns breaks the tie by some 10⁻¹⁶, and the face as guessed is that of the geometry.
pub(super) const EXACT: f64 = 1e-13;

/// The guesses at the face: solver tolerances, and how far an amount must outweigh its slack.
const TOLERANCES: [f64; 4] = [1e-10, 1e-8, 1e-12, 1e-7];
const MARGINS: [f64; 5] = [1.0, 1e3, 1e-3, 1e6, 1e-6];

impl Reference {
    /// Finds out what is true of a program.
    pub fn new(program: &Program) -> Reference {
        let unknown = Reference {
            verdict: Verdict::Undecided,
            total: None,
            largest: None,
            gap: 0.0,
        };
        let admissible = columns(program);
        if let Some(optimum) = optimum(&program.loads, &admissible, |c| c.cost) {
            let value = optimum.value;
            return Reference {
                verdict: Verdict::Stable,
                total: (optimum.gap <= 1e-12).then_some(value.near()),
                largest: largest_of_unique(program, &admissible, &optimum),
                gap: optimum.gap,
            };
        }
        let mut all = admissible;
        all.extend(sticking_columns(program));
        let sticks = |c: &Column| if c.force.is_sticking() { 1.0 } else { 0.0 };
        if let Some(optimum) = optimum(&program.loads, &all, sticks) {
            let largest = program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let least = optimum.value.near();
            return match least > EXACT * largest {
                // A small sum of large forces is known to fall before it is known to twelve digits.
                true if optimum.gap < 0.5 => Reference {
                    verdict: Verdict::Unstable,
                    total: (optimum.gap <= 1e-12).then_some(least),
                    gap: optimum.gap,
                    ..unknown
                },
                true => unknown,
                // It stands, but no dual optimum bounds its forces: exactly on the edge.
                false => Reference {
                    verdict: Verdict::Stable,
                    ..unknown
                },
            };
        }
        Reference {
            verdict: match falls_whatever_sticks(&program.loads, &all) {
                true => Verdict::Unstable,
                false => Verdict::Undecided,
            },
            ..unknown
        }
    }
}

/// Whether there is a motion against which not even sticking can do anything.
fn falls_whatever_sticks(loads: &[f64], all: &[Column]) -> bool {
    let sticks = |c: &Column| if c.force.is_sticking() { 1.0 } else { 0.0 };
    let solved = dual(
        loads,
        all,
        Conditioning::Full,
        &mut Effort::default(),
        sticks,
    );
    let y: Vec<Double> = solved.y.iter().map(|v| Double::from(*v)).collect();
    let size = y.iter().fold(0.0, |m: f64, v| m.max(v.abs().near()));
    let violation = all
        .iter()
        .map(|c| along(&entries(c), &y).near())
        .fold(0.0, f64::max);
    let power = power(loads, &y).near();
    let largest = loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    solved.status == Status::Unbounded && power / largest > 1e6 * violation && power > 1e-9 * size
}

/// The optimum of min Σ cost·amount over balances, certified, if one of the guesses leads to it.
pub(super) fn optimum(
    loads: &[f64],
    columns: &[Column],
    cost: impl Fn(&Column) -> f64 + Copy,
) -> Option<Optimum> {
    let sparse: Vec<Vec<(usize, Double)>> = columns.iter().map(entries).collect();
    for tolerance in TOLERANCES {
        let settings = SolverSettings {
            tolerance,
            choice: Choice::Any,
            ..Conditioning::Full.into()
        };
        let solved = dual(loads, columns, settings, &mut Effort::default(), cost);
        if solved.status != Status::Solved {
            continue;
        }
        for margin in MARGINS {
            let guess = Guess {
                loads,
                columns,
                sparse: &sparse,
                costs: columns.iter().map(cost).collect(),
                active: solved.active(margin),
                amounts: &solved.amounts,
                y: &solved.y,
            };
            if let Some(optimum) = guess.certified() {
                return Some(optimum);
            }
        }
    }
    None
}

/// A guess at the face of optima.
struct Guess<'a> {
    loads: &'a [f64],
    columns: &'a [Column],
    sparse: &'a [Vec<(usize, Double)>],
    costs: Vec<f64>,
    active: Vec<bool>,
    amounts: &'a [f64],
    y: &'a [f64],
}

impl Guess<'_> {
    fn certified(&self) -> Option<Optimum> {
        let full = |j: usize| {
            self.columns[j].limit.is_finite()
                && self.amounts[j] > self.columns[j].limit * (1.0 - 1e-6)
        };
        let all = 0..self.columns.len();
        let limited: Vec<usize> = all.clone().filter(|j| full(*j)).collect();
        let face: Vec<usize> = all.filter(|j| self.active[*j] && !full(*j)).collect();
        let mut loads: Vec<Double> = self.loads.iter().map(|v| Double::from(*v)).collect();
        let most = self.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        for j in &limited {
            let limit = Double::from(self.columns[*j].limit);
            for (row, value) in &self.sparse[*j] {
                loads[*row] = loads[*row] - limit * *value;
            }
        }
        let largest = self.amounts.iter().fold(most, |m, v| m.max(*v));
        let weights: Vec<Double> = face
            .iter()
            .map(|j| Double::from((self.amounts[*j] / largest).max(1e-12)))
            .collect();
        let terms = weights
            .iter()
            .zip(&face)
            .map(|(w, j)| (*w, self.sparse[*j].as_slice()));
        let matrix = Skyline::new(loads.len(), terms);
        let mut x: Vec<Double> = face
            .iter()
            .map(|j| Double::from(self.amounts[*j]))
            .collect();
        let mut y: Vec<Double> = self.y.iter().map(|v| Double::from(*v)).collect();
        let mut rest = loads.clone();
        for _ in 0..4 {
            rest = loads.clone();
            for (j, x) in face.iter().zip(&x) {
                add(&mut rest, &self.sparse[*j], -*x);
            }
            let w = matrix.solve(&rest);
            for ((j, x), weight) in face.iter().zip(&mut x).zip(&weights) {
                *x = *x + *weight * along(&self.sparse[*j], &w);
            }
            let mut right = vec![Double::ZERO; loads.len()];
            for (j, weight) in face.iter().zip(&weights) {
                add(&mut right, &self.sparse[*j], *weight * self.slack(*j, &y));
            }
            for (y, d) in y.iter_mut().zip(matrix.solve(&right)) {
                *y = *y + d;
            }
        }
        let forces = face.iter().zip(&x).fold(Double::ZERO, |sum, (j, x)| {
            sum + Double::from(self.costs[*j]) * *x
        });
        let (mut forces, mut bound) = (forces, power(self.loads, &y));
        let speed = y.iter().fold(1.0, |m: f64, v| m.max(v.abs().near()));
        for j in &limited {
            let limit = Double::from(self.columns[*j].limit);
            forces = forces + limit * Double::from(self.costs[*j]);
            bound = bound + limit * self.slack(*j, &y);
            if self.slack(*j, &y).near() > EXACT * speed {
                return None;
            }
        }
        let balanced = rest.iter().all(|r| r.abs().near() <= EXACT * largest);
        let presses = face.iter().zip(&x).all(|(j, x)| {
            (x.near() >= -EXACT * largest || self.either_way(*j, &face))
                && x.near() <= self.columns[*j].limit
        });
        let bounded = (0..self.columns.len())
            .filter(|j| !limited.contains(j))
            .all(|j| self.slack(j, &y).near() >= -EXACT * speed);
        let scale = forces
            .near()
            .abs()
            .max(bound.near().abs())
            .max(EXACT * largest * speed);
        // Weak duality: neither side can be off by more than the gap, the dearest column's violation times all forces, and
        // what is unbalanced times the velocities.
        let violation = (0..self.columns.len())
            .filter(|j| !limited.contains(j))
            .map(|j| -self.slack(j, &y).near())
            .fold(0.0, f64::max);
        let pressed: f64 = x.iter().map(|x| x.abs().near()).sum();
        let undone: f64 = rest
            .iter()
            .zip(&y)
            .map(|(r, y)| (*r * *y).abs().near())
            .sum();
        let gap = ((forces - bound).abs().near() + violation * pressed + undone) / scale;
        let agree = gap * scale <= 10.0 * EXACT * scale.max(largest);
        (balanced && presses && bounded && agree).then_some(Optimum {
            value: forces,
            gap,
            face,
            limited: !limited.is_empty(),
        })
    }

    /// By how much a column is too dear to be used.
    fn slack(&self, j: usize, y: &[Double]) -> Double {
        Double::from(self.costs[j]) - along(&self.sparse[j], y)
    }

    /// Whether a costless column's opposite is on the face too, so that its amount may have either sign.
    fn either_way(&self, j: usize, face: &[usize]) -> bool {
        let grip = |j: usize| matches!(self.columns[j].force, Force::Grip { .. });
        let partner = |k: &usize| {
            grip(*k)
                && self.columns[*k].limit.is_infinite()
                && self.sparse[*k]
                    .iter()
                    .zip(&self.sparse[j])
                    .all(|(a, b)| a.0 == b.0 && a.1 == -b.1)
        };
        grip(j) && self.costs[j] == 0.0 && face.iter().any(partner)
    }
}

pub(super) fn entries(column: &Column) -> Vec<(usize, Double)> {
    column
        .entries()
        .map(|(row, value)| (row, Double::from(value)))
        .collect()
}

pub(super) fn along(entries: &[(usize, Double)], y: &[Double]) -> Double {
    entries
        .iter()
        .fold(Double::ZERO, |sum, (row, value)| sum + *value * y[*row])
}

pub(super) fn add(sum: &mut [Double], entries: &[(usize, Double)], amount: Double) {
    for (row, value) in entries {
        sum[*row] = sum[*row] + amount * *value;
    }
}

fn power(loads: &[f64], y: &[Double]) -> Double {
    loads
        .iter()
        .zip(y)
        .fold(Double::ZERO, |sum, (n, y)| sum + Double::from(*n) * *y)
}
