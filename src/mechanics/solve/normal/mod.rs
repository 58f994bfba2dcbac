//! A second solver, for programs of many blocks: an interior-point method on the normal equations.
//!
//! A program's forces and velocities are optima of one pair of linear programs,
//!
//! ```text
//! min Σ cost·amount  s.t.  Σ amount·column = loads, amount ≥ 0   and   max loadsᵀy  s.t.  columnᵀy ≤ cost.
//! ```
//!
//! Every step of an interior-point method solves Σ weight·column·columnᵀ·y = right-hand side, a matrix with three rows per
//! block that couples blocks which touch. Of walls with a thousand blocks and more its factor, made of dense panels, takes
//! less than half the time of the one with a row per force; and steps that are centred again after they are found end
//! near the edge of standing where others run out of iterations.
//!
//! Where the sum of squared velocities is to be least, the matrix has 1 added to its diagonal; where that of squared forces is,
//! each contact has a small matrix for a weight. The smallest amounts that undo
//! what is left unbalanced take one factor and no iteration.
//!
//! It needs no trust: what it says goes to the proof like the answer of clarabel. Where it ends without a status, clarabel
//! is asked with full conditioning, or the next rung of the ladder decides. How much faster it is, and of what, is measured in [`crate::doc::performance`].

mod cholesky;
mod elements;
mod interior;
mod panels;
mod point;
mod product;
mod squares;
mod trend;
#[cfg(test)]
mod tests;

use std::time::Instant;

use super::{Answer, CrossoverTolerance, Status};
use crate::program::QuadraticProgram;
use cholesky::Cholesky;
use elements::Elements;
use interior::{Ended, Optimum, Posed};

/// Programs of fewer unknowns than so many blocks have go to clarabel, where little time is at stake.
///
/// From here on optima are also sharper: of a wall of 410 bricks 10⁻⁵ past its edge the least sticking is found to 10⁻⁶ of itself,
/// where clarabel's is off by half a hundredth, since velocities may violate a column by 10⁻⁸ that carries 10⁷ times as much.
const FEWEST_BLOCKS: usize = 60;

/// Where the factor takes fewer operations for an unknown, as those of chains do, what ends without a status is left to
/// clarabel: chains are the quickest for either, and long ones lose digits in the normal equations. An arch of 10 000 stones
/// keeps 10⁻⁶ of its loads unbalanced.
const LEAST_WORK: f64 = 1e3;

/// A column that touches more unknowns than so many would couple them all.
const MOST_ENTRIES: usize = 12;

/// Times that the smallest amounts are sought for what is left: each gains what the factor has of digits.
const ROUNDS: usize = 3;

/// What a program is to be solved to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// The tolerance of feasibility and gap.
    pub tolerance: f64,
    /// Where it goes on to; where that is out of reach, the tolerance does.
    pub finer: Option<CrossoverTolerance>,
    pub iterations: usize,
    pub deadline: Option<Instant>,
}

/// An optimum, a certificate, or no status; `None` where clarabel is to be asked: of other programs, and of few blocks.
pub(super) fn solve(problem: &QuadraticProgram, limits: Limits) -> Option<Answer> {
    let rows = match problem.equalities {
        0 => problem.unknowns,
        equalities => equalities,
    };
    if rows < 3 * FEWEST_BLOCKS {
        return None;
    }
    solve_where(problem, limits, LEAST_WORK)
}

/// Whether a problem wants the least squares of forces.
pub(super) fn is_squares(problem: &QuadraticProgram) -> bool {
    problem.equalities > 0 && !problem.quadratic.is_empty()
}

/// The same of every size; a chain's factor takes fewer operations for an unknown than so many.
fn solve_where(problem: &QuadraticProgram, limits: Limits, least_work: f64) -> Option<Answer> {
    let Some(form) = Form::new(problem) else {
        return is_squares(problem)
            .then(|| squares::solve(problem, limits))
            .flatten();
    };
    let (mut elements, cost, loads) = form.posed(problem);
    if elements.widest() > MOST_ENTRIES {
        return None;
    }
    let mut factor = Cholesky::new(&mut elements)?;
    let is_chain = factor.operations() < least_work * elements.unknowns() as f64;
    let loads = factor.in_order(&loads);
    if form == Form::Smallest {
        let y = smallest(&elements, &mut factor, &loads, limits.tolerance);
        // Of a chain that loses too many digits here clarabel has no optimum either, after two hundred iterations.
        let none = is_chain.then(|| Answer::none(problem));
        return y.map(|y| smallest_answer(&elements, &factor, y)).or(none);
    }
    let posed = Posed {
        elements: &elements,
        cost: &cost,
        loads: &loads,
        squares: f64::from(u8::from(form == Form::Shortest)),
    };
    let found = interior::solve(posed, &mut factor, limits);
    if (is_chain || form == Form::Shortest) && found.ended.is_none() {
        return None;
    }
    let velocities = factor.as_given(&found.velocities);
    Some(form.answer(problem, found, velocities))
}

/// The multipliers y of the smallest amounts that give the loads: Σ column·columnᵀ·y = loads; `None` where rounding leaves
/// more than the tolerance.
fn smallest(
    elements: &Elements,
    factor: &mut Cholesky,
    loads: &[f64],
    tolerance: f64,
) -> Option<Vec<f64>> {
    let mut amounts = vec![1.0; elements.count()];
    factor.factor(elements, &amounts, 0.0);
    let mut y = vec![0.0; loads.len()];
    let mut left = loads.to_vec();
    for _ in 0..ROUNDS {
        let mut change: Vec<[f64; 1]> = left.iter().map(|v| [*v]).collect();
        factor.solve(&mut change);
        y.iter_mut().zip(&change).for_each(|(y, d)| *y += d[0]);
        elements.along(&y, &mut amounts);
        left.fill(0.0);
        elements.add(&amounts, &mut left);
        let loads = loads.iter();
        left.iter_mut()
            .zip(loads)
            .for_each(|(v, load)| *v = load - *v);
    }
    let worst = left.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    (worst <= tolerance).then_some(y)
}

fn smallest_answer(elements: &Elements, factor: &Cholesky, y: Vec<f64>) -> Answer {
    let mut amounts = vec![0.0; elements.count()];
    elements.along(&y, &mut amounts);
    Answer {
        status: Status::Solved,
        x: amounts,
        z: factor.as_given(&y).iter().map(|v| -v).collect(),
        s: vec![0.0; y.len()],
        iterations: 1,
    }
}

/// Which of the pair is written down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// Velocities are the unknowns: one row ≤ for each column.
    Kinematic,
    /// Amounts are the unknowns: one row = for each velocity, and amount ≥ 0 for each.
    Forces,
    /// The kinematic one, and ½|velocities|².
    Shortest,
    /// The least ½|amounts|² of any sign: one row = for each velocity.
    Smallest,
}

impl Form {
    fn new(problem: &QuadraticProgram) -> Option<Form> {
        let squares = problem.quadratic.iter().enumerate();
        let all_squared = problem.quadratic.len() == problem.unknowns
            && squares.clone().all(|(k, entry)| *entry == (k, k, 1.0));
        if all_squared && problem.equalities == 0 {
            return Some(Form::Shortest);
        }
        if all_squared && problem.equalities == problem.bound.len() {
            let plain = problem.linear.iter().all(|q| *q == 0.0);
            return plain.then_some(Form::Smallest);
        }
        if !problem.quadratic.is_empty() {
            return None;
        }
        if problem.equalities == 0 {
            return Some(Form::Kinematic);
        }
        let signs = problem.bound.len() - problem.equalities;
        let is_sign = |(row, column, value): &(usize, usize, f64)| {
            *row - problem.equalities == *column && *value == -1.0
        };
        let below = problem.matrix.iter().filter(|e| e.0 >= problem.equalities);
        let only_signs = signs == problem.unknowns
            && below.clone().count() == signs
            && below.clone().all(is_sign)
            && problem.bound[problem.equalities..]
                .iter()
                .all(|b| *b == 0.0);
        only_signs.then_some(Form::Forces)
    }

    /// The columns, their costs and the loads.
    fn posed(self, problem: &QuadraticProgram) -> (Elements, Vec<f64>, Vec<f64>) {
        match self {
            Form::Kinematic | Form::Shortest => (
                Elements::new(
                    problem.unknowns,
                    problem.bound.len(),
                    problem.matrix.iter().copied(),
                ),
                problem.bound.clone(),
                problem.linear.iter().map(|v| -v).collect(),
            ),
            Form::Forces | Form::Smallest => (
                Elements::new(
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

    /// The optimum of a pair in the terms of the problem as it was written down.
    fn answer(self, problem: &QuadraticProgram, found: Optimum, velocities: Vec<f64>) -> Answer {
        let in_amounts = self == Form::Forces;
        let status = match found.ended {
            None => Status::Unsolved,
            Some(Ended::Optimal) => Status::Solved,
            // The written half has no solution, or one without end.
            Some(Ended::NothingBalances) if in_amounts => Status::Infeasible,
            Some(Ended::CostWithoutEnd) if !in_amounts => Status::Infeasible,
            Some(_) => Status::Unbounded,
        };
        let (x, z, s) = if in_amounts {
            let signs = velocities.iter().map(|v| -v).chain(found.slack);
            let nothing = std::iter::repeat_n(0.0, problem.equalities);
            let s = nothing.chain(found.amounts.iter().copied()).collect();
            (found.amounts, signs.collect(), s)
        } else {
            (velocities, found.amounts, found.slack)
        };
        let answer = Answer {
            status,
            x,
            z,
            s,
            iterations: found.iterations,
        };
        answer.if_finite()
    }
}
