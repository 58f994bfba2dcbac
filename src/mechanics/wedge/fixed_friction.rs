//! Finds springs at rest by fixed-point iteration on the friction limits, with convex programs (Tresca's friction).
//!
//! If the friction limit of each face is fixed (Tresca's law), springs at rest have the least energy. This is a convex
//! program, which has a solution as long as additional springs hold the blocks to the ground. Its normal forces
//! determine the next friction limits μ(N1 + N2), and so on (Panagiotopoulos 1975). Newton's method ([`super::newton`])
//! is faster if it converges. It does not converge, for example, if one of two stones in contact is a thousand times
//! heavier than the other.

use super::rest::normal_sums;
use super::spring::{Pattern, Rest, Slide, Springs};
use crate::mechanics::program::QuadraticProgram;
use crate::mechanics::solve::{Conditioning, Status, TOLERANCE, solve};

/// The largest number of fixed-point iterations. Each halves the stiffness of the springs to the ground.
const MAX_ITERATIONS: usize = 60;

/// Below this stiffness of the ground, Newton's method is tried too, because the pattern is then close to the pattern
/// of the state of rest.
const NEWTON_GROUND: f64 = 1e-4;

impl Springs<'_> {
    /// Returns the spring forces at rest, found by a fixed-point iteration on the friction limits. `None` if the
    /// iteration does not converge, or if the program has robots.
    pub(super) fn find_rest_by_fixed_friction(&self) -> Option<Rest> {
        if !self.grips.is_empty() {
            return None;
        }
        let mut friction_limits = vec![0.0; self.tangents.len()];
        let mut ground: f64 = 1.0;
        for _ in 0..MAX_ITERATIONS {
            let answer = solve(&self.least_energy(&friction_limits, ground), TOLERANCE, Conditioning::Full);
            if answer.status != Status::Solved {
                return None;
            }
            // Convergence test: stop if the springs are at rest in the pattern of these displacements.
            let mut u = answer.x[..self.program.loads.len()].to_vec();
            let mut pattern = self.pattern_of(&u);
            if let Some(rest) = self.rest(&pattern, &u) {
                return Some(rest);
            }
            // Fixed-point step: the normal forces determine the next friction limits.
            let normal: Vec<f64> = self.points.iter().map(|p| -p.column.dot(&u)).collect();
            let sums = normal_sums(self, normal.iter().map(|n| n.max(0.0)));
            for ((limit, sum), contact) in (friction_limits.iter_mut().zip(&sums)).zip(&self.program.contacts) {
                *limit = contact.friction * sum;
            }
            if ground < NEWTON_GROUND
                && self.balance_with_ground(ground, &mut u, &mut pattern)
                && let Some(rest) = self.rest(&pattern, &u)
            {
                return Some(rest);
            }
            ground = (0.5 * ground).max(TOLERANCE);
        }
        None
    }

    /// Returns which points press and which faces slide at the displacements `u`, without a previous pattern.
    fn pattern_of(&self, u: &[f64]) -> Pattern {
        let nothing = Pattern {
            pressed: vec![false; self.points.len()],
            slides: vec![Slide::Sticks; self.tangents.len()],
            limits: vec![0.0; self.grips.len()],
        };
        self.pattern(u, &nothing)
    }

    /// Builds the quadratic program of least energy with fixed friction limits:
    ///
    /// min ½Σp² + ½ρΣe² + Σ limit·q + ½ ground Σu² + loads·u,
    ///
    /// where u are the displacements, `ground` is the stiffness of the springs to the ground, g is the opening of each
    /// point, and p ≥ max(0, −g) is the compression of its spring. For each face, e is the elongation of the spring
    /// along the face, ρ is the stiffness of this spring, s is the slip, and q ≥ |s − e| is the sliding distance.
    fn least_energy(&self, friction_limits: &[f64], ground: f64) -> QuadraticProgram {
        let (rows, points) = (self.program.loads.len(), self.points.len());
        let faces = self.tangents.len();
        let (pressed, stretched) = (rows, rows + points);
        let slid = stretched + faces;
        let unknowns = slid + faces;
        let mut conic = QuadraticProgram {
            unknowns,
            quadratic: Vec::with_capacity(unknowns),
            linear: vec![0.0; unknowns],
            matrix: Vec::new(),
            bound: Vec::new(),
            equalities: 0,
        };
        // Add the energy of the springs to the ground, and the work of the loads.
        conic.quadratic.extend((0..rows).map(|k| (k, k, ground)));
        conic.linear[..rows].copy_from_slice(&self.program.loads);
        for (k, point) in self.points.iter().enumerate() {
            // p ≥ 0 and p ≥ −g.
            let own = pressed + k;
            conic.quadratic.push((own, own, 1.0));
            let row = conic.bound.len();
            conic.matrix.push((row, own, -1.0));
            conic.matrix.push((row + 1, own, -1.0));
            let entries = point.column.entries();
            conic.matrix.extend(entries.map(|(k, v)| (row + 1, k, -v)));
            conic.bound.extend([0.0; 2]);
        }
        for (k, tangent) in self.tangents.iter().enumerate() {
            // q ≥ ±(s − e).
            let (spring, slide) = (stretched + k, slid + k);
            conic.quadratic.push((spring, spring, self.tangential_stiffness));
            conic.linear[slide] = friction_limits[k];
            for sign in [1.0, -1.0] {
                let row = conic.bound.len();
                let entries = tangent.entries();
                conic.matrix.extend(entries.map(|(k, v)| (row, k, sign * v)));
                conic.matrix.extend([(row, spring, -sign), (row, slide, -1.0)]);
                conic.bound.push(0.0);
            }
        }
        conic
    }
}
