//! Missing forces and loads in figures: the figure of a structure that falls must not look like a balance.

use drystone::analysis::{Analysis, MarginKind, MarginKinds, Options as AnalysisOptions, Verdict};
use drystone::drawing::{Drawing, Group, Item, Theme};
use drystone::figure::{self, Kind, Options};
use drystone::report::entry::{Entry, File, ReportOptions, SheetPart};
use drystone::scene::Scene;

use serde_json::json;

use crate::labels::{classes, texts};

fn scene(text: &str) -> Scene {
    Scene::from_json(text).unwrap_or_else(|problems| panic!("{problems}"))
}

/// A block of 6 N near the edge of the ground, pushed sideways with `push` newtons at its lower edge.
fn block(left: f64, push: f64) -> Scene {
    let right = left + 4.0;
    scene(&format!(
        r#"{{ "drystone": 1, "friction": 0.5, "ground": [{{ "polygon": [[0,-1],[9,-1],[9,0],[0,0]] }}],
        "blocks": [{{ "id": "a", "polygon": [[{left},0],[{right},0],[{right},2],[{left},2]], "weight": 6 }}],
        "loads": [{{ "block": "a", "force": [{push}, 0], "at": [{left}, 0.2] }}] }}"#
    ))
}

/// All words of a drawing, and whether its force polygon has a dashed path.
fn words_and_dashes(drawing: &Drawing) -> (String, bool) {
    let page = Group { items: drawing.items.clone(), ..Group::default() };
    let words: Vec<String> = texts(&page).into_iter().map(|t| t.words).collect();
    let sides = classes(&drawing.items, &["side"]);
    let dashed = sides.iter().flat_map(|f| &f.items).any(|item| match item {
        Item::Path(path) => path.stroke.as_ref().is_some_and(|s| !s.dash.is_empty()),
        _ => false,
    });
    (words.join(" "), dashed)
}

#[test]
fn the_force_polygon_of_a_falling_structure_closes_only_with_missing_forces() {
    let drawn = |scene: &Scene| {
        words_and_dashes(&figure::draw(&Analysis::new(scene), Kind::Thrust, &Options::default().with_polygon(true)))
    };
    let (stands, dashed) = drawn(&block(1.0, 2.0));
    assert!(stands.contains("the force polygon is closed") && !dashed, "{stands}");
    // Three quarters of the block overhang, so the ground would have to pull.
    let (falls, dashed) = drawn(&block(-3.0, 0.0));
    assert!(falls.contains("closes only with the missing forces at the ground") && dashed, "{falls}");
    assert!(!falls.contains("is closed"), "{falls}");
    // Missing forces inside the structure act in pairs, so that they are no sides of the polygon. It closes without them.
    let thin = scene(include_str!("../scenes/archri4.55.json"));
    let (inside, _) = drawn(&thin);
    assert!(inside.contains("closes, because the forces missing inside the structure act in pairs"), "{inside}");
    assert!(!inside.contains("closes only"), "{inside}");
}

/// A block of 2 m × 1 m that overhangs by half stands, but falls with any tilt or load to the right. To the left it
/// stands up to the friction angle, atan 0.6 = 31°.
#[test]
fn a_margin_that_ends_at_0_names_the_side_to_which_the_structure_falls() {
    let file = json!({ "drystone": 1, "friction": 0.6,
        "ground": [{ "polygon": [[-4, -1], [0, -1], [0, 0], [-4, 0]] }],
        "blocks": [{ "id": "a", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "weight": 1 }] });
    let scene = crate::structure::scene(&file);
    let analysis = Analysis::with(&scene, &AnalysisOptions::default().margins(MarginKinds::ALL));
    for (toward, expected) in
        [(MarginKind::Tilt, "stands from 30.9° left to 0°"), (MarginKind::HorizontalLoad, "stands from 0.6 left to 0")]
    {
        let options = Options::default().at(drystone::figure::At::Margin(toward));
        let drawing = figure::draw(&analysis, Kind::Mechanism, &options);
        let (words, _) = words_and_dashes(&drawing);
        let words = words.replace('\u{a0}', " ");
        assert!(words.contains(expected), "{words}");
    }
}

#[test]
fn a_margin_with_two_ends_shows_one_collapse() {
    let analysis = Analysis::with(block(1.0, 0.5), &AnalysisOptions::default().margins(MarginKinds::ALL));
    let ends = analysis.edges(0, MarginKind::Tilt);
    assert_eq!(ends.len(), 2);
    assert!(ends[0].0.abs() <= ends[1].0.abs() && ends[0].0 * ends[1].0 < 0.0);
    assert_eq!(analysis.edge(0, MarginKind::Tilt), ends.first().cloned());
    let drawing = figure::draw(
        &analysis,
        Kind::Mechanism,
        &Options::default().at(drystone::figure::At::Margin(MarginKind::Tilt)),
    );
    let ghosts = classes(&drawing.items, &["ghosts"]);
    assert_eq!(ghosts.len(), 1);
    assert!(!classes(&drawing.items, &["hinge", "slip"]).is_empty(), "where it opens or slides");
}

#[test]
fn a_margin_of_loads_states_the_loads_at_which_the_verdict_changes() {
    let analysis_options = AnalysisOptions::default().margins(MarginKinds::ALL);
    let options = Options::default().at(drystone::figure::At::Margin(MarginKind::LoadFactor));
    let pushed = block(1.0, 2.0);
    let analysis = Analysis::with(&pushed, &analysis_options);
    let drawing = figure::draw(&analysis, Kind::Mechanism, &options);
    let (words, _) = words_and_dashes(&drawing);
    // The block slides at 3 N, half of its weight.
    assert!(words.contains("stands with its loads times at most 1.5"), "{words}");
    assert_eq!(Analysis::new(block(1.0, 2.99)).verdict(), Verdict::Stable);
    assert_eq!(Analysis::new(block(1.0, 3.01)).verdict(), Verdict::Unstable);
    assert_eq!(classes(&drawing.items, &["ghosts"]).len(), 1);
    assert_eq!(classes(&drawing.items, &["load"]).len(), 1, "the load is shown");
    // A structure that falls with its loads is drawn as it falls. The text states the loads with which it would stand: up
    // to 3 of the 4 N.
    let falls = block(1.0, 4.0);
    let analysis = Analysis::with(&falls, &analysis_options);
    let drawing = figure::draw(&analysis, Kind::Mechanism, &options);
    let (words, _) = words_and_dashes(&drawing);
    let would_stand = "stands with its loads times at most 0.75";
    assert!(words.contains(would_stand), "{words}");
    assert_eq!(classes(&drawing.items, &["displaced"]).len(), 1);
    assert!(!words.contains("would begin to fall"), "{words}");
}

#[test]
fn a_small_torque_is_drawn_legibly_and_its_amount_is_stated() {
    let small = scene(
        r#"{ "drystone": 1, "ground": [{ "polygon": [[0,-1],[9,-1],[9,0],[0,0]] }],
        "blocks": [{ "id": "a", "polygon": [[1,0],[5,0],[5,2],[1,2]], "weight": 6000 }],
        "loads": [{ "block": "a", "force": [0, 0], "at": [3, 1.5], "torque": 0.5 }] }"#,
    );
    let drawing = figure::draw(&Analysis::new(&small), Kind::Forces, &Options::default().theme(Theme::thesis()));
    let turns = classes(&drawing.items, &["torque"]);
    let [turn] = turns[..] else { panic!("{} turning arrows", turns.len()) };
    let across = turn.items.iter().find_map(|item| match item {
        Item::Path(path) => {
            let xs: Vec<f64> = path.outline.points().map(|p| p.x).collect();
            let most = xs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            Some(most - xs.iter().copied().fold(f64::INFINITY, f64::min))
        }
        _ => None,
    });
    assert!(across.is_some_and(|wide| wide > 10.0), "{across:?}");
    let (words, _) = words_and_dashes(&drawing);
    assert!(words.contains("0.5"), "{words}");
}

#[test]
fn a_report_of_an_unstable_frame_says_that_missing_forces_are_included() {
    let file = File { name: "a.json", text: "{}" };
    let captions = |scene: &Scene| {
        let entry = Entry::new(file, &Analysis::new(scene), &ReportOptions::default());
        let parts = entry.sections.iter().flat_map(|s| &s.parts);
        let notes = parts.filter_map(|part| match part {
            SheetPart::Note(words) => Some(words.as_str()),
            _ => None,
        });
        notes.collect::<Vec<_>>().join(" / ")
    };
    let falls = captions(&block(1.0, 4.0));
    assert!(falls.contains("These forces hold only together with the missing forces."), "{falls}");
    let stands = captions(&block(1.0, 2.0));
    assert!(stands.contains("One possible balance") && !stands.contains("missing"), "{stands}");
}
