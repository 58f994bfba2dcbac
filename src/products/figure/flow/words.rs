//! Writes the texts of figures of force flow: the tooltips of bands and joints, and the text below the verdict.

use super::strand::{Origin, Strand};
use crate::mechanics::analysis::{Contact, FrameAnalysis};
use crate::mechanics::scene::{BodyId, Scene};
use crate::products::figure::context::FigureContext;
use crate::products::figure::description;
use crate::products::figure::largest;
use crate::products::figure::limit;
use crate::products::figure::verdict;
use crate::products::figure::words::quantity;

/// Describes a band: `In block a: 5 N from a load, 6 N to block b`.
pub(super) fn strand(scene: &Scene, frame_analysis: &FrameAnalysis, strand: &Strand) -> String {
    let on = &scene.blocks[strand.on.0].id;
    let amount = |newtons: f64| quantity(newtons, scene.units.force());
    let name = |origin| name(scene, frame_analysis, BodyId::Block(strand.on), origin);
    format!(
        "In block {on}: {} from {}, {} to {}",
        amount(strand.amounts[0]),
        name(strand.from),
        amount(strand.amounts[1]),
        name(strand.to)
    )
}

/// Returns a name for the origin of a force on the body `on`, such as `block 3`, `robot crane` or `a load`.
fn name(scene: &Scene, frame_analysis: &FrameAnalysis, on: BodyId, origin: Origin) -> String {
    let other = |[a, b]: [BodyId; 2]| description::named(scene, if a == on { b } else { a });
    match origin {
        Origin::Contact(number) => other(frame_analysis.contacts[number].interface.bodies),
        Origin::Robot(robot) => format!("robot {}", scene.robots[robot.0].id),
        Origin::Load => "a load".to_owned(),
        Origin::Weight => "its weight".to_owned(),
        Origin::Missing(_) => "a missing force".to_owned(),
    }
}

/// Describes the resultant of a joint: `Between a and b: 5 N`.
pub(super) fn joint(scene: &Scene, contact: &Contact) -> String {
    let pair = description::pair(scene, contact.interface.bodies);
    let amount = quantity(contact.resultant.force.norm(), scene.units.force());
    format!("Between {pair}: {amount}")
}

/// Returns the text below the verdict: why the frame does not stand, its largest contact force, and its joints at their
/// limit. In a column of print with labels, the text leaves out the largest contact force, because its label shows it.
pub(super) fn reason(context: &FigureContext<'_>, frame: usize) -> String {
    let (scene, frame_analysis) = (&context.analysis.scene, &context.analysis.frames[frame]);
    let why = verdict::reason(scene, frame_analysis);
    let largest = if context.options.is_column() && context.options.labels {
        String::new()
    } else {
        largest::sentence(scene, frame_analysis)
    };
    let parts = [why, largest, limit::sentence(context, frame)];
    let parts: Vec<String> = parts.into_iter().filter(|p| !p.is_empty()).collect();
    parts.join("; ")
}
