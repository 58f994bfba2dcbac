//! Safety kernel: application points move inward by half the kernel of the stretch. Adds no unknown. Source:
//! [Vallat23](crate::doc::references) §2.0.10.

use super::{Call, EffectName, Situation};
use crate::assembly::Assembly;
use crate::interface::application_points;

/// Name in results.
pub const NAME: EffectName = EffectName::Kernel;

/// Called for when the kernel is above 0 and there is an interface to shrink.
pub fn called_for(situation: &Situation) -> Call {
    let kernel = situation.scene.kernel;
    if kernel == 0.0 {
        Call::not("the kernel is 0")
    } else if situation.interfaces.is_empty() {
        Call::not("there is no interface")
    } else {
        Call::For(format!(
            "forces keep {} of each stretch away from its ends",
            kernel / 2.0
        ))
    }
}

/// Moves the application points of every contact.
pub fn contribute(situation: &Situation, assembly: &mut Assembly) {
    for contact in &mut assembly.contacts {
        contact.points = application_points(contact.ends, situation.scene.kernel);
    }
}
