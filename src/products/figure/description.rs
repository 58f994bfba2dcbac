//! Describes arrows and motions in words, with numbers and units, for tooltips and screen readers; [`caption`] describes a
//! figure.

use super::arrow::ForceArrow;
use crate::mechanics::analysis::{Analysis, ForceKind, Motion, Verdict};
use crate::mechanics::scene::{BodyId, Scene};
use crate::products::wording::failure::named;
use crate::products::wording::number::{force, letter, quantity};
use crate::products::wording::verdict::reasons;

/// Returns the words for a kind of force, such as `Missing pull`.
pub(crate) fn word(kind: ForceKind) -> &'static str {
    match kind {
        ForceKind::Weight => "Weight",
        ForceKind::Load => "Load",
        ForceKind::Contact(_) | ForceKind::Robot(_) => "Force",
        ForceKind::Normal(_) => "Normal force",
        ForceKind::Friction(_) => "Friction force",
        ForceKind::RobotTorque(_) => "Torque",
        ForceKind::MissingPull(_) => "Missing pull",
        ForceKind::MissingFriction(_) => "Missing friction",
        ForceKind::MissingRobotForce(_) => "Missing force",
        ForceKind::MissingTorque(_) => "Missing torque",
    }
}

/// Names the body or the robot that exerts a force: `block a`, `the ground`, `robot r`. A weight and a load have no
/// name.
pub(crate) fn exerted_by(scene: &Scene, kind: ForceKind) -> Option<String> {
    let robot = || Some(format!("robot {}", scene.robots[kind.robot()?.0].id));
    kind.partner().map(|body| named(scene, body)).or_else(robot)
}

/// Describes the force that an arrow shows, such as `Weight of block a: 6 N at 270°`.
/// `unit` is the unit length, metres.
pub(crate) fn arrow(scene: &Scene, unit: f64, arrow: &ForceArrow) -> String {
    let amount = match arrow.kind {
        ForceKind::RobotTorque(_) | ForceKind::MissingTorque(_) => {
            quantity(arrow.force.norm() * unit, scene.units.torque())
        }
        _ => force(arrow.force, scene.units),
    };
    format!("{}: {amount}", described(scene, arrow.kind, arrow.on))
}

/// Names a force, such as `Force on block a from block b`.
pub(crate) fn described(scene: &Scene, kind: ForceKind, on: BodyId) -> String {
    let preposition = if kind == ForceKind::Weight { "of" } else { "on" };
    let from = exerted_by(scene, kind).map_or(String::new(), |name| format!(" from {name}"));
    format!("{} {preposition} {}{from}", word(kind), named(scene, on))
}

/// Describes in which direction a block begins to move in a mechanism, and how fast it turns.
pub(crate) fn motion(scene: &Scene, motion: &Motion) -> String {
    let name = &scene.blocks[motion.block.0].id;
    let degrees = libm::atan2(motion.velocity.y, motion.velocity.x).to_degrees();
    let degrees = (degrees.round() + 360.0) % 360.0;
    let turning = motion.spin.abs().to_degrees();
    let sense = if motion.spin > 0.0 { "anticlockwise" } else { "clockwise" };
    let begins = format!("Block {name} begins to move at {degrees:.0}°");
    if turning < 5e-4 {
        format!("{begins}, without turning")
    } else {
        format!("{begins}, turning {turning:.3}° {sense} per metre that the fastest point moves")
    }
}

/// Returns the caption of a figure: the title, followed by the verdict and its reasons for every frame.
///
/// ```
/// use drystone::{Analysis, Scene, figure};
/// let scene = Scene::from_json(r#"{ "drystone": 1, "title": "An overhang",
///     "ground": [{ "polygon": [[0, 0], [2, 0], [2, -1], [0, -1]] }],
///     "blocks": [{ "id": "plank", "polygon": [[1, 0], [5, 0], [5, 1], [1, 1]], "weight": 8 }] }"#)?;
/// let words = figure::caption(&Analysis::new(&scene));
/// assert_eq!(words, "An overhang. It falls: block plank would have to stick to the ground with 8 N.");
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn caption(analysis: &Analysis) -> String {
    let scene = analysis.given();
    let mut sentences = Vec::new();
    if !scene.title.is_empty() {
        sentences.push(format!("{}.", scene.title.trim_end_matches('.')));
    }
    let several = analysis.frames.len() > 1;
    for solved in analysis.each() {
        let verdict = solved.found.verdict.plain();
        let verdict = match solved.found.verdict {
            Verdict::Undecided => format!("is {verdict}"),
            _ => verdict.to_owned(),
        };
        let reasons = reasons(solved);
        let reasons = if reasons.is_empty() { String::new() } else { format!(": {reasons}") };
        let title = &solved.frame().title;
        sentences.push(match (several, title.as_str()) {
            (false, _) => format!("It {verdict}{reasons}."),
            (true, "") => format!("({}) It {verdict}{reasons}.", letter(solved.number)),
            (true, title) => format!("({}) {title}: it {verdict}{reasons}.", letter(solved.number)),
        });
    }
    sentences.join(" ")
}
