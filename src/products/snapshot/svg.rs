//! [`changes`]: compares two drawings as SVG text, line by line.
//!
//! Two lines count as equal if they differ only by rounding. Positions may differ by 0.025 pixels, colour channels by 1
//! of 255, and rounded numbers in words by one unit of their last digit. The ids of drystone begin with a hash of the
//! whole drawing, which is ignored.

use super::layer::UnreadableReference;
use crate::text::heading;

/// Tolerance for positions, in pixels. A tiny change of a coordinate changes its rounded value by at most 0.01. It
/// changes the sum of two rounded values by at most 0.02.
const POSITION_TOL: f64 = 0.025;
/// After a line that differs, equal lines are searched in at most this many further lines of both texts together.
const MAX_LOOKAHEAD: usize = 200;
/// Longest part of a line that a message shows, in characters.
const MAX_SHOWN: usize = 90;

/// Describes the differences between two drawings, given as SVG text. The list is empty if there are no differences.
///
/// # Errors
/// [`UnreadableReference`] if the expected text is not SVG.
///
/// # Example
/// ```
/// use drystone::snapshot::svg::changes;
/// let page = |colour: &str| format!("<svg>\n<g class=\"block\"><title>Block a</title>\n\
///     <path d=\"M0 0h9v5z\" fill=\"{colour}\"/>\n</g>\n</svg>\n");
/// let found = changes(&page("#ff0000"), &page("#0000ff"))?;
/// assert_eq!(found, ["path in Block a: fill #ff0000 → #0000ff"]);
/// # Ok::<(), drystone::snapshot::UnreadableReference>(())
/// ```
pub fn changes(expected: &str, found: &str) -> Result<Vec<String>, UnreadableReference> {
    UnreadableReference::check(expected.as_bytes(), "drawing")?;
    if !expected.contains("<svg") || !expected.trim_end().ends_with("</svg>") {
        let words = "it is not SVG: it has no <svg>, or does not end with </svg>";
        return Err(UnreadableReference(words.into()));
    }
    let (expected, found) = (without_hash(expected), without_hash(found));
    let (old, new): (Vec<&str>, Vec<&str>) = (expected.lines().collect(), found.lines().collect());
    let (mut i, mut j) = (0, 0);
    let mut changes = Vec::new();
    let mut groups = Groups::default();
    while i < old.len() || j < new.len() {
        // 1. Count the lines until both texts are equal again.
        let (gone, added) = next_equal(&old[i..], &new[j..]);
        // 2. Lines in the same place are one changed line, if they are about the same element.
        for k in 0..gone.max(added) {
            let (was, is) = (old[i..i + gone].get(k), new[j..j + added].get(k));
            if let Some(line) = is {
                groups.read(line);
            }
            let place = groups.innermost();
            match was.zip(is).and_then(|(was, is)| differences(was, is)) {
                Some((element, words)) => changes.push(format!("{element} in {place}: {words}")),
                None => {
                    changes.extend(was.map(|line| format!("in {place}: − {}", heading(line, MAX_SHOWN))));
                    changes.extend(is.map(|line| format!("in {place}: + {}", heading(line, MAX_SHOWN))));
                }
            }
        }
        if let Some(line) = new.get(j + added) {
            groups.read(line);
        }
        (i, j) = (i + gone + 1, j + added + 1);
    }
    Ok(changes)
}

/// The groups that contain a line, from the outermost to the innermost, each with its title.
#[derive(Default)]
struct Groups(Vec<String>);

impl Groups {
    fn read(&mut self, line: &str) {
        let opened = line.matches("<g ").count() + line.matches("<g>").count();
        self.0.extend(std::iter::repeat_n(String::new(), opened));
        let title = line.split_once("<title").and_then(|(_, rest)| rest.split_once('>')?.1.split_once("</title>"));
        if let (Some((title, _)), Some(group)) = (title, self.0.last_mut()) {
            *group = heading(&plain(title), MAX_SHOWN);
        }
        self.0.truncate(self.0.len().saturating_sub(line.matches("</g>").count()));
    }

    /// Returns the title of the innermost group that has one.
    fn innermost(&self) -> &str {
        let titles = self.0.iter().rev().find(|title| !title.is_empty());
        titles.map_or("the page", String::as_str)
    }
}

/// Replaces the entities of XML by their characters.
fn plain(text: &str) -> String {
    let entities = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
    entities.iter().fold(text.to_owned(), |text, (entity, character)| text.replace(entity, character))
}

/// Replaces the hash at the beginning of all ids, such as `d85ea54b1`, by `d`.
fn without_hash(svg: &str) -> String {
    let mark = svg.split_once("aria-labelledby=\"").and_then(|(_, ids)| ids.split_once("-title"));
    match mark {
        Some((mark, _)) if !mark.is_empty() && mark.bytes().all(|b| b.is_ascii_alphanumeric()) => {
            svg.replace(&format!("{mark}-"), "d-")
        }
        _ => svg.to_owned(),
    }
}

/// Returns the numbers of lines of both texts before the next line that is equal in both. Prefers the smallest sum of
/// both numbers.
fn next_equal(old: &[&str], new: &[&str]) -> (usize, usize) {
    let (most_old, most_new) = (old.len(), new.len());
    for sum in 0..=MAX_LOOKAHEAD.min(most_old + most_new) {
        // Pairs of equally many lines first: most changes keep the number of lines.
        let mut gone: Vec<usize> = (sum.saturating_sub(most_new)..=sum.min(most_old)).collect();
        gone.sort_by_key(|gone| gone.abs_diff(sum - gone));
        for gone in gone {
            let same = match (old.get(gone), new.get(sum - gone)) {
                (Some(old), Some(new)) => same_line(old, new),
                // Both texts end here.
                (None, None) => true,
                _ => false,
            };
            if same {
                return (gone, sum - gone);
            }
        }
    }
    (most_old, most_new)
}

/// Describes the attributes and words that differ between two lines of the same element: the element, such as `path`,
/// and `fill #ff0000 → #0000ff`. Returns `None` if the lines differ in anything else.
fn differences(old: &str, new: &str) -> Option<(String, String)> {
    // Parts with odd numbers are the values of attributes, because text in elements contains no quotation marks. The
    // last part has the words of the element.
    let (a, b): (Vec<&str>, Vec<&str>) = (old.split('"').collect(), new.split('"').collect());
    let last = a.len() - 1;
    if last == 0 || a.len() != b.len() || a[..last].iter().zip(&b).step_by(2).any(|(a, b)| a != b) {
        return None;
    }
    let differ = (1..last).step_by(2).filter(|k| !same_value(a[*k], b[*k]));
    let differences = differ.map(|k| {
        let name = a[k - 1].trim_end_matches('=').rsplit(' ').next().unwrap_or_default();
        format!("{name} {} → {}", excerpt(a[k], b[k]), excerpt(b[k], a[k]))
    });
    let mut differences: Vec<String> = differences.collect();
    let tag = a[0].trim_start_matches('<').split(' ').next().unwrap_or_default();
    let (was, is) = (words(a[last]), words(b[last]));
    if !same_words(&was, &is) {
        // A group with another title is another group.
        if tag == "g" {
            return None;
        }
        differences.push(format!("{} → {}", excerpt(&was, &is), excerpt(&is, &was)));
    }
    let element = if tag == "text" { format!("text \"{}\"", heading(&was, 40)) } else { tag.to_owned() };
    (!differences.is_empty()).then(|| (element, differences.join(", ")))
}

/// Returns the words between the tags of a part of a line.
fn words(part: &str) -> String {
    plain(&part.split('<').filter_map(|piece| piece.rsplit('>').next()).collect::<String>())
}

/// Returns a value for messages. A long value begins at the word that differs from `other`.
fn excerpt(value: &str, other: &str) -> String {
    const MAX_VALUE: usize = 40;
    if value.len().max(other.len()) <= MAX_VALUE {
        return value.to_owned();
    }
    let equal = value.char_indices().zip(other.chars()).take_while(|((_, a), b)| a == b);
    let end = equal.last().map_or(0, |((at, c), _)| at + c.len_utf8());
    let begin = value[..end].rfind(' ').map_or(0, |space| space + 1);
    let dots = if begin > 0 { "… " } else { "" };
    format!("{dots}{}", heading(&value[begin..], MAX_VALUE))
}

/// True if two lines are equal apart from rounding.
fn same_line(old: &str, new: &str) -> bool {
    if old == new {
        return true;
    }
    let (a, b) = (old.split('"'), new.split('"'));
    a.clone().count() == b.clone().count()
        && a.zip(b).enumerate().all(|(k, (a, b))| if k % 2 == 1 { same_value(a, b) } else { same_words(a, b) })
}

/// True if two values of an attribute are equal apart from rounding. Colour channels may differ by 1, and other numbers
/// by [`POSITION_TOL`].
fn same_value(a: &str, b: &str) -> bool {
    if a == b {
        return true;
    }
    if let (Some(a), Some(b)) = (colour(a), colour(b)) {
        return a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1);
    }
    same_pieces(a, b, |_, _| POSITION_TOL)
}

/// True if two texts are equal, apart from one unit in the last digit of rounded numbers. A number counts as rounded
/// if it has a decimal point, or if ° or % follows it. The facts layer compares the same numbers more precisely.
fn same_words(a: &str, b: &str) -> bool {
    // The place value of the last digit of a number: 0.01 for `1.23`.
    let unit = |number: &str| {
        let decimals = number.split_once('.').map_or(0, |(_, digits)| digits.len());
        format!("1e-{decimals}").parse().unwrap_or(1.0)
    };
    same_pieces(a, b, |[a, b], next| {
        let rounded = a.contains('.') && b.contains('.') || next.starts_with(['°', '%']);
        if rounded { 1.5 * f64::max(unit(a), unit(b)) } else { 0.0 }
    })
}

/// True if two texts have the same numbers and the same text between them. `tolerance` returns the largest difference of
/// two numbers, which it gets with the text behind them.
fn same_pieces(a: &str, b: &str, tolerance: impl Fn([&str; 2], &str) -> f64) -> bool {
    let (a, b) = (pieces(a), pieces(b));
    let next = |i: usize| a.get(i + 1).map_or("", |piece| piece.trim_start());
    let same = |i: usize| match (a[i].parse::<f64>(), b[i].parse::<f64>()) {
        _ if a[i] == b[i] => true,
        (Ok(x), Ok(y)) => (x - y).abs() <= tolerance([a[i], b[i]], next(i)),
        _ => false,
    };
    a.len() == b.len() && (0..a.len()).all(same)
}

/// Reads a colour of the form `#ff0000` as red, green and blue; `None` for any other text.
fn colour(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#').filter(|d| d.len() == 6)?;
    let value = u32::from_str_radix(digits, 16).ok()?;
    let [_, r, g, b] = value.to_be_bytes();
    Some([r, g, b])
}

/// Splits a text into numbers and the text between them. Leaves out text that is only white space: a minus sign may
/// stand in place of a space between two numbers.
fn pieces(text: &str) -> Vec<&str> {
    let bytes = text.as_bytes();
    let digit = |at: usize| bytes.get(at).is_some_and(u8::is_ascii_digit);
    let mut pieces = Vec::new();
    let (mut begin, mut in_number) = (0, false);
    for at in 0..=bytes.len() {
        let is_number = match bytes.get(at) {
            Some(b'-') => digit(at + 1),
            // A full stop that no digit follows ends a sentence.
            Some(b'.') => in_number && digit(at + 1),
            Some(byte) => byte.is_ascii_digit(),
            None => !in_number,
        };
        let is_next = is_number != in_number || (in_number && bytes.get(at) == Some(&b'-'));
        if is_next {
            // All bytes of a number are ASCII, so both ends are boundaries of characters.
            pieces.push(&text[begin..at]);
            (begin, in_number) = (at, is_number);
        }
    }
    pieces.retain(|piece| !piece.trim().is_empty());
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
        assert!(same_words("6.91 N.", "6.92 N.") && !same_words("weight 6.", "weight 7."));
        assert!(same_value("192.8953857421875 206.76", "192.8953857421900 206.77"));
        assert!(same_value("M0 3.75-11.25h2", "M-0.01 3.75-11.24h2"));
        assert!(!same_value("1.5", "1.6") && !same_value("none", "#000000"));
        assert!(same_value("#102030", "#112030") && !same_value("#102030", "#122030"));
    }

    fn page(lines: &str) -> String {
        format!("<svg width=\"90\" height=\"50\">\n{lines}</svg>\n")
    }

    #[test]
    fn one_line_less_among_similar_ones_is_reported_alone() {
        let paths = |lost: usize| {
            let path = |x: usize| format!("<path d=\"M{} 5l3 4h2z\" fill=\"#000000\"/>\n", 7 * x);
            page(&(0..30).filter(|x| *x != lost).map(path).collect::<String>())
        };
        let line = "<path d=\"M77 5l3 4h2z\" fill=\"#000000\"/>";
        assert_eq!(changes(&paths(99), &paths(11)), Ok(vec![format!("in the page: − {line}")]));
        assert_eq!(changes(&paths(11), &paths(99)), Ok(vec![format!("in the page: + {line}")]));
        assert_eq!(changes(&paths(29), &paths(99)).map(|c| c.len()), Ok(1));
    }

    #[test]
    fn a_changed_line_shows_what_changed_and_where_it_is() {
        let text = |x: u32, words: &str| {
            page(&format!("<g class=\"name\"><title>Block &lt;a&gt;</title>\n<text x=\"{x}\">{words}</text>\n</g>\n"))
        };
        let found = changes(&text(3, "it&#39;s"), &text(4, "right")).expect("both are SVG");
        assert_eq!(found, ["text \"it's\" in Block <a>: x 3 → 4, it's → right"]);
        let other = text(3, "left").replace("<text x=\"3\">left</text>", "<path d=\"M0 0h3\"/>");
        let found = changes(&text(3, "left"), &other).expect("both are SVG");
        assert_eq!(found, ["in Block <a>: − <text x=\"3\">left</text>", "in Block <a>: + <path d=\"M0 0h3\"/>"]);
    }

    #[test]
    fn each_kind_of_broken_file_has_its_own_message() {
        for (text, words) in [
            ("", "it is empty (0 bytes)"),
            ("version https://git-lfs.github.com/spec/v1\n", "it is a Git LFS pointer"),
            ("<<<<<<< HEAD\n<svg/>", "line 1 is a mark of a merge conflict"),
            ("<svg><g>", "it is not SVG"),
            ("{}", "it is not SVG"),
        ] {
            let refused = changes(text, &page("")).expect_err(text).to_string();
            assert!(refused.starts_with(words), "{refused}");
        }
    }
}
