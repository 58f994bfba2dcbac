//! Pressures on the sides of blocks, loads that keep their amount, and load cases, compared with sums by hand.

use drystone::analysis::{MarginKind, MarginKinds, Options, Verdict};
use drystone::scene::format::{BlockEntry, BlockSide, CaseEntry, DepthEntry, LoadEntry, PressureEntry, SceneFile};
use drystone::snapshot::fact::{DIGITS, Facts};
use drystone::{Analysis, Scene, figure, figure::Kind, output};
use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::rectangle;

fn scene(file: Value) -> Scene {
    Scene::from_json(&file.to_string()).expect("a valid scene")
}

/// The largest factor on the loads with which the first frame stands.
fn factor(scene: &Scene) -> f64 {
    let options = Options::default().margins(MarginKinds::new(&[MarginKind::LoadFactor]));
    let margins = Analysis::with(scene, &options).frames[0].margins.clone().expect("requested");
    margins.most(MarginKind::LoadFactor).expect("a limit")
}

/// A block of width `b` and height `h`, m, with the unit weight 22 kN/m³, on level ground.
fn on_floor(b: f64, h: f64, friction: f64, loads: Value) -> Value {
    json!({ "drystone": 1, "friction": friction, "thickness": 2.0, "silence": ["friction_high"],
        "ground": [{ "polygon": [[-20, 0], [20, 0], [20, -1], [-20, -1]] }],
        "blocks": [{ "id": "dam", "polygon": [[0, 0], [b, 0], [b, h], [0, h]], "weight": 22e3 * b * h * 2.0 }],
        "loads": loads })
}

fn water(to: f64) -> Value {
    json!({ "surface": to, "unit_weight": 9810.0 })
}

#[test]
fn a_block_under_water_to_its_top_overturns_and_slides_where_sums_by_hand_say() {
    let (w, water_weight) = (22e3, 9810.0);
    let b = 1.25;
    let h = b * f64::sqrt(3.0 * w / water_weight);
    for side in ["left", "right"] {
        let loads = json!([{ "block": "dam", "side": side, "pressure": water(h) }]);
        let overturns = factor(&scene(on_floor(b, h, 9.0, loads)));
        assert!((overturns - 1.0).abs() < 1e-6, "{overturns}");
        let mu = 0.3;
        let h = 2.0 * mu * b * w / water_weight;
        let loads = json!([{ "block": "dam", "side": side, "pressure": water(h) }]);
        let slides = factor(&scene(on_floor(b, h, mu, loads)));
        assert!((slides - 1.0).abs() < 1e-6, "{slides}");
    }
}

/// A wall of courses 0.5 m high with a vertical back at x = 0, and earth behind it on the right.
fn wall(widths: &[f64], mu: f64, loads: Value) -> Value {
    let blocks = widths.iter().enumerate().map(|(k, width)| {
        let (y, top) = (0.5 * k as f64, 0.5 * (k + 1) as f64);
        json!({ "id": k.to_string(), "polygon": [[-width, y], [0, y], [0, top], [-width, top]], "weight": 23e3 * 0.5 * width })
    });
    json!({ "drystone": 1, "friction": mu, "ground": [{ "polygon": [[-5, 0], [5, 0], [5, -1], [-5, -1]] }],
        "blocks": blocks.collect::<Vec<_>>(), "loads": loads })
}

#[test]
fn earth_behind_a_wall_of_courses_has_the_load_factor_of_sums_by_hand() {
    let (k, gamma, delta, mu) = (0.3, 18e3, 20f64.to_radians(), 0.55);
    let widths = [1.4, 1.2, 1.0, 0.8];
    let height = 2.0;
    let earth = json!([{ "between": [[0, 0], [0, height]],
        "pressure": { "surface": height, "unit_weight": gamma, "coefficient": k, "friction_angle": 20.0 } }]);
    let found = factor(&scene(wall(&widths, mu, earth)));
    // For the part of the wall above each joint: λ H ≤ μ (W + λ V), and no moment about the front edge.
    let mut expected = f64::INFINITY;
    for joint in 0..widths.len() {
        let above = &widths[joint..];
        let h = height - 0.5 * joint as f64;
        let thrust = 0.5 * k * gamma * h * h;
        let (push, drag) = (thrust * libm::cos(delta), thrust * libm::sin(delta));
        let weight: f64 = above.iter().map(|width| 23e3 * 0.5 * width).sum();
        let front = widths[joint];
        let resists: f64 = above.iter().map(|width| 23e3 * 0.5 * width * (front - width / 2.0)).sum();
        // If the drag of the earth outweighs its push, the wall stands at every factor.
        let limits = [mu * weight / (push - mu * drag), resists / (push * h / 3.0 - drag * front)];
        expected = limits.into_iter().filter(|limit| *limit > 0.0).fold(expected, f64::min);
    }
    assert!((found - expected).abs() < 1e-6 * expected, "{found}, by hand {expected}");
}

#[test]
fn a_pressure_between_two_points_follows_the_free_outline_over_ledges_and_in_both_directions() {
    let stepped = |ends: Value| {
        let mut file = wall(&[1.0, 1.0], 0.6, json!([{ "between": ends, "pressure": 1000.0 }]));
        // The second course lies 0.1 m farther forward, so that a ledge is free at the back.
        file["blocks"][1]["polygon"] = json!([[-1.1, 0.5], [-0.1, 0.5], [-0.1, 1.0], [-1.1, 1.0]]);
        scene(file)
    };
    for ends in [json!([[0, 0], [-0.1, 1.0]]), json!([[-0.1, 1.0], [0, 0]])] {
        let scene = stepped(ends);
        let sum = scene.loads().iter().fold([0.0; 2], |[x, y], load| [x + load.force.x, y + load.force.y]);
        assert!((sum[0] + 1000.0).abs() < 1e-9 && (sum[1] + 100.0).abs() < 1e-9, "{sum:?}");
        assert_eq!(scene.loads().len(), 3);
    }
    // The front and the top are another path, of which only a part is asked for.
    let front = stepped(json!([[-1.0, 0.25], [-1.1, 0.75]]));
    let across: f64 = front.loads().iter().map(|load| load.force.x).sum();
    let up: f64 = front.loads().iter().map(|load| load.force.y).sum();
    assert!((across - 500.0).abs() < 1e-9 && (up - 100.0).abs() < 1e-9, "{across} {up}");
}

#[test]
fn a_linear_pressure_has_its_exact_resultant_and_moment() {
    let of = |pressure: Value| {
        let loads = json!([{ "block": "dam", "side": "left", "pressure": pressure }]);
        scene(on_floor(1.0, 3.0, 0.7, loads)).loads()[0]
    };
    // From 100 N/m² below to 400 N/m² above, on 3 m × 2 m: 1 500 N at 3 · (100 + 800) / (3 · 500) = 1.8 m.
    let load = of(json!([100.0, 400.0]));
    assert!((load.force.x - 1500.0).abs() < 1e-9 && (load.at.y - 1.8).abs() < 1e-12 && load.torque == 0.0);
    // From −100 to 100 N/m²: no force, but the moment 2 · 200 · 3² / 12 N·m. The push to the right above turns the
    // block clockwise.
    let load = of(json!([-100.0, 100.0]));
    assert!(load.force.norm() < 1e-12 && (load.torque + 300.0).abs() < 1e-9, "{}", load.torque);
}

#[test]
fn lengths_in_millimetres_and_forces_in_kilonewtons_give_the_same_pressure() {
    let metres = on_floor(1.0, 2.0, 0.7, json!([{ "block": "dam", "side": "left", "pressure": water(1.5) }]));
    let mut millimetres = metres.clone();
    millimetres["units"] = json!({ "length": "mm", "force": "kN" });
    millimetres["thickness"] = json!(2000.0);
    millimetres["ground"] = json!([{ "polygon": [[-20000, 0], [20000, 0], [20000, -1000], [-20000, -1000]] }]);
    millimetres["blocks"] =
        json!([{ "id": "dam", "polygon": [[0, 0], [1000, 0], [1000, 2000], [0, 2000]], "weight": 88.0 }]);
    millimetres["loads"][0]["pressure"] = json!({ "surface": 1500.0, "unit_weight": 9.81 });
    let [a, b] = [metres, millimetres].map(|file| scene(file).loads()[0]);
    assert!((a.force - b.force).norm() < 1e-9 * a.force.norm() && (a.at - b.at).norm() < 1e-12);
    assert!((a.force.x - 0.5 * 9810.0 * 1.5 * 1.5 * 2.0).abs() < 1e-9 && (a.at.y - 0.5).abs() < 1e-12);
}

#[test]
fn a_fixed_load_keeps_its_amount_when_the_load_factor_changes() {
    // The weight of 88 kN and a fixed push of 4 kN at 1 m; the other push of 1 kN at 2 m grows until the block topples.
    let loads = json!([
        { "id": "fixed", "block": "dam", "force": [4000, 0], "at": [0, 1], "fixed": true },
        { "id": "push", "block": "dam", "force": [1000, 0], "at": [0, 2] }]);
    let found = factor(&scene(on_floor(1.0, 2.0, 9.0, loads.clone())));
    assert!((found - (44e3 - 4e3) / 2e3).abs() < 1e-6 * found, "{found}");
    // If all loads are fixed, no factor exists.
    let mut only = loads;
    only[1]["fixed"] = json!(true);
    let options = Options::default().margins(MarginKinds::ALL);
    let frames = Analysis::with(scene(on_floor(1.0, 2.0, 9.0, only)), &options).frames;
    assert_eq!(frames[0].margins.as_ref().expect("requested").of(MarginKind::LoadFactor), None);
}

fn with_cases(cases: Value) -> Scene {
    let mut file = on_floor(
        1.0,
        2.0,
        0.7,
        json!([
        { "id": "push", "block": "dam", "force": [10e3, 0], "at": [0, 2] },
        { "id": "snow", "block": "dam", "force": [0, -20e3], "at": [0.5, 2] }]),
    );
    file["cases"] = cases;
    scene(file)
}

#[test]
fn a_frame_has_the_results_of_its_worst_case() {
    let cases = json!([
        { "id": "weight alone", "loads": {} },
        { "id": "push", "weights": 0.9, "loads": { "push": 1.5 } },
        { "id": "all" }]);
    let options = Options::default().margins(MarginKinds::ALL);
    let frame = Analysis::with(with_cases(cases.clone()), &options).frames.remove(0);
    let found = frame.cases.as_ref().expect("the scene has cases");
    assert_eq!(frame.verdict, Verdict::Stable);
    assert_eq!(found.each[found.governing].id, "push");
    // 0.9 · 88 kN · 0.5 m against 1.5 · 10 kN · 2 m.
    let at = frame.margins.as_ref().expect("requested").most(MarginKind::LoadFactor).expect("a limit");
    assert!((at - 0.9 * 44.0 / 30.0).abs() < 1e-6, "{at}");
    // The least normal force at the ground is 0.9 times the weight, in the case `push`. The greatest is the weight and
    // the snow together, in the case `all`.
    let [low, high] = found.envelope[0].normal;
    assert!((low - 0.9 * 88e3).abs() < 1e-3 && (high - 108e3).abs() < 1e-3, "{low} {high}");
    let [low, high] = found.envelope[0].friction;
    assert!(low.abs() < 1e-3 && (high - 15e3).abs() < 1e-3, "{low} {high}");
    // One case that falls lets the frame fall.
    let mut falls = cases;
    falls[1]["loads"]["push"] = json!(3.0);
    let analysis = Analysis::with(with_cases(falls.clone()), &Options::default());
    assert_eq!(analysis.verdict(), Verdict::Unstable);
    assert_eq!(drystone::analysis::verdicts(&with_cases(falls), &Options::default()), [Verdict::Unstable]);
}

/// The first step alone falls nearest to a push to the right; with the second block on its left, the push to the left
/// governs. Pictures, limits and single frames belong to the case of their own frame.
#[test]
fn each_step_has_the_scene_of_its_own_worst_case() {
    let mut file = on_floor(
        1.0,
        2.0,
        9.0,
        json!([{ "id": "right", "block": "dam", "force": [2e3, 0], "at": [0, 2] },
               { "id": "left", "block": "top", "force": [-5e3, 0], "at": [0.5, 3] }]),
    );
    file["blocks"]
        .as_array_mut()
        .expect("blocks")
        .push(json!({ "id": "top", "polygon": [[0, 2], [1, 2], [1, 3], [0, 3]], "weight": 44e3 }));
    file["cases"] =
        json!([{ "id": "to the right", "loads": { "right": 1 } }, { "id": "to the left", "loads": { "left": 2 } }]);
    file["steps"] = json!([{ "place": ["dam"] }, { "place": ["top"] }]);
    let analysis = Analysis::with(scene(file.clone()), &Options::default().margins(MarginKinds::ALL));
    let worst: Vec<&str> = analysis
        .frames
        .iter()
        .map(|frame| frame.cases.as_ref().expect("cases"))
        .map(|cases| cases.each[cases.governing].id.as_str())
        .collect();
    assert_eq!(worst, ["to the right", "to the left"]);
    for (number, load) in [(0, 2e3), (1, -10e3)] {
        let loads = analysis.at(number).scene.loads();
        assert_eq!((loads.len(), loads[0].force.x), (1, load));
        let svg =
            output::svg::write(&figure::panels_of(&analysis, Kind::Forces, &figure::Options::default(), &[number])[0]);
        let [own, other] = if number == 0 { ["right: 2 kN", "left: 10 kN"] } else { ["left: 10 kN", "right: 2 kN"] };
        let words = svg.replace('\u{a0}', " ");
        assert!(words.contains(&format!(">{own}<")) && !words.contains(&format!(">{other}<")), "{number}: {svg}");
        // Asked later or from the beginning, the sensitivity is that of all cases.
        let kind = MarginKind::LoadFactor;
        let asked = Analysis::with(analysis.given().clone(), &Options::default().sensitivity(kind));
        assert_eq!(analysis.sensitivity(number, kind).ok(), asked.frames[number].sensitivity, "{number}");
        assert!(asked.frames[number].sensitivity.is_some());
    }
    let written: Vec<f64> = analysis.given().loads().iter().map(|load| load.force.x).collect();
    assert_eq!(written, [2e3, -5e3]);
    // A snapshot states the loads as written, and beside them the factors, which differ in another scene.
    let mut facts = |factor: f64| {
        file["cases"][1]["loads"]["left"] = factor.into();
        Facts::new(&Analysis::new(scene(file.clone())), DIGITS)
    };
    let changes = facts(2.0).changes(&facts(2.5)).join("\n");
    assert!(
        changes.contains("load case to the left, left: factor 2 → 2.5") && !changes.contains("load dam"),
        "{changes}"
    );
}

#[test]
fn the_cases_on_the_page_of_questions_have_the_factors_that_it_states() {
    let read =
        |path: &str| std::fs::read_to_string(format!("{}/{path}", env!("CARGO_MANIFEST_DIR"))).expect("readable");
    let page = read("src/doc/questions.md");
    let scene = Scene::from_json(&read("assets/questions/retaining-wall.json")).expect("valid");
    let frame = Analysis::with(&scene, &Options::default().margins(MarginKinds::ALL)).frames.remove(0);
    let cases = frame.cases.as_ref().expect("the scene has cases");
    assert_eq!(cases.each.len(), 3);
    for case in &cases.each {
        let factor = case.margins.as_ref().expect("requested").most(MarginKind::LoadFactor).expect("a limit");
        let words =
            format!("case {}: stands, carries its loads times {:.2}", case.id, (100.0 * factor).floor() / 100.0);
        assert!(page.contains(&words), "{words}");
    }
}

#[test]
fn problems_of_loads_and_cases_name_their_place() {
    let file = json!({ "drystone": 1,
        "ground": [{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }],
        "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [0, 1]] }],
        "loads": [
            { "block": "a", "side": "bottom", "pressure": 1.0, "force": [1, 0] },
            { "block": "a", "pressure": 1.0 },
            { "side": "left", "pressure": 1.0 },
            { "between": [[0, 5], [1, 0]], "pressure": 1.0 },
            { "block": "a", "side": "left" },
            { "force": [1, 0] },
            { "block": "a", "side": "left", "pressure": { "surface": 1, "unit_weight": -1, "friction_angle": 100 } }],
        "cases": [{ "id": "c", "loads": { "wind": 1.5 } }, { "id": "c" }] });
    let problems = Scene::from_json(&file.to_string()).expect_err("refused");
    let paths: Vec<String> = problems.list.iter().map(|problem| problem.path.clone()).collect();
    for path in [
        "loads[0]",
        "loads[1]",
        "loads[2]",
        "loads[3].between",
        "loads[4]",
        "loads[5]",
        "loads[6].pressure.unit_weight",
        "loads[6].pressure.friction_angle",
        "cases[0].loads.wind",
        "cases[1].id",
    ] {
        assert!(paths.iter().any(|found| found == path), "no problem at {path}: {paths:?}");
    }
}

#[test]
fn scenes_with_pressures_and_cases_are_built_in_code() {
    let depth = PressureEntry::from(DepthEntry::below(1.0, 9810.0));
    let file = SceneFile::default()
        .ground([[-9.0, 0.0], [9.0, 0.0], [9.0, -1.0], [-9.0, -1.0]])
        .block(BlockEntry::from([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).id("a").weight(20e3))
        .load(LoadEntry::on("a").id("water").side(BlockSide::Left).pressure(depth))
        .load(LoadEntry::between([1.0, 0.0], [1.0, 1.0], 500.0).fixed(true))
        .case(CaseEntry::new("full").load("water", 1.2).load("2", 1.0));
    let read = Scene::from_json(&file.to_json()).expect("the written file is valid");
    let built = file.build().expect("valid");
    assert_eq!(built.cases(), read.cases());
    assert_eq!(built.cases()[0].loads, [1.2, 1.0]);
    assert!(read.loads().iter().zip(built.loads()).all(|(a, b)| (a.force - b.force).norm() < 1e-9));
}

/// A pressure on the free back of a stack, and its resultant on a part of the outline: [Fx, Fy, moment about the origin].
struct Earth {
    entry: Value,
    pressure: Box<dyn Fn(f64, f64) -> f64>,
    drag: f64,
}

impl Earth {
    /// Integrates the pressure along an edge with the block on its left. `from` is the length of the path before it, as
    /// a share of the whole path, and `share` the share of the edge.
    fn on(&self, [a, b]: [[f64; 2]; 2], [from, share]: [f64; 2]) -> [f64; 3] {
        let edge = [b[0] - a[0], b[1] - a[1]];
        let length = libm::hypot(edge[0], edge[1]);
        let (inward, down) = ([-edge[1] / length, edge[0] / length], f64::signum(-edge[1]));
        let level = edge[1].abs() < 1e-12;
        let drag = if level { 0.0 } else { self.drag };
        let (sin, cos) = (libm::sin(drag), libm::cos(drag));
        let along = [edge[0] / length * down, edge[1] / length * down];
        let direction = [inward[0] * cos + along[0] * sin, inward[1] * cos + along[1] * sin];
        let mut sum = [0.0; 3];
        // Midpoints of many pieces: exact for a linear pressure but for the moment and the kink at the surface.
        let count = 4000;
        for piece in 0..count {
            let t = (f64::from(piece) + 0.5) / f64::from(count);
            let at = [a[0] + edge[0] * t, a[1] + edge[1] * t];
            let force = (self.pressure)(at[1], from + share * t) * length / f64::from(count);
            sum[0] += force * direction[0];
            sum[1] += force * direction[1];
            sum[2] += force * (at[0] * direction[1] - at[1] * direction[0]);
        }
        sum
    }
}

fn random_earth(random: &mut Random, bottom: [f64; 2], top: [f64; 2]) -> Earth {
    let between = json!([bottom, top]);
    match random.below(3) {
        0 => {
            let p = random.between(500.0, 5000.0);
            let entry = json!({ "between": between, "pressure": p });
            Earth { entry, pressure: Box::new(move |_, _| p), drag: 0.0 }
        }
        1 => {
            let [p, q] = [random.between(0.0, 6000.0), random.between(-1000.0, 3000.0)];
            let entry = json!({ "between": between, "pressure": [p, q] });
            Earth { entry, pressure: Box::new(move |_, share| p + (q - p) * share), drag: 0.0 }
        }
        _ => {
            let [surface, weight] = [random.between(0.3, 1.2) * top[1], random.between(9e3, 20e3)];
            let [k, degrees] = [random.between(0.2, 1.0), random.between(-10.0, 30.0)];
            let depth =
                json!({ "surface": surface, "unit_weight": weight, "coefficient": k, "friction_angle": degrees });
            Earth {
                entry: json!({ "between": between, "pressure": depth }),
                pressure: Box::new(move |y, _| k * weight * (surface - y).max(0.0)),
                drag: degrees.to_radians(),
            }
        }
    }
}

/// A stack stands if at each joint the force from above lies within the friction cone and passes through the joint.
#[test]
fn random_walls_under_pressure_have_the_load_factors_of_sums_over_their_joints() {
    let mut random = Random::new(49);
    let mut compared = 0;
    for _ in 0..300 {
        let mu = random.between(0.2, 0.9);
        let count = 1 + random.below(5);
        let (mut left, mut right, mut y) = (0.0, random.between(0.6, 2.0), 0.0);
        let mut courses = Vec::new();
        for _ in 0..count {
            let height = random.between(0.2, 0.6);
            courses.push([left, right, y, y + height]);
            y += height;
            left += random.between(-0.1, 0.2);
            right = (right + random.between(-0.2, 0.1)).max(left + 0.3);
        }
        let earth = random_earth(&mut random, [courses[0][1], 0.0], [courses[count - 1][1], y]);
        // The back of the wall, from below to above: for each edge the course that it belongs to.
        let mut edges = Vec::new();
        for (k, [_, right, low, high]) in courses.iter().enumerate() {
            edges.push((k, [[*right, *low], [*right, *high]]));
            if let Some(next) = courses.get(k + 1) {
                let owner = if next[1] < *right { k } else { k + 1 };
                edges.push((owner, [[*right, *high], [next[1], *high]]));
            }
        }
        let length = |[a, b]: [[f64; 2]; 2]| libm::hypot(b[0] - a[0], b[1] - a[1]);
        let total: f64 = edges.iter().map(|(_, edge)| length(*edge)).sum();
        let mut pushes = vec![[0.0; 3]; count];
        let mut before = 0.0;
        for (owner, edge) in edges {
            let share = length(edge) / total;
            let push = earth.on(edge, [before, share]);
            before += share;
            (0..3).for_each(|k| pushes[owner][k] += push[k]);
        }
        // The forces above each joint are a + λ b; each condition is a linear function of λ.
        let (mut limit, mut stands) = (f64::INFINITY, true);
        for joint in 0..count {
            let (mut weight, mut push) = ([0.0; 3], [0.0; 3]);
            for (k, [left, right, low, high]) in courses.iter().enumerate().skip(joint) {
                let own = 23e3 * (right - left) * (high - low);
                weight = [0.0, weight[1] - own, weight[2] - own * 0.5 * (left + right)];
                (0..3).for_each(|c| push[c] += pushes[k][c]);
            }
            let [mut start, mut end, height, _] = courses[joint];
            if joint > 0 {
                (start, end) = (start.max(courses[joint - 1][0]), end.min(courses[joint - 1][1]));
            }
            // The normal force N, N ± friction, and the moments about both ends of the joint.
            let conditions = |f: [f64; 3]| {
                let moment = |x: f64| f[2] - (x * f[1] - height * f[0]);
                [-f[1], -mu * f[1] - f[0], -mu * f[1] + f[0], -moment(start), moment(end)]
            };
            for (a, b) in conditions(weight).into_iter().zip(conditions(push)) {
                stands &= a > 1.0;
                if b < 0.0 {
                    limit = limit.min(-a / b);
                }
            }
        }
        if !stands || !limit.is_finite() || limit > 1e3 {
            continue;
        }
        let blocks = courses.iter().map(|[left, right, low, high]| {
            json!({ "polygon": [[left, low], [right, low], [right, high], [left, high]],
                "weight": 23e3 * (right - left) * (high - low) })
        });
        let file = json!({ "drystone": 1, "friction": mu, "contact_tolerance": 1e-9,
            "ground": [{ "polygon": [[-9, 0], [9, 0], [9, -1], [-9, -1]] }],
            "blocks": blocks.collect::<Vec<_>>(), "loads": [earth.entry] });
        let found = factor(&scene(file.clone()));
        assert!((found - limit).abs() < 2e-6 * limit, "{found}, by sums {limit}: {file}");
        compared += 1;
    }
    assert!(compared > 150, "{compared}");
}

#[test]
fn densities_and_unit_weights_may_have_units() {
    let file = |density: Value, unit_weight: Value, units: Value| {
        json!({ "drystone": 1, "units": units, "friction": 0.6,
            "ground": [{ "polygon": rectangle(-1.0, -1.0, 6.0, 1.0) }],
            "blocks": [{ "id": "w", "polygon": rectangle(0.0, 0.0, 4.0, 6.0), "density": density }],
            "loads": [{ "block": "w", "side": "left", "pressure": { "surface": 4, "unit_weight": unit_weight } }] })
    };
    let feet = json!({ "length": "ft", "force": "lbf" });
    let cubic_foot = 0.3048_f64 * 0.3048 * 0.3048;
    let numbers = scene(file(json!(150.0 * 0.453_592_37 / cubic_foot), json!(62.4 / cubic_foot), feet.clone()));
    for (density, weight) in [("150 lb/ft3", "62.4 lbf/ft3"), ("150lb/ft³", "62.4 lbf/ft^3")] {
        let texts = scene(file(json!(density), json!(weight), feet.clone()));
        assert!((texts.blocks()[0].weight / numbers.blocks()[0].weight - 1.0).abs() < 1e-12);
        assert!((texts.loads()[0].force.x / numbers.loads()[0].force.x - 1.0).abs() < 1e-12);
    }
    let plain = scene(file(json!("2.4 t/m3"), json!("9.81 kN/m3"), json!({})));
    assert!((plain.blocks()[0].weight - 2400.0 * 24.0 * 9.81).abs() < 1e-6);
    assert!((plain.loads()[0].force.x - 9810.0 * 8.0).abs() < 1e-6, "{:?}", plain.loads()[0]);
    for wrong in ["9 stones/m3", "9 kg/m2", "kg/m3", "9 kN", "1e999 kg/m3"] {
        let text = file(json!(wrong), json!(9810), json!({})).to_string();
        let problems = drystone::Scene::from_json(&text).expect_err("not a density").to_string();
        assert!(problems.contains("such as \"18 kN/m3\""), "{problems}");
    }
}

#[test]
fn listed_contacts_name_parts_of_the_ground() {
    let file = |left: &str, right: &str| {
        json!({ "drystone": 1, "friction": 0.5,
            "ground": [{ "id": "A", "polygon": rectangle(0.0, -1.0, 1.0, 1.0) },
                { "id": "B", "polygon": rectangle(3.0, -1.0, 1.0, 1.0) }],
            "blocks": [{ "id": "w", "polygon": rectangle(0.0, 0.0, 4.0, 1.0) }],
            "contacts": [{ "bodies": ["w", left], "at": [0.5, 0], "normal": 90 },
                { "bodies": [right, "w"], "at": [3.5, 0], "normal": -90 }] })
    };
    for (left, right) in [("A", "B"), ("ground", "ground")] {
        let frame = crate::structure::first(&file(left, right));
        let parts: Vec<_> = frame.contacts.iter().map(|contact| contact.interface.bodies[1]).collect();
        assert_eq!(parts, [0, 1].map(drystone::scene::BodyId::Ground));
        assert_eq!(frame.verdict, drystone::analysis::Verdict::Stable);
    }
    let problems = drystone::Scene::from_json(&file("A", "C").to_string()).expect_err("no body C").to_string();
    assert!(problems.contains('C'), "{problems}");
}
