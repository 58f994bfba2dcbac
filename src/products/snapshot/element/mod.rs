//! [`changes`]: describes the differences between two SVG drawings.
//!
//! 1. `tree` reads both files into trees of elements.
//! 2. `pairing` pairs the elements of both trees.
//! 3. `shape` and the functions below describe what changed in each pair: position, rotation, outline, colour, text.
//!
//! The comparison works for SVG of any program. However, if another program writes a shape with other elements, the
//! shape is reported as changed. Attributes that depend on the whole drawing (`id`, `aria-labelledby`) are ignored.
//! Positions are compared with a tolerance of 0.025 pixels, because drystone rounds them to 0.01.

mod pairing;
mod shape;
mod tree;

use shape::Movement;
use tree::Element;
pub use tree::SvgParseError;

/// Tolerance for positions, in pixels. A tiny change of a coordinate changes its rounded value by at most 0.01. It
/// changes the sum of two rounded values by at most 0.02.
const POSITION_TOL: f64 = 0.025;
/// A change that at least this many elements share is reported once.
const MIN_GROUPED: usize = 4;

/// A change of one element.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Event {
    /// The name of the element in messages.
    element: String,
    /// A description of the change.
    change: String,
}

/// Describes the differences between two drawings, given as SVG text. The list is empty if there are no differences.
///
/// # Errors
/// [`SvgParseError`] if one of the texts is not SVG. If both are not, the error describes `expected`.
///
/// # Example
/// ```
/// use drystone::snapshot::element::changes;
/// let page = |colour: &str| format!(r##"<svg xmlns="http://www.w3.org/2000/svg"><g class="block"><title>Block a</title>
///     <path d="M0 0h9v5z" fill="{colour}"/></g></svg>"##);
/// let found = changes(&page("#ff0000"), &page("#0000ff"))?;
/// assert_eq!(found, ["path in block \"Block a\": fill #ff0000 → #0000ff"]);
/// # Ok::<(), drystone::snapshot::element::SvgParseError>(())
/// ```
pub fn changes(expected: &str, found: &str) -> Result<Vec<String>, SvgParseError> {
    if expected == found {
        return Ok(Vec::new());
    }
    let (old, new) = (tree::read(expected)?, tree::read(found)?);
    let mut events = Vec::new();
    compare(&old, &new, "the page", &mut events);
    Ok(described(events))
}

/// Describes the changes in words. A change that at least [`MIN_GROUPED`] elements share is reported once.
fn described(events: Vec<Event>) -> Vec<String> {
    let mut described: Vec<String> = Vec::new();
    let mut done: Vec<&str> = Vec::new();
    for event in &events {
        if done.contains(&event.change.as_str()) {
            continue;
        }
        let alike: Vec<&Event> = events.iter().filter(|e| e.change == event.change).collect();
        if alike.len() < MIN_GROUPED {
            described.push(format!("{}: {}", event.element, event.change));
            continue;
        }
        done.push(&event.change);
        described.push(format!("{} elements, such as {}: {}", alike.len(), event.element, event.change));
    }
    described
}

/// Compares a pair of elements and their children, and adds the changes to `events`. `within` describes the parent
/// element, for messages.
fn compare(old: &Element, new: &Element, within: &str, events: &mut Vec<Event>) {
    let element = new.called(within);
    let mut report = |change: String| {
        events.push(Event { element: element.clone(), change });
    };
    for (what, a, b) in [
        ("title", &old.title, &new.title),
        ("description", &old.description, &new.description),
        ("words", &old.words, &new.words),
    ] {
        if !same_words(a, b) {
            report(match (a.is_empty(), b.is_empty()) {
                (true, _) => format!("{what} is new: {b:?}"),
                (_, true) => format!("{what} is gone: {a:?}"),
                _ => format!("{what} {a:?} → {b:?}"),
            });
        }
    }
    if old.tag == "svg" && old.tag == new.tag && old.size() != new.size() {
        report(format!("size {} → {}", old.size(), new.size()));
    }
    match shape::movement(old, new) {
        Movement::None => {}
        movement => report(movement.words()),
    }
    for (name, a) in &old.attributes {
        match new.attribute(name) {
            Some(b) if same_value(a, b) => {}
            Some(b) => report(format!("{name} {a} → {b}")),
            None => report(format!("{name} {a} is gone")),
        }
    }
    for (name, b) in &new.attributes {
        if old.attribute(name).is_none() {
            report(format!("{name} {b} is new"));
        }
    }
    let inside = new.place(within);
    for pair in pairing::pairs(&old.children, &new.children) {
        match pair {
            (Some(old), Some(new)) => compare(old, new, &inside, events),
            (Some(old), None) => events.push(Event { element: old.called(&inside), change: "vanished".into() }),
            (None, Some(new)) => events.push(Event { element: new.called(&inside), change: "appeared".into() }),
            (None, None) => {}
        }
    }
}

/// True if two attribute values are equal apart from rounding. Colour channels may differ by 1, and other numbers by
/// [`POSITION_TOL`].
fn same_value(a: &str, b: &str) -> bool {
    if a == b {
        return true;
    }
    if let (Some(a), Some(b)) = (colour(a), colour(b)) {
        return a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1);
    }
    let (a, b) = (pieces(a), pieces(b));
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(x), Ok(y)) => (x - y).abs() <= POSITION_TOL,
            _ => a == b,
        })
}

/// True if two texts are equal, apart from one unit in the last digit of rounded numbers. A number counts as rounded
/// if it has a decimal point, or if ° or % follows it. The facts layer compares the same numbers more precisely.
fn same_words(a: &str, b: &str) -> bool {
    if a == b {
        return true;
    }
    let (a, b) = (pieces(a), pieces(b));
    a.len() == b.len()
        && (0..a.len()).all(|i| {
            let next = a.get(i + 1).and_then(|p| p.trim_start().chars().next());
            let rounded = a[i].contains('.') && b[i].contains('.') || matches!(next, Some('°' | '%'));
            match (a[i].parse::<f64>(), b[i].parse::<f64>()) {
                (Ok(x), Ok(y)) if rounded => (x - y).abs() <= 1.5 * unit(a[i]).max(unit(b[i])),
                _ => a[i] == b[i],
            }
        })
}

/// Returns the place value of the last digit of a number: 0.01 for `1.23`.
fn unit(number: &str) -> f64 {
    let decimals = number.split_once('.').map_or(0, |(_, d)| d.len());
    format!("1e-{decimals}").parse().unwrap_or(1.0)
}

/// Reads a colour of the form `#ff0000` as red, green and blue; `None` for any other text.
fn colour(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').filter(|d| d.len() == 6)?;
    let value = u32::from_str_radix(digits, 16).ok()?;
    let [_, r, g, b] = value.to_be_bytes();
    Some([r, g, b])
}

/// Splits a text into numbers and the text between them, without the full stops at the end of each piece.
fn pieces(text: &str) -> Vec<&str> {
    let mut pieces = Vec::new();
    let mut begin = 0;
    let mut in_number = false;
    for (at, c) in text.char_indices() {
        let number = c.is_ascii_digit() || (in_number && c == '.');
        if number != in_number {
            pieces.push(&text[begin..at]);
            (begin, in_number) = (at, number);
        }
    }
    pieces.push(&text[begin..]);
    // Remove full stops at the end of each piece: after a number, a full stop ends the sentence and is not a decimal
    // point.
    pieces.iter_mut().for_each(|p| {
        if p.len() > 1 {
            *p = p.trim_end_matches('.');
        }
    });
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_not_a_change_but_a_different_count_is() {
        assert!(same_words("6.91 N at 65°", "6.92 N at 66°"));
        assert!(!same_words("6.91 N", "6.93 N"));
        assert!(!same_words("3 hinges", "4 hinges") && !same_words("Block 3", "Block 4"));
        assert!(same_value("192.8953857421875 206.76", "192.8953857421900 206.77"));
        assert!(!same_value("1.5", "1.6") && !same_value("none", "#000000"));
        assert!(same_value("#102030", "#112030") && !same_value("#102030", "#122030"));
    }

    fn page(inside: &str) -> String {
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"90\" height=\"50\">{inside}</svg>")
    }

    #[test]
    fn one_missing_element_among_equal_ones_is_reported_alone() {
        let paths = |lost: usize| {
            let path = |x: usize| format!("<path d=\"M{} 5l3 4h2z\" fill=\"#000000\"/>", 7 * x);
            let all = (0..30).filter(|x| *x != lost).map(path);
            page(&all.collect::<String>())
        };
        assert_eq!(changes(&paths(99), &paths(11)), Ok(vec!["path in the page: vanished".into()]));
        assert_eq!(changes(&paths(11), &paths(99)), Ok(vec!["path in the page: appeared".into()]));
    }

    #[test]
    fn a_change_of_many_elements_is_reported_once() {
        let texts = |x: usize| {
            let text = |k: usize| format!("<text x=\"{}\" y=\"{}\">word {k}</text>", x, 9 * k);
            page(&(0..9).map(text).collect::<String>())
        };
        let described = changes(&texts(3), &texts(4)).expect("both are SVG");
        assert_eq!(described, ["9 elements, such as text \"word 0\": moved by 1 px to the right"]);
    }

    #[test]
    fn each_kind_of_broken_file_has_its_own_message() {
        let sound = page("");
        for (text, words) in [
            ("", "it is empty (0 bytes)"),
            ("version https://git-lfs.github.com/spec/v1\n", "it is a Git LFS pointer"),
            ("<<<<<<< HEAD\n<svg/>", "line 1 is a mark of a merge conflict"),
            ("<svg><g></svg>", "it is not SVG"),
            ("{}", "it is not SVG"),
        ] {
            let refused = changes(text, &sound).expect_err(text).to_string();
            assert!(refused.starts_with(words), "{refused}");
        }
        let deep = page(&("<g>".repeat(900) + &"</g>".repeat(900)));
        assert!(changes(&deep, &sound).is_err());
    }
}
