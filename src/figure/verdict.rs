//! The verdict at a glance: a mark, a word, and what is missing in a sentence. Never colour alone.

use super::told;
use super::words::{listed, quantity};
use crate::analysis::{Failure, FrameAnalysis, Verdict};
use crate::drawing::text::NO_BREAK;
use crate::drawing::{Colour, Group, Outline, PagePoint, Path, Stroke, Theme};
use crate::scene::{BodyId, Scene};

/// The word for a verdict.
pub(crate) fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stands",
        Verdict::Unstable => "falls",
        Verdict::Undecided => "undecided",
    }
}

/// The colour of its mark.
pub(crate) fn colour(verdict: Verdict, theme: &Theme) -> Colour {
    match verdict {
        Verdict::Stable => theme.stands,
        Verdict::Unstable => theme.falls,
        Verdict::Undecided => theme.undecided,
    }
}

/// A disc of radius `r` with a tick, a cross or a question mark.
pub(crate) fn mark(verdict: Verdict, centre: PagePoint, r: f64, theme: &Theme) -> Group {
    let at = |x: f64, y: f64| centre.moved(x * r, y * r);
    let pen = || Stroke::new(theme.page, 0.24 * r);
    let disc = Path::filled(Outline::circle(centre, r), colour(verdict, theme));
    let group = Group::of_class("verdict").with(disc);
    match verdict {
        Verdict::Stable => group.with(Path::stroked(
            Outline::line([at(-0.45, 0.04), at(-0.13, 0.38), at(0.46, -0.34)]),
            pen(),
        )),
        Verdict::Unstable => group
            .with(Path::stroked(
                Outline::line([at(-0.36, -0.36), at(0.36, 0.36)]),
                pen(),
            ))
            .with(Path::stroked(
                Outline::line([at(-0.36, 0.36), at(0.36, -0.36)]),
                pen(),
            )),
        Verdict::Undecided => {
            let mut hook = Outline::line([at(-0.3, -0.26)]);
            hook.segments.extend([
                crate::drawing::Segment::Curve(at(-0.28, -0.72), at(0.42, -0.68), at(0.3, -0.2)),
                crate::drawing::Segment::Curve(at(0.24, 0.0), at(0.0, 0.0), at(0.0, 0.22)),
            ]);
            group.with(Path::stroked(hook, pen())).with(Path::filled(
                Outline::circle(at(0.0, 0.54), 0.15 * r),
                theme.page,
            ))
        }
    }
}

/// Why a frame does not stand, in words; empty where it does.
pub(crate) fn reason(scene: &Scene, found: &FrameAnalysis) -> String {
    let mut sentences = Vec::new();
    sentences.extend(uncarried(scene, found));
    if !found.failures.is_empty() {
        let mut failures: Vec<&Failure> = found.failures.iter().collect();
        failures.sort_by(|a, b| amount(b).total_cmp(&amount(a)));
        let parts = failures.into_iter().map(|f| missing(scene, f)).collect();
        sentences.push(format!("missing: {}", listed(&shortened(parts, 3))));
    }
    if found.only_by_wedging == Some(true) {
        sentences.push("only by wedging: its loads alone do not build up what holds it".to_owned());
    }
    if found.verdict == Verdict::Undecided && !found.doubt.is_empty() {
        sentences.push(found.doubt.clone());
    }
    sentences.join("; ")
}

/// Which blocks no sticking could save; `None` where there are none.
pub(crate) fn uncarried(scene: &Scene, found: &FrameAnalysis) -> Option<String> {
    let blocks = found.unsupported.iter();
    let names: Vec<String> = blocks.map(|b| scene.blocks[b.0].id.clone()).collect();
    let what = if names.len() == 1 { "block" } else { "blocks" };
    (!names.is_empty()).then(|| format!("nothing carries {what} {}", listed(&shortened(names, 6))))
}

/// The first of some parts, and how many more there are.
pub(crate) fn shortened(mut parts: Vec<String>, most: usize) -> Vec<String> {
    if parts.len() > most {
        let left = parts.len() - most;
        parts.truncate(most);
        parts.push(format!("{left} more"));
    }
    parts
}

/// How much is missing, N or N·m.
pub(crate) fn amount(failure: &Failure) -> f64 {
    match failure {
        Failure::Tension { force, .. }
        | Failure::Friction { force, .. }
        | Failure::RobotForce { force, .. } => force.norm(),
        Failure::RobotTorque { torque, .. } => torque.abs(),
    }
}

/// What is missing, in words.
pub(crate) fn missing(scene: &Scene, failure: &Failure) -> String {
    let pair = |bodies: &[BodyId; 2]| told::pair(scene, *bodies);
    match failure {
        Failure::Tension { bodies, force, .. } => {
            format!(
                "a pull of {} between {}",
                whole(force.norm(), "N"),
                pair(bodies)
            )
        }
        Failure::Friction { bodies, force, .. } => {
            format!(
                "friction of {} between {}",
                whole(force.norm(), "N"),
                pair(bodies)
            )
        }
        Failure::RobotForce { robot, force, .. } => {
            format!(
                "a force of {} from robot\u{a0}{}",
                whole(force.norm(), "N"),
                scene.robots[robot.0].id
            )
        }
        Failure::RobotTorque { robot, torque, .. } => {
            format!(
                "a torque of {} from robot\u{a0}{}",
                whole(torque.abs(), "N·m"),
                scene.robots[robot.0].id
            )
        }
    }
}

/// An amount that stays whole where lines are broken.
fn whole(value: f64, unit: &str) -> String {
    quantity(value, unit).replace(' ', &NO_BREAK.to_string())
}
