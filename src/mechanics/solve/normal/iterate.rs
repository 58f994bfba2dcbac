//! [`LinearProgram`] and [`Iterate`]: the problem that the interior-point method solves, and its current point.

use super::cholesky::Cholesky;
use super::column_groups::ColumnGroups;

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
