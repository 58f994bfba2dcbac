//! The forces that a block can carry.

use drystone::analysis::{Capacity, CapacityError, CapacityRequest, CapacityShape, ForceAt};
use drystone::internals::geometry::Point;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::structure::scene;

/// The capacity of a block at a point.
fn capacity(file: &Value, name: &str, at: ForceAt) -> Capacity {
    of(
        &scene(file),
        CapacityRequest::of_block(named(file, name)).at(at),
    )
    .expect("a capacity")
}

fn named(file: &Value, name: &str) -> drystone::scene::BlockId {
    scene(file).block_named(name).expect("the block exists")
}

fn of(scene: &Scene, request: CapacityRequest) -> Result<Capacity, CapacityError> {
    Analysis::new(scene).capacity(0, &request)
}

/// A quarter of an arch from 5 m to 6 m: voussoirs 1 to 19 of 20, the first one is ground. Weights are areas.
fn half_arch() -> Value {
    let corner = |radius: f64, k: usize| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * (1.0 - k as f64 / 20.0));
        [radius * cos, radius * sin]
    };
    let polygon = |k: usize| {
        [
            corner(5.0, k),
            corner(5.0, k + 1),
            corner(6.0, k + 1),
            corner(6.0, k),
        ]
    };
    // ½ (6² − 5²) sin 9°: the area between two chords.
    let area = 0.5 * 11.0 * libm::sin(std::f64::consts::PI / 20.0);
    let blocks: Vec<Value> = (1..20)
        .map(|k| json!({ "id": k.to_string(), "polygon": polygon(k), "weight": area }))
        .collect();
    json!({ "drystone": 1, "friction": 0.7, "ground": [{ "polygon": polygon(0) }], "blocks": blocks })
}

/// The force at two points, the ends of the last radial face. Reference values from exact linear programs.
#[test]
fn an_arch_is_held_by_a_force_at_its_last_face() {
    let file = half_arch();
    let ends = [Point::new(5.0, 0.0), Point::new(6.0, 0.0)];
    let found = capacity(&file, "19", ForceAt::Contact(ends));
    assert_eq!(found.shape(), CapacityShape::Polygon);
    assert!(found.gap < 1e-6, "{}", found.gap);
    for (direction, expected) in [
        ([-1.0, 0.0], 5.037283),
        ([1.0, 0.0], -2.780423),
        ([0.0, -1.0], -8.105449),
        ([0.0, 1.0], 9.102342),
    ] {
        let most = found.most(direction).expect("it is bounded");
        assert!((most - expected).abs() < 1e-6, "{direction:?}: {most}");
    }
    // At the middle of the face alone the force has no torque: fewer forces hold the arch.
    let fewer = capacity(&file, "19", ForceAt::Point(Point::new(5.5, 0.0)));
    assert!(
        fewer
            .vertices
            .iter()
            .all(|v| found.contains(v.force) && v.proof.is_some_and(|p| p.holds()))
    );
    assert!(fewer.most([1.0, 0.0]) < found.most([1.0, 0.0]));
    assert!(
        fewer
            .edges
            .iter()
            .all(|e| e.proof.holds() && !e.mechanism.is_empty())
    );
}
