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
//! 4. The dimensions of the null spaces show whether forces and motions are unique. If the forces are unique but the
//!    motions are not, all extreme motions are computed. Otherwise, some other forces and motions are computed.

use super::case::Case;
use super::elimination::{Elimination, ROUNDING_TOL, ZERO_TOL};
use super::reduced::{Reduced, State, Unknown};
use crate::mechanics::statics::assembly::Assembly;

/// The derivatives are not computed for more groups than this: the time grows with the cube of their number.
const MAX_GROUPS: usize = 150;

/// If there would be more states than this, only the first is computed.
const MAX_STATES: usize = 64;

/// If there would be more combinations of conditions than this, extreme motions are not computed.
const MAX_COMBINATIONS: usize = 4000;

/// The largest number of Newton steps for the forces and the value.
const MAX_NEWTON_STEPS: usize = 12;

/// Whether forces and mechanism at the end are unique.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Forces and mechanism are unique.
    Unique,
    /// The forces are unique, the mechanism is not. The first state lies inside the set of mechanisms; the other states
    /// are all its extreme points.
    Mechanisms,
    /// The forces are not unique, or the extreme mechanisms were not found. The other states differ from the first in
    /// each independent direction of forces and mechanisms.
    Hull,
    /// The set of forces and mechanisms has too many dimensions, so the other states are not computed.
    Unknown,
}

/// The states at one end of the interval of a component.
pub(super) struct EndState {
    /// The component with the value of the parameter at the end.
    pub changed: Assembly,
    /// The value of the parameter there.
    pub value: f64,
    /// One state, and further states if it is not unique.
    pub states: Vec<State>,
    pub freedom: Freedom,
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
        let mut found = EndState {
            states: vec![reduced.state(case, &changed, &motions.first, &amounts, value)],
            freedom: Freedom::Unique,
            changed,
            value,
        };
        found.add_others(case, &reduced, &motions, &amounts, &balances);
        Some(found)
    }

    /// If forces or mechanism are not unique, adds further states, and sets `freedom` accordingly.
    fn add_others(
        &mut self,
        case: &Case,
        reduced: &Reduced,
        motions: &Motions,
        amounts: &[f64],
        balances: &[Vec<f64>],
    ) {
        let (changed, value) = (self.changed.clone(), self.value);
        let state = |motion: &[f64], amounts: &[f64]| reduced.state(case, &changed, motion, amounts, value);
        if motions.null_space.is_empty() && balances.is_empty() {
            return;
        }
        let extreme = if balances.is_empty() { extreme_motions(reduced, &changed, motions) } else { None };
        if let Some(all) = extreme {
            self.freedom = Freedom::Mechanisms;
            let states = all.iter().map(|motion| state(motion, amounts));
            self.states.extend(states);
            return;
        }
        if (1 + motions.null_space.len()) * (1 + balances.len()) > MAX_STATES {
            self.freedom = Freedom::Unknown;
            return;
        }
        // Combine every motion with every set of forces: the derivative is linear in each of them.
        self.freedom = Freedom::Hull;
        let moved = |first: &[f64], by: &[f64]| -> Vec<f64> {
            let share = largest(first) / largest(by);
            first.iter().zip(by).map(|(a, b)| a + share * b).collect()
        };
        let all_motions: Vec<Vec<f64>> = std::iter::once(motions.first.clone())
            .chain(motions.null_space.iter().map(|by| moved(&motions.first, by)))
            .collect();
        let all_amounts: Vec<Vec<f64>> =
            std::iter::once(amounts.to_vec()).chain(balances.iter().map(|by| moved(amounts, by))).collect();
        for (k, motion) in all_motions.iter().enumerate() {
            for amounts in all_amounts.iter().skip(usize::from(k == 0)) {
                self.states.push(state(motion, amounts));
            }
        }
    }
}

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

/// Returns all extreme points of the set of possible motions. `None` if the set is unbounded, if there are too many
/// combinations of conditions to test, or if too few points are found.
///
/// A motion is first + Σ share · other. A force between groups that is 0 must not do negative work. At an extreme
/// motion, as many of these conditions hold with equality as there are shares.
fn extreme_motions(reduced: &Reduced, changed: &Assembly, motions: &Motions) -> Option<Vec<Vec<f64>>> {
    let free = motions.null_space.len();
    let conditions: Vec<Condition> = (reduced.unknowns.iter())
        .filter(|unknown| !unknown.is_basic)
        .map(|unknown| {
            let power = |motion: &[f64]| reduced.power(changed, unknown, motion);
            let shares = motions.null_space.iter().map(|m| power(m) / largest(m));
            Condition { first: power(&motions.first), shares: shares.collect() }
        })
        .collect();
    let speed = largest(&motions.first);
    // True if the motion `with` · first + Σ share · other meets all conditions.
    let meets = |shares: &[f64], with: f64| {
        let tolerance = ZERO_TOL * speed.max(largest(shares));
        conditions.iter().all(|c| c.power(shares, with) >= -tolerance)
    };
    let rows = |chosen: &[usize]| -> Vec<Vec<f64>> { chosen.iter().map(|k| conditions[*k].shares.clone()).collect() };
    // If some direction satisfies all conditions, the set of motions is unbounded.
    for chosen in subsets(conditions.len(), free - 1)? {
        let found = Elimination::new(&rows(&chosen), free, &[]);
        if let [direction] = found.null_space.as_slice() {
            let opposite: Vec<f64> = direction.iter().map(|v| -v).collect();
            if meets(direction, 0.0) || meets(&opposite, 0.0) {
                return None;
            }
        }
    }
    let mut all: Vec<Vec<f64>> = Vec::new();
    for chosen in subsets(conditions.len(), free)? {
        let side = chosen.iter().map(|k| -conditions[*k].first).collect();
        let found = Elimination::new(&rows(&chosen), free, &[side]);
        let (shares, _) = &found.solutions[0];
        if found.null_space.is_empty() && meets(shares, 1.0) {
            let mut motion = motions.first.clone();
            for (share, other) in shares.iter().zip(&motions.null_space) {
                let size = largest(other);
                for (v, o) in motion.iter_mut().zip(other) {
                    *v += share * o / size;
                }
            }
            all.push(motion);
        }
    }
    // A bounded set of this dimension has more extreme points than dimensions. With fewer points, the result is
    // incomplete.
    (all.len() > free).then_some(all)
}

/// A force that must not do negative work: its power along the first motion, and its power per share of each other
/// motion.
struct Condition {
    first: f64,
    shares: Vec<f64>,
}

impl Condition {
    /// Returns the power along a combination of motions: `with` times the first motion, plus `shares` times the others.
    fn power(&self, shares: &[f64], with: f64) -> f64 {
        let change: f64 = self.shares.iter().zip(shares).map(|(a, b)| a * b).sum();
        with * self.first + change
    }
}

/// Returns all subsets of `count` numbers from 0, 1, …, `total` − 1. `None` if there are too many.
fn subsets(total: usize, count: usize) -> Option<Vec<Vec<usize>>> {
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    for _ in 0..count {
        let mut longer = Vec::new();
        for chosen in &all {
            for k in chosen.last().map_or(0, |last| last + 1)..total {
                let mut more = chosen.clone();
                more.push(k);
                longer.push(more);
            }
        }
        if longer.len() > MAX_COMBINATIONS {
            return None;
        }
        all = longer;
    }
    Some(all)
}

/// Returns the largest absolute value of a list; 0 for an empty list.
fn largest(list: &[f64]) -> f64 {
    list.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}
