//! The validation manual: published values compared with those of this crate. With `UPDATE_SNAPSHOTS=1`, these tests
//! write the tables and pictures of `src/doc/validation.md`. Otherwise they fail if the page differs from the
//! computed values.

pub mod arches;
pub mod blocks;
mod cases;
mod measure;
mod panels;
mod pictures;
mod sources;
mod stacks;
mod walls;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use cases::{CASES, Case, Unit};
use sources::SOURCES;

const PAGE: &str = "src/doc/validation.md";

/// Sources that use friction without dilatancy. Compared with them, the values of this crate are not on the safe
/// side.
const UNSAFE: [&str; 3] = ["Ferris01", "Goodman76", "RS2"];

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn update() -> bool {
    std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none()
}

/// With `UPDATE_SNAPSHOTS`, writes a file. Otherwise panics if the file differs from `made`.
fn keep(name: &str, made: &str) {
    if update() {
        std::fs::write(path(name), made).expect("writable");
    }
    let kept = std::fs::read_to_string(path(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert!(kept == made, "{name}: run once with UPDATE_SNAPSHOTS=1");
}

/// Replaces the text between two marks of the page.
fn put(page: &mut String, mark: &str, text: &str) {
    let (begin, end) = (format!("<!-- {mark} -->\n"), format!("<!-- end of {mark} -->"));
    let from = page.find(&begin).expect("the mark is there") + begin.len();
    let to = page.find(&end).expect("the end is there");
    page.replace_range(from..to, &format!("\n{text}\n"));
}

/// The values of this crate. Each function is called only once. Two threads share the work.
fn computed() -> Vec<f64> {
    let mut found: BTreeMap<usize, f64> = BTreeMap::new();
    let mut first: BTreeMap<usize, usize> = BTreeMap::new();
    for (k, case) in CASES.iter().enumerate() {
        first.entry(case.ours as usize).or_insert(k);
    }
    let once: Vec<usize> = first.values().copied().collect();
    let half = |rest: usize| -> Vec<(usize, f64)> {
        let mine = once.iter().skip(rest).step_by(2);
        mine.map(|k| (*k, (CASES[*k].ours)())).collect()
    };
    std::thread::scope(|scope| {
        let other = scope.spawn(|| half(1));
        found.extend(half(0));
        found.extend(other.join().expect("values"));
    });
    let value = |case: &Case| found[&first[&(case.ours as usize)]];
    CASES.iter().map(value).collect()
}

/// The number of decimals of a published number.
fn decimals(published: &str) -> usize {
    published.split_once('.').map_or(0, |(_, decimals)| decimals.len())
}

/// The value of this crate with as many decimals as the published value, or with one more if that value has fewer
/// than five digits, and with at least four digits.
fn ours(case: &Case, value: f64) -> String {
    if case.unit == Unit::Answer {
        return if value == 1.0 { "yes" } else { "no" }.to_owned();
    }
    let whole = format!("{:.0}", value.abs().floor()).trim_start_matches('0').len();
    let published = decimals(case.published);
    let more = usize::from(published + whole < 5);
    let digits = (published + more).max(4usize.saturating_sub(whole));
    with_unit(case.unit, &format!("{value:.digits$}"))
}

fn with_unit(unit: Unit, number: &str) -> String {
    match unit {
        Unit::Ratio | Unit::Answer => number.to_owned(),
        Unit::Degrees => format!("{number}°"),
        Unit::Newtons => format!("{number} N"),
    }
}

fn percent(case: &Case, value: f64) -> f64 {
    let published: f64 = match case.unit {
        Unit::Answer => 1.0,
        _ => case.published.parse().expect("a number"),
    };
    100.0 * (value / published - 1.0)
}

/// A difference in percent with two digits. A difference below 0.001 % is given as "< 0.001".
fn difference(percent: f64) -> String {
    let size = percent.abs();
    if size < 0.001 {
        return "< 0.001".into();
    }
    let digits = match size {
        ..0.01 => 4,
        ..0.1 => 3,
        ..1.0 => 2,
        ..10.0 => 1,
        _ => 0,
    };
    let sign = if percent < 0.0 { "−" } else { "+" };
    format!("{sign}{size:.digits$}")
}

fn table(values: &[f64]) -> String {
    let mut rows =
        String::from("| group | case | drystone | published | difference, % | source |\n|---|---|---|---|---|---|\n");
    let mut group = "";
    for (case, value) in CASES.iter().zip(values) {
        let same = std::mem::replace(&mut group, case.group) == case.group;
        rows += &format!(
            "| {} | {} | {} | {}{} | {} | {} |\n",
            if same { "" } else { case.group },
            case.what,
            ours(case, *value),
            with_unit(case.unit, case.published),
            if case.seen { "" } else { " †" },
            match case.unit {
                Unit::Answer => "–".to_owned(),
                _ if UNSAFE.contains(&case.source) => format!("**{}**", difference(percent(case, *value))),
                _ => difference(percent(case, *value)),
            },
            case.source,
        );
    }
    rows
}

/// The sentence with the number of values that agree within 0.01 %, 0.1 % and 1 %.
fn summary(values: &[f64]) -> String {
    let found: Vec<f64> = (CASES.iter().zip(values)).map(|(case, value)| percent(case, *value).abs()).collect();
    let within = |most: f64| found.iter().filter(|p| **p <= most).count();
    let sources: BTreeSet<&str> = CASES.iter().map(|case| case.source).collect();
    let seen = CASES.iter().filter(|case| case.seen).count();
    format!(
        "The page compares {} values from {} sources. {} values agree within 0.01 %, {} within 0.1 %, and {} within 1 %. {} of the\npublished values were found in a publication that we read, or in a program; the others have a † and were not checked.\n",
        CASES.len(),
        sources.len(),
        within(0.01),
        within(0.1),
        within(1.0),
        seen,
    )
}

fn references() -> String {
    let mut rows = String::new();
    for (key, reference, seen) in SOURCES {
        rows += &format!("- **{key}** {reference}. ({seen})\n");
    }
    rows
}

#[test]
fn the_page_has_the_values_that_are_computed() {
    let values = computed();
    for (case, value) in CASES.iter().zip(&values) {
        let percent = percent(case, *value);
        assert!(
            percent.abs() <= case.within,
            "{}, {}: {value} is {percent:.5} % from {}",
            case.what,
            case.source,
            case.published
        );
    }
    let mut page = std::fs::read_to_string(path(PAGE)).expect("the page is there");
    put(&mut page, "overview", &table(&values));
    put(&mut page, "summary", &summary(&values));
    put(&mut page, "sources", &references());
    put(&mut page, "pictures", &pictures::links());
    keep(PAGE, &page);
}

#[test]
fn every_value_has_its_source_and_every_source_a_value() {
    let used: BTreeSet<&str> = CASES.iter().map(|case| case.source).collect();
    let listed: BTreeSet<&str> = SOURCES.iter().map(|source| source.0).collect();
    assert_eq!(used, listed);
    for (key, _, seen) in SOURCES {
        let any = CASES.iter().any(|case| case.source == *key && case.seen);
        assert_eq!(any, !seen.contains("not checked"), "{key}: {seen}");
    }
    let page = std::fs::read_to_string(path(PAGE)).expect("the page is there");
    for (name, ..) in pictures::PICTURES {
        assert!(page.contains(&format!("][{name}]")), "{name} is not on the page");
    }
}

/// Checks the number in the text of the page that is not in its table.
#[test]
fn the_text_states_the_computed_value() {
    let page = std::fs::read_to_string(path(PAGE)).expect("the page is there");
    let words = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let more = measure::horizontal(&arches::oppenheim(21));
    assert!(words.contains(&format!("with 21 voussoirs our value is {more:.3}")));
}

/// Checks each picture and its scene in `assets/validation`.
#[test]
fn the_pictures_show_their_scenes() {
    let mut inline = String::new();
    for (name, kind, file) in pictures::PICTURES {
        let file = file();
        let svg = pictures::drawn(name, *kind, &file);
        keep(&format!("assets/validation/{name}.json"), &format!("{file}\n"));
        keep(&format!("assets/validation/{name}.svg"), &svg);
        inline += &pictures::inline(name, &svg);
    }
    keep("assets/validation/inline.md", &inline);
    let files = std::fs::read_dir(path("assets/validation")).expect("there");
    assert_eq!(files.count(), 2 * pictures::PICTURES.len() + 1);
}
