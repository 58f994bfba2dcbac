//! Figures as wide as one or two columns of a journal: labels do not lie on other texts, and texts are not cut or too
//! small.

use drystone::analysis::{Analysis, MarginKind, MarginKinds};
use drystone::drawing::{Group, Text};
use drystone::figure::{self, Options};

use super::{Box4, COLUMN, TWO_COLUMNS, classes, hidden, ink, of_class, panels, texts};
use crate::lines::contributed;
use crate::pictures::gallery;

/// All kinds, the mechanisms beyond margins, and the force polygon.
fn views() -> impl Iterator<Item = (figure::Kind, Options)> {
    let at = |margin| (figure::Kind::Mechanism, Options::default().at(figure::At::Margin(margin)));
    let margins = [MarginKind::Tilt, MarginKind::LoadFactor, MarginKind::HorizontalLoad, MarginKind::Friction].map(at);
    let polygon = (figure::Kind::Thrust, Options::default().with_polygon(true));
    let kinds = figure::Kind::ALL.into_iter().map(|kind| (kind, Options::default()));
    kinds.chain(margins).chain([polygon])
}

#[test]
fn no_label_lies_on_another_or_on_a_title_and_no_words_are_cut_or_tiny_in_any_kind() {
    let mut count = 0;
    let mut complaints = Vec::new();
    for (name, scene) in gallery().into_iter().chain(contributed()) {
        let options = drystone::analysis::Options::default().margins(MarginKinds::ALL);
        let analysis = Analysis::with(&scene, &options);
        for width in [COLUMN, TWO_COLUMNS] {
            for (kind, options) in views() {
                let drawing = figure::draw(&analysis, kind, &options.width(width));
                let what = format!("{name} {} {width:.0}", kind.name());
                let page = Group { items: drawing.items.clone(), ..Group::default() };
                for items in panels(&drawing) {
                    let (labels, found) = hidden(items, &["name", "robot-name", "amount"], &[]);
                    count += labels;
                    complaints.extend(found.into_iter().map(|c| format!("{what}: {c}")));
                }
                let labels: Vec<Text> = classes(&drawing.items, &["labels"]).into_iter().flat_map(texts).collect();
                let others: Vec<Text> = texts(&page).into_iter().filter(|text| !labels.contains(text)).collect();
                for text in labels.iter().chain(&others) {
                    let [left, top, right, bottom] = ink(text);
                    if left < 0.0 || top < 0.0 || right > drawing.width || bottom > drawing.height {
                        complaints.push(format!("{what}: {} is cut", text.words));
                    }
                    // 6.6 points, and 6 points in the theme of the thesis. Symbols of free bodies have small indices.
                    let least = match labels.contains(text) {
                        _ if kind == figure::Kind::Freebody => 9.0,
                        true => 10.1,
                        false => 10.99,
                    };
                    if text.size < least {
                        complaints.push(format!("{what}: {} of {}", text.words, text.size));
                    }
                }
                for label in &labels {
                    let [left, top, right, bottom] = ink(label);
                    let meets = |b: Box4| left < b[2] && b[0] < right && top < b[3] && b[1] < bottom;
                    for other in others.iter().filter(|other| meets(ink(other))) {
                        complaints.push(format!("{what}: {} lies on {}", label.words, other.words));
                    }
                }
            }
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
    assert!(count > 2000, "only {count} labels were checked");
}

#[test]
fn in_a_figure_of_column_width_texts_are_large_enough_and_not_cut() {
    let options = Options::default().width(COLUMN);
    let mut drawings = Vec::new();
    for (name, scene) in gallery() {
        let analysis = Analysis::new(&scene);
        for kind in figure::Kind::ALL {
            drawings.push((format!("{name} {}", kind.name()), figure::draw(&analysis, kind, &options)));
        }
    }
    for (name, drawing) in drawings {
        assert!((drawing.width - COLUMN).abs() < 1.0, "{name}: {}", drawing.width);
        let page = Group { items: drawing.items, ..Group::default() };
        let mut in_pictures = Vec::new();
        of_class(&page.items, "labels", &mut in_pictures);
        let names: Vec<Text> = in_pictures.into_iter().flat_map(texts).collect();
        for text in texts(&page) {
            let [left, top, right, bottom] = ink(&text);
            let inside = left >= 0.0 && top >= 0.0 && right <= drawing.width && bottom <= drawing.height;
            assert!(inside, "{name}: {} is cut", text.words);
            // At 0.6 points per pixel, texts have at least 6.3 points and names 5.4.
            let least = if names.contains(&text) { 9.0 } else { 10.5 };
            let small_sign = name.ends_with("freebody") && text.size > 10.0;
            assert!(text.size >= least || small_sign, "{name}: {} of {}", text.words, text.size);
        }
    }
}
