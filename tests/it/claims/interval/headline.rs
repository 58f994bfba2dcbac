//! The headline of a report, and the sentences that state values at which a structure would fall or stand.

use serde_json::Value;

use super::super::{list, number};
use super::{Parameter, finite, parameters, scenes};

/// Words of a headline, and the pointer of the parameter that they refer to.
const HEADLINE_SIGNS: [(&str, &str); 4] = [
    ("gravity turns", "/tilt"),
    ("pushes it", "/horizontal_load"),
    ("friction", "/friction"),
    ("safety kernel", "/kernel"),
];

/// Asserts that the headline of a frame with loads states an end of the interval of its load factor, with three
/// digits.
fn assert_load_headline(headline: &str, verdict: &str, interval: &Value) {
    let [low, high] = [0, 1].map(|k| interval.get(k).and_then(Value::as_f64));
    let named = |start: &str| -> f64 {
        let rest = headline.strip_prefix(start).unwrap_or_default();
        let number = rest.split(' ').next().unwrap_or_default();
        number.parse().unwrap_or(f64::NAN)
    };
    let is_near = |found: f64, value: f64| (found - value).abs() <= 1e-2 * value.abs();
    // A load that is carried is rounded down, a load that is needed is rounded up.
    let is_below = |found: f64, value: f64| is_near(found, value) && found <= value * (1.0 + 1e-6);
    let is_above = |found: f64, value: f64| is_near(found, value) && found >= value * (1.0 - 1e-6);
    let holds = match (verdict, low, high) {
        ("stable", _, Some(high)) => is_below(named("It carries "), high),
        ("stable", Some(low), None) if low > 0.0 => {
            headline.ends_with("and any larger multiple.") && is_above(named("It carries "), low)
        }
        ("stable", _, None) => headline.starts_with("It carries any multiple of its load"),
        ("unstable", Some(low), _) if low > 1.0 => is_above(named("It falls: it needs "), low),
        ("unstable", _, Some(high)) => is_below(named("It falls: it carries "), high),
        ("unstable", ..) => headline.starts_with("It falls"),
        _ => headline.starts_with("It is undecided"),
    };
    assert!(holds, "{headline}: {verdict}, {interval}");
}

/// The headline states the load factor if this has a limit. Otherwise it states the parameter that is nearest to the
/// end of its interval.
#[test]
fn the_headline_is_the_margin_nearest_to_its_end() {
    for stated in scenes() {
        let start = "<p class=\"headline\"><strong><bdi dir=\"ltr\">";
        let from = stated.page.find(start).expect("a headline") + start.len();
        let headline = &stated.page[from..from + stated.page[from..].find('<').expect("closed")];
        let intervals = &stated.frame["margins"]["intervals"];
        let load_factor = intervals.get("load_factor");
        let verdict = stated.frame["verdict"].as_str().expect("a word");
        let is_free =
            |interval: &Value| verdict == "stable" && interval[0].as_f64() == Some(0.0) && interval[1].is_null();
        if load_factor.is_some_and(is_free) {
            let words = "and carries any multiple of its load";
            assert!(headline.contains(words), "{headline}");
        } else if let Some(interval) = load_factor {
            assert_load_headline(headline, verdict, interval);
            continue;
        }
        if stated.frame["verdict"] != "stable" {
            continue;
        }
        let reserve = |parameter: &Parameter| -> Option<f64> {
            let interval = stated.frame["margins"]["intervals"].pointer(&parameter.pointer)?;
            let [low, high] = finite(parameter, interval);
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
        let reserves = all.iter().filter_map(|p| Some((p, reserve(p)?)));
        let (nearest, least) = reserves.min_by(|a, b| a.1.total_cmp(&b.1)).expect("some");
        let sign = HEADLINE_SIGNS.iter().find(|(words, _)| headline.contains(words));
        let pointer = sign.map_or("", |(_, pointer)| *pointer);
        let is_named = |p: &&Parameter| p.pointer == pointer || headline.starts_with(&p.name);
        let named = all.iter().find(is_named).expect("named");
        let own = reserve(named).expect("an interval");
        assert!(own <= least + 1e-9, "{headline}, not {}", nearest.name);
    }
}

/// A load factor at which a report says that a structure would fall or stand lies on the correct side of the end.
#[test]
fn factors_at_which_it_would_fall_or_stand_lie_on_the_right_side() {
    for (stated, sentence) in scenes().iter().zip([
        "The structure would fall at 3.82 times its loads.",
        "The structure would stand at 1.34 times its loads.",
        "The structure would fall below 0.301 times its loads.",
        "The structure would stand at 0.327 times its loads.",
        "The structure stands at every factor on its loads.",
        "The structure falls at every factor on its loads.",
    ]) {
        let has = stated.page.contains(sentence);
        let is_loaded = !list(&stated.file["loads"]).is_empty();
        assert_eq!(has, is_loaded, "{sentence}: {}", stated.frame["margins"]["intervals"]);
    }
    // The plank falls below its least load factor, and the drawing shows this.
    let plank = &scenes()[2];
    assert!(plank.page.contains("Below 0.302 times its loads, 1 block moves"));
}

/// The number after `start` in a page.
fn number_after(page: &str, start: &str) -> Option<f64> {
    let (_, rest) = page.split_once(start)?;
    let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
    rest[..end].parse().ok()
}

/// The friction coefficient below which the structure would fall is at most the lower end. The tilt at which it would
/// fall is at least the end of that side.
#[test]
fn frictions_and_tilts_at_which_it_would_fall_lie_beyond_the_end() {
    let (mut frictions, mut tilts) = (0, 0);
    for stated in scenes() {
        let intervals = &stated.frame["margins"]["intervals"];
        let start = "The structure would fall with a friction coefficient below ";
        if let Some(found) = number_after(&stated.page, start) {
            let low = number(&intervals["friction"][0]);
            let is_below = found <= low * (1.0 + 1e-6) && found >= 0.99 * low;
            assert!(is_below, "{found}: {low}");
            frictions += 1;
        }
        let Some((_, turned)) = stated.page.split_once("The structure would fall if gravity turned by ") else {
            continue;
        };
        let turned = &turned[..turned.find(". ").unwrap_or(turned.len())];
        let mut sides = turned.split(" or ").take(2);
        for (side, end) in [("left", -1.0), ("right", 1.0)] {
            let end = end * intervals["tilt"][usize::from(end > 0.0)].as_f64().unwrap_or(f64::NAN);
            if end.is_nan() {
                continue;
            }
            let words = sides.next().expect("a side");
            let found = number_after(words, "").expect("an angle");
            assert!(words.contains(side), "{words}");
            let is_beyond = found >= end * (1.0 - 1e-6) && found <= 1.01 * end;
            assert!(is_beyond, "{found}: {end}");
            tilts += 1;
        }
    }
    assert!(frictions > 0 && tilts > 3, "{frictions} {tilts}");
}
