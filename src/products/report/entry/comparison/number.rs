//! Makes the tables that compare two frames in numbers: weight, sums of forces, largest force at an interface, and
//! margins.

use super::Side;
use crate::mechanics::analysis::FrameAnalysis;
use crate::mechanics::scene::format::UnitsEntry;
use crate::products::report::entry::{Grid, bullet};
use crate::products::wording::number::{digits, tenths};

/// Writes the change of a number relative to `before`, in percent, with its sign. The text is `none` if there is no
/// change except for rounding, and `from nothing` if `before` is 0 and `after` is not.
pub(super) fn change(before: f64, after: f64) -> String {
    if (after - before).abs() <= 1e-9 * before.abs() {
        return "none".to_owned();
    }
    if before == 0.0 {
        return "from nothing".to_owned();
    }
    let sign = if after < before { "−" } else { "+" };
    match (after / before - 1.0).abs() {
        little if little < 0.0005 => format!("{sign}under 0.1 %"),
        share => format!("{sign}{}", tenths(share)),
    }
}

/// Makes a table that compares two frames by weight, total force, total sticking and largest force at an interface, in
/// the given units.
pub(super) fn totals(then: &FrameAnalysis, now: &FrameAnalysis, units: UnitsEntry) -> Grid {
    let unit = units.force();
    let mut grid = Grid::new("In numbers", &["what", "#first", "#second", "#change"]);
    let largest = |f: &FrameAnalysis| {
        let forces = f.contacts.iter().map(|c| c.resultant.force.norm());
        forces.fold(0.0, f64::max)
    };
    for (what, a, b) in [
        ("weight of all blocks", then.weight, now.weight),
        ("total force", then.total_force, now.total_force),
        ("total sticking", then.total_sticking, now.total_sticking),
        ("largest force at an interface", largest(then), largest(now)),
    ] {
        let [first, second] = [a, b].map(|force| digits(unit.value_from_si(force)));
        let what = format!("{what}, {}", unit.symbol());
        grid.add("", [what, first, second, change(a, b)]);
    }
    grid
}

/// Makes a table that compares the margins of two frames, with one row for each margin. `number` is the index of both
/// frames.
pub(super) fn margins(sides: [Side<'_>; 2], number: usize) -> Grid {
    let mut grid = Grid::new("Margins", &["margin", "first", "second"]);
    let [first, second] = sides.map(|side| bullet::margin_bars(&side.analysis.scene, &side.analysis.frames[number]));
    for bullet in &first {
        let same = second.iter().find(|b| b.name == bullet.name);
        let after = same.map_or("–".to_owned(), |b| b.words.clone());
        grid.add("", [bullet.name.clone(), bullet.words.clone(), after]);
    }
    for bullet in second.iter().filter(|b| first.iter().all(|a| a.name != b.name)) {
        grid.add("", [bullet.name.clone(), "–".to_owned(), bullet.words.clone()]);
    }
    grid
}
