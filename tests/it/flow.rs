//! Figures of the force flow: the width of a band is proportional to its force, true lines of action pass through the
//! resultants, and the magnitudes of forces are printed.

use drystone::drawing::{Drawing, Group, Item, PagePoint, Path};
use drystone::figure::{self, Kind, Options};
use drystone::geometry::{Point, Vector, cross};
use drystone::output::svg;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use super::structure;

fn analysed(file: &Value) -> Analysis {
    Analysis::new(structure::scene(file))
}

fn drawn(analysis: &Analysis) -> Drawing {
    figure::draw(analysis, Kind::Flow, &Options::default())
}

/// Every group of a class.
fn groups<'a>(items: &'a [Item], class: &str) -> Vec<&'a Group> {
    let mut found = Vec::new();
    for item in items {
        if let Item::Group(group) = item {
            if group.class == class {
                found.push(group);
            }
            found.extend(groups(&group.items, class));
        }
    }
    found
}

fn path(group: &Group) -> &Path {
    let paths = group.items.iter().filter_map(|item| match item {
        Item::Path(path) => Some(path),
        _ => None,
    });
    paths.into_iter().next().expect("a path")
}

/// The axis of a band and its width at each point, pixels.
fn band(group: &Group) -> Vec<(PagePoint, f64)> {
    let points: Vec<PagePoint> = path(group).outline.points().collect();
    let count = points.len() / 2;
    let pairs = (0..count).map(|i| (points[i], points[2 * count - 1 - i]));
    pairs
        .map(|(a, b)| {
            let middle = PagePoint::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0);
            (middle, libm::hypot(a.x - b.x, a.y - b.y))
        })
        .collect()
}

/// The strand whose title begins with a text.
fn strand<'a>(drawing: &'a Drawing, start: &str) -> &'a Group {
    let all = groups(&drawing.items, "strand");
    let titles: Vec<&str> = all.iter().map(|g| g.title.as_str()).collect();
    let own = all.iter().find(|g| g.title.starts_with(start));
    own.unwrap_or_else(|| panic!("no {start:?} among {titles:#?}"))
}

#[test]
fn the_width_of_a_band_is_proportional_to_its_force() {
    let square = |id: &str, y: f64| structure::block(id, structure::rectangle(0.0, y, 2.0, 2.0), 6.0);
    let blocks = vec![square("low", 0.0), square("middle", 2.0), square("high", 4.0)];
    let drawing = drawn(&analysed(&structure::on_floor(0.7, blocks)));
    // 12 N enter the lowest block. Its weight of 6 N acts on the same line and is drawn on both sides of them, so that
    // the band of 18 N is half as wide again.
    let low = band(strand(&drawing, "In block low: 12 N from block middle, 12 N to"));
    let weight = band(strand(&drawing, "In block low: 6 N from its weight, 6 N to"));
    let middle = band(strand(&drawing, "In block middle: 6 N from block high"));
    let (first, last) = (low[0].1, weight[weight.len() - 1].1);
    assert!((last / first - 1.5).abs() < 1e-6, "{first} {last}");
    assert!((first / middle[0].1 - 2.0).abs() < 1e-6);
    // The weight begins at the centroid, and both bands end at the same point.
    let (end, own) = (low[low.len() - 1].0, weight[weight.len() - 1].0);
    assert!((end.y - own.y).abs() < 1e-6 && (end.x - own.x).abs() < 1e-6);
    assert!((weight[0].0.y - 0.5 * (low[0].0.y + end.y)).abs() < 1e-6);
    // On both sides of a joint, the bands have the same width and position.
    let weight = band(strand(&drawing, "In block middle: 6 N from its weight"));
    let end = weight[weight.len() - 1];
    assert!((end.1 - first).abs() < 1e-6 && (end.0.x - low[0].0.x).abs() < 1e-6);
}

#[test]
fn a_weight_on_the_line_of_a_force_is_pale_although_a_load_acts_at_the_same_point() {
    let square = |id: &str, y: f64| structure::block(id, structure::rectangle(0.0, y, 2.0, 2.0), 6.0);
    let mut file = structure::on_floor(0.7, vec![square("low", 0.0), square("high", 2.0)]);
    file["loads"] = json!([{ "block": "low", "at": [1.0, 1.0], "force": [0.0, -3.0] }]);
    let drawing = drawn(&analysed(&file));
    let low = band(strand(&drawing, "In block low: 6 N from block high, 9 N to"));
    let weight = band(strand(&drawing, "In block low: 6 N from its weight, 6 N to"));
    let (first, last) = (low[0].1, low[low.len() - 1].1);
    let all = weight[weight.len() - 1].1;
    assert!((last / first - 1.5).abs() < 1e-6, "{first} {last}");
    assert!((all / first - 2.5).abs() < 1e-6, "{first} {all}");
}

#[test]
fn the_widths_of_the_strands_of_a_block_sum_to_those_of_its_forces() {
    // A lintel on two posts carries a block. Two forces leave the lintel. They share the force of the block and the
    // lintel's weight.
    let blocks = vec![
        structure::block("left", structure::rectangle(0.0, 0.0, 1.0, 2.0), 4.0),
        structure::block("right", structure::rectangle(5.0, 0.0, 1.0, 2.0), 4.0),
        structure::block("lintel", structure::rectangle(0.0, 2.0, 6.0, 1.0), 10.0),
        structure::block("top", structure::rectangle(1.0, 3.0, 2.0, 1.0), 8.0),
    ];
    let drawing = drawn(&analysed(&structure::on_floor(0.7, blocks)));
    let on = |name: &str| -> Vec<Vec<(PagePoint, f64)>> {
        let all = groups(&drawing.items, "strand").into_iter();
        let own = all.filter(|g| g.title.starts_with(&format!("In block {name}: ")));
        own.map(band).collect()
    };
    let from_top: f64 = on("lintel").iter().map(|b| b[0].1).sum();
    let to_posts: f64 = on("lintel").iter().map(|b| b[b.len() - 1].1).sum();
    let in_top: f64 = on("top").iter().map(|b| b[b.len() - 1].1).sum();
    // The lintel's own 10 N and the 8 N of the block on it enter, and 18 N leave.
    assert!((from_top / in_top - 18.0 / 8.0).abs() < 1e-6, "{from_top} {in_top}");
    assert!((to_posts - from_top).abs() < 1e-6);
}

#[test]
fn lines_in_a_voussoir_are_true_lines_of_action() {
    let analysis = analysed(&structure::arch(11, 0.2, 0.7));
    let drawing = drawn(&analysis);
    let picture = groups(&drawing.items, "picture")[0];
    let camera = picture.camera.expect("a camera");
    let contacts = &analysis.frames[0].contacts;
    let mut checked = 0;
    for group in groups(&drawing.items, "strand") {
        let axis: Vec<Point> = band(group).iter().map(|p| camera.back(p.0)).collect();
        // A band that follows true lines of action has four points: at its ends, and at its corner before and after
        // the change of width.
        if axis.len() != 4 || (axis[1] - axis[2]).norm() > 1e-9 {
            continue;
        }
        for (end, next) in [(axis[0], axis[1]), (axis[3], axis[2])] {
            let at = |c: &&drystone::analysis::Contact| (c.resultant.at - end).norm() < 1e-6;
            let contact = contacts.iter().find(at).expect("a joint at the end of the band");
            let (force, direction): (Vector, Vector) = (contact.resultant.force, next - end);
            let sine = cross(force, direction) / (force.norm() * direction.norm());
            assert!(sine.abs() < 1e-3, "{}: {sine}", group.title);
            checked += 1;
        }
    }
    assert!(checked >= 8, "{checked}");
}

#[test]
fn the_largest_force_and_every_load_are_written() {
    let mut file = structure::on_floor(0.7, vec![structure::block("a", structure::rectangle(0.0, 0.0, 2.0, 2.0), 6.0)]);
    file["loads"] = json!([{ "block": "a", "at": [1.0, 2.0], "force": [0.0, -30.0] }]);
    let text = svg::write(&drawn(&analysed(&file)));
    assert!(text.contains(">36\u{a0}N<") || text.contains(">36 N<"), "{text}");
    assert!(text.contains("30\u{a0}N") || text.contains("30 N"));
}

#[test]
fn missing_forces_are_drawn_with_their_magnitudes() {
    // A block whose centroid lies a quarter of a metre beyond its support.
    let blocks = vec![
        structure::block("low", structure::rectangle(0.0, 0.0, 2.0, 1.0), 6.0),
        structure::block("high", structure::rectangle(1.25, 1.0, 2.0, 1.0), 6.0),
    ];
    let analysis = analysed(&structure::on_floor(0.7, blocks));
    assert!(!analysis.frames[0].failures.is_empty());
    let drawing = drawn(&analysis);
    let failures = groups(&drawing.items, "failures");
    assert!(!failures[0].items.is_empty());
    let text = svg::write(&drawing);
    assert!(text.contains("from a missing force"), "{text}");
    assert!(text.contains("force that cannot be carried"));
    let amounts = groups(&drawing.items, "amount");
    assert!(amounts.len() >= 2, "the largest force and a missing force have magnitudes");
}

#[test]
fn the_flow_of_four_hundred_blocks_has_few_paths_and_no_dots() {
    let path = format!("{}/assets/study/wall-400.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("the scene is there");
    let scene = Scene::from_json(&text).expect("a scene");
    let drawing = drawn(&Analysis::new(&scene));
    let flow = groups(&drawing.items, "flow");
    assert!(flow[0].items.len() <= 3 && !flow[0].items.is_empty());
    assert!(groups(&drawing.items, "resultant").is_empty());
    assert!(svg::write(&drawing).len() < 600_000);
}
