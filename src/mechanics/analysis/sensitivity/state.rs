//! [`EndState`]: computes the forces and the mechanism of a component at its limit of stability, and whether they are
//! unique.
//!
//! In the mechanism at the end, the two bodies of a contact either are held together or move relative to each other.
//! Bodies that are held together are one *group*. Only the contacts between groups matter. In the other contacts the
//! mechanism does no work, so their forces, which are often not unique, do not change a derivative.
//!
//! 1. One linear program gives forces and mechanism to nine digits ([`Case::solved`]). Unknowns with force are *basic*.
//! 2. [`Reduced`] has three equations for each group, and one unknown for each force between groups.
//! 3. Elimination solves for the motions of the groups. Newton's method solves for the forces and the value, up to
//!    rounding.
//! 4. The null spaces show whether forces and motions are unique. If they are not, some other forces and motions show
//!    which derivatives are: those that stay the same.

use super::case::Case;
use super::elimination::{Elimination, ROUNDING_TOL, ZERO_TOL};
use super::reduced::{Reduced, State, Unknown};
use crate::mechanics::statics::assembly::Assembly;

/// The derivatives are not computed for more groups than this: the time grows with the cube of their number.
const MAX_GROUPS: usize = 150;

/// How many further states tell whether a derivative is unique, if forces or mechanism are not.
const OTHER_STATES: u32 = 2;

/// The largest number of Newton steps for the forces and the value.
const MAX_NEWTON_STEPS: usize = 12;

/// The states at one end of the interval of a component.
pub(super) struct EndState {
    /// The component with the value of the parameter at the end.
    pub changed: Assembly,
    /// The value of the parameter there.
    pub value: f64,
    /// One state. If it is not unique, some others follow, with which a derivative differs if it is not unique.
    pub states: Vec<State>,
}

impl EndState {
    /// Computes forces and mechanism at an end of an interval. `None` if the equations are not solved accurately, if
    /// the result is not admissible, or if there are too many groups.
    pub fn new(case: &Case) -> Option<EndState> {
        let (program, solved) = case.solved(&case.at(case.value))?;
        let mut reduced = Reduced::new(case, &program, &solved);
        if reduced.groups == 0 || reduced.groups > MAX_GROUPS {
            return None;
        }
        let mut value = case.value;
        let amounts = balanced(case, &reduced, &mut value)?;
        let changed = case.at(value);
        let motions = Motions::new(case, &reduced, &changed, value)?;
        if reduced.has_idle_limit(&changed, ZERO_TOL * largest(&motions.first), &motions.first) {
            return None;
        }
        // A force that is 0, and along which the mechanism does no work, may differ from 0 in another equilibrium. It
        // also counts as basic.
        let speed = largest(&motions.first);
        let is_idle = |unknown: &Unknown| {
            let power = reduced.power(&changed, unknown, &motions.first);
            !unknown.is_basic && power.abs() <= ZERO_TOL * speed
        };
        let idle: Vec<bool> = reduced.unknowns.iter().map(is_idle).collect();
        for (unknown, is_idle) in reduced.unknowns.iter_mut().zip(&idle) {
            unknown.is_basic |= *is_idle;
        }
        let is_resisted = |unknown: &Unknown| {
            let power = reduced.power(&changed, unknown, &motions.first);
            unknown.is_basic || power >= 0.0
        };
        let force = largest(&amounts);
        let is_pulled = |(unknown, amount): (&Unknown, &f64)| !unknown.is_both_ways && *amount < -ZERO_TOL * force;
        if !reduced.unknowns.iter().all(is_resisted) || reduced.unknowns.iter().zip(&amounts).any(is_pulled) {
            return None;
        }
        let balances = null_balances(case, &reduced, &changed, &amounts, value)?;
        let state = |turn: u32| {
            let motion = moved(&motions.first, &motions.null_space, turn);
            reduced.state(case, &changed, &motion, &moved(&amounts, &balances, turn), value)
        };
        let is_unique = motions.null_space.is_empty() && balances.is_empty();
        let others = if is_unique { 0 } else { OTHER_STATES };
        let states = (0..=others).map(state).collect();
        Some(EndState { states, changed, value })
    }
}

/// Adds to a motion or to forces a multiple of each direction in which they may differ; nothing in turn 0.
///
/// The multiples have no pattern: a derivative is linear in the motion and in the forces, so a derivative that differs in
/// any of these directions differs here.
fn moved(first: &[f64], directions: &[Vec<f64>], turn: u32) -> Vec<f64> {
    let mut moved = first.to_vec();
    for (number, by) in directions.iter().enumerate().filter(|_| turn > 0) {
        let multiple = 0.5 + ((number + 1) as f64 * f64::from(turn) * GOLDEN_RATIO).fract();
        let share = multiple * largest(first) / largest(by);
        moved.iter_mut().zip(by).for_each(|(v, by)| *v += share * by);
    }
    moved
}

/// The golden ratio. The fractions of its multiples have no pattern.
const GOLDEN_RATIO: f64 = 1.618_033_988_749_895;

/// Solves by Newton's method for the forces between groups and for the value of the parameter at which they balance the
/// loads. Starts from the forces of the linear program; forces that are not basic stay 0. `None` if the method does not
/// converge.
fn balanced(case: &Case, reduced: &Reduced, value: &mut f64) -> Option<Vec<f64>> {
    let basic: Vec<usize> = reduced.basic().collect();
    let mut amounts: Vec<f64> = reduced.unknowns.iter().map(|u| u.amount).collect();
    for (amount, unknown) in amounts.iter_mut().zip(&reduced.unknowns) {
        if !unknown.is_basic {
            *amount = 0.0;
        }
    }
    for _ in 0..MAX_NEWTON_STEPS {
        let changed = case.at(*value);
        let residual = reduced.residual(&changed, &amounts);
        if largest(&residual) <= 1e-3 * ROUNDING_TOL * reduced.load {
            return Some(amounts);
        }
        let growth = reduced.growth(case, &changed, &amounts, *value);
        let unit = reduced.load / largest(&growth);
        if !unit.is_finite() {
            return None;
        }
        let mut rows = reduced.rows(&changed, &basic);
        for (row, growth) in rows.iter_mut().zip(&growth) {
            row.push(growth * unit);
        }
        let side = residual.iter().map(|v| -v).collect();
        let solved = Elimination::new(&rows, basic.len() + 1, &[side]);
        let (step, _) = &solved.solutions[0];
        for (k, place) in basic.iter().enumerate() {
            amounts[*place] += step[k];
        }
        *value += step[basic.len()] * unit;
    }
    let residual = reduced.residual(&case.at(*value), &amounts);
    (largest(&residual) <= ROUNDING_TOL * reduced.load).then_some(amounts)
}

/// Returns a basis of the changes of the forces that keep the balance while the parameter keeps its value. `None` if
/// some change of the forces keeps the balance only at another value.
fn null_balances(
    case: &Case,
    reduced: &Reduced,
    changed: &Assembly,
    amounts: &[f64],
    value: f64,
) -> Option<Vec<Vec<f64>>> {
    let basic: Vec<usize> = reduced.basic().collect();
    let growth = reduced.growth(case, changed, amounts, value);
    let unit = reduced.load / largest(&growth);
    let mut rows = reduced.rows(changed, &basic);
    for (row, growth) in rows.iter_mut().zip(&growth) {
        row.push(growth * unit);
    }
    let found = Elimination::new(&rows, basic.len() + 1, &[]);
    let whole = |vector: Vec<f64>| {
        let mut whole = vec![0.0; amounts.len()];
        for (k, place) in basic.iter().enumerate() {
            whole[*place] = vector[k];
        }
        let is_at_value = vector[basic.len()].abs() <= ROUNDING_TOL * largest(&vector);
        is_at_value.then_some(whole)
    };
    found.null_space.into_iter().map(whole).collect()
}

/// The motions of the groups: one motion, and a basis of the motions that may be added to it.
struct Motions {
    first: Vec<f64>,
    null_space: Vec<Vec<f64>>,
}

impl Motions {
    /// Corrects the motion of the linear program, such that basic forces do no work and the loads that push outward
    /// have the power 1. `None` if no such motion exists.
    fn new(case: &Case, reduced: &Reduced, changed: &Assembly, value: f64) -> Option<Motions> {
        let basic: Vec<usize> = reduced.basic().collect();
        let columns = reduced.rows(changed, &basic);
        let push = reduced.grouped(changed, &case.push(value));
        let unit = largest(&push);
        // There is one equation for each basic force, and one equation for the power.
        let mut rows: Vec<Vec<f64>> = (0..basic.len()).map(|k| columns.iter().map(|row| row[k]).collect()).collect();
        rows.push(push.iter().map(|v| v / unit).collect());
        let given = &reduced.motion;
        let power: f64 = push.iter().zip(given).map(|(p, v)| p / unit * v).sum();
        if power.is_nan() || power <= 0.0 {
            return None;
        }
        let start: Vec<f64> = given.iter().map(|v| v / power).collect();
        let work = |row: &Vec<f64>| row.iter().zip(&start).map(|(a, v)| a * v).sum::<f64>();
        let mut side: Vec<f64> = rows.iter().map(|row| -work(row)).collect();
        if let Some(last) = side.last_mut() {
            *last += 1.0;
        }
        let solved = Elimination::new(&rows, given.len(), &[side]);
        let (change, error) = &solved.solutions[0];
        let first: Vec<f64> = start.iter().zip(change).map(|(a, b)| a + b).collect();
        (*error <= ROUNDING_TOL * largest(&first)).then_some(Motions { first, null_space: solved.null_space })
    }
}

/// Returns the largest absolute value of a list; 0 for an empty list.
fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}
