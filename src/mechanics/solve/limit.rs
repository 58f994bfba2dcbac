//! Limit analysis: computes the largest load factor, the load factor nearest to 0, the least limit of a robot's force or
//! torque with which the loads can be balanced, or the largest force of a grip without limits in a direction. Each value
//! is the optimum of one linear program.
//!
//! The static theorem: the largest load factor is max λ s.t. Σ amount·column = loads + λ·direction. Its dual is the
//! kinematic theorem. Compared with the dual of the program of least force, the dual has one more row, directionᵀy ≥ 1,
//! and λ is the multiplier of this row. The velocities are the collapse mechanism at the limit. The least sufficient
//! limit of a robot's component is the least amount of this component, if no other force has a cost. Reference:
//! [Livesley78](crate::doc::references).

use super::scaled::ScaledProgram;
use super::{
    Amounts, Conditioning, Effort, Optimum, SolverSettings, Status, TOLERANCE, balance_by_least_change, largest,
};
use crate::geometry::Vector;
use crate::mechanics::program::{Aim, Column, Factor, Force, Program};

/// The extreme value of a load factor or of a robot's limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The extreme load factor; for a robot's component, its least limit in program units; for a grip, its largest
    /// force in a direction in program units.
    At(f64),
    /// No value allows a balance.
    Infeasible,
    /// The load factor or the force may grow without limit.
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

impl ExtremeValue {
    /// Returns the extreme value `at` if the program is solved, with the forces and the motion of the optimum.
    fn new(scaled: &ScaledProgram, solved: Optimum, at: f64) -> ExtremeValue {
        let motion = Some(solved.motion());
        match solved.status {
            Status::Solved => {
                ExtremeValue { limit: Limit::At(at), forces: Some(scaled.forces(solved.amounts)), motion }
            }
            // No mechanism has the velocities that the program asks for, so nothing limits the value.
            Status::Infeasible => Limit::Unbounded.into(),
            // No value allows a balance (for the largest λ: no λ ≥ 0). Along this motion, the loads do positive work
            // for each of these values.
            Status::Unbounded => ExtremeValue { motion, ..Limit::Infeasible.into() },
            Status::Unsolved => Limit::Unsolved.into(),
        }
    }
}

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
    extreme_factor(program, direction, Factor::Largest, false)
}

/// Like [`largest_factor`], but tries the faster plain conditioning first, whatever the number of blocks.
pub fn largest_factor_fast(program: &Program, direction: &[f64]) -> ExtremeValue {
    extreme_factor(program, direction, Factor::Largest, true)
}

/// Finds the λ nearest to 0, positive or negative, for which admissible forces balance `program.loads + λ·direction`.
///
/// [`Limit::Infeasible`] means that no λ allows a balance. If some λ allows a balance, there is a λ nearest to 0.
pub fn nearest_factor(program: &Program, direction: &[f64]) -> ExtremeValue {
    extreme_factor(program, direction, Factor::Nearest, false)
}

fn extreme_factor(program: &Program, direction: &[f64], factor: Factor, plain_first: bool) -> ExtremeValue {
    match solve_along(program, direction, factor, plain_first) {
        Some((scaled, solved)) => {
            let factor = solved.factor;
            ExtremeValue::new(&scaled, solved, factor)
        }
        None => Limit::Unbounded.into(),
    }
}

/// Finds the largest load factor, or the one nearest to 0. In the result, the factor refers to the original loads, but the
/// amounts refer to the scaled loads. `None` if the direction is zero.
fn solve_along<'p>(
    program: &'p Program,
    direction: &[f64],
    factor: Factor,
    plain_first: bool,
) -> Option<(ScaledProgram<'p>, Optimum)> {
    let size = largest(direction);
    if size == 0.0 {
        return None;
    }
    let scaled = ScaledProgram::new(program);
    let along: Vec<f64> = direction.iter().map(|v| v / size).collect();
    let is_large = program.has_many_blocks();
    let aim = Aim::Factor(factor, &along, if is_large { WORK_OF_MANY_BLOCKS } else { 1.0 });
    let mut solved = scaled.solve(&aim, attempts(plain_first, is_large), &mut Effort::default());
    if solved.status == Status::Solved {
        let total = scaled.loads.iter().zip(&along).map(|(load, along)| load + solved.factor * along);
        solved.amounts = rebalanced(&total.collect::<Vec<f64>>(), &scaled.columns, solved.amounts);
        solved.factor *= scaled.load / size;
    }
    Some((scaled, solved))
}

/// Returns the settings in the order in which they are tried: full conditioning with all tolerances, and before it
/// plain conditioning if `plain_first` is true. For many blocks, the faster plain conditioning is always tried first.
/// The finest tolerance is then not tried: with it, a wall of 410 bricks ends without a result.
fn attempts(plain_first: bool, is_large: bool) -> impl Iterator<Item = SolverSettings> {
    let with = |tolerance, conditioning: Conditioning| SolverSettings { tolerance, ..conditioning.into() };
    let plain = [plain_first.then_some(TOLERANCES[0]), is_large.then_some(TOLERANCES[1])].into_iter().flatten();
    let full = TOLERANCES.into_iter().skip(usize::from(is_large));
    plain.map(move |t| with(t, Conditioning::Plain)).chain(full.map(move |t| with(t, Conditioning::Full)))
}

/// Returns the amounts after the least change that removes the solver's residual.
pub(super) fn rebalanced(loads: &[f64], columns: &[Column], amounts: Vec<f64>) -> Vec<f64> {
    balance_by_least_change(loads, columns, amounts, Conditioning::Plain.into(), &mut Effort::default())
}

/// Finds the least limit of one component of one grip with which admissible forces balance the loads. All other limits
/// stay as in `program`. The components are 0 for the force x, 1 for the force y and 2 for torque/L.
pub fn least_grip_limit(program: &Program, grip: usize, component: usize) -> ExtremeValue {
    // Remove the limit of the component, and give each unit of it a cost of 1. The optimum then has the least amount of
    // this component, added up over its positive and its negative direction.
    let mut free = program.clone();
    free.grips[grip].limits[component] = f64::INFINITY;
    let cost = |column: &Column| match column.force {
        Force::Grip { grip: g, component: c, .. } if (g, c) == (grip, component) => 1.0,
        _ => 0.0,
    };
    extreme_cost(&free, &cost, false)
}

/// Finds the force of `grip` with the largest component along `direction`, a unit vector.
///
/// The program is max d·F s.t. Σ amount·column = loads, where F is the force of the grip and d the direction. The dual
/// is kinematic: max loadsᵀy s.t. columnᵀy ≤ 0, and in the motion −y the grip point has the velocity d. The motion −y is
/// the mechanism by which the structure fails under a larger force. Plain conditioning is tried first, because it is
/// faster. If `is_retry` is true, the result of an earlier call could not be proved; only full conditioning is then
/// tried.
pub fn support(program: &Program, grip: usize, direction: Vector, is_retry: bool) -> ExtremeValue {
    extreme_cost(program, &farthest_cost(grip, direction), !is_retry)
}

/// Finds the forces of least cost. The extreme value is the size of the cost.
fn extreme_cost(program: &Program, cost: &dyn Fn(&Column) -> f64, plain_first: bool) -> ExtremeValue {
    let scaled = ScaledProgram::new(program);
    let mut solved = scaled.solve(&Aim::Least(cost), attempts(plain_first, false), &mut Effort::default());
    let spent = scaled.columns.iter().zip(&solved.amounts).map(|(column, amount)| cost(column) * amount);
    let at = f64::abs(spent.sum::<f64>()) * scaled.load;
    if solved.status == Status::Solved {
        solved.amounts = rebalanced(&scaled.loads, &scaled.columns, solved.amounts);
    }
    ExtremeValue::new(&scaled, solved, at)
}

/// The optimum of the program of the largest load factor.
#[derive(Clone, Debug)]
pub struct LimitState {
    /// The largest factor.
    pub factor: f64,
    /// The columns of the program without the redundant pure normal forces (see `ReducedColumns`). Limits and amounts
    /// are in program units.
    pub columns: Vec<Column>,
    /// The amount of each column at the limit, in program units, at least 0.
    pub amounts: Vec<f64>,
    /// The collapse mechanism: three velocities for each block. Along it, the additional load of a factor of 1 has
    /// power 1.
    pub motion: Vec<f64>,
}

/// Finds the largest λ ≥ 0 for which admissible forces balance `program.loads + λ·direction`, and the forces and the
/// mechanism at this λ. To find out whether they are unique, the amount of every single column is needed; it is not
/// added up to the forces of contacts and grips.
///
/// `None` if λ has no largest value, if no λ ≥ 0 allows a balance, or if the solver ends without a result.
pub fn limit_state(program: &Program, direction: &[f64]) -> Option<LimitState> {
    let (scaled, solved) = solve_along(program, direction, Factor::Largest, false)?;
    if solved.status != Status::Solved {
        return None;
    }
    let motion = solved.motion();
    let power: f64 = direction.iter().zip(&solved.y).map(|(load, v)| load * v).sum();
    Some(LimitState {
        factor: solved.factor,
        amounts: solved.amounts.iter().map(|amount| amount * scaled.load).collect(),
        columns: scaled.into_columns(),
        motion: motion.iter().map(|v| v / power).collect(),
    })
}

/// Returns the cost function of the program that finds the force of a grip with the largest component along a
/// direction. For the force components of this grip, the cost is minus the component along the direction; for all other
/// columns it is 0.
pub(super) fn farthest_cost(grip: usize, direction: Vector) -> impl Fn(&Column) -> f64 {
    move |column| match column.force {
        Force::Grip { grip: column_grip, component, sign } if column_grip == grip && component < 2 => {
            -sign * direction[component]
        }
        _ => 0.0,
    }
}
