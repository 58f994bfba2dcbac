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
//!
//! [`ScaledProgram`]: a program in the form in which solvers are most accurate. Its largest load is 1, and redundant
//! columns are omitted ([`ReducedColumns`]).
//!
//! With loads of 300, the solver stops for a wall of 410 bricks at its limit after a hundred iterations without a
//! result; with loads of 1 it finds the optimum after about 70.
//!
//! If admissible forces have no cost, the pure normal force n̂ is redundant. It is (1 + μ)/2 times the sum of the two
//! rays of its friction cone, (n̂ + μ t̂)/(1 + μ) and (n̂ − μ t̂)/(1 + μ). Without the redundant columns, the dual has
//! a third fewer rows.

use super::amounts::Effort;
use super::answer::{Answer, Status};
use super::settings::{Conditioning, MAX_ITERATIONS, SolverSettings};
use super::solver::solve_within;
use super::{Amounts, Face, largest};
use crate::mechanics::program::{Column, Force, Program, QuadraticProgram, columns, force_primal, kinematic_dual};

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

/// A program whose loads are scaled to a largest load of 1.
pub(super) struct ScaledProgram<'p> {
    program: &'p Program,
    /// The largest load before scaling, or 1 if there are no loads.
    pub load: f64,
    /// The scaled loads.
    pub loads: Vec<f64>,
    /// The columns without redundant ones, with limits in the unit of the scaled loads.
    pub columns: Vec<Column>,
}

impl<'p> ScaledProgram<'p> {
    /// Scales a program.
    pub fn new(program: &'p Program) -> ScaledProgram<'p> {
        let load = match largest(&program.loads) {
            0.0 => 1.0,
            load => load,
        };
        ScaledProgram {
            program,
            load,
            loads: program.loads.iter().map(|v| v / load).collect(),
            columns: ReducedColumns::new(&columns_in(program, load)).columns,
        }
    }

    /// Converts the amounts of the columns to forces in the units of the original program.
    pub fn forces(&self, mut amounts: Vec<f64>) -> Amounts {
        amounts.iter_mut().for_each(|amount| *amount *= self.load);
        Face::whole(&self.loads, self.columns.clone()).with_amounts(amounts).to_forces(self.program).0
    }

    /// Returns the mechanism of an answer in the kinematic form: three velocities for each block, opposite to the
    /// virtual velocities.
    pub fn motion(&self, answer: &Answer) -> Vec<f64> {
        answer.x[..self.loads.len()].iter().map(|v| -v).collect()
    }
}

/// Returns the columns of a program, with limits in multiples of the load `unit`.
pub(super) fn columns_in(program: &Program, unit: f64) -> Vec<Column> {
    let mut columns = columns(program);
    for column in &mut columns {
        column.limit /= unit;
    }
    columns
}

/// The columns that remain after redundant ones are omitted.
pub(super) struct ReducedColumns {
    /// The remaining columns.
    pub columns: Vec<Column>,
    /// The index of each remaining column among all columns.
    original_indices: Vec<usize>,
}

impl ReducedColumns {
    /// Selects all columns except the pure normal forces that are followed by the two rays of their friction cone.
    pub fn new(all: &[Column]) -> ReducedColumns {
        let original_indices: Vec<usize> = (0..all.len()).filter(|k| !is_redundant(all, *k)).collect();
        ReducedColumns { columns: original_indices.iter().map(|k| all[*k]).collect(), original_indices }
    }

    /// Returns a list with one number for each column of `all`: the given amount for a remaining column, 0 for an
    /// omitted column.
    pub fn expand_amounts(&self, all: &[Column], amounts: &[f64]) -> Vec<f64> {
        let mut full = vec![0.0; all.len()];
        for (amount, original) in amounts.iter().zip(&self.original_indices) {
            full[*original] = *amount;
        }
        full
    }

    /// Converts an optimum for the remaining columns to an optimum for all columns. Where both rays of a cone have an
    /// amount above 0, half of the smaller amount is taken from each ray and becomes a pure normal force.
    pub fn expand_optimum(&self, all: &[Column], solved: Dual) -> Dual {
        let mut full = Dual {
            amounts: self.expand_amounts(all, &solved.amounts),
            slack: self.expand_amounts(all, &solved.slack),
            multipliers: self.expand_amounts(all, &solved.multipliers),
            ..solved
        };
        for k in (0..all.len()).filter(|k| is_redundant(all, *k)) {
            let Force::Ray { normal, .. } = all[k + 1].force else {
                continue;
            };
            // Equal amounts of both rays have no friction, so together they are a pure normal force.
            let shared = 0.5 * full.amounts[k + 1].min(full.amounts[k + 2]);
            full.amounts[k] = 2.0 * normal * shared;
            full.slack[k] = (full.slack[k + 1] + full.slack[k + 2]) / (2.0 * normal);
            full.amounts[k + 1] -= shared;
            full.amounts[k + 2] -= shared;
        }
        full
    }
}

/// True if a column is a pure normal force that is followed by the two rays of its friction cone.
fn is_redundant(all: &[Column], k: usize) -> bool {
    let with_friction =
        |c: Option<&Column>| c.is_some_and(|c| matches!(c.force, Force::Ray { friction, .. } if friction != 0.0));
    matches!(all[k].force, Force::Ray { friction: 0.0, .. })
        && with_friction(all.get(k + 1))
        && with_friction(all.get(k + 2))
}
