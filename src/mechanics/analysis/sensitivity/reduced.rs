//! [`Reduced`]: equilibrium equations for groups of bodies that move as one rigid body at the limit of stability.
//!
//! Each group has three rows: force x, force y, and moment about a common origin, divided by the length L. Forces are
//! in units of the program.
//!
//! [`State`]: the forces and the mechanism of a component at an end of an interval, where it begins to fall.
//!
//! [`Unknown`]: the unknown forces of contacts and robots at the limit of stability, and the groups of bodies that
//! these forces hold together.

use super::case::{Case, load_at};
use super::elimination::ROUNDING_TOL;
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::analysis::margin::{END_TOL, MarginKind};
use crate::mechanics::program::{Force, Program};
use crate::mechanics::proof::ContactForces;
use crate::mechanics::solve::LimitState;
use crate::mechanics::statics::assembly::{Assembly, DisjointSets, LoadVector};

/// The equilibrium equations of the groups.
pub(super) struct Reduced {
    /// The index of the group of each body; `None` if the body rests with the ground.
    group: Vec<Option<usize>>,
    /// The number of groups.
    pub groups: usize,
    /// The forces between groups.
    pub unknowns: Vec<Unknown>,
    /// The grip forces that are at their limit: the index of the grip, the component (0 force x, 1 force y, 2 torque),
    /// and the force in program units.
    limits: Vec<(usize, usize, f64)>,
    /// The motion of each group in the mechanism of the program: velocity x, velocity y, and spin times L.
    pub motion: Vec<f64>,
    /// The largest load component of a body, in units of the program.
    pub load: f64,
    origin: Point,
    length: f64,
    force: f64,
}

impl Reduced {
    /// Groups the bodies that contacts or robots hold together at the limit of stability, and keeps the forces between
    /// these groups as unknowns.
    pub fn new(case: &Case, program: &Program, solved: &LimitState) -> Reduced {
        let given = case.component;
        let (all, limits) = unknowns(program, solved);
        let (group, groups) = groups(given, &all);
        let is_between = |unknown: &Unknown| match unknown.source {
            Source::Contact { contact, .. } => {
                let contact = &given.contacts[contact];
                group[contact.on] != contact.from.and_then(|from| group[from])
            }
            Source::Grip { grip, .. } => group[given.grips[grip].body].is_some(),
        };
        let centroids = given.bodies.iter().map(|body| body.centroid.coords);
        let origin = Point::from(centroids.sum::<Vector>() / given.bodies.len() as f64);
        let length = program.scale.length;
        let mut motion = vec![0.0; 3 * groups];
        for (number, body) in given.bodies.iter().enumerate() {
            if let Some(group) = group[number] {
                let [u, v, spin] = [0, 1, 2].map(|row| solved.motion[3 * number + row]);
                // Compute the velocity at the common origin, as if the origin moved with this body.
                let arm = quarter_turn(origin - body.centroid) * (spin / length);
                motion[3 * group..3 * group + 3].copy_from_slice(&[u + arm.x, v + arm.y, spin]);
            }
        }
        Reduced {
            unknowns: all.into_iter().filter(is_between).collect(),
            limits,
            motion,
            load: program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs())),
            origin,
            length,
            force: program.scale.force,
            group,
            groups,
        }
    }

    /// Returns the indices of the basic unknowns: the forces that may differ from 0.
    pub fn basic(&self) -> impl Iterator<Item = usize> + '_ {
        let all = self.unknowns.iter().enumerate();
        all.filter(|(_, unknown)| unknown.is_basic).map(|(k, _)| k)
    }

    /// True if some robot force at its limit has a power of at most `speed` per unit of force. The motion then does not
    /// show whether this force stays at its limit.
    pub fn has_idle_limit(&self, changed: &Assembly, speed: f64, motion: &[f64]) -> bool {
        self.limits.iter().any(|(grip, component, _)| {
            let source = Source::Grip { grip: *grip, component: *component };
            let entries = self.entries(changed, source).into_iter();
            let power: f64 = entries.map(|(row, value)| value * motion[row]).sum();
            power.abs() <= speed
        })
    }

    /// Returns the column of an unknown force in the equilibrium equations, as (row, value) for a force of one unit.
    fn entries(&self, changed: &Assembly, source: Source) -> Vec<(usize, f64)> {
        match source {
            Source::Contact { contact, point, side } => {
                let contact = &changed.contacts[contact];
                let force = contact.normal + contact.tangent() * (side * contact.friction);
                let at = contact.points[point];
                let mut entries = self.wrench(contact.on, at, force, 0.0);
                if let Some(from) = contact.from {
                    entries.extend(self.wrench(from, at, -force, 0.0));
                }
                entries
            }
            Source::Grip { grip, component } => {
                let grip = &changed.grips[grip];
                let (force, torque) = match component {
                    0 => (Vector::new(1.0, 0.0), 0.0),
                    1 => (Vector::new(0.0, 1.0), 0.0),
                    _ => (Vector::zeros(), self.length),
                };
                self.wrench(grip.body, grip.at, force, torque)
            }
        }
    }

    /// Returns the entries (row, value) of a force at a point of a body, plus a torque, in the equilibrium equations.
    /// Empty if the body is at rest with the ground.
    fn wrench(&self, body: usize, at: Point, force: Vector, torque: f64) -> Vec<(usize, f64)> {
        let Some(group) = self.group[body] else {
            return Vec::new();
        };
        let moment = (cross(at - self.origin, force) + torque) / self.length;
        let row = 3 * group;
        vec![(row, force.x), (row + 1, force.y), (row + 2, moment)]
    }

    /// Returns the sum of the loads on each group: force x, force y and moment/L. Forces are in the unit of `loads`.
    pub fn grouped(&self, changed: &Assembly, loads: &[LoadVector]) -> Vec<f64> {
        let mut sum = vec![0.0; 3 * self.groups];
        for ((body, group), load) in changed.bodies.iter().zip(&self.group).zip(loads) {
            if let Some(group) = group {
                let [x, y, moment] = load_at(load, body.centroid, self.origin);
                for (row, value) in [x, y, moment / self.length].into_iter().enumerate() {
                    sum[3 * group + row] += value;
                }
            }
        }
        sum
    }

    /// Returns the rows of the equilibrium equations, with one column for each unknown in `chosen`.
    pub fn rows(&self, changed: &Assembly, chosen: &[usize]) -> Vec<Vec<f64>> {
        let mut rows = vec![vec![0.0; chosen.len()]; 3 * self.groups];
        for (column, place) in chosen.iter().enumerate() {
            for (row, value) in self.entries(changed, self.unknowns[*place].source) {
                rows[row][column] += value;
            }
        }
        rows
    }

    /// Returns the power that one unit of an unknown force has along a motion of the groups.
    pub fn power(&self, changed: &Assembly, unknown: &Unknown, motion: &[f64]) -> f64 {
        let entries = self.entries(changed, unknown.source).into_iter();
        entries.map(|(row, value)| value * motion[row]).sum()
    }

    /// Returns the amount of every force between groups, and of every grip force at its limit.
    fn amounts<'s>(&'s self, amounts: &'s [f64]) -> impl Iterator<Item = (Source, f64)> + 's {
        let limits = self.limits.iter().map(|(grip, component, amount)| {
            let source = Source::Grip { grip: *grip, component: *component };
            (source, *amount)
        });
        self.unknowns.iter().zip(amounts).map(|(unknown, amount)| (unknown.source, *amount)).chain(limits)
    }

    /// Returns the unbalanced force of each group (force x, force y, moment/L), in units of the program.
    pub fn residual(&self, changed: &Assembly, amounts: &[f64]) -> Vec<f64> {
        let loads: Vec<LoadVector> = changed.bodies.iter().map(|body| body.load).collect();
        let mut sum = self.grouped(changed, &loads);
        sum.iter_mut().for_each(|v| *v /= self.force);
        for (source, amount) in self.amounts(amounts) {
            for (row, value) in self.entries(changed, source) {
                sum[row] += amount * value;
            }
        }
        sum
    }

    /// Returns the derivative of [`Reduced::residual`] with respect to the parameter, at `value`.
    /// `changed` is the component with the parameter at `value`. The amounts stay the same.
    pub fn growth(&self, case: &Case, changed: &Assembly, amounts: &[f64], value: f64) -> Vec<f64> {
        if let Some(growth) = case.growth(value) {
            let mut sum = self.grouped(changed, &growth);
            sum.iter_mut().for_each(|v| *v /= self.force);
            return sum;
        }
        let mut sum = vec![0.0; 3 * self.groups];
        for (unknown, amount) in self.unknowns.iter().zip(amounts) {
            let Source::Contact { contact, point, side } = unknown.source else {
                continue;
            };
            let contact = &changed.contacts[contact];
            // A larger friction coefficient increases the tangential force. A larger kernel moves both points inward,
            // each by half the length of the contact per unit.
            let (force, torque) = match case.kind {
                MarginKind::Friction => (contact.tangent() * (side * amount), 0.0),
                MarginKind::FrictionFactor => {
                    let share = if contact.is_factored { contact.friction / value } else { 0.0 };
                    (contact.tangent() * (side * amount * share), 0.0)
                }
                _ => {
                    let inward = (contact.ends[1] - contact.ends[0]) * [0.5, -0.5][point];
                    let force = contact.normal + contact.tangent() * (side * contact.friction);
                    (Vector::zeros(), cross(inward, force) * amount)
                }
            };
            let at = contact.points[point];
            let mut entries = self.wrench(contact.on, at, force, torque);
            if let Some(from) = contact.from {
                entries.extend(self.wrench(from, at, -force, -torque));
            }
            for (row, value) in entries {
                sum[row] += value;
            }
        }
        sum
    }

    /// Converts forces and motion to a [`State`]: contact forces in newtons, motions of all bodies in metres, and power
    /// per unit of the parameter.
    pub fn state(&self, case: &Case, changed: &Assembly, motion: &[f64], amounts: &[f64], value: f64) -> State {
        let motions = self.group.iter().map(|group| {
            group.map_or(RigidMotion::REST, |group| RigidMotion {
                origin: self.origin,
                velocity: Vector::new(motion[3 * group], motion[3 * group + 1]),
                spin: motion[3 * group + 2] / self.length,
            })
        });
        let none = ContactForces { normal: [0.0; 2], friction: 0.0 };
        let mut forces = vec![none; changed.contacts.len()];
        let mut grips = vec![Vector::zeros(); changed.grips.len()];
        for (source, amount) in self.amounts(amounts) {
            let amount = amount * self.force;
            match source {
                Source::Contact { contact, point, side } => {
                    forces[contact].normal[point] += amount;
                    forces[contact].friction += side * changed.contacts[contact].friction * amount;
                }
                Source::Grip { grip, component } if component < 2 => grips[grip][component] += amount,
                Source::Grip { .. } => {}
            }
        }
        let growth = self.growth(case, changed, amounts, value);
        let work = growth.iter().zip(motion).map(|(g, v)| g * v).sum::<f64>();
        State { motions: motions.collect(), forces, grips, work: work * self.force }
    }
}

/// The rigid motion of a body: the velocity at `origin`, and the angular velocity.
#[derive(Clone, Copy, Debug)]
pub(super) struct RigidMotion {
    pub origin: Point,
    pub velocity: Vector,
    pub spin: f64,
}

impl RigidMotion {
    /// No motion.
    pub const REST: RigidMotion =
        RigidMotion { origin: Point::new(0.0, 0.0), velocity: Vector::new(0.0, 0.0), spin: 0.0 };

    /// Returns the velocity of a point that moves with the body.
    pub fn at(&self, point: Point) -> Vector {
        self.velocity + quarter_turn(point - self.origin) * self.spin
    }
}

/// Forces and a mechanism at the end of an interval.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// The motion of each body.
    pub motions: Vec<RigidMotion>,
    /// The forces of each contact in newtons; 0 for contacts inside a group of bodies that move as one rigid body.
    pub forces: Vec<ContactForces>,
    /// The force of each grip in newtons; 0 for robots that hold their body at rest.
    pub grips: Vec<Vector>,
    /// The derivative, with respect to the parameter, of the power of all forces along the motions.
    pub work: f64,
}

impl State {
    /// Returns the change of the power of a force on a body, per metre that the point of the force moves along x and
    /// along y. If the point moves by d, the power changes by spin · (d × force).
    pub fn power_per_shift(&self, body: usize, force: Vector) -> Vector {
        -quarter_turn(force) * self.motions[body].spin
    }
}

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
                    // The force does no work along the mechanism, as far as rounding tells.
                    is_basic: share > ROUNDING_TOL && share > power,
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
            // The end is known to this accuracy, and so is the force of a robot at its limit.
            if limit > 0.0 && amount.abs() >= limit * (1.0 - END_TOL) {
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
