//! Tests of lines of thrust in structures whose lines can be computed by hand.

use super::*;
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::BodyId;
use crate::mechanics::scene::Scene;
use crate::products::figure::bearing::bearings;

fn scene(text: &str) -> Scene {
    Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"))
}

fn thrust_segments(scene: &Scene) -> Vec<ThrustSegment> {
    let analysis = Analysis::new(scene);
    segments(analysis.at(0))
}

#[test]
fn in_an_arch_the_line_bends_above_or_below_the_centroid_of_each_voussoir() {
    let scene = scene(include_str!("../../../../assets/study/arch-27.json"));
    let segments = thrust_segments(&scene);
    let mut bends = 0;
    for pair in segments.chunk_by(|a, b| a.on == b.on) {
        let [a, b] = pair else {
            // Near the springing the thrust is so steep that it meets the weight outside the voussoir. There the line
            // is schematic.
            assert!(pair.len() == 1 && !pair[0].through, "{pair:?}");
            continue;
        };
        assert!(a.through && b.through);
        assert_eq!(a.to, b.from);
        let centroid = scene.blocks[a.on.0].centroid;
        assert!((a.to.x - centroid.x).abs() < 1e-6, "the line does not bend on the line of action of the weight");
        bends += 1;
    }
    assert!(bends >= 9, "{bends}");
    assert!(segments.iter().any(|s| !s.through));
}

#[test]
fn a_torque_moves_the_line_of_a_robot_sideways() {
    let scene = scene(
        r#"{ "drystone": 1, "blocks": [ { "id": "a", "polygon": [[0,0],[4,0],[4,2],[0,2]], "weight": 8 } ],
             "robots": [ { "id": "r", "limits": { "torque": 100 } } ],
             "steps": [ { "place": ["a"], "hold": { "r": { "block": "a", "at": [3, 1] } } } ] }"#,
    );
    // 8 N at the grip and −8 N·m about it act along the line through the centroid, so the line does not bend.
    assert!(thrust_segments(&scene).iter().all(|s| (s.from.x - 2.0).abs() < 1e-6));
}

/// A beam of 30 N on two posts, with loads.
fn beam(loads: &str) -> Scene {
    scene(&format!(
        r#"{{ "drystone": 1, "friction": 0.7,
             "ground": [ {{ "polygon": [[0,-1],[1,-1],[1,0],[0,0]] }}, {{ "polygon": [[9,-1],[10,-1],[10,0],[9,0]] }} ],
             "blocks": [ {{ "id": "beam", "polygon": [[0,0],[10,0],[10,1],[0,1]], "weight": 30 }} ],
             "loads": [ {loads} ] }}"#
    ))
}

#[test]
fn in_a_loaded_beam_the_reactions_and_the_load_meet_in_one_point() {
    let segments = thrust_segments(&beam(r#"{ "block": "beam", "force": [0, -12], "at": [4, 1] }"#));
    assert_eq!(segments.len(), 3, "{segments:?}");
    let meeting = segments[0].to;
    assert!(segments.iter().all(|s| !s.through && s.to == meeting));
    let load = segments.iter().find(|s| s.kind == ForceKind::Load);
    let load = load.expect("a segment for the load");
    assert_eq!((load.from, load.force), (Point::new(4.0, 1.0), Vector::new(0.0, -12.0)));
}

#[test]
fn the_line_has_no_gap_at_any_joint_in_compression() {
    for text in [
        include_str!("../../../../assets/study/arch-27.json"),
        include_str!("../../../../tests/scenes/archload.json"),
        include_str!("../../../../tests/scenes/buttress.json"),
    ] {
        let scene = scene(text);
        let analysis = Analysis::new(&scene);
        let frame_analysis = &analysis.frames[0];
        let segments = segments(analysis.at(0));
        for (contact, bearing) in frame_analysis.contacts.iter().zip(bearings(analysis.at(0))) {
            if bearing.is_none() {
                continue;
            }
            for body in contact.interface.bodies {
                let BodyId::Block(block) = body else { continue };
                let at = contact.resultant.at;
                let meets =
                    |s: &ThrustSegment| s.on == block && [s.from, s.to].iter().any(|end| (end - at).norm() < 1e-6);
                assert!(segments.iter().any(meets), "{at} in block {block:?}");
            }
        }
    }
}

#[test]
fn a_load_bends_the_line_of_thrust_on_its_line_of_action() {
    let scene = scene(
        r#"{ "drystone": 1, "friction": 0.7, "ground": [ { "polygon": [[0,-1],[4,-1],[4,0],[0,0]] } ],
             "blocks": [ { "id": "a", "polygon": [[0,0],[4,0],[4,4],[0,4]], "weight": 40 } ],
             "loads": [ { "block": "a", "force": [10, 0], "at": [0, 3] } ] }"#,
    );
    let segments = thrust_segments(&scene);
    // 40 N down through x = 2 and 10 N at height 3 meet at (2, 3). From there the line reaches the ground at (2.75,
    // 0).
    let [main, load] = &segments[..] else { panic!("{segments:?}") };
    assert!((main.from - Point::new(2.75, 0.0)).norm() < 1e-6, "{main:?}");
    assert!((main.to - Point::new(2.0, 3.0)).norm() < 1e-6, "{main:?}");
    assert_eq!(load.kind, ForceKind::Load);
    assert!((load.from - Point::new(0.0, 3.0)).norm() < 1e-9);
    assert!((load.to - main.to).norm() < 1e-6);
}

#[test]
fn a_stack_is_one_straight_line() {
    let scene = scene(
        r#"{ "drystone": 1, "friction": 0.7, "ground": [ { "polygon": [[0,-1],[2,-1],[2,0],[0,0]] } ],
             "blocks": [ { "id": "a", "polygon": [[0,0],[2,0],[2,1],[0,1]], "weight": 7 },
                         { "id": "b", "polygon": [[0,1],[2,1],[2,3],[0,3]], "weight": 5 } ] }"#,
    );
    let segments = thrust_segments(&scene);
    assert!(segments.iter().all(|s| s.through), "{segments:?}");
    assert!(segments.iter().all(|s| (s.from.x - 1.0).abs() + (s.to.x - 1.0).abs() < 1e-6));
    let along: f64 = segments.iter().map(|s| (s.to - s.from).norm()).sum();
    // The line runs through the lower block and up to the centroid of the upper block.
    assert!((along - 2.0).abs() < 1e-6, "{segments:?}");
}
