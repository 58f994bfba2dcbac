//! Makes facts from an analysis, and text from facts.

use super::round::Rounding;
use super::{Fact, Facts, Section, Value, Version};
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Analysis, Contact, Failure, FrameAnalysis, RobotForce, Verdict};
use crate::mechanics::scene::{BlockId, BodyId, Load, RobotId, Scene};
use crate::text;

/// The significant digits of a force that is as large as the largest weight or load.
pub const DIGITS: usize = 6;
/// The first line of a facts file, without the version of the format.
pub(super) const FIRST_WORDS: &str = "drystone facts ";
/// Blocks slower than this are not reported as falling; the fastest point of a mechanism has speed 1. Another optimum
/// of the same linear program may leave such a slow block at rest, so the fact would not be reproducible.
const MIN_FALLING_SPEED: f64 = 1e-3;

/// The decimal places to which the quantities of one scene are rounded.
struct Roundings {
    force: Rounding,
    length: Rounding,
    torque: Rounding,
}

pub(super) fn from_analysis(analysis: &Analysis, digits: usize) -> Facts {
    let scene = &analysis.scene;
    let blocks = scene.blocks.iter().map(|b| b.weight.abs());
    let loads = scene.loads.iter().map(|l| l.force.norm());
    let largest = blocks.chain(loads).fold(0.0, f64::max);
    let corners = scene.blocks.iter().flat_map(|b| b.body.polygon.outline());
    let size = corners.map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
    let roundings = Roundings {
        force: Rounding::new(digits, largest),
        length: Rounding::new(digits, size),
        torque: Rounding::new(digits, largest * size),
    };
    let gravity = Rounding::new(digits, scene.gravity.norm());
    let gravity = quantity("gravity", &pair(scene.gravity), gravity, "m/s²");
    let mut values = vec![gravity];
    if scene.kernel > 0.0 {
        values.push(unitless("kernel", scene.kernel));
    }
    let mut sections = vec![Section {
        head: Fact { kind: "scene".into(), names: vec![name(&scene.title)], values },
        facts: causes(scene, &roundings),
    }];
    for (number, (step, found)) in scene.frames.iter().zip(&analysis.frames).enumerate() {
        let head = Fact {
            kind: format!("frame {}", number + 1),
            names: vec![name(&step.title)],
            values: vec![word(verdict(found.verdict))],
        };
        let facts = frame(scene, step.placed.len(), found, &roundings);
        sections.push(Section { head, facts });
    }
    Facts { version: Version::Two, sections }
}

/// Returns the facts of the scene itself, such as blocks and loads. A user edits these facts, so they cause the changes
/// of the results.
fn causes(scene: &Scene, roundings: &Roundings) -> Vec<Fact> {
    let blocks = scene.blocks.iter().map(|block| Fact {
        kind: "block".into(),
        names: vec![name(&block.id)],
        values: vec![
            quantity("weight", &[block.weight], roundings.force, "N"),
            quantity("centroid", &[block.centroid.x, block.centroid.y], roundings.length, "m"),
            unitless("μ", block.body.friction),
        ],
    });
    let pairs = scene.friction_pairs.iter().map(|(pair, friction)| {
        let mut names = pair.map(|material| name(&scene.materials[material].name));
        names.sort();
        coefficient("friction", names.to_vec(), *friction)
    });
    let listed = scene.contacts.iter().map(|contact| {
        let names = bodies(scene, contact.bodies);
        coefficient("contact", names, contact.friction)
    });
    let robots = scene.robots.iter().map(|robot| Fact {
        kind: "limits".into(),
        names: vec![name(&robot.id)],
        values: vec![
            quantity("horizontal", &[robot.limits.fx], roundings.force, "N"),
            quantity("vertical", &[robot.limits.fy], roundings.force, "N"),
            quantity("torque", &[robot.limits.torque], roundings.torque, "N·m"),
        ],
    });
    let loads = scene.loads.iter().map(|given| load(scene, given, roundings));
    (blocks.chain(pairs).chain(listed).chain(robots).chain(loads)).collect()
}

/// Makes a fact whose only value is a friction coefficient.
fn coefficient(kind: &str, names: Vec<String>, friction: f64) -> Fact {
    Fact { kind: kind.into(), names, values: vec![unitless("μ", friction)] }
}

fn load(scene: &Scene, load: &Load, roundings: &Roundings) -> Fact {
    let mut values = vec![
        quantity("force", &pair(load.force), roundings.force, "N"),
        quantity("at", &[load.at.x, load.at.y], roundings.length, "m"),
    ];
    if load.torque != 0.0 {
        values.push(quantity("torque", &[load.torque], roundings.torque, "N·m"));
    }
    Fact { kind: "load".into(), names: vec![name(&scene.blocks[load.block.0].id)], values }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stable",
        Verdict::Unstable => "unstable",
        Verdict::Undecided => "undecided",
    }
}

fn frame(scene: &Scene, placed: usize, found: &FrameAnalysis, roundings: &Roundings) -> Vec<Fact> {
    let newtons = |name: &str, value: f64| quantity(name, &[value], roundings.force, "N");
    let mut sums = vec![unitless("blocks", placed as f64), newtons("weight", found.weight)];
    let proved = found.verdict != Verdict::Undecided;
    if proved {
        sums.push(newtons("total force", found.total_force));
        sums.push(newtons("total sticking", found.total_sticking));
    }
    let mut facts = vec![Fact { kind: "sums".into(), names: Vec::new(), values: sums }];
    let contacts = found.contacts.iter().map(|c| contact(scene, c, proved, roundings));
    facts.extend(contacts);
    if proved {
        facts.extend(found.robots.iter().map(|r| robot(scene, r, roundings)));
        facts.extend(found.failures.iter().map(|f| failure(scene, f, roundings)));
    }
    let moves = found.mechanism.iter().filter(|m| {
        let speed = m.velocity.norm().max(m.spin.abs() * found.length);
        speed > MIN_FALLING_SPEED
    });
    let mut falling: Vec<BlockId> = moves.map(|m| m.block).collect();
    falling.extend(&found.unsupported);
    falling.sort();
    falling.dedup();
    facts.extend(falling.iter().map(|block| Fact {
        kind: "block".into(),
        names: vec![name(&scene.blocks[block.0].id)],
        values: vec![word("falls")],
    }));
    facts
}

fn contact(scene: &Scene, contact: &Contact, proved: bool, roundings: &Roundings) -> Fact {
    let [n1, n2] = contact.normal_forces;
    let mut values = Vec::new();
    if proved {
        values.push(quantity("N", &[n1 + n2], roundings.force, "N"));
        values.push(quantity("T", &[contact.friction_force], roundings.force, "N"));
        let ends = sorted_by_position(contact.application_points, [n1, n2]);
        values.push(quantity("N at its ends", &ends, roundings.force, "N"));
    }
    values.push(unitless("μ", contact.interface.friction));
    Fact { kind: "interface".into(), names: bodies(scene, contact.interface.bodies), values }
}

/// Returns the forces at two points, sorted by the positions of the points along a fixed direction. The facts
/// therefore do not depend on the order of the points in the result. The direction has an irrational slope (0.38…,
/// from the golden ratio), so that two different points hardly ever have the same position along it.
fn sorted_by_position(at: [Point; 2], forces: [f64; 2]) -> [f64; 2] {
    let along = |p: Point| p.x + 0.381_966_011_25 * p.y;
    let [a, b] = forces;
    if along(at[0]) <= along(at[1]) { [a, b] } else { [b, a] }
}

/// Returns the sorted names of two bodies, with the ground last. The facts therefore do not depend on the order of
/// the bodies in the result.
fn bodies(scene: &Scene, bodies: [BodyId; 2]) -> Vec<String> {
    let mut names: Vec<(bool, String)> =
        bodies.iter().map(|b| (matches!(b, BodyId::Ground(_)), name(scene.name(*b)))).collect();
    names.sort();
    names.into_iter().map(|(_, name)| name).collect()
}

fn robot(scene: &Scene, robot: &RobotForce, roundings: &Roundings) -> Fact {
    Fact {
        kind: "robot".into(),
        names: grip(scene, robot.robot, robot.block),
        values: vec![
            quantity("force", &pair(robot.force), roundings.force, "N"),
            quantity("torque", &[robot.torque], roundings.torque, "N·m"),
        ],
    }
}

fn grip(scene: &Scene, robot: RobotId, block: BlockId) -> Vec<String> {
    let (robot, block) = (&scene.robots[robot.0], &scene.blocks[block.0]);
    vec![name(&robot.id), name(&block.id)]
}

fn failure(scene: &Scene, failure: &Failure, roundings: &Roundings) -> Fact {
    let newtons = |amount: f64| vec![quantity("missing", &[amount], roundings.force, "N")];
    let (kind, names, values) = match *failure {
        Failure::Tension { bodies: b, force, .. } => ("failure tension", bodies(scene, b), newtons(force.norm())),
        Failure::Friction { bodies: b, force, .. } => ("failure friction", bodies(scene, b), newtons(force.norm())),
        Failure::RobotForce { robot, block, force, .. } => {
            ("failure robot", grip(scene, robot, block), vec![quantity("missing", &pair(force), roundings.force, "N")])
        }
        Failure::RobotTorque { robot, block, torque, .. } => {
            ("failure robot", grip(scene, robot, block), vec![quantity("missing", &[torque], roundings.torque, "N·m")])
        }
    };
    Fact { kind: kind.into(), names, values }
}

fn pair(v: Vector) -> [f64; 2] {
    [v.x, v.y]
}

/// Shortens a name to one line of at most 200 characters.
fn name(foreign: &str) -> String {
    text::heading(foreign, 200)
}

fn quantity(name: &str, values: &[f64], rounding: Rounding, unit: &str) -> Value {
    Value { name: name.into(), numbers: values.iter().map(|v| rounding.write(*v)).collect(), unit: unit.into() }
}

/// Makes a value from a number without a unit, with at most six decimals.
fn unitless(name: &str, value: f64) -> Value {
    let written = format!("{value:.6}");
    Value {
        name: name.into(),
        numbers: vec![written.trim_end_matches('0').trim_end_matches('.').to_owned()],
        unit: String::new(),
    }
}

/// Makes a value that is only a word, without a number.
fn word(word: &str) -> Value {
    Value { name: String::new(), numbers: Vec::new(), unit: word.into() }
}

pub(super) fn text(facts: &Facts) -> String {
    let mut out = format!("{FIRST_WORDS}{}\n", facts.version.number());
    for (number, section) in facts.sections.iter().enumerate() {
        if number > 0 {
            out.push('\n');
        }
        line(&mut out, "", &section.head);
        let indent = if number == 0 { "" } else { "  " };
        for fact in &section.facts {
            line(&mut out, indent, fact);
        }
    }
    out
}

/// Appends a fact to `out` as one line.
fn line(out: &mut String, indent: &str, fact: &Fact) {
    out.push_str(indent);
    out.push_str(&fact.kind);
    for name in &fact.names {
        let quoted = name.replace('\\', "\\\\").replace('"', "\\\"");
        out.push_str(&format!(" \"{quoted}\""));
    }
    out.push_str(": ");
    let values = fact.values.iter().map(|value| {
        let parts = [&value.name].into_iter().chain(&value.numbers).chain([&value.unit]);
        let parts: Vec<&str> = parts.map(String::as_str).filter(|p| !p.is_empty()).collect();
        parts.join(" ")
    });
    out.push_str(&values.collect::<Vec<_>>().join(", "));
    out.push('\n');
}
