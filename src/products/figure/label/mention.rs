//! [`names`]: tests whether a text mentions the name of a block, even if the name is a number.
//!
//! Texts contain many numbers that are quantities or counts: `3 N`, `32 joints`, `at most 2`. A name that is a number
//! is therefore found only between words that stand next to names. If such a word is missing from the lists, a block
//! that the text mentions has no label. The opposite error would be worse: a label on a block that the text does not
//! mention would mislead the reader.

use crate::pictures::drawing::text::NO_BREAK;

/// True if a text contains `name` as a separate word that is neither a quantity nor a count nor a part of a number.
pub(super) fn names(text: &str, name: &str) -> bool {
    let is_word_boundary = |c: Option<char>| c.is_none_or(|c| !c.is_alphanumeric());
    !name.is_empty()
        && text.match_indices(name).any(|(at, _)| {
            let (before, rest) = (&text[..at], &text[at + name.len()..]);
            is_word_boundary(before.chars().next_back())
                && is_word_boundary(rest.chars().next())
                && !splits_a_number(before, name, rest)
                && (!is_number(name) || stands_for_a_name(before, rest))
        })
}

/// True if a name has digits and no letters.
fn is_number(name: &str) -> bool {
    name.chars().any(|c| c.is_ascii_digit()) && !name.chars().any(char::is_alphabetic)
}

/// True if the text before or after a name continues a number with decimals: the name `5` in `2.5` or `5.2`.
fn splits_a_number(before: &str, name: &str, rest: &str) -> bool {
    let digit = |c: Option<char>| c.is_some_and(|c| c.is_ascii_digit());
    let digit_beyond_point = |side: &mut dyn Iterator<Item = char>| side.next() == Some('.') && digit(side.next());
    (digit(name.chars().next_back()) && digit_beyond_point(&mut rest.chars()))
        || (digit(name.chars().next()) && digit_beyond_point(&mut before.chars().rev()))
}

/// True if the words before and after a number allow it to be a name.
fn stands_for_a_name(before: &str, rest: &str) -> bool {
    let space = [' ', NO_BREAK];
    let not_a_letter = |c: char| !c.is_alphabetic();
    let previous = before.trim_end_matches(space).rsplit(not_a_letter).next();
    let after = rest.trim_start_matches(space);
    let next = after.split(not_a_letter).next().unwrap_or_default();
    let ends_a_phrase = after.is_empty() || after.starts_with([',', ';', ':', '.', ')']);
    (ends_a_phrase || WORDS_AFTER_NAMES.contains(&next))
        && !WORDS_BEFORE_QUANTITIES.contains(&previous.unwrap_or_default())
}

/// The words that may follow the name of a block. After every other word, a unit for example, a number is no name.
const WORDS_AFTER_NAMES: [&str; 17] = [
    "and", "are", "at", "fall", "falls", "has", "have", "in", "is", "it", "on", "or", "over", "slides", "stands",
    "under", "with",
];

/// The words after which a number is a quantity even at the end of a phrase: `friction 2`, `from 0 to 3`.
const WORDS_BEFORE_QUANTITIES: [&str; 10] =
    ["factor", "factors", "friction", "from", "least", "most", "step", "than", "times", "to"];

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

    #[test]
    fn a_number_before_a_noun_or_after_a_parameter_is_not_a_name() {
        for (text, name) in [
            ("32 joints are at their limit", "32"),
            ("12 loads and 4 torques", "12"),
            ("stands at every factor from 1 to 3", "3"),
            ("falls: would need friction 2", "2"),
            ("carried with a force of at most 4", "4"),
        ] {
            assert!(!names(text, name), "{text}");
        }
        assert!(names("block 32 falls", "32"));
        assert!(names("joints are at their limit, first between 32 and 33.", "33"));
        assert!(names("a torque at v12", "v12"));
    }
}
