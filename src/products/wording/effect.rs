//! Explains the effects.

use crate::analysis::EffectName;

/// A short explanation of an effect.
pub fn meaning(effect: EffectName) -> &'static str {
    match effect {
        EffectName::Weight => "each block is pulled along gravity at its centroid",
        EffectName::Contact => {
            "blocks press on each other and on the ground where edges touch, and never pull"
        }
        EffectName::Friction => "contacts resist sliding, up to μ times the normal force",
        EffectName::Kernel => "forces keep away from the ends of interfaces",
        EffectName::Robots => "robots hold blocks by a force, up to their limits",
        EffectName::RobotTorque => "robots also hold blocks by a torque, up to their limits",
        EffectName::Loads => "forces and torques from outside, as the scene lists them",
        EffectName::CornerContacts => "corners that touch carry force too",
        EffectName::Sticking => {
            "the least adhesion, or robot force beyond the limits, with which it would stand"
        }
        EffectName::Mechanism => "the motion by which it falls",
        EffectName::Margins => "how far it is from the edge of standing",
        EffectName::Wedging => {
            "whether it stands only by a self-stress that its loads do not build up"
        }
    }
}
