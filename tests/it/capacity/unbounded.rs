//! Capacities without corners: half-planes, strips, lines, and all forces.

use drystone::analysis::{CapacityRequest, CapacityShape, Cases, ForceAt, LoadCapacity};
use drystone::internals::geometry::Point;
use serde_json::{Value, json};

use super::{capacity, named, of};
use crate::structure::{rectangle, scene};

/// A block of 10 N and 2 m × 1 m between two vertical walls without friction, on a floor or not.
fn in_a_slot(floor: bool) -> Value {
    let ground = if floor {
        json!([{ "polygon":
            [[-3, -1], [3, -1], [3, 3], [1, 3], [1, 0], [-1, 0], [-1, 3], [-3, 3]] }])
    } else {
        json!([{ "polygon": [[-3, -1], [-1, -1], [-1, 3], [-3, 3]] },
            { "polygon": [[1, -1], [3, -1], [3, 3], [1, 3]] }])
    };
    json!({ "drystone": 1, "friction": 0, "ground": ground,
        "blocks": [{ "id": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "weight": 10 }] })
}

/// What a capacity says about forces to the right, up, and down: N.
fn reach_right_up_down(found: &LoadCapacity) -> Option<[f64; 3]> {
    Some([found.reach([1.0, 0.0])?, found.reach([0.0, 1.0])?, found.reach([0.0, -1.0])?])
}

fn assert_reaches(found: &LoadCapacity, expected: [f64; 3]) {
    let reaches = reach_right_up_down(found).expect("it stands without a force");
    for (reach, expected) in reaches.into_iter().zip(expected) {
        let equal = reach == expected || (reach - expected).abs() < 1e-6;
        assert!(equal, "{reach}, expected {expected}: {found:?}");
    }
}

/// On a floor, every force with Fy ≤ 10 N is carried: a half-plane.
#[test]
fn forces_in_a_half_plane_are_carried_in_a_slot_with_a_floor() {
    let middle = ForceAt::Point(Point::new(0.0, 0.5));
    let found = capacity(&in_a_slot(true), "a", middle);
    assert_eq!(found.shape(), CapacityShape::Unbounded);
    assert_eq!((found.vertices.len(), found.rays.len(), found.edges.len()), (1, 3, 1));
    assert_eq!(found.edges[0].ends, [None; 2]);
    assert!((found.edges[0].limit - 10.0).abs() < 1e-6);
    assert_reaches(&found, [f64::INFINITY, 10.0, f64::INFINITY]);
    for (force, carried) in
        [([0.0, 0.0], true), ([1e6, 9.999], true), ([-1e6, -1e6], true), ([0.0, 10.001], false), ([1e3, 10.001], false)]
    {
        assert_eq!(found.contains(force), carried, "{force:?}");
    }
    assert_eq!(found.most([1.0, 0.0]), None);
    assert!((found.most([0.0, 1.0]).expect("limited") - 10.0).abs() < 1e-6);
    // Tilted by up to 2°, the weight presses with at least 10 N · cos 2° on the floor.
    let file = in_a_slot(true);
    let request = CapacityRequest::of_block(named(&file, "a")).at(middle).cases(Cases::default().tilt(-2.0, 2.0));
    let found = of(&scene(&file), request).expect("a capacity");
    let least = 10.0 * libm::cos(2f64.to_radians());
    assert_reaches(&found, [f64::INFINITY, least, f64::INFINITY]);
}

/// Without a floor, a robot of at most 20 N carries the weight: −10 N ≤ Fy ≤ 30 N, a strip. Without the robot only
/// forces with Fy = 10 N are carried: a line.
#[test]
fn forces_in_a_strip_or_on_a_line_are_carried_in_a_slot_without_a_floor() {
    let middle = ForceAt::Point(Point::new(0.0, 0.5));
    let line = capacity(&in_a_slot(false), "a", middle);
    assert_eq!(line.shape(), CapacityShape::Unbounded);
    assert_eq!((line.vertices.len(), line.rays.len(), line.edges.len()), (1, 2, 2));
    assert_eq!(reach_right_up_down(&line), None);
    assert!(line.contains([-1e3, 10.0]) && !line.contains([0.0, 9.99]));
    let range = [[0.0, -1.0], [0.0, 1.0]].map(|d| line.most(d).expect("limited"));
    assert!((range[0] + 10.0).abs() < 1e-6 && (range[1] - 10.0).abs() < 1e-6, "{range:?}");
    let mut file = in_a_slot(false);
    file["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "fx": 0, "fy": 20, "torque": 0 } }]);
    let strip = capacity(&file, "a", middle);
    assert_eq!((strip.vertices.len(), strip.rays.len(), strip.edges.len()), (2, 2, 2));
    assert_reaches(&strip, [f64::INFINITY, 30.0, 10.0]);
    assert!(strip.contains([1e3, 29.0]) && !strip.contains([1e3, 31.0]) && !strip.contains([0.0, -11.0]));
}

/// A block in a slot with friction carries every force, by self-stress. A tower apart from it falls if tilted by 12°.
#[test]
fn no_force_is_carried_for_all_values_if_another_part_falls_at_one_of_them() {
    let mut file = in_a_slot(true);
    file["friction"] = json!(0.5);
    file["ground"].as_array_mut().expect("a list").push(json!({ "polygon": rectangle(5.0, -1.0, 3.0, 1.0) }));
    let tower = json!({ "id": "b", "polygon": rectangle(6.0, 0.0, 1.0, 5.0) });
    file["blocks"].as_array_mut().expect("a list").push(tower);
    let request = |most: f64| {
        let tilted = Cases::default().tilt(-most, most);
        let request = CapacityRequest::of_block(named(&file, "a"));
        of(&scene(&file), request.cases(tilted)).expect("a capacity").shape()
    };
    assert_eq!(request(10.0), CapacityShape::Everything);
    assert_eq!(request(12.0), CapacityShape::Empty);
}
