//! Safety kernel: application points move inward by half the kernel of the stretch. Adds no unknown. Source:
//! [Vallat23](crate::doc::references) §2.0.10.

use super::{Applicability, EffectName, FrameContext};
use crate::assembly::Assembly;
use crate::interface::application_points;

/// Name in results.
pub const NAME: EffectName = EffectName::Kernel;

/// Called for when the kernel is above 0 and there is an interface to shrink.
pub fn called_for(situation: &FrameContext) -> Applicability {
    let kernel = situation.scene.kernel;
    if kernel == 0.0 {
        Applicability::not("the kernel is 0")
    } else if situation.interfaces.is_empty() {
        Applicability::not("there is no interface")
    } else {
        Applicability::For(format!(
            "forces keep {} of each stretch away from its ends",
            kernel / 2.0
        ))
    }
}

/// Moves the application points of every contact.
pub fn contribute(situation: &FrameContext, assembly: &mut Assembly) {
    for contact in &mut assembly.contacts {
        contact.points = application_points(contact.ends, situation.scene.kernel);
    }
}
