//! Tests of the picture of accuracy against time.

use super::*;

/// Reads the table of src/doc/accuracy.md back into a summary.
fn printed() -> Vec<Summary> {
    let text = include_str!("../../../../doc/accuracy.md");
    let number = |cell: &str| cell.trim_matches('*').parse::<f64>().ok();
    let line = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let method = Method::ALL.into_iter().find(|m| cells.first() == Some(&m.name()))?;
        let [_, tolerance, time, iterations, median, worst, largest, wrong, undecided] = cells[..] else {
            return None;
        };
        Some(Summary {
            method,
            tolerance: number(tolerance)?,
            time: number(time)?,
            total_error: number(worst),
            median_error: number(median),
            largest_error: number(largest),
            wrong: number(wrong)? as usize,
            undecided: number(undecided)? as usize,
            frames: 40,
            iterations: number(iterations)? as usize,
            best: false,
        })
    };
    text.lines().filter_map(line).collect()
}

/// With `UPDATE_SNAPSHOTS=1`, the test writes the picture anew.
#[test]
fn the_picture_in_the_documentation_shows_its_table() {
    let lines = printed();
    assert_eq!(lines.len(), 6 * Method::ALL.len());
    let drawn = picture(&lines, 41).expect("drawn");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/accuracy.svg");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none() {
        std::fs::write(path, &drawn).expect("writable");
    }
    let kept = std::fs::read_to_string(path).expect("assets/accuracy.svg exists");
    assert!(drawn == kept, "assets/accuracy.svg is not the picture of the table");
}

/// The README makes this statement about the picture.
#[test]
fn proved_verdicts_are_never_wrong_and_others_sometimes_are() {
    let lines = printed();
    for method in Method::ALL {
        let wrong: usize = lines.iter().filter(|l| l.method == method).map(|l| l.wrong).sum();
        let proved = matches!(method, Method::Level(_));
        assert_eq!(wrong == 0, proved, "{}", method.name());
    }
}

#[test]
fn every_row_shows_wrong_and_undecided_verdicts_and_only_the_default_is_ringed() {
    let lines = printed();
    let drawing = drawing(&lines, 41);
    let texts = |wanted: &str| {
        let text = |item: &&Item| matches!(item, Item::Text(t) if t.words == wanted);
        drawing.items.iter().filter(text).count()
    };
    for method in Method::ALL {
        assert_eq!(texts(method.name()), 1, "{}", method.name());
    }
    let counts = lines.iter().flat_map(|l| [l.wrong, l.undecided]);
    assert_eq!(texts("0"), counts.filter(|count| *count == 0).count());
    let ring = |item: &&Item| matches!(item, Item::Path(p) if p.fill.is_none() && p.stroke.as_ref().is_some_and(|s| s.width == 1.6));
    assert_eq!(drawing.items.iter().filter(ring).count(), 3);
    for item in &drawing.items {
        if let Item::Text(t) = item {
            assert!(t.at.x > 0.0 && t.at.x < WIDTH && t.at.y < drawing.height, "{}", t.words);
        }
    }
}
