//! [`Springs`]: the contacts and the robots of a program as springs. The springs of the contacts are unstressed before
//! the loads act.
//!
//! The springs' law: at every application point, N = max(0, −g), where g is the opening. Along the face of every
//! contact (the line along which the two bodies touch), T = −ρ s, where s is the slip; T is limited to ±μ(N1 + N2). If
//! the loads grow in proportion, so do all displacements. The law of the final state is therefore also the law of each
//! step of loading. The only parameter is ρ, the stiffness along a face relative to that of an application point.
//!
//! Invariant: every [`Rest`] obeys the law and balances every block relative to that block's own load.

use super::band::{Band, order};
use crate::mechanics::program::{Column, Force, Program, adhesion_columns, columns};

/// A sum up to this fraction of its terms counts as rounding: an opening, a slip, or the residual of a block.
pub(super) const ROUNDING_TOL: f64 = 1e-13;

/// Whether and in which direction the face of a contact slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slide {
    /// It does not slide: friction is the force of the spring along the face.
    Sticks,
    /// It slides along the tangent (−n_y, n_x), where n is the contact's normal. Friction is at its limit, against the
    /// tangent.
    Forth,
    /// It slides against the tangent. Friction is at its limit, along the tangent.
    Back,
}

impl Slide {
    /// Returns the sign of friction along the tangent if friction is at its limit; 0 if the face sticks, because the
    /// spring then determines friction.
    pub(super) fn friction_sign(self) -> f64 {
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
    /// For each application point, whether it presses.
    pub(super) pressed: Vec<bool>,
    /// For each contact, how its face slides.
    pub(super) slides: Vec<Slide>,
    /// For each component of a robot: −1 or 1 if it is at its limit, otherwise 0.
    pub(super) limits: Vec<f64>,
}

/// The forces of springs that came to rest.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    /// Normal force per application point.
    pub(super) normal: Vec<f64>,
    /// Friction force per contact.
    pub(super) friction: Vec<f64>,
    /// Force per component of a robot.
    pub(super) grips: Vec<f64>,
}

/// One component of a robot's force, as a spring. At displacement 0, the spring exerts the force `given`; its force
/// never exceeds the robot's limit.
///
/// Given forces need not be exact: the spring corrects them until the blocks balance.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpringGrip {
    /// The column of the component.
    pub(super) column: Column,
    /// The robot's limit of this component.
    pub(super) limit: f64,
    /// The force of the spring at displacement 0.
    pub(super) given: f64,
}

/// One application point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// The index of the contact that it belongs to.
    pub(super) contact: usize,
    /// The column of its normal force. Its product with the displacements is the opening g.
    pub(super) column: Column,
}

/// The springs of a program.
pub(super) struct Springs<'a> {
    pub(super) program: &'a Program,
    pub(super) points: Vec<Point>,
    /// For each contact, the column of friction along (−n_y, n_x).
    pub(super) tangents: Vec<Column>,
    pub(super) grips: Vec<SpringGrip>,
    /// ρ: the stiffness along a face, relative to that of an application point.
    pub(super) tangential_stiffness: f64,
    /// The position of each block in the banded matrix, and the bandwidth of this matrix.
    position: Vec<usize>,
    bandwidth: usize,
}

impl<'a> Springs<'a> {
    /// Creates the springs of a program. `given` contains, for each simulated component of a robot in the order of the
    /// grips, the force of its spring at displacement 0.
    pub(super) fn with_given_forces(program: &'a Program, given: &[f64], tangential_stiffness: f64) -> Springs<'a> {
        let mut springs = Springs::new(program, tangential_stiffness);
        for (grip, given) in springs.grips.iter_mut().zip(given) {
            grip.given = *given;
        }
        springs
    }

    /// Creates the springs of a program. The robots' springs exert no force at displacement 0.
    pub(super) fn new(program: &'a Program, tangential_stiffness: f64) -> Springs<'a> {
        // Without friction and grips, the columns of a program are the normal forces at its application points.
        let normals = columns(&Program {
            contacts: program
                .contacts
                .iter()
                .map(|c| crate::mechanics::program::ContactTerm { friction: 0.0, ..c.clone() })
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
        // Friction along the tangent, without a limit: one column for each contact.
        let tangents = adhesion_columns(program)
            .into_iter()
            .filter(|c| matches!(c.force, Force::AdhesionFriction { sign, .. } if sign > 0.0))
            .collect();
        let grips = columns(program)
            .into_iter()
            .filter(|c| matches!(c.force, Force::Grip { sign, .. } if sign > 0.0))
            .map(|column| SpringGrip { column, limit: column.limit, given: 0.0 })
            .collect();
        let (position, distance) = order(program);
        Springs { program, points, tangents, grips, tangential_stiffness, position, bandwidth: 3 * distance + 2 }
    }

    /// Returns the pattern with all points pressed and no face sliding.
    pub(super) fn all_pressed(&self) -> Pattern {
        Pattern {
            pressed: vec![true; self.points.len()],
            slides: vec![Slide::Sticks; self.tangents.len()],
            limits: vec![0.0; self.grips.len()],
        }
    }

    /// Returns which points press, which faces slide and which robots are at a limit at the displacements `u`. A point
    /// or face for which only rounding would decide keeps its entry of `former`.
    pub(super) fn pattern(&self, u: &[f64], former: &Pattern) -> Pattern {
        let size = |column: &Column| column.entries().fold(0.0, |m: f64, (r, v)| m.max((u[r] * v).abs()));
        // A point is pressed if its opening is negative.
        let mut found = former.clone();
        let mut normal = vec![0.0; self.tangents.len()];
        for (point, pressed) in self.points.iter().zip(&mut found.pressed) {
            let gap = point.column.dot(u);
            if gap.abs() > ROUNDING_TOL * size(&point.column) {
                *pressed = gap < 0.0;
            }
            if *pressed {
                normal[point.contact] -= gap;
            }
        }
        // A face slides if the force of its spring exceeds the friction limit.
        for (k, slides) in found.slides.iter_mut().enumerate() {
            let slip = self.tangents[k].dot(u);
            let limit = self.program.contacts[k].friction * normal[k].max(0.0);
            let rounding = ROUNDING_TOL * size(&self.tangents[k]);
            if self.tangential_stiffness * slip.abs() < limit - rounding {
                *slides = Slide::Sticks;
            } else if slip > rounding && self.tangential_stiffness * slip > limit + rounding {
                *slides = Slide::Forth;
            } else if slip < -rounding && self.tangential_stiffness * -slip > limit + rounding {
                *slides = Slide::Back;
            }
        }
        // A robot yields if the force of its spring exceeds the robot's limit.
        for (grip, limit) in self.grips.iter().zip(&mut found.limits) {
            let force = grip.given - grip.column.dot(u);
            *limit = if force.abs() > grip.limit { force.signum() } else { 0.0 };
        }
        found
    }

    /// Computes the LU factors of the tangent stiffness of a pattern, with springs of stiffness `ground` to the
    /// ground.
    pub(super) fn stiffness(&self, pattern: &Pattern, ground: f64) -> Band {
        // Assemble the tangent stiffness: a sum of products column·columnᵀ, one for each active spring.
        let mut band = Band::new(3 * self.program.blocks, self.bandwidth);
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
            let sign = pattern.slides[k].friction_sign();
            if sign != 0.0 {
                // Friction sign·μ·N with N = −g acts on the blocks as −sign·μ·g.
                enter(&self.tangents[k], &point.column, sign * self.program.contacts[k].friction);
            }
        }
        // Add the springs along the faces that stick.
        for (tangent, slides) in self.tangents.iter().zip(&pattern.slides) {
            if *slides == Slide::Sticks {
                enter(tangent, tangent, self.tangential_stiffness);
            }
        }
        for (grip, limit) in self.grips.iter().zip(&pattern.limits) {
            if *limit == 0.0 {
                enter(&grip.column, &grip.column, 1.0);
            }
        }
        // Add the springs to the ground.
        for row in 0..3 * self.program.blocks {
            band.add(row, row, ground);
        }
        band.factor()
    }

    /// Returns the row of the banded matrix that belongs to a row of the program.
    pub(super) fn row(&self, row: usize) -> usize {
        3 * self.position[row / 3] + row % 3
    }
}
