//! Separate code compares the assembly with the outlines. The result of a frame must not depend on blocks that are
//! placed later.
//!
//! Proofs sum forces with the assembly's centroids, load vectors and contacts. If those were wrong, every proof would
//! be wrong. Here areas and centroids are summed over triangles with the first corner (the library sums over edges),
//! and contacts are found by sampling points on both sides of every outline.

use std::fs;
use std::path::Path;

use drystone::analysis::{EffectName, Verdict};
use drystone::internals::assembly::Assembly;
use drystone::internals::effect::{FrameContext, assemble};
use drystone::internals::geometry::{Point, Vector};
use drystone::internals::interface::{ContactKind, Interfaces};
use drystone::internals::program::{Program, Scale, UnknownCounts, columns};
use drystone::scene::{BodyId, Frame};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::{arch, on_slope, rectangle, wall};

/// The scenes of the thesis's figures, and some scenes that are rotated.
fn scenes() -> Vec<(String, Value)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/thesis");
    let mut paths: Vec<_> = fs::read_dir(&folder)
        .expect("the scenes of the source are there")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    paths.sort();
    let mut scenes: Vec<(String, Value)> = paths
        .into_iter()
        .map(|path| {
            let text = fs::read_to_string(&path).expect("readable");
            let file = serde_json::from_str(&text).expect("sound JSON");
            (path.display().to_string(), file)
        })
        .collect();
    scenes.push(("arch".into(), arch(13, 0.2, 0.7)));
    scenes.push(("wall".into(), wall(4, 5)));
    scenes.push(("slope".into(), on_slope(17.0, 3.0, 2.0, 0.5, 0.3)));
    let mut loaded = wall(2, 3);
    loaded["gravity"] = json!([3.0, -7.0]);
    loaded["loads"] = json!([{ "block": "1", "force": [2.0, 5.0], "at": [0.3, 1.7], "torque": 0.7 },
        { "block": "1", "force": [-1.0, 0.5], "at": [0.1, 0.2] }]);
    scenes.push(("loaded".into(), loaded));
    scenes
}

fn assembly_of(scene: &Scene, frame: &Frame) -> (Assembly, Vec<ContactKind>) {
    let found = Interfaces::new(scene);
    let interfaces = found.in_frame(frame);
    let situation = FrameContext { scene, frame, interfaces: &interfaces };
    let kinds = interfaces.iter().map(|i| i.kind).collect();
    (assemble(&situation).0, kinds)
}

/// Area and first moments of a ring, summed over triangles that share its first corner.
fn by_triangles(ring: &[Point]) -> (f64, Vector) {
    let origin = ring[0];
    let mut area = 0.0;
    let mut moment = Vector::zeros();
    for pair in ring[1..].windows(2) {
        let (u, v) = (pair[0] - origin, pair[1] - origin);
        let twice = u.x * v.y - u.y * v.x;
        area += twice / 2.0;
        moment += (u + v) / 3.0 * (twice / 2.0);
    }
    (area, moment + origin.coords * area)
}

/// Whether a point lies in a body: a ray to the right crosses its outline and holes an odd number of times.
fn contains(scene: &Scene, body: BodyId, p: Point) -> bool {
    let polygon = &scene.body(body).polygon;
    let mut inside = false;
    let rings = std::iter::once(polygon.outline()).chain(polygon.holes().iter().map(|h| &h[..]));
    for ring in rings {
        for (k, a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
                inside = !inside;
            }
        }
    }
    inside
}

#[test]
fn centroids_and_load_vectors_are_those_of_the_outlines() {
    for (name, file) in scenes() {
        let scene = crate::structure::scene(&file);
        for frame in scene.frames() {
            let (assembly, _) = assembly_of(&scene, frame);
            assert_eq!(assembly.bodies.len(), frame.placed.len(), "{name}");
            for body in &assembly.bodies {
                let block = &scene.blocks()[body.block.0];
                let polygon = &block.body.polygon;
                let (mut area, mut moment) = by_triangles(polygon.outline());
                let sense = area.signum();
                for hole in polygon.holes() {
                    let (a, m) = by_triangles(hole);
                    area -= sense * a.abs();
                    moment -= m * (sense * a.signum());
                }
                let centroid = Point::from(moment / area);
                assert!((centroid - body.centroid).norm() < 1e-9, "{name}: {centroid}");
                // The loads are summed in components, with the moment about the origin.
                let g = scene.gravity();
                let pull = if g.norm() > 0.0 { g / g.norm() } else { g };
                let (mut fx, mut fy) = (pull.x * block.weight, pull.y * block.weight);
                let mut m = centroid.x * fy - centroid.y * fx;
                for load in scene.loads().iter().filter(|l| l.block == body.block) {
                    fx += load.force.x;
                    fy += load.force.y;
                    m += load.at.x * load.force.y - load.at.y * load.force.x + load.torque;
                }
                let own =
                    body.load.moment + (body.centroid.x * body.load.force.y - body.centroid.y * body.load.force.x);
                let size = 1.0 + block.weight.abs();
                assert!((body.load.force.x - fx).abs() < 1e-9 * size, "{name}");
                assert!((body.load.force.y - fy).abs() < 1e-9 * size, "{name}");
                assert!((own - m).abs() < 1e-8 * size, "{name}: {own} is not {m}");
            }
        }
    }
}

#[test]
fn contacts_lie_where_sampled_points_say_that_two_bodies_touch() {
    const HAIR: f64 = 1e-5;
    const SAMPLES: usize = 400;
    let mut sampled = 0;
    for (name, file) in scenes() {
        let scene = crate::structure::scene(&file);
        let Some(frame) = scene.frames().last() else {
            continue;
        };
        let (assembly, kinds) = assembly_of(&scene, frame);
        let mut bodies: Vec<BodyId> = (0..scene.ground().len()).map(BodyId::Ground).collect();
        bodies.extend(frame.placed.iter().map(|b| BodyId::Block(*b)));
        for body in &assembly.bodies {
            let me = BodyId::Block(body.block);
            let outline = scene.body(me).polygon.outline();
            // How much of this body's outline touches each other body.
            let mut touching = vec![0.0; bodies.len()];
            for (k, a) in outline.iter().enumerate() {
                let along = outline[(k + 1) % outline.len()] - a;
                let side = Vector::new(-along.y, along.x).normalize() * HAIR;
                for step in 0..SAMPLES {
                    let at = a + along * ((step as f64 + 0.5) / SAMPLES as f64);
                    let out = if contains(&scene, me, at + side) { at - side } else { at + side };
                    for (other, sum) in bodies.iter().zip(&mut touching) {
                        if *other != me && contains(&scene, *other, out) {
                            *sum += along.norm() / SAMPLES as f64;
                        }
                    }
                }
            }
            for (other, measured) in bodies.iter().zip(&touching) {
                let between = assembly
                    .contacts
                    .iter()
                    .filter(|c| c.kind == ContactKind::Edge && (c.bodies == [me, *other] || c.bodies == [*other, me]));
                let found: f64 = between.map(|c| (c.ends[1] - c.ends[0]).norm()).sum();
                let perimeter: f64 =
                    outline.iter().enumerate().map(|(k, a)| (outline[(k + 1) % outline.len()] - a).norm()).sum();
                let coarse = 2.0 * perimeter / SAMPLES as f64 + 4.0 * HAIR;
                assert!(
                    (found - measured).abs() <= coarse,
                    "{name}: {me:?} and {other:?} touch along {measured} m, the assembly has {found} m"
                );
                sampled += usize::from(*measured > 0.0);
            }
        }
        for contact in assembly.contacts.iter().filter(|c| c.kind == ContactKind::Edge) {
            let [on, from] = contact.bodies;
            for share in [0.05, 0.35, 0.65, 0.95] {
                let at = contact.ends[0] + (contact.ends[1] - contact.ends[0]) * share;
                assert!(contains(&scene, on, at + contact.normal * HAIR), "{name}");
                assert!(contains(&scene, from, at - contact.normal * HAIR), "{name}");
            }
            let inward = (contact.points[0] - contact.ends[0]).norm();
            let length = (contact.ends[1] - contact.ends[0]).norm();
            assert!((inward - scene.kernel() / 2.0 * length).abs() < 1e-12, "{name}");
        }
        assert_eq!(assembly.contacts.len(), kinds.len(), "{name}");
    }
    assert!(sampled > 150, "only {sampled} touching pairs were sampled");
}

#[test]
fn components_contain_every_body_contact_and_grip_once_and_effects_count_all_unknowns() {
    for (name, file) in scenes() {
        let scene = crate::structure::scene(&file);
        let analysis = Analysis::new(&scene);
        for (frame, result) in scene.frames().iter().zip(&analysis.frames) {
            let (assembly, _) = assembly_of(&scene, frame);
            let parts = assembly.components();
            let count = |of: fn(&Assembly) -> usize| parts.iter().map(of).sum::<usize>();
            assert_eq!(count(|p| p.bodies.len()), assembly.bodies.len(), "{name}");
            assert_eq!(count(|p| p.contacts.len()), assembly.contacts.len(), "{name}");
            assert_eq!(count(|p| p.grips.len()), assembly.grips.len(), "{name}");
            let mut unknowns = 0;
            for part in &parts {
                let program = Program::new(part, Scale::from_assembly(part));
                let all = columns(&program);
                unknowns += all.len();
                let count = UnknownCounts::new(&program);
                assert_eq!(
                    [
                        EffectName::Contact,
                        EffectName::Friction,
                        EffectName::CornerContacts,
                        EffectName::Robots,
                        EffectName::RobotTorque,
                    ]
                    .map(|effect| count.get(effect))
                    .iter()
                    .sum::<usize>(),
                    all.len()
                );
            }
            let reported: usize = result
                .effects
                .iter()
                .filter(|e| e.simulated && e.effect != EffectName::Sticking)
                .map(|e| e.unknowns)
                .sum();
            assert_eq!(reported, unknowns, "{name}: {:?}", result.effects);
        }
    }
}

#[test]
fn an_effect_that_a_frame_does_not_need_is_not_in_the_assembly() {
    let mut smooth = wall(2, 3);
    smooth["friction"] = json!(0.0);
    let smooth = crate::structure::scene(&smooth);
    let (assembly, _) = assembly_of(&smooth, &smooth.frames()[0]);
    assert!(assembly.contacts.iter().all(|c| c.friction == 0.0));
    assert!(assembly.contacts.iter().all(|c| c.points == c.ends));
    assert!(assembly.grips.is_empty());
    let program = Program::new(&assembly, Scale::from_assembly(&assembly));
    assert_eq!(columns(&program).len(), 2 * assembly.contacts.len());
}

/// A random building sequence: bricks of many widths on a floor, some of them held by robots for a while.
fn sequence(seed: u64) -> Value {
    let mut numbers = Random::new(seed);
    let mut random = |n: u64| numbers.next() % n;
    let mut blocks = Vec::new();
    let mut steps = Vec::new();
    let mut heights = [0.0; 4];
    let mut held: Option<String> = None;
    for number in 0..8 {
        let column = random(4) as usize;
        let width = 0.4 + 0.1 * random(9) as f64;
        let height = 0.25 * (1 + random(4)) as f64;
        let left = 1.7 * column as f64 + 0.05 * random(6) as f64;
        let id = format!("b{number}");
        blocks.push(json!({ "id": id, "polygon": rectangle(left, heights[column], width, height) }));
        heights[column] += height;
        let mut step = json!({ "title": id, "place": [id] });
        match (held.take(), random(3)) {
            (None, 0) => {
                step["hold"] = json!({ "r": id });
                held = Some(id);
            }
            (Some(_), 0) => step["release"] = json!(["r"]),
            (kept, _) => held = kept,
        }
        steps.push(step);
    }
    json!({ "drystone": 1, "friction": 0.6, "kernel": 0.1,
        "ground": [{ "polygon": rectangle(-1.0, -1.0, 10.0, 1.0) }],
        "blocks": blocks, "steps": steps,
        "robots": [{ "id": "r", "limits": { "force": 30.0, "torque": 2.0 } }] })
}

#[test]
fn a_frame_has_the_result_of_a_scene_with_only_its_blocks() {
    let (mut frames, mut falling) = (0, 0);
    for seed in 1..40 {
        let file = sequence(seed);
        let scene = crate::structure::scene(&file);
        let whole = Analysis::new(&scene);
        for (frame, result) in scene.frames().iter().zip(&whole.frames) {
            // The same frame as a separate file: only the placed blocks, with the robots that hold them in this
            // frame.
            let mut alone = file.clone();
            alone.as_object_mut().expect("an object").remove("steps");
            let placed: Vec<&str> = frame.placed.iter().map(|b| scene.blocks()[b.0].id.as_str()).collect();
            alone["blocks"]
                .as_array_mut()
                .expect("blocks")
                .retain(|b| placed.contains(&b["id"].as_str().expect("an id")));
            for hold in &frame.holds {
                alone["robots"][hold.robot.0]["holds"] = json!(scene.blocks()[hold.block.0].id);
                alone["robots"][hold.robot.0]["at"] = json!([hold.at.x, hold.at.y]);
            }
            let alone = crate::structure::first(&alone);
            let name = format!("sequence {seed}, {}", frame.title);
            assert_eq!(alone.verdict, result.verdict, "{name}");
            assert_eq!(alone.length, result.length, "{name}");
            let same = |a: f64, b: f64| (a - b).abs() <= 1e-7 * (1.0 + a.abs().max(b.abs()));
            assert!(same(alone.total_force, result.total_force), "{name}");
            assert!(same(alone.total_sticking, result.total_sticking), "{name}");
            for (a, b) in alone.contacts.iter().zip(&result.contacts) {
                assert_eq!(a.interface.ends, b.interface.ends, "{name}");
                assert!(same(a.friction_force, b.friction_force), "{name}");
                for k in 0..2 {
                    assert!(same(a.normal_forces[k], b.normal_forces[k]), "{name}");
                }
            }
            frames += 1;
            falling += usize::from(result.verdict == Verdict::Unstable);
        }
    }
    assert!(frames > 300 && falling > 20, "{falling} of {frames} frames fall");
}

/// A box of 4 m by 3 m on the ground with a load and a robot. Lengths are divided by L = 4 m, the length of the
/// joint, and forces are scaled so that the heaviest load is 300.
#[test]
fn a_program_scales_lengths_by_l_and_forces_by_the_heaviest_load() {
    let file = json!({ "drystone": 1, "friction": 0.5, "kernel": 0.5,
        "ground": [{ "polygon": rectangle(-1.0, -1.0, 9.0, 1.0) }],
        "blocks": [{ "id": "a", "polygon": rectangle(0.0, 0.0, 4.0, 3.0), "weight": 600 }],
        "loads": [{ "block": "a", "force": [10, 0], "at": [2, 3], "torque": 3 }],
        "robots": [{ "id": "r", "holds": "a", "at": [0, 3], "limits": { "fx": 20, "fy": 50, "torque": 64 } }] });
    let scene = Scene::from_json(&file.to_string()).expect("a sound scene");
    let (assembly, _) = assembly_of(&scene, &scene.frames()[0]);
    let scale = Scale::from_assembly(&assembly);
    assert_eq!((scale.length, scale.moment()), (4.0, 4.0 * scale.force));
    // The load and the weight together are a little more than the weight alone.
    let heaviest = libm::hypot(600.0, 10.0);
    assert!((scale.force * Scale::HEAVIEST - heaviest).abs() < 1e-9);
    let program = Program::new(&assembly, scale);
    // 10 N, 1.5 m above the centroid, turn by −15 N·m.
    let loads = [-10.0, 600.0, (15.0 - 3.0) / 4.0].map(|v| v / scale.force);
    for (found, expected) in program.loads.iter().zip(loads) {
        assert!((found - expected).abs() < 1e-9, "{:?}", program.loads);
    }
    // The application points lie 1 m to either side of the centroid and 1.5 m below it, ordered from left to right.
    let arms = [Vector::new(0.25, -0.375), Vector::new(-0.25, -0.375)];
    assert_eq!((program.contacts[0].on, program.contacts[0].from), ((0, arms), None));
    assert_eq!(program.grips[0].arm, Vector::new(-0.5, 0.375));
    let limits = program.grips[0].limits;
    assert!((limits[0] * scale.force - 20.0).abs() < 1e-9);
    assert!((limits[1] * scale.force - 50.0).abs() < 1e-9);
    assert!((limits[2] * scale.moment() - 64.0).abs() < 1e-9);
    // Without loads, the unit of force is 1/300 N.
    assert_eq!(Scale::new(2.0, 0.0).force, 1.0 / 300.0);
}
