//! Limit analysis: computes the largest load factor, the load factor nearest to 0, the least limit of a robot's force or
//! torque with which the loads can be balanced, or the largest force of a grip without limits in a direction. Each value
//! is the optimum of one linear program.
//!
//! The static theorem: the largest load factor is max λ s.t. Σ amount·column = loads + λ·direction. Its dual is the
//! kinematic theorem. Compared with the dual of the program of least force, the dual has one more row, directionᵀy ≥ 1,
//! and λ is the multiplier of this row. The velocities are the collapse mechanism at the limit. The least sufficient
//! limit of a robot's component is the least amount of this component, if no other force has a cost. Reference:
//! [Livesley78](crate::doc::references).

use super::dual::{ReducedColumns, ScaledProgram, amounts_of_rows};
use super::{
    Amounts, Answer, Conditioning, Effort, Face, Status, TOLERANCE, balance_by_least_change, dual, largest, solve,
};
use crate::geometry::Vector;
use crate::mechanics::program::{
    Column, Force, Program, QuadraticProgram, columns, kinematic_dual, load_factor_dual, nearest_factor_dual,
};

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
    factor_along(program, direction, Extremum::Largest, attempts(program))
}

/// Like [`largest_factor`], but tries the faster plain conditioning first, whatever the number of blocks.
pub fn largest_factor_fast(program: &Program, direction: &[f64]) -> ExtremeValue {
    let plain = [(TOLERANCE, Conditioning::Plain)].into_iter();
    factor_along(program, direction, Extremum::Largest, plain.chain(attempts(program)))
}

/// Finds the λ nearest to 0, positive or negative, for which admissible forces balance `program.loads + λ·direction`.
///
/// [`Limit::Infeasible`] means that no λ allows a balance. If some λ allows a balance, there is a λ nearest to 0.
pub fn nearest_factor(program: &Program, direction: &[f64]) -> ExtremeValue {
    factor_along(program, direction, Extremum::Nearest, attempts(program))
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
fn factor_along(
    program: &Program,
    direction: &[f64],
    extremum: Extremum,
    attempts: impl Iterator<Item = (f64, Conditioning)>,
) -> ExtremeValue {
    let Some(line) = ScaledLine::new(program, direction) else {
        return Limit::Unbounded.into();
    };
    let scaled = &line.scaled;
    let (mut problem, row_of) = match extremum {
        Extremum::Largest => load_factor_dual(&scaled.loads, &line.direction, &scaled.columns),
        Extremum::Nearest => nearest_factor_dual(&scaled.loads, &line.direction, &scaled.columns),
    };
    if program.has_many_blocks() {
        let work_rows = problem.bound.iter_mut().rev().take(extremum.rows());
        work_rows.for_each(|b| *b *= WORK_OF_MANY_BLOCKS);
    }
    let answer = solve_in_turn(&problem, attempts);
    match (answer.status, extremum.factor(&answer.z)) {
        (Status::Solved, Some(factor)) => ExtremeValue {
            limit: Limit::At(line.factor(factor)),
            forces: Some(scaled.forces(line.amounts(factor, &answer, &row_of))),
            motion: Some(scaled.motion(&answer)),
        },
        (Status::Infeasible, _) => Limit::Unbounded.into(),
        // No λ allows a balance (for the largest λ: no λ ≥ 0). Along this motion, the loads do positive work for
        // each of these λ.
        (Status::Unbounded, _) => ExtremeValue { motion: Some(scaled.motion(&answer)), ..Limit::Infeasible.into() },
        _ => Limit::Unsolved.into(),
    }
}

/// A scaled program, and the direction in which its loads grow, also scaled to a largest entry of 1.
struct ScaledLine<'p> {
    scaled: ScaledProgram<'p>,
    direction: Vec<f64>,
    /// The largest entry of the direction before scaling.
    size: f64,
}

impl<'p> ScaledLine<'p> {
    /// Scales a program and a direction; `None` if the direction is zero.
    fn new(program: &'p Program, direction: &[f64]) -> Option<ScaledLine<'p>> {
        let size = largest(direction);
        (size != 0.0).then(|| ScaledLine {
            scaled: ScaledProgram::new(program),
            direction: direction.iter().map(|v| v / size).collect(),
            size,
        })
    }

    /// Converts a factor of the scaled direction to the factor of the original direction.
    fn factor(&self, scaled: f64) -> f64 {
        scaled * self.scaled.load / self.size
    }

    /// Returns the amount of each column under the scaled loads plus `factor` times the scaled direction. The solver's
    /// residual is removed first.
    fn amounts(&self, factor: f64, answer: &Answer, row_of: &[usize]) -> Vec<f64> {
        let pairs = self.scaled.loads.iter().zip(&self.direction);
        let total: Vec<f64> = pairs.map(|(load, along)| load + factor * along).collect();
        rebalanced(&total, &self.scaled.columns, amounts_of_rows(answer, row_of))
    }
}

/// Solves a program with one tolerance and conditioning after the other, until the solver ends with a result.
fn solve_in_turn(problem: &QuadraticProgram, attempts: impl Iterator<Item = (f64, Conditioning)>) -> Answer {
    let mut answer = Answer::without_status(problem);
    for (tolerance, conditioning) in attempts {
        answer = solve(problem, tolerance, conditioning);
        if answer.status != Status::Unsolved {
            break;
        }
    }
    answer
}

/// Returns the tolerances and conditionings in the order in which they are tried. For many blocks, the faster plain
/// conditioning is tried first. The finest tolerance is then not tried: with it, a wall of 410 bricks ends without a
/// result.
fn attempts(program: &Program) -> impl Iterator<Item = (f64, Conditioning)> {
    let is_coarse = program.has_many_blocks();
    let plain = is_coarse.then_some((TOLERANCES[1], Conditioning::Plain));
    plain.into_iter().chain(full_attempts().skip(usize::from(is_coarse)))
}

/// Returns all tolerances with full conditioning, in the order in which they are tried.
fn full_attempts() -> impl Iterator<Item = (f64, Conditioning)> {
    TOLERANCES.into_iter().map(|tolerance| (tolerance, Conditioning::Full))
}

/// Returns the amounts after the least change that removes the solver's residual.
pub(super) fn rebalanced(loads: &[f64], columns: &[Column], amounts: Vec<f64>) -> Vec<f64> {
    let settings = Conditioning::Plain.into();
    balance_by_least_change(loads, columns, amounts, settings, &mut Effort::default())
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

/// The optimum of the program of the largest load factor.
#[derive(Clone, Debug)]
pub struct LimitState {
    /// The largest factor.
    pub factor: f64,
    /// The columns of the program without the redundant pure normal forces (see `ReducedColumns`).
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
    let line = ScaledLine::new(program, direction)?;
    let scaled = &line.scaled;
    let (problem, row_of) = load_factor_dual(&scaled.loads, &line.direction, &scaled.columns);
    let answer = solve_in_turn(&problem, attempts(program));
    if answer.status != Status::Solved {
        return None;
    }
    let factor = answer.z.last()?.max(0.0);
    let amounts = line.amounts(factor, &answer, &row_of);
    Some(LimitState {
        factor: line.factor(factor),
        // The limits of these columns are in program units, not scaled to the loads.
        columns: ReducedColumns::new(&columns(program)).columns,
        amounts: amounts.iter().map(|amount| amount * scaled.load).collect(),
        motion: scaled.motion(&answer).iter().map(|v| v / line.size).collect(),
    })
}

/// The largest force of a grip in a direction.
#[derive(Clone, Debug)]
pub enum Support {
    /// The largest force is finite.
    At {
        /// Forces that balance the loads, in program units. The force of the grip is the largest one in the direction.
        forces: Amounts,
        /// The mechanism: three velocities for each block, in units of the program.
        motion: Vec<f64>,
    },
    /// Forces of any size are possible.
    Unbounded,
    /// No force of the grip balances the loads.
    Infeasible,
    /// The solver ended without a result.
    Unsolved,
}

/// Finds the force of `grip` with the largest component along `direction`, a unit vector.
///
/// The program is max d·F s.t. Σ amount·column = loads, where F is the force of the grip and d the direction. The dual
/// is kinematic: max loadsᵀy s.t. columnᵀy ≤ 0, and in the motion −y the grip point has the velocity d. The motion −y is
/// the mechanism by which the structure fails under a larger force. Plain conditioning is tried first, because it is
/// faster. If `is_retry` is true, the result of an earlier call could not be proved; only full conditioning is then
/// tried.
pub fn support(program: &Program, grip: usize, direction: Vector, is_retry: bool) -> Support {
    let scaled = ScaledProgram::new(program);
    let (problem, row_of) = kinematic_dual(&scaled.loads, &scaled.columns, farthest_cost(grip, direction));
    let plain = (!is_retry).then_some((TOLERANCE, Conditioning::Plain));
    let answer = solve_in_turn(&problem, plain.into_iter().chain(full_attempts()));
    match answer.status {
        Status::Solved => {
            let amounts = rebalanced(&scaled.loads, &scaled.columns, amounts_of_rows(&answer, &row_of));
            Support::At { forces: scaled.forces(amounts), motion: scaled.motion(&answer) }
        }
        // No mechanism moves the grip point with the velocity `direction`, so nothing limits the force.
        Status::Infeasible => Support::Unbounded,
        Status::Unbounded => Support::Infeasible,
        Status::Unsolved => Support::Unsolved,
    }
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
