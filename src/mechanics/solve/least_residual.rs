//! Two linear programs for a structure near its limit of stability, where the program of least force fails. One
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

use super::optimum::solve_static_form;
use super::scaled::ScaledProgram;
use super::{
    Amounts, Balance, Conditioning, SolverSettings, Status, TOLERANCE, balance_by_least_change, largest, remainder,
};
use crate::mechanics::program::{Aim, Program};

/// A motion is a reliable proof of the fall if its power exceeds this multiple of Σ |velocity| times the largest load.
///
/// It is ten times the 1e-7 within which a proof accepts forces as balanced.
const MIN_POWER: f64 = 1e-6;

/// Finds forces that balance the loads, or a motion that proves that no forces balance them. With this motion, the
/// forces are zero if the motion is strong enough to exclude a balance, otherwise `None`.
pub fn any_balance(program: &Program) -> Balance {
    let scaled = ScaledProgram::new(program);
    let (loads, columns) = (&scaled.loads, &scaled.columns);
    let mut found = Balance::default();
    // Solve the static form without a cost: every admissible balance is an optimum.
    let balance = solve_static_form(loads, columns, Conditioning::Plain, &mut found.effort, |_| 0.0);
    match balance.status {
        Status::Solved => {
            let settings = Conditioning::Plain.into();
            let amounts = balance_by_least_change(loads, columns, balance.amounts, settings, &mut found.effort);
            let is_balanced = largest(&remainder(loads, columns, &amounts)) <= TOLERANCE;
            found.forces = is_balanced.then(|| scaled.forces(amounts));
        }
        Status::Unbounded => {
            // No forces balance the loads. The motion is the certificate of infeasibility.
            let power: f64 = loads.iter().zip(&balance.y).map(|(n, v)| n * v).sum();
            let speed_sum: f64 = balance.y.iter().map(|v| v.abs()).sum();
            found.forces = (power > MIN_POWER * speed_sum).then(|| Amounts::zero(program));
            found.motion = Some(balance.motion());
        }
        _ => {}
    }
    found
}

/// Finds the forces of least residual, and the motion that proves that no smaller residual is possible. Both are `None`
/// if the solver finds no optimum.
pub fn least_residual(program: &Program) -> Balance {
    let scaled = ScaledProgram::new(program);
    let mut found = Balance::default();
    let attempts = SolverSettings::from(Conditioning::Plain).with_retry();
    let solved = scaled.solve(&Aim::Residual, attempts, &mut found.effort);
    if solved.status == Status::Solved {
        found.motion = Some(solved.motion());
        found.forces = Some(scaled.forces(solved.amounts));
    }
    found
}
