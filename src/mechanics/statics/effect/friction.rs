//! Friction: |T| ≤ μ (N1 + N2) at each interface (Coulomb's law).
//!
//! There are two unknowns per application point, one for each edge of the friction cone: a normal force together with
//! the full friction in one direction. Source: [Vallat23](crate::doc::references) §2.0.3.

use super::{Applicability, Effect, EffectName, FrameContext, counted};
use crate::mechanics::statics::assembly::Assembly;

/// Friction at interfaces. Applies if μ > 0 at some interface; contributes the coefficient of each contact.
pub(super) struct Friction;

impl Effect for Friction {
    fn name(&self) -> EffectName {
        EffectName::Friction
    }

    fn applicability(&self, context: &FrameContext) -> Applicability {
        let rough = context.interfaces.iter().filter(|i| i.friction > 0.0);
        let (rough, all) = (rough.count(), context.interfaces.len());
        match rough {
            0 if all == 0 => Applicability::skipped("there is no interface"),
            // Four unknowns per interface: two directions of friction at each of the two application points.
            0 => Applicability::skipped_saving("μ is 0 at every interface", 4 * all),
            1 => Applicability::Applies("1 interface has friction".to_owned()),
            n => Applicability::Applies(format!("{} have friction", counted(n, "interface"))),
        }
    }

    fn contribute(&self, context: &FrameContext, assembly: &mut Assembly) {
        for contact in &mut assembly.contacts {
            contact.friction = context.interfaces[contact.interface].friction;
        }
    }
}
