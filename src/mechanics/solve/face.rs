//! [`Face`]: the set of all optima of a linear program, and the balance of least Σ force² on it.
//!
//! An interior-point method ends in the relative interior of the face of optima: its answer is strictly complementary, so a
//! column belongs to the face exactly if its amount outweighs its slack (Goldman and Tucker).

use super::amounts::{Amounts, Effort};
use super::answer::Status;
use super::dual::{Dual, solved_with_retry};
use super::exact;
use super::settings::SolverSettings;
use crate::program::{Column, Program, least_squares};

/// A face of the polyhedron of balances: the columns that may carry force, and those at their limits on all of it.
#[derive(Clone)]
pub(super) struct Face {
    /// What `columns` must balance: the loads, less what the columns at their limits give.
    pub loads: Vec<f64>,
    /// The columns between their bounds.
    pub columns: Vec<Column>,
    /// An amount for each of `columns`.
    pub amounts: Vec<f64>,
    /// The columns that every optimum uses to their limit.
    pub at_limit: Vec<Column>,
}

impl Face {
    /// All balances of some columns.
    pub fn whole(loads: &[f64], columns: Vec<Column>) -> Face {
        let amounts = vec![0.0; columns.len()];
        Face {
            loads: loads.to_vec(),
            columns,
            amounts,
            at_limit: Vec::new(),
        }
    }

    /// The same columns with other amounts.
    pub fn with(self, amounts: Vec<f64>) -> Face {
        Face { amounts, ..self }
    }

    /// The face of optima, from a solved dual of this face: its basic columns (see [`Dual::active`]).
    ///
    /// A limited column is at its limit if the limit's multiplier exceeds the distance from it. Only then is every balance on
    /// the face an optimum.
    pub fn narrowed(&self, solved: &Dual, margin: f64) -> Face {
        let mut face = Face {
            columns: Vec::new(),
            amounts: Vec::new(),
            ..self.clone()
        };
        let active = solved.active(margin);
        for (k, column) in self.columns.iter().enumerate() {
            let amount = solved.amounts[k];
            if column.limit.is_finite() && solved.multipliers[k] > column.limit - amount {
                column.add_to(&mut face.loads, -column.limit);
                face.at_limit.push(*column);
            } else if active[k] {
                face.columns.push(*column);
                face.amounts.push(amount);
            }
        }
        face
    }

    /// The face with those columns only for which `keep(column, amount)` is true.
    pub fn only(&self, keep: impl Fn(&Column, f64) -> bool) -> Face {
        let mut face = Face {
            columns: Vec::new(),
            amounts: Vec::new(),
            ..self.clone()
        };
        for (column, amount) in self.columns.iter().zip(&self.amounts) {
            if keep(column, *amount) {
                face.columns.push(*column);
                face.amounts.push(*amount);
            }
        }
        face
    }

    /// The cost of amounts, with that of the columns at their limits.
    pub fn cost(&self, amounts: &[f64]) -> f64 {
        let chosen: f64 = self
            .columns
            .iter()
            .zip(amounts)
            .map(|(c, a)| c.cost * a)
            .sum();
        chosen + self.at_limit.iter().map(|c| c.cost * c.limit).sum::<f64>()
    }

    /// The admissible forces and the sticking forces.
    pub fn gathered(&self, program: &Program) -> (Amounts, Amounts) {
        let (mut admissible, mut sticking) = (Amounts::none(program), Amounts::none(program));
        let chosen = self.columns.iter().zip(self.amounts.iter().copied());
        let at_limit = self.at_limit.iter().map(|c| (c, c.limit));
        for (column, amount) in chosen.chain(at_limit) {
            let to = if column.force.is_sticking() {
                &mut sticking
            } else {
                &mut admissible
            };
            to.add(column.force, amount);
        }
        (admissible, sticking)
    }
}

/// The amounts ≥ 0 of least Σ force² on given columns; `None` if the columns cannot balance the loads.
///
/// If the balance has a unique solution, or one that [`exact`] can prove, elimination finds it, right to rounding. Else a
/// quadratic program does.
pub(super) fn least_squares_amounts(
    loads: &[f64],
    columns: &[Column],
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Vec<f64>> {
    if columns.is_empty() {
        return Some(Vec::new());
    }
    if let Some(amounts) = exact::unique_balance(loads, columns)
        .or_else(|| exact::least_squares_balance(loads, columns))
    {
        return Some(amounts);
    }
    let answer = solved_with_retry(&least_squares(loads, columns, None), settings, effort);
    (answer.status == Status::Solved).then(|| answer.x.iter().map(|v| v.max(0.0)).collect())
}
