//! Figures of structures by other authors: words are complete, separate and legible, missing forces and loads are
//! shown, and numbers do not look like names of blocks.

use drystone::Analysis;
use drystone::analysis::Verdict;
use drystone::drawing::difference::contrast;
use drystone::drawing::{Colour, Drawing, Group, Item, Outline, PagePoint, PageRect, Text};
use drystone::figure::{self, Kind, Options};
use drystone::scene::Scene;

use crate::labels::{classes, ink, texts};

/// Structures by other authors: with measured coordinates, holes, loads, materials, many robots, a pebble on a
/// boulder, names in other scripts, and a wall that falls.
fn strangers() -> Vec<(String, Scene)> {
    let folder = format!("{}/tests/it/stranger", env!("CARGO_MANIFEST_DIR"));
    let mut names: Vec<String> = std::fs::read_dir(&folder)
        .expect("structures")
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    names.sort();
    assert_eq!(names.len(), 9);
    let read = |name: String| {
        let text = std::fs::read_to_string(format!("{folder}/{name}")).expect("readable");
        let scene = Scene::from_json(&text).unwrap_or_else(|p| panic!("{name}:\n{p}"));
        (name, scene)
    };
    names.into_iter().map(read).collect()
}

/// Whether a point lies in an outline. Curves are replaced by their control polygons.
fn contains(outline: &Outline, at: PagePoint) -> bool {
    let points: Vec<PagePoint> = outline.points().collect();
    let mut inside = false;
    for i in 0..points.len() {
        let (a, b) = (points[i], points[(i + 1) % points.len()]);
        if (a.y > at.y) != (b.y > at.y) && at.x < (b.x - a.x) * (at.y - a.y) / (b.y - a.y) + a.x {
            inside = !inside;
        }
    }
    inside
}

/// Sets `found` to the colour of the last filled path at a position, without the labels.
fn below(items: &[Item], at: PagePoint, clip: Option<PageRect>, found: &mut Colour) {
    let visible = clip
        .is_none_or(|c| (c.at.x..=c.at.x + c.width).contains(&at.x) && (c.at.y..=c.at.y + c.height).contains(&at.y));
    for item in items {
        match item {
            Item::Path(path) if visible && path.opacity > 0.99 && contains(&path.outline, at) => {
                *found = path.fill.unwrap_or(*found);
            }
            Item::Group(group) if group.class != "labels" => {
                below(&group.items, at, group.clip.or(clip), found);
            }
            _ => {}
        }
    }
}

/// The number of labels that were checked, and all faults of the texts of a drawing.
fn faults(drawing: &Drawing) -> (usize, Vec<String>) {
    let page = Group { items: drawing.items.clone(), ..Group::default() };
    let all: Vec<Text> = texts(&page);
    let mut faults = Vec::new();
    for (i, text) in all.iter().enumerate() {
        let [left, top, right, bottom] = ink(text);
        if left < 0.0 || top < 0.0 || right > drawing.width || bottom > drawing.height {
            faults.push(format!("{} is cut", text.words));
        }
        // A text with a halo may lie on another text.
        for other in all[..i].iter().filter(|o| o.halo.is_none() && text.halo.is_none()) {
            let b = ink(other);
            if left < b[2] && b[0] < right && top < b[3] && b[1] < bottom {
                faults.push(format!("{} lies on {}", text.words, other.words));
            }
        }
    }
    let mut labels = 0;
    for picture in classes(&drawing.items, &["picture"]) {
        for text in classes(&picture.items, &["labels"]).into_iter().flat_map(texts) {
            labels += 1;
            let [left, top, right, bottom] = ink(&text);
            let middle = PagePoint::new((left + right) / 2.0, (top + bottom) / 2.0);
            let mut ground = drawing.background.unwrap_or(Colour::WHITE);
            match &text.halo {
                Some(halo) => ground = halo.0,
                None => below(&picture.items, middle, None, &mut ground),
            }
            let contrast = contrast(text.fill, ground);
            if contrast < 4.5 {
                faults.push(format!("{}: contrast {contrast:.2}", text.words));
            }
        }
    }
    (labels, faults)
}

#[test]
fn overlapping_and_faint_texts_are_found() {
    let (_, scene) = strangers().remove(0);
    let mut drawing = figure::forces(&Analysis::new(&scene), &Options::default());
    assert_eq!(faults(&drawing).1, Vec::<String>::new());
    let key = classes(&drawing.items, &["legend"])[0];
    let mut twice = texts(key)[0].clone();
    twice.at = twice.at.moved(3.0, 1.0);
    drawing.items.push(twice.into());
    let faint = Group::with_class("labels").with(Text::new(
        PagePoint::new(40.0, 70.0),
        "faint",
        drystone::drawing::Face::Sans,
        12.0,
        Colour::hex(0xcccccc),
    ));
    drawing.items.push(Group::with_class("picture").with(faint).into());
    let found = faults(&drawing).1;
    assert!(found.iter().any(|f| f.contains("lies on")), "{found:?}");
    assert!(found.iter().any(|f| f.starts_with("faint: contrast")), "{found:?}");
}

/// All texts of a drawing, separated by spaces.
fn all_words(drawing: &Drawing) -> String {
    let page = Group { items: drawing.items.clone(), ..Group::default() };
    let words: Vec<String> = texts(&page).into_iter().map(|t| t.words).collect();
    words.join(" ")
}

#[test]
fn missing_forces_and_loads_are_shown_even_if_very_small() {
    for (name, scene) in strangers() {
        let analysis = Analysis::new(&scene);
        let drawing = figure::forces(&analysis, &Options::default());
        for (found, frame) in analysis.frames.iter().zip(classes(&drawing.items, &["frame"])) {
            let drawn: Vec<String> =
                classes(&frame.items, &["missing", "load"]).into_iter().map(|g| g.title.clone()).collect();
            let missing = drawn.iter().filter(|t| t.starts_with("Missing")).count();
            assert!(missing >= found.failures.len(), "{name}: {missing}");
            assert_eq!(found.verdict == Verdict::Unstable, missing > 0, "{name}");
            let loads = drawn.iter().filter(|t| t.starts_with("Load on")).count();
            let expected = scene.loads().iter().filter(|l| l.force.norm() > 0.0).count();
            assert_eq!(loads, expected, "{name}");
        }
    }
}

#[test]
fn names_of_blocks_occur_without_a_unit_after_them() {
    let (_, scene) = strangers().into_iter().find(|s| s.0 == "falls.json").expect("it is there");
    let analysis = Analysis::new(&scene);
    // The figure of one block names forces and coordinates too.
    for kind in Kind::ALL.into_iter().filter(|kind| !kind.shows_one_block()) {
        let drawing = figure::draw(&analysis, kind, &Options::default());
        let words = all_words(&drawing);
        for label in classes(&drawing.items, &["name"]).into_iter().flat_map(texts) {
            let name = label.words.as_str();
            let as_name = words.match_indices(name).any(|(at, _)| {
                let rest = words[at + name.len()..].trim_start_matches([' ', '\u{a0}']);
                let amount = ["N", "kN", "m ", "%"].iter().any(|unit| rest.starts_with(unit));
                !amount && words[..at].ends_with([' ', '\u{a0}'])
            });
            assert!(as_name, "{}: {name} occurs only as a number with a unit: {words}", kind.name());
        }
    }
}
