//! Checks the equilibrium tables of a report from their printed numbers alone: forces and moments of the structure.

use super::{FALLS, Folder, STANDS};

/// A row of an equilibrium table: each printed value, and half a unit of its third digit.
struct Row {
    name: String,
    values: Vec<Option<(f64, f64)>>,
}

fn number(words: &str) -> Option<(f64, f64)> {
    let words = words.trim_matches('*').replace('−', "-");
    let value: f64 = words.parse().ok()?;
    // Three significant digits are written, without zeros at the end.
    let digit = if value == 0.0 { 0.0 } else { libm::exp10(libm::floor(libm::log10(value.abs())) - 2.0) };
    Some((value, 0.5 * digit))
}

/// The equilibrium tables of a Markdown page: the caption, the head and the rows of each.
fn balances(page: &str) -> Vec<(String, String, Vec<Row>)> {
    let mut found = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if !(line.starts_with("**") && line.contains("; moments about ")) {
            continue;
        }
        let mut table = lines.by_ref().skip(1).take_while(|l| l.starts_with('|'));
        let head = table.next().expect("a head").to_owned();
        let rows = table.skip(1).map(|row| {
            let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
            Row { name: cells[0].trim_matches('*').to_owned(), values: cells[1..].iter().map(|c| number(c)).collect() }
        });
        found.push((line.to_owned(), head, rows.collect()));
    }
    found
}

/// The factor from the unit of a column to newtons or newton metres.
fn factor(head: &str, column: usize) -> f64 {
    let cells: Vec<&str> = head.trim_matches('|').split('|').collect();
    match cells[column + 1].trim().rsplit(", ").next() {
        Some(unit) if unit.starts_with('k') => 1e3,
        Some(unit) if unit.starts_with('M') => 1e6,
        Some(unit) if unit.starts_with('m') && unit.len() > 1 => 1e-3,
        Some(unit) if unit.starts_with('µ') => 1e-6,
        _ => 1.0,
    }
}

/// Asserts that the forces of a table sum to zero, and that each moment follows from its force and its position.
fn assert_balances((caption, head, rows): &(String, String, Vec<Row>)) {
    let (sum, forces) = rows.split_last().expect("rows");
    assert_eq!(sum.name, "sum", "{caption}");
    for column in 2..5 {
        let printed = forces.iter().filter_map(|row| row.values[column]);
        let (total, slack) = printed.fold((0.0, 0.0), |(t, s), (v, half)| (t + v, s + half));
        assert!(total.abs() <= slack + 1e-9, "{caption}: {head}: column {column} sums to {total}");
        let (stated, half) = sum.values[column].expect("a sum");
        assert!(stated == 0.0 && half == 0.0, "{caption}: the printed sum is {stated}");
    }
    let (force, moment) = (factor(head, 2), factor(head, 4));
    for row in forces {
        // The moment in a row with a torque is not that of the force alone.
        if row.name.contains("torque") {
            continue;
        }
        let [Some(x), Some(y), Some(right), Some(up), Some(stated)] = row.values[..] else {
            continue;
        };
        let (dx, dy) = (x.0, y.0);
        let (fx, fy) = (force * right.0, force * up.0);
        let expected = dx * fy - dy * fx;
        // The rounding error of each printed number is at most half a unit of its last digit.
        let slack = 2.0 * x.1 * fy.abs()
            + 2.0 * y.1 * fx.abs()
            + force * (dx.abs() * up.1 + dy.abs() * right.1)
            + moment * stated.1;
        let off = (expected - moment * stated.0).abs();
        assert!(off <= 1.01 * slack + 1e-9, "{caption}: {}: {expected} is printed as {}", row.name, stated.0);
    }
}

#[test]
fn the_printed_forces_balance_and_their_moments_follow_from_them() {
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes");
    let named = [
        "arch13",
        "arch13thin",
        "archload",
        "buttress",
        "doorway",
        "leaning",
        "loaded",
        "robots10",
        "slide",
        "tinyhuge",
        "masonry/arch-on-piers",
        "masonry/arch-spreads",
        "masonry/corbels",
        "masonry/cranes",
        "masonry/flat-arch",
    ];
    let mut files = vec![
        ("in/a.json".to_owned(), STANDS.to_owned()),
        ("in/b.json".to_owned(), FALLS.to_owned()),
        ("in/c.json".to_owned(), include_str!("../intervals/archmech.json").to_owned()),
        ("in/d.json".to_owned(), include_str!("../intervals/plank.json").to_owned()),
    ];
    files.extend(named.map(|name| {
        let text = std::fs::read_to_string(format!("{scenes}/{name}.json"));
        (format!("in/{name}.json"), text.expect("readable"))
    }));
    let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    let folder = Folder::new(&files);
    folder.done("report in -o r.md");
    let balances = balances(&folder.text("r.md"));
    assert!(
        balances.len() == files.len(),
        "expected a table for nearly all of {} scenes, found {}",
        files.len(),
        balances.len()
    );
    balances.iter().for_each(assert_balances);
}
