//! [`Step`]: the content of a report on one frame.

use super::bullet::{self, MarginBar};
use super::chosen::chosen;
use super::cost::cost;
use super::{Chart, Figure, Grid, HoverTarget, ReportOptions};
use crate::analysis::{Analysis, Contact, EffectName, Failure, FrameAnalysis, Verdict};
use crate::chart::{self, Bars};
use crate::figure::{self, Kind, Options};
use crate::geometry::Point;
use crate::interface::ContactKind;
use crate::scene::{BodyId, Scene};
use crate::text::line;
use crate::wording::number::{digits, letter, listed, percent, place, prefixed};
use crate::wording::{failure, proof, verdict};

/// Width of a figure, in pixels.
const WIDTH: f64 = 560.0;
/// With fewer interfaces, a table shows more than a chart.
const MIN_CHART_INTERFACES: usize = 8;
/// Figures with more interfaces than this get no hover targets: the page would become too large.
const MAX_HOVER_TARGETS: usize = 3000;

/// The content of a report on one frame.
#[derive(Clone, Debug)]
pub struct Step {
    /// Its letter in a strip of frames; empty for a single frame.
    pub letter: String,
    /// Its title, or `Step 3`.
    pub title: String,
    /// The verdict.
    pub verdict: Verdict,
    /// A sentence with the verdict and its reasons.
    pub sentence: String,
    /// More sentences.
    pub remarks: Vec<String>,
    /// The figures.
    pub plates: Vec<Figure>,
    /// The hover targets in the first figure, one for each row of the tables.
    pub touches: Vec<HoverTarget>,
    /// The margins, if they were computed.
    pub bullets: Vec<MarginBar>,
    /// Charts of the forces.
    pub charts: Vec<Chart>,
    /// The tables, most important first, without empty ones.
    pub grids: Vec<Grid>,
    /// An explanation of the proof.
    pub proof: String,
}

/// Whether a frame has a collapse mechanism to show.
pub(super) fn has_mechanism(found: &FrameAnalysis) -> bool {
    found.verdict == Verdict::Unstable && !found.mechanism.is_empty()
}

/// The options for figures in a report: the page shows titles and verdicts next to them.
pub(super) fn options(wanted: &ReportOptions) -> Options {
    Options {
        theme: wanted.theme.clone(),
        titles: false,
        captions: false,
        verdicts: false,
        // Half the width of a page: the labels are legible there and on a phone.
        width: Some(WIDTH),
        ..Options::default()
    }
}

/// All steps of an analysis.
pub(super) fn all(analysis: &Analysis, wanted: &ReportOptions) -> Vec<Step> {
    let options = options(wanted);
    let chosen = chosen(analysis);
    let drawn = |frame: &usize| chosen[*frame];
    let falls = |frame: &usize| has_mechanism(&analysis.frames[*frame]);
    let all = 0..analysis.frames.len();
    let frames: Vec<usize> = all.clone().filter(drawn).collect();
    let mut forces = figure::panels_of(analysis, Kind::Forces, &options, &frames).into_iter();
    let falling: Vec<usize> = all.filter(drawn).filter(falls).collect();
    let mut motions = match falling.is_empty() {
        true => Vec::new(),
        false => figure::panels_of(analysis, Kind::Mechanism, &options, &falling),
    }
    .into_iter();
    let scene = &analysis.scene;
    let mut steps = Vec::with_capacity(analysis.frames.len());
    for (number, found) in analysis.frames.iter().enumerate() {
        let mut step = without_figures(scene, number, found, (wanted, chosen[number]));
        let Some(drawing) = chosen[number].then(|| forces.next()).flatten() else {
            steps.push(step);
            continue;
        };
        step.plates.push(Figure {
            caption: if found.failures.is_empty() {
                "The forces on every block. The length of an arrow shows its size.".into()
            } else {
                "The forces on every block. The missing forces have the colour of failures.".into()
            },
            drawing,
        });
        if let Some(drawing) = has_mechanism(found).then(|| motions.next()).flatten() {
            step.plates.push(Figure {
                caption: "How it begins to fall. Dashed: the blocks before they move.".into(),
                drawing,
            });
        }
        steps.push(step);
    }
    steps
}

/// The text and tables of a frame, without figures. A frame that is not drawn gets the reasons of its verdict only.
fn without_figures(
    scene: &Scene,
    number: usize,
    found: &FrameAnalysis,
    (wanted, drawn): (&ReportOptions, bool),
) -> Step {
    let several = scene.frames.len() > 1;
    let title = line(&scene.frames[number].title);
    let mut step = Step {
        letter: if several {
            letter(number)
        } else {
            String::new()
        },
        title: if title.is_empty() && several {
            format!("Step {}", number + 1)
        } else {
            title
        },
        verdict: found.verdict,
        sentence: line(&verdict::sentence(scene, found)),
        remarks: remarks(found),
        plates: Vec::new(),
        touches: Vec::new(),
        bullets: bullet::margin_bars(scene, found),
        charts: Vec::new(),
        grids: Vec::new(),
        proof: proof::sentence(found.proof),
    };
    if !drawn {
        let grids = [totals(scene, number, found), failures(scene, found)];
        step.grids = grids.into_iter().filter(|g| !g.lines.is_empty()).collect();
        return step;
    }
    step.touches = touches(scene, found);
    step.charts = charts(found);
    let grids = [
        totals(scene, number, found),
        failures(scene, found),
        interfaces(scene, found),
        robots(scene, found),
        cost(found, wanted.timing),
        proved(found),
    ];
    step.grids = grids.into_iter().filter(|g| !g.lines.is_empty()).collect();
    step
}

fn remarks(found: &FrameAnalysis) -> Vec<String> {
    let mut remarks = Vec::new();
    if !found.least_force && found.verdict == Verdict::Stable {
        remarks.push(
            "These forces balance. It was not proved that their total is the smallest.".to_owned(),
        );
    }
    let wedging = found
        .effects
        .iter()
        .find(|e| e.effect == EffectName::Wedging && e.simulated);
    if let Some(wedging) = wedging.filter(|_| found.only_by_wedging != Some(false)) {
        remarks.push(format!("Wedging: {}.", line(&wedging.why)));
    }
    let about_margins = found
        .margins
        .iter()
        .flat_map(|margins| &margins.intervals.notes);
    let notes = found.notices.iter().chain(about_margins);
    remarks.extend(notes.map(|n| format!("Note: {}.", line(n))));
    remarks
}

fn totals(scene: &Scene, number: usize, found: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new("In numbers", &["what", "#how much"]);
    let mut add = |what: &str, much: String| grid.add("", [what.to_owned(), much]);
    add("blocks", scene.frames[number].placed.len().to_string());
    add(
        "weight of all blocks",
        format!("{} N", digits(found.weight)),
    );
    add(
        "total force: sum of all normal, friction and robot forces",
        format!("{} N", digits(found.total_force)),
    );
    if found.total_sticking > 0.0 {
        add(
            "total sticking: the least adhesion with which it would stand",
            format!("{} N", digits(found.total_sticking)),
        );
    }
    let largest = found
        .contacts
        .iter()
        .max_by(|a, b| size(a).total_cmp(&size(b)));
    if let Some(largest) = largest {
        let between = failure::pair(scene, largest.interface.bodies);
        add(
            &line(&format!(
                "largest force at an interface{}, between {between}",
                force_qualifier(found)
            )),
            format!("{} N", digits(size(largest))),
        );
    }
    grid
}

fn size(contact: &Contact) -> f64 {
    contact.resultant.force.norm()
}

fn sum(contact: &Contact) -> f64 {
    contact.normal_forces[0] + contact.normal_forces[1]
}

/// The eccentricity of a resultant: 0 in the middle of its interface, 1 at an end; `None` without force or length.
fn off_middle(contact: &Contact) -> Option<f64> {
    let length = contact.interface.length();
    if contact.interface.kind == ContactKind::Corner || length <= 0.0 || size(contact) == 0.0 {
        return None;
    }
    let off = (contact.resultant.at - contact.interface.middle()).dot(&contact.interface.tangent());
    Some((2.0 * off.abs() / length).min(1.0))
}

/// A qualifier for table captions: the forces of a falling frame include missing forces.
fn force_qualifier(found: &FrameAnalysis) -> &'static str {
    match found.verdict {
        Verdict::Stable => "",
        Verdict::Unstable => ", with the missing forces added",
        Verdict::Undecided => ", not proved",
    }
}

fn interfaces(scene: &Scene, found: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new(
        format!("Interfaces{}", force_qualifier(found)),
        &[
            "between",
            "#normal force N, N",
            "#friction force T, N",
            "#friction used",
            "#resultant, from the middle to the edge",
        ],
    );
    for (number, contact) in found.contacts.iter().enumerate() {
        let between = failure::pair(scene, contact.interface.bodies);
        let sits = match (contact.interface.kind, off_middle(contact)) {
            (ContactKind::Corner, _) => "a corner".to_owned(),
            (_, Some(off)) => percent(off),
            (_, None) => "no force".to_owned(),
        };
        let cells = [
            line(&between),
            digits(sum(contact)),
            digits(contact.friction_force.abs()),
            percent(contact.friction_used),
            sits,
        ];
        grid.add(format!("i{number}"), cells);
    }
    grid
}

fn robots(scene: &Scene, found: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new(
        format!("Robots{}", force_qualifier(found)),
        &[
            "robot",
            "holds",
            "#force to the right, N",
            "#force up, N",
            "#torque, N·m",
            "#limit used",
        ],
    );
    for (number, robot) in found.robots.iter().enumerate() {
        let limits = scene.robots[robot.robot.0].limits;
        let limited = [limits.fx, limits.fy, limits.torque]
            .iter()
            .any(|l| l.is_finite() && *l > 0.0);
        let cells = [
            line(&scene.robots[robot.robot.0].id),
            line(&scene.blocks[robot.block.0].id),
            digits(robot.force.x),
            digits(robot.force.y),
            digits(robot.torque),
            if limited {
                percent(robot.limit_used)
            } else {
                "no limit".into()
            },
        ];
        grid.add(format!("r{number}"), cells);
    }
    grid
}

fn failures(scene: &Scene, found: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new("What fails", &["what", "#missing"]);
    for what in failure::unsupported(scene, found, usize::MAX) {
        grid.add("", [line(&what), "all of it".to_owned()]);
    }
    for (number, failed) in found.failures.iter().enumerate() {
        let cells = [
            line(&failure::sentence(scene, failed)),
            failure::amount_with_unit(failed),
        ];
        grid.add(format!("f{number}"), cells);
    }
    grid
}

fn proved(found: &FrameAnalysis) -> Grid {
    let mut grid = Grid::new("The proof in numbers", &["what", "#how much"]);
    for (what, much) in proof::numbers(found.proof) {
        grid.add("", [what.to_owned(), much]);
    }
    grid
}

fn charts(found: &FrameAnalysis) -> Vec<Chart> {
    if found.contacts.len() < MIN_CHART_INTERFACES {
        return Vec::new();
    }
    let largest = found.contacts.iter().map(size).fold(0.0, f64::max);
    let (unit, factor) = prefixed(largest, "N");
    let forces: Vec<f64> = found.contacts.iter().map(|c| size(c) * factor).collect();
    let used: Vec<f64> = found
        .contacts
        .iter()
        .filter(|c| sum(c) > 0.0)
        .map(|c| 100.0 * c.friction_used)
        .collect();
    let kinds = [
        (
            "Number of interfaces by force",
            format!("force at an interface, {unit}"),
            Bars::counted(&forces, None),
        ),
        (
            "Number of loaded interfaces by share of friction used",
            "friction used, %".to_owned(),
            Bars::counted(&used, Some(100.0)),
        ),
    ];
    let drawn = kinds.into_iter().filter_map(|(caption, x, bars)| {
        let caption = format!("{caption}{}", force_qualifier(found));
        let chart = Bars {
            title: caption.clone(),
            x,
            y: "interfaces".to_owned(),
            ..bars
        };
        // Without any force there is no chart.
        let svg = chart::bars(&chart).ok()?;
        Some(Chart { caption, svg })
    });
    drawn.collect()
}

fn touches(scene: &Scene, found: &FrameAnalysis) -> Vec<HoverTarget> {
    if found.contacts.len() > MAX_HOVER_TARGETS {
        return Vec::new();
    }
    let mut touches = Vec::new();
    for (number, contact) in found.contacts.iter().enumerate() {
        let mut parts = vec![
            format!("normal force {} N", digits(sum(contact))),
            format!("friction force {} N", digits(contact.friction_force.abs())),
            format!(
                "friction used {}{}",
                percent(contact.friction_used),
                match found.verdict {
                    Verdict::Stable => "",
                    Verdict::Unstable => " (missing forces added)",
                    Verdict::Undecided => " (not proved)",
                }
            ),
        ];
        if let Some(off) = off_middle(contact) {
            parts.push(format!(
                "resultant {} from the middle to the edge",
                percent(off)
            ));
        }
        let between = failure::pair(scene, contact.interface.bodies);
        touches.push(HoverTarget {
            mark: format!("i{number}"),
            words: line(&format!("Interface between {between}: {}", listed(&parts))),
            ends: contact.interface.ends,
        });
    }
    for (number, robot) in found.robots.iter().enumerate() {
        let id = &scene.robots[robot.robot.0].id;
        let held = failure::named(scene, BodyId::Block(robot.block));
        let (x, y, turn) = (
            digits(robot.force.x),
            digits(robot.force.y),
            digits(robot.torque),
        );
        let words = format!(
            "Robot {id} holds {held} at {}: force ({x}, {y}) N, torque {turn} N·m",
            place(robot.at)
        );
        touches.push(touch(format!("r{number}"), &words, robot.at));
    }
    for (number, failed) in found.failures.iter().enumerate() {
        let at = match failed {
            Failure::Tension { at, .. }
            | Failure::Friction { at, .. }
            | Failure::RobotForce { at, .. }
            | Failure::RobotTorque { at, .. } => *at,
        };
        let words = format!("Failure: {}", failure::sentence(scene, failed));
        touches.push(touch(format!("f{number}"), &words, at));
    }
    touches
}

fn touch(mark: String, words: &str, at: Point) -> HoverTarget {
    HoverTarget {
        mark,
        words: line(words),
        ends: [at, at],
    }
}
