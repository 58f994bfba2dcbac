//! [`LimitState`]: the largest load factor, with the amounts of all columns and the mechanism at this factor.
//!
//! [`largest_factor`](super::largest_factor) adds up the columns to the forces of contacts and grips. To find out
//! whether forces and mechanism are unique, the amount of every single column is needed.

use super::limit::{ScaledLoads, attempts, columns_in};
use super::reduced_columns::ReducedColumns;
use super::{Status, solve};
use crate::mechanics::program::{Column, Program, load_factor_dual};

/// The optimum of the program of the largest load factor.
#[derive(Clone, Debug)]
pub struct LimitState {
    /// The largest factor.
    pub factor: f64,
    /// The columns of the program without the redundant pure normal forces (see `reduced_columns`).
    pub columns: Vec<Column>,
    /// The amount of each column at the limit, in program units, at least 0.
    pub amounts: Vec<f64>,
    /// The collapse mechanism: three velocities for each block. Along it, the additional load of a factor of 1 has
    /// power 1.
    pub motion: Vec<f64>,
}

/// Finds the largest λ ≥ 0 for which admissible forces balance `program.loads + λ·direction`, and the forces and the
/// mechanism at this λ.
///
/// `None` if λ has no largest value, if no λ ≥ 0 allows a balance, or if the solver ends without a result.
pub fn limit_state(program: &Program, direction: &[f64]) -> Option<LimitState> {
    let scaled = ScaledLoads::new(program, direction)?;
    let columns = scaled.columns(program);
    let (problem, row_of) = load_factor_dual(&scaled.loads, &scaled.direction, &columns);
    for (tolerance, conditioning) in attempts(program) {
        let answer = solve(&problem, tolerance, conditioning);
        match answer.status {
            Status::Solved => {
                let factor = answer.z.last()?.max(0.0);
                let amounts = scaled.amounts(&scaled.total(factor), &columns, &answer, &row_of);
                let mut motion = scaled.motion(&answer);
                motion.iter_mut().for_each(|v| *v /= scaled.direction_size);
                return Some(LimitState {
                    factor: scaled.factor(factor),
                    columns: columns_of(program),
                    amounts,
                    motion,
                });
            }
            Status::Unsolved => {}
            Status::Infeasible | Status::Unbounded => return None,
        }
    }
    None
}

/// Returns the columns of a program without redundant columns. Their limits are in program units, not scaled to the
/// loads.
fn columns_of(program: &Program) -> Vec<Column> {
    ReducedColumns::new(&columns_in(program, 1.0)).columns
}
