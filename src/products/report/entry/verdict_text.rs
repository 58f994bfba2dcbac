//! [`fails_first`] and [`changes_of_verdict`]: sentences about how a frame falls or would fall, and about changes of
//! inputs that would change its verdict.

use super::joints::name;
use crate::mechanics::analysis::{Analysis, End, FALLS, FrameAnalysis, Interval, Motion, STANDS, Toward, Verdict};
use crate::mechanics::scene::Scene;
use crate::products::figure::{Fall, Joint};
use crate::products::wording::failure::{shortened, unsupported_phrase};
use crate::products::wording::margin::{Parameter, Position, StatedMargin, stated};
use crate::products::wording::number::{counted, listed, place, three, three_down, three_up};
use crate::text::line;

/// Largest number of joints of one kind that a sentence names.
const MAX_NAMED: usize = 4;

/// Returns the margin whose end shows how a standing frame would fall. The order of preference is load factor, tilt,
/// horizontal load. Returns `None` if no end of these margins has a mechanism.
pub(super) fn toward(frame_analysis: &FrameAnalysis) -> Option<Toward> {
    let intervals = &frame_analysis.margins.as_ref()?.intervals;
    let has_edge = |interval: &Option<Interval>| {
        let ends = interval.iter().flat_map(|i| [i.low(), i.high()]);
        ends.flatten().any(|end| matches!(end, End::At { mechanism, .. } if !mechanism.is_empty()))
    };
    let ways = [
        (&intervals.load_factor, Toward::LoadFactor),
        (&intervals.tilt, Toward::Tilt),
        (&intervals.horizontal_load, Toward::HorizontalLoad),
    ];
    ways.into_iter().find(|way| has_edge(way.0)).map(|way| way.1)
}

/// Describes how the frame falls, or how it would fall at the end of its margin. Returns `None` if the frame is
/// undecided, or if neither a mechanism nor an unsupported block is known.
pub(super) fn fails_first(analysis: &Analysis, number: usize) -> Option<String> {
    let (scene, frame_analysis) = (&analysis.scene, &analysis.frames[number]);
    match frame_analysis.verdict {
        Verdict::Undecided => None,
        Verdict::Unstable => {
            let mut said: Vec<String> = unsupported_phrase(scene, frame_analysis).into_iter().collect();
            // Use the elementary mechanism, because the figure shows it too.
            let shown = analysis.alone(number)?.elementary();
            said.extend(collapse(analysis, number, &shown.frames[0].mechanism));
            (!said.is_empty()).then(|| line(&format!("{}.", said.join("; "))))
        }
        Verdict::Stable => {
            let toward = toward(frame_analysis)?;
            let (value, mechanism) = analysis.edge(number, toward)?;
            let when = match toward {
                Toward::LoadFactor if value < 1.0 => {
                    format!("Below {} times its loads", three_up(value))
                }
                Toward::LoadFactor => format!("At {} times its loads", three_up(value)),
                Toward::Tilt => {
                    let side = if value < 0.0 { "left" } else { "right" };
                    format!("If gravity turns by {}° to the {side}", three(value.abs()))
                }
                Toward::HorizontalLoad => {
                    let side = if value < 0.0 { "left" } else { "right" };
                    format!("Under a horizontal load of {} times each weight to the {side}", three(value.abs()))
                }
            };
            let how = collapse(analysis, number, &mechanism)?;
            Some(line(&format!("{when}, {how}.")))
        }
    }
}

/// Describes how blocks begin to move: `7 blocks move, with 4 hinges: a / b at (1, 2), …`. Returns `None` if the
/// mechanism is empty.
fn collapse(analysis: &Analysis, number: usize, mechanism: &[Motion]) -> Option<String> {
    if mechanism.is_empty() {
        return None;
    }
    let fall = Fall::with(analysis, number, mechanism);
    let (scene, contacts) = (&analysis.scene, &analysis.frames[number].contacts);
    let at = |joint: &&Joint| {
        let contact = &contacts[joint.contact];
        match joint.hinge {
            Some(point) => {
                let at = place(point, scene.units).replace('-', "−");
                format!("{} at {at}", name(scene, contact))
            }
            None => name(scene, contact),
        }
    };
    let hinges: Vec<String> = fall.joints.iter().filter(|j| j.hinge.is_some()).map(|j| at(&j)).collect();
    let sliding = |tips: bool| -> Vec<String> {
        let slides = fall.joints.iter();
        let slides = slides.filter(|j| j.slip != 0.0 && j.touch.is_some() == tips);
        slides.map(|j| at(&j)).collect()
    };
    let kinds = [(hinges, "hinge"), (sliding(false), "sliding joint"), (sliding(true), "sliding and tipping joint")];
    let said = kinds.into_iter().filter(|(joints, _)| !joints.is_empty());
    let said = said.map(|(joints, kind)| {
        let count = counted(joints.len(), kind);
        format!("{count}: {}", listed(&shortened(joints, MAX_NAMED)))
    });
    let said: Vec<String> = said.collect();
    let moving = fall.moving().count();
    let verb = if moving == 1 { "moves" } else { "move" };
    let blocks = format!("{} {verb}", counted(moving, "block"));
    Some(if said.is_empty() { blocks } else { format!("{blocks}, with {}", said.join(", and ")) })
}

/// Describes which changes of loads, friction or gravity would change the verdict, or states that none would. Returns
/// at most one sentence for each computed margin.
pub(super) fn changes_of_verdict(scene: &Scene, frame_analysis: &FrameAnalysis) -> Vec<String> {
    stated(scene, frame_analysis).iter().filter_map(|margin| change(margin, frame_analysis.verdict)).collect()
}

/// Describes which change of one parameter would change the verdict, or states that none would. Returns `None` if the
/// margin is undecided, or if there is no sentence for this parameter and verdict.
fn change(margin: &StatedMargin<'_>, verdict: Verdict) -> Option<String> {
    if matches!(margin.interval, Interval::Undecided) {
        return None;
    }
    let ends = [margin.interval.low(), margin.interval.high()];
    let is_unconfirmed = |end: &&End| matches!(end, End::Unconfirmed { .. });
    if ends.iter().flatten().any(is_unconfirmed) {
        // The value at which the structure begins to fall is not known, so state only where it is known to stand.
        let (name, sentence) = (&margin.name, margin.sentence());
        return Some(format!("For the {name}, the structure {sentence}."));
    }
    let [low, high] = ends.map(|end| end.and_then(End::value));
    let now = three(margin.present.map_or(0.0, |present| present.0));
    let inside = margin.position == Position::Inside;
    match (margin.parameter, verdict) {
        (Parameter::LoadFactor, Verdict::Stable) if inside => Some(limit_of_loads(low, high)),
        (Parameter::LoadFactor, Verdict::Unstable) => Some(loads_that_stand(low, high)),
        (Parameter::Friction, Verdict::Stable) if inside => Some(match low {
            Some(low) if low > 0.0 => {
                let low = three_down(low);
                format!("The structure would fall with a friction coefficient below {low}; now {now}.")
            }
            _ => "The structure needs no friction.".to_owned(),
        }),
        (Parameter::Friction, Verdict::Unstable) if !inside => Some(match low {
            Some(low) if low > 0.0 => {
                let low = three_up(low);
                format!("The structure would stand with a friction coefficient of {low}; now {now}.")
            }
            _ => "More friction does not help.".to_owned(),
        }),
        (Parameter::Tilt, Verdict::Stable) => limit_of_tilt(low, high),
        _ => None,
    }
}

/// Describes the factors on the loads at which a standing structure would fall. `low` and `high` are the ends of the
/// interval of factors at which it stands.
fn limit_of_loads(low: Option<f64>, high: Option<f64>) -> String {
    match (low.filter(|low| *low > 0.0), high) {
        (Some(low), Some(high)) => format!(
            "The structure would fall at {} times its loads, and below {} times its loads.",
            three_up(high),
            three_down(low)
        ),
        (None, Some(high)) => {
            format!("The structure would fall at {} times its loads.", three_up(high))
        }
        (Some(low), None) => {
            format!("The structure would fall below {} times its loads.", three_down(low))
        }
        (None, None) => format!("The structure {STANDS} at every factor on its loads."),
    }
}

/// Describes the nearest factor on the loads at which a falling structure would stand. `low` and `high` are the ends
/// of the interval of factors at which it stands.
fn loads_that_stand(low: Option<f64>, high: Option<f64>) -> String {
    let factor = match (low, high) {
        (Some(low), _) if low > 1.0 => three_up(low),
        (_, Some(high)) => three_down(high),
        _ => return format!("The structure {FALLS} at every factor on its loads."),
    };
    format!("The structure would stand at {factor} times its loads.")
}

/// Describes how far gravity must turn to each side until a standing structure falls. `low` and `high` are the ends of
/// the interval of tilts at which it stands, in degrees. Returns `None` if both ends are `None`.
fn limit_of_tilt(low: Option<f64>, high: Option<f64>) -> Option<String> {
    let sides = [
        low.map(|v| format!("{}° to the left", three_up(v.abs()))),
        high.map(|v| format!("{}° to the right", three_up(v))),
    ];
    let sides: Vec<String> = sides.into_iter().flatten().collect();
    (!sides.is_empty()).then(|| format!("The structure would fall if gravity turned by {}.", sides.join(" or ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::analysis::Options;

    /// At an end that is not confirmed, the structure is only known to stand: no sentence may say that it falls
    /// there.
    #[test]
    fn no_sentence_says_that_the_structure_falls_at_an_unconfirmed_end() {
        let scene = Scene::from_json(
            r#"{ "drystone": 1, "ground": [{ "polygon": [[-9, -1], [9, -1], [9, 0], [-9, 0]] }],
                 "blocks": [{ "id": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "density": 100 }],
                 "loads": [{ "block": "a", "at": [2, 1], "force": [10, 0] }] }"#,
        )
        .expect("a valid scene");
        let mut analysis = Analysis::with(&scene, &Options::default().margins(true));
        let frame = &mut analysis.frames[0];
        let margins = frame.margins.as_mut().expect("margins were requested");
        margins.intervals.load_factor = Some(Interval::Between {
            low: End::At { value: 0.0, mechanism: Vec::new() },
            high: End::Unconfirmed { stands: 2.0, beyond: 2.5 },
        });
        let said = changes_of_verdict(&scene, frame);
        let expected = "(upper end not confirmed: between 2 and 2.5)";
        assert!(said[0].contains(expected), "{said:?}");
        assert!(!said.iter().any(|s| s.contains("times its loads")), "{said:?}");
    }
}
