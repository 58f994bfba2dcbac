//! Removes a solver's error from a motion. In the corrected motion, every contact opens or stays closed, up to rounding
//! errors. If violations remain, the proof subtracts the power that contacts can absorb because of them.
//!
//! A motion from an interior-point method violates contacts by about a billionth of its speed. Contact forces of a
//! billion times the loads could then resist it. The method is iterative refinement: each round scales the violations
//! to size 1 and finds the shortest change that removes them, by a quadratic program. Each round adds about nine
//! correct digits. If nothing is wedged, all contacts can open at once, and the change opens each by [`EXTRA_OPENING`],
//! so that rounding closes none. Otherwise, contacts that cannot open stay closed up to rounding errors. Reference:
//! Higham, Accuracy and Stability of Numerical Algorithms, 2002, chapter 12 (iterative refinement).

use super::optimum::solve_in_turn;
use super::{Conditioning, Effort, SolverSettings, Status, TOLERANCE};
use crate::mechanics::program::{Column, Force, Program, columns, least_change};
use crate::mechanics::proof::NON_BINDING_RATIO;

/// The speed at which every contact is made to open, relative to the largest velocity (about 1).
///
/// It is several thousand times the rounding of a velocity. If it were ten times smaller, rounding would matter in long
/// chains; if it were ten times larger, the power of the loads would change in digits that are shown.
const EXTRA_OPENING: f64 = 1e-12;

/// A round constrains the contacts that open by less than this multiple of the worst violation. The others cannot
/// close.
const NEARLY_CLOSED: f64 = 1e3;

/// If not all contacts can open, a round may leave this fraction of the worst violation. Without this tolerance, the
/// program of the round would have no interior.
const MAX_REMAINING_SHARE: f64 = 1e-4;

/// The solver's tolerance for a change, as a fraction of the violation that may remain.
///
/// Most motions violate contacts only by rounding. A coarse tolerance then halves the number of iterations.
const TOLERANCE_SHARE: f64 = 1e-2;

/// The coarsest tolerance with which a change is solved.
const MAX_TOLERANCE: f64 = 1e-3;

/// Violations up to this count as rounding errors of velocities.
const ROUNDING_TOL: f64 = 16.0 * f64::EPSILON;

/// The largest number of rounds.
const MAX_ROUNDS: usize = 5;

/// Returns a motion near a given motion that no contact resists, and in which robots with very large limits do not
/// move. `None` if no such motion is found.
///
/// The largest velocity of the given motion must be about 1. Some motions are impossible without violations, such as
/// the motion of a flat wedge into its notch. The loads then have almost no power along the corrected motion.
pub fn repair_motion(program: &Program, motion: &[f64], effort: &mut Effort) -> Option<Vec<f64>> {
    let firm = NON_BINDING_RATIO * program.loads.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let (mut held, mut contacts) = (Vec::new(), Vec::new());
    for column in columns(program) {
        match column.force {
            // A component of a grip has two columns, one for each sign. One of them is enough for an equality.
            Force::Grip { sign, .. } if column.limit > firm && sign > 0.0 => held.push(column),
            Force::Grip { .. } => {}
            _ => contacts.push(column),
        }
    }
    [EXTRA_OPENING, 0.0].into_iter().find_map(|extra| open_contacts(motion, &held, &contacts, extra, effort))
}

/// Changes a motion until every contact opens at a speed of about `extra` or more (at least half of it), and the grip
/// components in `held` do not move. With `extra` = 0, small violations may remain. `None` if no such motion is found.
fn open_contacts(
    motion: &[f64],
    held: &[Column],
    contacts: &[Column],
    extra: f64,
    effort: &mut Effort,
) -> Option<Vec<f64>> {
    let mut motion = motion.to_vec();
    let tolerance = if extra == 0.0 { ROUNDING_TOL } else { 0.5 * extra };
    for round in 0..=MAX_ROUNDS {
        // Convergence test: stop if the worst violation is small.
        let torn = held.iter().map(|c| c.dot(&motion).abs());
        let closing = contacts.iter().map(|c| extra - c.dot(&motion));
        let worst = torn.chain(closing).fold(0.0, f64::max);
        if worst <= tolerance {
            return Some(motion);
        }
        if round == MAX_ROUNDS {
            break;
        }
        // If contacts cannot open, the quadratic program has interior points only if each round may leave a small part
        // of the violation.
        let left = match extra {
            0.0 => MAX_REMAINING_SHARE.max(ROUNDING_TOL / worst),
            _ => 0.0,
        };
        let mut rows: Vec<(&Column, f64)> = held.iter().map(|c| (c, -c.dot(&motion) / worst)).collect();
        for column in contacts {
            // Only contacts that are nearly closed are constrained.
            let wanted = (extra - column.dot(&motion)) / worst - left;
            if wanted > -NEARLY_CLOSED {
                rows.push((column, wanted));
            }
        }
        // Find the shortest change that removes the scaled violations, and add it to the motion.
        let conic = least_change(motion.len(), &rows, held.len());
        let settings = SolverSettings {
            tolerance: (TOLERANCE_SHARE * tolerance / worst).clamp(TOLERANCE, MAX_TOLERANCE),
            ..Conditioning::Plain.into()
        };
        let answer = solve_in_turn(&conic, settings.with_retry(), effort);
        if answer.status != Status::Solved {
            return (extra == 0.0 && round > 0).then_some(motion);
        }
        for (v, d) in motion.iter_mut().zip(&answer.x) {
            *v += worst * d;
        }
    }
    // A violation above the tolerance may remain, because columns whose length is far from 1 have larger rounding
    // errors. The proof checks it.
    (extra == 0.0).then_some(motion)
}
