//! Limit analysis: computes the largest load factor, the load factor nearest to 0, or the least limit of a robot's
//! force or torque with which the loads can be balanced. Each value is the optimum of one linear program.
//!
//! The static theorem: the largest load factor is max λ s.t. Σ amount·column = loads + λ·direction. Its dual is the
//! kinematic theorem. Compared with the dual of the program of least force, the dual has one more row, directionᵀy ≥ 1,
//! and λ is the multiplier of this row. The velocities are the collapse mechanism at the limit. The least sufficient
//! limit of a robot's component is the least amount of this component, if no other force has a cost. Reference:
//! [Livesley78](crate::doc::references).

use super::dual::amounts_of_rows;
use super::reduced_columns::ReducedColumns;
use super::{
    Amounts, Answer, Conditioning, Effort, Face, Status, TOLERANCE, balance_by_least_change, dual, largest, solve,
};
use crate::mechanics::program::{Column, Force, Program, columns, load_factor_dual, nearest_factor_dual};

/// The extreme value of a load factor or of a robot's limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The extreme load factor; for a robot's component, its least limit in program units.
    At(f64),
    /// No value allows a balance.
    Infeasible,
    /// The load factor may grow without limit.
    Unbounded,
    /// The solver ended without a result, so nothing is known about the value.
    Unsolved,
}

/// The extreme value of a load factor or of a robot's limit, with the forces and the motion at this value.
#[derive(Clone, Debug)]
pub struct ExtremeValue {
    /// The extreme value.
    pub limit: Limit,
    /// Forces that balance the loads at the extreme value; `None` if `limit` is not [`Limit::At`].
    pub forces: Option<Amounts>,
    /// Three velocities for each block. With [`Limit::At`], they are the collapse mechanism just beyond the extreme
    /// value. With [`Limit::Infeasible`], they are a motion along which the loads do work for every allowed load
    /// factor. `None` in all other cases, and if no such motion was computed.
    pub motion: Option<Vec<f64>>,
}

impl From<Limit> for ExtremeValue {
    fn from(limit: Limit) -> ExtremeValue {
        ExtremeValue { limit, forces: None, motion: None }
    }
}

/// From this number of blocks on, the finest of [`TOLERANCES`] is not tried: with it, a wall of 410 bricks ends
/// without a result.
const MANY_BLOCKS: usize = 200;

/// The right-hand side of the row directionᵀy ≥ 1 for many blocks, instead of 1. It scales the velocities.
///
/// With 1, the velocities of a wall of 915 bricks are about 0.001. Its limit then takes 97 iterations with full
/// conditioning and is accurate to 10⁻⁶. With 1 000, the limit takes 38 iterations with plain conditioning and is
/// accurate to 10⁻⁷.
const WORK_OF_MANY_BLOCKS: f64 = 1e3;

/// The tolerances that are tried in turn until the solver ends with a result.
const TOLERANCES: [f64; 3] = [TOLERANCE, 10.0 * TOLERANCE, 100.0 * TOLERANCE];

/// Finds the largest λ ≥ 0 for which admissible forces balance `program.loads + λ·direction`.
///
/// Loads and direction are scaled to a largest entry of 1. With loads of 300, the solver stops for a wall of 420 bricks
/// after a hundred iterations at λ = 0.48159; with loads of 1 it reaches the optimum λ = 0.48162.
pub fn largest_factor(program: &Program, direction: &[f64]) -> ExtremeValue {
    factor_along(program, direction, Extremum::Largest)
}

/// Finds the λ nearest to 0, positive or negative, for which admissible forces balance `program.loads + λ·direction`.
///
/// [`Limit::Infeasible`] means that no λ allows a balance. If some λ allows a balance, there is a λ nearest to 0.
pub fn nearest_factor(program: &Program, direction: &[f64]) -> ExtremeValue {
    factor_along(program, direction, Extremum::Nearest)
}

/// Which load factor λ is to be found.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extremum {
    Largest,
    Nearest,
}

impl Extremum {
    /// Returns the number of rows, at the end of the linear program, whose multipliers determine λ.
    fn rows(self) -> usize {
        match self {
            Extremum::Largest => 1,
            Extremum::Nearest => 2,
        }
    }

    /// Computes λ from the multipliers of the last rows of the linear program; `None` if the solver returned too few
    /// multipliers.
    fn factor(self, multipliers: &[f64]) -> Option<f64> {
        match (self, multipliers) {
            (Extremum::Largest, [.., up]) => Some(up.max(0.0)),
            (Extremum::Nearest, [.., up, down]) => Some(up - down),
            _ => None,
        }
    }
}

/// Finds the largest λ, or the λ nearest to 0, for which admissible forces balance `program.loads + λ·direction`.
fn factor_along(program: &Program, direction: &[f64], extremum: Extremum) -> ExtremeValue {
    let Some(scaled) = ScaledLoads::new(program, direction) else {
        return Limit::Unbounded.into();
    };
    let columns = scaled.columns(program);
    let (mut problem, row_of) = match extremum {
        Extremum::Largest => load_factor_dual(&scaled.loads, &scaled.direction, &columns),
        Extremum::Nearest => nearest_factor_dual(&scaled.loads, &scaled.direction, &columns),
    };
    if program.blocks >= MANY_BLOCKS {
        let work_rows = problem.bound.iter_mut().rev().take(extremum.rows());
        work_rows.for_each(|b| *b *= WORK_OF_MANY_BLOCKS);
    }
    // Try the tolerances in turn until the solver ends with a result.
    for (tolerance, conditioning) in attempts(program) {
        let answer = solve(&problem, tolerance, conditioning);
        match (answer.status, extremum.factor(&answer.z)) {
            (Status::Solved, Some(factor)) => {
                let total = scaled.total(factor);
                let amounts = scaled.amounts(&total, &columns, &answer, &row_of);
                let face = Face::whole(&total, columns).with_amounts(amounts);
                return ExtremeValue {
                    limit: Limit::At(scaled.factor(factor)),
                    forces: Some(face.to_forces(program).0),
                    motion: Some(scaled.motion(&answer)),
                };
            }
            (Status::Infeasible, _) => return Limit::Unbounded.into(),
            // No λ allows a balance (for the largest λ: no λ ≥ 0). Along this motion, the loads do positive work for
            // each of these λ.
            (Status::Unbounded, _) => {
                return ExtremeValue { motion: Some(scaled.motion(&answer)), ..Limit::Infeasible.into() };
            }
            _ => {}
        }
    }
    Limit::Unsolved.into()
}

/// The loads of a program and the direction in which they grow, both scaled to a largest entry of 1.
pub(super) struct ScaledLoads {
    pub(super) loads: Vec<f64>,
    pub(super) direction: Vec<f64>,
    /// The largest entry of the loads before scaling, or 1 if there are no loads.
    load_size: f64,
    /// The largest entry of the direction before scaling.
    pub(super) direction_size: f64,
}

impl ScaledLoads {
    /// Scales the loads of a program and a direction; `None` if the direction is zero.
    pub(super) fn new(program: &Program, direction: &[f64]) -> Option<ScaledLoads> {
        let direction_size = largest(direction);
        if direction_size == 0.0 {
            return None;
        }
        let load_size = match largest(&program.loads) {
            0.0 => 1.0,
            size => size,
        };
        let scaled = |list: &[f64], by: f64| list.iter().map(|v| v / by).collect();
        Some(ScaledLoads {
            loads: scaled(&program.loads, load_size),
            direction: scaled(direction, direction_size),
            load_size,
            direction_size,
        })
    }

    /// Returns the columns of the program without redundant columns ([`ReducedColumns`]), with limits in the unit of
    /// the scaled loads.
    pub(super) fn columns(&self, program: &Program) -> Vec<Column> {
        ReducedColumns::new(&columns_in(program, self.load_size)).columns
    }

    /// Converts a factor of the scaled direction to the factor of the original direction.
    pub(super) fn factor(&self, scaled: f64) -> f64 {
        scaled * self.load_size / self.direction_size
    }

    /// Returns the scaled loads plus `factor` times the scaled direction.
    pub(super) fn total(&self, factor: f64) -> Vec<f64> {
        let pairs = self.loads.iter().zip(&self.direction);
        pairs.map(|(load, along)| load + factor * along).collect()
    }

    /// Returns the amount of each column under the scaled loads `total`, in program units. The solver's residual is
    /// removed first.
    pub(super) fn amounts(&self, total: &[f64], columns: &[Column], answer: &Answer, row_of: &[usize]) -> Vec<f64> {
        let mut amounts = rebalanced(total, columns, amounts_of_rows(answer, row_of));
        amounts.iter_mut().for_each(|amount| *amount *= self.load_size);
        amounts
    }

    /// Returns the mechanism of an answer: three velocities for each block.
    pub(super) fn motion(&self, answer: &Answer) -> Vec<f64> {
        answer.x[..self.loads.len()].iter().map(|v| -v).collect()
    }
}

/// Returns the tolerances and conditionings in the order in which they are tried. For many blocks, the faster plain
/// conditioning is tried first, and the finest tolerance is not tried.
pub(super) fn attempts(program: &Program) -> impl Iterator<Item = (f64, Conditioning)> {
    let has_many_blocks = program.blocks >= MANY_BLOCKS;
    let plain = has_many_blocks.then_some((TOLERANCES[1], Conditioning::Plain));
    let finest = usize::from(has_many_blocks);
    let full = TOLERANCES.into_iter().skip(finest);
    plain.into_iter().chain(full.map(|tolerance| (tolerance, Conditioning::Full)))
}

/// Returns the amounts after the least change that removes the solver's residual.
pub(super) fn rebalanced(loads: &[f64], columns: &[Column], amounts: Vec<f64>) -> Vec<f64> {
    let settings = Conditioning::Plain.into();
    balance_by_least_change(loads, columns, amounts, settings, &mut Effort::default())
}

/// Returns the columns of a program, with limits in multiples of the load `unit`.
pub(super) fn columns_in(program: &Program, unit: f64) -> Vec<Column> {
    let mut columns = columns(program);
    for column in &mut columns {
        column.limit /= unit;
    }
    columns
}

/// Finds the least limit of one component of one grip with which admissible forces balance the loads. All other limits
/// stay as in `program`. The components are 0 for the force x, 1 for the force y and 2 for torque/L.
pub fn least_grip_limit(program: &Program, grip: usize, component: usize) -> ExtremeValue {
    // Remove the limit of the component, and give each unit of it a cost of 1. The optimum then has the least amount of
    // this component.
    let mut free = program.clone();
    free.grips[grip].limits[component] = f64::INFINITY;
    let is_own =
        |force: &Force| matches!(force, Force::Grip { grip: g, component: c, .. } if *g == grip && *c == component);
    let columns = columns(&free);
    let solved = dual(&free.loads, &columns, Conditioning::Full, &mut Effort::default(), |c| {
        f64::from(u8::from(is_own(&c.force)))
    });
    match solved.status {
        // The least limit is the amount of this component, added up over its positive and its negative direction.
        Status::Solved => {
            let amounts = rebalanced(&free.loads, &columns, solved.amounts.clone());
            let owned = columns.iter().zip(&solved.amounts);
            let owned = owned.filter(|(c, _)| is_own(&c.force));
            let at = owned.map(|(_, amount)| amount).sum();
            let face = Face::whole(&free.loads, columns.clone()).with_amounts(amounts);
            ExtremeValue {
                limit: Limit::At(at),
                forces: Some(face.to_forces(&free).0),
                motion: Some(solved.y.iter().map(|v| -v).collect()),
            }
        }
        Status::Unbounded => Limit::Infeasible.into(),
        _ => Limit::Unsolved.into(),
    }
}
