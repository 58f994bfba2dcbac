//! [`to_json`]: an analysis as the JSON object that other programs read.
//!
//! Invariant: the same analysis gives the same bytes, apart from `seconds`, which [`Timing::LeftOut`] leaves out. Every
//! number is plain: no −0, and the shortest decimal that reads back as the same f64. A number that could not be computed,
//! which happens in frames that are `undecided` only, is `null`. Lists that say nothing are absent where the contract
//! does not name them: `unsupported`, `notices`, `doubt`.
//!
//! This file is serde's second door, beside `scene::format`: that one reads a person's file, this one writes for programs,
//! and the two change for different reasons.

use std::io;

use serde::{Serialize, Serializer};
use serde_json::ser::Formatter;

use crate::analysis::{Analysis, Contact, Failure, FrameAnalysis, Proof, RobotForce, Verdict};
use crate::geometry::{Point, Vector};
use crate::interface::ContactKind;
use crate::scene::{BlockId, BodyId, RobotId, Scene};

/// Whether a result tells how long it took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timing {
    /// `solve.seconds` is there, and differs from run to run.
    Included,
    /// `solve.seconds` is absent: the same scene gives the same bytes.
    LeftOut,
}

/// How much white space a result has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One line per property, and one per interface, robot or failure. Ends with a line feed.
    Lines,
    /// All of it on one line, as JSON Lines want it. Ends with a line feed.
    OneLine,
}

/// The result of an analysis as one JSON object.
///
/// Forces are those on `bodies[0]`, `normal` points into `bodies[0]`, `"ground"` names the ground. The `amount` of a
/// failure is its share of `total_sticking` in newtons, `|F_x| + |F_y|` for a robot, whose limits are per component;
/// the amount of a missing torque is in N·m.
///
/// # Units
/// Metres, newtons, N·m; a spin is per metre, because the fastest point moves with speed 1.
///
/// # Example
/// ```
/// use drystone::analysis::Analysis;
/// use drystone::report::result::{Layout, Timing, to_json};
/// use drystone::scene::Scene;
///
/// let scene = Scene::from_json(r#"{ "drystone": 1, "blocks": [{ "id": "a", "polygon": [[0, 0], [3, 0], [0, 2]] }] }"#)?;
/// let json = to_json(&Analysis::of(&scene), Timing::LeftOut, Layout::OneLine);
/// assert!(json.contains(r#""verdict":"unstable""#), "nothing holds it");
/// # Ok::<(), drystone::scene::Problems>(())
/// ```
pub fn to_json(analysis: &Analysis, timing: Timing, layout: Layout) -> String {
    let result = Result::of(analysis, timing);
    let mut bytes = Vec::new();
    let written = match layout {
        Layout::Lines => result.serialize(&mut serde_json::Serializer::with_formatter(
            &mut bytes,
            Lines::default(),
        )),
        Layout::OneLine => serde_json::to_writer(&mut bytes, &result),
    };
    written.expect("plain structures with text keys always serialise into memory");
    bytes.push(b'\n');
    String::from_utf8(bytes).expect("serde_json writes UTF-8")
}

#[derive(Serialize)]
struct Result<'a> {
    drystone: &'static str,
    scene: &'a str,
    frames: Vec<Frame<'a>>,
}

#[derive(Serialize)]
struct Frame<'a> {
    title: &'a str,
    verdict: &'static str,
    #[serde(skip_serializing_if = "str::is_empty")]
    doubt: &'a str,
    total_force: Number,
    total_sticking: Number,
    weight: Number,
    interfaces: Vec<Interface<'a>>,
    robots: Vec<Robot<'a>>,
    failures: Vec<Missing<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unsupported: Vec<&'a str>,
    mechanism: Vec<Motion<'a>>,
    effects: Vec<Effect<'a>>,
    proof: ProofNumbers,
    solve: Solve,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notices: &'a [String],
}

#[derive(Serialize)]
struct Interface<'a> {
    bodies: [&'a str; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    kind: Option<&'static str>,
    ends: [Pair; 2],
    application_points: [Pair; 2],
    normal: Pair,
    mu: Number,
    normal_forces: [Number; 2],
    friction_force: Number,
    resultant: Resultant,
    friction_used: Number,
}

#[derive(Serialize)]
struct Resultant {
    at: Pair,
    force: Pair,
}

#[derive(Serialize)]
struct Robot<'a> {
    id: &'a str,
    holds: &'a str,
    at: Pair,
    force: Pair,
    torque: Number,
    limit_used: Number,
}

/// A failure. Exactly one of `bodies` and `robot` is there, and exactly one of `force` and `torque`.
#[derive(Serialize)]
struct Missing<'a> {
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    bodies: Option<[&'a str; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    robot: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    holds: Option<&'a str>,
    at: Pair,
    #[serde(skip_serializing_if = "Option::is_none")]
    force: Option<Pair>,
    #[serde(skip_serializing_if = "Option::is_none")]
    torque: Option<Number>,
    amount: Number,
}

#[derive(Serialize)]
struct Motion<'a> {
    block: &'a str,
    velocity: Pair,
    spin: Number,
}

#[derive(Serialize)]
struct Effect<'a> {
    effect: &'static str,
    simulated: bool,
    why: &'a str,
    unknowns: usize,
}

#[derive(Serialize)]
#[serde(untagged)]
enum ProofNumbers {
    Forces {
        worst_imbalance: Number,
        worst_share: Number,
        worst_pull: Number,
        worst_slip: Number,
    },
    Mechanism {
        power: Number,
        worst_violation: Number,
    },
}

#[derive(Serialize)]
struct Solve {
    method: &'static str,
    iterations: usize,
    programs: usize,
    groups: usize,
    reused: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<Number>,
}

/// A plain number: −0 is written 0.0, a number that is not finite is written null.
#[derive(Clone, Copy)]
struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        // Adding 0 turns −0 into 0 and leaves every other number alone.
        serializer.serialize_f64(self.0 + 0.0)
    }
}

type Pair = [Number; 2];

fn place(p: Point) -> Pair {
    [Number(p.x), Number(p.y)]
}

fn arrow(v: Vector) -> Pair {
    [Number(v.x), Number(v.y)]
}

impl<'a> Result<'a> {
    fn of(analysis: &'a Analysis, timing: Timing) -> Result<'a> {
        let scene = analysis.scene;
        let frames = scene.frames.iter().zip(&analysis.frames);
        Result {
            drystone: env!("CARGO_PKG_VERSION"),
            scene: &scene.title,
            frames: frames
                .map(|(step, frame)| Frame::of(scene, &step.title, frame, timing))
                .collect(),
        }
    }
}

impl<'a> Frame<'a> {
    fn of(scene: &'a Scene, title: &'a str, frame: &'a FrameAnalysis, timing: Timing) -> Frame<'a> {
        let block = |id: BlockId| scene.blocks[id.0].id.as_str();
        Frame {
            title,
            verdict: word(frame.verdict),
            doubt: &frame.doubt,
            total_force: Number(frame.total_force),
            total_sticking: Number(frame.total_sticking),
            weight: Number(frame.weight),
            interfaces: frame
                .contacts
                .iter()
                .map(|c| Interface::of(scene, c))
                .collect(),
            robots: frame.robots.iter().map(|r| Robot::of(scene, r)).collect(),
            failures: frame
                .failures
                .iter()
                .map(|f| Missing::of(scene, f))
                .collect(),
            unsupported: frame.unsupported.iter().map(|id| block(*id)).collect(),
            mechanism: frame
                .mechanism
                .iter()
                .map(|m| Motion {
                    block: block(m.block),
                    velocity: arrow(m.velocity),
                    spin: Number(m.spin),
                })
                .collect(),
            effects: frame
                .effects
                .iter()
                .map(|e| Effect {
                    effect: e.effect,
                    simulated: e.simulated,
                    why: &e.why,
                    unknowns: e.unknowns,
                })
                .collect(),
            proof: ProofNumbers::of(frame.proof),
            solve: Solve {
                method: frame.solve.method,
                iterations: frame.solve.iterations,
                programs: frame.solve.programs,
                groups: frame.solve.groups,
                reused: frame.solve.reused,
                seconds: (timing == Timing::Included).then_some(Number(frame.solve.seconds)),
            },
            notices: &frame.notices,
        }
    }
}

/// The verdict's word, in results as in a person's table.
pub fn word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stable",
        Verdict::Unstable => "unstable",
        Verdict::Undecided => "undecided",
    }
}

impl<'a> Interface<'a> {
    fn of(scene: &'a Scene, contact: &Contact) -> Interface<'a> {
        let interface = &contact.interface;
        Interface {
            bodies: interface.bodies.map(|b| scene.name(b)),
            kind: (interface.kind == ContactKind::Corner).then_some("corner"),
            ends: interface.ends.map(place),
            application_points: contact.application_points.map(place),
            normal: arrow(interface.normal),
            mu: Number(interface.friction),
            normal_forces: contact.normal_forces.map(Number),
            friction_force: Number(contact.friction_force),
            resultant: Resultant {
                at: place(contact.resultant.at),
                force: arrow(contact.resultant.force),
            },
            friction_used: Number(contact.friction_used),
        }
    }
}

impl<'a> Robot<'a> {
    fn of(scene: &'a Scene, robot: &RobotForce) -> Robot<'a> {
        Robot {
            id: &scene.robots[robot.robot.0].id,
            holds: &scene.blocks[robot.block.0].id,
            at: place(robot.at),
            force: arrow(robot.force),
            torque: Number(robot.torque),
            limit_used: Number(robot.limit_used),
        }
    }
}

impl<'a> Missing<'a> {
    fn of(scene: &'a Scene, failure: &Failure) -> Missing<'a> {
        let contact = |kind, bodies: [BodyId; 2], at, force: Vector| Missing {
            kind,
            bodies: Some(bodies.map(|b| scene.name(b))),
            robot: None,
            holds: None,
            at: place(at),
            force: Some(arrow(force)),
            torque: None,
            amount: Number(force.norm()),
        };
        let grip = |kind, robot: RobotId, block: BlockId, at| Missing {
            kind,
            bodies: None,
            robot: Some(&scene.robots[robot.0].id),
            holds: Some(&scene.blocks[block.0].id),
            at: place(at),
            force: None,
            torque: None,
            amount: Number(0.0),
        };
        match *failure {
            Failure::Tension { bodies, at, force } => contact("tension", bodies, at, force),
            Failure::Friction { bodies, at, force } => contact("friction", bodies, at, force),
            Failure::RobotForce {
                robot,
                block,
                at,
                force,
            } => Missing {
                force: Some(arrow(force)),
                amount: Number(force.x.abs() + force.y.abs()),
                ..grip("robot_force", robot, block, at)
            },
            Failure::RobotTorque {
                robot,
                block,
                at,
                torque,
            } => Missing {
                torque: Some(Number(torque)),
                amount: Number(torque.abs()),
                ..grip("robot_torque", robot, block, at)
            },
        }
    }
}

impl ProofNumbers {
    fn of(proof: Proof) -> ProofNumbers {
        match proof {
            Proof::Forces {
                worst_imbalance,
                worst_share,
                worst_pull,
                worst_slip,
            } => ProofNumbers::Forces {
                worst_imbalance: Number(worst_imbalance),
                worst_share: Number(worst_share),
                worst_pull: Number(worst_pull),
                worst_slip: Number(worst_slip),
            },
            Proof::Mechanism {
                power,
                worst_violation,
            } => ProofNumbers::Mechanism {
                power: Number(power),
                worst_violation: Number(worst_violation),
            },
        }
    }
}

/// The result and its frames have a line per property; what lies deeper has one line each.
#[derive(Default)]
struct Lines {
    /// For every open bracket: whether it is an array, and whether it has broken into lines.
    open: Vec<(bool, bool)>,
    objects: usize,
}

impl Lines {
    fn line<W: ?Sized + io::Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.open.iter().filter(|o| o.1).count()).try_for_each(|_| writer.write_all(b"  "))
    }

    fn close<W: ?Sized + io::Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        if let Some((_, true)) = self.open.pop() {
            self.line(writer)?;
        }
        writer.write_all(bracket)
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open.push((true, false));
        writer.write_all(b"[")
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b"]")
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        if let Some(array) = self.open.last_mut().filter(|o| o.0) {
            array.1 = true;
            self.line(writer)?;
        }
        self.open.push((false, self.objects < 2));
        self.objects += 1;
        writer.write_all(b"{")
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.objects -= 1;
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + io::Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        match self.open.last() {
            Some((_, true)) => self.line(writer),
            _ if first => Ok(()),
            _ => writer.write_all(b" "),
        }
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{EffectReport, Motion as Moved, Resultant as Sum, SolveReport};
    use crate::geometry::{Polygon, Tolerance};
    use crate::scene::{Block, Body, Frame as Step, Limits, Robot as Arm};

    fn scene() -> Scene {
        let corners = vec![
            Point::new(0.0, 0.0),
            Point::new(3.0, 0.0),
            Point::new(0.0, 2.0),
        ];
        let body = Body {
            polygon: Polygon::new(corners, vec![]).expect("sound"),
            cells: None,
            material: None,
            friction: 0.5,
            fill: None,
        };
        let block = |id: &str| Block {
            id: id.into(),
            body: body.clone(),
            centroid: Point::new(1.0, 0.7),
            weight: 5.0,
        };
        Scene {
            title: "A \"wedge\"".into(),
            gravity: Vector::new(0.0, -9.81),
            kernel: 0.0,
            lattice: None,
            exact: false,
            tolerance: Tolerance::of(3.0, 3.0),
            ground: vec![],
            blocks: vec![block("a"), block("b")],
            robots: vec![Arm {
                id: "r0".into(),
                limits: Limits::default(),
                holds: None,
            }],
            loads: vec![],
            materials: vec![],
            friction_pairs: vec![],
            corner_contacts: false,
            frames: vec![Step {
                title: "Only".into(),
                placed: vec![BlockId(0)],
                holds: vec![],
                plans: vec![],
            }],
        }
    }

    fn frame() -> FrameAnalysis {
        let (a, b, ground) = (
            BodyId::Block(BlockId(0)),
            BodyId::Block(BlockId(1)),
            BodyId::Ground(4),
        );
        let (robot, block, at) = (RobotId(0), BlockId(1), Point::new(2.0, 1.5));
        let force = Vector::new(3.0, -4.0);
        FrameAnalysis {
            verdict: Verdict::Unstable,
            doubt: String::new(),
            total_force: 43.372,
            total_sticking: 4.125,
            weight: 24.0,
            contacts: vec![Contact {
                interface: crate::interface::Interface {
                    bodies: [a, ground],
                    kind: ContactKind::Edge,
                    ends: [Point::new(0.0, 0.0), Point::new(3.0, -0.0)],
                    normal: Vector::new(0.0, 1.0),
                    friction: 0.5,
                },
                application_points: [Point::new(0.3, 0.0), Point::new(2.7, 0.0)],
                normal_forces: [4.5, 1.5],
                friction_force: -0.75,
                resultant: Sum {
                    on: a,
                    at: Point::new(0.9, 0.0),
                    force: Vector::new(0.75, 6.0),
                },
                friction_used: 0.25,
            }],
            robots: vec![RobotForce {
                robot,
                block,
                at,
                force,
                torque: 0.1,
                limit_used: 1.0,
            }],
            failures: vec![
                Failure::Tension {
                    bodies: [b, a],
                    at,
                    force,
                },
                Failure::Friction {
                    bodies: [b, ground],
                    at,
                    force,
                },
                Failure::RobotForce {
                    robot,
                    block,
                    at,
                    force,
                },
                Failure::RobotTorque {
                    robot,
                    block,
                    at,
                    torque: -2.0,
                },
            ],
            unsupported: vec![],
            mechanism: vec![Moved {
                block,
                velocity: Vector::new(0.5, -0.0),
                spin: f64::NAN,
            }],
            effects: vec![EffectReport {
                effect: "friction",
                simulated: true,
                why: "two".into(),
                unknowns: 8,
            }],
            proof: Proof::Mechanism {
                power: 0.25,
                worst_violation: 1e-12,
            },
            solve: SolveReport {
                method: "kinematic",
                iterations: 9,
                programs: 2,
                groups: 1,
                reused: 0,
                seconds: 0.0004,
            },
            notices: vec![],
        }
    }

    const LINES: &str = r#"{
  "drystone": "VERSION",
  "scene": "A \"wedge\"",
  "frames": [
    {
      "title": "Only",
      "verdict": "unstable",
      "total_force": 43.372,
      "total_sticking": 4.125,
      "weight": 24.0,
      "interfaces": [
        {"bodies": ["a","ground"], "ends": [[0.0,0.0],[3.0,0.0]], "application_points": [[0.3,0.0],[2.7,0.0]], "normal": [0.0,1.0], "mu": 0.5, "normal_forces": [4.5,1.5], "friction_force": -0.75, "resultant": {"at": [0.9,0.0], "force": [0.75,6.0]}, "friction_used": 0.25}
      ],
      "robots": [
        {"id": "r0", "holds": "b", "at": [2.0,1.5], "force": [3.0,-4.0], "torque": 0.1, "limit_used": 1.0}
      ],
      "failures": [
        {"kind": "tension", "bodies": ["b","a"], "at": [2.0,1.5], "force": [3.0,-4.0], "amount": 5.0},
        {"kind": "friction", "bodies": ["b","ground"], "at": [2.0,1.5], "force": [3.0,-4.0], "amount": 5.0},
        {"kind": "robot_force", "robot": "r0", "holds": "b", "at": [2.0,1.5], "force": [3.0,-4.0], "amount": 7.0},
        {"kind": "robot_torque", "robot": "r0", "holds": "b", "at": [2.0,1.5], "torque": -2.0, "amount": 2.0}
      ],
      "mechanism": [
        {"block": "b", "velocity": [0.5,0.0], "spin": null}
      ],
      "effects": [
        {"effect": "friction", "simulated": true, "why": "two", "unknowns": 8}
      ],
      "proof": {"power": 0.25, "worst_violation": 1e-12},
      "solve": {"method": "kinematic", "iterations": 9, "programs": 2, "groups": 1, "reused": 0}
    }
  ]
}
"#;

    #[test]
    fn the_names_are_the_contract_and_stay() {
        let scene = scene();
        let analysis = Analysis {
            scene: &scene,
            length: 1.0,
            frames: vec![frame()],
        };
        let expected = LINES.replace("VERSION", env!("CARGO_PKG_VERSION"));
        assert_eq!(to_json(&analysis, Timing::LeftOut, Layout::Lines), expected);
        let line = to_json(&analysis, Timing::Included, Layout::OneLine);
        assert_eq!(line.matches('\n').count(), 1);
        assert!(line.contains(r#""seconds":0.0004"#));
        let value: serde_json::Value = serde_json::from_str(&expected).expect("sound JSON");
        assert_eq!(value["frames"][0]["failures"][2]["amount"], 7.0);
    }

    #[test]
    fn what_is_worth_saying_is_said() {
        let scene = scene();
        let mut frame = frame();
        frame.doubt = "both proofs fail".into();
        frame.unsupported = vec![BlockId(1)];
        frame.notices = vec!["a contact of 1e-9 m is left out".into()];
        frame.proof = Proof::Forces {
            worst_imbalance: 1e-3,
            worst_pull: 0.0,
            worst_slip: -0.0,
        };
        let json = to_json(
            &Analysis {
                scene: &scene,
                length: 1.0,
                frames: vec![frame],
            },
            Timing::LeftOut,
            Layout::Lines,
        );
        assert!(json.contains(r#""doubt": "both proofs fail""#), "{json}");
        assert!(json.contains(r#""unsupported": ["b"]"#), "{json}");
        assert!(
            json.contains(r#""notices": ["a contact of 1e-9 m is left out"]"#),
            "{json}"
        );
        assert!(
            json.contains(r#"{"worst_imbalance": 0.001, "worst_pull": 0.0, "worst_slip": 0.0}"#),
            "{json}"
        );
    }
}
