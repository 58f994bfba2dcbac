//! [`fails_first`] and [`would_take`]: sentences on where a frame fails first, and what would change its verdict.

use super::joints::name;
use crate::analysis::{Analysis, End, Failure, FrameAnalysis, Motion, Toward, Verdict};
use crate::figure::{Joint, joints};
use crate::scene::Scene;
use crate::text::line;
use crate::wording::failure::{by_amount, sentence, shortened, unsupported_phrase};
use crate::wording::margin::{Parameter, Position, StatedMargin, confirmed, stated};
use crate::wording::number::{counted, listed, place, three};

/// A sentence names at most this many joints or blocks.
const MAX_NAMED: usize = 5;
/// At most this many failures are described one by one.
const MAX_LISTED_FAILURES: usize = 3;

/// Returns the margin whose end shows how a standing frame would fall: load factor, else tilt, else horizontal load.
/// `None` if no end of these has a mechanism.
pub(super) fn toward(found: &FrameAnalysis) -> Option<Toward> {
    let intervals = &found.margins.as_ref()?.intervals;
    let has_edge = |interval: &Option<crate::analysis::Interval>| {
        let ends = interval.iter().flat_map(|i| [i.low(), i.high()]);
        ends.flatten()
            .any(|end| matches!(end, End::At { mechanism, .. } if !mechanism.is_empty()))
    };
    let ways = [
        (&intervals.load_factor, Toward::LoadFactor),
        (&intervals.tilt, Toward::Tilt),
        (&intervals.horizontal_load, Toward::HorizontalLoad),
    ];
    ways.into_iter()
        .find(|way| has_edge(way.0))
        .map(|way| way.1)
}

/// Describes how the frame falls, or how it would fall at the end of its margin. `None` if it is undecided, or if no
/// mechanism is known.
pub(super) fn fails_first(analysis: &Analysis, number: usize) -> Option<String> {
    let (scene, found) = (&analysis.scene, &analysis.frames[number]);
    match found.verdict {
        Verdict::Undecided => None,
        Verdict::Unstable => {
            let mut said: Vec<String> = unsupported_phrase(scene, found).into_iter().collect();
            let failures = by_amount(found);
            let sentences = failures.iter().map(|f: &&Failure| sentence(scene, f));
            said.extend(sentences.take(MAX_LISTED_FAILURES));
            let more = failures.len().saturating_sub(MAX_LISTED_FAILURES);
            if more > 0 {
                said.push(format!("and {} more", counted(more, "failure")));
            }
            said.extend(collapse(analysis, number, &found.mechanism));
            (!said.is_empty()).then(|| line(&format!("{}.", said.join("; "))))
        }
        Verdict::Stable => {
            let toward = toward(found)?;
            let (value, mechanism) = analysis.edge(number, toward)?;
            let when = match toward {
                Toward::LoadFactor => format!("At {} times its loads", three(value)),
                Toward::Tilt => {
                    let side = if value < 0.0 { "left" } else { "right" };
                    format!("If gravity turns {}° to the {side}", three(value.abs()))
                }
                Toward::HorizontalLoad => {
                    let side = if value < 0.0 { "left" } else { "right" };
                    format!("Under {} of its weight to the {side}", three(value.abs()))
                }
            };
            let how = collapse(analysis, number, &mechanism)?;
            Some(line(&format!("{when}, {how}.")))
        }
    }
}

/// Describes how blocks begin to move: `7 blocks move, with 4 hinges: a / b at (1, 2), …`. `None` if the mechanism is
/// empty.
fn collapse(analysis: &Analysis, number: usize, mechanism: &[Motion]) -> Option<String> {
    if mechanism.is_empty() {
        return None;
    }
    let mut moved = Analysis {
        scene: analysis.scene.clone(),
        frames: vec![analysis.frames[number].clone()],
        notes: Vec::new(),
    };
    moved.frames[0].mechanism = mechanism.to_vec();
    let (scene, contacts) = (&analysis.scene, &analysis.frames[number].contacts);
    let found = joints(&moved, 0);
    let at = |joint: &&Joint| {
        let contact = &contacts[joint.contact];
        match joint.hinge {
            Some(point) => format!("{} at {}", name(scene, contact), place(point)),
            None => name(scene, contact),
        }
    };
    let hinges: Vec<String> = found
        .iter()
        .filter(|j| j.hinge.is_some())
        .map(|j| at(&j))
        .collect();
    let slides = found.iter().filter(|j| j.hinge.is_none() && j.slip != 0.0);
    let slides: Vec<String> = slides.map(|j| at(&j)).collect();
    let mut said = Vec::new();
    if !hinges.is_empty() {
        let names = listed(&shortened(hinges.clone(), MAX_NAMED));
        said.push(format!("{}: {names}", counted(hinges.len(), "hinge")));
    }
    if !slides.is_empty() {
        let names = listed(&shortened(slides.clone(), MAX_NAMED));
        said.push(format!(
            "{}: {names}",
            counted(slides.len(), "sliding joint")
        ));
    }
    let verb = if mechanism.len() == 1 {
        "moves"
    } else {
        "move"
    };
    let blocks = format!("{} {verb}", counted(mechanism.len(), "block"));
    Some(match said.is_empty() {
        true => blocks,
        false => format!("{blocks}, with {}", said.join(" and ")),
    })
}

/// Describes changes of loads, friction or gravity that would change the verdict. Returns at most one sentence for
/// each margin that was computed.
pub(super) fn would_take(scene: &Scene, found: &FrameAnalysis) -> Vec<String> {
    stated(scene, found)
        .iter()
        .filter_map(|margin| change(margin, found.verdict))
        .collect()
}

fn change(margin: &StatedMargin<'_>, verdict: Verdict) -> Option<String> {
    let low = margin.interval.low().and_then(confirmed);
    let high = margin.interval.high().and_then(confirmed);
    let now = margin.present.map(|present| present.0).unwrap_or(0.0);
    let inside = margin.position == Position::Inside;
    Some(match (margin.parameter, verdict, inside) {
        (Parameter::LoadFactor, Verdict::Stable, true) => match (low, high) {
            (_, Some(high)) => format!("To fall: its loads times {}.", three(high)),
            _ => "To fall: no multiple of its loads suffices.".to_owned(),
        },
        (Parameter::LoadFactor, Verdict::Unstable, _) => match (low, high) {
            (Some(low), _) if low > 1.0 => format!("To stand: its loads times {}.", three(low)),
            (_, Some(high)) => format!("To stand: its loads times {}.", three(high)),
            _ => "To stand: no factor on its loads suffices.".to_owned(),
        },
        (Parameter::Friction, Verdict::Stable, true) => match low {
            Some(low) if low > 0.0 => {
                format!(
                    "To slide: a friction coefficient below {} instead of {}.",
                    three(low),
                    three(now)
                )
            }
            _ => "Friction is not needed.".to_owned(),
        },
        (Parameter::Friction, Verdict::Unstable, false) => match low {
            Some(low) if low > 0.0 => {
                format!(
                    "To stand: a friction coefficient of {} instead of {}.",
                    three(low),
                    three(now)
                )
            }
            _ => "To stand: no friction suffices.".to_owned(),
        },
        (Parameter::Tilt, Verdict::Stable, _) => {
            let sides = [
                low.map(|v| format!("{}° to the left", three(v.abs()))),
                high.map(|v| format!("{}° to the right", three(v))),
            ];
            let sides: Vec<String> = sides.into_iter().flatten().collect();
            match sides.is_empty() {
                true => return None,
                false => format!("To tip: gravity turned {}.", sides.join(" or ")),
            }
        }
        _ => return None,
    })
}
