//! [`Newton`]: one iteration of the interior-point method, with predictor, corrector and Gondzio's additional
//! correctors.
//!
//! Newton's equations for a direction (df, dy, dz, dτ, dκ) follow. Here r are the residuals, η is the fraction of the
//! residuals to remove, and w is [`LinearProgram::velocity_weight`].
//!
//! ```text
//! A df + w dy − loads dτ = η r_primal        z df + f dz = target
//! Aᵀdy + dz − cost dτ    = η r_dual          κ dτ + τ dκ = target of the pair
//! costᵀdf − loadsᵀdy + dκ = −η gap
//! ```
//!
//! Elimination of dz and df leaves (A·W·Aᵀ + w·1) dy = right-hand side with W = f/z. All directions of an iteration use
//! the same factor. A second right-hand side, which is solved together with that of the predictor, yields the change of
//! the other unknowns per unit of dτ (`tau_direction`). The last of Newton's equations then determines dτ.

use super::cholesky::Cholesky;
use super::dense::dot;
use super::residuals::{Iterate, LinearProgram, Optimality, REGULARIZATION, Residuals, STEP_TO_BOUNDARY};

/// The largest number of Gondzio correctors for a direction.
///
/// Walls near their limit take 82, 77, 69 and 82 iterations with 1, 2, 3 and 5 correctors; without any they do not
/// converge in 100 iterations.
const MAX_CORRECTORS: usize = 3;

/// A corrector aims at a step that is longer by this amount (Gondzio's δ).
///
/// If it were larger, the products would miss their targets by more; if it were smaller, the gain would not be worth
/// another solve.
const STEP_INCREASE: f64 = 0.3;

/// A corrector is accepted if it makes the step longer by at least this fraction of [`STEP_INCREASE`].
const MIN_SHARE_OF_INCREASE: f64 = 0.1;

/// Products amount·slack between μ divided by this factor and μ times this factor need no correction (Gondzio's β).
const CENTRALITY_BAND: f64 = 10.0;

/// If a step is shorter than this, the method makes no progress and stops.
const MIN_STEP: f64 = 1e-6;

/// Directions and buffers of an iteration.
pub(super) struct Newton {
    /// W = f/z, one weight for each column.
    weight: Vec<f64>,
    /// The change of the iterate per unit of dτ.
    tau_direction: Iterate,
    /// The best direction so far.
    direction: Iterate,
    /// The direction that was computed last.
    candidate: Iterate,
    /// The change of each product amount·slack, to first order, at which the last direction aims.
    target: Vec<f64>,
    next_target: Vec<f64>,
    /// The right-hand side η r_dual − target/f after the elimination of dz.
    slack_side: Vec<f64>,
}

/// The right-hand sides of Newton's equations for a direction, apart from the targets of the products amount·slack.
#[derive(Clone, Copy)]
struct Sides {
    /// η: the fraction of the residuals to be removed.
    residual_share: f64,
    /// The change of τκ, to first order.
    pair: f64,
}

impl Newton {
    pub fn new(lp: &LinearProgram) -> Newton {
        let (columns, unknowns) = (lp.cost.len(), lp.loads.len());
        Newton {
            weight: vec![0.0; columns],
            tau_direction: Iterate::zero(columns, unknowns),
            direction: Iterate::zero(columns, unknowns),
            candidate: Iterate::zero(columns, unknowns),
            target: vec![0.0; columns],
            next_target: vec![0.0; columns],
            slack_side: vec![0.0; columns],
        }
    }

    /// Performs one iteration. Returns false if the step is too short to make progress.
    pub fn step(
        &mut self,
        lp: &LinearProgram,
        factor: &mut Cholesky,
        at: &mut Iterate,
        residuals: &Residuals,
        optimality: &Optimality,
    ) -> bool {
        // 1 for a linear program; 0 for a quadratic program, in which τ stays 1.
        let is_homogeneous = 1.0 - lp.velocity_weight;
        // Compute the weights at this iterate, and factor the matrix of the normal equations.
        for (weight, (f, z)) in self.weight.iter_mut().zip(at.f.iter().zip(&at.z)) {
            *weight = f / z;
        }
        factor.factor(lp.columns, &self.weight, REGULARIZATION + lp.velocity_weight);
        let mut system = System { lp, factor, residuals, gap: optimality.gap, pivot: 0.0 };

        // Predictor (affine scaling): the direction that aims at zero residuals and zero products.
        for (target, (f, z)) in self.target.iter_mut().zip(at.f.iter().zip(&at.z)) {
            *target = -f * z;
        }
        let mut sides = Sides { residual_share: 1.0, pair: -at.tau * at.kappa };
        self.predict(&mut system, at, sides);

        // Centring: the target of every product is σμ, with σ = (1 − predictor's step length)³.
        let short = 1.0 - at.max_step(&self.direction).min(1.0);
        let sigma = short * short * short;
        let centre = sigma * optimality.mu;

        // Corrector: the predictor's second-order error in each product is subtracted.
        let pair = centre + sides.pair - self.direction.tau * self.direction.kappa;
        sides = Sides { residual_share: 1.0 - sigma, pair: is_homogeneous * pair };
        let changes = self.direction.f.iter().zip(&self.direction.z);
        for (target, (f, z)) in self.target.iter_mut().zip(changes) {
            *target += centre - f * z;
        }
        self.solve_candidate(&system, at, sides);
        std::mem::swap(&mut self.direction, &mut self.candidate);
        let max_step = self.correct_centrality(&system, at, sides, centre);

        // The step length is the same for all variables, as the homogeneous form requires.
        let step = f64::min(STEP_TO_BOUNDARY * max_step, 1.0);
        at.advance(&self.direction, step);
        step > MIN_STEP
    }

    /// Applies Gondzio's correctors, which correct the products amount·slack that a longer step would move away from
    /// the centre.
    ///
    /// Improves `direction`, and returns the longest step along the improved direction.
    fn correct_centrality(&mut self, system: &System, at: &Iterate, mut sides: Sides, centre: f64) -> f64 {
        let mut max_step = at.max_step(&self.direction);
        for _ in 0..MAX_CORRECTORS {
            // The step is close enough to a full step, so no corrector is needed.
            if max_step > 1.0 - MIN_SHARE_OF_INCREASE * STEP_INCREASE {
                break;
            }
            // Aim at a longer step: correct the products that would leave the band around the centre.
            let aim = f64::min(max_step + STEP_INCREASE, 1.0);
            let pair = (1.0 - system.lp.velocity_weight) * self.recentre(at, aim, centre);
            std::mem::swap(&mut self.target, &mut self.next_target);
            let next = Sides { pair: sides.pair + pair, ..sides };
            self.solve_candidate(system, at, next);
            // Accept the corrector only if it makes the step longer.
            let step = at.max_step(&self.candidate);
            if step < max_step + MIN_SHARE_OF_INCREASE * STEP_INCREASE {
                break;
            }
            std::mem::swap(&mut self.direction, &mut self.candidate);
            (max_step, sides) = (step, next);
        }
        max_step
    }

    /// Writes into `next_target` the changes of the products amount·slack at which a corrector aims. Returns the
    /// correction of the product τκ.
    ///
    /// A product that a step of length `step` would move out of the band around `centre` is corrected to the nearest
    /// end of the band. A correction decreases a product by at most `CENTRALITY_BAND`·`centre`.
    fn recentre(&mut self, at: &Iterate, step: f64, centre: f64) -> f64 {
        let correction = |v: f64, dv: f64, w: f64, dw: f64| {
            let product = (v + step * dv) * (w + step * dw);
            f64::max(
                product.clamp(centre / CENTRALITY_BAND, CENTRALITY_BAND * centre) - product,
                -CENTRALITY_BAND * centre,
            )
        };
        let by = &self.direction;
        for (k, next) in self.next_target.iter_mut().enumerate() {
            *next = self.target[k] + correction(at.f[k], by.f[k], at.z[k], by.z[k]);
        }
        correction(at.tau, by.tau, at.kappa, by.kappa)
    }

    /// Computes the predictor direction. The linear system is solved at the same time for another right-hand side,
    /// which yields `tau_direction` and the pivot of dτ.
    fn predict(&mut self, system: &mut System, at: &Iterate, sides: Sides) {
        let lp = system.lp;
        let mut tau_side = lp.loads.to_vec();
        let weighted_cost = self.weight.iter().zip(lp.cost);
        for (side, (weight, cost)) in self.slack_side.iter_mut().zip(weighted_cost) {
            *side = weight * cost;
        }
        lp.columns.add_product(&self.slack_side, &mut tau_side);
        let side = self.velocity_side(system, at, sides);
        let mut both: Vec<[f64; 2]> = tau_side.iter().zip(&side).map(|(a, b)| [*a, *b]).collect();
        system.factor.solve(&mut both);

        // From the solution for the first right-hand side, compute the changes of velocities and amounts per unit of
        // dτ, and the pivot of dτ.
        let part = &mut self.tau_direction;
        part.y.iter_mut().zip(&both).for_each(|(y, v)| *y = v[0]);
        lp.columns.transpose_product(&part.y, &mut part.f);
        let weighted = self.weight.iter().zip(lp.cost);
        for (f, (weight, cost)) in part.f.iter_mut().zip(weighted) {
            *f = weight * (*f - cost);
        }
        system.pivot = dot(lp.loads, &part.y) - dot(lp.cost, &part.f) + at.kappa / at.tau;

        // The solution for the second right-hand side contains the velocities of the predictor.
        let velocities = self.candidate.y.iter_mut().zip(&both);
        velocities.for_each(|(y, v)| *y = v[1]);
        self.complete_candidate(system, at, sides);
        std::mem::swap(&mut self.direction, &mut self.candidate);
    }

    /// Solves Newton's equations for the given right-hand sides with the factor of this iteration. Writes the direction
    /// into `candidate`.
    fn solve_candidate(&mut self, system: &System, at: &Iterate, sides: Sides) {
        let side = self.velocity_side(system, at, sides);
        let mut side: Vec<[f64; 1]> = side.into_iter().map(|v| [v]).collect();
        system.factor.solve(&mut side);
        let velocities = self.candidate.y.iter_mut().zip(&side);
        velocities.for_each(|(y, v)| *y = v[0]);
        self.complete_candidate(system, at, sides);
    }

    /// Returns the right-hand side of the normal equations. Stores in `slack_side` the numbers that
    /// [`Self::complete_candidate`] needs.
    fn velocity_side(&mut self, system: &System, at: &Iterate, sides: Sides) -> Vec<f64> {
        let (residuals, share) = (system.residuals, sides.residual_share);
        for (k, side) in self.slack_side.iter_mut().enumerate() {
            *side = share * residuals.dual[k] - self.target[k] / at.f[k];
        }
        let mut side: Vec<f64> = residuals.primal.iter().map(|v| share * v).collect();
        let weighted = self.weight.iter().zip(&self.slack_side);
        let weighted: Vec<f64> = weighted.map(|(w, r)| w * r).collect();
        system.lp.columns.add_product(&weighted, &mut side);
        side
    }

    /// Back substitution: computes dτ, then the amounts, slacks and κ that belong to the velocities of `candidate`.
    fn complete_candidate(&mut self, system: &System, at: &Iterate, sides: Sides) {
        let lp = system.lp;
        let (tau_part, to) = (&self.tau_direction, &mut self.candidate);
        lp.columns.transpose_product(&to.y, &mut to.f);
        for (f, (weight, side)) in to.f.iter_mut().zip(self.weight.iter().zip(&self.slack_side)) {
            *f = weight * (*f - side);
        }
        // Compute dτ from the last of Newton's equations.
        let gap = sides.residual_share * system.gap - dot(lp.loads, &to.y) + dot(lp.cost, &to.f) + sides.pair / at.tau;
        to.tau = (1.0 - lp.velocity_weight) * gap / system.pivot;
        // Add to dy and df the part that is proportional to dτ. Compute dz from the linearised product.
        for (y, part) in to.y.iter_mut().zip(&tau_part.y) {
            *y += part * to.tau;
        }
        for (k, f) in to.f.iter_mut().enumerate() {
            *f += tau_part.f[k] * to.tau;
            to.z[k] = (self.target[k] - at.z[k] * *f) / at.f[k];
        }
        to.kappa = (sides.pair - at.kappa * to.tau) / at.tau;
    }
}

/// The data that all directions of an iteration share.
struct System<'a> {
    lp: &'a LinearProgram<'a>,
    factor: &'a Cholesky,
    residuals: &'a Residuals,
    gap: f64,
    /// The coefficient of dτ after all other unknowns are eliminated.
    pivot: f64,
}
