//! [`Column`]: one unknown force, at least 0, and its coefficients in the equilibrium equations.
//!
//! The columns of a contact are the generators of the friction cone at each application point: the pure normal force
//! n̂, and the normal force with full friction in either direction, (n̂ ± μ t̂)/(1 + μ). Each generator has the cost 1
//! in the objective. Every admissible contact force is a sum of generators with amounts ≥ 0, so the program needs no
//! inequality for friction. The optimum is the same as in [Vallat23](crate::doc::references) §2.0.3, which uses other
//! unknowns.

use super::{ContactTerm, GripTerm, Program};
use crate::geometry::{Vector, cross, quarter_turn};
use crate::mechanics::statics::effect::EffectName;
use crate::mechanics::statics::interface::ContactKind;

/// The force that a column represents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Force {
    /// A generator of the friction cone at an application point: friction is 0 or ±μ times the normal force.
    Ray {
        /// The index of the contact.
        contact: usize,
        /// The application point, 0 or 1.
        point: usize,
        /// Normal force per unit of the unknown.
        normal: f64,
        /// Friction per unit of the unknown, positive along (−n_y, n_x).
        friction: f64,
    },
    /// A component of a robot's force or torque, in the direction `sign`, up to the limit of the robot.
    Grip {
        /// The index of the grip.
        grip: usize,
        /// 0: force x, 1: force y, 2: torque divided by the length scale L.
        component: usize,
        /// +1 or −1.
        sign: f64,
    },
    /// A tensile force at an application point.
    AdhesionNormal {
        /// The index of the contact.
        contact: usize,
        /// The application point, 0 or 1.
        point: usize,
    },
    /// Friction that needs no normal force, along `sign` times the tangent.
    AdhesionFriction {
        /// The index of the contact.
        contact: usize,
        /// +1 or −1.
        sign: f64,
    },
    /// A component of a robot's force or torque, in the direction `sign`, regardless of the limit of the robot.
    AdhesionGrip {
        /// The index of the grip.
        grip: usize,
        /// 0: force x, 1: force y, 2: torque divided by the length scale L.
        component: usize,
        /// +1 or −1.
        sign: f64,
    },
}

impl Force {
    /// True if the force is adhesion (sticking), which no contact or robot can exert. It only shows which force is
    /// missing in a structure that falls.
    pub fn is_adhesion(&self) -> bool {
        matches!(self, Force::AdhesionNormal { .. } | Force::AdhesionFriction { .. } | Force::AdhesionGrip { .. })
    }

    /// Returns the effect that the force belongs to, such as friction or robots.
    fn effect(&self, program: &Program) -> EffectName {
        match *self {
            Force::Ray { contact, friction, .. } => match (program.contacts[contact].kind, friction) {
                (ContactKind::Corner, _) => EffectName::CornerContacts,
                (ContactKind::Edge, 0.0) => EffectName::Contact,
                (ContactKind::Edge, _) => EffectName::Friction,
            },
            Force::Grip { component: 2, .. } => EffectName::RobotTorque,
            Force::Grip { .. } => EffectName::Robots,
            Force::AdhesionNormal { .. } | Force::AdhesionFriction { .. } | Force::AdhesionGrip { .. } => {
                EffectName::Sticking
            }
        }
    }
}

/// One column of the program: a force, and its coefficients in the equilibrium equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// The coefficients as (row, value) pairs; only the first `count` pairs are used.
    places: [(usize, f64); 6],
    count: usize,
    /// The cost per unit of amount: 1 for every normal, friction or robot force, as in Vallat (2023).
    pub cost: f64,
    /// The largest amount; infinite if there is no limit.
    pub limit: f64,
    /// The force that the column represents.
    pub force: Force,
}

impl Column {
    /// Returns the nonzero coefficients of the column as (row, value) pairs.
    pub fn entries(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.filled().iter().copied()
    }

    fn filled(&self) -> &[(usize, f64)] {
        &self.places[..self.count]
    }

    /// True if two columns have the same coefficients, regardless of their rows, and the same limit.
    pub(crate) fn has_values_of(&self, other: &Column) -> bool {
        let mut pairs = self.filled().iter().zip(other.filled());
        self.count == other.count && pairs.all(|(own, its)| own.1 == its.1) && self.limit == other.limit
    }

    /// Returns the power of one unit of the force at the velocities `y` of the blocks: the inner product of the column
    /// and `y`. For a force between two blocks, this is the sum of the power on both blocks.
    pub fn dot(&self, y: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (row, value) in self.filled() {
            sum += value * y[*row];
        }
        sum
    }

    /// Returns the inner product of this column and another column.
    pub fn dot_column(&self, other: &Column) -> f64 {
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

    /// True if both columns have coefficients for a common body. The coefficients of each body are consecutive.
    fn shares_block(&self, other: &Column) -> bool {
        let blocks = |column: &Column| {
            let last = column.count.saturating_sub(1);
            [0, last].map(|place| column.places[place].0 / 3)
        };
        let own = blocks(self);
        blocks(other).iter().any(|block| own.contains(block))
    }

    /// Adds `amount` times this column to the vector `sum`, which has one element for each row.
    pub fn add_to(&self, sum: &mut [f64], amount: f64) {
        for (row, value) in self.filled() {
            sum[*row] += amount * value;
        }
    }

    fn new(force: Force, cost: f64, limit: f64) -> Column {
        Column { places: [(0, 0.0); 6], count: 0, cost, limit, force }
    }

    /// Appends the coefficients of a force on the body with index `block`, and of its moment about the centroid.
    fn enter(&mut self, block: usize, force: Vector, moment: f64) {
        for (offset, value) in [force.x, force.y, moment].into_iter().enumerate() {
            if value != 0.0 {
                self.places[self.count] = (3 * block + offset, value);
                self.count += 1;
            }
        }
    }
}

/// The number of unknowns (columns) of each effect in a program.
#[derive(Clone, Debug, Default)]
pub struct UnknownCounts {
    /// The effects that have unknowns. The list is so short that a linear search is fastest.
    counts: Vec<(EffectName, usize)>,
}

impl UnknownCounts {
    /// Counts the unknowns of a program for each effect, of admissible and of adhesive forces. The columns of many blocks
    /// would take gigabytes, so they are not kept.
    pub fn new(program: &Program) -> UnknownCounts {
        let mut counts = UnknownCounts::default();
        each_column(program, |column| counts.add(column.force.effect(program), 1));
        each_adhesion_column(program, |column| counts.add(column.force.effect(program), 1));
        counts
    }

    /// Returns the number of unknowns (columns) of an effect; 0 if it has none.
    pub fn get(&self, effect: EffectName) -> usize {
        let entry = self.counts.iter().find(|entry| entry.0 == effect);
        entry.map_or(0, |entry| entry.1)
    }

    /// Returns the sum of two counts, separately for each effect.
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

/// Returns the columns of all forces that contacts and robots can exert: contacts first, then grips.
pub fn columns(program: &Program) -> Vec<Column> {
    let mut columns = Vec::with_capacity(6 * program.contacts.len() + 4 * program.grips.len());
    each_column(program, |column| columns.push(column));
    columns
}

/// Makes one column of [`columns`] after the other.
fn each_column(program: &Program, mut add: impl FnMut(Column)) {
    for (number, contact) in program.contacts.iter().enumerate() {
        for point in 0..contact.points {
            let mu = contact.friction;
            for side in if mu > 0.0 { &[0.0, 1.0, -1.0][..] } else { &[0.0][..] } {
                // Scale each generator so that the magnitudes of its normal force and its friction sum to 1. Columns
                // then have similar sizes for every friction coefficient.
                let (normal, friction) =
                    if *side == 0.0 { (1.0, 0.0) } else { (1.0 / (1.0 + mu), side * mu / (1.0 + mu)) };
                let force = Force::Ray { contact: number, point, normal, friction };
                let direction = contact.normal * normal + quarter_turn(contact.normal) * friction;
                add(contact_column(contact, point, direction, force, 1.0));
            }
        }
    }
    for (number, grip) in program.grips.iter().enumerate() {
        for component in (0..3).filter(|c| grip.limits[*c] > 0.0) {
            for sign in [1.0, -1.0] {
                let force = Force::Grip { grip: number, component, sign };
                add(grip_column(grip, component, sign, force, grip.limits[component]));
            }
        }
    }
}

/// Returns the columns of all adhesive forces of a program. Adhesive forces have no limits. The columns of the contacts
/// come first, then those of the grips: forces and torques of robots beyond their limits.
///
/// They correspond to the negative forces of [Vallat23](crate::doc::references) §2.0.8. Each contact has adhesive
/// friction, with one column for each direction, at only one of its application points, because friction forces at both
/// points act along the same line.
pub fn adhesion_columns(program: &Program) -> Vec<Column> {
    let mut columns = Vec::with_capacity(4 * program.contacts.len() + 6 * program.grips.len());
    each_adhesion_column(program, |column| columns.push(column));
    columns
}

/// Makes one column of [`adhesion_columns`] after the other.
fn each_adhesion_column(program: &Program, mut add: impl FnMut(Column)) {
    for (number, contact) in program.contacts.iter().enumerate() {
        for point in 0..contact.points {
            let force = Force::AdhesionNormal { contact: number, point };
            add(contact_column(contact, point, -contact.normal, force, 1.0));
        }
        for sign in [1.0, -1.0] {
            let force = Force::AdhesionFriction { contact: number, sign };
            add(contact_column(contact, 0, quarter_turn(contact.normal) * sign, force, 1.0));
        }
    }
    for (number, grip) in program.grips.iter().enumerate() {
        for component in 0..3 {
            for sign in [1.0, -1.0] {
                let force = Force::AdhesionGrip { grip: number, component, sign };
                add(grip_column(grip, component, sign, force, f64::INFINITY));
            }
        }
    }
}

/// Creates the column of a force at an application point of a contact. If the contact has a second body, the opposite
/// force acts on that body.
fn contact_column(contact: &ContactTerm, point: usize, direction: Vector, force: Force, cost: f64) -> Column {
    let mut column = Column::new(force, cost, f64::INFINITY);
    let (on, arms) = contact.on;
    column.enter(on, direction, cross(arms[point], direction));
    if let Some((from, arms)) = contact.from {
        column.enter(from, -direction, -cross(arms[point], direction));
    }
    column
}

/// Creates the column of one component of a robot's force or torque, in the direction `sign` (−1 or 1).
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
