//! Effects: what a frame calls for, decided one by one and contributed to its [`Assembly`].
//!
//! One file per effect, each with two functions and its source: `called_for` says whether the frame needs it, in words,
//! and `contribute` adds what it brings to the assembly (loads, contacts, friction, grips). An effect that is not called
//! for contributes nothing, so that no program has a row or a column of it. How many unknowns each added is counted from
//! the programs that were posed. Sticking, mechanism, margins and wedging are called for by the outcome or by the user;
//! they add to no assembly, and their reports are written after the solve.

pub mod contact;
pub mod corner_contact;
pub mod friction;
pub mod kernel;
pub mod load;
pub mod margin;
pub mod mechanism;
mod name;
pub mod robot;
pub mod robot_torque;
pub mod sticking;
pub mod wedging;
pub mod weight;

pub use name::EffectName;

use crate::assembly::Assembly;
use crate::interface::Interface;
use crate::scene::{Frame, Scene};

/// One effect in one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct EffectReport {
    /// Its name.
    pub effect: EffectName,
    /// Whether it was simulated.
    pub simulated: bool,
    /// Why, in words.
    pub why: String,
    /// Force unknowns it added to the programs posed, or would have added where it was skipped.
    pub unknowns: usize,
}

impl EffectReport {
    fn simulated(effect: EffectName, why: String, unknowns: usize) -> EffectReport {
        EffectReport {
            effect,
            simulated: true,
            why,
            unknowns,
        }
    }

    fn skipped(effect: EffectName, why: impl Into<String>, unknowns: usize) -> EffectReport {
        EffectReport {
            effect,
            simulated: false,
            why: why.into(),
            unknowns,
        }
    }
}

/// What an effect looks at to decide.
#[derive(Clone, Copy, Debug)]
pub struct FrameContext<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The frame.
    pub frame: &'a Frame,
    /// The interfaces between bodies that stand in the frame.
    pub interfaces: &'a [&'a Interface],
}

/// Whether a frame calls for an effect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Applicability {
    /// It does, for the reason given.
    For(String),
    /// It does not, for the reason given; so many unknowns are saved by leaving it out.
    Not(String, usize),
}

impl Applicability {
    fn not(why: &str) -> Applicability {
        Applicability::Not(why.to_owned(), 0)
    }
}

/// An effect that contributes to the assembly.
struct Effect {
    name: EffectName,
    called_for: fn(&FrameContext) -> Applicability,
    contribute: fn(&FrameContext, &mut Assembly),
}

/// In the order in which they are reported and contribute: friction and kernel change the contacts that are there.
const EFFECTS: [Effect; 8] = [
    Effect {
        name: weight::NAME,
        called_for: weight::called_for,
        contribute: weight::contribute,
    },
    Effect {
        name: contact::NAME,
        called_for: contact::called_for,
        contribute: contact::contribute,
    },
    Effect {
        name: friction::NAME,
        called_for: friction::called_for,
        contribute: friction::contribute,
    },
    Effect {
        name: kernel::NAME,
        called_for: kernel::called_for,
        contribute: kernel::contribute,
    },
    Effect {
        name: robot::NAME,
        called_for: robot::called_for,
        contribute: robot::contribute,
    },
    Effect {
        name: robot_torque::NAME,
        called_for: robot_torque::called_for,
        contribute: robot_torque::contribute,
    },
    Effect {
        name: load::NAME,
        called_for: load::called_for,
        contribute: load::contribute,
    },
    Effect {
        name: corner_contact::NAME,
        called_for: corner_contact::called_for,
        contribute: corner_contact::contribute,
    },
];

/// Puts a frame's assembly together from the effects it calls for, and reports on each of them.
///
/// The reports of simulated effects hold 0 unknowns until they are counted from the programs posed.
pub fn assemble(situation: &FrameContext) -> (Assembly, Vec<EffectReport>) {
    let mut assembly =
        Assembly::without_effects(situation.scene, situation.frame, situation.interfaces);
    let mut reports = Vec::with_capacity(EFFECTS.len());
    for effect in &EFFECTS {
        reports.push(match (effect.called_for)(situation) {
            Applicability::For(why) => {
                (effect.contribute)(situation, &mut assembly);
                EffectReport::simulated(effect.name, why, 0)
            }
            Applicability::Not(why, saved) => EffectReport::skipped(effect.name, why, saved),
        });
    }
    assembly.contacts.sort_by_key(|contact| contact.interface);
    (assembly.with_summed_loads(), reports)
}

/// `1 thing`, `2 things`.
fn counted(n: usize, noun: &str) -> String {
    if n == 1 {
        format!("1 {noun}")
    } else {
        format!("{n} {noun}s")
    }
}
