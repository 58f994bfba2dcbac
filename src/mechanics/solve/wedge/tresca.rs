//! The springs' rest by turns: friction that yields at a given force, then forces at which it yields.
//!
//! With the friction at which faces yield held fixed (Tresca's law) the springs take the least energy, a convex program that
//! always has an answer while springs to the ground help. Its normal forces say at which friction faces yield, and so on.
//! Newton's steps between patterns are quicker where they end; beside a stone a thousand times as heavy they run in circles.

use super::law::normal_sums;
use super::spring::{Pattern, Rest, Slide, Springs};
use crate::program::QuadraticProgram;
use crate::solve::{Conditioning, Status, TOLERANCE, solve};

/// Turns at most. Each halves the springs to the ground.
const TURNS: usize = 60;

/// The springs to the ground soften to this part, and are soft enough for Newton's steps from there on at the second.
const SOFTEST: f64 = 1e-9;
const SOFT: f64 = 1e-4;

impl Springs<'_> {
    /// The rest that turns lead to, if they lead to one. Robots, which give about what they are asked to, are left out.
    pub(super) fn settled_by_turns(&self) -> Option<Rest> {
        if !self.grips.is_empty() {
            return None;
        }
        let mut yields = vec![0.0; self.tangents.len()];
        let mut ground: f64 = 1.0;
        for _ in 0..TURNS {
            let answer = solve(
                &self.held_at(&yields, ground),
                TOLERANCE,
                Conditioning::Full,
            );
            if answer.status != Status::Solved {
                return None;
            }
            let mut u = answer.x[..self.program.loads.len()].to_vec();
            let mut pattern = self.at(&u);
            if let Some(rest) = self.rest(&pattern, &u) {
                return Some(rest);
            }
            let normal: Vec<f64> = self.points.iter().map(|p| -p.column.dot(&u)).collect();
            let sums = normal_sums(self, normal.iter().map(|n| n.max(0.0)));
            for ((yields, sum), contact) in
                (yields.iter_mut().zip(&sums)).zip(&self.program.contacts)
            {
                *yields = contact.friction * sum;
            }
            if ground < SOFT
                && self.helped(ground, &mut u, &mut pattern)
                && let Some(rest) = self.rest(&pattern, &u)
            {
                return Some(rest);
            }
            ground = (0.5 * ground).max(SOFTEST);
        }
        None
    }

    /// The pattern of displacements, where nothing is known of any before.
    fn at(&self, u: &[f64]) -> Pattern {
        let nothing = Pattern {
            pressed: vec![false; self.points.len()],
            slides: vec![Slide::Sticks; self.tangents.len()],
            limits: vec![0.0; self.grips.len()],
        };
        self.pattern(u, &nothing)
    }

    /// The least energy where friction yields at given forces: displacements u, what points are pressed by p ≥ 0, p ≥ −g,
    /// what springs along faces are stretched by e, and how far faces slide beyond it q ≥ |s − e|;
    /// min ½Σp² + ½ρΣe² + Σ yields·q + ½ ground Σu² + loads·u.
    fn held_at(&self, yields: &[f64], ground: f64) -> QuadraticProgram {
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
            conic.linear[slide] = yields[k];
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
