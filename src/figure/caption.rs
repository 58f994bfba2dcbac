//! [`caption`]: what a figure shows, in plain words, written from the result.

use super::verdict::{amount, shortened, uncarried, word};
use super::words::{letter, quantity};
use crate::analysis::{Analysis, Failure, FrameAnalysis, Verdict};
use crate::scene::{BodyId, Scene};

/// Above so many things that are missing the rest is counted.
const MOST: usize = 4;

/// What a figure of an analysis shows: its title, and for every frame its verdict and what it lacks to stand.
///
/// ```
/// use drystone::{Analysis, Scene, figure};
/// let scene = Scene::from_json(r#"{ "drystone": 1, "title": "An overhang",
///     "ground": [{ "polygon": [[0, 0], [2, 0], [2, -1], [0, -1]] }],
///     "blocks": [{ "id": "plank", "polygon": [[1, 0], [5, 0], [5, 1], [1, 1]], "weight": 8 }] }"#)?;
/// let words = figure::caption(&Analysis::of(&scene));
/// assert_eq!(words, "An overhang. It falls: block plank would have to stick to the ground with 8 N.");
/// # Ok::<(), drystone::scene::Problems>(())
/// ```
pub fn caption(analysis: &Analysis<'_>) -> String {
    let scene = analysis.scene;
    let mut sentences = Vec::new();
    if !scene.title.is_empty() {
        sentences.push(format!("{}.", scene.title.trim_end_matches('.')));
    }
    let several = analysis.frames.len() > 1;
    for (number, found) in analysis.frames.iter().enumerate() {
        let verdict = word(found.verdict);
        let verdict = match found.verdict {
            Verdict::Undecided => format!("is {verdict}"),
            _ => verdict.to_owned(),
        };
        let lacks = lacks(scene, found);
        let lacks = if lacks.is_empty() {
            String::new()
        } else {
            format!(": {lacks}")
        };
        let title = &scene.frames[number].title;
        sentences.push(match (several, title.as_str()) {
            (false, _) => format!("It {verdict}{lacks}."),
            (true, "") => format!("({}) It {verdict}{lacks}.", letter(number)),
            (true, title) => format!("({}) {title}: it {verdict}{lacks}.", letter(number)),
        });
    }
    sentences.join(" ")
}

/// What a frame lacks to stand; empty where it stands.
fn lacks(scene: &Scene, found: &FrameAnalysis) -> String {
    let mut parts: Vec<String> = Vec::new();
    parts.extend(uncarried(scene, found));
    let mut failures: Vec<&Failure> = found.failures.iter().collect();
    failures.sort_by(|a, b| amount(b).total_cmp(&amount(a)));
    let failures: Vec<String> = failures.into_iter().map(|f| lacking(scene, f)).collect();
    parts.extend(shortened(failures, MOST));
    if found.only_by_wedging == Some(true) {
        parts.push("only wedged, by forces that its loads alone do not build up".to_owned());
    }
    if found.verdict == Verdict::Undecided {
        parts.push(found.doubt.clone());
    }
    parts.retain(|p| !p.is_empty());
    parts.join("; ")
}

fn lacking(scene: &Scene, failure: &Failure) -> String {
    let named = |id: BodyId| match id {
        BodyId::Ground(_) => "the ground".to_owned(),
        BodyId::Block(_) => format!("block {}", scene.name(id)),
    };
    match failure {
        Failure::Tension {
            bodies: [a, b],
            force,
            ..
        } => format!(
            "{} would have to stick to {} with {}",
            named(*a),
            named(*b),
            quantity(force.norm(), "N")
        ),
        Failure::Friction {
            bodies: [a, b],
            force,
            ..
        } => format!(
            "{} would have to hold on to {} against sliding with {}",
            named(*a),
            named(*b),
            quantity(force.norm(), "N")
        ),
        Failure::RobotForce { robot, force, .. } => format!(
            "robot {} would have to give {} more",
            scene.robots[robot.0].id,
            quantity(force.norm(), "N")
        ),
        Failure::RobotTorque { robot, torque, .. } => format!(
            "robot {} would have to give a torque of {}",
            scene.robots[robot.0].id,
            quantity(torque.abs(), "N·m")
        ),
    }
}
