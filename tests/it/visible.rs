//! Loads, missing forces and limits are visible, and texts name only what a figure shows.

use drystone::Analysis;
use drystone::drawing::{Drawing, Group, Item, PagePoint, Path, Theme};
use drystone::figure::{self, Kind, Options};
use drystone::scene::{BlockId, Scene};

use crate::labels::{classes, texts};

/// Two blocks. On the centroid of the upper block act three loads and two opposite torques, and on the centroid of the
/// lower block acts a load with a torque, whose line of action therefore lies outside the block.
const ONE_SPOT: &str = r#"{ "drystone": 1, "density": 2000, "friction": 0.6,
    "ground": [{ "polygon": [[-2,-1],[5,-1],[5,0],[-2,0]] }],
    "blocks": [{ "id": "base", "polygon": [[0,0],[3,0],[3,1],[0,1]] },
               { "id": "top", "polygon": [[0.5,1],[2.5,1],[2.5,2],[0.5,2]] }],
    "loads": [{ "block": "top", "at": [1.5,1.5], "force": [4000, 0] },
              { "block": "top", "at": [1.5,1.5], "force": [0, -6000] },
              { "block": "top", "at": [1.5,1.5], "force": [-3000, -3000] },
              { "block": "top", "at": [1.5,1.5], "torque": 2500 },
              { "block": "top", "at": [1.5,1.5], "torque": -1500 },
              { "block": "base", "at": [1.5,0.5], "force": [2500, -2500], "torque": 3000 }] }"#;

fn analysed(text: &str) -> Analysis {
    let scene = Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"));
    Analysis::new(&scene)
}

/// Draws a figure in the look of the thesis.
fn drawn(text: &str, kind: Kind) -> Drawing {
    figure::draw(&analysed(text), kind, &Options::default().theme(Theme::thesis()))
}

fn words(drawing: &Drawing) -> String {
    let page = Group { items: drawing.items.clone(), ..Group::default() };
    let words: Vec<String> = texts(&page).into_iter().map(|t| t.words).collect();
    words.join(" ")
}

fn paths(group: &Group) -> Vec<&Path> {
    let paths = group.items.iter().filter_map(|item| match item {
        Item::Path(path) => Some(path),
        _ => None,
    });
    paths.collect()
}

fn points(path: &Path) -> Vec<PagePoint> {
    path.outline.points().collect()
}

/// The smallest distance between points of two paths, pixels.
fn distance(a: &Path, b: &Path) -> f64 {
    let others = points(b);
    let far = |p: PagePoint, q: &PagePoint| libm::hypot(p.x - q.x, p.y - q.y);
    let nearest = |p: PagePoint| others.iter().map(|q| far(p, q)).fold(f64::INFINITY, f64::min);
    points(a).into_iter().map(nearest).fold(f64::INFINITY, f64::min)
}

#[test]
fn loads_lie_above_the_circle_of_the_weight() {
    for kind in [Kind::Forces, Kind::Build, Kind::Flow] {
        let drawing = drawn(ONE_SPOT, kind);
        let picture = classes(&drawing.items, &["picture"])[0];
        let place =
            |class| picture.items.iter().position(|item| matches!(item, Item::Group(layer) if layer.class == class));
        assert!(place("forces") < place("loads"), "{kind:?}");
        let loads = classes(&drawing.items, &["load"]);
        let count = loads.iter().filter(|load| load.title.starts_with("Load")).count();
        assert_eq!(count, 4, "{kind:?}");
    }
}

#[test]
fn opposite_torques_at_one_point_have_separate_arcs() {
    for kind in [Kind::Flow, Kind::Thrust, Kind::Mechanism, Kind::Forces] {
        let drawing = drawn(ONE_SPOT, kind);
        let torques = classes(&drawing.items, &["torque", "load"]);
        let torques = torques.iter().filter(|mark| mark.title.starts_with("Torque"));
        let arcs: Vec<&Path> = torques.map(|g| paths(g)[0]).collect();
        assert_eq!(arcs.len(), 3, "{kind:?}");
        for (i, a) in arcs.iter().enumerate() {
            for b in &arcs[..i] {
                assert!(distance(a, b) > 2.5, "{kind:?}: {}", distance(a, b));
            }
        }
    }
}

#[test]
fn a_line_of_thrust_does_not_enter_the_ground() {
    let drawing = drawn(ONE_SPOT, Kind::Thrust);
    let ground = classes(&drawing.items, &["earth"]);
    let top = paths(ground[0]).into_iter().flat_map(points);
    let top = top.map(|p| p.y).fold(f64::INFINITY, f64::min);
    let parts = classes(&drawing.items, &["thrust", "schematic"]);
    assert!(parts.len() >= 3);
    for part in parts {
        let low = paths(part).into_iter().flat_map(points).map(|p| p.y);
        let low = low.fold(f64::NEG_INFINITY, f64::max);
        assert!(low <= top + 0.1, "{}: {low} below {top}", part.title);
    }
}

#[test]
fn the_key_of_a_line_of_thrust_names_only_lines_that_are_drawn() {
    let lintel = include_str!("../scenes/lintel.json");
    for text in [ONE_SPOT, lintel] {
        let drawing = drawn(text, Kind::Thrust);
        let has = |class: &str| !classes(&drawing.items, &[class]).is_empty();
        let words = words(&drawing);
        assert_eq!(words.contains("line of thrust"), has("thrust"), "{words}");
        assert_eq!(words.contains("schematic"), has("schematic"), "{words}");
        assert!(words.contains("at this width"), "{words}");
    }
}

#[test]
fn small_and_missing_forces_of_a_free_body_are_visible() {
    // Three quarters of the block overhang, so the ground would have to pull. The load is a thousandth of the weight.
    let falls = r#"{ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": [[0,-1],[9,-1],[9,0],[0,0]] }],
        "blocks": [{ "id": "a", "polygon": [[-3,0],[1,0],[1,2],[-3,2]], "weight": 6 }],
        "loads": [{ "block": "a", "force": [0.006, 0], "at": [-3, 1] }] }"#;
    let analysis = analysed(falls);
    let drawing = crate::pictures::free_body(&analysis, 0, BlockId(0), &Options::default());
    let drawing = drawing.expect("block a is placed");
    let forces = classes(&drawing.items, &["force"]);
    let length = |group: &Group| {
        // An arrow has seven corners; the fourth is its tip, and the first and the last are its tail.
        let corners = points(paths(group)[0]);
        let tail = PagePoint::new(0.5 * (corners[0].x + corners[6].x), 0.5 * (corners[0].y + corners[6].y));
        libm::hypot(corners[3].x - tail.x, corners[3].y - tail.y)
    };
    let load = forces.iter().find(|g| g.title.starts_with("Load"));
    assert!(length(load.expect("the load is drawn")) >= 13.9);
    let missing = forces.iter().rposition(|g| g.title.starts_with("Missing"));
    let missing = missing.expect("a missing force is drawn");
    assert!(length(forces[missing]) >= 19.9);
    let above = &forces[missing + 1..];
    let above: Vec<&str> = above.iter().map(|g| g.title.as_str()).collect();
    assert!(above.is_empty(), "{above:?}");
    let words = words(&drawing);
    assert!(words.contains("are drawn larger") && !words.contains("not drawn"), "{words}");
}

#[test]
fn a_small_missing_force_is_less_visible_than_a_large_one() {
    // Two blocks of 600 N and 1 N. Three quarters of each overhang, so the ground would have to pull at both.
    let falls = r#"{ "drystone": 1, "friction": 0.5,
        "ground": [{ "polygon": [[0,-1],[9,-1],[9,0],[0,0]] }],
        "blocks": [{ "id": "a", "polygon": [[-3,0],[1,0],[1,2],[-3,2]], "weight": 600 },
                   { "id": "b", "polygon": [[8,0],[12,0],[12,2],[8,2]], "weight": 1 }] }"#;
    let drawing = drawn(falls, Kind::Flow);
    let strands = classes(&drawing.items, &["strand"]);
    let missing = strands.iter().filter(|s| s.title.contains("missing"));
    let blocks: Vec<&str> = missing.map(|s| &s.title[..10]).collect();
    assert!(!blocks.is_empty() && blocks.iter().all(|b| *b == "In block a"), "{blocks:?}");
    let failures = classes(&drawing.items, &["failures"]);
    let arrows = classes(&failures[0].items, &["missing"]);
    let length = |block: &str| {
        let own = arrows.iter().find(|a| a.title.contains(&format!("between {block}")));
        let corners = points(paths(own.expect("an arrow"))[0]);
        let ys = corners.iter().map(|p| p.y);
        ys.clone().fold(f64::NEG_INFINITY, f64::max) - ys.fold(f64::INFINITY, f64::min)
    };
    let (large, small) = (length("a"), length("b"));
    assert!(small > 0.3 * large && small < 0.5 * large, "{small} {large}");
    let words = words(&drawing);
    assert!(words.contains("600 N") && words.contains("1 N"), "{words}");
}

#[test]
fn a_robot_at_its_limit_has_the_mark_of_a_limit() {
    let held = |limit: f64| {
        format!(
            r#"{{ "drystone": 1,
            "blocks": [{{ "id": "a", "polygon": [[0,0],[2,0],[2,2],[0,2]], "weight": 6 }}],
            "robots": [{{ "id": "r", "holds": "a", "limits": {{ "force": {limit}, "torque": 1 }} }}] }}"#
        )
    };
    for kind in [Kind::Forces, Kind::Flow] {
        let marks = |text: &str| {
            let drawing = drawn(text, kind);
            let limits = classes(&drawing.items, &["limit"]);
            let titles: Vec<String> = limits.iter().map(|g| g.title.clone()).collect();
            (titles, words(&drawing).contains("robot at its limit"))
        };
        let at_limit = (vec!["Robot r is at its limit".to_owned()], true);
        assert_eq!(marks(&held(6.0)), at_limit, "{kind:?}");
        assert_eq!(marks(&held(12.0)), (Vec::new(), false), "{kind:?}");
    }
}

#[test]
fn used_friction_is_stated_for_the_forces_shown() {
    // The friction that holds the block is exactly the available friction.
    let full = r#"{ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": [[0,-1],[9,-1],[9,0],[0,0]] }],
        "blocks": [{ "id": "a", "polygon": [[1,0],[5,0],[5,2],[1,2]], "weight": 6 }],
        "loads": [{ "block": "a", "force": [3, 0], "at": [1, 0.2] }] }"#;
    let words = words(&drawn(full, Kind::Joints));
    assert!(words.contains("all of it") && words.contains("100\u{a0}%"), "{words}");
}

#[test]
fn the_key_of_colours_is_true_if_colours_repeat() {
    let blocks: Vec<String> = (0..8)
        .map(|y| {
            let up = y + 1;
            format!(r#"{{ "polygon": [[0,{y}],[2,{y}],[2,{up}],[0,{up}]], "weight": 6 }}"#)
        })
        .collect();
    let tower = format!(
        r#"{{ "drystone": 1, "ground": [{{ "polygon": [[-1,-1],[3,-1],[3,0],[-1,0]] }}], "blocks": [{}] }}"#,
        blocks.join(",")
    );
    for width in [300.0, 700.0] {
        let options = Options::default().theme(Theme::thesis()).width(width);
        let words = words(&figure::draw(&analysed(&tower), Kind::Forces, &options));
        assert!(words.contains("one colour per block"), "{words}");
    }
}
