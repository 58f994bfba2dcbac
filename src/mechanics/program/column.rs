//! [`Column`]: one force of amount ≥ 0 and the balance rows it enters. Where a force enters the
//! balance rows is worked out here.
//!
//! Admissible contact forces are the generators of the friction cone of each application point: the normal alone and the
//! normal with full friction either way, (n̂ ± μ t̂)/(1 + μ), each at cost 1 a unit. Every admissible contact force is a
//! sum of these with amounts ≥ 0, so no inequality rows remain ([Vallat23](crate::doc::references) §2.0.3 in other
//! unknowns, the same optimum).

use super::{ContactTerm, GripTerm, Program};
use crate::effect::EffectName;
use crate::geometry::{Vector, cross, quarter_turn};
use crate::interface::ContactKind;

/// Which force a column stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {
    /// A pressing force at an application point of a contact, with friction of 0 or ±μ times the normal force.
    Ray {
        /// The contact.
        contact: usize,
        /// The application point, 0 or 1.
        point: usize,
        /// Normal force per unit.
        normal: f64,
        /// Friction per unit, signed along (−n_y, n_x).
        friction: f64,
    },
    /// A robot's force (component 0, 1) or torque (2), along `sign`.
    Grip {
        /// The grip.
        grip: usize,
        /// 0: force x, 1: force y, 2: torque/L.
        component: usize,
        /// +1 or −1.
        sign: f64,
    },
    /// A pull at an application point.
    StickNormal {
        /// The contact.
        contact: usize,
        /// The application point.
        point: usize,
    },
    /// Friction that needs no pressure, along `sign` times the tangent.
    StickFriction {
        /// The contact.
        contact: usize,
        /// +1 or −1.
        sign: f64,
    },
    /// A robot's component beyond its limits.
    StickGrip {
        /// The grip.
        grip: usize,
        /// 0: force x, 1: force y, 2: torque/L.
        component: usize,
        /// +1 or −1.
        sign: f64,
    },
}

impl Force {
    /// Whether the force is sticking, not admissible.
    pub fn is_sticking(&self) -> bool {
        matches!(
            self,
            Force::StickNormal { .. } | Force::StickFriction { .. } | Force::StickGrip { .. }
        )
    }

    /// The effect that the force belongs to.
    fn effect(&self, program: &Program) -> EffectName {
        match *self {
            Force::Ray {
                contact, friction, ..
            } => match (program.contacts[contact].kind, friction) {
                (ContactKind::Corner, _) => EffectName::CornerContacts,
                (ContactKind::Edge, 0.0) => EffectName::Contact,
                (ContactKind::Edge, _) => EffectName::Friction,
            },
            Force::Grip { component: 2, .. } => EffectName::RobotTorque,
            Force::Grip { .. } => EffectName::Robots,
            Force::StickNormal { .. } | Force::StickFriction { .. } | Force::StickGrip { .. } => {
                EffectName::Sticking
            }
        }
    }
}

/// One force and its place in the balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Rows and values, of which the first `count` stand for something.
    places: [(usize, f64); 6],
    count: usize,
    /// What it costs per unit: the source's weight of 1 per normal, friction or robot unknown.
    pub cost: f64,
    /// Largest amount, infinite without limit.
    pub limit: f64,
    /// What it stands for.
    pub force: Force,
}

impl Column {
    /// The nonzero entries as (row, value).
    pub fn entries(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.filled().iter().copied()
    }

    fn filled(&self) -> &[(usize, f64)] {
        &self.places[..self.count]
    }

    /// Whether another column has the same values, in whichever rows, and the same limit.
    pub(crate) fn has_values_of(&self, other: &Column) -> bool {
        let mut pairs = self.filled().iter().zip(other.filled());
        self.count == other.count
            && pairs.all(|(own, its)| own.1 == its.1)
            && self.limit == other.limit
    }

    /// The column's product with virtual velocities `y`: the velocity against which the force works.
    pub fn dot(&self, y: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (row, value) in self.filled() {
            sum += value * y[*row];
        }
        sum
    }

    /// The product of two columns.
    pub fn times(&self, other: &Column) -> f64 {
        if !self.shares_block(other) {
            return 0.0;
        }
        let mut sum = 0.0;
        for (row, value) in other.filled() {
            for (own, v) in self.filled() {
                if own == row {
                    sum += v * value;
                }
            }
        }
        sum
    }

    /// Whether both act on one block. The entries of a block stand together.
    fn shares_block(&self, other: &Column) -> bool {
        let blocks = |column: &Column| {
            let last = column.count.saturating_sub(1);
            [0, last].map(|place| column.places[place].0 / 3)
        };
        let own = blocks(self);
        blocks(other).iter().any(|block| own.contains(block))
    }

    /// Adds `amount` of the column to `sum`.
    pub fn add_to(&self, sum: &mut [f64], amount: f64) {
        for (row, value) in self.filled() {
            sum[*row] += amount * value;
        }
    }

    /// The difference of two columns that enter the same blocks.
    pub(super) fn less(&self, other: &Column) -> Column {
        let mut difference = Column { count: 0, ..*self };
        let mut put = |row: usize, value: f64| match (0..difference.count)
            .find(|i| difference.places[*i].0 == row)
        {
            Some(i) => difference.places[i].1 += value,
            None => {
                difference.places[difference.count] = (row, value);
                difference.count += 1;
            }
        };
        self.entries().for_each(|(row, value)| put(row, value));
        other.entries().for_each(|(row, value)| put(row, -value));
        difference
    }

    fn new(force: Force, cost: f64, limit: f64) -> Column {
        Column {
            places: [(0, 0.0); 6],
            count: 0,
            cost,
            limit,
            force,
        }
    }

    /// Enters a force with an arm about the block's centroid, and a torque.
    fn enter(&mut self, block: usize, force: Vector, moment: f64) {
        for (offset, value) in [force.x, force.y, moment].into_iter().enumerate() {
            if value != 0.0 {
                self.places[self.count] = (3 * block + offset, value);
                self.count += 1;
            }
        }
    }
}

/// The number of unknowns that each effect has in a program.
#[derive(Clone, Debug, Default)]
pub struct UnknownCounts {
    /// The effects that have unknowns. The list is so short that a linear search is quickest.
    counts: Vec<(EffectName, usize)>,
}

impl UnknownCounts {
    /// Counts the columns of a program by the effect that each belongs to.
    pub fn new<'a>(
        program: &Program,
        columns: impl IntoIterator<Item = &'a Column>,
    ) -> UnknownCounts {
        let mut counts = UnknownCounts::default();
        for column in columns {
            counts.add(column.force.effect(program), 1);
        }
        counts
    }

    /// The number of unknowns of an effect; 0 for an effect without columns of its own.
    pub fn get(&self, effect: EffectName) -> usize {
        let entry = self.counts.iter().find(|entry| entry.0 == effect);
        entry.map_or(0, |entry| entry.1)
    }

    /// The sum of two counts, effect by effect.
    pub fn plus(mut self, other: &UnknownCounts) -> UnknownCounts {
        for (effect, count) in &other.counts {
            self.add(*effect, *count);
        }
        self
    }

    fn add(&mut self, effect: EffectName, count: usize) {
        match self.counts.iter_mut().find(|entry| entry.0 == effect) {
            Some(entry) => entry.1 += count,
            None => self.counts.push((effect, count)),
        }
    }
}

/// Every admissible force of a program.
pub fn columns(program: &Program) -> Vec<Column> {
    let mut columns = Vec::with_capacity(6 * program.contacts.len() + 4 * program.grips.len());
    for (number, contact) in program.contacts.iter().enumerate() {
        for point in 0..contact.points {
            let mu = contact.friction;
            for side in if mu > 0.0 {
                &[0.0, 1.0, -1.0][..]
            } else {
                &[0.0][..]
            } {
                // A unit of any generator costs 1, so that rough and smooth contacts look alike to the solver.
                let (normal, friction) = if *side == 0.0 {
                    (1.0, 0.0)
                } else {
                    (1.0 / (1.0 + mu), side * mu / (1.0 + mu))
                };
                let force = Force::Ray {
                    contact: number,
                    point,
                    normal,
                    friction,
                };
                let direction = contact.normal * normal + quarter_turn(contact.normal) * friction;
                columns.push(contact_column(contact, point, direction, force, 1.0));
            }
        }
    }
    for (number, grip) in program.grips.iter().enumerate() {
        for component in (0..3).filter(|c| grip.limits[*c] > 0.0) {
            for sign in [1.0, -1.0] {
                let force = Force::Grip {
                    grip: number,
                    component,
                    sign,
                };
                columns.push(grip_column(
                    grip,
                    component,
                    sign,
                    force,
                    grip.limits[component],
                ));
            }
        }
    }
    columns
}

/// Every sticking force of a program: the opposite partner of each of the source's columns
/// ([Vallat23](crate::doc::references) §2.0.8), unbounded.
///
/// Sticking friction is one force per interface, because both corners' act along the same line.
pub fn sticking_columns(program: &Program) -> Vec<Column> {
    let mut columns = Vec::with_capacity(4 * program.contacts.len() + 6 * program.grips.len());
    for (number, contact) in program.contacts.iter().enumerate() {
        for point in 0..contact.points {
            let force = Force::StickNormal {
                contact: number,
                point,
            };
            columns.push(contact_column(contact, point, -contact.normal, force, 1.0));
        }
        for sign in [1.0, -1.0] {
            let force = Force::StickFriction {
                contact: number,
                sign,
            };
            columns.push(contact_column(
                contact,
                0,
                quarter_turn(contact.normal) * sign,
                force,
                1.0,
            ));
        }
    }
    for (number, grip) in program.grips.iter().enumerate() {
        for component in 0..3 {
            for sign in [1.0, -1.0] {
                let force = Force::StickGrip {
                    grip: number,
                    component,
                    sign,
                };
                columns.push(grip_column(grip, component, sign, force, f64::INFINITY));
            }
        }
    }
    columns
}

fn contact_column(
    contact: &ContactTerm,
    point: usize,
    direction: Vector,
    force: Force,
    cost: f64,
) -> Column {
    let mut column = Column::new(force, cost, f64::INFINITY);
    let (on, arms) = contact.on;
    column.enter(on, direction, cross(arms[point], direction));
    if let Some((from, arms)) = contact.from {
        column.enter(from, -direction, -cross(arms[point], direction));
    }
    column
}

fn grip_column(grip: &GripTerm, component: usize, sign: f64, force: Force, limit: f64) -> Column {
    let mut column = Column::new(force, 1.0, limit);
    let direction = match component {
        0 => Vector::new(sign, 0.0),
        1 => Vector::new(0.0, sign),
        _ => Vector::zeros(),
    };
    let torque = if component == 2 { sign } else { 0.0 };
    column.enter(grip.block, direction, cross(grip.arm, direction) + torque);
    column
}
