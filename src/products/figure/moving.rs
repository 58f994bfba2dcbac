//! [`Moving`]: the motion of a frame that a figure shows, with the friction of the joints during it.

use super::fall::Fall;
use super::option::{At, Options};
use crate::mechanics::analysis::{Analysis, End, MarginKind, Motion, Verdict};
use crate::products::wording::margin::{Governing, OtherFriction};

/// The motion that the figure shows of a frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct Moving {
    /// The velocities of the blocks; empty if nothing moves.
    pub motions: Vec<Motion>,
    /// The friction of all joints during this motion, if it is not the present one.
    friction: Option<OtherFriction>,
    /// The value of the parameter of the margin just beyond which the frame moves.
    pub edge: Option<f64>,
}

impl Moving {
    /// Returns the motion of a frame that the options ask for. A frame that falls shows its fall. The movement of a support
    /// is not included, because the support moves too.
    pub fn new(analysis: &Analysis, frame: usize, options: &Options) -> Moving {
        let found = &analysis.frames[frame];
        let moved = |motions: &[Motion]| Moving { motions: motions.to_vec(), ..Moving::default() };
        match (options.at, found.verdict, &found.vehicle, &found.placement) {
            (Some(At::Vehicle), _, Some(influence), _) => moved(&influence.mechanism),
            (_, Verdict::Unstable, ..) => moved(&found.mechanism),
            (Some(At::Placement), Verdict::Stable, _, Some(placement)) => moved(&placement.mechanism),
            (Some(At::Margin(kind)), Verdict::Stable, ..) => beyond(analysis, frame, kind).unwrap_or_default(),
            _ => Moving::default(),
        }
    }

    /// Returns the collapse that the line of the verdict of a frame names: that beyond its first margin, or its own.
    pub fn governing(analysis: &Analysis, frame: usize, governing: &Governing<'_>) -> Moving {
        let found = &analysis.frames[frame];
        let motions = governing.mechanism;
        let own = || Moving { motions: motions.to_vec(), friction: governing.friction, edge: None };
        let is_of_vehicle = found.vehicle.as_ref().is_some_and(|own| std::ptr::eq(&own.mechanism[..], motions));
        match (found.verdict, governing.kind) {
            _ if is_of_vehicle => own(),
            (Verdict::Unstable, _) => {
                let alone = analysis.alone(frame).map(|alone| alone.elementary());
                let motions = alone.and_then(|alone| Some(alone.frames.first()?.mechanism.clone()));
                motions.map_or_else(own, |motions| Moving { motions, ..Moving::default() })
            }
            (_, Some(kind)) => beyond(analysis, frame, kind).unwrap_or_else(own),
            _ => own(),
        }
    }

    /// Returns the motion with its rigid bodies and joints.
    pub fn fall<'a>(&self, analysis: &'a Analysis, frame: usize) -> Fall<'a> {
        Fall::with_friction(analysis, frame, &self.motions, self.friction)
    }
}

/// Returns how a frame that stands falls just beyond a margin.
fn beyond(analysis: &Analysis, frame: usize, kind: MarginKind) -> Option<Moving> {
    let friction = match kind {
        MarginKind::Friction => OtherFriction::Coefficient,
        MarginKind::FrictionFactor => OtherFriction::Factor,
        _ => {
            let (edge, motions) = analysis.edge(frame, kind)?;
            return Some(Moving { motions, friction: None, edge: Some(edge) });
        }
    };
    match analysis.frames[frame].margins.as_ref()?.end(kind, 0)? {
        End::At { value, mechanism } => {
            Some(Moving { motions: mechanism.clone(), friction: Some(friction(*value)), edge: Some(*value) })
        }
        _ => None,
    }
}
