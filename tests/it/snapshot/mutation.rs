//! The table of mutations: the layers that can see a mutation report it with a specific message. Small random changes
//! of forces and pixels are not reported.

use std::sync::Arc;

use drystone::analysis::{Analysis, Verdict};
use drystone::drawing::{Colour, Drawing, Group, Item, Outline, PagePoint, Segment, Theme};
use drystone::figure::{self, Options};
use drystone::output::{png, svg};
use drystone::snapshot::fact::{DIGITS, Facts};
use drystone::snapshot::picture::{Difference, Picture};
use drystone::snapshot::svg as svg_text;
use drystone::{Scene, output};

use super::lintel;
use crate::random::Random;

/// The facts, the drawing and the picture of one scene.
struct Sample {
    facts: Facts,
    svg: String,
    picture: Picture,
}

impl Sample {
    fn of(analysis: &Analysis, drawing: &Drawing) -> Sample {
        let svg = svg::write(drawing);
        let raster = png::rgba(&svg, png::Size::Natural).expect("a picture");
        Sample {
            facts: Facts::new(analysis, DIGITS),
            picture: Picture::new(raster.width, raster.height, raster.rgba),
            svg,
        }
    }

    fn drawn(text: &str, change: impl FnOnce(&mut Drawing)) -> Sample {
        let scene = Scene::from_json(text).expect("sound");
        let analysis = Analysis::new(&scene);
        let options = Options::default().theme(Theme::thesis());
        let mut drawing = figure::forces(&analysis, &options);
        change(&mut drawing);
        Sample::of(&analysis, &drawing)
    }

    fn scene(text: &str) -> Sample {
        Sample::drawn(text, |_| {})
    }
}

/// The messages of each layer if `found` is compared with the references of `expected`. The references are packed and
/// read back first, as if from a file.
fn messages(expected: &Sample, found: &Sample) -> [Vec<String>; 3] {
    let kept = Facts::read(&expected.facts.text()).expect("what was written is read");
    let facts = kept.changes(&found.facts);
    let packed = expected.picture.encode().expect("packed");
    let packed = Picture::decode(&packed).expect("what was packed is read");
    let difference = Difference::new(&packed, &found.picture, 1);
    let pixels = if difference.is_none() { vec![] } else { vec![difference.words()] };
    let elements = svg_text::changes(&expected.svg, &found.svg).expect("both are SVG");
    [facts, elements, pixels]
}

fn groups(items: &mut [Item], visit: &mut dyn FnMut(&mut Group)) {
    for item in items {
        if let Item::Group(group) = item {
            visit(group);
            groups(&mut group.items, visit);
        }
    }
}

fn points(outline: &mut Outline, change: &dyn Fn(PagePoint) -> PagePoint) {
    for segment in &mut outline.segments {
        match segment {
            Segment::Move(p) | Segment::Line(p) => *p = change(*p),
            Segment::Curve(a, b, c) => [*a, *b, *c] = [*a, *b, *c].map(change),
            Segment::Close => {}
        }
    }
}

/// Rotates the arrow with a title about its tail, anticlockwise on the page.
fn rotate(drawing: &mut Drawing, title: &str, degrees: f64) {
    let mut rotated = 0;
    groups(&mut drawing.items, &mut |group| {
        if !group.title.starts_with(title) {
            return;
        }
        for item in &mut group.items {
            if let Item::Path(path) = item {
                let Some(Segment::Move(tail)) = path.outline.segments.first().cloned() else {
                    continue;
                };
                let (sin, cos) = libm::sincos(-degrees.to_radians());
                points(&mut path.outline, &|p| {
                    let (x, y) = (p.x - tail.x, p.y - tail.y);
                    tail.moved(cos * x - sin * y, sin * x + cos * y)
                });
                rotated += 1;
            }
        }
    });
    assert!(rotated > 0, "there is no arrow {title:?}");
}

/// Calls `change` with the items of the drawing and with those of each group.
fn each_list(drawing: &mut Drawing, change: &mut dyn FnMut(&mut Vec<Item>)) {
    change(&mut drawing.items);
    groups(&mut drawing.items, &mut |group| change(&mut group.items));
}

/// Removes the label of a block.
fn remove_label(drawing: &mut Drawing, label: &str) {
    let mut removed = 0;
    groups(&mut drawing.items, &mut |group| {
        if group.class != "name" {
            return;
        }
        group.items.retain(|item| {
            let is = matches!(item, Item::Text(text) if text.words == label);
            removed += usize::from(is);
            !is
        });
    });
    assert_eq!(removed, 1, "{label}");
}

/// Moves the label with this text by some pixels.
fn shift(drawing: &mut Drawing, label: &str, x: f64, y: f64) {
    each_list(drawing, &mut |items| {
        for item in items {
            if let Item::Text(text) = item
                && text.words == label
            {
                text.at = text.at.moved(x, y);
            }
        }
    });
}

/// Changes the red component of the fill of a block.
fn recolour(drawing: &mut Drawing, title: &str, by: u8) {
    groups(&mut drawing.items, &mut |group| {
        if group.title != title {
            return;
        }
        for item in &mut group.items {
            if let Item::Path(path) = item
                && let Some(Colour([r, g, b])) = path.fill
            {
                path.fill = Some(Colour([r.wrapping_add(by), g, b]));
            }
        }
    });
}

/// A row of the table: the mutation, and a part of the expected message of each layer. An empty string means that the
/// layer reports nothing.
struct Row {
    what: &'static str,
    found: Sample,
    facts: &'static str,
    svg: &'static str,
    pixels: &'static str,
}

#[test]
fn every_mutation_is_reported_by_the_expected_layers() {
    let text = lintel("A lintel", 1.0);
    let expected = Sample::scene(&text);
    let arrow = "Force on block lintel from block left";
    let without_a_post = {
        let mut file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        file["blocks"].as_array_mut().expect("blocks").remove(1);
        file.to_string()
    };
    let mut one_pixel_right = Sample::scene(&text);
    one_pixel_right.picture = shifted(&expected.picture);
    let rows = [
        Row {
            what: "the picture shifted by a pixel",
            found: one_pixel_right,
            facts: "",
            svg: "",
            pixels: "pixels differ, by up to",
        },
        Row {
            what: "a label moved by a pixel",
            found: Sample::drawn(&text, |d| shift(d, "lintel", 1.0, 0.0)),
            facts: "",
            svg: "text \"lintel\" in ",
            pixels: "pixels differ, by up to",
        },
        Row {
            what: "an arrow rotated by three degrees",
            found: Sample::drawn(&text, |d| rotate(d, arrow, 3.0)),
            facts: "",
            svg: "path in Force on block lintel from block left: ",
            pixels: "pixels differ, by up to",
        },
        Row {
            what: "a missing label",
            found: Sample::drawn(&text, |d| remove_label(d, "lintel")),
            facts: "",
            svg: "− <text ",
            pixels: "pixels differ, by up to",
        },
        Row {
            what: "a block in another colour",
            found: Sample::drawn(&text, |d| recolour(d, "Block left", 90)),
            facts: "",
            svg: "path in Block left: fill #",
            pixels: "pixels differ, by up to 90 of 255",
        },
        Row {
            what: "a block in nearly the same colour",
            found: Sample::drawn(&text, |d| recolour(d, "Block left", 2)),
            facts: "",
            svg: "path in Block left: fill #",
            pixels: "pixels differ, by up to 2 of 255",
        },
        Row {
            what: "a load larger by 1 %",
            found: Sample::scene(&lintel("A lintel", 1.01)),
            facts: "interface left–lintel: N ",
            svg: "in Load on block lintel",
            pixels: "pixels differ, by up to",
        },
        Row {
            what: "a missing block",
            found: Sample::scene(&without_a_post),
            facts: "frame 1: stands → falls",
            svg: "<title>Block right</title>",
            pixels: "found",
        },
    ];
    for row in rows {
        let messages = messages(&expected, &row.found);
        for ((layer, words), part) in
            ["facts", "svg", "pixels"].iter().zip(&messages).zip([row.facts, row.svg, row.pixels])
        {
            if part.is_empty() {
                assert!(words.is_empty(), "{}, {layer}: {words:#?}", row.what);
            } else {
                let found = words.iter().any(|w| w.contains(part));
                assert!(found, "{}, {layer}: {part:?} expected in {words:#?}", row.what);
            }
        }
    }
}

#[test]
fn a_missing_block_is_reported_before_the_blocks_that_fall_without_it() {
    let text = lintel("A lintel", 1.0);
    let mut file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    file["blocks"].as_array_mut().expect("blocks").remove(1);
    let [facts, ..] = messages(&Sample::scene(&text), &Sample::scene(&file.to_string()));
    assert_eq!(facts[0], "block right is gone: weight 60 N", "the cause");
    assert_eq!(facts[1], "frame 1: stands → falls", "its effect");
    assert!(facts.contains(&"block lintel no longer stands".into()), "{facts:#?}");
    for gone in ["block right is gone: weight 60 N", "interface right–ground is gone"] {
        assert!(facts.iter().any(|w| w.starts_with(gone)), "{facts:#?}");
    }
    let [back, ..] = messages(&Sample::scene(&file.to_string()), &Sample::scene(&text));
    assert!(back.contains(&"block lintel no longer falls".into()), "{back:#?}");
    assert!(back.iter().any(|w| w.starts_with("block right is new: weight 60 N")), "{back:#?}");
}

/// A block with a load and a robot, for tests of causes. `kernel` is its safety kernel.
fn held(edit: &dyn Fn(&mut serde_json::Value)) -> Facts {
    let mut file = serde_json::json!({ "drystone": 1, "friction": 0.7, "kernel": 0.1,
        "ground": [{ "polygon": [[-9, -1], [9, -1], [9, 0], [-9, 0]] }],
        "blocks": [{ "id": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "weight": 10 }],
        "loads": [{ "block": "a", "force": [1, -2], "at": [1, 1] }],
        "robots": [{ "id": "arm", "limits": { "fx": 5, "fy": 6, "torque": 1 }, "holds": "a", "at": [1, 0.5] }] });
    edit(&mut file);
    let scene = Scene::from_json(&file.to_string()).unwrap_or_else(|problems| panic!("{problems}"));
    Facts::new(&Analysis::new(&scene), DIGITS)
}

/// Changed loads, friction coefficients, robot limits and kernels are reported before the results that follow from them.
#[test]
fn an_edited_input_is_the_first_change_that_is_reported() {
    let before = held(&|_| {});
    let first = |edit: &dyn Fn(&mut serde_json::Value)| -> Vec<String> { before.changes(&held(edit)) };
    let load = first(&|file| file["loads"][0]["force"] = serde_json::json!([1, -4]));
    assert_eq!(load[0], "load on a: force 1, −2 → 1, −4 N");
    assert!(load.iter().any(|words| words.starts_with("interface a–ground: N ")), "{load:?}");
    let gone = first(&|file| file["loads"] = serde_json::json!([]));
    assert_eq!(gone[0], "load on a is gone: force 1, −2 N");
    let friction = first(&|file| file["friction"] = 0.5.into());
    assert_eq!(friction[0], "block a: μ 0.7 → 0.5");
    let limits = first(&|file| file["robots"][0]["limits"]["fy"] = 8.into());
    assert_eq!(limits, ["limits of robot arm: vertical 6 → 8 N"]);
    let kernel = first(&|file| file["kernel"] = 0.2.into());
    assert_eq!(kernel[0], "the scene: kernel 0.1 → 0.2");
}

/// Many blocks whose friction coefficient changed in the same way share one line.
#[test]
fn an_equal_change_of_many_blocks_is_one_line() {
    let row = |friction: f64| {
        let block = |k: u32| {
            let x = 3.0 * f64::from(k);
            serde_json::json!({ "polygon": [[x, 0], [x + 2.0, 0], [x + 2.0, 1], [x, 1]], "weight": 10 })
        };
        let blocks: Vec<_> = (0..6).map(block).collect();
        held(&|file| {
            let ground = serde_json::json!([[-9, -1], [20, -1], [20, 0], [-9, 0]]);
            file["ground"][0]["polygon"] = ground;
            file["blocks"] = blocks.clone().into();
            file["friction"] = friction.into();
            file["loads"] = serde_json::json!([]);
            file["robots"] = serde_json::json!([]);
        })
    };
    let changes = row(0.7).changes(&row(0.5));
    assert_eq!(changes[0], "6 blocks: μ 0.7 → 0.5");
    assert_eq!(changes[1], "6 interfaces: μ 0.7 → 0.5");
    let blocks = changes.iter().filter(|change| change.contains("block"));
    assert_eq!(blocks.count(), 1, "{changes:?}");
}

/// A reference of another version is not compared; the message names both versions and the remedy.
#[test]
fn facts_of_another_version_are_refused_with_a_remedy() {
    let other = held(&|_| {}).text().replace("{\"drystone_facts\":3", "{\"drystone_facts\":2");
    for (text, words) in [
        (
            &*other,
            "it has facts of version 2, and this program reads version 3; write it again with `drystone snapshot",
        ),
        ("{\"drystone_facts\":9}", "it has facts of version 9, and this program reads version 3"),
        ("{}", "it is not a file of facts: missing field `drystone_facts`"),
        ("{\"drystone_facts\":3}", "it is not a file of facts: missing field `decimals`"),
    ] {
        let refused = Facts::read(text).expect_err(text).to_string();
        assert!(refused.starts_with(words), "{refused}");
    }
}

/// The picture moved right by one pixel. The first column is repeated.
fn shifted(picture: &Picture) -> Picture {
    let wide = picture.width as usize;
    let mut pixels = Vec::with_capacity(picture.pixels().len());
    for row in picture.pixels().chunks(wide) {
        pixels.push(row[0]);
        pixels.extend_from_slice(&row[..wide - 1]);
    }
    Picture::new(picture.width, picture.height, pixels)
}

/// Changes every force of an analysis by up to a billionth, as another solver might.
fn jittered(analysis: &mut Analysis, random: &mut Random) {
    let mut near = |value: &mut f64| {
        let part = (random.next() % 2001) as f64 / 1000.0 - 1.0;
        *value += part * 1e-9 * value.abs().max(1e-3);
    };
    for frame in analysis.frames.iter_mut().map(Arc::make_mut) {
        near(&mut frame.total_force);
        near(&mut frame.total_sticking);
        for contact in &mut frame.contacts {
            contact.normal_forces.iter_mut().for_each(&mut near);
            near(&mut contact.friction_force);
            let resultant = &mut contact.resultant;
            near(&mut resultant.at.x);
            near(&mut resultant.at.y);
            near(&mut resultant.force.x);
            near(&mut resultant.force.y);
        }
        for robot in &mut frame.robots {
            near(&mut robot.force.x);
            near(&mut robot.force.y);
            near(&mut robot.torque);
        }
    }
}

/// The scenes of the gallery.
fn gallery() -> Vec<(String, Scene)> {
    let mut scenes = Vec::new();
    for folder in ["tests/scenes", "assets/thesis"] {
        let folder = format!("{}/{folder}", env!("CARGO_MANIFEST_DIR"));
        for entry in std::fs::read_dir(folder).expect("readable") {
            let path = entry.expect("readable").path();
            if path.extension().is_some_and(|e| e == "json") {
                let text = std::fs::read_to_string(&path).expect("readable");
                scenes.push((path.display().to_string(), Scene::from_json(&text).expect("sound")));
            }
        }
    }
    scenes.sort_by(|a, b| a.0.cmp(&b.0));
    scenes
}

#[test]
fn forces_that_differ_by_a_billionth_change_neither_facts_nor_drawing() {
    let mut random = Random::new(7);
    let scenes = gallery();
    assert!(scenes.len() >= 30, "{}", scenes.len());
    for (name, scene) in &scenes {
        let analysis = Analysis::new(scene);
        let mut other = analysis.clone();
        jittered(&mut other, &mut random);
        let facts = |a: &Analysis| Facts::read(&Facts::new(a, DIGITS).text()).expect("read back");
        let changes = facts(&analysis).changes(&facts(&other));
        assert!(changes.is_empty(), "{name}: {changes:#?}");
        let drawn = |a: &Analysis| svg::write(&figure::forces(a, &Options::default()));
        let changes = svg_text::changes(&drawn(&analysis), &drawn(&other)).expect("SVG");
        assert!(changes.is_empty(), "{name}: {changes:#?}");
    }
}

#[test]
fn a_difference_of_two_in_a_colour_is_a_change_but_not_of_one() {
    let expected = Sample::scene(&lintel("A lintel", 1.0));
    let packed = expected.picture.encode().expect("packed");
    let packed = Picture::decode(&packed).expect("read");
    let mut random = Random::new(3);
    let mut changed_by_up_to = |most: u64| {
        let pixels = expected.picture.pixels().iter().map(|p| {
            let mut p = *p;
            for channel in &mut p[..3] {
                let by = (random.next() % (2 * most + 1)) as i16 - most as i16;
                *channel = (i16::from(*channel) + by).clamp(0, 255) as u8;
            }
            p
        });
        Picture::new(expected.picture.width, expected.picture.height, pixels.collect())
    };
    let by_one = Difference::new(&packed, &changed_by_up_to(1), 1);
    assert!(by_one.is_none(), "{}", by_one.words());
    let by_two = Difference::new(&packed, &changed_by_up_to(2), 1);
    assert!(by_two.changed > by_two.of / 2, "{}", by_two.words());
}

#[test]
fn a_single_changed_pixel_is_reported() {
    let expected = Sample::scene(&lintel("A lintel", 1.0)).picture;
    let packed = Picture::decode(&expected.encode().expect("packed")).expect("read");
    let mut pixels = expected.pixels().to_vec();
    // A pixel of the white page, which has no rounding errors.
    pixels[5 * expected.width as usize + 9] = [252, 255, 255, 255];
    let found = Picture::new(expected.width, expected.height, pixels);
    let difference = Difference::new(&packed, &found, 1);
    assert_eq!((difference.changed, difference.largest, difference.bounds), (1, 3, Some([9, 5, 1, 1])));
    let image = difference.image(&packed);
    assert_eq!(image.pixel(9, 5), [0xd4, 0x00, 0x1a, 255], "marked in red");
    assert_eq!(image.pixel(12, 8), [0xf0, 0x70, 0x80, 255], "framed");
}

/// The facts of every scene of the gallery, with any characters in names, are read back as they were written.
#[test]
fn facts_are_read_back_as_they_were_written() {
    for (name, scene) in gallery() {
        let analysis = Analysis::new(&scene);
        let facts = Facts::new(&analysis, DIGITS);
        let text = facts.text();
        assert_eq!(Facts::read(&text).as_ref(), Ok(&facts), "{name}");
        assert_eq!(Facts::read(&text.replace('\n', "\r\n")), Ok(facts), "{name} with other line ends");
    }
    let nasty = lintel("a \"b\" \\ c: d, e 5 N\n\u{1b}", 1.0).replace("\"left\"", r#""x\": 1 N, \"y\\""#);
    let scene = Scene::from_json(&nasty).expect("sound");
    let analysis = Analysis::new(&scene);
    assert_eq!(analysis.verdict(), Verdict::Stable);
    let facts = Facts::new(&analysis, DIGITS);
    assert_eq!(Facts::read(&facts.text()), Ok(facts));
    assert!(output::svg::write(&figure::forces(&analysis, &Options::default())).contains("y\\"));
}
