//! [`Tangent`]: the least that forces leave unbalanced, and how that changes with the contacts.
//!
//! V = max loadsᵀy  s.t.  columnᵀy ≤ 0, −1 ≤ y ≤ 1 is above 0 where a program falls and 0 where it stands. At its optimum
//! the forces and the motion bound V of a sibling, whose contacts are rougher or whose application points lie elsewhere, to
//! first order: V less what the same normal forces, with all the friction they then have, do along the same motion. That is
//! linear in the friction coefficient and in the kernel, so its zero is the next value to try: Newton's step on V.

use super::limit::{columns_in, rebalanced};
use super::slanted::Slanted;
use super::{Amounts, Conditioning, Effort, Face, Status, largest, solved_with_retry};
use crate::geometry::{Vector, quarter_turn};
use crate::program::{Column, Force, Program, least_residual_dual};

/// The optimum of the program of the least residual.
#[derive(Clone, Debug)]
pub struct Tangent {
    /// V: Σ |what is left unbalanced|, in parts of the largest load.
    pub left: f64,
    columns: Vec<Column>,
    amounts: Vec<f64>,
    y: Vec<f64>,
    load: f64,
    /// What the contact forces do along y.
    done: f64,
}

impl Tangent {
    /// Solves it; `None` where the solver ends without a status.
    pub fn new(program: &Program) -> Option<Tangent> {
        let load = match largest(&program.loads) {
            0.0 => return None,
            load => load,
        };
        let loads: Vec<f64> = program.loads.iter().map(|v| v / load).collect();
        let columns = Slanted::new(&columns_in(program, load)).columns;
        let (conic, row_of) = least_residual_dual(&loads, &columns);
        let answer = solved_with_retry(&conic, Conditioning::Plain, &mut Effort::default());
        if answer.status != Status::Solved {
            return None;
        }
        let amounts = row_of.iter().enumerate().map(|(k, row)| match *row {
            // A pair posed as one equality carries the amount of its first, of either sign.
            usize::MAX => (-answer.z[row_of[k - 1]]).max(0.0),
            row => answer.z[row].max(0.0),
        });
        let objective = conic.linear.iter().zip(&answer.x).map(|(q, x)| q * x);
        let mut tangent = Tangent {
            left: -objective.sum::<f64>(),
            amounts: amounts.collect(),
            columns,
            y: answer.x[..loads.len()].to_vec(),
            load,
            done: 0.0,
        };
        tangent.done = tangent.power(program);
        Some(tangent)
    }

    /// V of a sibling with the same loads, to first order.
    pub fn of_sibling(&self, sibling: &Program) -> f64 {
        self.left + self.done - self.power(sibling)
    }

    /// The motion of largest power: three velocities per block.
    pub fn motion(&self) -> Vec<f64> {
        self.y.iter().map(|v| -v).collect()
    }

    /// The forces, changed as little as balances what they leave.
    pub fn forces(&self, program: &Program) -> Amounts {
        let loads: Vec<f64> = program.loads.iter().map(|v| v / self.load).collect();
        let mut amounts = rebalanced(&loads, &self.columns, self.amounts.clone());
        amounts.iter_mut().for_each(|amount| *amount *= self.load);
        let face = Face::whole(&loads, self.columns.clone()).with(amounts);
        face.gathered(program).0
    }

    /// What the normal forces do along y at the contacts of a program, with all the friction that these have.
    fn power(&self, program: &Program) -> f64 {
        let mut sum = 0.0;
        for (column, amount) in self.columns.iter().zip(&self.amounts) {
            let Force::Ray {
                contact,
                point,
                normal,
                friction,
            } = column.force
            else {
                continue;
            };
            let contact = &program.contacts[contact];
            let speed = |(block, arms): (usize, [Vector; 2])| {
                let [u, v, spin] = [0, 1, 2].map(|row| self.y[3 * block + row]);
                Vector::new(u, v) + quarter_turn(arms[point]) * spin
            };
            let apart = speed(contact.on) - contact.from.map_or(Vector::zeros(), speed);
            let slides = quarter_turn(contact.normal).dot(&apart);
            // Where there was no friction, it acts against the motion.
            let side = if friction == 0.0 { slides } else { friction };
            let rubbed = contact.friction * slides * side.signum();
            sum += amount * normal * (contact.normal.dot(&apart) + rubbed);
        }
        sum
    }
}
