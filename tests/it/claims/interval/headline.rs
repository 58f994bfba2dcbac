//! The headline margins of a report, which are also the words below a figure.

use serde_json::Value;

use super::super::list;
use super::{Parameter, finite, parameters, scenes};

/// The words before and after the number of a headline margin, the pointer of its parameter, and whether the number is
/// rounded down.
const MARGINS: [(&str, &str, &str, bool); 9] = [
    ("needs ", " × its load", "/load_factor", false),
    ("carries ", " × its load", "/load_factor", true),
    ("carries ", "\u{a0}% of its load", "/load_factor", true),
    ("would need ", " times its load", "/load_factor", false),
    ("falls at ", "° of tilt", "/tilt", true),
    ("falls at ", " × its weight", "/horizontal_load", true),
    ("needs friction ", " of ", "/friction", false),
    ("would need friction ", "", "/friction", false),
    ("stands up to a kernel of ", "", "/kernel", true),
];

/// The number of a headline margin, the pointer of its parameter, and whether it is rounded down.
fn parsed(words: &str) -> (f64, &'static str, bool) {
    let fits = |(start, end, pointer, is_down): &(&str, &str, &'static str, bool)| {
        let rest = words.strip_prefix(start)?;
        let length = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let value: f64 = rest[..length].parse().ok()?;
        let value = if end.contains('%') { value / 100.0 } else { value };
        rest[length..].starts_with(end).then_some((value, *pointer, *is_down))
    };
    MARGINS.iter().find_map(fits).unwrap_or_else(|| panic!("{words}"))
}

/// Each headline margin is an end of its interval, rounded to the safe side. The first one is the load factor if this has
/// a limit, otherwise the parameter that is nearest to the end of its interval.
#[test]
fn headline_margins_are_ends_on_the_safe_side_and_the_first_is_the_nearest() {
    let mut seen = 0;
    for stated in scenes() {
        let start = "<p class=\"headline\"><strong><bdi dir=\"ltr\">";
        let Some((_, headline)) = stated.page.split_once(start) else { continue };
        let headline = &headline[..headline.find('<').expect("closed")];
        let intervals = &stated.frame["margins"]["intervals"];
        let stands = stated.frame["verdict"] == "stable";
        if headline == "no friction coefficient would hold it" {
            assert!(intervals["friction"].is_null());
            continue;
        }
        for part in headline.split(" · ") {
            let (value, pointer, is_down) = parsed(part);
            let ends = list(intervals.pointer(pointer).expect("an interval")).iter().filter_map(Value::as_f64);
            let ends: Vec<f64> = ends.map(f64::abs).collect();
            let is_safe = |end: &f64| {
                let near = (value - end).abs() <= 1e-2 * end;
                near && if is_down { value <= end * (1.0 + 1e-6) } else { value >= end * (1.0 - 1e-6) }
            };
            assert!(ends.iter().any(is_safe), "{part}: {ends:?}");
            seen += 1;
        }
        let (_, pointer, _) = parsed(headline.split(" · ").next().expect("one"));
        let is_limited = |ends: &&Value| ends[0].as_f64() != Some(0.0) || !ends[1].is_null();
        let load_factor = intervals.get("load_factor").filter(is_limited);
        if !stands || load_factor.is_some() {
            assert!(!stands || pointer == "/load_factor", "{headline}");
            continue;
        }
        let reserve = |parameter: &Parameter| -> Option<f64> {
            let [low, high] = finite(parameter, intervals.pointer(&parameter.pointer)?);
            let now = parameter.present;
            let all = match parameter.pointer.as_str() {
                "/tilt" => 90.0,
                "/kernel" => 1.0 - now,
                _ => 1.0,
            };
            let below = low.map_or(1.0, |low| if parameter.is_signed { -low / all } else { 1.0 - low / now });
            let above = high.map_or(1.0, |high| (high - now) / all);
            Some(below.min(above))
        };
        let all = parameters(&stated.file);
        let least = all.iter().filter_map(reserve).fold(f64::INFINITY, f64::min);
        let own = all.iter().find(|p| p.pointer == pointer).and_then(reserve).expect("an interval");
        assert!(own <= least + 1e-9 || all.iter().any(|p| p.pointer.starts_with("/robots")), "{headline}: {least}");
    }
    assert!(seen > 6, "{seen}");
}
