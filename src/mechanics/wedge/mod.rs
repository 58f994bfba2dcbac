//! Checks whether the loads alone, on a structure without initial stress, produce forces that balance them. If they do
//! not, the structure stands only by a self-stress that the loads do not produce (wedging).
//!
//! Every application point gets a spring along the normal, which can only press. Every contact gets a spring along its
//! face, the line along which the two bodies touch. All springs are unstressed before the loads act; friction is
//! Coulomb's. Robots may exert any force within their limits. If the springs come to rest, their forces are the
//! certificate ([`spring`]). If no state of rest is found, a search tries to prove that there is none: it rules out
//! every pattern of pressing points and sliding faces ([`branch_and_bound`]).

mod band;
mod branch_and_bound;
mod certificate;
mod fixed_friction;
mod newton;
mod node;
mod relaxation;
mod rest;
mod spring;

use crate::mechanics::program::{Column, Force, Program, columns};
use crate::mechanics::solve::{Conditioning, Effort, Status, is_late, least_cost};
use branch_and_bound::{SearchOutcome, search};
use spring::Springs;

pub use node::RuledOut;
pub use spring::Slide;

/// Whether a balance needs a self-stress.
#[derive(Clone, Debug, PartialEq)]
pub enum SelfStressCheck {
    /// No self-stress is needed: the loads build up the balance from rest.
    FromRest,
    /// A self-stress is needed: the springs have no state of rest. This is proved for springs that are equally stiff
    /// along the normal and along the face.
    OnlyWedged(SelfStress),
    /// Neither of the two other answers was proved.
    Undecided(WedgingUndecided),
}

/// A self-stress that a program needs in order to stand.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfStress {
    /// The motion in which the springs give way: three velocities for each block. The largest absolute velocity is 1.
    pub motion: Vec<f64>,
    /// The contacts that open or slide in this motion.
    pub contacts: Vec<usize>,
    /// True if no application point closes in the motion, so that the moving blocks press against nothing.
    pub presses_nothing: bool,
    /// The least sum of normal forces at `contacts` in any balance, in program units. `None` if the solver finds no
    /// optimum.
    pub least_normal_sum: Option<f64>,
    /// The motion that proves `least_normal_sum`. Along this motion, the work against the forces of `contacts` is at
    /// most 1 per unit of normal force. No force of another contact resists the motion.
    pub bounding_motion: Vec<f64>,
    /// The patterns that the proof ruled out. Together they cover all patterns of pressing and sliding.
    pub ruled_out: Vec<RuledOut>,
}

impl SelfStress {
    /// Returns the indices of the blocks with an absolute velocity above 0.001. The largest absolute velocity of the
    /// motion is 1.
    pub fn moving_blocks(&self) -> impl Iterator<Item = usize> {
        let blocks = self.motion.chunks(3).enumerate();
        blocks.filter_map(|(block, v)| v.iter().any(|v| v.abs() > 1e-3).then_some(block))
    }
}

impl std::fmt::Display for WedgingUndecided {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            WedgingUndecided::NotFound => {
                "the search found neither a state of rest of the springs nor a proof that there is none"
            }
            WedgingUndecided::Stiffness => {
                "whether the springs come to rest depends on their stiffness along the faces"
            }
            WedgingUndecided::Late => "the time limit was reached",
        })
    }
}

/// The reason why it was proved neither that a self-stress is needed nor that none is needed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WedgingUndecided {
    /// Neither a state of rest nor a proof that there is none was found.
    NotFound,
    /// The answer depends on the stiffness of the springs along the faces.
    Stiffness,
    /// The search reached the deadline.
    Late,
}

/// Stiffnesses of the spring along a face, relative to the spring of an application point. They are tried if no state
/// of rest is found with a stiffness of 1.
const OTHER_STIFFNESSES: [f64; 4] = [0.3, 3.0, 0.05, 20.0];

/// The largest number of blocks for which the iteration with fixed friction is tried. With more blocks, it takes too
/// long.
const MAX_BLOCKS_FIXED_FRICTION: usize = 400;

/// A velocity below this counts as 0; the largest is 1.
const VELOCITY_TOL: f64 = 1e-6;

/// Checks whether the loads of a structure that stands can build up balancing forces from rest.
///
/// `given` are the robots' forces in the known balance, as (force x, force y, torque/L) for each grip. The robots may
/// exert other forces within their limits.
///
/// Without friction, the forces always build up from rest: the springs then come to rest at the balance of
/// least Σ N².
pub fn check_self_stress(program: &Program, given: &[[f64; 3]]) -> SelfStressCheck {
    if program.contacts.iter().all(|c| c.friction == 0.0) {
        return SelfStressCheck::FromRest;
    }
    if is_late() {
        return SelfStressCheck::Undecided(WedgingUndecided::Late);
    }
    let given: Vec<f64> = columns(program)
        .iter()
        .filter_map(|column| match column.force {
            Force::Grip { grip, component, sign } if sign > 0.0 => Some(given[grip][component]),
            _ => None,
        })
        .collect();
    // Fast attempts to find a state of rest: first with robots' springs that start at the given forces, then with
    // robots' springs that start at 0, then by the iteration with fixed friction limits.
    let motion = match Springs::with_given_forces(program, &given, 1.0).find_rest() {
        Ok(_) => return SelfStressCheck::FromRest,
        Err(motion) => motion,
    };
    let springs = Springs::new(program, 1.0);
    if !given.is_empty() && springs.find_rest().is_ok() {
        return SelfStressCheck::FromRest;
    }
    if program.blocks <= MAX_BLOCKS_FIXED_FRICTION && springs.find_rest_by_fixed_friction().is_some() {
        return SelfStressCheck::FromRest;
    }
    // Search for a proof that there is no state of rest.
    let found = search(program);
    if found == SearchOutcome::RestFound {
        return SelfStressCheck::FromRest;
    }
    let rests = |stiffness: &f64| Springs::with_given_forces(program, &given, *stiffness).find_rest().is_ok();
    if OTHER_STIFFNESSES.iter().any(rests) {
        return SelfStressCheck::Undecided(WedgingUndecided::Stiffness);
    }
    match found {
        SearchOutcome::NoRest(ruled_out) => SelfStressCheck::OnlyWedged(self_stress(program, motion, ruled_out)),
        _ if is_late() => SelfStressCheck::Undecided(WedgingUndecided::Late),
        _ => SelfStressCheck::Undecided(WedgingUndecided::NotFound),
    }
}

/// Returns the self-stress that a structure needs if its springs do not come to rest. Its size is the least sum of
/// normal forces at the contacts that open or slide in `motion`.
fn self_stress(program: &Program, motion: Vec<f64>, ruled_out: Vec<RuledOut>) -> SelfStress {
    let springs = Springs::new(program, 1.0);
    // Find the contacts that open or slide, and whether any point closes.
    let mut moved = vec![false; program.contacts.len()];
    let mut presses_nothing = true;
    for point in &springs.points {
        let opening = point.column.dot(&motion);
        presses_nothing &= opening >= -VELOCITY_TOL;
        moved[point.contact] |=
            opening > VELOCITY_TOL || springs.tangents[point.contact].dot(&motion).abs() > VELOCITY_TOL;
    }
    let contacts: Vec<usize> = (0..moved.len()).filter(|k| moved[*k]).collect();
    // Compute the least sum of normal forces at these contacts.
    let cost = |column: &Column| match column.force {
        Force::Ray { contact, normal, .. } if moved[contact] => normal,
        _ => 0.0,
    };
    let mut effort = Effort::default();
    let pressed = least_cost(&program.loads, &columns(program), Conditioning::Full, &mut effort, cost);
    SelfStress {
        motion,
        contacts,
        presses_nothing,
        least_normal_sum: (pressed.status == Status::Solved).then_some(pressed.objective),
        bounding_motion: pressed.y.iter().map(|v| -v).collect(),
        ruled_out,
    }
}
