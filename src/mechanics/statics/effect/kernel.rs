//! Safety kernel: each application point moves inward by the fraction kernel/2 of the interface's length. The effect
//! adds no unknowns to the linear program.
//!
//! Source: [Vallat23](crate::doc::references) §2.0.10.

use super::{Applicability, Effect, EffectName, FrameContext};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::interface::application_points;

/// The safety kernel. Applies if it is above 0 and there is an interface; moves the application points of all contacts.
pub(super) struct Kernel;

impl Effect for Kernel {
    fn name(&self) -> EffectName {
        EffectName::Kernel
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let kernel = context.scene.kernel;
        if kernel == 0.0 {
            Applicability::skipped("the kernel is 0")
        } else if context.interfaces.is_empty() {
            Applicability::skipped("there is no interface")
        } else {
            Applicability::Applies(format!(
                "forces act at least {} of each interface's length away from its ends",
                kernel / 2.0
            ))
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        for contact in &mut assembly.contacts {
            contact.points = application_points(contact.ends, context.scene.kernel);
        }
    }
}
