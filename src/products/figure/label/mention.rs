//! [`names`]: tests whether a text mentions the name of a block, even if the name is a number.

use crate::drawing::text::NO_BREAK;

/// True if a text contains `name` as a separate word. In `3 N` or `3 hinges`, the number is a quantity or a count and
/// not a name. A number with decimals is not a name either.
pub(super) fn names(text: &str, name: &str) -> bool {
    let is_word_boundary = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
    let ends_in_digit = name.ends_with(|c: char| c.is_ascii_digit());
    let begins_with_digit = name.starts_with(|c: char| c.is_ascii_digit());
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let counts = |before: &str, rest: &str| {
        let mut after = rest.chars();
        let goes_on = after.next() == Some('.') && digit(after.next());
        let mut earlier = before.chars().rev();
        let began = earlier.next() == Some('.') && digit(earlier.next());
        let word = rest.trim_start_matches([' ', NO_BREAK]);
        let word = word.split(|c: char| !c.is_alphabetic() && c != '%').next();
        (ends_in_digit && goes_on)
            || (begins_with_digit && began)
            || (ends_in_digit && rest.starts_with('°'))
            || (ends_in_digit && COUNTED_NOUNS.contains(&word.unwrap_or_default()))
    };
    !name.is_empty()
        && text.match_indices(name).any(|(at, _)| {
            let (before, rest) = (&text[..at], &text[at + name.len()..]);
            is_word_boundary(before.chars().next_back())
                && is_word_boundary(rest.chars().next())
                && !counts(before, rest)
        })
}

/// The words after a number in the text below a frame if the number is not a name.
const COUNTED_NOUNS: [&str; 28] = [
    "N",
    "nN",
    "µN",
    "mN",
    "kN",
    "MN",
    "GN",
    "m",
    "mm",
    "km",
    "%",
    "more",
    "of",
    "block",
    "blocks",
    "bodies",
    "hinge",
    "hinges",
    "sliding",
    "shared",
    "interfaces",
    "resultants",
    "robots",
    "forces",
    "frames",
    "rigid",
    "amount",
    "amounts",
];

#[cfg(test)]
mod tests {
    use super::names;

    #[test]
    fn amounts_counts_and_parts_of_words_are_not_names() {
        let text = "missing: a pull of 2.5\u{a0}kN between 19.17 and 3, friction of 12 N between 4 and b-2; 5 more";
        for name in ["19.17", "3", "4", "b-2"] {
            assert!(names(text, name), "{name}");
        }
        for name in ["2.5", "19", "17", "12", "5", "pull of a", ""] {
            assert!(!names(text, name), "{name}");
        }
        assert!(!names("3 of 5 shared forces changed by over 5 %", "5"));
        assert!(!names("gravity is turned by 12° to the left", "12"));
    }
}
