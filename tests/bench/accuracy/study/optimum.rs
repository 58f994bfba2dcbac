//! [`optimum`]: computes the certified optimum of a linear program in extended precision.
//!
//! The program is min Σ cost·amount over amounts ≥ 0 (up to a limit) that balance the loads. The method is a
//! crossover from an interior-point solution with a certificate by weak duality:
//!
//! 1. An interior-point solution in f64 suggests the optimal face: the columns that an optimal solution may use. The
//!    guess may be wrong; several tolerances and thresholds are tried.
//! 2. On the face, amounts and velocities solve linear equations, which are refined in [`Double`] precision
//!    ([`Guess`]).
//! 3. The result is accepted only if, in this precision, it is primal feasible, dual feasible, and both objective
//!    values agree. By weak duality no solution can then be better.
//!
//! Reference for steps 1 and 2: Megiddo (1991), On finding primal- and dual-optimal bases. Here the face need not be
//! a basis: the least-squares refinement works on any optimal face.

use super::double::Double;
use super::skyline::Skyline;
use drystone::internals::program::{Column, Force};
use drystone::internals::solve::{Choice, Conditioning, Effort, SolverSettings, Status, least_cost};

/// A certified optimum.
pub struct Optimum {
    /// The objective value.
    pub value: Double,
    /// The largest possible relative error of the value.
    pub gap: f64,
    /// The indices of the columns of the optimal face, which may have amounts above 0. Columns at their limit are not
    /// included.
    pub face: Vec<usize>,
    /// Whether a column is at its limit. Only the columns of robots have limits.
    pub limited: bool,
}

/// Relative tolerance of the feasibility checks.
///
/// The arithmetic has 32 digits, but the columns are f64. If the exact geometry has several optima, the rounding
/// errors of the columns (about 1e-16) make one of them the only optimum. The guessed face is the face of the exact
/// geometry. Therefore the tolerance must be above these rounding errors. The gap is computed separately and counts
/// such violations, so the tolerance hides no error.
pub const OPTIMALITY_TOL: f64 = 1e-13;

/// Solver tolerances for the first guess at the face.
const GUESS_TOLERANCES: [f64; 4] = [1e-10, 1e-8, 1e-12, 1e-7];
/// A column belongs to the guessed face if its amount times a factor exceeds its reduced cost. These factors are
/// tried in this order.
const FACE_FACTORS: [f64; 5] = [1.0, 1e3, 1e-3, 1e6, 1e-6];
/// Number of steps of iterative refinement. The factorisation has 32 digits, so one step is enough for most faces.
/// Further steps help ill-conditioned faces.
const REFINEMENT_STEPS: usize = 4;
/// An amount is at its limit if its relative distance from the limit is at most this value.
const LIMIT_TOL: f64 = 1e-6;
/// The smallest weight of a column in the refinement, relative to the largest amount.
const MIN_WEIGHT: f64 = 1e-12;

/// Returns the certified optimum of a linear program; `None` if no guess at the optimal face passes the checks.
pub fn optimum(loads: &[f64], columns: &[Column], cost: impl Fn(&Column) -> f64 + Copy) -> Option<Optimum> {
    let sparse: Vec<Vec<(usize, Double)>> = columns.iter().map(entries).collect();
    for tolerance in GUESS_TOLERANCES {
        let settings = SolverSettings { tolerance, choice: Choice::Any, ..Conditioning::Full.into() };
        let solved = least_cost(loads, columns, settings, &mut Effort::default(), cost);
        if solved.status != Status::Solved {
            continue;
        }
        for margin in FACE_FACTORS {
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

/// A guess at the optimal face, with the amounts and velocities of the interior-point solution.
struct Guess<'a> {
    loads: &'a [f64],
    columns: &'a [Column],
    sparse: &'a [Vec<(usize, Double)>],
    costs: Vec<f64>,
    /// For each column, whether it belongs to the guessed face.
    active: Vec<bool>,
    amounts: &'a [f64],
    /// The velocities.
    y: &'a [f64],
}

/// The refined solution on a face.
struct Refined {
    /// The indices of the columns at their limit.
    limited: Vec<usize>,
    /// The indices of the columns of the face that are not at their limit.
    face: Vec<usize>,
    /// The amounts of the columns in `face`.
    x: Vec<Double>,
    /// The velocities.
    y: Vec<Double>,
    /// The loads that the forces leave unbalanced.
    rest: Vec<Double>,
    /// The largest load or amount: the scale of forces.
    largest: f64,
}

impl Guess<'_> {
    /// Refines the guess, and returns the optimum if it passes all checks.
    fn certified(&self) -> Option<Optimum> {
        self.checked(self.refined())
    }

    /// Refines the amounts and the velocities on the guessed optimal face.
    ///
    /// With the columns A and weights W of the face, both corrections solve systems with the same matrix A W Aᵀ: the
    /// amounts change by W Aᵀ w with A W Aᵀ w = rest, the velocities by d with A W Aᵀ d = A W · (reduced costs). The
    /// weights are the amounts, so that a small amount changes little and stays positive.
    fn refined(&self) -> Refined {
        let at_limit =
            |j: usize| self.columns[j].limit.is_finite() && self.amounts[j] > self.columns[j].limit * (1.0 - LIMIT_TOL);
        let all = 0..self.columns.len();
        let limited: Vec<usize> = all.clone().filter(|j| at_limit(*j)).collect();
        let face: Vec<usize> = all.filter(|j| self.active[*j] && !at_limit(*j)).collect();
        let loads = self.loads_with(&limited);
        let heaviest = self.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let largest = self.amounts.iter().fold(heaviest, |m, v| m.max(*v));
        let weights: Vec<Double> =
            face.iter().map(|j| Double::from((self.amounts[*j] / largest).max(MIN_WEIGHT))).collect();
        let terms = weights.iter().zip(&face).map(|(w, j)| (*w, self.sparse[*j].as_slice()));
        let matrix = Skyline::new(loads.len(), terms);
        let mut x: Vec<Double> = face.iter().map(|j| Double::from(self.amounts[*j])).collect();
        let mut y: Vec<Double> = self.y.iter().map(|v| Double::from(*v)).collect();
        let mut rest = loads.clone();
        for _ in 0..REFINEMENT_STEPS {
            rest = loads.clone();
            for (j, x) in face.iter().zip(&x) {
                add(&mut rest, &self.sparse[*j], -*x);
            }
            let w = matrix.solve(&rest);
            for ((j, x), weight) in face.iter().zip(&mut x).zip(&weights) {
                *x = *x + *weight * product(&self.sparse[*j], &w);
            }
            let mut right = vec![Double::ZERO; loads.len()];
            for (j, weight) in face.iter().zip(&weights) {
                add(&mut right, &self.sparse[*j], *weight * self.reduced_cost(*j, &y));
            }
            for (y, d) in y.iter_mut().zip(matrix.solve(&right)) {
                *y = *y + d;
            }
        }
        Refined { limited, face, x, y, rest, largest }
    }

    /// Returns the loads minus the forces of the columns at their limit. These forces are known, so they act like
    /// loads.
    fn loads_with(&self, limited: &[usize]) -> Vec<Double> {
        let mut loads: Vec<Double> = self.loads.iter().map(|v| Double::from(*v)).collect();
        for j in limited {
            let limit = Double::from(self.columns[*j].limit);
            for (row, value) in &self.sparse[*j] {
                loads[*row] = loads[*row] - limit * *value;
            }
        }
        loads
    }

    /// Checks a refined solution for primal and dual feasibility and for its duality gap. Returns `None` if a check
    /// fails.
    fn checked(&self, refined: Refined) -> Option<Optimum> {
        let Refined { limited, face, x, y, rest, largest } = refined;
        // Compute the primal objective value, Σ cost·amount, and the dual objective value: the power of the loads plus
        // Σ limit·(reduced cost) over the columns at their limit.
        let mut forces = face.iter().zip(&x).fold(Double::ZERO, |sum, (j, x)| sum + Double::from(self.costs[*j]) * *x);
        let mut bound = power(self.loads, &y);
        let speed = y.iter().fold(1.0, |m: f64, v| m.max(v.abs().near()));
        for j in &limited {
            let limit = Double::from(self.columns[*j].limit);
            forces = forces + limit * Double::from(self.costs[*j]);
            bound = bound + limit * self.reduced_cost(*j, &y);
            // A column at its limit must not have a positive reduced cost.
            if self.reduced_cost(*j, &y).near() > OPTIMALITY_TOL * speed {
                return None;
            }
        }
        // Check primal feasibility: the loads balance, and amounts lie between 0 and their limits.
        let balanced = rest.iter().all(|r| r.abs().near() <= OPTIMALITY_TOL * largest);
        let presses = face.iter().zip(&x).all(|(j, x)| {
            (x.near() >= -OPTIMALITY_TOL * largest || self.may_be_negative(*j, &face))
                && x.near() <= self.columns[*j].limit
        });
        // Check dual feasibility: no column below its limit has a negative reduced cost.
        let free = || (0..self.columns.len()).filter(|j| !limited.contains(j));
        let bounded = free().all(|j| self.reduced_cost(j, &y).near() >= -OPTIMALITY_TOL * speed);
        let scale = forces.near().abs().max(bound.near().abs()).max(OPTIMALITY_TOL * largest * speed);
        // Bound the error by weak duality: it is at most the difference of both objective values, plus the largest
        // dual violation times the sum of all amounts, plus the unbalanced forces times the velocities.
        let violation = free().map(|j| -self.reduced_cost(j, &y).near()).fold(0.0, f64::max);
        let total: f64 = x.iter().map(|x| x.abs().near()).sum();
        let unbalanced: f64 = rest.iter().zip(&y).map(|(r, y)| (*r * *y).abs().near()).sum();
        let gap = ((forces - bound).abs().near() + violation * total + unbalanced) / scale;
        let agree = gap * scale <= 10.0 * OPTIMALITY_TOL * scale.max(largest);
        (balanced && presses && bounded && agree).then_some(Optimum {
            value: forces,
            gap,
            face,
            limited: !limited.is_empty(),
        })
    }

    /// Returns the reduced cost of column `j`: its cost minus the power of its unit force at the velocities `y`.
    fn reduced_cost(&self, j: usize, y: &[Double]) -> Double {
        Double::from(self.costs[j]) - product(&self.sparse[j], y)
    }

    /// True if column `j` may have a negative amount. This holds for a column of a grip without cost if the column of
    /// the opposite force is on the face and has no limit: only the difference of the two amounts matters.
    fn may_be_negative(&self, j: usize, face: &[usize]) -> bool {
        let grip = |j: usize| matches!(self.columns[j].force, Force::Grip { .. });
        let partner = |k: &usize| {
            grip(*k)
                && self.columns[*k].limit.is_infinite()
                && self.sparse[*k].iter().zip(&self.sparse[j]).all(|(a, b)| a.0 == b.0 && a.1 == -b.1)
        };
        grip(j) && self.costs[j] == 0.0 && face.iter().any(partner)
    }
}

/// Returns the nonzero entries of a column as pairs of row and value, in extended precision.
pub fn entries(column: &Column) -> Vec<(usize, Double)> {
    column.entries().map(|(row, value)| (row, Double::from(value))).collect()
}

/// Returns the dot product of a sparse column and a vector.
pub fn product(entries: &[(usize, Double)], y: &[Double]) -> Double {
    entries.iter().fold(Double::ZERO, |sum, (row, value)| sum + *value * y[*row])
}

/// Adds a multiple of a sparse column to a vector.
pub fn add(sum: &mut [Double], entries: &[(usize, Double)], amount: Double) {
    for (row, value) in entries {
        sum[*row] = sum[*row] + amount * *value;
    }
}

/// Returns the power of the loads at the velocities `y`: their dot product.
pub fn power(loads: &[f64], y: &[Double]) -> Double {
    loads.iter().zip(y).fold(Double::ZERO, |sum, (n, y)| sum + Double::from(*n) * *y)
}
