//! Describes the placement tolerance of a frame.

use super::failure::pair;
use super::number::{three_down, three_up};
use crate::mechanics::analysis::{FrameAnalysis, Placement, PlacementLimit};
use crate::mechanics::scene::{BodyId, Scene};

/// Writes a length in the unit of the scene, or in millimetres if the scene gives no unit, with a rounding to one side.
pub fn length(scene: &Scene, metres: f64, rounded: fn(f64) -> String) -> String {
    let unit = scene.units.length();
    if unit.is_chosen {
        return format!("{} {}", rounded(unit.value_from_si(metres)), unit.symbol());
    }
    format!("{} mm", rounded(1e3 * metres))
}

/// States the proved placement tolerance in a few words, for figures.
pub fn proved(scene: &Scene, placement: &Placement) -> String {
    format!("safe for all errors up to {}", length(scene, placement.proved, three_down))
}

/// Describes the placement tolerance of a frame in one sentence without a full stop.
pub fn sentence(scene: &Scene, frame_analysis: &FrameAnalysis, placement: &Placement) -> String {
    let stands = format!(
        "stands for all errors up to {} (all blocks, their centres of gravity and their loads at once)",
        length(scene, placement.proved, three_down)
    );
    let falls = placement.falls_at.map(|at| {
        let block = placement.block.map(|block| format!("; {} decides", scene.name(BodyId::Block(block))));
        format!("; falls with a pattern of errors of {}{}", length(scene, at, three_up), block.unwrap_or_default())
    });
    let joint = placement.joint.and_then(|joint| frame_analysis.contacts.get(joint));
    let why = match placement.limited_by {
        PlacementLimit::Balance => String::new(),
        PlacementLimit::JointLength => match joint {
            Some(contact) => {
                format!("; beyond it the joint of {} has no length left", pair(scene, contact.interface.bodies))
            }
            None => "; beyond it a joint has no length left".to_owned(),
        },
        PlacementLimit::PointContact => "; a contact that acts at one point leaves no room for errors".to_owned(),
        PlacementLimit::TooManyBlocks => "; the structure has too many blocks for this test".to_owned(),
        PlacementLimit::Search => "; the search ended before the optimum".to_owned(),
        PlacementLimit::TimeLimit => "; the time limit ended the search".to_owned(),
    };
    stands + &falls.unwrap_or_default() + &why
}
