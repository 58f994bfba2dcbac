//! [`Tangent`]: the least residual of a program, and a linear estimate of its change if friction or the application
//! points of contacts change.
//!
//! V = max loadsᵀy s.t. columnᵀy ≤ 0, −1 ≤ y ≤ 1 is the least Σ |residual|. It is 0 if the structure stands and above 0
//! if it falls. A *sibling* of the program has another friction coefficient or other application points. To first
//! order, the V of a sibling is V plus a difference of works. This difference is the work of the contact forces along y
//! in this program, minus their work along y in the sibling. The contact forces consist of the normal forces of this
//! program, with full friction. This estimate is linear in the friction coefficient and in the shift of the application
//! points. Its zero is the next value to try: Newton's method on V. Reference: Nocedal and Wright, Numerical
//! Optimization, 2006, section 12.8 (multipliers and sensitivity).

use super::limit::rebalanced;
use super::scaled::ScaledProgram;
use super::{Amounts, Conditioning, Effort, Optimum, SolverSettings, Status, largest};
use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::program::{Aim, Column, Force, Program};

/// The optimum of the program of least residual, from which [`Tangent::estimate_residual`] estimates the residual of
/// other programs.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// V: Σ |residual|, relative to the largest load.
    pub residual_sum: f64,
    columns: Vec<Column>,
    optimum: Optimum,
    /// The work of the contact forces along y.
    work: f64,
}

impl Tangent {
    /// Solves the program of least residual. `None` if there are no loads, or if the solver finds no optimum.
    pub fn new(program: &Program) -> Option<Tangent> {
        if largest(&program.loads) == 0.0 {
            return None;
        }
        let scaled = ScaledProgram::new(program);
        let optimum = scaled.solve(
            &Aim::Residual,
            SolverSettings::from(Conditioning::Plain).with_retry(),
            &mut Effort::default(),
        );
        if optimum.status != Status::Solved {
            return None;
        }
        let mut tangent = Tangent { residual_sum: optimum.objective, columns: scaled.columns, optimum, work: 0.0 };
        tangent.work = tangent.work_in(program);
        Some(tangent)
    }

    /// Estimates, to first order, the least residual V of another program with the same loads and changed contacts.
    pub fn estimate_residual(&self, sibling: &Program) -> f64 {
        self.residual_sum + self.work - self.work_in(sibling)
    }

    /// Returns the motion along which the loads have the largest power: three velocities per block, each between −1 and
    /// 1.
    pub fn motion(&self) -> Vec<f64> {
        self.optimum.motion()
    }

    /// Returns the forces of least residual, corrected by the least change that removes the residual. Amounts that
    /// would become negative are set to 0, so a residual may remain.
    pub fn forces(&self, program: &Program) -> Amounts {
        let scaled = ScaledProgram::new(program);
        scaled.forces(rebalanced(&scaled.loads, &scaled.columns, self.optimum.amounts.clone()))
    }

    /// Returns the work of the contact forces along the velocities y. Each contact has full friction, and has the
    /// normal, points and friction coefficient that it has in `program`.
    fn work_in(&self, program: &Program) -> f64 {
        let mut sum = 0.0;
        for (column, amount) in self.columns.iter().zip(&self.optimum.amounts) {
            let Force::Ray { contact, point, normal, friction } = column.force else {
                continue;
            };
            let contact = &program.contacts[contact];
            // Compute the velocity of the contact point on one body, relative to the contact point on the other body.
            let speed = |(block, arms): (usize, [Vector; 2])| {
                let [u, v, spin] = [0, 1, 2].map(|row| self.optimum.y[3 * block + row]);
                Vector::new(u, v) + quarter_turn(arms[point]) * spin
            };
            let relative_velocity = speed(contact.on) - contact.from.map_or(Vector::zeros(), speed);
            let slip = quarter_turn(contact.normal).dot(&relative_velocity);
            // For a pure normal force, the sign of friction follows from the slip.
            let sense = if friction == 0.0 { slip } else { friction };
            let friction_speed = contact.friction * slip * sense.signum();
            sum += amount * normal * (contact.normal.dot(&relative_velocity) + friction_speed);
        }
        sum
    }
}
