//! [`Bearing`]: the force of an interface, and its distance from opening and from sliding.

use crate::analysis::{Contact, FrameAnalysis};
use crate::interface::ContactKind;
use crate::scene::{BodyId, Scene};

/// Forces below this share of the largest may be noise of the solution …
const NOISE: f64 = 1e-6;
/// … unless they are more than this share of a block's own weight: a feather under a mountain is carried too.
const SHARE: f64 = 1e-3;

/// What an interface bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bearing {
    /// The force that presses it, N, above 0.
    pub pressed: f64,
    /// How far its resultant is from the middle, as a share of the way to the end of the safe stretch; `None` where
    /// that stretch is a point.
    pub eccentricity: Option<f64>,
    /// Friction used of friction available; `None` where none is available.
    pub friction: Option<f64>,
}

/// The bearing of each contact of a frame; `None` for a contact without force.
pub(crate) fn bearings(scene: &Scene, found: &FrameAnalysis) -> Vec<Option<Bearing>> {
    let pressed = |c: &Contact| c.normal_forces.iter().sum::<f64>();
    let largest = found.contacts.iter().map(pressed).fold(0.0, f64::max);
    let bearing = |contact: &Contact| {
        let pressed = pressed(contact);
        let [one, other] = contact.normal_forces;
        let point = contact.interface.kind == ContactKind::Corner || scene.kernel >= 1.0;
        let weights = contact.interface.bodies.iter().map(|body| match body {
            BodyId::Block(id) => scene.blocks[id.0].weight,
            BodyId::Ground(_) => f64::INFINITY,
        });
        let lighter = weights.fold(f64::INFINITY, f64::min);
        (pressed > noise(largest, lighter)).then(|| Bearing {
            pressed,
            eccentricity: (!point).then(|| (one - other).abs() / pressed),
            friction: (contact.interface.friction > 0.0).then_some(contact.friction_used),
        })
    };
    found.contacts.iter().map(bearing).collect()
}

/// The largest force, in newtons, that may be solver noise on a block of this weight, if the largest force of the frame is
/// `largest`.
pub(crate) fn noise(largest: f64, weight: f64) -> f64 {
    if weight > 0.0 {
        f64::min(NOISE * largest, SHARE * weight)
    } else if largest.is_finite() {
        NOISE * largest
    } else {
        0.0
    }
}
