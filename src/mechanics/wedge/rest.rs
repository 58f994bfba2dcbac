//! Computes the spring forces of a pattern, and checks whether they are a [`Rest`]: they must balance every block and
//! obey the springs' law.
//!
//! The forces are computed with iterative refinement (Higham, Accuracy and Stability of Numerical Algorithms, 2002,
//! chapter 12).

use super::spring::{Pattern, ROUNDING_TOL, Rest, Slide, Springs};
use crate::mechanics::program::Column;
use crate::mechanics::proof::Proof;
use crate::mechanics::solve::is_late;

/// The largest violation of the springs' law, as a fraction of the lighter block's load.
///
/// It is a tenth of [`Proof::IMBALANCE_TOL`], the largest residual of a block as a fraction of its own load, so that such
/// violations are small compared with the allowed residual. In addition, a violation of 1e-11 of the contact's own
/// forces is allowed.
const LAW_TOL: f64 = 1e-8;

/// The largest number of steps of iterative refinement. Each step adds about as many correct digits as the LU factors
/// have.
const MAX_REFINEMENTS: usize = 12;

/// Returns, for each contact, the sum of the given normal forces at its application points.
pub(super) fn normal_sums(springs: &Springs, normal: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sums = vec![0.0; springs.tangents.len()];
    for (point, normal) in springs.points.iter().zip(normal) {
        sums[point.contact] += normal;
    }
    sums
}

impl Springs<'_> {
    /// Computes the spring forces of a pattern. Returns them if they balance every block and obey the springs' law;
    /// otherwise `None`.
    ///
    /// The iterative refinement corrects openings, slips and the displacements of the robots' springs, instead of the
    /// displacements of blocks. The forces on a light block are then accurate relative to its own load, even if heavy
    /// blocks move far. A motion that the pattern does not resist keeps the value that it has in `u`.
    pub(super) fn rest(&self, pattern: &Pattern, u: &[f64]) -> Option<Rest> {
        let stiffness = self.stiffness(pattern, 1e-11);
        let mut gap: Vec<f64> = self.points.iter().map(|p| p.column.dot(u)).collect();
        let mut slip: Vec<f64> = self.tangents.iter().map(|t| t.dot(u)).collect();
        let mut yielded: Vec<f64> = self.grips.iter().map(|g| g.column.dot(u)).collect();
        for _ in 0..MAX_REFINEMENTS {
            if is_late() {
                return None;
            }
            let rest = self.forces(pattern, &gap, &slip, &yielded);
            let residual = self.unbalanced(&rest);
            if self.balances(&rest, &residual) {
                return self.obeys(&rest, &gap, &slip).then_some(rest);
            }
            // Refinement step: add the displacements that the residual causes.
            let change = self.displacements(&stiffness, &residual);
            if change.iter().any(|v| !v.is_finite()) {
                return None;
            }
            for (gap, point) in gap.iter_mut().zip(&self.points) {
                *gap += point.column.dot(&change);
            }
            for (slip, tangent) in slip.iter_mut().zip(&self.tangents) {
                *slip += tangent.dot(&change);
            }
            for (yielded, grip) in yielded.iter_mut().zip(&self.grips) {
                *yielded += grip.column.dot(&change);
            }
        }
        None
    }

    /// Computes the forces of the springs in a pattern, from the opening of each point, the slip of each face and the
    /// displacement `yielded` of each robot's spring.
    fn forces(&self, pattern: &Pattern, gap: &[f64], slip: &[f64], yielded: &[f64]) -> Rest {
        // Compute the normal forces at the pressed points, and their sum for each contact.
        let mut sum = vec![0.0; self.tangents.len()];
        let mut normal = vec![0.0; self.points.len()];
        for (k, point) in self.points.iter().enumerate() {
            if pattern.pressed[k] {
                normal[k] = -gap[k];
                sum[point.contact] += normal[k];
            }
        }
        // Friction is the force of the spring if the face sticks, otherwise ±μ(N1 + N2).
        let friction = pattern.slides.iter().enumerate().map(|(k, slides)| match slides {
            Slide::Sticks => -self.tangential_stiffness * slip[k],
            _ => slides.friction_sign() * self.program.contacts[k].friction * sum[k],
        });
        let grips = self.grips.iter().zip(&pattern.limits).zip(yielded);
        Rest {
            friction: friction.collect(),
            grips: grips
                .map(|((grip, limit), yielded)| match *limit {
                    0.0 => grip.given - yielded,
                    limit => limit * grip.limit,
                })
                .collect(),
            normal,
        }
    }

    /// Returns the residual loads − Σ force, one number for each row of the equilibrium equations.
    fn unbalanced(&self, rest: &Rest) -> Vec<f64> {
        let mut residual = self.program.loads.clone();
        for (grip, force) in self.grips.iter().zip(&rest.grips) {
            grip.column.add_to(&mut residual, -force);
        }
        for (point, force) in self.points.iter().zip(&rest.normal) {
            point.column.add_to(&mut residual, -force);
        }
        for (tangent, force) in self.tangents.iter().zip(&rest.friction) {
            tangent.add_to(&mut residual, -force);
        }
        residual
    }

    /// Returns, for each block, the largest entry of its own load, and Σ |force| on it.
    fn force_sizes(&self, rest: &Rest) -> Vec<(f64, f64)> {
        let own = self.program.loads.chunks(3).map(|r| (r.iter().fold(0.0, |m: f64, v| m.max(v.abs())), 0.0));
        let mut force_sizes: Vec<(f64, f64)> = own.collect();
        let mut add = |column: &Column, force: f64| {
            for (row, value) in column.entries() {
                force_sizes[row / 3].1 += (value * force).abs();
            }
        };
        self.points.iter().zip(&rest.normal).for_each(|(p, f)| add(&p.column, *f));
        self.tangents.iter().zip(&rest.friction).for_each(|(t, f)| add(t, *f));
        self.grips.iter().zip(&rest.grips).for_each(|(g, f)| add(&g.column, *f));
        force_sizes
    }

    /// True if the residual of every block is within the tolerance, which is a fraction of the block's own load plus
    /// the rounding error of the forces on it.
    fn balances(&self, rest: &Rest, residual: &[f64]) -> bool {
        self.force_sizes(rest).iter().zip(residual.chunks(3)).all(|((own, forces), residual)| {
            let allowed = Proof::IMBALANCE_TOL * own + ROUNDING_TOL * forces;
            residual.iter().all(|v| v.abs() <= allowed)
        })
    }

    /// True if the forces obey the springs' law at all points and faces, and the limits of the robots.
    fn obeys(&self, rest: &Rest, gap: &[f64], slip: &[f64]) -> bool {
        let force_sizes = self.force_sizes(rest);
        let contacts = &self.program.contacts;
        let normal = normal_sums(self, rest.normal.iter().copied());
        let allowed: Vec<f64> = contacts
            .iter()
            .enumerate()
            .map(|(k, c)| {
                // The tolerance is a fraction of the smaller load of the two blocks, plus a far smaller fraction of the
                // contact's own forces.
                let lighter =
                    c.from.as_ref().map_or(force_sizes[c.on.0].0, |f| force_sizes[c.on.0].0.min(force_sizes[f.0].0));
                LAW_TOL * lighter + 1e-3 * LAW_TOL * (normal[k].abs() + rest.friction[k].abs())
            })
            .collect();
        // Points: N = max(0, −gap), for springs of stiffness 1. N is 0 or −gap already, so only N ≥ 0 and N + gap ≥ 0
        // remain to be checked, up to the tolerance.
        let points = self.points.iter().zip(gap).zip(&rest.normal).all(|((p, gap), normal)| {
            let allowed = allowed[p.contact];
            *normal >= -allowed && (normal + gap) >= -allowed
        });
        // Robots: every component within its limit.
        let limits = self.grips.iter().zip(&rest.grips).all(|(g, f)| f.abs() <= g.limit * (1.0 + LAW_TOL));
        points
            && limits
            && contacts.iter().enumerate().all(|(k, c)| {
                // Faces: within the tolerance, the friction force must be −ρ·slip, limited to ±μ(N1 + N2), where N1 and
                // N2 are the normal forces at the points of the face.
                let limit = c.friction * normal[k].max(0.0);
                let law = (-self.tangential_stiffness * slip[k]).clamp(-limit, limit);
                (rest.friction[k] - law).abs() <= allowed[k] * (1.0 + c.friction)
            })
    }
}
