//! The rest of springs by Newton's method between patterns of pressing and sliding, with continuation in the ground's stiffness.

use super::band::Band;
use super::spring::{Pattern, Rest, Springs};

/// Newton steps at one stiffness of the ground, and how many of them are full steps.
const MAX_STEPS: usize = 60;
const FULL_STEPS: usize = 15;

/// The shares of a step that the line search tries.
const STEP_SHARES: [f64; 6] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.01];

/// How often the springs to the ground soften, and the factor each time: down to 0.3²¹ ≈ 1e-11 of a point's stiffness.
const MAX_SOFTENINGS: usize = 22;
const SOFTENING_FACTOR: f64 = 0.3;

impl Springs<'_> {
    /// The displacements at which springs of this stiffness give the `forces` that the blocks need.
    pub(super) fn displacements(&self, stiffness: &Band, forces: &[f64]) -> Vec<f64> {
        let mut right = vec![0.0; forces.len()];
        for (row, value) in forces.iter().enumerate() {
            right[self.row(row)] = -value;
        }
        let found = stiffness.solve(&right);
        (0..forces.len()).map(|row| found[self.row(row)]).collect()
    }

    /// The forces that springs must give: what the blocks need, less the given forces of robots' springs and the limits of
    /// robots at theirs.
    fn spring_loads(&self, pattern: &Pattern) -> Vec<f64> {
        let mut loads = self.program.loads.clone();
        for (grip, limit) in self.grips.iter().zip(&pattern.limits) {
            let given = if *limit == 0.0 {
                grip.given
            } else {
                limit * grip.limit
            };
            grip.column.add_to(&mut loads, -given);
        }
        loads
    }

    /// The norm of what springs, and springs of stiffness `ground` to the ground, leave unbalanced at given displacements.
    fn residual_norm(&self, u: &[f64], ground: f64) -> f64 {
        let mut residual = self.program.loads.clone();
        for grip in &self.grips {
            let force = (grip.given - grip.column.dot(u)).clamp(-grip.limit, grip.limit);
            grip.column.add_to(&mut residual, -force);
        }
        let mut normal = vec![0.0; self.tangents.len()];
        for point in &self.points {
            let force = (-point.column.dot(u)).max(0.0);
            normal[point.contact] += force;
            point.column.add_to(&mut residual, -force);
        }
        for (k, tangent) in self.tangents.iter().enumerate() {
            let limit = self.program.contacts[k].friction * normal[k];
            let force = (-self.along * tangent.dot(u)).clamp(-limit, limit);
            tangent.add_to(&mut residual, -force);
        }
        let sum: f64 = residual
            .iter()
            .zip(u)
            .map(|(r, u)| (r + ground * u) * (r + ground * u))
            .sum();
        sum.sqrt()
    }

    /// Equilibrium with springs of stiffness `ground` to the ground, from given displacements and their pattern. Updates both
    /// and returns true if it was found.
    ///
    /// Newton's method: a pattern makes the law linear, the displacements that solve it make the next pattern. If the same
    /// pattern comes out, that is equilibrium. After [`FULL_STEPS`] a line search shortens the steps, since full ones may cycle.
    pub(super) fn balance_with_ground(
        &self,
        ground: f64,
        u: &mut Vec<f64>,
        pattern: &mut Pattern,
    ) -> bool {
        for step in 0..MAX_STEPS {
            let stiffness = self.stiffness(pattern, ground);
            let target = self.displacements(&stiffness, &self.spring_loads(pattern));
            if target.iter().any(|v| !v.is_finite()) {
                return false;
            }
            let next = self.pattern(&target, pattern);
            if next == *pattern {
                *u = target;
                return true;
            }
            if step < FULL_STEPS {
                (*u, *pattern) = (target, next);
                continue;
            }
            *u = self.line_search(u, &target, ground);
            *pattern = self.pattern(u, pattern);
        }
        false
    }

    /// The displacements on the way from `u` to `target` that leave least unbalanced, among the shares tried. Stops at the first
    /// one of sufficient decrease (Armijo).
    fn line_search(&self, u: &[f64], target: &[f64], ground: f64) -> Vec<f64> {
        let now = self.residual_norm(u, ground);
        let mut best = (f64::INFINITY, u.to_vec());
        for (k, share) in STEP_SHARES.into_iter().enumerate() {
            let both = u.iter().zip(target);
            let between: Vec<f64> = both.map(|(a, b)| a + share * (b - a)).collect();
            let norm = self.residual_norm(&between, ground);
            if k == 0 || norm < best.0 {
                best = (norm, between);
            }
            if norm < now * (1.0 - 0.5 * share) {
                break;
            }
        }
        best.1
    }

    /// Continuation: springs to the ground soften step by step until the forces without them are a rest.
    ///
    /// Returns the rest, or the displacements at the end, scaled to a largest of 1.
    pub(super) fn find_rest(&self) -> Result<Rest, Vec<f64>> {
        let mut u = vec![0.0; self.program.loads.len()];
        let mut pattern = self.all_pressed();
        let mut ground = 1.0;
        for _ in 0..MAX_SOFTENINGS {
            if self.balance_with_ground(ground, &mut u, &mut pattern)
                && let Some(rest) = self.rest(&pattern, &u)
            {
                return Ok(rest);
            }
            ground *= SOFTENING_FACTOR;
        }
        let largest = u.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        Err(u
            .iter()
            .map(|v| v / largest.max(f64::MIN_POSITIVE))
            .collect())
    }
}
