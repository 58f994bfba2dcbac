//! Figures: arrows and fills are compared with the numbers of the thesis, and every figure must obey general rules.

use drystone::drawing::{Colour, Drawing, Group, Item, Outline, Theme};
use drystone::figure::{self, ArrowKind, Fill, ForceStyle, Normalisation, Options};
use drystone::internals::geometry::{Point, Vector};
use drystone::output::{png, svg};
use drystone::scene::BlockId;
use drystone::{Analysis, Scene};
use serde_json::Value;

pub(crate) fn scene(path: &str) -> Scene {
    let full = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&full).expect("the scene is there");
    Scene::from_json(&text).unwrap_or_else(|problems| panic!("{path}:\n{problems}"))
}

/// The figure of a block as a free body, in a frame; `None` if the frame does not place the block.
pub(crate) fn free_body(analysis: &Analysis, frame: usize, block: BlockId, options: &Options) -> Option<Drawing> {
    let options = options.clone().block(block);
    figure::panels_of(analysis, figure::Kind::Freebody, &options, &[frame]).pop()
}

pub(crate) fn gallery() -> Vec<(String, Scene)> {
    let folder = format!("{}/assets/thesis", env!("CARGO_MANIFEST_DIR"));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("the gallery")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name"))
        .filter(|name| name.ends_with(".json"))
        .collect();
    names.sort();
    names.into_iter().map(|name| (name.clone(), scene(&format!("assets/thesis/{name}")))).collect()
}

fn source() -> Options {
    Options::default().style(ForceStyle::Components).normalisation(Normalisation::Source)
}

fn pair(value: &Value) -> (f64, f64) {
    (value[0].as_f64().expect("x"), value[1].as_f64().expect("y"))
}

#[test]
fn arrows_are_those_of_the_thesis() {
    let panels: Value = serde_json::from_str(include_str!("../reference/panels.json")).expect("JSON");
    let mut compared = 0;
    for (name, panel) in panels.as_object().expect("panels") {
        let scene = scene(panel["scene"].as_str().expect("a scene"));
        let analysis = Analysis::new(&scene);
        let frame = panel["frame"].as_u64().expect("a frame") as usize;
        let mut ours = figure::arrows(&analysis, frame, &source());
        let expected = panel["expected"]["arrows"].as_array().expect("arrows");
        // The thesis draws the red friction arrow of an interface at an arbitrary corner, drystone in the middle.
        let anywhere = |a: &figure::ForceArrow| matches!(a.kind, ArrowKind::MissingFriction(_));
        for arrow in expected {
            let (at, vector) = (pair(&arrow["at"]), pair(&arrow["vector"]));
            let colour = arrow["color"].as_str().expect("a colour");
            let width = arrow["width"].as_f64().expect("a width");
            let found = ours.iter().position(|a| {
                let place = (a.at - Point::new(at.0, at.1)).norm();
                (place < 1e-3 || anywhere(a) && place < 0.5)
                    && (a.vector - Vector::new(vector.0, vector.1)).norm() < 1e-3
                    && a.colour.css() == colour
                    && (a.width - width).abs() < 1e-3
            });
            let Some(found) = found else { panic!("{name} has no arrow {arrow}; the remaining arrows are {ours:#?}") };
            ours.remove(found);
            compared += 1;
        }
        assert!(ours.is_empty(), "{name} has additional arrows: {ours:#?}");
    }
    assert!(compared > 250, "{compared}");
}

/// The title and the fill of every block of a frame.
fn fills(drawing: &Drawing, frame: usize) -> Vec<(String, Colour)> {
    let mut found = Vec::new();
    groups(&drawing.items, &mut |group| {
        if group.id.as_deref() == Some(&format!("frame-{}", frame + 1)) {
            groups(&group.items, &mut |block| {
                let fill = block.items.iter().find_map(|item| match item {
                    Item::Path(path) => path.fill,
                    _ => None,
                });
                if let ("block", Some(fill)) = (block.class.as_str(), fill) {
                    found.push((block.title.clone(), fill));
                }
            });
        }
    });
    found
}

fn groups(items: &[Item], visit: &mut dyn FnMut(&Group)) {
    for item in items {
        if let Item::Group(group) = item {
            visit(group);
            groups(&group.items, visit);
        }
    }
}

#[test]
fn fills_are_those_of_the_thesis() {
    let panels: Value = serde_json::from_str(include_str!("../reference/panels.json")).expect("JSON");
    for (name, panel) in panels.as_object().expect("panels") {
        let scene = scene(panel["scene"].as_str().expect("a scene"));
        let options = Options::default().fill(Fill::Source);
        let drawing = figure::forces(&Analysis::new(&scene), &options);
        let fills = fills(&drawing, panel["frame"].as_u64().expect("a frame") as usize);
        let blocks = panel["blocks"].as_array().expect("blocks");
        assert_eq!(fills.len(), blocks.len(), "{name}");
        for ((title, fill), block) in fills.iter().zip(blocks) {
            assert_eq!(fill.css(), block["fill"].as_str().expect("a fill"), "{name}, {title}");
        }
    }
}

/// Visits the outline of every path of a drawing, except in clipped groups.
fn points(items: &[Item], visit: &mut dyn FnMut(&Outline)) {
    for item in items {
        match item {
            Item::Path(path) => visit(&path.outline),
            Item::Text(_) => {}
            // Clipped outlines may extend beyond the page.
            Item::Group(group) if group.clip.is_some() => {}
            Item::Group(group) => points(&group.items, visit),
        }
    }
}

#[test]
fn nothing_lies_beyond_the_page_and_words_fit() {
    for style in [Options::default(), source()] {
        for (name, scene) in gallery() {
            let drawing = figure::forces(&Analysis::new(&scene), &style);
            let inside = |x: f64, y: f64| (0.0..=drawing.width).contains(&x) && (0.0..=drawing.height).contains(&y);
            points(&drawing.items, &mut |outline| {
                for p in outline.points() {
                    assert!(inside(p.x, p.y), "{name}: {p:?} of {} × {}", drawing.width, drawing.height);
                }
            });
            fn words(items: &[Item], visit: &mut dyn FnMut(&drystone::drawing::Text)) {
                for item in items {
                    match item {
                        Item::Text(text) => visit(text),
                        Item::Group(group) => words(&group.items, visit),
                        Item::Path(_) => {}
                    }
                }
            }
            words(&drawing.items, &mut |text| {
                let wide = drystone::drawing::text::width(&text.words, text.face, text.size);
                let left = match text.anchor {
                    drystone::drawing::Anchor::Start => text.at.x,
                    drystone::drawing::Anchor::Middle => text.at.x - wide / 2.0,
                    drystone::drawing::Anchor::End => text.at.x - wide,
                };
                assert!(inside(left, text.at.y) && inside(left + wide, text.at.y), "{name}: {}", text.words);
            });
        }
    }
}

#[test]
fn a_figure_has_its_verdicts_and_numbers_as_text_for_screen_readers() {
    let scene = scene("assets/thesis/figure-4.json");
    let svg = svg::write(&figure::forces(&Analysis::new(&scene), &Options::default()));
    for part in [
        "<title>(a) Initial situation: stands</title>",
        "<title>Force on block 3 from block 2: 6.91 N at 65°</title>",
        "<title>Robot r1 holds block 4</title>",
        "<title>Block 5, planned by robot r0</title>",
        "<title>Missing torque on block 3 from robot r0: 5.74 N·m anticlockwise</title>",
        "<title>(e) Robot 1 wants to place a new block: falls</title>",
        "missing: a torque of 5.74 N·m from robot r0",
    ] {
        assert!(svg.contains(part), "the figure does not contain {part}");
    }
}

#[test]
fn the_largest_arrow_is_one_edge_long_in_each_panel() {
    let scene = scene("assets/thesis/figure-4.json");
    let analysis = Analysis::new(&scene);
    for frame in 0..scene.frames().len() {
        let arrows = figure::arrows(&analysis, frame, &Options::default());
        let longest = arrows.iter().map(|a| a.vector.norm()).fold(0.0, f64::max);
        assert!((longest - 1.0).abs() < 1e-9, "frame {frame}: {longest}");
        assert!(arrows.iter().any(|a| a.kind == ArrowKind::Weight));
    }
}

#[test]
fn arrows_between_two_blocks_are_opposite_and_the_ground_has_none() {
    let scene = scene("assets/thesis/figure-8-left.json");
    let arrows = figure::arrows(&Analysis::new(&scene), 0, &Options::default());
    let mut pairs = 0;
    for arrow in &arrows {
        assert!(matches!(arrow.on, drystone::scene::BodyId::Block(_)));
        if let ArrowKind::Contact(from @ drystone::scene::BodyId::Block(_)) = arrow.kind {
            let partner =
                arrows.iter().find(|a| a.on == from && a.kind == ArrowKind::Contact(arrow.on) && a.at == arrow.at);
            let partner = partner.expect("the other block has its own arrow");
            assert_eq!(partner.force, -arrow.force);
            assert_ne!(partner.colour, arrow.colour);
            pairs += 1;
        }
    }
    assert!(pairs >= 6, "{pairs}");
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let text = |_: usize| {
        let scene = scene("assets/thesis/figure-5.json");
        svg::write(&figure::forces(&Analysis::new(&scene), &Options::default()))
    };
    assert_eq!(text(0), text(1));
    let picture = |svg: &str| png::render(svg, png::Size::Width(700)).expect("a picture");
    assert_eq!(picture(&text(0)), picture(&text(1)));
}

#[test]
fn shapes_are_drawn_with_their_names() {
    let drawing = figure::shapes(&Theme::thesis());
    let svg = svg::write(&drawing);
    for name in drystone::scene::shape::BUILT_IN {
        assert!(svg.contains(&format!(">{name}</text>")), "{name}");
    }
    assert!(png::render(&svg, png::Size::Natural).is_ok());
}

fn from_json(text: &str) -> Scene {
    Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"))
}

fn drawn(scene: &Scene) -> String {
    svg::write(&figure::forces(&Analysis::new(scene), &Options::default()))
}

/// A block of 4 m × 2 m and 8 N on wide ground, with more text inserted into the scene.
fn slab(more: &str, block: &str) -> Scene {
    from_json(&format!(
        r#"{{ "drystone": 1, "title": "Slab", {more}
             "ground": [ {{ "polygon": [[-90,-9],[90,-9],[90,0],[-90,0]] }} ],
             "blocks": [ {{ "id": "s", "polygon": [[0,0],[4,0],[4,2],[0,2]], "weight": 8 {block} }} ] }}"#
    ))
}

#[test]
fn loads_and_robots_torques_have_their_arrows() {
    let scene = slab(r#""loads": [ { "block": "s", "force": [1, -2], "at": [3, 2], "torque": -1.5 } ],"#, "");
    let analysis = Analysis::new(&scene);
    let marks = figure::marks(&analysis, 0, &Options::default(), 10.0);
    let load = marks.arrows.iter().find(|a| a.kind == ArrowKind::Load).expect("a load's arrow");
    assert_eq!((load.at, load.force), (Point::new(3.0, 2.0), Vector::new(1.0, -2.0)));
    // The unit length is 0.6·√8 m here and stands for 10 N.
    assert!((load.vector - Vector::new(1.0, -2.0) * (0.06 * 8f64.sqrt())).norm() < 1e-12);
    assert_eq!(marks.turns.len(), 1);
    assert_eq!((marks.turns[0].kind, marks.turns[0].torque), (figure::TurnKind::Load, -1.5));
    assert!(marks.turns[0].torque < 0.0);
    assert!(drawn(&scene).contains("Torque of a load on block s: 1.5 N·m clockwise"));
}

/// The height of the arrow with this title, in each frame that has it.
fn heights(drawing: &Drawing, title: &str) -> Vec<f64> {
    let mut found = Vec::new();
    groups(&drawing.items, &mut |group| {
        if let (true, Some(Item::Path(path))) = (group.title.starts_with(title), group.items.first()) {
            let ys: Vec<f64> = path.outline.points().map(|p| p.y).collect();
            found.push(ys.iter().copied().fold(f64::MIN, f64::max) - ys.iter().copied().fold(f64::MAX, f64::min));
        }
    });
    found
}

#[test]
fn with_one_scale_for_a_strip_equal_weights_have_equal_arrows() {
    let scene = scene("assets/thesis/figure-5.json");
    let analysis = Analysis::new(&scene);
    let weights = |scale| {
        let options = Options::default().scale(scale);
        heights(&figure::forces(&analysis, &options), "Weight of block 1")
    };
    let own = weights(figure::ArrowScale::Panel);
    let shared = weights(figure::ArrowScale::Strip);
    assert!(own.len() == 2 && own[0] > 1.5 * own[1], "{own:?}");
    assert!(shared.len() == 2 && (shared[0] - shared[1]).abs() < 1e-9, "{shared:?}");
}

#[test]
fn without_a_limit_the_key_states_what_the_colours_mean() {
    let look =
        |scene: &Scene| svg::write(&figure::forces(&Analysis::new(scene), &Options::default().theme(Theme::thesis())));
    let two = r#"{ "drystone": 1, "ground": [ { "polygon": [[-1,-1],[9,-1],[9,0],[-1,0]] } ], "blocks": [
        { "id": "low", "polygon": [[0,0],[2,0],[2,1],[0,1]], "weight": 6 },
        { "id": "high", "polygon": [[0,1],[2,1],[2,2],[0,2]], "weight": 2 } ] }"#;
    let text = look(&from_json(two));
    assert!(text.contains(">8 N</text>") && text.contains("weight or largest normal force"));
    let full = Theme::thesis().amplitude(1.0).css();
    assert!(text.contains(&format!("fill=\"{full}\"")), "the most loaded block is at the end of the scale");
    assert!(!text.contains("limit of"));
    let limited = two.replace("\"ground\"", r#""robots": [ { "id": "r", "limits": { "force": 20 } } ], "ground""#);
    // A robot that holds nothing changes no colour, except with the fills of the thesis, which have a different key.
    let of_blocks = |text: &str, fill: &str| text.matches(&format!("fill=\"{fill}\"")).count();
    let with_robot = look(&from_json(&limited));
    assert!(!with_robot.contains("limit of"));
    assert_eq!(of_blocks(&with_robot, &full), of_blocks(&text, &full));
    let options = Options::default().fill(Fill::Source);
    let scene = from_json(&limited);
    let source = svg::write(&figure::forces(&Analysis::new(&scene), &options));
    assert!(source.contains("of the robots&#39; limit of 20 N"));
}

#[test]
fn a_fill_given_in_the_scene_has_precedence() {
    let scene = slab("", r##", "fill": "#8b6b3d""##);
    let fill = fills(&figure::forces(&Analysis::new(&scene), &Options::default()), 0);
    assert_eq!(fill, [("Block s".to_owned(), Colour::hex(0x8b6b3d))]);
}

#[test]
fn wide_ground_is_cut_and_the_structure_stays_large() {
    let drawing = figure::forces(&Analysis::new(slab("", "")), &Options::default());
    let mut block = None;
    groups(&drawing.items, &mut |group| {
        if let ("block", Some(Item::Path(path))) = (group.class.as_str(), group.items.first()) {
            let xs: Vec<f64> = path.outline.points().map(|p| p.x).collect();
            block = Some(xs.iter().copied().fold(0.0, f64::max) - xs.iter().copied().fold(f64::MAX, f64::min));
        }
    });
    assert!(block.expect("a block") > 0.3 * drawing.width);
}

#[test]
fn unusual_scenes_are_drawn() {
    let nothing = from_json(r#"{ "drystone": 1, "blocks": [] }"#);
    let weightless = slab(r#""gravity": [0, 0],"#, "");
    let falling = from_json(
        r#"{ "drystone": 1, "title": "A <b> & \"c\" 石", "blocks": [ { "id": "<&\"'>", "polygon": [[0,0],[1,0],[0,1]] } ] }"#,
    );
    let far = from_json(
        r#"{ "drystone": 1, "blocks": [ { "id": "a", "polygon": [[1e9,1e9],[1000000001,1e9],[1e9,1000000001]] },
             { "id": "b", "polygon": [[-1e9,0],[-999999999,0],[-1e9,1]] } ] }"#,
    );
    let tiny = from_json(r#"{ "drystone": 1, "blocks": [ { "id": "a", "polygon": [[0,0],[1e-6,0],[0,1e-6]] } ] }"#);
    for scene in [nothing, weightless, falling, far, tiny] {
        let svg = drawn(&scene);
        let picture = png::render(&svg, png::Size::Natural).expect("a picture");
        assert!(picture.len() > 500 && picture.len() < 1_000_000, "{}", scene.title());
    }
}

#[test]
fn very_many_blocks_are_drawn_together() {
    let block =
        |i: usize| format!(r#"{{ "id": "b{i}", "cells": [[{}, {}]], "weight": {} }}"#, 2 * (i % 50), 0, 1 + i % 7);
    // Blocks side by side, each on a separate part of the ground.
    let (mut blocks, mut ground) = (Vec::new(), Vec::new());
    for i in 0..1100 {
        let (column, row) = (2 * (i % 50), 3 * (i / 50));
        blocks.push(block(i).replace(&format!("{column}, 0"), &format!("{column}, {}", row + 1)));
        ground.push(format!(r#"{{ "cells": [[{column}, {row}]] }}"#));
    }
    let scene = from_json(&format!(
        r#"{{ "drystone": 1, "grid": {{ "kind": "square", "side": 1 }}, "ground": [{}], "blocks": [{}] }}"#,
        ground.join(","),
        blocks.join(",")
    ));
    let svg = drawn(&scene);
    assert!(svg.contains("<title>1100 blocks</title>"));
    let paths = svg.matches("<path").count();
    assert!(paths < 120, "{paths}");
    assert!(png::render(&svg, png::Size::Natural).is_ok());
}
