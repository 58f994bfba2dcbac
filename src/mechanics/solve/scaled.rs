//! [`ScaledProgram`]: a program in the form in which solvers are most accurate. Its largest load is 1, and redundant
//! columns are omitted ([`ReducedColumns`]).
//!
//! With loads of 300, the solver stops for a wall of 410 bricks at its limit after a hundred iterations without a
//! result; with loads of 1 it finds the optimum after about 70.
//!
//! If admissible forces have no cost, the pure normal force n̂ is redundant. It is (1 + μ)/2 times the sum of the two
//! rays of its friction cone, (n̂ + μ t̂)/(1 + μ) and (n̂ − μ t̂)/(1 + μ). Without the redundant columns, the dual has
//! a third fewer rows.

use super::amounts::{Amounts, Effort, largest};
use super::face::Face;
use super::optimum::{Optimum, solve_kinematic_form};
use super::settings::SolverSettings;
use crate::mechanics::program::{Aim, Column, Force, Program, columns};

/// A program whose loads are scaled to a largest load of 1.
pub(super) struct ScaledProgram<'p> {
    program: &'p Program,
    /// The largest load of the program, by which all loads are divided; 1 if there are no loads.
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

    /// Solves the kinematic form of the scaled program.
    pub fn solve(&self, aim: &Aim, attempts: impl IntoIterator<Item = SolverSettings>, effort: &mut Effort) -> Optimum {
        solve_kinematic_form(&self.loads, &self.columns, aim, attempts, effort)
    }

    /// Returns the columns, with limits in the units of the original program.
    pub fn into_columns(mut self) -> Vec<Column> {
        self.columns.iter_mut().for_each(|column| column.limit *= self.load);
        self.columns
    }

    /// Converts the amounts of the columns to forces in the units of the original program.
    pub fn forces(&self, mut amounts: Vec<f64>) -> Amounts {
        amounts.iter_mut().for_each(|amount| *amount *= self.load);
        Face::whole(&self.loads, self.columns.clone()).with_amounts(amounts).to_forces(self.program).0
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
    pub fn expand_optimum(&self, all: &[Column], solved: Optimum) -> Optimum {
        let mut full = Optimum {
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
