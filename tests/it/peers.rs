//! The README's picture that compares drystone with other programs shows the table written by
//! `tests/bench/peers/peers.py`.

pub mod growth;

use std::fs;
use std::path::Path;

use drystone::internals::chart::Point;

use growth::{Growth, GrowthLine, growth};

/// A row of the table: structure, blocks, whether it stands, program, answer, milliseconds.
type Row = (String, f64, bool, String, String, f64);

fn rows() -> Vec<Row> {
    let text = include_str!("../bench/peers/peers.csv");
    let mut lines = text.lines();
    let head = "structure,blocks,stands,program,answer,milliseconds";
    assert_eq!(lines.next(), Some(head));
    lines.map(row).collect()
}

fn row(line: &str) -> Row {
    let parts: Vec<&str> = line.split('"').collect();
    let [before, program, after] = parts[..] else {
        panic!("a name in quotes: {line}");
    };
    let before: Vec<&str> = before.split(',').collect();
    let after: Vec<&str> = after.split(',').collect();
    let number = |cell: &str| cell.parse::<f64>().expect(line);
    (
        before[0].to_owned(),
        number(before[1]),
        before[2] == "yes",
        program.to_owned(),
        after[1].to_owned(),
        number(after[2]),
    )
}

/// The label of a program's line in the picture: the name in the table without the version.
fn name(program: &str) -> Option<String> {
    match program {
        "drystone" => return Some("drystone, everything found out".to_owned()),
        "drystone batch, one of many" => return Some(MANY.to_owned()),
        _ => {}
    }
    let (name, version) = program.rsplit_once(' ').unwrap_or((program, ""));
    let name = if version.contains('.') { name } else { program };
    Some(name.to_owned())
}

const MANY: &str = "drystone, one of many scenes";

/// The lines of all programs for walls that stand, in the order of the table.
fn walls() -> Vec<GrowthLine> {
    let mut lines: Vec<GrowthLine> = Vec::new();
    for (structure, blocks, stands, program, answer, milliseconds) in rows() {
        let Some(name) = name(&program).filter(|_| structure == "wall" && stands) else {
            continue;
        };
        let is_highlighted = program.starts_with("drystone");
        let point = Point { x: blocks, y: milliseconds, wrong: answer != "right" };
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.points.push(point),
            None => lines.push(GrowthLine { name, is_highlighted, points: vec![point] }),
        }
    }
    for line in &mut lines {
        line.points.sort_by(|a, b| a.x.total_cmp(&b.x));
    }
    lines
}

fn drawn() -> String {
    let chart = Growth {
        title: "How long a standing wall takes".into(),
        x: "blocks".into(),
        y: "milliseconds of processor time, median".into(),
        lines: walls(),
        wrong: "wrong answer".into(),
    };
    growth(&chart).expect("drawn")
}

/// `UPDATE_SNAPSHOTS=1` draws the picture again.
#[test]
fn the_readmes_picture_of_other_programs_shows_the_table_that_was_measured() {
    let drawn = drawn();
    let shown = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/peers.svg");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none() {
        fs::write(&shown, &drawn).expect("writable");
    }
    let kept = fs::read_to_string(&shown).expect("in the repository");
    assert!(kept == drawn, "the picture differs from the table: inspect it, and run once with UPDATE_SNAPSHOTS=1");
}

/// The statement of the README about the picture.
#[test]
fn drystone_in_a_batch_is_faster_than_other_programs_at_ten_and_a_thousand_blocks() {
    let lines = walls();
    let at = |line: &GrowthLine, least: f64| line.points.iter().find(|p| p.x >= least).map(|p| p.y);
    let many = lines.iter().find(|line| line.name == MANY);
    let many = many.expect("in the table");
    for size in [10.0, 1000.0] {
        let own = at(many, size).expect("measured");
        for other in lines.iter().filter(|line| !line.is_highlighted) {
            let others = at(other, size);
            assert!(others.is_none_or(|y| y > 2.0 * own), "{} at {size}", other.name);
        }
    }
}

#[test]
fn every_program_is_named_once_and_inside_the_picture() {
    let drawn = drawn();
    for line in walls() {
        assert_eq!(drawn.matches(&format!("\n{}\n", line.name)).count(), 1, "{}", line.name);
    }
    assert!(drawn.len() < 40_000, "{}", drawn.len());
}
