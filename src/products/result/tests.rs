//! Tests that the JSON output follows its documented format exactly.

use super::*;
use crate::geometry::{Point, Polygon, Tolerance as Closeness, Vector};
use crate::mechanics::analysis::{
    Contact, EffectName, EffectReport, Failure, FrameAnalysis, Motion as Moved, Proof, Resultant as Sum, RobotForce,
    SolveReport, UndecidedReason, Verdict,
};
use crate::mechanics::scene::{
    Block, BlockId, Body, BodyId, CornerContacts, Frame as Step, Healed, Limits, Robot as Arm, RobotId,
};
use crate::mechanics::statics::interface::ContactKind;

fn scene() -> Scene {
    let corners = vec![Point::new(0.0, 0.0), Point::new(3.0, 0.0), Point::new(0.0, 2.0)];
    let body = Body {
        polygon: Polygon::new(corners, vec![]).expect("a valid polygon"),
        circle: None,
        cells: None,
        material: None,
        friction: 0.5,
        fill: None,
        gap: 3e-6,
        rounding: 0.0,
        is_schematic: false,
    };
    let block = |id: &str| Block {
        id: id.into(),
        body: body.clone(),
        centroid: Point::new(1.0, 0.7),
        has_own_centre: false,
        weight: 5.0,
        placement: 1.0,
        weighs_by_area: false,
        mass: None,
    };
    Scene {
        title: "A \"wedge\"".into(),
        author: String::new(),
        project: String::new(),
        date: String::new(),
        units: Default::default(),
        gravity: Vector::new(0.0, -9.81),
        thickness: 1.0,
        kernel: 0.0,
        lattice: None,
        exact: false,
        tolerance: Closeness::new(3.0, 3.0),
        healed: Healed::default(),
        misfit: 0.0,
        set: Vec::new(),
        penetrations: Vec::new(),
        ground: vec![],
        blocks: vec![block("a"), block("b")],
        robots: vec![Arm { id: "r0".into(), limits: Limits::default(), holds: None }],
        loads: vec![],
        load_ids: vec![],
        cases: vec![],
        movements: vec![],
        vehicle: None,
        materials: vec![],
        friction_pairs: vec![],
        joint_sets: Vec::new(),
        contacts: Vec::new(),
        corner_contacts: CornerContacts::NONE,
        frames: vec![Step {
            title: "Only".into(),
            placed: vec![BlockId(0)],
            holds: vec![],
            plans: vec![],
            expected: None,
        }],
        notes: vec![],
        silenced: vec![],
        lines: Default::default(),
    }
}

fn frame() -> FrameAnalysis {
    let (a, b, ground) = (BodyId::Block(BlockId(0)), BodyId::Block(BlockId(1)), BodyId::Ground(4));
    let (robot, block, at) = (RobotId(0), BlockId(1), Point::new(2.0, 1.5));
    let force = Vector::new(3.0, -4.0);
    FrameAnalysis {
        verdict: Verdict::Unstable,
        doubts: vec![],
        length: 1.5,
        total_force: 43.372,
        force_bound: None,
        least_force: true,
        total_sticking: 4.125,
        weight: 24.0,
        contacts: vec![Contact {
            interface: crate::mechanics::statics::interface::Interface {
                bodies: [a, ground],
                kind: ContactKind::Edge,
                ends: [Point::new(0.0, 0.0), Point::new(3.0, -0.0)],
                normal: Vector::new(0.0, 1.0),
                friction: 0.5,
            },
            application_points: [Point::new(0.3, 0.0), Point::new(2.7, 0.0)],
            normal_forces: [4.5, 1.5],
            friction_force: -0.75,
            resultant: Sum { on: a, at: Point::new(0.9, 0.0), force: Vector::new(0.75, 6.0) },
            friction_used: 0.25,
        }],
        robots: vec![RobotForce { robot, block, at, force, torque: 0.1, limit_used: 1.0 }],
        failures: vec![
            Failure::Tension { bodies: [b, a], at, force },
            Failure::Friction { bodies: [b, ground], at, force },
            Failure::RobotForce { robot, block, at, force },
            Failure::RobotTorque { robot, block, at, torque: -2.0 },
        ],
        unsupported: vec![],
        mechanism: vec![Moved { block, velocity: Vector::new(0.5, -0.0), spin: f64::NAN }],
        margins: None,
        sensitivity: None,
        placement: None,
        movements: vec![],
        removable: None,
        vehicle: None,
        capacity: None,
        only_by_wedging: None,
        exact: None,
        cases: None,
        under_vehicle: None,
        corners_decide: false,
        alone: None,
        wedged: None,
        effects: vec![EffectReport { effect: EffectName::Friction, simulated: true, why: "two".into(), unknowns: 8 }],
        proof: Proof::Mechanism { power: 0.25, worst_violation: 1e-12 },
        solve: SolveReport {
            method: crate::mechanics::analysis::Method::LeastForce,
            iterations: 9,
            programs: 2,
            groups: 1,
            reused: 0,
            seconds: 0.0004,
            stages: crate::mechanics::analysis::Stages::default(),
        },
        notices: vec![],
    }
}

const LINES: &str = r#"{
  "drystone": "VERSION",
  "scene": "A \"wedge\"",
  "contact_tolerance": {
    "gap": 3e-6,
    "from": "size",
    "healed_within": 0.0,
    "moved_corners": 0,
    "largest_move": 0.0
  },
  "frames": [
    {
      "title": "Only",
      "verdict": "unstable",
      "length": 1.5,
      "total_force": 43.372,
      "total_sticking": 4.125,
      "weight": 24.0,
      "interfaces": [
        {"bodies": ["a","ground"], "ends": [[0.0,0.0],[3.0,0.0]], "application_points": [[0.3,0.0],[2.7,0.0]], "normal": [0.0,1.0], "mu": 0.5, "normal_forces": [4.5,1.5], "friction_force": -0.75, "resultant": {"at": [0.9,0.0], "force": [0.75,6.0]}, "friction_used": 0.25, "eccentricity": 0.6, "in_middle_third": false, "pressure": [4.444444444444444,0.0]}
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
      "proof": {"power": 0.25, "worst_violation": 1e-12, "no_balance_below": 250000000000.0},
      "solve": {"method": "kinematic", "iterations": 9, "programs": 2, "groups": 1, "reused": 0}
    }
  ]
}
"#;

#[test]
fn the_names_and_the_order_of_the_keys_do_not_change() {
    let scene = scene();
    let analysis = Analysis::of_parts(scene, vec![frame().into()]);
    let expected = LINES.replace("VERSION", env!("CARGO_PKG_VERSION"));
    assert_eq!(to_json(&analysis, Timing::LeftOut, Layout::Lines), expected);
    let line = to_json(&analysis, Timing::Included, Layout::OneLine);
    assert_eq!(line.matches('\n').count(), 1);
    assert!(line.contains(r#""seconds":0.0004"#));
    let value: serde_json::Value = serde_json::from_str(&expected).expect("valid JSON");
    assert_eq!(value["frames"][0]["failures"][2]["amount"], 7.0);
}

#[test]
fn doubts_notices_and_weak_proofs_are_in_the_output() {
    let scene = scene();
    let mut frame = frame();
    frame.doubts = vec![UndecidedReason::Late];
    frame.least_force = false;
    frame.unsupported = vec![BlockId(1)];
    frame.notices = vec!["a contact of 1e-9 m is left out".into()];
    frame.proof = Proof::Forces { worst_imbalance: 1e-3, worst_share: 0.5, worst_pull: 0.0, worst_slip: -0.0 };
    let json = to_json(&Analysis::of_parts(scene, vec![frame.into()]), Timing::LeftOut, Layout::Lines);
    assert!(json.contains(r#""doubt": "the time limit was reached before it was decided""#), "{json}");
    assert!(json.contains(r#""unsupported": ["b"]"#), "{json}");
    assert!(json.contains(r#""total_force_least": false"#), "{json}");
    assert!(json.contains(r#""notices": ["a contact of 1e-9 m is left out"]"#), "{json}");
    assert!(
        json.contains(r#"{"worst_imbalance": 0.001, "worst_share": 0.5, "worst_pull": 0.0, "worst_slip": 0.0}"#),
        "{json}"
    );
}
