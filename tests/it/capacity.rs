//! The forces that a block can carry.

use drystone::analysis::{
    CapacityError, CapacityRequest, CapacityShape, Cases, ForceAt, LoadCapacity, Options, Verdict,
};
use drystone::internals::geometry::Point;
use drystone::result::{Layout, Timing, to_json};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::structure::{block, rectangle, scene};

mod random;
mod unbounded;

fn capacity(file: &Value, name: &str, at: ForceAt) -> LoadCapacity {
    of(&scene(file), CapacityRequest::of_block(named(file, name)).at(at)).expect("a capacity")
}

fn named(file: &Value, name: &str) -> drystone::scene::BlockId {
    scene(file).block_named(name).expect("the block exists")
}

fn of(scene: &Scene, request: CapacityRequest) -> Result<LoadCapacity, CapacityError> {
    Analysis::new(scene).capacity(0, &request)
}

/// A semicircular arch between the radii 5 m and 6 m. The first of its 20 voussoirs is ground. Weights are areas.
fn semicircle() -> Value {
    let corner = |radius: f64, k: usize| {
        let (sin, cos) = libm::sincos(std::f64::consts::PI * (1.0 - k as f64 / 20.0));
        [radius * cos, radius * sin]
    };
    let polygon = |k: usize| [corner(5.0, k), corner(5.0, k + 1), corner(6.0, k + 1), corner(6.0, k)];
    // ½ (6² − 5²) sin 9°: the area between two chords.
    let area = 0.5 * 11.0 * libm::sin(std::f64::consts::PI / 20.0);
    let blocks: Vec<Value> =
        (1..20).map(|k| json!({ "id": k.to_string(), "polygon": polygon(k), "weight": area })).collect();
    json!({ "drystone": 1, "friction": 0.7, "ground": [{ "polygon": polygon(0) }], "blocks": blocks })
}

/// The force acts at two points, the ends of the last radial face. The reference values are from exact linear
/// programs.
#[test]
fn an_arch_is_held_by_a_force_at_its_last_face() {
    let file = semicircle();
    let ends = [Point::new(5.0, 0.0), Point::new(6.0, 0.0)];
    let found = capacity(&file, "19", ForceAt::Contact(ends));
    assert_eq!(found.shape(), CapacityShape::Polygon);
    assert!(found.gap < 1e-6, "{}", found.gap);
    for (direction, expected) in
        [([-1.0, 0.0], 5.037283), ([1.0, 0.0], -2.780423), ([0.0, -1.0], -8.105449), ([0.0, 1.0], 9.102342)]
    {
        let most = found.most(direction).expect("it is bounded");
        assert!((most - expected).abs() < 1e-6, "{direction:?}: {most}");
    }
    // A force at the single point in the middle of the face has no torque about it, so fewer forces hold the arch.
    let fewer = capacity(&file, "19", ForceAt::Point(Point::new(5.5, 0.0)));
    assert!(fewer.vertices.iter().all(|v| found.contains(v.force) && v.proof.is_some_and(|p| p.holds())));
    assert!(fewer.most([1.0, 0.0]) < found.most([1.0, 0.0]));
    assert!(fewer.edges.iter().all(|e| e.proof.holds() && !e.mechanism.is_empty()));
}

/// A block of 4 m × 2 m and 6 N on a floor with friction 0.5.
fn on_floor() -> Value {
    json!({ "drystone": 1, "friction": 0.5,
        "ground": [{ "polygon": rectangle(0.0, -1.0, 9.0, 1.0) }],
        "blocks": [block("a", rectangle(1.0, 0.0, 4.0, 2.0), 6.0)] })
}

fn near(found: impl Into<Option<f64>>, expected: f64) {
    let found = found.into().expect("it is bounded");
    assert!((found - expected).abs() < 1e-5, "{found} instead of {expected}");
}

#[test]
fn the_capacity_of_a_block_on_a_floor_agrees_with_sums_by_hand() {
    // A force at the centroid makes the block slide: |Fx| ≤ 0.5 (6 − Fy). It would tip only at |Fx| = 2 (6 − Fy).
    let found = capacity(&on_floor(), "a", ForceAt::Default);
    assert_eq!(found.shape(), CapacityShape::Unbounded);
    assert_eq!((found.vertices.len(), found.edges.len()), (1, 2));
    near(found.vertices[0].force.y, 6.0);
    for (direction, most) in [([-1.0, 0.0], 3.0), ([1.0, 0.0], 3.0), ([0.0, 1.0], 6.0)] {
        near(found.reach(direction), most);
    }
    assert_eq!(found.reach([0.0, -1.0]), Some(f64::INFINITY));
    assert!(found.gap < 1e-5, "{}", found.gap);
    // A force at the upper right corner: the block slides at Fx = 3 N. It would tip about (5, 0) only at 2 Fx = 12
    // N·m.
    let corner = capacity(&on_floor(), "a", ForceAt::Point(Point::new(5.0, 2.0)));
    near(corner.reach([1.0, 0.0]), 3.0);
    // An upward force at the same corner turns the block about (1, 0): 4 Fy = 12 N·m.
    near(corner.reach([0.0, 1.0]), 3.0);
}

#[test]
fn every_shape_occurs() {
    // Without friction only vertical forces between the ends of the joint are carried.
    let mut smooth = on_floor();
    smooth["friction"] = json!(0.0);
    let ray = capacity(&smooth, "a", ForceAt::Default);
    assert_eq!((ray.shape(), ray.rays.len()), (CapacityShape::Unbounded, 1));
    near(ray.reach([0.0, 1.0]), 6.0);
    near(ray.reach([1.0, 0.0]), 0.0);
    // A vertical force 1 m to the right of the block either lifts it or tips it: the set is a segment.
    let segment = capacity(&smooth, "a", ForceAt::Point(Point::new(6.0, 1.0)));
    assert_eq!(segment.shape(), CapacityShape::Segment, "{segment:?}");
    near(segment.reach([0.0, -1.0]), 12.0);
    near(segment.reach([0.0, 1.0]), 12.0 / 5.0);
    // Only one force holds a block in the air: its weight, upwards at the centroid.
    let mut hangs = on_floor();
    hangs["ground"] = json!([]);
    let point = capacity(&hangs, "a", ForceAt::Default);
    assert_eq!(point.shape(), CapacityShape::Point, "{point:?}");
    near(point.vertices[0].force.y, 6.0);
    // A force at a point right of the centroid cannot hold the block. Two forces at the ends of a contact can,
    // because they also exert a torque.
    let off_centre = capacity(&hangs, "a", ForceAt::Point(Point::new(4.0, 1.0)));
    assert_eq!(off_centre.shape(), CapacityShape::Empty);
    assert!(!off_centre.mechanism.is_empty() && !off_centre.contains([0.0, 6.0]));
    let ends = [Point::new(4.0, 0.0), Point::new(4.0, 2.0)];
    let held = capacity(&hangs, "a", ForceAt::Contact(ends));
    assert_eq!(held.shape(), CapacityShape::Point);
    near(held.vertices[0].torque, -6.0);
    // A robot without limits carries every force.
    let mut held = hangs.clone();
    held["robots"] = json!([{ "id": "r", "holds": "a" }]);
    let all = capacity(&held, "a", ForceAt::Point(Point::new(3.0, 1.0)));
    assert_eq!(all.shape(), CapacityShape::Everything);
    assert_eq!(all.reach([1.0, 0.0]), Some(f64::INFINITY));
    // By default the force replaces the robot that holds the block, so it must equal the weight.
    let tool = capacity(&held, "a", ForceAt::Default);
    assert_eq!(tool.shape(), CapacityShape::Point);
    assert!(tool.robot.is_some());
    // If another block falls, the set is empty.
    let mut other = on_floor();
    other["blocks"].as_array_mut().expect("a list").push(block("b", rectangle(1.0, 5.0, 1.0, 1.0), 1.0));
    let none = capacity(&other, "a", ForceAt::Default);
    assert_eq!(none.shape(), CapacityShape::Empty);
    assert_eq!(none.mechanism.len(), 1);
}

#[test]
fn requests_that_are_not_valid_are_refused() {
    let file = on_floor();
    let (scene, a) = (scene(&file), named(&file, "a"));
    let request = CapacityRequest::of_block(a);
    let analysis = Analysis::new(&scene);
    assert_eq!(analysis.capacity(1, &request), Err(CapacityError::NoFrame));
    let at = request.at(ForceAt::Point(Point::new(f64::NAN, 0.0)));
    assert!(matches!(of(&scene, at), Err(CapacityError::Point(..))));
    let both = request.at(ForceAt::Contact([Point::new(1.0, 0.0); 2]));
    assert!(matches!(of(&scene, both), Err(CapacityError::Point(..))));
    for cases in [
        Cases::default().tilt(-60.0, 60.0),
        Cases::default().friction(0.7, 0.5),
        Cases::default().friction(-0.1, 0.5),
        Cases::default().horizontal_load(0.0, f64::NAN),
    ] {
        let found = of(&scene, request.cases(cases));
        assert!(matches!(found, Err(CapacityError::Range(_))), "{found:?}");
    }
}

/// The set of forces that the block on a floor carries in all cases of a range, compared with sums by hand.
#[test]
fn a_force_carried_in_all_cases_is_carried_in_each_case() {
    let file = on_floor();
    let (scene, request) = (scene(&file), CapacityRequest::of_block(named(&file, "a")));
    let every = |cases: Cases| of(&scene, request.cases(cases)).expect("a capacity");
    // The smallest friction coefficient decides: |Fx| ≤ 0.4 (6 − Fy).
    let friction = every(Cases::default().friction(0.4, 0.9));
    near(friction.reach([1.0, 0.0]), 2.4);
    near(friction.reach([0.0, 1.0]), 6.0);
    // A horizontal load of a tenth of the weight uses 0.6 N of the friction of 3 N.
    let across = every(Cases::default().horizontal_load(-0.1, 0.1));
    assert_eq!(across.cases, 2);
    near(across.reach([1.0, 0.0]), 2.4);
    near(across.reach([-1.0, 0.0]), 2.4);
    // Tilted: Fx + 6 sin t ≤ 0.5 · 6 cos t. The result may be smaller by 5e-5 of the weight.
    let tilted = every(Cases::default().tilt(-2.0, 2.0));
    let (sin, cos) = libm::sincos(2.0_f64.to_radians());
    let exact = 3.0 * cos - 6.0 * sin;
    let found = tilted.reach([1.0, 0.0]).expect("it stands");
    assert!(found <= exact + 1e-6 && found > exact - 3e-4, "{found} {exact}");
    // Each single case carries at least as much.
    for tilt in [-2.0, -1.3, 0.0, 0.7, 2.0] {
        let alone = every(Cases::default().tilt(tilt, tilt));
        for vertex in &tilted.vertices {
            let inside = vertex.force * (1.0 - 1e-6) - vertex.force.normalize() * 1e-5;
            assert!(alone.contains(inside), "{tilt}: {:?}", vertex.force);
        }
    }
}

/// A block on a floor and a robot hold a hook with a friction of 10⁶; gravity acts to the right. Motions had no proof,
/// and the capacity was withheld.
fn hook() -> Value {
    let hook = json!([[-1, 1.5], [0, 1.5], [0, 4], [0.5, 4], [0.5, 1.5], [2.5, 1.5], [2.5, 5], [-1, 5]]);
    json!({ "drystone": 1, "gravity": [9.81, 0], "kernel": 0.99, "friction": 0.5,
        "materials": { "A": { "friction": 0.05 }, "B": { "friction": 0.3 }, "C": { "density": 0 } },
        "friction_pairs": [{ "between": ["A", "B"], "friction": 0.3 }, { "between": ["B", "C"], "friction": 1e6 }],
        "ground": [{ "polygon": rectangle(-9.0, -1.0, 39.0, 1.0), "material": "A" }],
        "blocks": [{ "id": "b0", "polygon": rectangle(0.0, 0.0, 0.5, 4.0), "material": "C", "weight": 9 },
                   { "id": "b1", "polygon": hook, "material": "B", "weight": 8 }],
        "robots": [{ "id": "R0", "holds": "b0", "at": [2, 5] }] })
}

#[test]
fn a_capacity_at_a_friction_of_a_million_is_found() {
    let (file, none) = (hook(), [0.0; 2]);
    assert!(capacity(&file, "b1", ForceAt::Default).contains(none));
    let robot = capacity(&file, "b0", ForceAt::Default);
    assert!(!robot.contains(none) && robot.gap < 1e-3, "{robot:?}");
}

/// Scenes for the checks below: the arch, the block on a floor, the hook, and ten random scenes.
fn scenes() -> Vec<Value> {
    let mut all = vec![semicircle(), on_floor(), hook()];
    all.extend((0..10).map(|number| crate::oracle::random::scene(number).1));
    all
}

/// The capacity of the last block at its centroid. `None` if the scene is invalid, its blocks overlap, or the
/// capacity is withheld.
fn last_capacity(file: &Value) -> Option<(Scene, LoadCapacity)> {
    let scene = Scene::from_json(&file.to_string()).ok()?;
    if !scene.penetrations().is_empty() {
        return None;
    }
    let last = drystone::scene::BlockId(scene.blocks().len() - 1);
    let found = of(&scene, CapacityRequest::of_block(last).at(ForceAt::Point(scene.blocks()[last.0].centroid)));
    Some((scene, found.ok()?))
}

/// The verdict of the same scene with one more load.
fn with_load(file: &Value, scene: &Scene, capacity: &LoadCapacity, force: [f64; 2]) -> Verdict {
    let mut file = file.clone();
    let id = &scene.blocks()[capacity.block.0].id;
    let at = capacity.at[0];
    let load = json!({ "block": id, "force": force, "at": [at.x, at.y] });
    match file["loads"].as_array_mut() {
        Some(loads) => loads.push(load),
        None => file["loads"] = json!([load]),
    }
    crate::structure::verdict(&file)
}

#[test]
fn just_beyond_an_edge_it_falls_and_at_a_vertex_it_stands() {
    let mut count = 0;
    for file in scenes() {
        let Some((scene, found)) = last_capacity(&file) else {
            continue;
        };
        let weight: f64 = scene.blocks().iter().map(|b| b.weight).sum();
        if found.vertices.is_empty() || found.rays.len() > 2 {
            continue;
        }
        let forces: Vec<_> = found.vertices.iter().map(|v| v.force).collect();
        let middle = forces.iter().sum::<drystone::internals::geometry::Vector>() / forces.len() as f64;
        let size = forces.iter().map(|f| f.norm()).fold(weight, f64::max);
        for edge in &found.edges {
            let ends: Vec<_> = edge.ends.iter().flatten().map(|k| forces[*k]).collect();
            let on = ends.iter().sum::<drystone::internals::geometry::Vector>() / ends.len().max(1) as f64;
            let on = if ends.is_empty() { forces[0] } else { on };
            let beyond = on + edge.normal * (1e-4 * size);
            let verdict = with_load(&file, &scene, &found, [beyond.x, beyond.y]);
            assert_eq!(verdict, Verdict::Unstable, "{file} {edge:?}");
            count += 1;
        }
        for force in &forces {
            let inside = force + (middle - force) * 1e-6;
            let verdict = with_load(&file, &scene, &found, [inside.x, inside.y]);
            assert_eq!(verdict, Verdict::Stable, "{file} {force:?}");
        }
    }
    assert!(count > 5, "{count} edges");
}

#[test]
fn the_forces_of_a_vertex_balance_every_block() {
    let file = semicircle();
    let found = capacity(&file, "19", ForceAt::Point(Point::new(5.5, 0.0)));
    let analysis = Analysis::new(scene(&file));
    for vertex in &found.vertices {
        let mut sum = vertex.force;
        for block in analysis.given().blocks() {
            sum.y -= block.weight;
        }
        // Of all forces, only those of the ground do not cancel.
        for pressed in &vertex.contacts {
            let interface = &analysis.frames[0].contacts[pressed.interface].interface;
            assert!(pressed.normal.iter().all(|n| *n >= 0.0));
            let most = interface.friction * (pressed.normal[0] + pressed.normal[1]);
            assert!(pressed.friction.abs() <= most * (1.0 + 1e-9));
            let force =
                interface.normal * (pressed.normal[0] + pressed.normal[1]) + interface.tangent() * pressed.friction;
            let grounds = interface.bodies.map(|b| matches!(b, drystone::scene::BodyId::Ground(_)));
            match grounds {
                [false, true] => sum += force,
                [true, false] => sum -= force,
                _ => {}
            }
        }
        assert!(sum.norm() < 1e-6, "{sum:?}");
    }
}

#[test]
fn the_json_contains_the_capacity_that_was_found() {
    let file = semicircle();
    let scene = scene(&file);
    let at = ForceAt::Point(Point::new(5.5, 0.0));
    let request = CapacityRequest::of_block(named(&file, "19")).at(at);
    let analysis = Analysis::with(&scene, &Options::default().capacity(request));
    let found = analysis.frames[0].capacity.as_ref().expect("requested");
    let json = to_json(&analysis, Timing::LeftOut, Layout::OneLine);
    let json: Value = serde_json::from_str(&json).expect("JSON");
    let capacity = &json["frames"][0]["capacity"];
    assert_eq!((&capacity["block"], &capacity["shape"]), (&json!("19"), &json!("polygon")));
    assert_eq!(capacity["at"], json!([[5.5, 0.0]]));
    assert_eq!(capacity["stands_without"], json!(false));
    let forces: Vec<[f64; 2]> = found.vertices.iter().map(|v| [v.force.x, v.force.y]).collect();
    assert_eq!(capacity["vertices"], json!(forces));
    assert_eq!(capacity["edges"].as_array().map(Vec::len), Some(found.edges.len()));
    assert_eq!(capacity["balances"].as_array().map(Vec::len), Some(forces.len()));
    assert_eq!(capacity["cases"], json!(1));
    let limits: Vec<f64> = found.edges.iter().map(|e| e.limit).collect();
    let written: Vec<f64> =
        capacity["edges"].as_array().expect("a list").iter().map(|e| e["limit"].as_f64().expect("a number")).collect();
    assert_eq!(written, limits);
    // The capacity is written only if it was requested.
    let plain = to_json(&Analysis::new(&scene), Timing::LeftOut, Layout::OneLine);
    assert!(!plain.contains("\"capacity\""));
}

/// All frames of a small scene: no capacity may be withheld because a proof is missing, even if a single force has no
/// proof at first.
#[test]
fn every_block_of_the_doorway_has_a_capacity() {
    let scene = Scene::from_json(include_str!("../../assets/starter.json")).expect("valid");
    let analysis = Analysis::new(&scene);
    for (number, frame) in scene.frames().iter().enumerate() {
        for block in &frame.placed {
            let request = CapacityRequest::of_block(*block);
            let found = analysis.capacity(number, &request);
            assert!(found.is_ok(), "frame {number}, {block:?}: {found:?}");
        }
    }
}

/// A force on a stone high in a gabled wall. For larger downward forces, other mechanisms limit the set. So the last
/// vertices before the unbounded edges are more than ten times as far away as the first ones. If they are missed, the
/// set is withheld.
#[test]
fn far_vertices_before_an_unbounded_edge_are_found() {
    let text = include_str!("../../assets/gallery/gabled-wall.json");
    let scene = Scene::from_json(text).expect("valid");
    let stone = scene.block_named("16-1").expect("the block exists");
    let found = of(&scene, CapacityRequest::of_block(stone)).expect("a capacity");
    let far = found.vertices.iter().map(|v| libm::hypot(v.force[0], v.force[1]));
    let near = far.clone().fold(f64::INFINITY, f64::min);
    let far = far.fold(0.0, f64::max);
    assert!(far > 10.0 * near, "{near} N to {far} N");
    assert_eq!(found.rays.len(), 2);
}
