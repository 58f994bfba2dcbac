//! [`Optimum`]: the optimum of a linear program of forces, found from its static (primal) form or from its kinematic
//! (dual) form. All linear programs of structures are solved here.
//!
//! ```text
//! static:     min Σ cost·amount                   s.t.  Σ amount·column = loads,  0 ≤ amount ≤ limit
//! kinematic:  max loadsᵀy − Σ limit·multiplier    s.t.  columnᵀy − multiplier ≤ cost
//! ```
//!
//! y are the velocities, three for each block. Each column with a limit has one multiplier, which is ≥ 0. An
//! [`Optimum`] contains the solution of both forms. [`Aim`] names the other programs: the largest load factor, the load
//! factor nearest to 0, and the least residual. Reference: [Livesley78](crate::doc::references).

use super::amounts::Effort;
use super::answer::{Answer, Status};
use super::settings::{Conditioning, SolverSettings};
use super::solver::solve_with;
use crate::mechanics::program::{Aim, Column, Factor, QuadraticProgram, force_primal, kinematic_form};

/// The optimum of a linear program and of its kinematic form.
#[derive(Clone, Debug)]
pub struct Optimum {
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
    /// The objective at the optimum: the least cost, or the least residual.
    pub objective: f64,
    /// The load factor λ; 0 if the program has none.
    pub factor: f64,
}

impl Optimum {
    /// Creates a solution with the given status and size, in which all numbers are 0.
    fn zero(status: Status, unknowns: usize, columns: usize) -> Optimum {
        Optimum {
            status,
            y: vec![0.0; unknowns],
            amounts: vec![0.0; columns],
            slack: vec![0.0; columns],
            multipliers: vec![0.0; columns],
            objective: 0.0,
            factor: 0.0,
        }
    }

    /// Returns, for each column, whether it is basic and thus belongs to the face of optima. A column is basic if its
    /// slack is below `margin` times its amount.
    pub fn active(&self, margin: f64) -> Vec<bool> {
        self.amounts.iter().zip(&self.slack).map(|(amount, slack)| margin * amount > *slack).collect()
    }

    /// Returns the motion along which the loads do work: three velocities for each block.
    pub fn motion(&self) -> Vec<f64> {
        self.y.iter().map(|v| -v).collect()
    }
}

/// Finds the forces of least cost that balance the loads, by solving the kinematic form. If the solver ends without a
/// result, solves the static form with full conditioning.
///
/// Near the limit of stability the velocities are very large, and the kinematic form may end without a result. The
/// forces may be of ordinary size.
///
/// `cost` returns the cost of one unit of a column.
pub fn least_cost(
    loads: &[f64],
    columns: &[Column],
    settings: impl Into<SolverSettings>,
    effort: &mut Effort,
    cost: impl Fn(&Column) -> f64,
) -> Optimum {
    let settings = settings.into();
    let solved = solve_kinematic_form(loads, columns, &Aim::Least(&cost), [settings], effort);
    if solved.status != Status::Unsolved {
        return solved;
    }
    solve_static_form(loads, columns, SolverSettings { conditioning: Conditioning::Full, ..settings }, effort, cost)
}

/// Solves the kinematic form of a program with one of the settings after the other, until the solver ends with a
/// result.
pub(super) fn solve_kinematic_form(
    loads: &[f64],
    columns: &[Column],
    aim: &Aim,
    attempts: impl IntoIterator<Item = SolverSettings>,
    effort: &mut Effort,
) -> Optimum {
    let (conic, row_of) = kinematic_form(loads, columns, aim);
    let answer = solve_in_turn(&conic, attempts, effort);
    // The multipliers of the rows are the amounts of the columns. The slacks of the rows are the slacks of the columns.
    let mut solved = Optimum::zero(answer.status, loads.len(), columns.len());
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
    let limited = (0..columns.len()).filter(|k| columns[*k].limit.is_finite());
    for (k, multiplier) in limited.zip(&answer.x[loads.len()..]) {
        solved.multipliers[k] = multiplier.max(0.0);
    }
    // The solver minimises the negative of the dual's objective.
    solved.objective = -conic.linear.iter().zip(&answer.x).map(|(q, x)| q * x).sum::<f64>();
    solved.factor = match (aim, &answer.z[..]) {
        (Aim::Factor(Factor::Largest, ..), [.., up]) => up.max(0.0),
        (Aim::Factor(Factor::Nearest, ..), [.., up, down]) => up - down,
        _ => 0.0,
    };
    solved
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
) -> Optimum {
    let conic = force_primal(loads, columns, cost, None);
    let answer = solve_in_turn(&conic, [settings.into()], effort);
    // Convert the status of the static form to that of its dual, the kinematic form. The dual of an infeasible program
    // is unbounded, because velocities of 0 are feasible if no cost is negative. The dual of an unbounded program is
    // infeasible.
    let status = match answer.status {
        Status::Infeasible => Status::Unbounded,
        Status::Unbounded => Status::Infeasible,
        other => other,
    };
    let mut solved = Optimum::zero(status, loads.len(), columns.len());
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

/// Solves a program with one of the settings after the other, until the solver ends with a result. Adds the work to
/// `effort`. This is the only place where a program is solved again.
pub(crate) fn solve_in_turn(
    problem: &QuadraticProgram,
    attempts: impl IntoIterator<Item = SolverSettings>,
    effort: &mut Effort,
) -> Answer {
    let mut answer = Answer::without_status(problem);
    for settings in attempts {
        answer = solve_with(problem, settings);
        *effort = effort.plus(Effort { iterations: answer.iterations, programs: 1 });
        if answer.status != Status::Unsolved {
            break;
        }
    }
    answer
}
