//! Names next to their blocks, with and without a leader line, and names in several lines, measured on the drawings.

use drystone::Analysis;
use drystone::drawing::{Drawing, Face, Group, PagePoint};
use drystone::figure::{self, Kind, Options};
use drystone::scene::{BlockId, Scene};

use crate::labels::{Box4, COLUMN, classes, ink, pieces, texts, through};
use crate::lines::contributed;
use crate::pictures::{gallery, scene};

const NAMES: [&str; 3] = ["name", "robot-name", "amount"];

fn drawn(scene: &Scene, kind: Kind, width: f64) -> Drawing {
    figure::draw(&Analysis::new(scene), kind, &Options::default().width(width))
}

/// The boxes of the lines of a label.
fn boxes(label: &Group) -> Vec<Box4> {
    texts(label).iter().map(ink).collect()
}

fn crosses([a, b]: [PagePoint; 2], [c, d]: [PagePoint; 2]) -> bool {
    let side = |p: PagePoint, q: PagePoint, r: PagePoint| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    side(a, b, c) * side(a, b, d) < -1e-6 && side(c, d, a) * side(c, d, b) < -1e-6
}

/// The ends of a label's leader line, or `None` without a leader. It is drawn twice: first as a wider line in the
/// colour of the page, then as the visible line, which is the last path of the label.
fn leader(label: &Group) -> Option<[PagePoint; 2]> {
    pieces(label).last().copied()
}

/// In the crowded scene `steps30`, at most one leader in twenty may cross a label or another leader. In all other
/// scenes, none may.
#[test]
fn leaders_cross_neither_each_other_nor_a_label() {
    let (mut count, mut complaints) = (0, Vec::new());
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        for (kind, width) in [(Kind::Forces, COLUMN), (Kind::Forces, 658.0), (Kind::Thrust, COLUMN)] {
            let drawing = drawn(&scene, kind, width);
            for panel in classes(&drawing.items, &["picture"]) {
                let labels = classes(&panel.items, &NAMES);
                for (i, label) in labels.iter().enumerate() {
                    let Some(line) = leader(label) else { continue };
                    count += 1;
                    for (j, other) in labels.iter().enumerate().filter(|(j, _)| *j != i) {
                        let struck = boxes(other).iter().any(|b| through(line, *b));
                        let crossed = j < i && leader(other).is_some_and(|l| crosses(line, l));
                        if struck || crossed {
                            let words = |l: &Group| texts(l)[0].words.clone();
                            let (a, b) = (words(label), words(other));
                            complaints.push(format!("{name}, {kind:?}, {width}: {a} over {b}"));
                        }
                    }
                }
            }
        }
    }
    assert!(count > 50, "only {count} leaders were checked");
    let crowded = |complaint: &&String| complaint.starts_with("steps30");
    let (crowded, others): (Vec<_>, Vec<_>) = complaints.iter().partition(crowded);
    assert!(others.is_empty(), "{others:?}");
    assert!(crowded.len() * 20 <= count, "{} of {count}: {crowded:?}", crowded.len());
}

/// Twelve loads stand so close together that their amounts do not fit beside each other. The amounts are in the order
/// of the loads, and no leader crosses another leader or an amount.
#[test]
fn the_amounts_of_loads_in_a_row_are_in_the_order_of_the_loads() {
    let loads: Vec<String> =
        (1..=12).map(|k| format!(r#"{{ "block": "beam", "at": [{k}, 1], "force": [0, -{k}001] }}"#)).collect();
    let scene = Scene::from_json(&format!(
        r#"{{ "drystone": 1,
            "ground": [ {{ "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]] }},
                        {{ "polygon": [[12, -1], [13, -1], [13, 0], [12, 0]] }} ],
            "blocks": [ {{ "id": "beam", "weight": 90000, "polygon": [[0, 0], [13, 0], [13, 1], [0, 1]] }} ],
            "loads": [ {} ] }}"#,
        loads.join(", ")
    ))
    .expect("a valid scene");
    for kind in [Kind::Forces, Kind::Flow, Kind::Thrust, Kind::Mechanism] {
        let drawing = drawn(&scene, kind, COLUMN);
        let labels = classes(&drawing.items, &["amount"]);
        // The largest force of a joint is written in bold, or with the word `largest`.
        let is_load = |l: &&&Group| {
            let text = &texts(l)[0];
            !text.words.starts_with("largest") && text.face == Face::Sans
        };
        let labels = labels.iter().filter(is_load);
        let labels: Vec<&Group> = labels.copied().collect();
        let mut amounts: Vec<(f64, String)> =
            labels.iter().map(|l| (texts(l)[0].at.x, texts(l)[0].words.clone())).collect();
        amounts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let words: Vec<&str> = amounts.iter().map(|a| a.1.as_str()).collect();
        let expected: Vec<String> = (1..=12).map(|k| format!("{k} kN")).collect();
        // Leaders lead to the amounts that have no room in the row.
        assert!(words.len() == 12 && expected.iter().all(|load| words.contains(&load.as_str())), "{kind:?} {words:?}");
        for (i, label) in labels.iter().enumerate() {
            let Some(line) = leader(label) else { continue };
            for (j, other) in labels.iter().enumerate().filter(|(j, _)| *j != i) {
                let crossed = j < i && leader(other).is_some_and(|l| crosses(line, l));
                let struck = boxes(other).iter().any(|b| through(line, *b));
                assert!(!crossed && !struck, "{kind:?}: {}", texts(label)[0].words);
            }
        }
    }
}

/// The picture cuts off the ground line on which both points lie. Their names once had no room.
#[test]
fn both_points_at_equal_height_have_a_name_in_a_free_body() {
    let found = Analysis::new(scene("tests/scenes/one.json"));
    for width in [COLUMN, 658.0] {
        let drawing = crate::pictures::free_body(&found, 0, BlockId(0), &Options::default().width(width));
        let drawing = drawing.expect("placed");
        let page = Group { items: drawing.items, ..Group::default() };
        let words: Vec<String> = texts(&page).into_iter().map(|t| t.words).collect();
        assert!(!words.iter().any(|w| w.contains("no room")), "{width}: {words:?}");
    }
}

#[test]
fn the_list_of_a_free_body_breaks_long_names_and_cuts_none() {
    let name = "a stone whose name is as long as a stone in a wall of names";
    let text = format!(
        r#"{{ "drystone": 1, "ground": [{{ "polygon": [[-1,-1],[4,-1],[4,0],[-1,0]] }}],
             "blocks": [{{ "id": "{name}", "polygon": [[0,0],[3,0],[3,1],[0,1]] }},
                        {{ "id": "b", "polygon": [[0,1],[3,1],[3,2],[0,2]] }}] }}"#
    );
    let found = Analysis::new(Scene::from_json(&text).expect("sound"));
    let drawing = crate::pictures::free_body(&found, 0, BlockId(1), &Options::default().width(COLUMN));
    let drawing = drawing.expect("placed");
    let list = classes(&drawing.items, &["list"]);
    let texts: Vec<_> = list.iter().flat_map(|group| texts(group)).collect();
    let words: Vec<&str> = texts.iter().map(|t| t.words.as_str()).collect();
    let list_text = words.join(" ");
    assert!(!list_text.contains('…') && list_text.contains("wall of names"), "{list_text}");
    for text in &texts {
        let [left, top, right, bottom] = ink(text);
        let on_page = left >= 0.0 && top >= 0.0 && right <= drawing.width && bottom <= drawing.height;
        assert!(on_page, "{} is cut", text.words);
    }
}
