//! Two linear programs for a structure near its limit of stability, where the linear program of least force fails. One
//! finds any forces that balance the loads, the other finds forces with the least residual.
//!
//! Near that limit the program of least force ends without a result: just before the limit its optimum grows without
//! bound, and past the limit it is infeasible. These two programs have no cost of forces:
//!
//! - *any balance*: admissible forces that balance the loads, by the static form without a cost. For a wall of 410
//!   bricks, 10⁻⁵ of the load on either side of its limit, the solver takes about 30 iterations. With the program of
//!   least force, it takes 200 and fails.
//! - *least residual*: admissible forces with the least Σ |loads − Σ force|. If this sum is 0, the forces balance the
//!   loads. Otherwise the velocities are the motion of largest power of the loads, with velocities between −1 and 1.
//!   The program has an optimum on both sides of the limit. The size of the residual shows whether the forces balance
//!   within the tolerance of the proofs.

use super::dual::amounts_of_rows;
use super::limit::columns_in;
use super::reduced_columns::ReducedColumns;
use super::{
    Amounts, Conditioning, Effort, Face, Status, balance_by_least_change, largest, remainder, solve_static_form,
    solve_with_retry,
};
use crate::mechanics::program::{Column, Program, least_residual_dual};

/// Forces and a motion. A proof may accept one of them: the forces if they balance the loads, otherwise the motion.
#[derive(Clone, Debug)]
pub struct Residual {
    /// The admissible forces.
    pub forces: Amounts,
    /// The motion along which the loads do work, if the forces do not balance them: three velocities per block.
    /// [`any_balance`] returns velocities of 0 if it finds forces.
    pub motion: Vec<f64>,
    /// True if the forces balance the loads, if the loads' power along the motion is well above the tolerance of the
    /// proofs, or if the residual is the least possible.
    pub is_reliable: bool,
    /// The number of programs and iterations that were needed.
    pub effort: Effort,
}

/// A motion is a reliable proof of the fall if its power exceeds this multiple of Σ |velocity| times the largest load.
///
/// It is ten times the 1e-7 within which a proof accepts forces as balanced.
const MIN_POWER: f64 = 1e-6;

/// The residual up to which forces count as a balance, relative to the largest load: the solver's tolerance.
const BALANCE_TOL: f64 = 1e-9;

/// A program scaled to a largest load of 1.
///
/// For a wall of 410 bricks pushed to its limit, the solver ends without a result with loads of 300; with loads of 1 it
/// finds the optimum after about 70 iterations.
struct ScaledProgram<'p> {
    program: &'p Program,
    load: f64,
    loads: Vec<f64>,
    columns: Vec<Column>,
    reduced_columns: ReducedColumns,
}

impl ScaledProgram<'_> {
    fn new(program: &Program) -> ScaledProgram<'_> {
        let load = match largest(&program.loads) {
            0.0 => 1.0,
            load => load,
        };
        let columns = columns_in(program, load);
        ScaledProgram {
            program,
            load,
            loads: program.loads.iter().map(|v| v / load).collect(),
            reduced_columns: ReducedColumns::new(&columns),
            columns,
        }
    }

    /// Converts the amounts of the scaled program to forces in the units of the original program.
    fn forces(&self, amounts: &[f64]) -> Amounts {
        let mut face = Face::whole(&self.program.loads, self.columns.clone());
        face.amounts = self.reduced_columns.expand_amounts(&self.columns, amounts);
        face.amounts.iter_mut().for_each(|amount| *amount *= self.load);
        face.to_forces(self.program).0
    }
}

/// Finds forces that balance the loads, or a motion that proves that no forces balance them. The forces and the motion
/// are 0 if the solver ends without a result.
pub fn any_balance(program: &Program) -> Residual {
    let scaled = ScaledProgram::new(program);
    let (loads, columns) = (&scaled.loads, &scaled.reduced_columns.columns);
    let mut effort = Effort::default();
    // Solve the static form without a cost: every admissible balance is an optimum.
    let balance = solve_static_form(loads, columns, Conditioning::Plain, &mut effort, |_| 0.0);
    let mut found =
        Residual { forces: Amounts::zero(program), motion: vec![0.0; loads.len()], is_reliable: false, effort };
    match balance.status {
        Status::Solved => {
            let settings = Conditioning::Plain.into();
            let amounts = balance_by_least_change(loads, columns, balance.amounts, settings, &mut found.effort);
            found.is_reliable = largest(&remainder(loads, columns, &amounts)) <= BALANCE_TOL;
            found.forces = scaled.forces(&amounts);
        }
        Status::Unbounded => {
            // No forces balance the loads. The motion is the certificate of infeasibility.
            let power: f64 = loads.iter().zip(&balance.y).map(|(n, v)| n * v).sum();
            let speed_sum: f64 = balance.y.iter().map(|v| v.abs()).sum();
            found.is_reliable = power > MIN_POWER * speed_sum;
            found.motion = balance.y.iter().map(|v| -v).collect();
        }
        _ => {}
    }
    found
}

/// Finds the forces of least residual, and the motion that proves that no smaller residual is possible. `None` if the
/// solver finds no optimum.
pub fn least_residual(program: &Program) -> Option<Residual> {
    let scaled = ScaledProgram::new(program);
    let mut effort = Effort::default();
    let (conic, row_of) = least_residual_dual(&scaled.loads, &scaled.reduced_columns.columns);
    let answer = solve_with_retry(&conic, Conditioning::Plain, &mut effort);
    if answer.status != Status::Solved {
        return None;
    }
    let amounts = amounts_of_rows(&answer, &row_of);
    Some(Residual {
        forces: scaled.forces(&amounts),
        motion: answer.x[..scaled.loads.len()].iter().map(|v| -v).collect(),
        is_reliable: true,
        effort,
    })
}
