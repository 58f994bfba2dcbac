//! [`Residuals`] and [`Optimality`]: the residuals of the homogeneous form, and the convergence tests.

use super::dense::{dot, max_norm};
use super::iterate::{Iterate, LinearProgram};

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
