//! [`Face`]: the set of all optima of a linear program, and the balance of least Σ force² on it.
//!
//! An interior-point method ends in the relative interior of the face of optima, where the solution is strictly
//! complementary. A column therefore belongs to the face exactly if its amount exceeds its slack, which is its reduced
//! cost (Goldman and Tucker 1956).

use super::amounts::{Amounts, Effort};
use super::answer::Status;
use super::optimum::{Optimum, solve_in_turn};
use super::settings::SolverSettings;
use crate::mechanics::program::{Column, Program, least_squares};

/// A face of the polyhedron of all balances (admissible forces that balance the loads). It is described by the columns
/// whose amounts may vary on the face, and by the columns that are at their limits everywhere on the face. All other
/// columns are 0.
#[derive(Clone)]
pub(super) struct Face {
    /// The loads that `columns` must balance: the given loads minus the forces of the columns at their limits.
    pub loads: Vec<f64>,
    /// The columns whose amounts may vary between their bounds.
    pub columns: Vec<Column>,
    /// An amount for each of `columns`.
    pub amounts: Vec<f64>,
    /// The columns whose amount equals their limit in every optimum.
    pub at_limit: Vec<Column>,
}

impl Face {
    /// Returns the face of all forces that balance the loads: no column is excluded, and none is fixed at its limit. The
    /// amounts are set to 0; they do not balance the loads yet.
    pub fn whole(loads: &[f64], columns: Vec<Column>) -> Face {
        let amounts = vec![0.0; columns.len()];
        Face { loads: loads.to_vec(), columns, amounts, at_limit: Vec::new() }
    }

    /// Returns the same face with other amounts.
    pub fn with_amounts(self, amounts: Vec<f64>) -> Face {
        Face { amounts, ..self }
    }

    /// Returns the face of optima of a linear program on this face. `solved` is the solution of the program; its basic
    /// columns (see [`Optimum::active`]) belong to the face of optima.
    ///
    /// A limited column counts as being at its limit if the multiplier of the limit exceeds the distance of its amount
    /// from the limit. Such columns are fixed; otherwise not every balance on the face would be an optimum.
    pub fn optimal_face(&self, solved: &Optimum, margin: f64) -> Face {
        let mut face = Face { columns: Vec::new(), amounts: Vec::new(), ..self.clone() };
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

    /// Returns the face restricted to the columns for which `keep(column, amount)` is true.
    pub fn restrict(&self, mut keep: impl FnMut(&Column, f64) -> bool) -> Face {
        let mut face = Face { columns: Vec::new(), amounts: Vec::new(), ..self.clone() };
        for (column, amount) in self.columns.iter().zip(&self.amounts) {
            if keep(column, *amount) {
                face.columns.push(*column);
                face.amounts.push(*amount);
            }
        }
        face
    }

    /// Returns the total cost of the given amounts and of the columns at their limits.
    pub fn cost(&self, amounts: &[f64]) -> f64 {
        let chosen: f64 = self.columns.iter().zip(amounts).map(|(c, a)| c.cost * a).sum();
        chosen + self.at_limit.iter().map(|c| c.cost * c.limit).sum::<f64>()
    }

    /// Returns the entries of `amounts` that belong to adhesion columns. `amounts` has one entry for each of
    /// `columns`.
    pub fn adhesion_amounts<'a>(&'a self, amounts: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let both = self.columns.iter().zip(amounts);
        both.filter(|(c, _)| c.force.is_adhesion()).map(|(_, a)| *a)
    }

    /// Returns the sum of the amounts of the adhesion columns: the objective of stage 1 of the program of least
    /// adhesion.
    pub fn adhesion_sum(&self, amounts: &[f64]) -> f64 {
        self.adhesion_amounts(amounts).sum()
    }

    /// Converts the amounts to forces of contacts and grips. Returns the admissible forces, and the adhesion.
    pub fn to_forces(&self, program: &Program) -> (Amounts, Amounts) {
        let (mut admissible, mut adhesion) = (Amounts::zero(program), Amounts::zero(program));
        let chosen = self.columns.iter().zip(self.amounts.iter().copied());
        let at_limit = self.at_limit.iter().map(|c| (c, c.limit));
        for (column, amount) in chosen.chain(at_limit) {
            let to = if column.force.is_adhesion() { &mut adhesion } else { &mut admissible };
            to.add(column.force, amount);
        }
        (admissible, adhesion)
    }
}

/// Computes the amounts ≥ 0 of least Σ force² that balance the loads. `None` if the solver finds no such amounts.
pub(super) fn least_squares_amounts(
    loads: &[f64],
    columns: &[Column],
    settings: SolverSettings,
    effort: &mut Effort,
) -> Option<Vec<f64>> {
    if columns.is_empty() {
        return Some(Vec::new());
    }
    let answer = solve_in_turn(&least_squares(loads, columns, None), settings.with_retry(), effort);
    (answer.status == Status::Solved).then(|| answer.x.iter().map(|v| v.max(0.0)).collect())
}
