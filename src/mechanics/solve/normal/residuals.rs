//! [`Residuals`] and [`Optimality`]: the residuals of the homogeneous form, and the convergence tests.
//!
//! [`LinearProgram`] and [`Iterate`]: the problem that the interior-point method solves, and its current point.

use super::cholesky::Cholesky;
use super::column_groups::ColumnGroups;
use super::dense::{dot, max_norm};

/// The status with which the interior-point method ended. The primal program is the program in forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Termination {
    /// f/τ is an optimum of the program in forces, y/τ of the program in velocities.
    Optimal,
    /// No amounts balance the loads: y is a certificate, loadsᵀy > 0 and Aᵀy ≤ 0.
    PrimalInfeasible,
    /// The cost has no lower bound: f is a certificate, A f = 0 and costᵀf < 0.
    Unbounded,
}

/// A certificate of infeasibility may violate its equations by this fraction of its objective.
///
/// Forces that used this violation would have to be 10⁸ times the loads. If it were ten times larger, a wall near its
/// limit, whose thrusts are many times its loads, could be called infeasible. If it were ten times smaller, it would
/// require more digits than the normal equations have there.
const CERTIFICATE_TOL: f64 = 1e-8;

/// The residual vectors of the homogeneous form.
pub(super) struct Residuals {
    /// loads·τ − A f − velocity_weight·y.
    pub primal: Vec<f64>,
    /// cost·τ − Aᵀy − z.
    pub dual: Vec<f64>,
}

/// The numbers that the convergence tests compare, at one iterate.
pub(super) struct Optimality {
    /// κ + costᵀf − loadsᵀy, the residual of the last equation.
    pub gap: f64,
    /// μ, the mean of the products amount·slack and τκ.
    pub mu: f64,
    primal_objective: f64,
    dual_objective: f64,
    /// Largest entries of the primal residual and of A f.
    primal: [f64; 2],
    /// Largest entries of the dual residual and of Aᵀy + z.
    dual: [f64; 2],
    /// Largest amount, slack and velocity.
    size: [f64; 3],
    pub tau: f64,
    pub kappa: f64,
}

impl Optimality {
    /// Writes the residuals at an iterate into `residuals`, and returns their sizes.
    pub fn evaluate(lp: &LinearProgram, at: &Iterate, residuals: &mut Residuals) -> Optimality {
        // Primal residual: loads·τ − A f − velocity_weight·y.
        residuals.primal.fill(0.0);
        lp.columns.add_product(&at.f, &mut residuals.primal);
        let balanced = max_norm(&residuals.primal);
        let loads = lp.loads.iter().zip(&at.y);
        for (rest, (load, y)) in residuals.primal.iter_mut().zip(loads) {
            *rest = load * at.tau - *rest - lp.velocity_weight * y;
        }
        // Dual residual: cost·τ − Aᵀy − z.
        lp.columns.transpose_product(&at.y, &mut residuals.dual);
        let mut priced = 0.0f64;
        for ((rest, cost), z) in residuals.dual.iter_mut().zip(lp.cost).zip(&at.z) {
            let sum = *rest + z;
            priced = priced.max(sum.abs());
            *rest = cost * at.tau - sum;
        }
        // Objectives and gap.
        let half_square = 0.5 * lp.velocity_weight * dot(&at.y, &at.y);
        let primal_objective = dot(lp.cost, &at.f) + half_square;
        let dual_objective = dot(lp.loads, &at.y) - half_square;
        Optimality {
            gap: at.kappa + primal_objective - dual_objective,
            mu: (dot(&at.f, &at.z) + at.tau * at.kappa) / (at.f.len() + 1) as f64,
            primal_objective,
            dual_objective,
            primal: [max_norm(&residuals.primal), balanced],
            dual: [max_norm(&residuals.dual), priced],
            size: [max_norm(&at.f), max_norm(&at.z), max_norm(&at.y)],
            tau: at.tau,
            kappa: at.kappa,
        }
    }

    /// True if the amounts balance the loads to the tolerance, relative to the sum of the largest load and the largest
    /// amount, or to 1 if that sum is smaller.
    pub fn is_primal_feasible(&self, lp: &LinearProgram, tolerance: f64) -> bool {
        let f = self.size[0];
        let scale = f64::max(1.0, max_norm(lp.loads) + f / self.tau);
        self.primal[0] < tolerance * self.tau * scale
    }

    /// True if Aᵀy + z equals the costs and the two objectives are equal, both to the tolerance.
    fn is_dual_optimal(&self, lp: &LinearProgram, tolerance: f64) -> bool {
        let tau = self.tau;
        let [_, z, y] = self.size;
        let (primal, dual) = (self.primal_objective / tau, self.dual_objective / tau);
        let gap = (primal - dual).abs();
        let scale = f64::max(1.0, max_norm(lp.cost) + (y + z) / tau);
        self.dual[0] < tolerance * tau * scale && gap < tolerance * primal.abs().min(dual.abs()).max(1.0)
    }

    /// True if all conditions of an optimum hold to the tolerance.
    pub fn is_optimal(&self, lp: &LinearProgram, tolerance: f64) -> bool {
        self.is_primal_feasible(lp, tolerance) && self.is_dual_optimal(lp, tolerance)
    }

    /// True if all conditions of an optimum hold except the balance of the loads.
    pub fn lacks_only_balance(&self, lp: &LinearProgram, tolerance: f64) -> bool {
        !self.is_primal_feasible(lp, tolerance) && self.is_dual_optimal(lp, tolerance)
    }

    /// Returns the absolute gap between the two objectives, and the given sum of slacks, both divided by the absolute
    /// cost (the primal objective).
    pub fn relative_to_cost(&self, slack: f64) -> [f64; 2] {
        [self.primal_objective - self.dual_objective, slack].map(|v| v.abs() / self.primal_objective.abs())
    }

    /// Convergence test: returns whether the iterate is an optimum or a certificate; `None` if it is neither.
    pub fn termination(&self, lp: &LinearProgram, tolerance: f64) -> Option<Termination> {
        let [f, z, y] = self.size;
        if self.is_optimal(lp, tolerance) {
            return Some(Termination::Optimal);
        }
        if self.tau >= self.kappa {
            return None;
        }
        // κ exceeds τ: test the two certificates.
        let (primal, dual) = (self.primal_objective, self.dual_objective);
        if dual > 0.0 && self.dual[1] < CERTIFICATE_TOL * dual.min(y + z) {
            return Some(Termination::PrimalInfeasible);
        }
        if primal < 0.0 && self.primal[1] < CERTIFICATE_TOL * f64::min(-primal, f) {
            return Some(Termination::Unbounded);
        }
        None
    }
}

/// A number added to the diagonal of the normal equations, so that the velocity of an unsupported body has a pivot too.
///
/// The entries of the columns are near 1. If this number were ten times larger, the last steps, whose weights differ by
/// many powers of ten, would be less accurate; if it were ten times smaller, it would vanish in the rounding of a
/// diagonal entry of a thousand.
pub(super) const REGULARIZATION: f64 = 1e-12;

/// A step covers at most this fraction of the distance to the nearest bound, so that all variables stay positive.
///
/// If it were closer to 1, variables would come too close to their bounds and the next steps would be short; if it were
/// 0.9, each iteration would gain at most one digit.
pub(super) const STEP_TO_BOUNDARY: f64 = 0.99;

/// The linear program min costᵀf s.t. A f = loads, f ≥ 0, and its dual, max loadsᵀy s.t. Aᵀy + z = cost, z ≥ 0.
///
/// The objective of the dual may contain one more term, −½ velocity_weight |y|².
pub(super) struct LinearProgram<'a> {
    /// A: one column for each force.
    pub columns: &'a ColumnGroups,
    /// The cost of each column.
    pub cost: &'a [f64],
    /// The loads, in the order of elimination, as are all velocities in this module.
    pub loads: &'a [f64],
    /// The factor of the term −½|y|² of the dual: 0 for a linear program, or 1.
    pub velocity_weight: f64,
}

/// A point of the homogeneous form, or a direction: amounts f, slacks z, velocities y, and the pair τ, κ.
pub(super) struct Iterate {
    pub f: Vec<f64>,
    pub z: Vec<f64>,
    pub y: Vec<f64>,
    pub tau: f64,
    pub kappa: f64,
}

impl Iterate {
    pub fn zero(columns: usize, unknowns: usize) -> Iterate {
        Iterate { f: vec![0.0; columns], z: vec![0.0; columns], y: vec![0.0; unknowns], tau: 0.0, kappa: 0.0 }
    }

    /// Returns Mehrotra's starting point: the least-squares solutions of A f = loads and Aᵀy + z = cost, with f and z
    /// shifted until they are positive. Replaces the values of `factor` by the factor of A·Aᵀ.
    pub fn starting_point(lp: &LinearProgram, factor: &mut Cholesky) -> Iterate {
        let columns = lp.cost.len();
        factor.factor(lp.columns, &vec![1.0; columns], REGULARIZATION + lp.velocity_weight);
        // Solve for two right-hand sides at once: A·Aᵀ·multipliers = loads gives f, A·Aᵀ·y = A·cost gives y and z.
        let mut weighted_cost = vec![0.0; lp.loads.len()];
        lp.columns.add_product(lp.cost, &mut weighted_cost);
        let sides = lp.loads.iter().zip(&weighted_cost);
        let mut both: Vec<[f64; 2]> = sides.map(|(b, c)| [*b, *c]).collect();
        factor.solve(&mut both);
        let mut at = Iterate { tau: 1.0, kappa: 1.0 - lp.velocity_weight, ..Iterate::zero(columns, lp.loads.len()) };
        // f = Aᵀ·multipliers and z = cost − Aᵀy.
        let multipliers: Vec<f64> = both.iter().map(|v| v[0]).collect();
        lp.columns.transpose_product(&multipliers, &mut at.f);
        at.y = both.iter().map(|v| v[1]).collect();
        lp.columns.transpose_product(&at.y, &mut at.z);
        for (z, c) in at.z.iter_mut().zip(lp.cost) {
            *z = c - *z;
        }
        // Shift f and z into the interior: add one constant to all f and another constant to all z.
        for list in [&mut at.f, &mut at.z] {
            let least = list.iter().fold(f64::INFINITY, |a, b| a.min(*b));
            let mean = list.iter().filter(|v| **v > 0.0).sum::<f64>() / columns as f64;
            // The smallest variable becomes at least 1, and at least a tenth of the mean, in which negative values
            // count as 0.
            let inside = f64::max(1.0, 0.1 * mean);
            let shift = if least < inside { inside - least.min(0.0) } else { 0.0 };
            list.iter_mut().for_each(|v| *v += shift);
        }
        at
    }

    /// Returns the sum of the slacks of the basic columns, which are the columns whose amount exceeds their slack.
    pub fn basic_slack(&self) -> f64 {
        let both = self.f.iter().zip(&self.z);
        both.filter(|(f, z)| f > z).map(|(_, z)| z).sum()
    }

    /// Ratio test: returns the longest step along a direction that keeps f, z, τ and κ ≥ 0, at most
    /// 1/[`STEP_TO_BOUNDARY`].
    pub fn max_step(&self, direction: &Iterate) -> f64 {
        let pair = [(self.tau, direction.tau), (self.kappa, direction.kappa)];
        let (f, z) = (self.f.iter().zip(&direction.f), self.z.iter().zip(&direction.z));
        let mut step = shorten_step(1.0 / STEP_TO_BOUNDARY, f.chain(z));
        for (v, d) in pair {
            step = shorten_step(step, std::iter::once((&v, &d)));
        }
        step
    }

    /// Adds `step` times a direction to the iterate.
    pub fn advance(&mut self, direction: &Iterate, step: f64) {
        let lists = [(&mut self.f, &direction.f), (&mut self.z, &direction.z), (&mut self.y, &direction.y)];
        for (list, along) in lists {
            for (v, d) in list.iter_mut().zip(along) {
                *v += step * d;
            }
        }
        self.tau += step * direction.tau;
        self.kappa += step * direction.kappa;
        // The homogeneous form determines only the ratios of f, z, y, τ and κ. Rescale them before they leave the range
        // of f64.
        let size = self.tau.max(self.kappa);
        if !(1e-3..1e3).contains(&size) {
            let lists = [&mut self.f, &mut self.z, &mut self.y];
            lists.into_iter().flatten().for_each(|v| *v /= size);
            self.tau /= size;
            self.kappa /= size;
        }
    }
}

/// Returns the longest step, at most `step`, along which no value becomes negative; `pairs` are (value, change).
pub(super) fn shorten_step<'a>(mut step: f64, pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> f64 {
    for (v, d) in pairs {
        if v + step * d < 0.0 {
            step = -v / d;
        }
    }
    step
}
