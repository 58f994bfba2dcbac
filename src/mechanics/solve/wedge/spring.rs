//! [`Springs`]: a program whose contacts yield, unstressed before the loads act, and the rest they come to.
//!
//! At every application point N = max(0, −g) with g the opening, along every face T = −ρ s with s the slip, cut at
//! ±μ(N1 + N2). Loads that grow in proportion move everything in proportion, so that the law above is also the one
//! that loading step by step obeys. All sizes divide out: only ρ, how stiff a face is along itself in parts of a point's
//! stiffness, is a choice.
//!
//! Invariant: a [`Rest`] obeys the law and balances every block in parts of that block's own load, whoever found it.

use super::band::{Band, order};
use crate::program::{Column, Force, Program, columns, sticking_columns};

/// How one face slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slide {
    /// It does not: friction is what the spring along the face gives.
    Sticks,
    /// Along the face's direction: friction is all there can be, against it.
    Forth,
    /// Against the face's direction.
    Back,
}

impl Slide {
    /// Which way friction acts, 0 where the spring decides.
    pub(super) fn friction(self) -> f64 {
        match self {
            Slide::Sticks => 0.0,
            Slide::Forth => -1.0,
            Slide::Back => 1.0,
        }
    }
}

/// Which points press and which faces slide.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pattern {
    /// Per application point.
    pub(super) pressed: Vec<bool>,
    /// Per contact.
    pub(super) slides: Vec<Slide>,
    /// Per robot's component: −1 or 1 at a limit, else 0.
    pub(super) limits: Vec<f64>,
}

/// Forces that springs from rest come to.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    /// Normal force per application point.
    pub(super) normal: Vec<f64>,
    /// Friction force per contact.
    pub(super) friction: Vec<f64>,
    /// Amount per robot's component.
    pub(super) grips: Vec<f64>,
}

/// One component of what a robot gives. It yields about what it is asked to give, as far as its limits allow, so that
/// forces known to some digits require no more of them to balance.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpringGrip {
    /// The component.
    pub(super) column: Column,
    /// Its limit.
    pub(super) limit: f64,
    /// What it is asked to give.
    pub(super) given: f64,
}

/// One application point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Its contact.
    pub(super) contact: usize,
    /// Its normal force; the product with velocities is the speed at which it opens.
    pub(super) column: Column,
}

/// The springs of a program.
pub(super) struct Springs<'a> {
    pub(super) program: &'a Program,
    pub(super) points: Vec<Point>,
    /// Per contact, friction along (−n_y, n_x).
    pub(super) tangents: Vec<Column>,
    pub(super) grips: Vec<SpringGrip>,
    /// Stiffness along a face in parts of a point's.
    pub(super) along: f64,
    place: Vec<usize>,
    reach: usize,
}

impl<'a> Springs<'a> {
    /// The springs of a program, robots asked to give `given` per simulated component, in the order of the grips.
    pub(super) fn around(program: &'a Program, given: &[f64], along: f64) -> Springs<'a> {
        let mut springs = Springs::new(program, along);
        for (grip, given) in springs.grips.iter_mut().zip(given) {
            grip.given = *given;
        }
        springs
    }

    /// The springs of a program, robots asked to give nothing.
    pub(super) fn new(program: &'a Program, along: f64) -> Springs<'a> {
        let normals = columns(&Program {
            contacts: program
                .contacts
                .iter()
                .map(|c| crate::program::ContactTerm {
                    friction: 0.0,
                    ..c.clone()
                })
                .collect(),
            grips: Vec::new(),
            ..program.clone()
        });
        let points = normals
            .into_iter()
            .filter_map(|column| match column.force {
                Force::Ray { contact, .. } => Some(Point { contact, column }),
                _ => None,
            })
            .collect();
        let tangents = sticking_columns(program)
            .into_iter()
            .filter(|c| matches!(c.force, Force::StickFriction { sign, .. } if sign > 0.0))
            .collect();
        let grips = columns(program)
            .into_iter()
            .filter(|c| matches!(c.force, Force::Grip { sign, .. } if sign > 0.0))
            .map(|column| SpringGrip {
                column,
                limit: column.limit,
                given: 0.0,
            })
            .collect();
        let (place, apart) = order(program);
        Springs {
            program,
            points,
            tangents,
            grips,
            along,
            place,
            reach: 3 * apart + 2,
        }
    }

    /// Everything pressed, nothing sliding.
    pub(super) fn whole(&self) -> Pattern {
        Pattern {
            pressed: vec![true; self.points.len()],
            slides: vec![Slide::Sticks; self.tangents.len()],
            limits: vec![0.0; self.grips.len()],
        }
    }

    /// The pattern that displacements make; where they leave it to rounding, that of `before`.
    pub(super) fn pattern(&self, u: &[f64], before: &Pattern) -> Pattern {
        let size = |column: &Column| {
            column
                .entries()
                .fold(0.0, |m: f64, (r, v)| m.max((u[r] * v).abs()))
        };
        let mut found = before.clone();
        let mut most = vec![0.0; self.tangents.len()];
        for (point, pressed) in self.points.iter().zip(&mut found.pressed) {
            let gap = point.column.dot(u);
            if gap.abs() > 1e-13 * size(&point.column) {
                *pressed = gap < 0.0;
            }
            if *pressed {
                most[point.contact] -= gap;
            }
        }
        for (k, slides) in found.slides.iter_mut().enumerate() {
            let slip = self.tangents[k].dot(u);
            let most = self.program.contacts[k].friction * most[k].max(0.0);
            let rounding = 1e-13 * size(&self.tangents[k]);
            if self.along * slip.abs() < most - rounding {
                *slides = Slide::Sticks;
            } else if slip > rounding && self.along * slip > most + rounding {
                *slides = Slide::Forth;
            } else if slip < -rounding && self.along * -slip > most + rounding {
                *slides = Slide::Back;
            }
        }
        for (grip, limit) in self.grips.iter().zip(&mut found.limits) {
            let force = grip.given - grip.column.dot(u);
            *limit = if force.abs() > grip.limit {
                force.signum()
            } else {
                0.0
            };
        }
        found
    }

    /// The stiffness of a pattern, and `ground` more for every displacement.
    pub(super) fn stiffness(&self, pattern: &Pattern, ground: f64) -> Band {
        let mut band = Band::new(3 * self.program.blocks, self.reach);
        let mut enter = |left: &Column, right: &Column, by: f64| {
            for (i, a) in left.entries() {
                for (j, b) in right.entries() {
                    band.add(self.row(i), self.row(j), by * a * b);
                }
            }
        };
        for (point, pressed) in self.points.iter().zip(&pattern.pressed) {
            if !*pressed {
                continue;
            }
            enter(&point.column, &point.column, 1.0);
            let k = point.contact;
            let way = pattern.slides[k].friction();
            if way != 0.0 {
                // Friction way·μ·N with N = −g acts on the blocks as −way·μ·g.
                enter(
                    &self.tangents[k],
                    &point.column,
                    way * self.program.contacts[k].friction,
                );
            }
        }
        for (tangent, slides) in self.tangents.iter().zip(&pattern.slides) {
            if *slides == Slide::Sticks {
                enter(tangent, tangent, self.along);
            }
        }
        for (grip, limit) in self.grips.iter().zip(&pattern.limits) {
            if *limit == 0.0 {
                enter(&grip.column, &grip.column, 1.0);
            }
        }
        for row in 0..3 * self.program.blocks {
            band.add(row, row, ground);
        }
        band.factored()
    }

    fn row(&self, row: usize) -> usize {
        3 * self.place[row / 3] + row % 3
    }

    pub(super) fn displaced(&self, stiffness: &Band, asked: &[f64]) -> Vec<f64> {
        let mut right = vec![0.0; asked.len()];
        for (row, value) in asked.iter().enumerate() {
            right[self.row(row)] = -value;
        }
        let found = stiffness.solve(&right);
        (0..asked.len()).map(|row| found[self.row(row)]).collect()
    }

    /// What contacts must give beside what robots are asked to, or give at their limits.
    fn asked(&self, pattern: &Pattern) -> Vec<f64> {
        let mut asked = self.program.loads.clone();
        for (grip, limit) in self.grips.iter().zip(&pattern.limits) {
            let given = if *limit == 0.0 {
                grip.given
            } else {
                limit * grip.limit
            };
            grip.column.add_to(&mut asked, -given);
        }
        asked
    }

    /// What the springs and springs of stiffness `ground` to the ground leave unbalanced at given displacements.
    fn off(&self, u: &[f64], ground: f64) -> f64 {
        let mut rest = self.program.loads.clone();
        for grip in &self.grips {
            let force = (grip.given - grip.column.dot(u)).clamp(-grip.limit, grip.limit);
            grip.column.add_to(&mut rest, -force);
        }
        let mut normal = vec![0.0; self.tangents.len()];
        for point in &self.points {
            let force = (-point.column.dot(u)).max(0.0);
            normal[point.contact] += force;
            point.column.add_to(&mut rest, -force);
        }
        for (k, tangent) in self.tangents.iter().enumerate() {
            let most = self.program.contacts[k].friction * normal[k];
            let force = (-self.along * tangent.dot(u)).clamp(-most, most);
            tangent.add_to(&mut rest, -force);
        }
        let sum: f64 = rest
            .iter()
            .zip(u)
            .map(|(r, u)| (r + ground * u) * (r + ground * u))
            .sum();
        sum.sqrt()
    }

    /// Displacements at which springs to the ground of stiffness `ground` help to balance, from given ones: Newton's
    /// steps between patterns, shortened where whole ones run in circles.
    pub(super) fn helped(&self, ground: f64, u: &mut Vec<f64>, pattern: &mut Pattern) -> bool {
        for step in 0..STEPS {
            let stiffness = self.stiffness(pattern, ground);
            let next = self.displaced(&stiffness, &self.asked(pattern));
            if next.iter().any(|v| !v.is_finite()) {
                return false;
            }
            let made = self.pattern(&next, pattern);
            if made == *pattern {
                *u = next;
                return true;
            }
            if step < WHOLE {
                (*u, *pattern) = (next, made);
                continue;
            }
            let now = self.off(u, ground);
            let mut best: Option<(f64, Vec<f64>)> = None;
            for share in [1.0, 0.5, 0.25, 0.1, 0.03, 0.01] {
                let between: Vec<f64> = u
                    .iter()
                    .zip(&next)
                    .map(|(a, b)| a + share * (b - a))
                    .collect();
                let off = self.off(&between, ground);
                if best.as_ref().is_none_or(|b| off < b.0) {
                    best = Some((off, between));
                }
                if off < now * (1.0 - 0.5 * share) {
                    break;
                }
            }
            if let Some((_, between)) = best {
                *u = between;
            }
            *pattern = self.pattern(u, pattern);
        }
        false
    }

    /// The rest reached as springs to the ground soften until they carry nothing; else the way they go at the end,
    /// largest displacement 1.
    pub(super) fn settled(&self) -> Result<Rest, Vec<f64>> {
        let mut u = vec![0.0; self.program.loads.len()];
        let mut pattern = self.whole();
        let mut ground = 1.0;
        for _ in 0..SOFTENINGS {
            if self.helped(ground, &mut u, &mut pattern)
                && let Some(rest) = self.rest(&pattern, &u)
            {
                return Ok(rest);
            }
            ground *= SOFTENING;
        }
        let most = u.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        Err(u.iter().map(|v| v / most.max(f64::MIN_POSITIVE)).collect())
    }
}

/// Steps between patterns at one stiffness, and how many of them are whole.
const STEPS: usize = 60;
const WHOLE: usize = 15;

/// How often the springs to the ground soften, and to which part.
const SOFTENINGS: usize = 22;
const SOFTENING: f64 = 0.3;
