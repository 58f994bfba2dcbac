//! [`ReducedColumns`]: the columns of a program, without the pure normal forces that are sums of two rays of a
//! friction cone.
//!
//! If admissible forces have no cost, the pure normal force n̂ is redundant. It is (1 + μ)/2 times the sum of the two
//! rays of its friction cone, (n̂ + μ t̂)/(1 + μ) and (n̂ − μ t̂)/(1 + μ). Without the redundant columns, the dual has
//! a third fewer rows.

use super::Dual;
use crate::mechanics::program::{Column, Force};

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
