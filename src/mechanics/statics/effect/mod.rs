//! Effects: the phenomena that can be simulated in a frame, such as friction or robots, and whether a frame needs them.
//!
//! An effect that acts on the assembly is a type in `action.rs` that implements `Effect`: `applicability` returns
//! whether the frame needs it, with a reason in words, and `contribute` adds its loads, contacts, friction or grips to
//! the [`Assembly`]. A skipped effect contributes nothing, so the linear program has no row or column for it. The
//! number of unknowns of each effect is counted later, from the columns of the programs that were solved.
//!
//! Sticking, mechanism, margins and wedging depend on the verdict or on the user's options. They contribute to no
//! assembly; their functions in [`report`] are called after the frame is solved.
//!
//! To add an effect, write its type or its report, and add it to [`EffectName`] and to `EFFECTS` here.

mod action;
pub mod report;

use std::fmt;

use action::{Contact, CornerContacts, Friction, Kernel, Loads, RobotTorque, Robots, Weight};

use crate::mechanics::scene::{Frame, Scene};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::interface::{Interface, Interfaces};

/// The name of an effect. Effects are reported in this order; `Display` writes [`EffectName::word`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum EffectName {
    /// Gravity acts on each block at its centroid.
    Weight,
    /// Blocks press on each other and on the ground where edges touch; they never pull.
    Contact,
    /// Contacts that are pressed resist sliding.
    Friction,
    /// Contact forces act at a distance from the ends of interfaces.
    Kernel,
    /// Robots hold blocks with a force.
    Robots,
    /// Robots also apply a torque to the blocks they hold.
    RobotTorque,
    /// Forces and torques that the scene lists.
    Loads,
    /// Contact forces also act where a corner touches an edge or another corner.
    CornerContacts,
    /// The least additional forces with which a falling frame would stand: adhesion at contacts, or robot forces beyond
    /// the limits.
    Sticking,
    /// The motion with which a frame collapses.
    Mechanism,
    /// How far a quantity, such as loads, friction or tilt, may change before the verdict changes.
    Margins,
    /// Whether a frame stands only by a self-stress that its loads do not build up.
    Wedging,
    /// How accurately the blocks must be placed. Reported only if it was requested.
    Placement,
    /// How the structure follows a support that moves. Reported only if the scene lists movements.
    Movements,
    /// The load factor for each position of a vehicle. Reported only if the scene has a vehicle.
    Vehicle,
}

impl EffectName {
    /// Returns the name of the effect in results, such as `robot torque`.
    pub fn word(self) -> &'static str {
        match self {
            EffectName::Weight => "weight",
            EffectName::Contact => "contact",
            EffectName::Friction => "friction",
            EffectName::Kernel => "kernel",
            EffectName::Robots => "robots",
            EffectName::RobotTorque => "robot torque",
            EffectName::Loads => "loads",
            EffectName::CornerContacts => "corner contacts",
            EffectName::Sticking => "sticking",
            EffectName::Mechanism => "mechanism",
            EffectName::Margins => "margins",
            EffectName::Wedging => "wedging",
            EffectName::Placement => "placement",
            EffectName::Movements => "movements",
            EffectName::Vehicle => "vehicle",
        }
    }

    /// Returns a short explanation of the effect for users.
    pub fn meaning(self) -> &'static str {
        match self {
            EffectName::Weight => "gravity acts on each block at its centroid",
            EffectName::Contact => "blocks press on each other and on the ground where edges touch, and never pull",
            EffectName::Friction => "contacts resist sliding, up to μ times the normal force",
            EffectName::Kernel => "contact forces act at a distance from the ends of interfaces",
            EffectName::Robots => "robots hold blocks by a force, up to their limits",
            EffectName::RobotTorque => "robots also hold blocks by a torque, up to their limits",
            EffectName::Loads => "external forces and torques that the scene lists",
            EffectName::CornerContacts => "corners that touch an edge or a corner also carry force",
            EffectName::Sticking => "the least adhesion, or robot force beyond the limits, with which it would stand",
            EffectName::Mechanism => "the motion by which it falls",
            EffectName::Margins => "how far loads, friction, tilt and geometry may change before the verdict changes",
            EffectName::Wedging => "whether it stands only by a self-stress that its loads do not build up",
            EffectName::Placement => "how far blocks may be off their places before the verdict changes",
            EffectName::Movements => "how the structure cracks and which force it exerts if a support moves a little",
            EffectName::Vehicle => "the load factor for each position of a vehicle that travels over the structure",
        }
    }
}

impl fmt::Display for EffectName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// Whether one effect was simulated in one frame, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct EffectReport {
    /// The effect.
    pub effect: EffectName,
    /// Whether it was simulated.
    pub simulated: bool,
    /// Why it was simulated or skipped, in words.
    pub why: String,
    /// The number of force unknowns that the effect added to the programs. For a skipped effect, the number that it
    /// would have added.
    pub unknowns: usize,
}

impl EffectReport {
    fn simulated(effect: EffectName, why: String, unknowns: usize) -> EffectReport {
        EffectReport { effect, simulated: true, why, unknowns }
    }

    fn skipped(effect: EffectName, why: impl Into<String>, unknowns: usize) -> EffectReport {
        EffectReport { effect, simulated: false, why: why.into(), unknowns }
    }
}

/// The data of a frame that effects use.
#[derive(Clone, Copy, Debug)]
pub struct FrameContext<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The frame.
    pub frame: &'a Frame,
    /// The interfaces between bodies that are present in the frame.
    pub interfaces: &'a [&'a Interface],
}

/// Whether a frame needs an effect.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Applicability {
    /// The effect is simulated, for this reason.
    Applies(String),
    /// The effect is skipped.
    Skipped {
        /// Why it is skipped, in words.
        reason: String,
        /// The number of unknowns that this saves.
        saved_unknowns: usize,
    },
}

impl Applicability {
    /// Returns the result for a skipped effect that saves no unknowns.
    fn skipped(reason: &str) -> Applicability {
        Applicability::skipped_saving(reason, 0)
    }

    /// Returns the result for a skipped effect. `saved_unknowns` is the number of unknowns that the effect would add.
    fn skipped_saving(reason: &str, saved_unknowns: usize) -> Applicability {
        Applicability::Skipped { reason: reason.to_owned(), saved_unknowns }
    }
}

/// An effect that contributes to the assembly of a frame.
trait Effect {
    /// Returns the name of the effect in results, such as `robot torque`.
    fn name(&self) -> EffectName;

    /// Decides whether the frame needs the effect, and why.
    fn applicability(&self, context: &FrameContext) -> Applicability;

    /// Adds the loads, contacts or grips of the effect to the assembly, or changes contacts or grips of
    /// the assembly. It is called only if the effect applies.
    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly);
}

/// The effects in the order in which they contribute and are reported. Friction and kernel change contacts, so they
/// come after the effect that adds edge contacts.
const EFFECTS: [&dyn Effect; 8] =
    [&Weight, &Contact, &Friction, &Kernel, &Robots, &RobotTorque, &Loads, &CornerContacts];

/// Builds the assembly of a frame, as [`assemble`] does, of which it leaves out the reports.
pub fn assembly_of(scene: &Scene, frame: &Frame, interfaces: &Interfaces) -> Assembly {
    assemble(&FrameContext { scene, frame, interfaces: &interfaces.in_frame(frame) }).0
}

/// Builds the assembly of a frame from the effects that apply. Also returns a report on each effect that can act on the
/// assembly, including skipped effects.
///
/// The reports of simulated effects contain 0 unknowns at first. The unknowns are counted later, from the programs.
pub fn assemble(context: &FrameContext) -> (Assembly, Vec<EffectReport>) {
    let mut assembly = Assembly::without_effects(context.scene, context.frame, context.interfaces);
    let mut reports = Vec::with_capacity(EFFECTS.len());
    for effect in EFFECTS {
        reports.push(match effect.applicability(context) {
            Applicability::Applies(why) => {
                effect.contribute(context, &mut assembly);
                EffectReport::simulated(effect.name(), why, 0)
            }
            Applicability::Skipped { reason, saved_unknowns } => {
                EffectReport::skipped(effect.name(), reason, saved_unknowns)
            }
        });
    }
    // Edge and corner contacts come from two effects. Sort them, because results list contacts in the order of the
    // interfaces.
    assembly.contacts.sort_by_key(|contact| contact.interface);
    (assembly.with_summed_loads(), reports)
}

/// Writes a number with a noun, such as `1 block` or `2 blocks`.
fn counted(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}
