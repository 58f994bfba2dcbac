//! Answers of scenes with load cases or a vehicle hold in every condition: compared with analyses of each condition alone.

use std::io::Write;
use std::process::{Command, Stdio};

use drystone::analysis::{
    CapacityRequest, Condition, FrameAnalysis, Interval, MarginKind, MarginKinds, MovementOutcome, Options, Verdict,
};
use drystone::geometry::Point;
use drystone::result::{Layout, Timing, to_json};
use drystone::scene::BlockId;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::scene;

const WALL: &str = include_str!("../../assets/questions/retaining-wall.json");
const BRIDGE: &str = include_str!("../../assets/questions/bridge-vehicle.json");

fn asked() -> Options {
    Options::default().margins(MarginKinds::ALL).placement(true).removable(true)
}

fn frame(scene: Scene, options: &Options) -> FrameAnalysis {
    FrameAnalysis::clone(&Analysis::with(scene, options).frames[0])
}

/// Both ends of an interval; a lower end above the upper end if it is empty.
fn ends(interval: &Interval) -> [f64; 2] {
    match interval {
        Interval::Empty(_) => [1.0, 0.0],
        Interval::Between { low, high } => {
            [low.value().unwrap_or(f64::NEG_INFINITY), high.value().unwrap_or(f64::INFINITY)]
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn answers_of_random_load_cases_are_those_of_the_worst_of_each() {
    let mut random = Random::new(62);
    let mut decided = [0; 2];
    for number in 0..12 {
        let mut file: Value = serde_json::from_str(WALL).expect("JSON");
        let mut factor = || (random.below(5) as f64) * 0.4;
        let case = |id: &str, of: &mut dyn FnMut() -> f64| {
            let loads = json!({ "earth": of(), "people": of(), "wind": of() });
            json!({ "id": id, "weights": 0.6 + 0.3 * of(), "loads": loads })
        };
        let [a, b] = [case("a", &mut factor), case("b", &mut factor)];
        let mut with = |cases: Value| {
            file["cases"] = cases;
            frame(scene(&file), &asked())
        };
        let (both, alone) = (with(json!([a, b])), [with(json!([a])), with(json!([b]))]);
        assert_eq!(Some(both.verdict), alone.iter().map(|own| own.verdict).max(), "{number}");
        let margins = |found: &FrameAnalysis| found.margins.clone().expect("requested");
        for kind in [MarginKind::Friction, MarginKind::Tilt, MarginKind::Kernel, MarginKind::LoadFactor] {
            let list = margins(&both);
            let found = list.margin(kind).expect("a margin");
            let own = alone.each_ref().map(|one| margins(one).of(kind).map(ends));
            let [low, high] = [f64::max as fn(f64, f64) -> f64, f64::min].map(|of| {
                let end = usize::from(of(0.0, 1.0) == 0.0);
                own.iter().flatten().map(|ends| ends[end]).reduce(of).expect("an end")
            });
            if low > high {
                assert!(matches!(found.interval, Interval::Empty(_)), "{number} {kind:?} {found:?}");
                continue;
            }
            assert_eq!(ends(&found.interval), [low, high], "{number} {kind:?}");
            // The named case has this end.
            for (end, Condition { case, .. }) in found.conditions.into_iter().enumerate() {
                let case = case.expect("a case");
                decided[case] += 1;
                assert_eq!(own[case].expect("an interval")[end], [low, high][end], "{number} {kind:?}");
            }
        }
        let placed = alone.each_ref().map(|own| own.placement.as_ref().map(|own| own.proved));
        let least = placed[0].zip(placed[1]).map(|(a, b)| a.min(b));
        assert_eq!(both.placement.as_ref().map(|own| own.proved), least, "{number}");
        let rows = |found: &FrameAnalysis| found.removable.clone().expect("requested");
        for ((row, a), b) in rows(&both).into_iter().zip(rows(&alone[0])).zip(rows(&alone[1])) {
            assert_eq!(row.rest, a.rest.max(b.rest), "{number}");
            assert_eq!(row.force, a.force.zip(b.force).map(|(a, b)| a.max(b)), "{number}");
        }
    }
    assert!(decided.iter().all(|count| *count > 10), "{decided:?}");
}

#[test]
fn the_worst_case_does_not_depend_on_what_is_asked() {
    let file: Value = serde_json::from_str(WALL).expect("JSON");
    let tilt = MarginKinds::new(&[MarginKind::Tilt]);
    for options in [Options::default(), Options::default().margins(tilt), asked()] {
        let found = frame(scene(&file), &options);
        let cases = found.cases.as_ref().expect("cases");
        assert_eq!(cases.each[cases.governing].id, "earth and people");
        assert_eq!(found.margins.is_some(), !options.ask.margins.is_empty());
    }
}

#[test]
fn a_wall_with_three_cases_has_the_margins_of_the_worst_of_each() {
    let found = frame(scene(&serde_json::from_str(WALL).expect("JSON")), &asked());
    let right = found.margins.as_ref().and_then(|margins| margins.most(MarginKind::Tilt)).expect("a tilt");
    assert!((right - 32.218).abs() < 1e-3, "{right}");
    let placed = found.placement.expect("it stands").proved;
    assert!((placed - 0.132_04).abs() < 1e-5, "{placed}");
}

#[test]
fn results_name_the_case_or_the_position_that_decides_each_answer() {
    let json = |file: &str| -> Value {
        let analysis = Analysis::with(scene(&serde_json::from_str(file).expect("JSON")), &asked());
        serde_json::from_str(&to_json(&analysis, Timing::LeftOut, Layout::OneLine)).expect("JSON of the result")
    };
    let own = |of: Value| of["frames"][0]["conditions"].clone();
    let wall = own(json(WALL));
    let [people, wind] = ["earth and people", "wind"].map(|id| json!({ "case": id }));
    assert_eq!(wall["margins"]["tilt"], json!([people, wind]));
    assert_eq!((&wall["margins"]["load_factor"][1], &wall["margins"]["friction"][0]), (&people, &people));
    assert_eq!((&wall["margins"]["kernel"][1], &wall["margins"]["horizontal_load"][1]), (&people, &wind));
    assert_eq!((&wall["placement"], &wall["removable"][0]["case"]), (&json!([wind, wind]), &json!("earth alone")));
    let analysis = Analysis::with(
        scene(&serde_json::from_str(BRIDGE).expect("JSON")),
        &Options::default().margins(MarginKinds::ALL),
    );
    let bridge: Value =
        serde_json::from_str(&to_json(&analysis, Timing::LeftOut, Layout::OneLine)).expect("JSON of the result");
    let position = &bridge["frames"][0]["vehicle"]["governing"];
    let bridge = own(bridge.clone());
    assert_eq!(&bridge["margins"]["load_factor"][1]["position"], position);
    // The largest kernel belongs to another position than the least factor.
    let of = |kind: &str, end: usize| bridge["margins"][kind][end]["position"].as_u64();
    assert_eq!((of("friction", 0), of("kernel", 1)), (position.as_u64(), Some(61)));
    assert!(["tilt", "horizontal_load"].into_iter().all(|kind| of(kind, 0).is_some() && of(kind, 1).is_some()));
    // A beam of weight 6 from x = -1 to 2 on a floor from 0 to 1 falls under an axle at its left end, unless a block of 20
    // lies on its middle.
    let ballast = json!({ "drystone": 1, "ground": [{ "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]] }],
        "blocks": [{ "polygon": [[-1, 0], [2, 0], [2, 1], [-1, 1]], "weight": 6 },
            { "polygon": [[0, 1], [1, 1], [1, 2], [0, 2]], "weight": 20 }],
        "vehicle": { "axles": [{ "weight": 4 }] } });
    let ballast = json(&ballast.to_string());
    let row = &ballast["frames"][0]["conditions"]["removable"][1];
    assert_eq!(ballast["frames"][0]["removable"][1]["stands"], false);
    let position = row["position"].as_u64().expect("a position") as usize;
    assert_eq!(ballast["frames"][0]["vehicle"]["positions"][position]["at"], -1.0);
}

/// A ladder of 100 N on a floor with friction `mu`, whose upper corner touches a wall.
fn ladder(mu: f64, corners: impl Into<Value>) -> FrameAnalysis {
    let file = json!({ "drystone": 1, "friction": mu, "corner_contacts": corners.into(), "ground": [
            { "id": "floor", "polygon": [[-3, -1], [3.2, -1], [3.2, 0], [-3, 0]] },
            { "id": "wall", "polygon": [[2.2, 0], [3.2, 0], [3.2, 6], [2.2, 6]] }],
        "blocks": [{ "id": "ladder", "polygon": [[0, 0], [0.12, 0], [2.2, 4.5], [2.1, 4.55]], "weight": 100 }] });
    frame(scene(&file), &Options::default().margins(MarginKinds::ALL))
}

#[test]
fn a_ladder_that_stands_only_by_its_corner_says_so() {
    let analysis = |mu: f64, corners: bool| {
        let found = ladder(mu, corners);
        (found.verdict, found.corners_decide)
    };
    assert_eq!(analysis(0.6, false), (Verdict::Unstable, true));
    assert_eq!(analysis(0.6, true), (Verdict::Stable, true));
    // All corners, or those on edges, are the same here.
    assert_eq!((ladder(0.6, "on_edges").verdict, ladder(0.6, "on_edges").corners_decide), (Verdict::Stable, true));
    // On a slippery floor it falls in any case.
    assert_eq!(analysis(0.05, false), (Verdict::Unstable, false));
    assert_eq!(analysis(0.05, true), (Verdict::Unstable, false));
    let falls = ladder(0.6, false);
    assert!(
        falls.notices.iter().any(|notice| notice.contains("--set corner_contacts=on_edges")),
        "{:?}",
        falls.notices
    );
    let stands = ladder(0.6, "on_edges");
    assert_eq!(stands.verdict, Verdict::Stable);
    assert!(stands.notices.iter().any(|notice| notice.contains("only because corners")), "{:?}", stands.notices);
}

#[test]
fn a_corner_that_just_misses_an_edge_is_noted() {
    let notices = |gap: f64| {
        let file = json!({ "drystone": 1, "friction": 0.6, "contact_tolerance": 1e-6,
            "ground": [{ "id": "floor", "polygon": [[-3, -1], [3.2, -1], [3.2, 0], [-3, 0]] },
                { "id": "wall", "polygon": [[2.2 + gap, 0], [3.2, 0], [3.2, 6], [2.2 + gap, 6]] }],
            "blocks": [{ "id": "ladder", "polygon": [[0, 0], [0.12, 0], [2.2, 4.5], [2.1, 4.55]], "weight": 100 }] });
        Analysis::new(crate::structure::scene(&file)).frames[0].notices.join("; ")
    };
    let near = notices(5e-6);
    for words in ["ladder and wall", "1×10⁻⁶ m", "`--set contact_tolerance=1.00e-5 --set corner_contacts=on_edges`"]
    {
        assert!(near.contains(words), "{words}: {near}");
    }
    assert!(!notices(0.0).contains("comes near") && !notices(5e-5).contains("comes near"));
}

#[test]
fn answers_of_a_bridge_hold_at_every_position_of_its_vehicle() {
    let file: Value = serde_json::from_str(BRIDGE).expect("JSON");
    let kinds = MarginKinds::new(&[MarginKind::Tilt, MarginKind::Kernel, MarginKind::Friction]);
    let options = Options::default().margins(kinds);
    let block = scene(&file).block_named("A5").expect("a stone");
    let asked = options.capacity(CapacityRequest::of_block(block));
    let analysis = Analysis::with(scene(&file), &asked);
    let found = &analysis.frames[0];
    assert_eq!(found.verdict, Verdict::Stable);
    let line = found.vehicle.as_ref().expect("an influence line");
    let at = |axles: &[(usize, BlockId, Point)]| {
        let mut loaded = file.clone();
        let loads = axles.iter().map(|(axle, block, at)| {
            let weight = file["vehicle"]["axles"][*axle]["weight"].as_f64().expect("a weight");
            json!({ "block": analysis.given().blocks()[block.0].id, "at": [at.x, at.y], "force": [0, -weight] })
        });
        loaded["loads"] = loads.collect();
        loaded.as_object_mut().expect("an object").remove("vehicle");
        frame(scene(&loaded), &asked)
    };
    let each: Vec<FrameAnalysis> = line.positions.iter().map(|position| at(&position.axles)).collect();
    let ends = |found: &FrameAnalysis| {
        let margins = found.margins.as_ref().expect("asked");
        [
            margins.most(MarginKind::Tilt).expect("a tilt"),
            -margins.least(MarginKind::Tilt).expect("a tilt"),
            margins.most(MarginKind::Kernel).expect("a kernel"),
            1.0 / margins.least(MarginKind::Friction).expect("a friction"),
        ]
    };
    let whole = ends(found);
    for (kind, whole) in whole.into_iter().enumerate() {
        let least = each.iter().map(|own| ends(own)[kind]).fold(f64::INFINITY, f64::min);
        assert!((whole - least).abs() <= 1e-5 * least, "{kind}: {whole} {least}");
    }
    let carried = found.capacity.as_ref().expect("asked");
    for corner in &carried.vertices {
        let inside = corner.force * 0.9999;
        assert!(each.iter().all(|own| own.capacity.as_ref().is_some_and(|own| own.contains([inside.x, inside.y]))));
    }
    for edge in &carried.edges {
        let [from, to] = edge.ends.map(|end| carried.vertices[end.expect("a polygon")].force);
        let beyond = (from + to) * 0.5 + edge.normal * (1e-4 * edge.limit.abs());
        let own = edge.condition.position.map(|position| &each[position]).expect("a position");
        assert!(own.capacity.as_ref().is_some_and(|own| !own.contains([beyond.x, beyond.y])));
    }
}

#[test]
fn the_headline_of_a_scene_with_movements_states_the_first_one() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/questions/spreading-arch.json"));
    let found = Analysis::with(
        Scene::from_json(&text.expect("there")).expect("sound"),
        &Options::default().margins(MarginKinds::ALL),
    );
    let page = drystone::figure::draw(&found, drystone::figure::Kind::Forces, &drystone::figure::Options::default());
    let svg = drystone::output::svg::write(&page);
    assert!(svg.contains("4 joints open by up to 1.36 mm if right moves by (0.01, 0) m (1 of 2 movements)"), "{svg}");
}

#[test]
fn the_part_of_the_ground_that_carries_nothing_is_drawn_where_it_faces_the_structure() {
    let shown = |x: f64| {
        let file = json!({ "drystone": 1, "ground": [
                { "polygon": [[-3, -1], [3, -1], [3, 0], [-3, 0]] },
                { "polygon": [[x, 0], [x + 1.0, 0], [x + 1.0, 6], [x, 6]] }],
            "blocks": [{ "polygon": [[0, 0], [2, 0], [2, 4], [0, 4]], "weight": 100 }] });
        let found = Analysis::new(scene(&file));
        let options = drystone::figure::Options::default();
        let page = drystone::figure::draw(&found, drystone::figure::Kind::Structure, &options);
        drystone::output::svg::write(&page).matches("class=\"earth\"").count()
    };
    // A wall a hand's breadth away, and one far away.
    assert_eq!([shown(2.1), shown(50.0)], [2, 1]);
}

/// A beam of 6 N on two posts under an axle of 4 N.
fn beam() -> Value {
    json!({ "drystone": 1, "friction": 0.6, "ground": [{ "polygon": [[-1, -2], [7, -2], [7, 0], [-1, 0]] }],
        "blocks": [{ "id": "left", "polygon": [[0.5, 0], [1.5, 0], [1.5, 1], [0.5, 1]], "weight": 3 },
            { "id": "right", "polygon": [[4.5, 0], [5.5, 0], [5.5, 1], [4.5, 1]], "weight": 3 },
            { "id": "beam", "polygon": [[-0.5, 1], [6.5, 1], [6.5, 1.5], [-0.5, 1.5]], "weight": 6 }],
        "vehicle": { "axles": [{ "weight": 4 }, { "weight": 2, "offset": 0.8 }] } })
}

#[test]
fn placement_and_help_hold_at_every_position() {
    let analysis = Analysis::with(scene(&beam()), &asked());
    let found = &analysis.frames[0];
    assert_eq!(found.verdict, Verdict::Stable, "{:?}", found.notices);
    let line = found.vehicle.as_ref().expect("an influence line");
    let at = |axles: &[(usize, BlockId, Point)]| {
        let mut loaded = beam();
        let loads = axles.iter().map(|(axle, block, at)| {
            let weight = [4.0, 2.0][*axle];
            json!({ "block": analysis.given().blocks()[block.0].id, "at": [at.x, at.y], "force": [0, -weight] })
        });
        loaded["loads"] = loads.collect();
        loaded.as_object_mut().expect("an object").remove("vehicle");
        frame(scene(&loaded), &asked())
    };
    let each: Vec<FrameAnalysis> = line.positions.iter().map(|position| at(&position.axles)).collect();
    let least = each.iter().filter_map(|own| Some(own.placement.as_ref()?.proved)).fold(f64::INFINITY, f64::min);
    let whole = found.placement.as_ref().expect("asked").proved;
    assert!((whole - least).abs() <= 1e-3 * least, "{whole} {least}");
    // Without a post, a robot that holds the beam suffices without the vehicle, but not with the axles beyond it.
    let rows = found.removable.as_ref().expect("asked");
    let mut bare = beam();
    bare.as_object_mut().expect("an object").remove("vehicle");
    let bare = frame(scene(&bare), &asked()).removable.expect("asked");
    assert_eq!((rows[1].rest, rows[1].help), (Verdict::Unstable, None));
    assert!(bare[1].help.is_some(), "{bare:?}");
    let help = |own: &FrameAnalysis| own.removable.as_ref().is_some_and(|rows| rows[1].help.is_some());
    assert!(each.iter().any(help) && !each.iter().all(help));
}

#[test]
fn each_case_has_its_capacity_movement_and_sensitivity() {
    let mut file = crate::structure::arch(7, 0.5, 0.7);
    file["ground"] = json!([{ "id": "left", "polygon": [[-2, -1], [0, -1], [0, 0], [-2, 0]] },
        { "id": "right", "polygon": [[0, -1], [2, -1], [2, 0], [0, 0]] }]);
    file["movements"] = json!([{ "ground": "left", "translation": [-0.01, 0] }]);
    file["loads"] =
        json!([{ "id": "snow", "block": "v3", "force": [0, -20] }, { "id": "wind", "block": "v2", "force": [15, 0] }]);
    file["cases"] = json!([{ "id": "snow", "loads": { "snow": 1.5 } }, { "id": "wind", "loads": { "wind": 1 } }]);
    let block = scene(&file).block_named("v3").expect("a stone");
    let options = Options::default()
        .margins(MarginKinds::ALL)
        .sensitivity(MarginKind::Tilt)
        .capacity(CapacityRequest::of_block(block));
    let found = frame(scene(&file), &options);
    let alone = |id: &str| {
        let mut one = file.clone();
        one["cases"] =
            file["cases"].as_array().expect("cases").iter().filter(|case| case["id"] == id).cloned().collect();
        frame(scene(&one), &options)
    };
    let each = ["snow", "wind"].map(alone);
    let cases = found.cases.as_ref().expect("cases");
    for (case, own) in cases.each.iter().zip(&each) {
        let [MovementOutcome::Follows(here), MovementOutcome::Follows(there)] =
            [&case.movements[0].outcome, &own.movements[0].outcome]
        else {
            panic!("{:?}", case.movements);
        };
        assert!((here.force - there.force).norm() <= 1e-6 * there.force.norm(), "{:?} {:?}", here.force, there.force);
    }
    let carried = found.capacity.as_ref().expect("asked");
    for corner in &carried.vertices {
        let inside = corner.force * 0.9999;
        assert!(each.iter().all(|own| own.capacity.as_ref().is_some_and(|own| own.contains([inside.x, inside.y]))));
    }
    assert!(!carried.edges.is_empty());
    for edge in &carried.edges {
        let case = edge.condition.case.expect("a case");
        let own = each[case].capacity.as_ref().expect("asked");
        let same = |other: &drystone::analysis::CapacityEdge| {
            (other.limit - edge.limit).abs() <= 1e-6 * edge.limit.abs().max(1.0)
                && (other.normal - edge.normal).norm() <= 1e-6
        };
        assert!(own.edges.iter().any(same), "{edge:?}");
    }
    // The derivatives of an end are those of the case that decides it.
    let conditions =
        found.margins.as_ref().and_then(|margins| margins.margin(MarginKind::Tilt)).expect("asked").conditions;
    let all = found.sensitivity.as_ref().expect("asked");
    for (end, condition) in [(&all.low, conditions[0]), (&all.high, conditions[1])] {
        let own = each[condition.case.expect("a case")].sensitivity.as_ref().expect("asked");
        let own = [&own.low, &own.high].map(|end| end.as_ref().map(|end| end.value));
        let value = end.as_ref().expect("an end").value;
        assert!(own.iter().flatten().any(|own| (own - value).abs() <= 1e-9 * value.abs()), "{value} {own:?}");
    }
}

#[test]
fn joints_in_sets_have_their_friction_and_a_factor_acts_on_the_named_ones() {
    let file = |on: Value| {
        json!({ "drystone": 1, "friction": 0.6, "friction_factor_on": on,
            "ground": [{ "id": "rock", "polygon": [[-1, -1], [5, -1], [5, 0], [-1, 0]] }],
            "joint_sets": [{ "id": "foot", "bodies": ["a", "rock"], "friction": 0.4 },
                { "id": "heads", "direction": "head", "friction": 0.1 }, { "id": "beds", "direction": "bed" }],
            "blocks": [{ "id": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "weight": 100 },
                { "id": "b", "polygon": [[2, 0], [4, 0], [4, 1], [2, 1]], "weight": 100 },
                { "id": "c", "polygon": [[1, 1], [3, 1], [3, 2], [1, 2]], "weight": 100 }],
            "loads": [{ "block": "c", "force": [30, 0], "at": [1, 1.2] }] })
    };
    let factor = |on: Value| {
        let found = frame(scene(&file(on)), &Options::default().margins(MarginKinds::ALL));
        let mut mu: Vec<f64> = found.contacts.iter().map(|contact| contact.interface.friction).collect();
        mu.sort_by(f64::total_cmp);
        assert_eq!(mu, [0.1, 0.4, 0.6, 0.6, 0.6]);
        found.margins.expect("asked").least(MarginKind::FrictionFactor)
    };
    // The upper block slides if the bed below it has a friction of 30 / 100.
    let beds = factor(json!(["beds"])).expect("a factor");
    assert!((beds - 0.5).abs() < 1e-6, "{beds}");
    // The head joint carries nothing that friction holds, so its friction may vanish.
    assert_eq!(factor(json!(["heads"])), Some(0.0));
    let mut program = Command::new(env!("CARGO_BIN_EXE_drystone"))
        .args(["check", "--margins", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program runs");
    program.stdin.take().expect("a pipe").write_all(file(json!(["beds"])).to_string().as_bytes()).expect("written");
    let words = String::from_utf8(program.wait_with_output().expect("it ends").stdout).expect("text");
    assert!(words.contains("stands with the friction of beds times at least 0.5"), "{words}");
    let beds = Analysis::with(scene(&file(json!(["beds"]))), &Options::default().margins(MarginKinds::ALL));
    let page = drystone::figure::draw(&beds, drystone::figure::Kind::Joints, &drystone::figure::Options::default());
    let svg = drystone::output::svg::write(&page);
    assert!(svg.contains("× the friction of beds") && !svg.contains("its friction"), "{svg}");
    for (key, value, code) in [
        ("friction_factor_on", json!(["arch"]), "arch"),
        ("joint_sets", json!([{ "id": "x", "bodies": ["a", "q"] }]), "q"),
    ] {
        let mut wrong = file(json!([]));
        wrong[key] = value;
        let problems = Scene::from_json(&wrong.to_string()).expect_err("an unknown name").to_string();
        assert!(problems.contains(&format!("`{code}`")), "{problems}");
    }
}
