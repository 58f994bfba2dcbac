//! The keys of figures, their size on a page, and the options that leave out parts of a figure.

use drystone::analysis::Analysis;
use drystone::drawing::{Face, Group, Text, Theme};
use drystone::figure::{self, Kind, Options};

use crate::labels::{COLUMN, classes, pieces, texts};
use crate::pictures::scene;

#[test]
fn a_load_has_its_magnitude_and_is_explained_in_the_key() {
    let scene = scene("tests/scenes/loaded.json");
    let drawing = figure::forces(&Analysis::new(&scene), &Options::default().theme(Theme::thesis()));
    // The largest force of a joint is written in bold.
    let amounts: Vec<String> = classes(&drawing.items, &["amount"])
        .into_iter()
        .flat_map(texts)
        .filter(|text| text.face == Face::Sans)
        .map(|t| t.words)
        .collect();
    assert_eq!(amounts.len(), scene.loads().len(), "{amounts:?}");
    let key: Vec<Text> = classes(&drawing.items, &["legend"]).into_iter().flat_map(texts).collect();
    assert!(key.iter().any(|t| t.words == "loads"), "{key:?}");
    assert!(key.iter().any(|t| t.words.contains("weight")), "{key:?}");
}

#[test]
fn every_robot_has_its_name_and_its_force() {
    let scene = scene("tests/scenes/robots10.json");
    let drawing = figure::forces(&Analysis::new(&scene), &Options::default().theme(Theme::thesis()));
    let labels: Vec<Text> = classes(&drawing.items, &["amount"]).into_iter().flat_map(texts).collect();
    for robot in scene.robots() {
        let words = format!("{}: ", robot.id);
        assert!(labels.iter().any(|t| t.words.starts_with(&words) && t.words.ends_with('N')), "{words}: {labels:?}");
    }
}

#[test]
fn thirty_steps_fit_on_a_page_and_figure_4_in_a_column() {
    let drawn = |path: &str, width| {
        let scene = scene(path);
        let mut options = Options::default();
        options.width = width;
        figure::forces(&Analysis::new(&scene), &options)
    };
    let steps = drawn("tests/scenes/steps30.json", None);
    assert!(steps.height / steps.width < 297.0 / 210.0, "{} × {}", steps.width, steps.height);
    let figure = drawn("assets/thesis/figure-4.json", Some(COLUMN));
    let high = figure.height / figure.width * 84.0;
    // A4 without margins of 35 mm at the top and at the bottom.
    assert!(high < 227.0, "{high} mm");
}

/// The scenes of the test below: none of them is flatter than a third of its width.
const NOT_FLAT: [&str; 9] =
    ["arch13", "arch13thin", "archload", "buttress", "doorway", "leaning", "loaded", "slide", "wall200"];

#[test]
fn in_a_column_of_print_key_and_caption_need_at_most_half_of_a_figure() {
    let kinds = [Kind::Forces, Kind::Flow, Kind::Thrust, Kind::Mechanism];
    let mut wordy = Vec::new();
    for name in NOT_FLAT {
        let analysis = Analysis::new(scene(&format!("tests/scenes/{name}.json")));
        for kind in kinds {
            let drawing = figure::draw(&analysis, kind, &Options::default().width(COLUMN));
            let pictures = classes(&drawing.items, &["ground", "earth", "block", "displaced"]);
            let shapes = pictures.into_iter().flat_map(pieces).flatten();
            let bottom = shapes.map(|p| p.y).fold(0.0, f64::max);
            let share = 1.0 - bottom / drawing.height;
            if share > 0.5 {
                wordy.push(format!("{name} {}: {share:.2}", kind.name()));
            }
        }
    }
    assert!(wordy.is_empty(), "{wordy:#?}");
}

#[test]
fn each_option_leaves_out_only_the_part_that_it_names() {
    let scene = scene("tests/scenes/lintel.json");
    let analysis = Analysis::new(&scene);
    let words_of = |options: &Options| {
        let drawing = figure::forces(&analysis, options);
        let badges = classes(&drawing.items, &["verdict"]).len();
        let page = Group { items: drawing.items, ..Group::default() };
        // A symbol shows the verdict of a panel.
        let badge = (badges > 0).then(|| "verdict".to_owned());
        texts(&page).into_iter().map(|t| t.words).chain(badge).collect::<Vec<String>>()
    };
    let look = || Options::default().theme(Theme::thesis());
    let full = words_of(&look());
    let has = |all: &[String], words: &str| all.iter().any(|s| s.contains(words));
    let signs = ["A lintel, and", "(b) The crane", "verdict", "one colour per block"];
    assert!(signs.iter().all(|words| has(&full, words)), "{full:?}");
    let less = [look().titles(false), look().captions(false), look().verdicts(false), look().keys(false)];
    for (number, options) in less.iter().enumerate() {
        let left = words_of(options);
        for (other, words) in signs.iter().enumerate() {
            assert_eq!(has(&left, words), other != number, "{words}: {left:?}");
        }
    }
    let more = look().scale_bar(true).dimensions(true);
    let more = words_of(&more);
    let metres = |all: &[String]| all.iter().filter(|s| s.ends_with(" m")).count();
    assert_eq!((metres(&full), metres(&more)), (0, 7), "{more:?}");
}
