//! Whether forces are a [`Rest`]: they balance every block and obey the springs' law.

use super::spring::{Pattern, Rest, Slide, Springs};
use crate::program::Column;

/// Parts of a block's own load that may stay unbalanced: what a verdict allows.
const BALANCED: f64 = 1e-7;

/// Parts of the forces on a block below which its balance is rounding.
const ROUNDING: f64 = 1e-13;

/// Parts of a contact's forces by which the law may be missed.
const LAWFUL: f64 = 1e-8;

/// Corrections of the forces.
const REFINEMENTS: usize = 12;

/// Per contact, the sum over its points.
pub(super) fn normal_sums(springs: &Springs, normal: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sums = vec![0.0; springs.tangents.len()];
    for (point, normal) in springs.points.iter().zip(normal) {
        sums[point.contact] += normal;
    }
    sums
}

impl Springs<'_> {
    /// The rest that a pattern leads to, if it obeys the law.
    ///
    /// Forces are corrected by what they leave unbalanced, so that those on a light block become as good as its own load
    /// wants them, whatever the heavy ones displace. Where a pattern leaves a motion free, it stays as it is in `u`.
    pub(super) fn rest(&self, pattern: &Pattern, u: &[f64]) -> Option<Rest> {
        let stiffness = self.stiffness(pattern, 1e-11);
        let mut gap: Vec<f64> = self.points.iter().map(|p| p.column.dot(u)).collect();
        let mut slip: Vec<f64> = self.tangents.iter().map(|t| t.dot(u)).collect();
        let mut yielded: Vec<f64> = self.grips.iter().map(|g| g.column.dot(u)).collect();
        for _ in 0..REFINEMENTS {
            let rest = self.forces(pattern, &gap, &slip, &yielded);
            let left = self.left(&rest);
            if self.balances(&rest, &left) {
                return self.obeys(&rest, &gap, &slip).then_some(rest);
            }
            let change = self.displaced(&stiffness, &left);
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

    fn forces(&self, pattern: &Pattern, gap: &[f64], slip: &[f64], yielded: &[f64]) -> Rest {
        let mut sum = vec![0.0; self.tangents.len()];
        let mut normal = vec![0.0; self.points.len()];
        for (k, point) in self.points.iter().enumerate() {
            if pattern.pressed[k] {
                normal[k] = -gap[k];
                sum[point.contact] += normal[k];
            }
        }
        let friction = pattern
            .slides
            .iter()
            .enumerate()
            .map(|(k, slides)| match slides {
                Slide::Sticks => -self.along * slip[k],
                _ => slides.friction() * self.program.contacts[k].friction * sum[k],
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

    /// What forces leave unbalanced.
    fn left(&self, rest: &Rest) -> Vec<f64> {
        let mut left = self.program.loads.clone();
        for (grip, force) in self.grips.iter().zip(&rest.grips) {
            grip.column.add_to(&mut left, -force);
        }
        for (point, force) in self.points.iter().zip(&rest.normal) {
            point.column.add_to(&mut left, -force);
        }
        for (tangent, force) in self.tangents.iter().zip(&rest.friction) {
            tangent.add_to(&mut left, -force);
        }
        left
    }

    /// Per block, its own load and the sum of the forces on it.
    fn sizes(&self, rest: &Rest) -> Vec<(f64, f64)> {
        let own = self
            .program
            .loads
            .chunks(3)
            .map(|r| (r.iter().fold(0.0, |m: f64, v| m.max(v.abs())), 0.0));
        let mut sizes: Vec<(f64, f64)> = own.collect();
        let mut add = |column: &Column, force: f64| {
            for (row, value) in column.entries() {
                sizes[row / 3].1 += (value * force).abs();
            }
        };
        self.points
            .iter()
            .zip(&rest.normal)
            .for_each(|(p, f)| add(&p.column, *f));
        self.tangents
            .iter()
            .zip(&rest.friction)
            .for_each(|(t, f)| add(t, *f));
        self.grips
            .iter()
            .zip(&rest.grips)
            .for_each(|(g, f)| add(&g.column, *f));
        sizes
    }

    fn balances(&self, rest: &Rest, left: &[f64]) -> bool {
        self.sizes(rest)
            .iter()
            .zip(left.chunks(3))
            .all(|((own, forces), left)| {
                let allowed = BALANCED * own + ROUNDING * forces;
                left.iter().all(|v| v.abs() <= allowed)
            })
    }

    fn obeys(&self, rest: &Rest, gap: &[f64], slip: &[f64]) -> bool {
        let sizes = self.sizes(rest);
        let contacts = &self.program.contacts;
        let normal = normal_sums(self, rest.normal.iter().copied());
        let allowed: Vec<f64> = contacts
            .iter()
            .enumerate()
            .map(|(k, c)| {
                let lighter = c
                    .from
                    .as_ref()
                    .map_or(sizes[c.on.0].0, |f| sizes[c.on.0].0.min(sizes[f.0].0));
                LAWFUL * lighter + 1e-3 * LAWFUL * (normal[k].abs() + rest.friction[k].abs())
            })
            .collect();
        let points = self
            .points
            .iter()
            .zip(gap)
            .zip(&rest.normal)
            .all(|((p, gap), normal)| {
                let allowed = allowed[p.contact];
                *normal >= -allowed && (normal + gap) >= -allowed
            });
        let limits = self
            .grips
            .iter()
            .zip(&rest.grips)
            .all(|(g, f)| f.abs() <= g.limit * (1.0 + LAWFUL));
        points
            && limits
            && contacts.iter().enumerate().all(|(k, c)| {
                let most = c.friction * normal[k].max(0.0);
                let wanted = (-self.along * slip[k]).clamp(-most, most);
                (rest.friction[k] - wanted).abs() <= allowed[k] * (1.0 + c.friction)
            })
    }
}
