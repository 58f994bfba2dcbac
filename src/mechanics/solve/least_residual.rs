//! The programs of any balance and of least residual, which decide near the limit of standing.
//!
//! There the program of least force ends without a status: it is infeasible past the limit, and its optimum unbounded just
//! before it. Two programs without that cost decide:
//!
//! - any balance, with the forces as unknowns and no cost. It takes some 30 iterations on either side of the limit of a
//!   wall of 410 bricks, 10⁻⁵ of the load away, where the least force takes 200 and fails.
//! - the least Σ |residual|. If it is 0 the forces balance; else the velocities are those of largest power within
//!   −1 ≤ y ≤ 1. It has an optimum on either side, and shows whether an answer lies within the band of the proofs.

use super::dual::amounts_of_rows;
use super::limit::columns_in;
use super::slanted::Slanted;
use super::{
    Amounts, Conditioning, Effort, Face, Status, balance_by_least_change, in_forces, largest,
    remainder, solved_with_retry,
};
use crate::program::{Column, Program, least_residual_dual};

/// Forces and a motion, one of which a proof can use.
#[derive(Clone, Debug)]
pub struct Residual {
    /// The admissible forces.
    pub forces: Amounts,
    /// The motion against them: three velocities per block, 0 where the forces balance.
    pub motion: Vec<f64>,
    /// Whether the result is beyond the solver's doubt: the forces balance, the motion exceeds the band of the proofs, or the
    /// residual is the least.
    pub nearest: bool,
    /// The work it took.
    pub effort: Effort,
}

/// A motion proves the fall beyond doubt if its power exceeds this multiple of Σ |velocity|, relative to the largest load: ten times
/// the 1e-7 within which forces count as balanced.
const MIN_POWER: f64 = 1e-6;

/// The residual that a balance may leave, relative to the largest load: the solver's tolerance.
const BALANCE_TOL: f64 = 1e-9;

/// A program scaled to a largest load of 1.
///
/// A wall of 410 bricks pushed to its limit ends without a status with loads of 300, and after some 70 iterations with 1.
struct ScaledProgram<'p> {
    program: &'p Program,
    load: f64,
    loads: Vec<f64>,
    columns: Vec<Column>,
    slanted: Slanted,
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
            slanted: Slanted::new(&columns),
            columns,
        }
    }

    /// The forces of these amounts, in the program's own units of force.
    fn forces(&self, amounts: &[f64]) -> Amounts {
        let mut face = Face::whole(&self.program.loads, self.columns.clone());
        face.amounts = self.slanted.amounts_of_all(&self.columns, amounts);
        face.amounts
            .iter_mut()
            .for_each(|amount| *amount *= self.load);
        face.gathered(self.program).0
    }
}

/// Finds forces that balance, or a motion that shows that none do. Both are 0 if the solver ends without a status.
pub fn any_balance(program: &Program) -> Residual {
    let scaled = ScaledProgram::new(program);
    let (loads, columns) = (&scaled.loads, &scaled.slanted.columns);
    let mut effort = Effort::default();
    let any = in_forces(loads, columns, Conditioning::Plain, &mut effort, |_| 0.0);
    let mut found = Residual {
        forces: Amounts::none(program),
        motion: vec![0.0; loads.len()],
        nearest: false,
        effort,
    };
    match any.status {
        Status::Solved => {
            let settings = Conditioning::Plain.into();
            let amounts =
                balance_by_least_change(loads, columns, any.amounts, settings, &mut found.effort);
            found.nearest = largest(&remainder(loads, columns, &amounts)) <= BALANCE_TOL;
            found.forces = scaled.forces(&amounts);
        }
        Status::Unbounded => {
            let power: f64 = loads.iter().zip(&any.y).map(|(n, v)| n * v).sum();
            let way: f64 = any.y.iter().map(|v| v.abs()).sum();
            found.nearest = power > MIN_POWER * way;
            found.motion = any.y.iter().map(|v| -v).collect();
        }
        _ => {}
    }
    found
}

/// Finds the forces of least residual and the motion that proves it; `None` if the solver ends without a status.
pub fn least_residual(program: &Program) -> Option<Residual> {
    let scaled = ScaledProgram::new(program);
    let mut effort = Effort::default();
    let (conic, row_of) = least_residual_dual(&scaled.loads, &scaled.slanted.columns);
    let answer = solved_with_retry(&conic, Conditioning::Plain, &mut effort);
    if answer.status != Status::Solved {
        return None;
    }
    let amounts = amounts_of_rows(&answer, &row_of);
    Some(Residual {
        forces: scaled.forces(&amounts),
        motion: answer.x[..scaled.loads.len()].iter().map(|v| -v).collect(),
        nearest: true,
        effort,
    })
}
