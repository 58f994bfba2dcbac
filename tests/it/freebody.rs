//! Figures of free bodies: every force is listed, and the listed forces balance.

use drystone::Analysis;
use drystone::analysis::Verdict;
use drystone::drawing::Group;
use drystone::figure::{self, Corners, Options};
use drystone::scene::BlockId;

use serde_json::{Value, json};

use crate::labels::{COLUMN, hidden, ink, texts};
use crate::lines::contributed;
use crate::pictures::{gallery, scene};
use crate::structure::rectangle;

/// A row of the list: its name, and x, y and moment as printed.
struct Row {
    name: String,
    numbers: [String; 3],
}

fn rows(description: &str) -> Vec<Row> {
    let mut rows = Vec::new();
    for part in description.split("; ").collect::<Vec<_>>().windows(2) {
        // `mg = 6 N: (0` and `−6) N, moment 0 N·m, weight`
        let Some((before, x)) = part[0].rsplit_once(": (") else {
            continue;
        };
        let (y, rest) = part[1].split_once(") ").expect("the second component");
        let moment = rest.split_once("moment ").expect("a moment").1;
        let moment = moment.split(' ').next().expect("a number");
        let name = before.rsplit(". ").next().unwrap_or(before);
        rows.push(Row { name: name.to_owned(), numbers: [x, y, moment].map(str::to_owned) });
    }
    rows
}

fn number(printed: &str) -> f64 {
    printed.replace('−', "-").parse().unwrap_or_else(|_| panic!("{printed}"))
}

/// Half a unit of the last digit of a printed number.
fn rounding(printed: &str) -> f64 {
    let decimals = printed.split_once('.').map_or(0, |(_, d)| d.len());
    0.5 * libm::pow(10.0, -(decimals as f64))
}

/// Asserts that the forces listed for a block sum to the listed sum, and to zero if the structure balances. Returns
/// the number of listed forces.
fn assert_balances(name: &str, analysis: &Analysis, frame: usize, id: BlockId) -> usize {
    let (scene, found) = (analysis.given(), &analysis.frames[frame]);
    let mut listed = 0;
    for corners in [Corners::Few, Corners::All] {
        let options = Options::default().corners(corners);
        let drawing = crate::pictures::free_body(analysis, frame, id, &options).expect("it is placed");
        let what = format!("{name}, frame {frame}, block {}", scene.blocks()[id.0].id);
        let rows = rows(&drawing.description);
        let (sum, forces) = rows.split_last().expect("a list");
        assert_eq!(sum.name, "sum", "{what}: {}", drawing.description);
        assert!(!forces.is_empty() || scene.blocks()[id.0].weight == 0.0, "{what}");
        for k in 0..3 {
            let added: f64 = forces.iter().map(|r| number(&r.numbers[k])).sum();
            let slack = rounding(&sum.numbers[k]) * (forces.len() as f64 + 1.0) + 1e-9;
            let off = (added - number(&sum.numbers[k])).abs();
            assert!(off <= slack, "{what}: column {k} adds up to {added}, {off} off");
            if found.verdict != Verdict::Undecided && !found.unsupported.contains(&id) {
                let all = &drawing.description;
                assert_eq!(number(&sum.numbers[k]), 0.0, "{what}: {all}");
            }
        }
        listed += forces.len();
    }
    listed
}

#[test]
fn the_printed_forces_and_moments_of_every_block_sum_to_zero() {
    let mut listed = 0;
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let analysis = Analysis::new(&scene);
        for frame in 0..analysis.frames.len() {
            // A wall has many similar blocks, so the first 24 are enough.
            for id in scene.frames()[frame].placed.iter().take(24) {
                listed += assert_balances(&name, &analysis, frame, *id);
            }
        }
    }
    assert!(listed > 1500, "{listed}");
}

/// With a kernel of 1, the two application points of each interface coincide in its middle. The beam on five posts has
/// so many interfaces that only their resultants are listed.
#[test]
fn the_forces_of_interfaces_with_a_single_application_point_sum_to_zero() {
    let posts = (0..5).map(|k| rectangle(2.0 * f64::from(k), 0.0, 1.0, 2.0));
    let polygons = posts.chain([rectangle(0.0, 2.0, 9.0, 1.0)]);
    let blocks: Vec<Value> = polygons.map(|p| json!({ "polygon": p })).collect();
    let file = json!({ "drystone": 1, "kernel": 1, "friction": 0.6,
        "ground": [{ "polygon": rectangle(-1.0, -1.0, 11.0, 1.0) }], "blocks": blocks });
    let analysis = Analysis::new(crate::structure::scene(&file));
    assert_eq!(analysis.frames[0].verdict, Verdict::Stable);
    assert!(assert_balances("five posts", &analysis, 0, BlockId(5)) >= 12);
}

#[test]
fn loads_missing_forces_and_the_step_are_listed() {
    let loaded = crate::pictures::scene("tests/scenes/loaded.json");
    let beam = BlockId(2);
    let options = Options::default();
    let drawing = crate::pictures::free_body(&Analysis::new(&loaded), 0, beam, &options).expect("placed");
    let description = &drawing.description;
    assert!(description.contains("Load Q_1 on block beam: 4 kN at 270°"), "{description}");
    assert!(description.contains("Q_2 = 0.800 kN: (0.800; 0.000) kN"), "{description}");
    let slide = crate::pictures::scene("tests/scenes/slide.json");
    let drawing = crate::pictures::free_body(&Analysis::new(&slide), 0, BlockId(0), &options).expect("placed");
    assert!(drawing.description.contains("missing, ground"), "{}", drawing.description);
    let steps = crate::pictures::scene("assets/thesis/figure-4.json");
    let analysis = Analysis::new(&steps);
    let drawing = crate::pictures::free_body(&analysis, 1, BlockId(0), &options).expect("placed");
    let svg = drystone::output::svg::write(&drawing);
    assert!(svg.contains("step (b) of 6"), "{svg}");
}

#[test]
fn every_name_of_a_free_body_is_legible() {
    let mut count = 0;
    let column = Options::default().width(COLUMN);
    let corners = Options::default().corners(figure::Corners::All);
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let analysis = Analysis::new(&scene);
        for (frame, found) in scene.frames().iter().enumerate().take(3) {
            for block in &found.placed {
                for options in [&Options::default(), &column, &corners] {
                    let drawing =
                        crate::pictures::free_body(&analysis, frame, *block, options).expect("the block is placed");
                    let (labels, complaints) =
                        hidden(&drawing.items, &["name"], &["force", "block", "guides", "values", "axes"]);
                    count += labels;
                    assert!(complaints.is_empty(), "{name}, block {block:?}: {complaints:?}");
                    let page = Group { items: drawing.items, ..Group::default() };
                    for text in texts(&page) {
                        let [left, top, right, bottom] = ink(&text);
                        let inside = left >= 0.0 && top >= 0.0 && right <= drawing.width && bottom <= drawing.height;
                        assert!(inside, "{name}, {block:?}: {} is cut", text.words);
                    }
                }
            }
        }
    }
    assert!(count > 2000, "only {count} names were checked");
}

#[test]
fn the_free_body_of_the_slope_names_and_lists_every_force() {
    let scene = scene("assets/thesis/figure-1.json");
    let analysis = Analysis::new(&scene);
    let all = Options::default().corners(figure::Corners::All);
    let drawing = crate::pictures::free_body(&analysis, 0, BlockId(0), &all).expect("placed");
    for name in ["F_s1", "F_fl1", "F_fr1", "F_s2", "F_fl2", "F_fr2"] {
        assert!(drawing.description.contains(&format!("force {name} on block a")), "{name}");
    }
    // 6 N on a slope of 20°: friction of 6·sin 20° acts up the slope, to the right of the normal ŝ.
    for part in [
        "mg = 6.000 N: (0.000; −6.000) N",
        "F_fl1 = 0.000 N: (0.000; 0.000) N",
        "sum: (0.000; 0.000) N, moment 0.000 N·m",
        "s = (−0.342; 0.94)",
    ] {
        assert!(drawing.description.contains(part), "{part}: {}", drawing.description);
    }
    assert_eq!(crate::pictures::free_body(&analysis, 1, BlockId(0), &Options::default()), None);
    assert_eq!(crate::pictures::free_body(&analysis, 0, BlockId(1), &Options::default()), None);
}
