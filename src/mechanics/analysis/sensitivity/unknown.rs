//! [`Unknown`]: the unknown forces of contacts and robots at the limit of stability, and the groups of bodies that
//! these forces hold together.

use crate::mechanics::program::{Force, Program};
use crate::mechanics::solve::LimitState;
use crate::mechanics::statics::assembly::{Assembly, DisjointSets};

/// A force is basic if the ratio of its amount to the largest amount is larger than this. This ratio must also be
/// larger than the power of one unit of the force along the mechanism, relative to the largest velocity.
const BASIC_TOL: f64 = 1e-8;

/// The force of a robot counts as being at its limit if it differs from the limit by at most this fraction of the
/// limit.
const LIMIT_TOL: f64 = 1e-6;

/// A force whose amount is unknown.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unknown {
    pub source: Source,
    /// The amount of the force in the solution of the program. It is not negative unless the force can act in both
    /// directions.
    pub amount: f64,
    /// True if the force may be different from 0 in equilibrium.
    pub is_basic: bool,
    /// True if the amount may be negative.
    pub is_both_ways: bool,
}

/// The point of application and the direction of a force.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// One unit of normal force at a point of a contact, with the largest friction along `side` times the tangent.
    Contact { contact: usize, point: usize, side: f64 },
    /// One unit of force x, force y or torque of a grip (component 0, 1 or 2).
    Grip { grip: usize, component: usize },
}

/// Returns the unknown forces of contacts and grips. Also returns the components of grip forces that are at their
/// limits, as (grip, component, force).
pub(super) fn unknowns(program: &Program, solved: &LimitState) -> (Vec<Unknown>, Vec<(usize, usize, f64)>) {
    let size = |list: &[f64]| list.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let (force, speed) = (size(&solved.amounts), size(&solved.motion));
    let mut unknowns = Vec::new();
    let mut grips = vec![[0.0; 3]; program.grips.len()];
    for (column, amount) in solved.columns.iter().zip(&solved.amounts) {
        match column.force {
            Force::Ray { contact, point, normal, friction } => {
                let power = column.dot(&solved.motion).abs() / speed;
                let share = amount / force;
                unknowns.push(Unknown {
                    source: Source::Contact {
                        contact,
                        point,
                        side: match friction {
                            0.0 => 0.0,
                            _ => friction.signum(),
                        },
                    },
                    amount: amount * normal,
                    is_basic: share > BASIC_TOL && share > power,
                    is_both_ways: false,
                });
            }
            Force::Grip { grip, component, sign } => grips[grip][component] += sign * amount,
            _ => {}
        }
    }
    let mut limits = Vec::new();
    for (grip, (forces, term)) in grips.iter().zip(&program.grips).enumerate() {
        for (component, amount) in forces.iter().copied().enumerate() {
            let limit = term.limits[component];
            if limit > 0.0 && amount.abs() >= limit * (1.0 - LIMIT_TOL) {
                limits.push((grip, component, limit * amount.signum()));
            } else if limit > 0.0 {
                unknowns.push(Unknown {
                    source: Source::Grip { grip, component },
                    amount,
                    is_basic: true,
                    is_both_ways: true,
                });
            }
        }
    }
    (unknowns, limits)
}

/// Returns the group of each body, and the number of groups. The group is `None` for a body at rest with the ground.
///
/// A contact holds its bodies together if both of its points have basic forces, and one point has them on both edges of
/// its friction cone. Then the bodies cannot move relative to each other. A robot holds a body if its force x, force y
/// and torque are all below their limits.
pub(super) fn groups(given: &Assembly, unknowns: &[Unknown]) -> (Vec<Option<usize>>, usize) {
    let ground = given.bodies.len();
    let mut sets = DisjointSets::new(ground + 1);
    let mut sides = vec![[0_usize; 2]; given.contacts.len()];
    let mut held = vec![0_usize; given.grips.len()];
    for unknown in unknowns.iter().filter(|unknown| unknown.is_basic) {
        match unknown.source {
            Source::Contact { contact, point, .. } => sides[contact][point] += 1,
            Source::Grip { grip, .. } => held[grip] += 1,
        }
    }
    for (contact, sides) in given.contacts.iter().zip(sides) {
        if sides.iter().min() >= Some(&1) && sides.iter().max() >= Some(&2) {
            sets.union(contact.on, contact.from.unwrap_or(ground));
        }
    }
    for (grip, held) in given.grips.iter().zip(held) {
        if held == 3 {
            sets.union(grip.body, ground);
        }
    }
    let fixed = sets.find(ground);
    let mut numbers: Vec<Option<usize>> = vec![None; ground + 1];
    let mut count = 0;
    let group = (0..ground).map(|body| {
        let root = sets.find(body);
        if root == fixed {
            return None;
        }
        if numbers[root].is_none() {
            numbers[root] = Some(count);
            count += 1;
        }
        numbers[root]
    });
    let group = group.collect();
    (group, count)
}
