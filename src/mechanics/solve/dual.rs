//! [`Dual`]: the optimum of the linear program of forces, found from its static (primal) form or from its kinematic
//! (dual) form.
//!
//! ```text
//! static:     min Σ cost·amount                   s.t.  Σ amount·column = loads,  0 ≤ amount ≤ limit
//! kinematic:  max loadsᵀy − Σ limit·multiplier    s.t.  columnᵀy − multiplier ≤ cost
//! ```
//!
//! y are the velocities, three for each block. Each column with a limit has one multiplier, which is ≥ 0. A [`Dual`]
//! contains the solution of both forms. Reference: [Livesley78](crate::doc::references).

use super::amounts::Effort;
use super::answer::{Answer, Status};
use super::settings::{Conditioning, MAX_ITERATIONS, SolverSettings};
use super::solver::solve_within;
use crate::mechanics::program::{Column, QuadraticProgram, force_primal, kinematic_dual};

/// The solution of a linear program and of its kinematic dual.
#[derive(Clone, Debug)]
pub struct Dual {
    /// The status of the kinematic form. If it is `Unbounded`, −y is a motion that no contact resists.
    pub status: Status,
    /// Virtual velocities, three for each block. The motion along which the loads do work is −y.
    pub y: Vec<f64>,
    /// The amount of each column, ≥ 0.
    pub amounts: Vec<f64>,
    /// The slack of each column, its reduced cost: cost − columnᵀy (plus its multiplier) ≥ 0.
    pub slack: Vec<f64>,
    /// The multiplier of each column's limit: by how much the least cost falls if the limit is raised, per unit. It is
    /// 0 for a column without a limit.
    pub multipliers: Vec<f64>,
    /// The objective at the optimum, which is the least cost.
    pub objective: f64,
}

impl Dual {
    /// Creates a solution with the given status and size, in which all numbers are 0.
    fn zero(status: Status, unknowns: usize, columns: usize) -> Dual {
        Dual {
            status,
            y: vec![0.0; unknowns],
            amounts: vec![0.0; columns],
            slack: vec![0.0; columns],
            multipliers: vec![0.0; columns],
            objective: 0.0,
        }
    }

    /// Returns, for each column, whether it is basic and thus belongs to the face of optima. A column is basic if its
    /// slack is below `margin` times its amount.
    pub fn active(&self, margin: f64) -> Vec<bool> {
        self.amounts.iter().zip(&self.slack).map(|(amount, slack)| margin * amount > *slack).collect()
    }
}

/// Finds the forces of least cost that balance the loads, by solving the kinematic dual. If plain conditioning ends
/// without a result, solves the dual again with full conditioning.
///
/// `cost` returns the cost of one unit of a column.
pub fn dual(
    loads: &[f64],
    columns: &[Column],
    settings: impl Into<SolverSettings>,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Dual {
    let (conic, row_of) = kinematic_dual(loads, columns, cost);
    let answer = solve_with_retry(&conic, settings, effort);
    from_kinematic_answer(loads, columns, &conic, &row_of, &answer)
}

/// Converts a solver's answer for the kinematic dual `conic` to a [`Dual`]: velocities, the amount, slack and limit
/// multiplier of each column, and the objective. `row_of` contains, for each column, the index of its row in `conic`,
/// or `usize::MAX` for the second column of an opposite pair that shares one equality.
pub(super) fn from_kinematic_answer(
    loads: &[f64],
    columns: &[Column],
    conic: &QuadraticProgram,
    row_of: &[usize],
    answer: &Answer,
) -> Dual {
    let n = columns.len();
    // The multipliers of the rows are the amounts of the columns. The slacks of the rows are the slacks of the columns.
    let mut solved = Dual::zero(answer.status, loads.len(), columns.len());
    if answer.x.is_empty() {
        return solved;
    }
    for (k, row) in row_of.iter().enumerate() {
        if *row == usize::MAX {
            // This column and the previous one are the opposite directions of one grip component, and share one
            // equality. Both are basic, even if their amount is 0.
            solved.amounts[k] = f64::max(f64::MIN_POSITIVE, -answer.z[row_of[k - 1]]);
        } else if *row < conic.equalities {
            solved.amounts[k] = f64::max(f64::MIN_POSITIVE, answer.z[*row]);
        } else {
            solved.amounts[k] = answer.z[*row].max(0.0);
            solved.slack[k] = answer.s[*row];
        }
    }
    solved.y.copy_from_slice(&answer.x[..loads.len()]);
    // The unknowns after the velocities are the multipliers of the limited columns, in their order.
    let limited = (0..n).filter(|k| columns[*k].limit.is_finite());
    for (k, multiplier) in limited.zip(&answer.x[loads.len()..]) {
        solved.multipliers[k] = multiplier.max(0.0);
    }
    // The solver minimises the negative of the dual's objective.
    solved.objective = -conic.linear.iter().zip(&answer.x).map(|(q, x)| q * x).sum::<f64>();
    solved
}

/// Returns the amounts of columns: the multipliers of their rows.
///
/// `row_of` contains the row of each column, or `usize::MAX` for the second column of an opposite pair that shares
/// one equality. The amount of that column is the multiplier with the opposite sign.
pub(super) fn amounts_of_rows(answer: &Answer, row_of: &[usize]) -> Vec<f64> {
    let rows = row_of.iter().enumerate();
    rows.map(|(k, row)| match *row {
        usize::MAX => (-answer.z[row_of[k - 1]]).max(0.0),
        row => answer.z[row].max(0.0),
    })
    .collect()
}

/// Finds the forces of least cost that balance the loads, by solving the static form: the forces are the unknowns, the
/// rows are the balance, and the multipliers of the rows are the velocities.
///
/// Near the limit of stability, the static form takes about half the iterations of the kinematic form, and each
/// iteration takes a third longer. The static form separates basic columns from the others less clearly.
pub(super) fn solve_static_form(
    loads: &[f64],
    columns: &[Column],
    settings: impl Into<SolverSettings>,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Dual {
    let conic = force_primal(loads, columns, cost, None);
    let answer = solve_once(&conic, settings.into(), effort);
    // Convert the status of the static form to that of its dual, the kinematic form. The dual of an infeasible program
    // is unbounded, because velocities of 0 are feasible if no cost is negative. The dual of an unbounded program is
    // infeasible.
    let status = match answer.status {
        Status::Infeasible => Status::Unbounded,
        Status::Unbounded => Status::Infeasible,
        other => other,
    };
    let mut solved = Dual::zero(status, loads.len(), columns.len());
    if answer.x.is_empty() {
        return solved;
    }
    // The velocities are the multipliers of the balance rows with the opposite sign.
    for (y, multiplier) in solved.y.iter_mut().zip(&answer.z) {
        *y = -multiplier;
    }
    // The row x ≥ 0 of a column is followed by the row of its limit, if the column has a limit.
    let mut row = loads.len();
    for (k, column) in columns.iter().enumerate() {
        solved.amounts[k] = answer.x[k].max(0.0);
        solved.slack[k] = answer.z[row];
        row += 1;
        if column.limit.is_finite() {
            solved.multipliers[k] = answer.z[row].max(0.0);
            row += 1;
        }
    }
    let costs = conic.linear.iter().zip(&answer.x).map(|(q, x)| q * x);
    solved.objective = costs.sum();
    solved
}

/// Solves a program. If plain conditioning ends without a result, solves it again with full conditioning.
pub(super) fn solve_with_retry(
    conic: &QuadraticProgram,
    settings: impl Into<SolverSettings>,
    effort: &mut Effort,
) -> Answer {
    let settings = settings.into();
    let answer = solve_once(conic, settings, effort);
    if answer.status == Status::Unsolved && settings.conditioning == Conditioning::Plain {
        let full = SolverSettings { conditioning: Conditioning::Full, ..settings };
        return solve_once(conic, full, effort);
    }
    answer
}

/// Solves a program once, without a retry, and adds the work to `effort`.
pub(super) fn solve_once(conic: &QuadraticProgram, settings: SolverSettings, effort: &mut Effort) -> Answer {
    solve_once_within(conic, settings, MAX_ITERATIONS, effort)
}

/// Solves a program once, in at most `iterations` iterations, and adds the work to `effort`.
pub(super) fn solve_once_within(
    conic: &QuadraticProgram,
    settings: SolverSettings,
    iterations: usize,
    effort: &mut Effort,
) -> Answer {
    let answer = solve_within(conic, settings, iterations);
    *effort = effort.plus(Effort { iterations: answer.iterations, programs: 1 });
    answer
}
