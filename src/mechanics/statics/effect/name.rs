//! [`EffectName`]: every effect that a frame may call for.

use std::fmt;

/// An effect by name, in the order of reporting. `Display` is its word in results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum EffectName {
    /// Each block is pulled along gravity at its centroid.
    Weight,
    /// Blocks press on each other and on the ground where edges touch, and never pull.
    Contact,
    /// What is pressed resists sliding.
    Friction,
    /// Forces keep away from the ends of interfaces.
    Kernel,
    /// Robots hold blocks with a force.
    Robots,
    /// Robots also turn what they hold.
    RobotTorque,
    /// Forces and torques from outside.
    Loads,
    /// Corners that touch carry force too.
    CornerContacts,
    /// The least that would have to stick for a frame to stand.
    Sticking,
    /// The motion by which a frame falls.
    Mechanism,
    /// How far a frame is from the edge of standing.
    Margins,
    /// Whether a frame stands only by a stress of its own that its loads do not build up.
    Wedging,
}

impl EffectName {
    /// Its word in results.
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
        }
    }
}

impl fmt::Display for EffectName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
