//! [`Slanted`]: the columns of a program without redundant ones.
//!
//! If admissible forces have no cost, a normal force alone is half the sum of the two rays of its friction cone, (n̂ + μ t̂)/(1 + μ) and
//! (n̂ − μ t̂)/(1 + μ), times 1 + μ. Its row follows from theirs. Without it a third of the rows is gone.

use super::Dual;
use crate::program::{Column, Force};

/// The columns that are left.
pub(super) struct Slanted {
    /// The columns.
    pub columns: Vec<Column>,
    /// The index of each among all columns.
    places: Vec<usize>,
}

impl Slanted {
    /// Leaves out every normal force alone that is followed by the two rays of its cone.
    pub fn new(all: &[Column]) -> Slanted {
        let places: Vec<usize> = (0..all.len()).filter(|k| !is_redundant(all, *k)).collect();
        Slanted {
            columns: places.iter().map(|k| all[*k]).collect(),
            places,
        }
    }

    /// The amounts of all columns, 0 for those left out.
    pub fn amounts_of_all(&self, all: &[Column], amounts: &[f64]) -> Vec<f64> {
        let mut full = vec![0.0; all.len()];
        for (amount, place) in amounts.iter().zip(&self.places) {
            full[*place] = *amount;
        }
        full
    }

    /// An optimum in terms of all columns: half of what both rays of a cone carry becomes the normal force alone.
    pub fn in_all_columns(&self, all: &[Column], solved: Dual) -> Dual {
        let mut full = Dual {
            amounts: self.amounts_of_all(all, &solved.amounts),
            slack: self.amounts_of_all(all, &solved.slack),
            multipliers: self.amounts_of_all(all, &solved.multipliers),
            ..solved
        };
        for k in (0..all.len()).filter(|k| is_redundant(all, *k)) {
            let Force::Ray { normal, .. } = all[k + 1].force else {
                continue;
            };
            let shared = 0.5 * full.amounts[k + 1].min(full.amounts[k + 2]);
            full.amounts[k] = 2.0 * normal * shared;
            full.slack[k] = (full.slack[k + 1] + full.slack[k + 2]) / (2.0 * normal);
            full.amounts[k + 1] -= shared;
            full.amounts[k + 2] -= shared;
        }
        full
    }
}

/// Whether a column is a normal force alone, followed by the two rays of its cone.
fn is_redundant(all: &[Column], k: usize) -> bool {
    let with_friction = |c: Option<&Column>| {
        c.is_some_and(|c| matches!(c.force, Force::Ray { friction, .. } if friction != 0.0))
    };
    matches!(all[k].force, Force::Ray { friction: 0.0, .. })
        && with_friction(all.get(k + 1))
        && with_friction(all.get(k + 2))
}
