//! [`Amounts`]: the forces at all contacts and grips of a structure. [`Balance`]: the result of a program that looks for
//! such forces. [`Effort`]: how many programs were solved for a result, and how many iterations
//! they took.

use crate::geometry::{Vector, cross, quarter_turn};
use crate::mechanics::program::{Column, Force, Program};

/// The forces at all contacts and grips of a program, in program units.
#[derive(Clone, Debug, PartialEq)]
pub struct Amounts {
    /// Per contact: the normal forces at its two application points, ≥ 0. In `Balance::adhesion` they are tensile
    /// forces.
    pub normal: Vec<[f64; 2]>,
    /// Per contact: the friction along the tangent (−n_y, n_x), where n is the contact's normal.
    pub friction: Vec<f64>,
    /// Per grip: the force x, force y and torque/L on the held block, where L is the unit of length of the program.
    pub grip: Vec<[f64; 3]>,
}

impl Amounts {
    /// Returns amounts in which every force of the program is zero.
    pub fn zero(program: &Program) -> Amounts {
        Amounts {
            normal: vec![[0.0; 2]; program.contacts.len()],
            friction: vec![0.0; program.contacts.len()],
            grip: vec![[0.0; 3]; program.grips.len()],
        }
    }

    /// Returns the sum of the absolute values of all forces, Σ (N1 + N2 + |T|) + Σ (|Fx| + |Fy| + |M|/L): the objective
    /// of Vallat (2023). L is the unit of length of the program.
    pub fn total(&self) -> f64 {
        let contacts: f64 = self.normal.iter().flatten().chain(&self.friction).map(|v| v.abs()).sum();
        contacts + self.grip.iter().flatten().map(|v| v.abs()).sum::<f64>()
    }

    /// Returns the largest absolute entry of the residual, loads − Σ force, in program units. It is 0 if every block is
    /// balanced.
    pub fn unbalanced(&self, program: &Program) -> f64 {
        let mut residual = program.loads.clone();
        // Subtracts a force and its moment from the residual, in the three rows of a block.
        let mut act = |block: usize, force: Vector, moment: f64| {
            for (row, value) in [force.x, force.y, moment].into_iter().enumerate() {
                residual[3 * block + row] -= value;
            }
        };
        for (k, contact) in program.contacts.iter().enumerate() {
            let (normal, tangent) = (contact.normal, quarter_turn(contact.normal));
            let [first, second] = self.normal[k].map(|amount| normal * amount);
            let first = first + tangent * self.friction[k];
            // The contact force acts on the block `on` and, with the opposite sign, on the block `from`.
            let both = [(contact.on, 1.0)].into_iter();
            for ((block, arms), sign) in both.chain(contact.from.map(|from| (from, -1.0))) {
                let moment = cross(arms[0], first) + cross(arms[1], second);
                act(block, (first + second) * sign, moment * sign);
            }
        }
        for (grip, [x, y, moment]) in program.grips.iter().zip(&self.grip) {
            let force = Vector::new(*x, *y);
            act(grip.block, force, cross(grip.arm, force) + moment);
        }
        largest(&residual)
    }

    /// Multiplies every force by a factor.
    pub(super) fn multiply(&mut self, factor: f64) {
        self.all_mut().for_each(|v| *v *= factor);
    }

    /// Adds other forces to these, contact by contact and grip by grip.
    pub fn add_all(&mut self, other: &Amounts) {
        let others = other.normal.iter().flatten().chain(&other.friction).chain(other.grip.iter().flatten());
        self.all_mut().zip(others).for_each(|(v, more)| *v += more);
    }

    fn all_mut(&mut self) -> impl Iterator<Item = &mut f64> {
        self.normal.iter_mut().flatten().chain(&mut self.friction).chain(self.grip.iter_mut().flatten())
    }

    /// Adds `amount` times the unit force `force` to the forces of its contact or grip.
    pub fn add(&mut self, force: Force, amount: f64) {
        match force {
            Force::Ray { contact, point, normal, friction } => {
                self.normal[contact][point] += normal * amount;
                self.friction[contact] += friction * amount;
            }
            Force::AdhesionNormal { contact, point } => self.normal[contact][point] += amount,
            Force::AdhesionFriction { contact, sign } => self.friction[contact] += sign * amount,
            Force::Grip { grip, component, sign } | Force::AdhesionGrip { grip, component, sign } => {
                self.grip[grip][component] += sign * amount;
            }
        }
    }
}

/// The amount of computation that a result needed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// The number of interior-point iterations, over all programs.
    pub iterations: usize,
    /// The number of programs that were solved.
    pub programs: usize,
}

impl Effort {
    /// Returns the sum of two efforts: the numbers of iterations and of programs are each added.
    pub fn plus(self, other: Effort) -> Effort {
        Effort { iterations: self.iterations + other.iterations, programs: self.programs + other.programs }
    }
}

/// The result of a program that looks for forces that balance every block, with or without adhesion. If `forces`,
/// `adhesion` and `motion` are all `None`, the solver ended without a result.
#[derive(Clone, Debug, Default)]
pub struct Balance {
    /// Admissible forces (pressure, friction and robot forces within their limits) that balance every block, together
    /// with the adhesion if there is any. `None` if there are no such forces.
    pub forces: Option<Amounts>,
    /// The adhesion (tension, and friction and robot forces beyond their limits) of the balance with the least
    /// adhesion. `None` if the program has no adhesion, or if not even adhesion balances every block.
    pub adhesion: Option<Amounts>,
    /// A motion that no contact resists, three velocities for each block. Along it, the loads do more work than the
    /// robots can absorb, unless `forces` balance every block without adhesion.
    pub motion: Option<Vec<f64>>,
    /// True if admissible forces had a small cost in the program of least adhesion. The contacts may then resist the
    /// motion slightly.
    pub priced: bool,
    /// If forces of least sum were found: a motion, three velocities for each block, that proves a lower bound of their sum. The
    /// work against each unit force is at most its cost, except for robots at their limits. The bound is the work of
    /// the loads, minus the excess work against these robots.
    pub witness: Option<Vec<f64>>,
    /// The number of programs and iterations that were needed.
    pub effort: Effort,
}

/// Returns the residual loads − Σ amount·column, one number for each row.
pub(super) fn remainder(loads: &[f64], columns: &[Column], amounts: &[f64]) -> Vec<f64> {
    let mut rest: Vec<f64> = loads.to_vec();
    for (column, amount) in columns.iter().zip(amounts) {
        column.add_to(&mut rest, -amount);
    }
    rest
}

/// Returns the largest absolute value in a list, 0 for an empty list.
pub(super) fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}
