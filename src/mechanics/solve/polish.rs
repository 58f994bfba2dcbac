//! A motion freed from the solver's error: every contact opens or stays as it is, to the last bit or by a hair.
//!
//! A motion from an interior-point method violates contacts by a billionth of its speed, and forces of a billion loads
//! could use that. So the violations are scaled up to size 1 and the shortest change that undoes them is sought, which
//! gains the solver's nine digits once more. Where nothing is wedged every contact can open at once, and the change asks
//! for a little of that: then no rounding is left to doubt. Where something is, contacts that cannot open stay closed to
//! rounding.

use super::{Conditioning, Effort, SolverSettings, Status, TOLERANCE, solved_with_retry};
use crate::program::{Column, Force, Program, columns, least_change};

/// How far contacts are opened, in parts of the fastest speed: beyond the rounding of a speed, and far below what matters.
const HAIR: f64 = 1e-12;

/// Contacts are looked after that are less open than so many violations.
const NEAR: f64 = 1e3;

/// Where contacts cannot open a change may leave so much of a violation to the next.
const LEFT: f64 = 1e-4;

/// A change is sought to so small a part of what it may leave, but no coarser than this: mostly the motion that comes in
/// violates nothing but by rounding, and half the iterations do.
const ENOUGH: f64 = 1e-2;
const COARSEST: f64 = 1e-3;

/// Violations that are the rounding of speeds.
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// Rounds of changes, each for what the last one left or closed.
const ROUNDS: usize = 5;

/// A grip whose limit is so many times the heaviest load holds as if it had none.
const NON_BINDING: f64 = 1e4;

/// The motion near a given one, of fastest speed about 1, that no contact can object to, if one is found.
///
/// A motion that needs its violations, such as that of a flat wedge into its notch, loses its power by the change.
pub fn polished(program: &Program, motion: &[f64], effort: &mut Effort) -> Option<Vec<f64>> {
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
    [HAIR, 0.0]
        .into_iter()
        .find_map(|hair| changed(motion, &held, &contacts, hair, effort))
}

/// The motion changed so that the contacts open by a hair, if they can, and what is held does not move.
fn changed(
    motion: &[f64],
    held: &[Column],
    contacts: &[Column],
    hair: f64,
    effort: &mut Effort,
) -> Option<Vec<f64>> {
    let mut motion = motion.to_vec();
    let small = if hair == 0.0 { ROUNDED } else { 0.5 * hair };
    for round in 0..=ROUNDS {
        let torn = held.iter().map(|c| c.dot(&motion).abs());
        let closing = contacts.iter().map(|c| hair - c.dot(&motion));
        let worst = torn.chain(closing).fold(0.0, f64::max);
        if worst <= small {
            return Some(motion);
        }
        if round == ROUNDS {
            break;
        }
        // What cannot open leaves the program no room inside, unless each change may leave a little for the next, and
        // the rounding of the speeds at that.
        let left = match hair {
            0.0 => LEFT.max(ROUNDED / worst),
            _ => 0.0,
        };
        let mut rows: Vec<(&Column, f64)> =
            held.iter().map(|c| (c, -c.dot(&motion) / worst)).collect();
        for column in contacts {
            let wanted = (hair - column.dot(&motion)) / worst - left;
            if wanted > -NEAR {
                rows.push((column, wanted));
            }
        }
        let conic = least_change(motion.len(), &rows, held.len());
        let settings = SolverSettings {
            tolerance: (ENOUGH * small / worst).clamp(TOLERANCE, COARSEST),
            ..Conditioning::Plain.into()
        };
        let answer = solved_with_retry(&conic, settings, effort);
        if answer.status != Status::Solved {
            return (hair == 0.0 && round > 0).then_some(motion);
        }
        for (v, d) in motion.iter_mut().zip(&answer.x) {
            *v += worst * d;
        }
    }
    // Columns far from unit length are rounded more than others; the proof measures what is left.
    (hair == 0.0).then_some(motion)
}
