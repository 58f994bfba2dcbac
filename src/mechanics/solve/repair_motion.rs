//! Removes a solver's error from a motion: afterwards every contact opens a little, or stays closed to rounding.
//!
//! A motion from an interior-point method violates contacts by a billionth of its speed, and forces of a billion loads could
//! use that. Iterative refinement: each round scales the violations to size 1 and finds the shortest change that removes
//! them, a quadratic program, which gains the solver's nine digits. If nothing is wedged, all contacts can open at once, and the
//! change opens each by [`EXTRA_OPENING`]: then rounding closes none. Otherwise contacts that cannot open stay closed to
//! rounding.

use super::{Conditioning, Effort, SolverSettings, Status, TOLERANCE, solved_with_retry};
use crate::program::{Column, Force, Program, columns, least_change};

/// How far contacts are opened, relative to the fastest speed of about 1: a thousand times its rounding, and far below what matters.
/// At a tenth rounding would count in long chains; ten times larger, the loads' power would change in digits that are shown.
const EXTRA_OPENING: f64 = 1e-12;

/// Contacts that are less open than this multiple of the worst violation are kept from closing in the round.
const NEARLY_CLOSED: f64 = 1e3;

/// If contacts cannot open, a round may leave this fraction of a violation to the next: the program then has an interior.
const LEFT_TO_NEXT_ROUND: f64 = 1e-4;

/// A change is solved to this fraction of what it may leave, at most to [`MAX_TOLERANCE`]. Most motions violate contacts by
/// rounding only, and half the iterations do.
const TOLERANCE_SHARE: f64 = 1e-2;
const MAX_TOLERANCE: f64 = 1e-3;

/// Violations up to this are the rounding of speeds.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Rounds of changes.
const MAX_ROUNDS: usize = 5;

/// A grip whose limit exceeds this multiple of the heaviest load holds as if it had no limit.
const NON_BINDING: f64 = 1e4;

/// Returns a motion near a given one that no contact opposes; `None` if there is none. The fastest speed is to be about 1.
///
/// A motion that needs its violations, such as that of a flat wedge into its notch, loses its power by the change.
pub fn repair_motion(program: &Program, motion: &[f64], effort: &mut Effort) -> Option<Vec<f64>> {
    let firm = NON_BINDING * program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let (mut held, mut contacts) = (Vec::new(), Vec::new());
    for column in columns(program) {
        match column.force {
            // Of a component's two signs one is enough to hold it.
            Force::Grip { sign, .. } if column.limit > firm && sign > 0.0 => held.push(column),
            Force::Grip { .. } => {}
            _ => contacts.push(column),
        }
    }
    [EXTRA_OPENING, 0.0]
        .into_iter()
        .find_map(|extra| open_contacts(motion, &held, &contacts, extra, effort))
}

/// The motion, changed until the contacts open by `extra`, and what is held does not move.
fn open_contacts(
    motion: &[f64],
    held: &[Column],
    contacts: &[Column],
    extra: f64,
    effort: &mut Effort,
) -> Option<Vec<f64>> {
    let mut motion = motion.to_vec();
    let small = if extra == 0.0 { ROUNDING } else { 0.5 * extra };
    for round in 0..=MAX_ROUNDS {
        // Convergence test: the worst violation.
        let torn = held.iter().map(|c| c.dot(&motion).abs());
        let closing = contacts.iter().map(|c| extra - c.dot(&motion));
        let worst = torn.chain(closing).fold(0.0, f64::max);
        if worst <= small {
            return Some(motion);
        }
        if round == MAX_ROUNDS {
            break;
        }
        // If contacts cannot open, the program has no interior, unless a round may leave a little to the next, and the
        // rounding of the speeds.
        let left = match extra {
            0.0 => LEFT_TO_NEXT_ROUND.max(ROUNDING / worst),
            _ => 0.0,
        };
        let mut rows: Vec<(&Column, f64)> =
            held.iter().map(|c| (c, -c.dot(&motion) / worst)).collect();
        for column in contacts {
            let wanted = (extra - column.dot(&motion)) / worst - left;
            if wanted > -NEARLY_CLOSED {
                rows.push((column, wanted));
            }
        }
        // The shortest change, scaled, and added.
        let conic = least_change(motion.len(), &rows, held.len());
        let settings = SolverSettings {
            tolerance: (TOLERANCE_SHARE * small / worst).clamp(TOLERANCE, MAX_TOLERANCE),
            ..Conditioning::Plain.into()
        };
        let answer = solved_with_retry(&conic, settings, effort);
        if answer.status != Status::Solved {
            return (extra == 0.0 && round > 0).then_some(motion);
        }
        for (v, d) in motion.iter_mut().zip(&answer.x) {
            *v += worst * d;
        }
    }
    // Columns far from unit length have more rounding than others; the proof measures what is left.
    (extra == 0.0).then_some(motion)
}
