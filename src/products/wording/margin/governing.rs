//! [`governing`] states a frame's headline margin in a few words, for the line of the verdict below a picture, with the
//! collapse at its limit; for a falling frame what it lacks to stand.

use super::{StatedMargin, confirmed, friction, stated};
use crate::geometry::range_of;
use crate::mechanics::analysis::{End, FrameAnalysis, Interval, MarginKind, Motion, SolvedFrame, Verdict};
use crate::mechanics::scene::Scene;
use crate::products::wording::number::{NO_BREAK, digits, three_down, three_up};
use crate::products::wording::question;

/// The needed friction is stated if it is at least this fraction of the present friction.
const NEAR_FRICTION: f64 = 0.8;

/// The friction of all joints, if it is not the present one.
#[derive(Clone, Copy, Debug)]
pub enum OtherFriction {
    /// All joints have this coefficient.
    Coefficient(f64),
    /// All joints have their coefficient times this factor.
    Factor(f64),
}

impl OtherFriction {
    /// Returns the friction coefficient of a joint with a `present` coefficient.
    pub fn of(self, present: f64) -> f64 {
        match self {
            OtherFriction::Coefficient(friction) => friction,
            OtherFriction::Factor(factor) => factor * present,
        }
    }
}

/// The words after a verdict, and the motion to which they belong.
#[derive(Clone, Debug, Default)]
pub struct Governing<'a> {
    /// The margins in words, the headline margin first: `carries 2.81 × its loads`. Rounded to the safe side.
    pub words: Vec<String>,
    /// The parameter of the first margin; `None` for a frame that falls.
    pub kind: Option<MarginKind>,
    /// What the first margin is a value of: `this load`, `this tilt`. Empty for a frame that falls.
    pub at: &'static str,
    /// The collapse just beyond the first margin; for a frame that falls, its own collapse. Empty if it is not known.
    pub mechanism: &'a [Motion],
    /// The friction of all joints at which this collapse happens, if it is not the present one.
    pub friction: Option<OtherFriction>,
}

/// Returns the headline margin of a frame in words, followed by its tilt and its friction if they say more. The list is
/// empty if no margins were computed, or if the frame is undecided.
pub fn governing<'a>(solved: SolvedFrame<'a>) -> Governing<'a> {
    let SolvedFrame { scene, number, found, .. } = solved;
    let placed = &scene.frames[number].placed;
    let loads = scene.loads_on(placed).len();
    let mut governing = match found.verdict {
        Verdict::Undecided => Governing::default(),
        Verdict::Unstable => Governing {
            words: lack(solved).into_iter().chain(corners(found)).collect(),
            mechanism: &found.mechanism,
            ..Governing::default()
        },
        Verdict::Stable => reserves(solved, if loads == 1 { "load" } else { "loads" }),
    };
    if let Some(words) = question::vehicle_headline(solved) {
        // What the vehicle does is what the scene asks. The other margins of a frame that stands do not contain it.
        governing.words = vec![words];
        if let Some(influence) = found.vehicle.as_ref().filter(|_| found.verdict == Verdict::Stable) {
            governing = Governing {
                kind: Some(MarginKind::LoadFactor),
                at: "this load",
                mechanism: &influence.mechanism,
                friction: None,
                ..governing
            };
        }
    }
    if let Some(words) = question::movement_headline(solved) {
        governing.words.insert(0, words);
    }
    governing.words.extend(question::worst_case(found));
    governing
}

/// Says that a frame that falls would stand if corners carried force.
fn corners(found: &FrameAnalysis) -> Option<String> {
    found.corners_decide.then(|| "stands if corners carry".to_owned())
}

/// Returns the same words as one text, for tables: `carries 2.81 × its load · falls at 19° of tilt`.
#[cfg(any(feature = "report", feature = "cli"))]
pub fn headline(solved: SolvedFrame<'_>) -> String {
    governing(solved).words.join(" · ")
}

fn reserves<'a>(solved: SolvedFrame<'a>, load: &str) -> Governing<'a> {
    let SolvedFrame { scene, found, .. } = solved;
    let margins = stated(solved);
    let has_factor = margins.iter().any(|margin| margin.kind == MarginKind::FrictionFactor);
    let has_sets = scene.factored_sets().next().is_some();
    let mut governing = Governing::default();
    for (place, margin) in margins.iter().enumerate() {
        let is_more = match margin.kind {
            MarginKind::Tilt => true,
            // One coefficient everywhere is another structure than one with several. Then the factor is stated.
            MarginKind::Friction => {
                !((margin.differs() || has_sets) && has_factor) && friction_share(margin, found) >= NEAR_FRICTION
            }
            MarginKind::FrictionFactor => least(margin) >= NEAR_FRICTION,
            _ => false,
        };
        let Some((words, end)) = reserve(margin, scene, found, load).filter(|_| place == 0 || is_more) else {
            continue;
        };
        governing.kind.get_or_insert(margin.kind);
        if governing.words.is_empty()
            && let Some(End::At { mechanism, value }) = end
        {
            governing.mechanism = mechanism;
            governing.friction = match margin.kind {
                MarginKind::Friction => Some(OtherFriction::Coefficient(*value)),
                MarginKind::FrictionFactor => Some(OtherFriction::Factor(*value)),
                _ => None,
            };
            governing.at = margin.kind.about().at;
        }
        governing.words.push(words + &elsewhere(margin, end, found));
    }
    governing
}

/// Names the load case of an end in brackets if the forces of the frame belong to another one.
fn elsewhere(margin: &StatedMargin<'_>, end: Option<&End>, found: &FrameAnalysis) -> String {
    let is_low = end.zip(margin.interval.low()).is_some_and(|(end, low)| std::ptr::eq(end, low));
    let condition = margin.conditions[usize::from(!is_low)];
    let is_same = condition.case == found.condition().case;
    let name = question::conditions(found, [condition]).filter(|_| !is_same);
    name.map_or_else(String::new, |name| format!(" ({name})"))
}

/// Returns the least value with which the frame stands; 0 if there is none.
fn least(margin: &StatedMargin<'_>) -> f64 {
    margin.interval.low().and_then(confirmed).unwrap_or(0.0)
}

/// Returns the needed friction as a fraction of the least present friction.
fn friction_share(margin: &StatedMargin<'_>, found: &FrameAnalysis) -> f64 {
    friction(found).map_or(0.0, |(present, _)| least(margin) / present)
}

/// States a factor on the friction, with the coefficient in brackets if all joints that it multiplies have the same.
fn times_friction(factor: f64, scene: &Scene, found: &FrameAnalysis) -> String {
    let joints = found.contacts.iter().map(|contact| &contact.interface);
    let factored = joints.filter(|joint| scene.has_factored_friction(joint.bodies, joint.normal));
    let rough = factored.map(|joint| joint.friction).filter(|friction| *friction > 0.0);
    let (least, most) = range_of(rough);
    let coefficient = if least == most { format!(" ({})", three_up(factor * most)) } else { String::new() };
    format!("{} × {}{coefficient}", three_up(factor), question::factored_friction(scene))
}

/// States a margin of a frame that stands, and the end of its interval to which the words belong. `None` if the
/// parameter has no limit.
fn reserve<'a>(
    margin: &StatedMargin<'a>,
    scene: &Scene,
    found: &FrameAnalysis,
    load: &str,
) -> Option<(String, Option<&'a End>)> {
    let (low, high) = (margin.interval.low(), margin.interval.high());
    let value = |end: Option<&'a End>| Some((confirmed(end?)?, end));
    // The nearer end, and its side if the other end is farther away.
    let nearest = || {
        let sides = [(value(low), " to the left"), (value(high), " to the right")];
        let sides = sides.into_iter().filter_map(|(end, side)| Some((end?.0.abs(), end?.1, side)));
        let mut sides: Vec<(f64, Option<&'a End>, &str)> = sides.collect();
        sides.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (near, end, side) = *sides.first()?;
        let is_alike = sides.get(1).is_some_and(|other| three_down(other.0) == three_down(near));
        Some((near, end, if is_alike { "" } else { side }))
    };
    match margin.kind {
        MarginKind::LoadFactor => {
            if let Some((factor, end)) = value(high) {
                return Some((format!("carries {} × its {load}", three_down(factor)), end));
            }
            // Some structures fall if their loads, such as a counterweight, become smaller.
            let (factor, end) = value(low).filter(|(factor, _)| *factor > 0.0)?;
            Some((format!("needs {} × its {load}", three_up(factor)), end))
        }
        MarginKind::Tilt => {
            let (angle, end, side) = nearest()?;
            Some((format!("falls at {}° of tilt{side}", three_down(angle)), end))
        }
        MarginKind::HorizontalLoad => {
            let (share, end, side) = nearest()?;
            let side = if side.is_empty() { " sideways" } else { side };
            Some((format!("falls at {} × its weight{side}", three_down(share)), end))
        }
        MarginKind::Friction => {
            let (needed, end) = value(low).filter(|(needed, _)| *needed > 0.0)?;
            let (least, most) = friction(found)?;
            let needed = three_up(needed);
            let words = if least < most {
                let smooth = if least == 0.0 { ", smooth ones too" } else { "" };
                format!("needs friction {needed} of {}–{}, the same at all joints{smooth}", digits(least), digits(most))
            } else {
                format!("needs friction {needed} of {}", digits(least))
            };
            Some((words, end))
        }
        MarginKind::FrictionFactor => {
            let (needed, end) = value(low).filter(|(needed, _)| *needed > 0.0)?;
            Some((format!("stands down to {}", times_friction(needed, scene, found)), end))
        }
        MarginKind::Kernel => {
            let (kernel, end) = value(high)?;
            Some((format!("stands up to a kernel of {}", three_down(kernel)), end))
        }
        _ => None,
    }
}

/// Describes what a falling frame lacks to stand: `carries 33 % of its load`. Returns `None` if the frame stands or is
/// undecided, or if no computed margin shows what is lacking.
pub(super) fn lack(solved: SolvedFrame<'_>) -> Option<String> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    if frame_analysis.verdict != Verdict::Unstable {
        return None;
    }
    let margins = frame_analysis.margins.as_ref()?;
    let loads = margins.of(MarginKind::LoadFactor).and_then(|interval| load_lack(scene, interval));
    // What friction cannot hold, corners can.
    if frame_analysis.corners_decide {
        return loads;
    }
    loads
        .or_else(|| factor_lack(solved, margins.of(MarginKind::FrictionFactor)?))
        .or_else(|| friction_lack(frame_analysis, margins.of(MarginKind::Friction)?))
}

/// Describes the factor on the friction with which a frame of different coefficients would stand, or states that no factor
/// would hold it. Returns `None` if all coefficients are equal, or if the factor is not known.
fn factor_lack(solved: SolvedFrame<'_>, interval: &Interval) -> Option<String> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let has_sets = scene.factored_sets().next().is_some();
    friction(frame_analysis).filter(|(least, most)| least < most || has_sets)?;
    match interval {
        Interval::Empty(_) => Some(format!("no multiple of {} would hold it", question::factored_friction(scene))),
        Interval::Undecided => None,
        Interval::Between { low, .. } => {
            let needed = confirmed(low).filter(|needed| *needed > 1.0)?;
            Some(format!("would need {}", times_friction(needed, scene, frame_analysis)))
        }
    }
}

/// Describes which fraction of its loads a falling frame carries, or how many times its loads it would need to stand.
/// Returns `None` if neither is known.
fn load_lack(scene: &Scene, interval: &Interval) -> Option<String> {
    let mut entries: Vec<usize> = scene.loads.iter().map(|load| load.entry).collect();
    entries.dedup();
    let loads = match entries.len() {
        1 => "load",
        _ => "loads",
    };
    let [low, high] = [interval.low()?, interval.high()?].map(confirmed);
    match (low, high) {
        // Round down, so that the frame carries at least the written fraction.
        (_, Some(high)) if high < 1.0 => Some(if high >= 0.01 {
            format!("carries {}{NO_BREAK}% of its {loads}", three_down(100.0 * high))
        } else {
            format!("carries less than 1{NO_BREAK}% of its {loads}")
        }),
        (Some(low), _) if low > 1.0 => Some(format!("would need {} times its {loads}", three_up(low))),
        _ => None,
    }
}

/// Describes the friction coefficient with which a falling frame would stand, or states that no coefficient would hold
/// it. Returns `None` if the smallest present coefficient is large enough, if the margin is undecided, or if there are
/// no interfaces.
fn friction_lack(frame_analysis: &FrameAnalysis, interval: &Interval) -> Option<String> {
    let (least, most) = friction(frame_analysis)?;
    match interval {
        Interval::Empty(_) => Some("no friction coefficient would hold it".to_owned()),
        Interval::Undecided => None,
        Interval::Between { low, .. } => {
            let low = confirmed(low).filter(|low| *low > least)?;
            let everywhere = match least < most {
                true if least == 0.0 => " at every joint, smooth ones too",
                true => " at every joint",
                false => "",
            };
            Some(format!("would need friction {}{everywhere}", three_up(low)))
        }
    }
}
