//! A second solver besides clarabel, for programs of many blocks: interior-point methods that solve the normal
//! equations.
//!
//! The forces and the velocities of a structure are the optima of two linear programs that are dual to each other:
//!
//! ```text
//! min Σ cost·amount  s.t.  Σ amount·column = loads, amount ≥ 0   and   max loadsᵀy  s.t.  columnᵀy ≤ cost.
//! ```
//!
//! Every step of an interior-point method solves A·W·Aᵀ·y = right-hand side. The matrix has three rows for each block,
//! and it couples blocks that touch. For walls of a thousand blocks or more, its supernodal factor takes less than half
//! the time of clarabel's factor, which has a row for each force. With Gondzio's correctors the method also converges
//! near the limit of stability, where clarabel runs out of iterations. Measured times are in
//! [`crate::doc::performance`].
//!
//! | program | solved by |
//! |---|---|
//! | linear, in velocities or in forces | [`interior_point`] |
//! | least ½\|velocities\|² | [`interior_point`], with 1 added to the diagonal |
//! | least ½\|forces\|² of any sign | [`least_norm`]: one factor, no iteration |
//! | least squares of forces with lower bounds | [`block_qp`], each contact with a small weight matrix |
//!
//! The results are checked by a proof, as are the results of clarabel.

mod block_qp;
mod cholesky;
mod column_groups;
mod dense;
mod elimination_tree;
mod interior_point;
mod least_norm;
mod newton;
mod residuals;
mod supernodes;
#[cfg(test)]
mod tests;

use super::answer::{Answer, Status};
use super::settings::StoppingCriteria;
use crate::mechanics::program::QuadraticProgram;
use cholesky::Cholesky;
use column_groups::ColumnGroups;
use interior_point::Solution;
use residuals::LinearProgram;
use residuals::Termination;

/// Programs of fewer blocks than this are solved by clarabel, which takes little time for them.
///
/// For more blocks, this solver is also more accurate. For a wall of 410 bricks, 10⁻⁵ past its limit, the least
/// adhesion has a relative error of 10⁻⁶, and that of clarabel an error of 0.5 %. The reason: the velocities of
/// clarabel may violate the constraint of a column by 10⁻⁸, and a column may carry 10⁷ times the loads.
const MIN_BLOCKS: usize = 60;

/// A structure counts as a chain, such as an arch, if its factorization takes fewer operations than this for each
/// unknown.
///
/// If the interior-point method ends without a result for a chain, clarabel solves the program. Chains take little time
/// in either solver. Long chains lose digits in the normal equations: for an arch of 10 000 stones a residual of 10⁻⁶
/// of the loads remains.
pub(super) const CHAIN_OPERATIONS: f64 = 1e3;

/// Programs with a column of more entries than this are refused: such a column couples many blocks and fills the
/// factor.
const MAX_COLUMN_ENTRIES: usize = 12;

/// Solves a program. Returns an optimum, a certificate that there is no optimum, or an answer without a result.
///
/// Returns `None` if clarabel should solve the program. This is the case if the program has few blocks, another form or
/// a column with too many entries, or if no order of elimination was found. It is also the case if the method ended
/// without a result for a chain or for a quadratic program, which clarabel may still solve. The exception is the least
/// norm of a chain: there, the answer without a result is returned.
pub(super) fn solve(problem: &QuadraticProgram, criteria: StoppingCriteria) -> Option<Answer> {
    let rows = match problem.equalities {
        0 => problem.unknowns,
        equalities => equalities,
    };
    if rows < 3 * MIN_BLOCKS {
        return None;
    }
    solve_any_size(problem, criteria, CHAIN_OPERATIONS)
}

/// True if a problem is a least-squares problem in forces: it has balance equations and a quadratic objective.
pub(super) fn is_least_squares(problem: &QuadraticProgram) -> bool {
    problem.equalities > 0 && !problem.quadratic.is_empty()
}

/// Like [`solve`], but also for few blocks. The structure counts as a chain if its factorization needs fewer than
/// `chain_operations` operations for each unknown.
pub(super) fn solve_any_size(
    problem: &QuadraticProgram,
    criteria: StoppingCriteria,
    chain_operations: f64,
) -> Option<Answer> {
    let form = match ProblemKind::new(problem) {
        Some(ProblemKind::Linear(form)) => form,
        Some(ProblemKind::LeastNorm) => {
            return solve_least_norm(problem, criteria, chain_operations);
        }
        None if is_least_squares(problem) => return block_qp::solve(problem, criteria),
        None => return None,
    };
    let (mut columns, cost, loads) = form.pair(problem);
    if columns.max_entries() > MAX_COLUMN_ENTRIES {
        return None;
    }
    let mut factor = Cholesky::new(&mut columns)?;
    let is_chain = is_chain(&factor, &columns, chain_operations);
    let lp = LinearProgram {
        columns: &columns,
        cost: &cost,
        loads: &factor.to_elimination_order(&loads),
        velocity_weight: f64::from(u8::from(form == LinearForm::ShortestVelocities)),
    };
    // If the method ends without a result for a chain or for the shortest velocities, return `None`, so that clarabel
    // is tried.
    let solution = interior_point::solve(&lp, &mut factor, criteria);
    if (is_chain || form == LinearForm::ShortestVelocities) && solution.termination.is_none() {
        return None;
    }
    let velocities = factor.to_program_order(&solution.velocities);
    Some(form.answer(problem, solution, velocities))
}

/// Finds the amounts, positive or negative, that balance the loads with the least ½|amounts|². `None` if clarabel
/// should solve the problem.
fn solve_least_norm(problem: &QuadraticProgram, criteria: StoppingCriteria, chain_operations: f64) -> Option<Answer> {
    let (mut columns, _, loads) = LinearForm::Forces.pair(problem);
    if columns.max_entries() > MAX_COLUMN_ENTRIES {
        return None;
    }
    let mut factor = Cholesky::new(&mut columns)?;
    let is_chain = is_chain(&factor, &columns, chain_operations);
    let loads = factor.to_elimination_order(&loads);
    match least_norm::solve(&columns, &mut factor, &loads, criteria.tolerance) {
        Some(optimum) => Some(Answer {
            status: Status::Solved,
            x: optimum.amounts,
            z: (factor.to_program_order(&optimum.multipliers).iter()).map(|v| -v).collect(),
            s: vec![0.0; loads.len()],
            iterations: 1,
        }),
        // If a chain loses too many digits here, return an answer without a result: clarabel finds no optimum either,
        // even after two hundred iterations.
        None => is_chain.then(|| Answer::without_status(problem)),
    }
}

/// True if the structure counts as a chain: its factorization needs fewer than `chain_operations` operations for each
/// unknown.
fn is_chain(factor: &Cholesky, columns: &ColumnGroups, chain_operations: f64) -> bool {
    factor.operations() < chain_operations * columns.unknowns() as f64
}

/// The kinds of problem that this module solves, apart from the problems of [`block_qp`].
enum ProblemKind {
    Linear(LinearForm),
    /// The least ½|amounts|² without bounds: one equality for each velocity.
    LeastNorm,
}

/// The form in which a [`QuadraticProgram`] states the linear program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LinearForm {
    /// The unknowns are velocities: one inequality for each column.
    Kinematic,
    /// The unknowns are amounts: one equality for each velocity, and amount ≥ 0 for each column.
    Forces,
    /// The kinematic form with the objective ½|velocities|² added.
    ShortestVelocities,
}

impl ProblemKind {
    fn new(problem: &QuadraticProgram) -> Option<ProblemKind> {
        // Recognise the form by its quadratic objective and its rows.
        let mut squares = problem.quadratic.iter().enumerate();
        let all_squared =
            problem.quadratic.len() == problem.unknowns && squares.all(|(k, entry)| *entry == (k, k, 1.0));
        if all_squared && problem.equalities == 0 {
            return Some(ProblemKind::Linear(LinearForm::ShortestVelocities));
        }
        if all_squared && problem.equalities == problem.bound.len() {
            let has_no_cost = problem.linear.iter().all(|q| *q == 0.0);
            return has_no_cost.then_some(ProblemKind::LeastNorm);
        }
        if !problem.quadratic.is_empty() {
            return None;
        }
        if problem.equalities == 0 {
            return Some(ProblemKind::Linear(LinearForm::Kinematic));
        }
        // After the equilibrium equations, only the rows −amount ≤ 0 are allowed, one for each column.
        let signs = problem.bound.len() - problem.equalities;
        let is_sign =
            |(row, column, value): &(usize, usize, f64)| *row - problem.equalities == *column && *value == -1.0;
        let below = problem.matrix.iter().filter(|e| e.0 >= problem.equalities);
        let only_signs = signs == problem.unknowns
            && below.clone().count() == signs
            && below.clone().all(is_sign)
            && problem.bound[problem.equalities..].iter().all(|b| *b == 0.0);
        only_signs.then_some(ProblemKind::Linear(LinearForm::Forces))
    }
}

impl LinearForm {
    /// Returns the columns of the linear program, their costs, and the loads.
    fn pair(self, problem: &QuadraticProgram) -> (ColumnGroups, Vec<f64>, Vec<f64>) {
        match self {
            LinearForm::Kinematic | LinearForm::ShortestVelocities => (
                ColumnGroups::new(problem.unknowns, problem.bound.len(), problem.matrix.iter().copied()),
                problem.bound.clone(),
                problem.linear.iter().map(|v| -v).collect(),
            ),
            LinearForm::Forces => (
                ColumnGroups::new(
                    problem.equalities,
                    problem.unknowns,
                    problem
                        .matrix
                        .iter()
                        .filter(|e| e.0 < problem.equalities)
                        .map(|(row, column, value)| (*column, *row, *value)),
                ),
                problem.linear.clone(),
                problem.bound[..problem.equalities].to_vec(),
            ),
        }
    }

    /// Converts the solution of the primal and the dual program to the unknowns, rows and signs of the problem.
    fn answer(self, problem: &QuadraticProgram, solution: Solution, velocities: Vec<f64>) -> Answer {
        let in_amounts = self == LinearForm::Forces;
        let status = match solution.termination {
            None => Status::Unsolved,
            Some(Termination::Optimal) => Status::Solved,
            // The kinematic form is the dual, so the statuses infeasible and unbounded are exchanged.
            Some(Termination::PrimalInfeasible) if in_amounts => Status::Infeasible,
            Some(Termination::Unbounded) if !in_amounts => Status::Infeasible,
            Some(_) => Status::Unbounded,
        };
        let (x, z, s) = if in_amounts {
            let multipliers = velocities.iter().map(|v| -v).chain(solution.slack);
            let no_slack = std::iter::repeat_n(0.0, problem.equalities);
            let s = no_slack.chain(solution.amounts.iter().copied()).collect();
            (solution.amounts, multipliers.collect(), s)
        } else {
            (velocities, solution.amounts, solution.slack)
        };
        let answer = Answer { status, x, z, s, iterations: solution.iterations };
        answer.if_finite()
    }
}
