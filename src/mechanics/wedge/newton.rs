//! Finds springs at rest by a semismooth Newton method, with continuation in the stiffness of springs to the ground.
//!
//! A pattern (which points press, which faces slide) makes the springs' law linear. A Newton step solves this linear
//! system; the displacements determine the next pattern. If the pattern does not change, the springs are in
//! equilibrium. Additional springs to the ground make the first systems regular and are then softened. Reference:
//! Alart and Curnier, A mixed formulation for frictional contact problems prone to Newton like solution methods,
//! 1991.

use super::band::Band;
use super::spring::{Pattern, Rest, Springs};
use crate::mechanics::solve::is_late;

/// The largest number of Newton steps at one stiffness of the ground.
const MAX_STEPS: usize = 60;

/// The number of Newton steps at one stiffness of the ground that are full steps; later steps use a line search.
const FULL_STEPS: usize = 15;

/// The step lengths that the line search tries, as fractions of the full step.
const STEP_SHARES: [f64; 6] = [1.0, 0.5, 0.25, 0.1, 0.03, 0.01];

/// The number of stiffnesses of the ground that are tried, from 1 down to 0.3²¹ ≈ 1e-11 of an application point's
/// stiffness.
const MAX_SOFTENINGS: usize = 22;

/// The factor by which the stiffness of the ground falls each time.
const SOFTENING_FACTOR: f64 = 0.3;

impl Springs<'_> {
    /// Computes the displacements at which springs with this stiffness matrix exert the given forces on the blocks.
    pub(super) fn displacements(&self, stiffness: &Band, forces: &[f64]) -> Vec<f64> {
        let mut right = vec![0.0; forces.len()];
        for (row, value) in forces.iter().enumerate() {
            right[self.row(row)] = -value;
        }
        let found = stiffness.solve(&right);
        (0..forces.len()).map(|row| found[self.row(row)]).collect()
    }

    /// Returns the forces that the springs must exert: the loads minus the constant part of each robot's force. This
    /// part is the limit if the robot is at its limit, and the given force otherwise.
    fn spring_loads(&self, pattern: &Pattern) -> Vec<f64> {
        let mut loads = self.program.loads.clone();
        for (grip, limit) in self.grips.iter().zip(&pattern.limits) {
            let given = if *limit == 0.0 { grip.given } else { limit * grip.limit };
            grip.column.add_to(&mut loads, -given);
        }
        loads
    }

    /// Returns the norm of the residual at given displacements, with springs of stiffness `ground` to the ground.
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
            let force = (-self.tangential_stiffness * tangent.dot(u)).clamp(-limit, limit);
            tangent.add_to(&mut residual, -force);
        }
        let sum: f64 = residual.iter().zip(u).map(|(r, u)| (r + ground * u) * (r + ground * u)).sum();
        sum.sqrt()
    }

    /// Finds equilibrium with springs of stiffness `ground` to the ground, starting from given displacements and their
    /// pattern. Updates the displacements and the pattern, and returns true if equilibrium was found.
    ///
    /// After [`FULL_STEPS`] steps a line search shortens the steps, because full steps may cycle.
    pub(super) fn balance_with_ground(&self, ground: f64, u: &mut Vec<f64>, pattern: &mut Pattern) -> bool {
        for step in 0..MAX_STEPS {
            if is_late() {
                return false;
            }
            // Newton step: solve the linear system of this pattern.
            let stiffness = self.stiffness(pattern, ground);
            let target = self.displacements(&stiffness, &self.spring_loads(pattern));
            if target.iter().any(|v| !v.is_finite()) {
                return false;
            }
            // Convergence test: stop if the displacements have the pattern from which they were computed.
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

    /// Line search: tries the step lengths [`STEP_SHARES`] from `u` towards `target`, and returns the displacements
    /// with the smallest residual. Stops at the first step length with a sufficient decrease (Armijo).
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

    /// Continuation: reduces the stiffness of the springs to the ground step by step, until the structure is at rest
    /// without them.
    ///
    /// Returns the spring forces at rest. If no state of rest is found, the error contains the last displacements,
    /// scaled so that the largest absolute value is 1.
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
        Err(u.iter().map(|v| v / largest.max(f64::MIN_POSITIVE)).collect())
    }
}
