//! An interior-point method for least-squares programs of forces whose amounts have lower bounds. The quadratic
//! objective of such a program has a block-diagonal matrix.
//!
//! ```text
//! min ½ xᵀPx + linearᵀx   s.t.   A x = loads,   s = x + floor ≥ 0,   multipliers z ≥ 0 of the bounds
//! ```
//!
//! P couples only the few columns of one contact. The method is Mehrotra's predictor and corrector (Nocedal and Wright,
//! Numerical Optimization, 2006, section 16.6). Each step solves A·W·Aᵀ·dy = right-hand side with W = (P + Z/S)⁻¹,
//! which has one small block for each contact. With P + Z/S = L·Lᵀ and B = A·L⁻ᵀ, this matrix is B·Bᵀ. It is therefore
//! factored by the same code as that of a linear program, with the columns of B and weights of 1.
//!
//! The amounts x and their distances s from the bounds are separate variables. Otherwise, for an amount far above its
//! bound, a small change of x would be lost in the rounding of s.

use super::cholesky::Cholesky;
use super::column_groups::ColumnGroups;
use super::dense::{
    BlockDiagonal, MAX_BLOCK_COLUMNS, backward_substitute, cholesky_in_place, dot, forward_substitute, max_norm,
};
use super::residuals::{REGULARIZATION, STEP_TO_BOUNDARY, shorten_step};
use crate::clock::Instant;
use crate::mechanics::program::QuadraticProgram;
use crate::mechanics::solve::answer::{Answer, Status};
use crate::mechanics::solve::settings::StoppingCriteria;

/// The duality gap is reduced to this fraction of the tolerance, if that can be reached.
///
/// The error of a force is about the square root of the gap: a gap of 10⁻⁹ leaves relative errors of about 10⁻⁵. One or
/// two more steps cost little.
const GAP_FACTOR: f64 = 1e-3;

/// A step shorter than this counts as a step without progress.
const SHORT_STEP: f64 = 0.1;

/// A step longer than this counts as a step without progress if more than [`STALLED_SHARE`] of the primal residual
/// remains.
///
/// A step of this length usually leaves a third of the residual.
const LONG_STEP: f64 = 0.8;

/// If more than this fraction of the primal residual remains, a long step has made no progress.
const STALLED_SHARE: f64 = 0.8;

/// The method stops after this number of steps without progress in succession: probably no amounts balance the loads.
const MAX_IDLE_STEPS: usize = 3;

/// Solves a least-squares program of forces whose amounts have lower bounds. `None` if the program has another form, or
/// if the method ends without an optimum.
///
/// The method also solves long chains of blocks, such as an arch of 10 000 stones, whose thrust is thousands of times a
/// stone's weight. For this arch, clarabel wrongly reports that the problem is infeasible.
pub(super) fn solve(problem: &QuadraticProgram, criteria: StoppingCriteria) -> Option<Answer> {
    if !has_only_floors(problem) {
        return None;
    }
    let tolerance = criteria.tolerance;
    let mut run = BlockQp::new(BlockDiagonal::quadratic_of(problem)?, problem)?;
    run.set_starting_point();
    // Iterate until the duality gap meets a finer tolerance. If the iterations end before that, it is enough to meet
    // the normal tolerance.
    let (mut iterations, mut idle_steps) = (0, 0);
    while !run.is_optimal(tolerance, GAP_FACTOR * tolerance) {
        let is_late = criteria.deadline.is_some_and(|end| Instant::now() >= end);
        if iterations == criteria.iterations || is_late || idle_steps == MAX_IDLE_STEPS {
            if run.is_optimal(tolerance, tolerance) {
                break;
            }
            return None;
        }
        // Count consecutive steps without progress: short steps, and long steps after which most of the residual
        // remains.
        let former = max_norm(&run.residuals.primal);
        let step = run.step();
        let is_stalled = max_norm(&run.residuals.primal) > STALLED_SHARE * former;
        let is_in_vain = step > LONG_STEP && is_stalled && !run.is_balanced(tolerance);
        idle_steps = if step < SHORT_STEP || is_in_vain { idle_steps + 1 } else { 0 };
        if !run.mu().is_finite() {
            return None;
        }
        iterations += 1;
    }
    // Return the variables in the order and with the signs of the problem.
    let y = run.factor.to_program_order(&run.y);
    Some(Answer {
        status: Status::Solved,
        z: y.iter().map(|v| -v).chain(run.z).collect(),
        s: vec![0.0; y.len()].into_iter().chain(run.s).collect(),
        x: run.x,
        iterations,
    })
}

/// True if the rows of a problem are the equilibrium equations and exactly one lower bound for each column, and if
/// there are at least as many columns as equations.
fn has_only_floors(problem: &QuadraticProgram) -> bool {
    let n = problem.unknowns;
    let is_floor = |(row, column, value): &(usize, usize, f64)| *row - problem.equalities == *column && *value == -1.0;
    let mut below = problem.matrix.iter().filter(|e| e.0 >= problem.equalities);
    // With fewer columns than equations, the forces can rarely balance the loads. Leave such a problem to clarabel,
    // which detects within two iterations that there is no balance.
    problem.equalities != 0
        && n >= problem.equalities
        && problem.bound.len() == problem.equalities + n
        && below.all(is_floor)
}

/// A run of the method.
struct BlockQp {
    quadratic: BlockDiagonal,
    /// A, with the unknowns in the order of elimination.
    columns: ColumnGroups,
    /// B = A·L⁻ᵀ, whose columns have a weight of 1.
    whitened: ColumnGroups,
    factor: Cholesky,
    ones: Vec<f64>,
    /// The Cholesky factor L of each block of P + Z/S, in the lower triangle.
    lower: Vec<f64>,
    loads: Vec<f64>,
    linear: Vec<f64>,
    floor: Vec<f64>,
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    z: Vec<f64>,
    residuals: Residuals,
}

/// The residuals of the optimality conditions at the iterate.
struct Residuals {
    /// loads − A x.
    primal: Vec<f64>,
    /// Aᵀy + z − Px − linear.
    dual: Vec<f64>,
    /// x + floor − s.
    bound: Vec<f64>,
    /// The largest absolute entries of A x, of P x and of Aᵀy, with which the residuals are compared.
    size: [f64; 3],
}

/// A search direction: the changes of x, y, s and z.
struct Direction {
    x: Vec<f64>,
    y: Vec<f64>,
    s: Vec<f64>,
    z: Vec<f64>,
}

impl BlockQp {
    fn new(quadratic: BlockDiagonal, problem: &QuadraticProgram) -> Option<BlockQp> {
        let n = problem.unknowns;
        let balance = problem
            .matrix
            .iter()
            .filter(|e| e.0 < problem.equalities)
            .map(|(row, column, value)| (*column, *row, *value));
        let mut columns = ColumnGroups::with_groups(problem.equalities, &quadratic.blocks, balance);
        if columns.max_entries() > super::MAX_COLUMN_ENTRIES {
            return None;
        }
        let factor = Cholesky::new(&mut columns)?;
        let (loads, floor) = problem.bound.split_at(problem.equalities);
        Some(BlockQp {
            lower: vec![0.0; quadratic.entries.len()],
            quadratic,
            whitened: columns.clone(),
            ones: vec![1.0; n],
            loads: factor.to_elimination_order(loads),
            factor,
            linear: problem.linear.clone(),
            floor: floor.to_vec(),
            x: vec![0.0; n],
            y: vec![0.0; problem.equalities],
            s: vec![1.0; n],
            z: vec![1.0; n],
            residuals: Residuals {
                primal: vec![0.0; problem.equalities],
                dual: vec![0.0; n],
                bound: vec![0.0; n],
                size: [0.0; 3],
            },
            columns,
        })
    }

    /// Sets the starting point: x is the least-squares solution without bounds, s is at least the mean of |x|, and each
    /// product s·z is the square of this mean.
    fn set_starting_point(&mut self) {
        self.factor_system();
        let mut side: Vec<[f64; 1]> = self.loads.iter().map(|v| [*v]).collect();
        self.factor.solve(&mut side);
        self.y = side.iter().map(|v| v[0]).collect();
        self.columns.transpose_product(&self.y, &mut self.x);
        let mut x = std::mem::take(&mut self.x);
        self.apply_weight(&mut x);
        self.x = x;
        // Choose s and z in the interior: each product s·z is the square of the mean of |x|.
        let mean = self.x.iter().map(|x| x.abs()).sum::<f64>() / self.x.len().max(1) as f64;
        let inside = if mean > 0.0 { mean } else { 1.0 };
        for k in 0..self.x.len() {
            self.s[k] = f64::max(self.x[k] + self.floor[k], inside);
            self.z[k] = inside * (inside / self.s[k]);
        }
        self.update_residuals();
    }

    /// Recomputes all residuals at the iterate.
    fn update_residuals(&mut self) {
        let residuals = &mut self.residuals;
        residuals.primal.fill(0.0);
        self.columns.add_product(&self.x, &mut residuals.primal);
        let balanced = max_norm(&residuals.primal);
        for (rest, load) in residuals.primal.iter_mut().zip(&self.loads) {
            *rest = load - *rest;
        }
        self.quadratic.multiply(&self.x, &mut residuals.dual);
        let squared = max_norm(&residuals.dual);
        // `residuals.bound` is a buffer for Aᵀy until the loop below.
        (self.columns).transpose_product(&self.y, &mut residuals.bound);
        residuals.size = [balanced, squared, max_norm(&residuals.bound)];
        for k in 0..self.x.len() {
            residuals.dual[k] = residuals.bound[k] + self.z[k] - residuals.dual[k] - self.linear[k];
            residuals.bound[k] = (self.x[k] - self.s[k]) + self.floor[k];
        }
    }

    /// Returns μ, the mean of the products s·z.
    fn mu(&self) -> f64 {
        dot(&self.s, &self.z) / self.s.len().max(1) as f64
    }

    /// True if the largest entry of the primal residual is at most `tolerance` · max(1, largest entry of A x), in
    /// absolute values.
    fn is_balanced(&self, tolerance: f64) -> bool {
        max_norm(&self.residuals.primal) <= tolerance * f64::max(1.0, self.residuals.size[0])
    }

    /// True if every residual is at most `tolerance`, relative to its terms, and the duality gap Σ s·z is at most
    /// `gap` · max(1, |objective|).
    fn is_optimal(&self, tolerance: f64, gap: f64) -> bool {
        let [_, squared, along] = self.residuals.size;
        let is_small = |list: &[f64], of: f64| max_norm(list) <= tolerance * f64::max(1.0, of);
        let mut product = vec![0.0; self.x.len()];
        self.quadratic.multiply(&self.x, &mut product);
        let objective = 0.5 * dot(&self.x, &product) + dot(&self.linear, &self.x);
        self.is_balanced(tolerance)
            && is_small(&self.residuals.dual, squared.max(along))
            && is_small(&self.residuals.bound, max_norm(&self.x))
            && dot(&self.s, &self.z) <= gap * f64::max(1.0, objective.abs())
    }

    /// Factors P + Z/S block by block, then the matrix of the normal equations.
    fn factor_system(&mut self) {
        for (k, block) in self.quadratic.blocks.iter().enumerate() {
            let (width, range) = (block.len(), self.quadratic.range(k));
            let lower = &mut self.lower[range.clone()];
            lower.copy_from_slice(&self.quadratic.entries[range]);
            for (i, at) in block.clone().enumerate() {
                lower[i * width + i] += self.z[at] / self.s[at];
            }
            cholesky_in_place(lower, width);
            // Transform each row of the group's columns by L⁻¹.
            let rows = self.columns.group(k).rows.len();
            let values = self.columns.group(k).values;
            let whitened = self.whitened.values_mut(k);
            for r in 0..rows {
                let mut row = [0.0; MAX_BLOCK_COLUMNS];
                for (v, column) in row.iter_mut().zip(values.chunks_exact(rows)) {
                    *v = column[r];
                }
                forward_substitute(lower, width, &mut row[..width]);
                for (v, column) in row.iter().zip(whitened.chunks_exact_mut(rows)) {
                    column[r] = *v;
                }
            }
        }
        (self.factor).factor(&self.whitened, &self.ones, REGULARIZATION);
    }

    /// Replaces a list by W·list, where W = (P + Z/S)⁻¹.
    fn apply_weight(&self, list: &mut [f64]) {
        for (k, block) in self.quadratic.blocks.iter().enumerate() {
            let lower = &self.lower[self.quadratic.range(k)];
            let own = &mut list[block.clone()];
            forward_substitute(lower, block.len(), own);
            backward_substitute(lower, block.len(), own);
        }
    }

    /// Computes the Newton direction along which, to first order, each product s·z changes by its entry of `target`. A
    /// full step removes the fraction `residual_share` of the residuals.
    fn direction(&self, target: &[f64], residual_share: f64) -> Direction {
        let n = self.x.len();
        // Elimination of ds and dz: (P + Z/S) dx = Aᵀdy + side.
        let side: Vec<f64> = (0..n)
            .map(|k| {
                let (s, z) = (self.s[k], self.z[k]);
                residual_share * self.residuals.dual[k] + (target[k] - residual_share * z * self.residuals.bound[k]) / s
            })
            .collect();
        // Elimination of dx: the normal equations A·W·Aᵀ dy = residual − A·W·side.
        let mut weighted = side.clone();
        self.apply_weight(&mut weighted);
        let mut sum = vec![0.0; self.loads.len()];
        self.columns.add_product(&weighted, &mut sum);
        let primal = self.residuals.primal.iter().zip(&sum);
        let mut right: Vec<[f64; 1]> = primal.map(|(rest, sum)| [residual_share * rest - sum]).collect();
        self.factor.solve(&mut right);
        // Back substitution: dx, then ds and dz.
        let y: Vec<f64> = right.iter().map(|v| v[0]).collect();
        let mut x = vec![0.0; n];
        self.columns.transpose_product(&y, &mut x);
        x.iter_mut().zip(&side).for_each(|(x, r)| *x += r);
        self.apply_weight(&mut x);
        let s: Vec<f64> = x.iter().zip(&self.residuals.bound).map(|(x, rest)| x + residual_share * rest).collect();
        let z = (0..n).map(|k| (target[k] - self.z[k] * s[k]) / self.s[k]);
        Direction { z: z.collect(), x, y, s }
    }

    /// Ratio test: returns the longest step that keeps s and z ≥ 0, at most 1/[`STEP_TO_BOUNDARY`].
    fn max_step(&self, along: &Direction) -> f64 {
        let (s, z) = (self.s.iter().zip(&along.s), self.z.iter().zip(&along.z));
        shorten_step(1.0 / STEP_TO_BOUNDARY, s.chain(z))
    }

    /// Performs one iteration and returns its step length.
    fn step(&mut self) -> f64 {
        self.factor_system();
        // Predictor (affine scaling).
        let products = self.s.iter().zip(&self.z);
        let mut target: Vec<f64> = products.map(|(s, z)| -s * z).collect();
        let predictor = self.direction(&target, 1.0);
        // Centring: σ = (1 − predictor's step length)³.
        let short = 1.0 - self.max_step(&predictor).min(1.0);
        let sigma = short * short * short;
        let centre = sigma * self.mu();
        // Corrector: the predictor's second-order error ds·dz is subtracted from each product.
        for (k, target) in target.iter_mut().enumerate() {
            *target += centre - predictor.s[k] * predictor.z[k];
        }
        let along = self.direction(&target, 1.0 - sigma);
        // The step length is the same for all variables and ends a little before the nearest bound.
        let step = f64::min(STEP_TO_BOUNDARY * self.max_step(&along), 1.0);
        let lists =
            [(&mut self.x, &along.x), (&mut self.y, &along.y), (&mut self.s, &along.s), (&mut self.z, &along.z)];
        for (list, along) in lists {
            list.iter_mut().zip(along).for_each(|(v, d)| *v += step * d);
        }
        self.update_residuals();
        step
    }
}
