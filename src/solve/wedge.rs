//! Whether a balance is reached from rest, or only by a self-stress that nothing built up.
//!
//! Every application point gets a unilateral spring and every interface a spring along itself, all unstressed before the
//! loads act. Friction is Coulomb's, by Tresca's fixed point: at given largest friction forces τ the springs' forces are
//! a convex quadratic program (least complementary energy), and τ becomes μ(N1 + N2) of its answer. The springs' size
//! divides out: it scales displacements, which never enter, and not forces.
//!
//! Beyond τ a spring `HARDENING` times as stiff goes on holding, so that each step has an answer. Where friction comes
//! with the loads, the excess it carries vanishes with its stiffness; where a block hangs on friction between faces that
//! nothing presses together, it carries that block however soft it is. That tells the two apart.

use super::{Care, Effort, Status, careful};
use crate::program::{Program, Scale, elastic};

/// How a balance comes about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// The loads build it up themselves.
    FromRest,
    /// Only a self-stress from elsewhere makes it.
    OnlyWedged,
    /// The fixed point was not found.
    Unclear,
}

/// The stiffness beyond the largest friction force, in parts of the springs'.
const HARDENING: [f64; 2] = [1e-2, 1e-4];

/// Excess that keeps this share of itself while the hardening falls a hundredfold does not vanish.
const LASTING: f64 = 0.3;

/// Steps of the fixed point.
const STEPS: usize = 300;

/// The first share of the way that a step goes. Between steep faces more friction takes away the pressure that allows
/// it, many times over; a share that overshoots is cut.
const FIRST_SHARE: f64 = 0.5;

/// Friction is never cut below this share of the heaviest load, so that the programs keep an interior.
const LEAST: f64 = 1e-7;

/// Whether the forces that balance a standing program build up from rest.
pub fn reach(program: &Program) -> Reach {
    let Some(stiff) = settled(program, HARDENING[0]) else {
        return Reach::Unclear;
    };
    let Some(soft) = settled(program, HARDENING[1]) else {
        return Reach::Unclear;
    };
    // What acts on a block apart from contacts: its load, and what a robot gives it.
    let own = |block: usize| {
        let rows = &program.need[3 * block..3 * block + 3];
        rows.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
    };
    let hangs = program.contacts.iter().enumerate().any(|(k, contact)| {
        let load = contact
            .from
            .as_ref()
            .map_or(own(contact.on.0), |from| own(contact.on.0).min(own(from.0)));
        let (before, after) = (stiff[k], soft[k]);
        after > LASTING * before && after > 1e-3 * load.max(1e-9 * Scale::HEAVIEST)
    });
    if hangs {
        Reach::OnlyWedged
    } else {
        Reach::FromRest
    }
}

/// What friction carries beyond its largest force, per contact, at the fixed point.
fn settled(program: &Program, hardening: f64) -> Option<Vec<f64>> {
    let heaviest = Scale::HEAVIEST;
    let mut effort = Effort::default();
    // First as if friction had no end: springs that only press and hold.
    let mut most = vec![1e3 * heaviest * (1.0 + program.blocks as f64); program.contacts.len()];
    let (mut share, mut before) = (FIRST_SHARE, f64::INFINITY);
    for step in 0..STEPS {
        let answer = careful(&elastic(program, &most, hardening), Care::Full, &mut effort);
        if answer.status != Status::Solved {
            return None;
        }
        let mut off: f64 = 0.0;
        let mut next = Vec::with_capacity(most.len());
        for (k, contact) in program.contacts.iter().enumerate() {
            let of = &answer.x[4 * k..4 * k + 4];
            let allowed =
                (contact.friction * (of[0].max(0.0) + of[1].max(0.0))).max(LEAST * heaviest);
            // A bound above what is used does nothing, wherever it is.
            if (of[2] + of[3] * hardening.sqrt()).abs() > allowed.min(most[k]) * (1.0 - 1e-6) {
                off = off.max((allowed - most[k]).abs());
            }
            next.push(if step == 0 {
                allowed
            } else {
                most[k] + share * (allowed - most[k])
            });
        }
        if off <= 1e-4 * heaviest {
            let excess =
                (0..program.contacts.len()).map(|k| answer.x[4 * k + 3].abs() * hardening.sqrt());
            return Some(excess.collect());
        }
        if step > 1 && off > 0.9 * before {
            share *= 0.7;
        }
        (most, before) = (next, off);
    }
    None
}
