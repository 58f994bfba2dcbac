//! Whether a balance is reached from rest, or only by a self-stress that nothing built up.
//!
//! Every application point gets a unilateral spring and every interface a spring along itself, all unstressed before the
//! loads act; friction is Coulomb's. Robots may give whatever their limits allow. Where such springs come to rest, the
//! forces they come to are the certificate ([`spring`]). Where none do, every way in which points press and faces
//! slide is ruled out by multipliers that show the balance and the springs' law to contradict each other ([`tree`]).

mod band;
mod certificate;
mod law;
mod spring;
mod tree;
mod tresca;

use super::{Conditioning, Effort, Status, dual};
use crate::program::{Column, Force, Program, columns};
use spring::Springs;
use tree::{Search, search};

pub use spring::Slide;
pub use tree::RuledOut;

/// How a balance comes about.
#[derive(Clone, Debug, PartialEq)]
pub enum SelfStressCheck {
    /// The loads build it up themselves.
    FromRest,
    /// Only a self-stress from elsewhere makes it.
    OnlyWedged(SelfStress),
    /// Neither was shown.
    Undecided(WedgingUndecided),
}

/// The self-stress without which a program does not stand.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfStress {
    /// Three velocities per block, the largest 1: how the springs give way.
    pub motion: Vec<f64>,
    /// The contacts that this motion opens or slides.
    pub contacts: Vec<usize>,
    /// Whether the motion presses no contact at all.
    pub presses_nothing: bool,
    /// The least sum of normal forces at those contacts with which forces balance, pure number.
    pub least: Option<f64>,
    /// The motion that shows it: no other contact takes work along it, these at most 1 for each unit of normal force.
    pub bound: Vec<f64>,
    /// The cases ruled out by the proof; one of them holds whatever springs do.
    pub cases: Vec<RuledOut>,
}

impl SelfStress {
    /// The blocks that move along the motion.
    pub fn moving(&self) -> impl Iterator<Item = usize> {
        let blocks = self.motion.chunks(3).enumerate();
        blocks.filter_map(|(block, v)| v.iter().any(|v| v.abs() > 1e-3).then_some(block))
    }
}

impl std::fmt::Display for WedgingUndecided {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            WedgingUndecided::NotFound => {
                "springs were not found to come to rest, nor was it shown that none do"
            }
            WedgingUndecided::Stiffness => {
                "springs come to rest or not depending on how stiff faces are along themselves"
            }
        })
    }
}

/// Why an answer was not found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WedgingUndecided {
    /// Neither a rest nor a proof that there is none.
    NotFound,
    /// It depends on how stiff faces are along themselves.
    Stiffness,
}

/// Stiffness along a face, in parts of a point's, tried beside 1 where springs of 1 find no rest.
const ALONG: [f64; 4] = [0.3, 3.0, 0.05, 20.0];

/// Turns of convex programs take long for more blocks than this.
const MOST_BY_TURNS: usize = 400;

/// A velocity below this is none.
const STILL: f64 = 1e-6;

/// Whether the forces that balance a standing program build up from rest. `given` is what robots were found to give, as
/// (force x, force y, torque/L) per grip; within their limits they may give anything else.
///
/// Without friction the answer is known: among the forces that balance, springs come to those of least Σ N².
pub fn reach(program: &Program, given: &[[f64; 3]]) -> SelfStressCheck {
    if program.contacts.iter().all(|c| c.friction == 0.0) {
        return SelfStressCheck::FromRest;
    }
    let given: Vec<f64> = columns(program)
        .iter()
        .filter_map(|column| match column.force {
            Force::Grip {
                grip,
                component,
                sign,
            } if sign > 0.0 => Some(given[grip][component]),
            _ => None,
        })
        .collect();
    let motion = match Springs::around(program, &given, 1.0).settled() {
        Ok(_) => return SelfStressCheck::FromRest,
        Err(motion) => motion,
    };
    let springs = Springs::new(program, 1.0);
    if !given.is_empty() && springs.settled().is_ok() {
        return SelfStressCheck::FromRest;
    }
    if program.blocks <= MOST_BY_TURNS && springs.settled_by_turns().is_some() {
        return SelfStressCheck::FromRest;
    }
    let found = search(program);
    if found == Search::Rests {
        return SelfStressCheck::FromRest;
    }
    let other = |along: &f64| Springs::around(program, &given, *along).settled().is_ok();
    if ALONG.iter().any(other) {
        return SelfStressCheck::Undecided(WedgingUndecided::Stiffness);
    }
    match found {
        Search::NoRest(cases) => SelfStressCheck::OnlyWedged(squeeze(program, motion, cases)),
        _ => SelfStressCheck::Undecided(WedgingUndecided::NotFound),
    }
}

/// What a program without rest lacks, shown on a motion.
fn squeeze(program: &Program, motion: Vec<f64>, cases: Vec<RuledOut>) -> SelfStress {
    let springs = Springs::new(program, 1.0);
    let mut moved = vec![false; program.contacts.len()];
    let mut presses_nothing = true;
    for point in &springs.points {
        let opening = point.column.dot(&motion);
        presses_nothing &= opening >= -STILL;
        moved[point.contact] |=
            opening > STILL || springs.tangents[point.contact].dot(&motion).abs() > STILL;
    }
    let contacts: Vec<usize> = (0..moved.len()).filter(|k| moved[*k]).collect();
    let cost = |column: &Column| match column.force {
        Force::Ray {
            contact, normal, ..
        } if moved[contact] => normal,
        _ => 0.0,
    };
    let mut effort = Effort::default();
    let pressed = dual(
        &program.loads,
        &columns(program),
        Conditioning::Full,
        &mut effort,
        cost,
    );
    SelfStress {
        motion,
        contacts,
        presses_nothing,
        least: (pressed.status == Status::Solved).then_some(pressed.objective),
        bound: pressed.y.iter().map(|v| -v).collect(),
        cases,
    }
}
