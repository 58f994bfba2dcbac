//! Numbers that appear twice on a page are equal to the digit: in sentences, in tables and in figures.

use std::collections::BTreeSet;

use serde_json::Value;

use super::{FALLS, Folder, STANDS};

/// Returns the texts of a part of a page: what stands between its tags.
fn texts(page: &str) -> Vec<&str> {
    let parts = page.split('<').filter_map(|part| part.split_once('>'));
    parts.map(|(_, text)| text.trim()).filter(|text| !text.is_empty()).collect()
}

/// Returns the significant digits of a printed number, and its size: `0.505` gives `505`.
fn digits(number: &str) -> Option<(String, f64)> {
    let number = number.trim_start_matches(['−', '-']);
    let size: f64 = number.parse().ok()?;
    let digits: String = number.chars().filter(char::is_ascii_digit).collect();
    Some((digits.trim_matches('0').to_owned(), size))
}

/// Returns the three digits of every number of a result, of the lengths of its vectors, and of the sums of its pairs.
fn rounded(result: &Value) -> BTreeSet<String> {
    let digits = |x: f64| {
        let written = format!("{:.2e}", x.abs() * (1.0 + 1e-7));
        let mantissa = written.split('e').next().unwrap_or_default().replace('.', "");
        mantissa.trim_end_matches('0').to_owned()
    };
    let mut found = BTreeSet::new();
    match result {
        Value::Number(number) => found.extend(number.as_f64().map(digits)),
        Value::Array(all) => {
            if let [Some(x), Some(y)] = all.iter().map(Value::as_f64).collect::<Vec<_>>()[..] {
                found.extend([digits(libm::hypot(x, y)), digits(x + y)]);
            }
            found.extend(all.iter().flat_map(rounded));
        }
        Value::Object(keys) => found.extend(keys.values().flat_map(rounded)),
        _ => {}
    }
    found
}

/// Returns the forces in words, `505 N`, with their digits and their size in newtons.
fn forces(texts: &[&str]) -> BTreeSet<(String, u64)> {
    let mut found = BTreeSet::new();
    for text in texts {
        let words: Vec<&str> = text.split([' ', '\u{a0}', ',', ';', '(', ')']).collect();
        for pair in words.windows(2) {
            let factor = match pair[1].trim_end_matches('.') {
                "N" => 1.0,
                "kN" => 1e3,
                "MN" => 1e6,
                _ => continue,
            };
            if let Some((digits, size)) = digits(pair[0]) {
                found.insert((digits, (size * factor * 1e6) as u64));
            }
        }
    }
    found
}

/// Returns the forces in the columns of tables whose heads end with a unit of force.
fn columns(page: &str) -> BTreeSet<(String, u64)> {
    let mut found = BTreeSet::new();
    for table in page.split("<table").skip(1) {
        let table = table.split("</table>").next().unwrap_or_default();
        let (head, body) = table.split_once("<tbody>").expect("a body");
        let factors: Vec<Option<f64>> = head
            .split("<th")
            .skip(2)
            .map(|cell| match texts(cell).first()?.rsplit_once(", ")?.1 {
                "N" => Some(1.0),
                "kN" => Some(1e3),
                "MN" => Some(1e6),
                _ => None,
            })
            .collect();
        for row in body.split("<tr").skip(1) {
            for (cell, factor) in row.split("<td").skip(1).zip(&factors) {
                let text = texts(cell).first().copied().and_then(digits);
                if let (Some((digits, size)), Some(factor)) = (text, factor) {
                    found.insert((digits, (size * factor * 1e6) as u64));
                }
            }
        }
    }
    found
}

#[test]
fn numbers_that_appear_twice_on_a_page_have_the_same_digits() {
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/scenes");
    let mut files = vec![("a.json".to_owned(), STANDS.to_owned()), ("b.json".to_owned(), FALLS.to_owned())];
    for name in ["arch13", "archload", "buttress", "loaded", "robots10", "slide", "masonry/arch-spreads"] {
        let text = std::fs::read_to_string(format!("{scenes}/{name}.json")).expect("readable");
        files.push((format!("{}.json", name.replace('/', "-")), text));
    }
    let given: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    let folder = Folder::new(&given);
    let (mut equal, mut margins) = (0, 0);
    for (name, _) in &files {
        folder.done(&format!("report {name} -o r.html --theme plain"));
        let page = folder.text("r.html");
        let page = page.split("<textarea").next().expect("a page");
        // The texts of figures, and all others.
        let (mut drawn, mut written) = (String::new(), String::new());
        for part in page.split("<svg") {
            match part.split_once("</svg>") {
                Some((figure, rest)) => {
                    drawn.push_str(figure);
                    written.push_str(rest);
                }
                None => written.push_str(part),
            }
        }
        folder.done(&format!("report {name} -o r.json"));
        let truth = rounded(&serde_json::from_str(&folder.text("r.json")).expect("JSON"));
        let mut stated = forces(&texts(&written));
        stated.extend(columns(&written));
        for (digits, size) in forces(&texts(&drawn)) {
            // Two roundings of one number differ by at most one unit of the third digit.
            let unit = libm::exp10(libm::floor(libm::log10(size as f64)) - 2.0);
            let near = stated.iter().filter(|(_, other)| other.abs_diff(size) as f64 <= 1.01 * unit);
            let near: Vec<&(String, u64)> = near.collect();
            let is_equal = near.iter().any(|(other, _)| *other == digits);
            // Different numbers may be close to each other: then each of them is that of a result.
            let are_true = || near.iter().map(|one| &one.0).chain([&digits]).all(|digits| truth.contains(digits));
            assert!(
                near.is_empty() || is_equal || are_true(),
                "{name}: a figure has {digits} ({} N), the page {near:?}",
                size as f64 * 1e-6
            );
            equal += usize::from(!near.is_empty());
        }
        // The headline margin is a number of the table of margins.
        let headline = written.split("class=\"headline\"").nth(1).and_then(|rest| rest.split("</p>").next());
        for part in headline.into_iter().flat_map(|words| words.split(" · ")) {
            let number = part.split([' ', '°', '>']).find_map(digits);
            let is_margin = ["× its load", "of tilt", "friction"].iter().any(|sign| part.contains(sign));
            if let (Some((digits, _)), true) = (number, is_margin) {
                let table = written.split("<table").find(|table| table.contains(">present value<")).expect("margins");
                let all = texts(table);
                let numbers = all.iter().filter_map(|text| self::digits(text.split(['°', ' ']).next()?));
                assert!(numbers.into_iter().any(|(other, _)| other == digits), "{name}: {part}: {all:?}");
                margins += 1;
            }
        }
        for text in texts(&written) {
            let is_exponent = |word: &str| word.contains("e-") && word.parse::<f64>().is_ok_and(|x| x.abs() > 1e-3);
            assert!(!text.split(' ').any(is_exponent), "{name}: {text}");
        }
    }
    assert!(equal > 8 && margins > 4, "{equal} {margins}");
}
