//! The rest of springs by fixed-point iteration on the friction: convex programs with Tresca's friction.
//!
//! If the friction at which faces yield is held fixed (Tresca's law), springs take the least energy. That is a convex program,
//! which has an answer as long as springs to the ground help. Its normal forces give the next friction limits, μ(N1 + N2),
//! and so on (Panagiotopoulos 1975). Newton's method between patterns is quicker if it ends; next to a stone a thousand
//! times as heavy it cycles.

use super::rest::normal_sums;
use super::spring::{Pattern, Rest, Slide, Springs};
use crate::program::QuadraticProgram;
use crate::solve::{Conditioning, Status, TOLERANCE, solve};

/// Fixed-point iterations. Each halves the stiffness of the ground.
const MAX_ITERATIONS: usize = 60;

/// The stiffness of the ground does not fall below this, relative to a point's: the solver's tolerance.
const MIN_GROUND: f64 = 1e-9;

/// Below this stiffness of the ground the pattern is near enough to that of the rest for Newton's method to be tried.
const NEWTON_GROUND: f64 = 1e-4;

impl Springs<'_> {
    /// The rest that the iteration leads to, if any. Not for programs with robots.
    pub(super) fn find_rest_by_fixed_friction(&self) -> Option<Rest> {
        if !self.grips.is_empty() {
            return None;
        }
        let mut friction_limits = vec![0.0; self.tangents.len()];
        let mut ground: f64 = 1.0;
        for _ in 0..MAX_ITERATIONS {
            let answer = solve(
                &self.least_energy(&friction_limits, ground),
                TOLERANCE,
                Conditioning::Full,
            );
            if answer.status != Status::Solved {
                return None;
            }
            let mut u = answer.x[..self.program.loads.len()].to_vec();
            let mut pattern = self.pattern_of(&u);
            if let Some(rest) = self.rest(&pattern, &u) {
                return Some(rest);
            }
            let normal: Vec<f64> = self.points.iter().map(|p| -p.column.dot(&u)).collect();
            let sums = normal_sums(self, normal.iter().map(|n| n.max(0.0)));
            for ((limit, sum), contact) in
                (friction_limits.iter_mut().zip(&sums)).zip(&self.program.contacts)
            {
                *limit = contact.friction * sum;
            }
            if ground < NEWTON_GROUND
                && self.balance_with_ground(ground, &mut u, &mut pattern)
                && let Some(rest) = self.rest(&pattern, &u)
            {
                return Some(rest);
            }
            ground = (0.5 * ground).max(MIN_GROUND);
        }
        None
    }

    /// The pattern of displacements, without a former one.
    fn pattern_of(&self, u: &[f64]) -> Pattern {
        let nothing = Pattern {
            pressed: vec![false; self.points.len()],
            slides: vec![Slide::Sticks; self.tangents.len()],
            limits: vec![0.0; self.grips.len()],
        };
        self.pattern(u, &nothing)
    }

    /// The program of least energy with fixed friction limits:
    ///
    /// min ½Σp² + ½ρΣe² + Σ limit·q + ½ ground Σu² + loads·u,
    ///
    /// where u are the displacements, p ≥ 0, p ≥ −g how far points are pressed, e how far springs along faces are
    /// stretched, and q ≥ |s − e| how far faces slide beyond that.
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
        conic.quadratic.extend((0..rows).map(|k| (k, k, ground)));
        conic.linear[..rows].copy_from_slice(&self.program.loads);
        for (k, point) in self.points.iter().enumerate() {
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
            let (spring, slide) = (stretched + k, slid + k);
            conic.quadratic.push((spring, spring, self.along));
            conic.linear[slide] = friction_limits[k];
            for sign in [1.0, -1.0] {
                let row = conic.bound.len();
                let entries = tangent.entries();
                conic
                    .matrix
                    .extend(entries.map(|(k, v)| (row, k, sign * v)));
                conic
                    .matrix
                    .extend([(row, spring, -sign), (row, slide, -1.0)]);
                conic.bound.push(0.0);
            }
        }
        conic
    }
}
