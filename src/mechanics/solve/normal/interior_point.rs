//! A primal-dual interior-point method on the homogeneous self-dual form. It solves linear programs, and the program of
//! the shortest velocities (least ½|y|²).
//!
//! Unknowns are amounts f ≥ 0, velocities y, slacks z ≥ 0 and the pair τ, κ ≥ 0:
//!
//! ```text
//! A f = loads·τ,   Aᵀy + z = cost·τ,   loadsᵀy − costᵀf = κ.
//! ```
//!
//! If τ > 0 at the end, f/τ and y/τ are optima. If κ > 0, y or f is a certificate that there is no optimum. The
//! quadratic program max loadsᵀy − ½|y|² always has an optimum: τ stays 1, and y is added to the left of the first
//! equation.
//!
//! Steps of each iteration: residuals, convergence test, then one Newton step ([`super::newton`]: predictor, centring,
//! corrector, step length). Two steps at the end are not in textbooks: [`InteriorPoint::restore_balance`] and
//! [`InteriorPoint::drop_non_basic`]. References: Xu, Hung and Ye 1996; Andersen and Andersen 2000 (homogeneous form);
//! Mehrotra 1992 (predictor and corrector); Gondzio 1996 (additional correctors).
//!
//! [`SlackTrend`]: predicts, before the interior-point method ends, whether the optimum will be strictly complementary.
//!
//! If it will be, the sum of the slacks of the basic columns falls in proportion to the duality gap, and faster at the
//! end. Otherwise, as in walls near their limit, this sum falls like the square root of the gap, and more iterations do
//! not separate basic columns from the others. The exponent of slack ∝ gap^exponent is computed from two iterations.

use super::cholesky::Cholesky;
use super::dense::dot;
use super::newton::Newton;
use super::residuals::{Iterate, LinearProgram, Optimality, REGULARIZATION, Residuals, STEP_TO_BOUNDARY, Termination};
use crate::clock::Instant;
use crate::mechanics::solve::settings::{CrossoverTolerance, StoppingCriteria};

/// The optimum, a certificate, or the last iterate.
pub(super) struct Solution {
    /// Whether the result is an optimum or a certificate; `None` if it is neither.
    pub termination: Option<Termination>,
    /// f, one for each column.
    pub amounts: Vec<f64>,
    /// z, one for each column.
    pub slack: Vec<f64>,
    /// y, in the order of elimination. A certificate is scaled so that loadsᵀy = 1 or costᵀf = −1.
    pub velocities: Vec<f64>,
    pub iterations: usize,
}

/// The largest number of calls to [`InteriorPoint::restore_balance`]. Each costs as much as an iteration.
const MAX_RESTORATIONS: usize = 3;

/// A column counts as clearly basic if its amount is more than this multiple of its slack.
///
/// If it were 10, non-basic columns would look basic, because centring keeps all products near μ; if it were 1000,
/// basic columns would be dropped.
const BASIC_RATIO: f64 = 100.0;

/// If τ/κ is below this, [`EXTRA_ITERATIONS`] more iterations are allowed: a certificate of infeasibility is then
/// close.
const CERTIFICATE_RATIO: f64 = 1e-4;

/// The number of iterations beyond the limit in which a certificate may still be reached.
const EXTRA_ITERATIONS: usize = 3;

/// Solves a linear program. `factor` must contain the symbolic analysis for the columns of this program.
pub(super) fn solve(lp: &LinearProgram, factor: &mut Cholesky, criteria: StoppingCriteria) -> Solution {
    let mut run = InteriorPoint::new(lp, factor);
    let (mut iterations, mut restorations) = (0, 0);
    let factor_of_tolerance = criteria.crossover.map_or(1.0, |c| c.tolerance_factor);
    let final_tolerance = factor_of_tolerance * criteria.tolerance;
    let mut trend = SlackTrend::default();
    let termination = loop {
        let optimality = Optimality::evaluate(lp, &run.at, &mut run.residuals);
        // Convergence test.
        if let Some(termination) = optimality.termination(lp, final_tolerance) {
            break Some(termination);
        }
        // Crossover: stop early if the basic columns will not become distinct from the others.
        if let Some(crossover) = criteria.crossover {
            let early = crossover.early_factor * criteria.tolerance;
            if run.is_never_complementary(&optimality, crossover, final_tolerance, &mut trend)
                && optimality.is_optimal(lp, early)
            {
                run.drop_non_basic(early);
                break Some(Termination::Optimal);
            }
        }
        // If only the balance of the loads is not met, remove its residual instead of taking another Newton step.
        let is_late = criteria.deadline.is_some_and(|end| Instant::now() >= end);
        if restorations < MAX_RESTORATIONS && optimality.lacks_only_balance(lp, final_tolerance) {
            run.restore_balance();
            restorations += 1;
            continue;
        }
        let max_iterations = if optimality.tau < CERTIFICATE_RATIO * optimality.kappa {
            criteria.iterations + EXTRA_ITERATIONS
        } else {
            criteria.iterations
        };
        let is_over = iterations >= max_iterations || is_late || !optimality.mu.is_finite();
        if is_over || !run.step(&optimality) {
            // The iterations end here. The finer tolerance of the crossover is not met, but the normal tolerance may
            // be.
            break optimality.termination(lp, criteria.tolerance);
        }
        iterations += 1;
    };
    // Scale an optimum to τ = 1, and a certificate to loadsᵀy = 1 or costᵀf = −1.
    let at = run.at;
    let scale = match termination {
        Some(Termination::PrimalInfeasible) => 1.0 / dot(lp.loads, &at.y),
        Some(Termination::Unbounded) => -1.0 / dot(lp.cost, &at.f),
        _ => 1.0 / at.tau,
    };
    let scaled = |list: Vec<f64>| -> Vec<f64> { list.into_iter().map(|v| v * scale).collect() };
    Solution { termination, amounts: scaled(at.f), slack: scaled(at.z), velocities: scaled(at.y), iterations }
}

/// A run of the method.
struct InteriorPoint<'a> {
    lp: &'a LinearProgram<'a>,
    factor: &'a mut Cholesky,
    at: Iterate,
    residuals: Residuals,
    newton: Newton,
}

impl<'a> InteriorPoint<'a> {
    fn new(lp: &'a LinearProgram<'a>, factor: &'a mut Cholesky) -> InteriorPoint<'a> {
        let (columns, unknowns) = (lp.cost.len(), lp.loads.len());
        InteriorPoint {
            at: Iterate::starting_point(lp, factor),
            lp,
            factor,
            residuals: Residuals { primal: vec![0.0; unknowns], dual: vec![0.0; columns] },
            newton: Newton::new(lp),
        }
    }

    /// Performs one Newton step. Returns false if the step is too short to make progress.
    fn step(&mut self, optimality: &Optimality) -> bool {
        let (lp, residuals) = (self.lp, &self.residuals);
        (self.newton).step(lp, self.factor, &mut self.at, residuals, optimality)
    }

    /// True if the optimum will probably not be strictly complementary: the sum of the slacks of the basic columns,
    /// relative to the cost and extrapolated to the final tolerance, exceeds `crossover.max_slack`.
    fn is_never_complementary(
        &self,
        optimality: &Optimality,
        crossover: CrossoverTolerance,
        final_tolerance: f64,
        trend: &mut SlackTrend,
    ) -> bool {
        let now = optimality.relative_to_cost(self.at.basic_slack());
        trend.extrapolate(now, final_tolerance).is_some_and(|slack| slack > crossover.max_slack)
    }

    /// Removes the primal residual by the least relative change of the amounts, min Σ (df/f)². The change is shortened
    /// if an amount would become negative.
    ///
    /// A Newton step weights the columns by f/z. Near the limit of stability these weights differ so much that a
    /// residual of 10⁻⁶ of the loads remains after every step. The amounts f differ less, so weights of f² remove the
    /// residual. This is needed only at the end, when the residual consists of rounding.
    fn restore_balance(&mut self) {
        // Solve A·F²·Aᵀ·multipliers = residual, where F is the diagonal matrix of f. The change is F²·Aᵀ·multipliers.
        let weights: Vec<f64> = self.at.f.iter().map(|f| f * f).collect();
        (self.factor).factor(self.lp.columns, &weights, REGULARIZATION);
        let mut side: Vec<[f64; 1]> = self.residuals.primal.iter().map(|v| [*v]).collect();
        self.factor.solve(&mut side);
        let multipliers: Vec<f64> = side.iter().map(|v| v[0]).collect();
        let mut changes = vec![0.0; weights.len()];
        (self.lp.columns).transpose_product(&multipliers, &mut changes);
        // Step length: all amounts must stay positive.
        let decrease = |(f, change): (&f64, &f64)| -f * change;
        let most = self.at.f.iter().zip(&changes).map(decrease);
        let step = f64::min(1.0, STEP_TO_BOUNDARY / most.fold(STEP_TO_BOUNDARY, f64::max));
        for (f, change) in self.at.f.iter_mut().zip(&changes) {
            *f += step * *f * *f * change;
        }
    }

    /// Sets to 0 the amounts of the columns that have a cost and are not clearly basic, and restores the balance.
    ///
    /// The former amounts are restored if the remaining amounts are not an optimum to the given tolerance.
    fn drop_non_basic(&mut self, tolerance: f64) {
        let former = self.at.f.clone();
        let slack = self.at.z.iter().zip(self.lp.cost);
        for (f, (z, cost)) in self.at.f.iter_mut().zip(slack) {
            if *cost > 0.0 && *f <= BASIC_RATIO * z {
                *f = 0.0;
            }
        }
        Optimality::evaluate(self.lp, &self.at, &mut self.residuals);
        self.restore_balance();
        let optimality = Optimality::evaluate(self.lp, &self.at, &mut self.residuals);
        if !optimality.is_optimal(self.lp, tolerance) {
            self.at.f = former;
        }
    }
}

/// The trend is measured once the gap, relative to the cost, is at most this. Before that, the basic columns are not
/// known.
const FIRST_GAP: f64 = 2e-6;

/// The gap must have fallen by this factor before the exponent is computed. Two points closer together would not
/// determine the exponent accurately.
const MIN_GAP_RATIO: f64 = 10.0;

/// The trend of the slack of the basic columns against the duality gap, both relative to the cost.
#[derive(Default)]
pub(super) struct SlackTrend {
    /// The gap and the slack of the first iteration whose gap is at most [`FIRST_GAP`].
    first: Option<[f64; 2]>,
}

impl SlackTrend {
    /// Takes the gap and the sum of slacks of an iteration, both relative to the cost. Returns the sum of slacks that
    /// the trend predicts at `final_gap`, or `None` if the trend is not yet known.
    pub fn extrapolate(&mut self, [gap, slack]: [f64; 2], final_gap: f64) -> Option<f64> {
        if gap > FIRST_GAP {
            return None;
        }
        let [first_gap, first_slack] = *self.first.get_or_insert([gap, slack]);
        if first_gap < MIN_GAP_RATIO * gap {
            return None;
        }
        let exponent = libm::log(first_slack / slack) / libm::log(first_gap / gap);
        Some(slack * libm::pow(final_gap / gap, exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::SlackTrend;

    #[test]
    fn a_power_law_is_extrapolated() {
        for power in [0.5, 1.0] {
            let slack = |gap: f64| 3.0 * libm::pow(gap, power);
            let mut trend = SlackTrend::default();
            for gap in [1e-3, 1e-5, 1e-6, 4e-7] {
                assert_eq!(trend.extrapolate([gap, slack(gap)], 1e-11), None, "{gap}");
            }
            for gap in [1e-7, 3e-9] {
                let expected = trend.extrapolate([gap, slack(gap)], 1e-11).unwrap();
                assert!((expected / slack(1e-11) - 1.0).abs() < 1e-9, "{gap}");
            }
        }
    }
}
