//! Effects in a reader's words.

use crate::analysis::EffectName;

/// What an effect is.
pub fn meaning(effect: EffectName) -> &'static str {
    match effect {
        EffectName::Weight => "each block is pulled along gravity at its centroid",
        EffectName::Contact => {
            "blocks press on each other and on the ground where edges touch, and never pull"
        }
        EffectName::Friction => "what is pressed resists sliding, up to μ times the pressing force",
        EffectName::Kernel => "forces keep away from the ends of interfaces",
        EffectName::Robots => "robots hold blocks with a force, up to their limits",
        EffectName::RobotTorque => "robots also turn what they hold, up to their limits",
        EffectName::Loads => "forces and torques from outside, as the scene lists them",
        EffectName::CornerContacts => "corners that touch carry force too",
        EffectName::Sticking => {
            "the least that would have to be glued, or robots to give beyond their limits, for it to stand"
        }
        EffectName::Mechanism => "the motion by which it falls",
        EffectName::Margins => "how far it is from the edge of standing",
        EffectName::Wedging => {
            "whether it stands only by a stress of its own that its loads do not build up"
        }
    }
}
