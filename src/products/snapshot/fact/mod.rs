//! [`Facts`]: the main inputs and results of a scene, as JSON with rounded numbers.
//!
//! Each line is one fact: the kind of the object, its names, and values with the keys of the result's JSON.
//!
//! ```json
//! {"drystone_facts":3,"decimals":{"N":5,"m":5,"N·m":5,"m/s²":5},"sections":[[
//! {"fact":"scene","of":["Two bricks"],"gravity":[0.0,-9.81]},
//! {"fact":"block","of":["a"],"centroid":[1.0,0.5],"mu":0.7,"weight":6.0}],[
//! {"fact":"frame 1","of":["All of it"],"verdict":"stable"},
//! {"fact":"sums","of":[],"blocks":1.0,"total_force":8.0,"total_sticking":0.0,"weight":6.0},
//! {"fact":"interface","of":["a","ground"],"friction_force":0.0,"mu":0.7,"normal_force":8.0,"normal_forces":[4.0,4.0]}]]}
//! ```
//!
//! Forces are rounded so that the largest weight or load has [`DIGITS`] significant digits. Lengths and torques are
//! rounded in the same way. Two such numbers count as equal if they differ by at most 1.5 units of the last decimal:
//! rounding errors of the solver are smaller, and a change by one percent is far larger. Frames that are undecided have
//! no proof, so their forces are not reported.

mod compare;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Analysis, Contact, Failure, SolvedFrame, Verdict};
use crate::mechanics::scene::{BlockId, BodyId, RobotId, Scene};
use crate::products::snapshot::layer::UnreadableReference;
use crate::text;

/// The significant digits of a force that is as large as the largest weight or load.
pub const DIGITS: usize = 6;
/// Blocks slower than this are not reported as falling; the fastest point of a mechanism has speed 1. Another optimum
/// of the same linear program may leave such a slow block at rest, so the fact would not be reproducible.
const MIN_FALLING_SPEED: f64 = 1e-3;
/// The version of the format that is written.
const VERSION: u8 = 3;
/// Decimals of numbers without a unit, which are counts and coefficients. They have no rounding error of the solver.
const UNITLESS_DECIMALS: i32 = 6;

/// All quantities in the order of messages: the key in the file, the words in messages, and the unit.
const QUANTITIES: [(&str, &str, &str); 20] = [
    ("verdict", "", ""),
    ("gravity", "gravity", "m/s²"),
    ("kernel", "kernel", ""),
    ("blocks", "blocks", ""),
    ("weight", "weight", "N"),
    ("total_force", "total force", "N"),
    ("total_sticking", "total sticking", "N"),
    ("missing", "missing", "N"),
    ("missing_torque", "missing", "N·m"),
    ("centroid", "centroid", "m"),
    ("force", "force", "N"),
    ("at", "at", "m"),
    ("fx", "horizontal", "N"),
    ("fy", "vertical", "N"),
    ("torque", "torque", "N·m"),
    ("normal_force", "N", "N"),
    ("friction_force", "T", "N"),
    ("normal_forces", "N at its ends", "N"),
    ("mu", "μ", ""),
    ("factor", "factor", ""),
];

/// The main inputs and the results of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// The version of the format.
    drystone_facts: u8,
    /// The decimals to which the numbers of each unit are rounded.
    decimals: BTreeMap<String, i32>,
    /// The facts of the scene, then those of each frame. The first fact of each section is its heading.
    sections: Vec<Vec<Fact>>,
}

/// An object and its values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Fact {
    /// The kind of object: `block`, `interface`, `failure tension`.
    #[serde(rename = "fact")]
    kind: String,
    /// The names of the object.
    #[serde(rename = "of")]
    names: Vec<String>,
    /// For each quantity a number, or several numbers; `null` for a number that is not finite. A verdict is a word.
    #[serde(flatten)]
    values: BTreeMap<String, Value>,
}

impl Facts {
    /// Collects the facts of an analysis. Forces are rounded so that the largest weight or load has `digits`
    /// significant digits, usually [`DIGITS`]. All other forces have the same number of decimals.
    ///
    /// ```
    /// use drystone::{Analysis, Scene, snapshot::fact::{DIGITS, Facts}};
    /// let facts = |load: f64| {
    ///     let scene = Scene::from_json(&format!(r#"{{ "drystone": 1, "friction": 0.5,
    ///         "ground": [{{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }}],
    ///         "blocks": [{{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 3 }}],
    ///         "loads": [{{ "block": "a", "force": [0, {}], "at": [2.5, 2] }}] }}"#, -load)).expect("sound");
    ///     Facts::new(&Analysis::new(&scene), DIGITS)
    /// };
    /// let words = facts(0.0).changes(&facts(1.2));
    /// assert!(words.contains(&"interface a–ground: N 3 → 4.2 N, N at its ends 1.5, 1.5 → 2.1, 2.1 N".into()), "{words:?}");
    /// assert!(facts(1.2).changes(&facts(1.2 + 1e-9)).is_empty());
    /// ```
    pub fn new(analysis: &Analysis, digits: usize) -> Facts {
        let scene = analysis.given();
        let weights = scene.blocks.iter().map(|b| b.weight.abs());
        let force = weights.chain(scene.loads.iter().map(|l| l.force.norm())).fold(0.0, f64::max);
        let corners = scene.blocks.iter().flat_map(|b| b.body.polygon.outline());
        let size = corners.map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
        let largest = [("N", force), ("m", size), ("N·m", force * size), ("m/s²", scene.gravity.norm())];
        let decimals = largest.map(|(unit, largest)| (unit.to_owned(), decimals(digits, largest)));
        let mut facts =
            Facts { drystone_facts: VERSION, decimals: decimals.into_iter().collect(), sections: vec![causes(scene)] };
        facts.sections.extend(analysis.each().map(|solved| {
            let verdict = json!({ "verdict": solved.found.verdict.word() });
            let heading = fact(&format!("frame {}", solved.number + 1), vec![&solved.frame().title], verdict);
            [vec![heading], frame(solved)].concat()
        }));
        for fact in facts.sections.iter_mut().flatten() {
            for (key, value) in &mut fact.values {
                let decimals = facts.decimals.get(quantity(key).1).copied().unwrap_or(UNITLESS_DECIMALS);
                round(value, decimals);
            }
        }
        facts
    }

    /// Returns the facts as text, in the format of reference files.
    pub fn text(&self) -> String {
        let text = serde_json::to_string(self).unwrap_or_default();
        // Each fact begins on a new line. This cannot occur in a name, where quotation marks are escaped.
        text::json(&text.replace("{\"fact\":\"", "\n{\"fact\":\"")).into_owned() + "\n"
    }

    /// Reads facts from the text of a reference file.
    ///
    /// # Errors
    /// [`UnreadableReference`] if the text is not a list of facts, or of another version.
    pub fn read(text: &str) -> Result<Facts, UnreadableReference> {
        let text = text.trim_start_matches('\u{feff}');
        UnreadableReference::check(text.as_bytes(), "facts")?;
        /// The version of facts, whose other keys may differ from those of this version.
        #[derive(Deserialize)]
        struct Versioned {
            drystone_facts: u8,
        }
        let wrong = |why: String| UnreadableReference(format!("it is not a file of facts: {why}"));
        let Versioned { drystone_facts: version } = serde_json::from_str(text).map_err(|e| wrong(e.to_string()))?;
        if version != VERSION {
            let why = format!("it has facts of version {version}, and this program reads version {VERSION}");
            return Err(UnreadableReference(format!("{why}; write it again with `drystone snapshot --accept`")));
        }
        let facts: Facts = serde_json::from_str(text).map_err(|error| wrong(error.to_string()))?;
        if facts.sections.iter().any(Vec::is_empty) {
            return Err(wrong("a section is empty".to_owned()));
        }
        Ok(facts)
    }

    /// Describes how the facts `found` differ from these facts. Changes of the scene come first. Then come changes of
    /// the results, the most important first. The list is empty if there is no difference.
    pub fn changes(&self, found: &Facts) -> Vec<String> {
        compare::changes(self, found)
    }
}

/// Returns the words and the unit of a quantity.
fn quantity(key: &str) -> (&str, &str) {
    QUANTITIES.iter().find(|q| q.0 == key).map_or(("", ""), |q| (q.1, q.2))
}

/// Returns the number of decimals at which `largest` has `digits` significant digits; negative for large numbers. If
/// `largest` is zero, infinite or NaN, the number of decimals is chosen for 1 instead.
fn decimals(digits: usize, largest: f64) -> i32 {
    let size = if largest > 0.0 && largest.is_finite() { largest } else { 1.0 };
    // Read the exponent from the printed number, because a computed logarithm may be wrong by one at powers of ten.
    let printed = format!("{size:e}");
    let exponent: i32 = printed.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    digits as i32 - 1 - exponent
}

/// Returns a power of ten. It is read from text, because `powi` is not exact.
fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

/// Rounds all numbers of a value, never to −0.
fn round(value: &mut Value, decimals: i32) {
    match value {
        Value::Array(list) => list.iter_mut().for_each(|value| round(value, decimals)),
        Value::Number(_) => {
            let number = value.as_f64().unwrap_or_default();
            let places = decimals.max(0) as usize;
            let unit = power_of_ten((-decimals).max(0));
            let rounded: f64 = format!("{:.places$}", number / unit).parse().unwrap_or(number);
            *value = json!(rounded * unit + 0.0);
        }
        _ => {}
    }
}

/// Makes a fact. Names are shortened to one line of at most 200 characters.
fn fact(kind: &str, names: Vec<&str>, values: Value) -> Fact {
    let names = names.into_iter().map(|name| text::heading(name, 200)).collect();
    let values = if let Value::Object(values) = values { values.into_iter().collect() } else { BTreeMap::new() };
    Fact { kind: kind.into(), names, values }
}

/// Returns the facts of the scene itself, such as blocks and loads. A user edits these facts, so they cause the changes
/// of the results.
fn causes(scene: &Scene) -> Vec<Fact> {
    let mut heading = json!({ "gravity": pair(scene.gravity) });
    if scene.kernel > 0.0 {
        heading["kernel"] = scene.kernel.into();
    }
    let mut facts = vec![fact("scene", vec![&scene.title], heading)];
    facts.extend(scene.blocks.iter().map(|block| {
        let at = [block.centroid.x, block.centroid.y];
        let values = json!({ "weight": block.weight, "centroid": at, "mu": block.body.friction });
        fact("block", vec![&block.id], values)
    }));
    facts.extend(scene.friction_pairs.iter().map(|(pair, friction)| {
        let mut names = pair.map(|material| scene.materials[material].name.as_str());
        names.sort_unstable();
        fact("friction", names.to_vec(), json!({ "mu": friction }))
    }));
    facts.extend(
        scene
            .joint_sets
            .iter()
            .map(|set| fact("joint set", vec![&set.id], json!({ "mu": set.friction, "factored": set.is_factored }))),
    );
    facts.extend(scene.contacts.iter().map(|contact| {
        let names = bodies(scene, contact.bodies);
        fact("contact", names, json!({ "mu": contact.friction }))
    }));
    facts.extend(scene.robots.iter().map(|robot| {
        let limits = json!({ "fx": robot.limits.fx, "fy": robot.limits.fy, "torque": robot.limits.torque });
        fact("limits", vec![&robot.id], limits)
    }));
    let all: Vec<BlockId> = (0..scene.blocks.len()).map(BlockId).collect();
    facts.extend(scene.loads_on(&all).iter().map(|load| {
        let mut values = json!({ "force": pair(load.force), "at": [load.at.x, load.at.y] });
        if load.torque != 0.0 {
            values["torque"] = load.torque.into();
        }
        fact("load", vec![&scene.blocks[load.block.0].id], values)
    }));
    for case in scene.cases() {
        let weights = format!("{}, weights", case.id);
        facts.push(fact("load case", vec![&weights], json!({ "factor": case.weights })));
        facts.extend(case.loads.iter().enumerate().map(|(entry, factor)| {
            let number = format!("load {}", entry + 1);
            let load = scene.load_ids.get(entry).and_then(|id| id.as_deref()).unwrap_or(&number);
            fact("load case", vec![&format!("{}, {load}", case.id)], json!({ "factor": factor }))
        }));
    }
    facts
}

/// Returns the facts of a frame without its heading.
fn frame(solved: SolvedFrame<'_>) -> Vec<Fact> {
    let SolvedFrame { scene, found, .. } = solved;
    let placed = solved.frame().placed.len();
    let is_proved = found.verdict != Verdict::Undecided;
    let mut sums = json!({ "blocks": placed as f64, "weight": found.weight });
    if is_proved {
        sums["total_force"] = found.total_force.into();
        sums["total_sticking"] = found.total_sticking.into();
    }
    let mut facts = vec![fact("sums", Vec::new(), sums)];
    let cases = found.cases.iter().flat_map(|cases| &cases.each);
    facts.extend(cases.map(|case| fact("case", vec![&case.id], json!({ "stands": case.verdict == Verdict::Stable }))));
    facts.extend(found.contacts.iter().map(|contact| interface(scene, contact, is_proved)));
    if is_proved {
        facts.extend(found.robots.iter().map(|robot| {
            let values = json!({ "force": pair(robot.force), "torque": robot.torque });
            fact("robot", grip(scene, robot.robot, robot.block), values)
        }));
        facts.extend(found.failures.iter().map(|failure| missing(scene, failure)));
    }
    let moves = found.mechanism.iter().filter(|m| {
        let speed = m.velocity.norm().max(m.spin.abs() * found.length);
        speed > MIN_FALLING_SPEED
    });
    let mut falling: Vec<BlockId> = moves.map(|m| m.block).chain(found.unsupported.iter().copied()).collect();
    falling.sort();
    falling.dedup();
    facts.extend(falling.iter().map(|block| fact("falls", vec![&scene.blocks[block.0].id], json!({}))));
    facts
}

fn interface(scene: &Scene, contact: &Contact, is_proved: bool) -> Fact {
    let mut values = json!({ "mu": contact.interface.friction });
    if is_proved {
        let [n1, n2] = contact.normal_forces;
        // Sort the forces at the two points by the positions of the points along a fixed direction, so that the facts
        // do not depend on the order of the points. The direction has an irrational slope (0.38…, from the golden
        // ratio), so that two different points hardly ever have the same position along it.
        let along = |p: Point| p.x + 0.381_966_011_25 * p.y;
        let [a, b] = contact.application_points.map(along);
        values["normal_force"] = (n1 + n2).into();
        values["normal_forces"] = json!(if a <= b { [n1, n2] } else { [n2, n1] });
        values["friction_force"] = contact.friction_force.into();
    }
    fact("interface", bodies(scene, contact.interface.bodies), values)
}

/// Returns the sorted names of two bodies, with the ground last. The facts therefore do not depend on the order of
/// the bodies in the result.
fn bodies(scene: &Scene, bodies: [BodyId; 2]) -> Vec<&str> {
    let mut names = bodies.map(|b| (matches!(b, BodyId::Ground(_)), scene.name(b)));
    names.sort_unstable();
    names.map(|(_, name)| name).to_vec()
}

fn grip(scene: &Scene, robot: RobotId, block: BlockId) -> Vec<&str> {
    vec![&scene.robots[robot.0].id, &scene.blocks[block.0].id]
}

fn missing(scene: &Scene, failure: &Failure) -> Fact {
    match *failure {
        Failure::Tension { bodies: b, force, .. } => {
            fact("failure tension", bodies(scene, b), json!({ "missing": force.norm() }))
        }
        Failure::Friction { bodies: b, force, .. } => {
            fact("failure friction", bodies(scene, b), json!({ "missing": force.norm() }))
        }
        Failure::RobotForce { robot, block, force, .. } => {
            fact("failure robot", grip(scene, robot, block), json!({ "missing": pair(force) }))
        }
        Failure::RobotTorque { robot, block, torque, .. } => {
            fact("failure robot", grip(scene, robot, block), json!({ "missing_torque": torque }))
        }
    }
}

fn pair(v: Vector) -> [f64; 2] {
    [v.x, v.y]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_numbers_end_at_the_decimal_place_of_the_largest_number() {
        let rounded = |largest: f64, number: f64| {
            let mut value = json!(number);
            round(&mut value, decimals(6, largest));
            value
        };
        assert_eq!(rounded(24.0, 4.460_206_8), json!(4.4602));
        assert_eq!(rounded(6.0, -0.000_000_4).to_string(), "0.0");
        assert_eq!(rounded(0.05, 0.012_345_67), json!(0.012_345_7));
        assert_eq!(rounded(123_456.0, 7.6), json!(8.0));
        assert_eq!(rounded(2.5e9, -1.251_34e7), json!(-1.251e7));
        assert_eq!(rounded(0.0, f64::NAN), Value::Null);
    }
}
