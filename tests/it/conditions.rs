//! Answers of scenes with load cases or a vehicle hold in every condition: compared with analyses of each condition alone.

use drystone::analysis::{Condition, FrameAnalysis, Interval, MarginKind, MarginKinds, Options, Verdict};
use drystone::result::{Layout, Timing, to_json};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::random::Random;
use crate::structure::scene;

const WALL: &str = include_str!("../../assets/questions/retaining-wall.json");
const BRIDGE: &str = include_str!("../../assets/questions/bridge-vehicle.json");

fn asked() -> Options {
    Options::default().margins(true).placement(true).removable(true)
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
    for options in [Options::default(), Options::default().margins(true).margin_kinds(tilt), asked()] {
        let found = frame(scene(&file), &options);
        let cases = found.cases.as_ref().expect("cases");
        assert_eq!(cases.each[cases.governing].id, "earth and people");
        assert_eq!(found.margins.is_some(), options.margins);
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
    let bridge = json(BRIDGE);
    let position = &bridge["frames"][0]["vehicle"]["governing"];
    let bridge = own(bridge.clone());
    for kind in ["friction", "tilt", "horizontal_load"] {
        assert_eq!(&bridge["margins"][kind][0]["position"], position, "{kind}");
    }
    for kind in ["tilt", "horizontal_load", "kernel", "load_factor"] {
        assert_eq!(&bridge["margins"][kind][1]["position"], position, "{kind}");
    }
    assert_eq!(&bridge["placement"][0]["position"], position);
    // A beam of weight 6 from x = -1 to 2 on a floor from 0 to 1 falls under an axle at its left end.
    let falls = json!({ "drystone": 1, "ground": [{ "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]] }],
        "blocks": [{ "polygon": [[-1, 0], [2, 0], [2, 1], [-1, 1]], "weight": 6 }],
        "vehicle": { "axles": [{ "weight": 4 }] } });
    let falls = json(&falls.to_string());
    let governing = &falls["frames"][0]["governing_position"];
    assert_eq!(&own(falls.clone())["removable"][0]["position"], governing);
}

/// A ladder of 100 N on a floor with friction `mu`, whose upper corner touches a wall.
fn ladder(mu: f64, corners: impl Into<Value>) -> FrameAnalysis {
    let file = json!({ "drystone": 1, "friction": mu, "corner_contacts": corners.into(), "ground": [
            { "id": "floor", "polygon": [[-3, -1], [3.2, -1], [3.2, 0], [-3, 0]] },
            { "id": "wall", "polygon": [[2.2, 0], [3.2, 0], [3.2, 6], [2.2, 6]] }],
        "blocks": [{ "id": "ladder", "polygon": [[0, 0], [0.12, 0], [2.2, 4.5], [2.1, 4.55]], "weight": 100 }] });
    frame(scene(&file), &Options::default().margins(true))
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
fn margins_of_a_bridge_hold_with_its_vehicle_at_the_governing_position() {
    let file: Value = serde_json::from_str(BRIDGE).expect("JSON");
    let analysis = Analysis::with(scene(&file), &asked());
    let found = &analysis.frames[0];
    assert_eq!(found.verdict, Verdict::Stable);
    let line = found.vehicle.as_ref().expect("an influence line");
    let governing = line.governing.expect("a position");
    let mut loaded = file;
    let axles = &line.positions[governing].axles;
    loaded["loads"] = axles
        .iter()
        .map(|(axle, block, at)| {
            let weight = loaded["vehicle"]["axles"][*axle]["weight"].as_f64().expect("a weight");
            json!({ "block": analysis.scene.blocks()[block.0].id, "at": [at.x, at.y], "force": [0, -weight] })
        })
        .collect();
    loaded.as_object_mut().expect("an object").remove("vehicle");
    let there = frame(scene(&loaded), &asked());
    for kind in [MarginKind::Tilt, MarginKind::Kernel, MarginKind::LoadFactor] {
        let [whole, own] = [found, &there].map(|of| of.margins.as_ref().and_then(|of| of.most(kind)).expect("a limit"));
        assert!((whole - own).abs() <= 1e-5 * own, "{kind:?}: {whole} {own}");
    }
    assert!(found.notices.iter().any(|notice| notice.contains("not at the other")));
}

#[test]
fn the_headline_of_a_scene_with_movements_states_the_first_one() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/questions/spreading-arch.json"));
    let found =
        Analysis::with(Scene::from_json(&text.expect("there")).expect("sound"), &Options::default().margins(true));
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
