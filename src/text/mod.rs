//! Escapes untrusted text for each output format, and shortens and joins words for messages. All text that does not come from this program is untrusted.
//!
//! A title, an id or a file name may contain anything: line breaks that begin a table row, escape sequences of
//! terminals, characters that reverse the reading direction, markup, or spreadsheet formulas. The functions of this
//! module return harmless text, on one line except for JSON. Except in JSON, control characters become spaces or
//! [`HIDDEN`], so that the reader sees where they were.

use std::borrow::Cow;

pub use spelling::nearest;

mod spelling;

/// The character that replaces control characters, except line breaks and tabs, and characters that change the reading
/// direction.
pub const HIDDEN: char = '\u{fffd}';

/// Returns a 64-bit hash of some bytes (FNV-1a). The hash is the same on every machine and in every version of Rust. It
/// detects accidental differences, but it is not secure: two texts with the same hash can be constructed.
///
/// ```
/// use drystone::internals::text::hash;
/// assert_eq!(hash(b"a"), 0xaf63_dc4c_8601_ec8c);
/// ```
pub fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Returns the words with a capital first letter.
pub(crate) fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + letters.as_str()
}

/// Returns the text on one line. Line breaks and tabs become spaces. Other control characters, and characters that
/// change the reading direction, become [`HIDDEN`]. The number of characters stays the same.
///
/// ```
/// use drystone::internals::text::line;
/// assert_eq!(line("x\n  all  stable"), "x   all  stable");
/// assert_eq!(line("\u{1b}[31mred"), "\u{fffd}[31mred");
/// ```
pub fn line(text: &str) -> String {
    text.chars().map(visible).collect()
}

/// Returns text for a heading: like [`line()`], but with single spaces between words. A text of more than `max_chars`
/// characters is cut and ends with an ellipsis.
pub fn heading(text: &str, max_chars: usize) -> String {
    let line = line(text);
    let words: Vec<&str> = line.split(' ').filter(|word| !word.is_empty()).collect();
    let words = words.join(" ");
    if words.chars().count() <= max_chars {
        return words;
    }
    words.chars().take(max_chars.saturating_sub(1)).chain(['…']).collect()
}

/// If a text has more than 40 characters, returns its first 37 characters and "…"; otherwise the whole text.
pub fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 { text.to_string() } else { text.chars().take(37).chain("…".chars()).collect() }
}

/// Writes a number as in a sentence, rounded to 1 + `decimals` significant digits: `0.5`, `12`. If it is less than 0.001,
/// or at least a million, it is written with a power of ten: `1.3×10⁻⁵`. Trailing zeros are dropped.
///
/// ```
/// use drystone::internals::text::power_of_ten;
/// assert_eq!([0.5, 12.34, -1.26e-5, 2e9].map(|x| power_of_ten(x, 1)), ["0.5", "12", "−1.3×10⁻⁵", "2×10⁹"]);
/// ```
pub fn power_of_ten(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$e}");
    let Some((mantissa, exponent)) = text.split_once('e') else { return text };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if x == 0.0 || (-3..6).contains(&exponent) {
        return text.parse::<f64>().unwrap_or(x).to_string().replace('-', "−");
    }
    let (sign, mantissa) = mantissa.strip_prefix('-').map_or(("", mantissa), |rest| ("−", rest));
    format!("{sign}{}×10{}", without_zeros(mantissa), superscript(exponent))
}

/// Writes a whole number as an exponent, in superscript digits: `⁻⁹` for −9.
pub fn superscript(value: i32) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        '4' => '⁴',
        '5' => '⁵',
        '6' => '⁶',
        '7' => '⁷',
        '8' => '⁸',
        _ => '⁹',
    };
    value.to_string().chars().map(raised).collect()
}

/// Joins the items into a text such as "a, b or c"; "nothing" if there are no items.
pub fn choice(items: impl IntoIterator<Item = String>) -> String {
    let items: Vec<String> = items.into_iter().collect();
    match items.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        Some((last, _)) => last.clone(),
        None => "nothing".into(),
    }
}

/// Returns a space for a line break or tab, [`HIDDEN`] for another control character or a character that changes the
/// reading direction, and otherwise the character itself.
fn visible(c: char) -> char {
    match c {
        '\t' | '\n' | '\u{b}' | '\u{c}' | '\r' | '\u{85}' | '\u{2028}' | '\u{2029}' => ' ',
        c if is_hidden(c) => HIDDEN,
        c => c,
    }
}

/// True for control characters, and for characters that embed, override or isolate a writing direction ([UAX9] 2.1 to
/// 2.4).
///
/// [UAX9]: https://www.unicode.org/reports/tr9/
pub fn is_hidden(c: char) -> bool {
    c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Escapes text for the content of an XML element or for an attribute value in quotes. The result is one line, with
/// entities for markup characters and without code points that XML forbids.
pub fn xml(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars().map(visible) {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            ' '..='\u{7e}' | '\u{a0}'..='\u{fdcf}' | '\u{fdf0}'..='\u{fffd}' => out.push(c),
            // The last two code points of each plane are not characters.
            '\u{10000}'.. if u32::from(c) & 0xfffe != 0xfffe => out.push(c),
            _ => {}
        }
    }
    out
}

/// Escapes text for Markdown, so that it cannot start emphasis, a heading, a list, a link, code or HTML.
pub fn markdown(text: &str) -> String {
    let line = line(text);
    let text = line.trim();
    let number = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    // Lists and heading underlines can begin only at the start of a line.
    let starts_block = |place: usize, c: char| match c {
        '-' | '+' | '=' => place == 0,
        _ => matches!(c, '.' | ')') && place == number && number > 0,
    };
    backslash_escaped(text, starts_block)
}

/// Escapes text for a cell of a Markdown table. It is like [`markdown`], but `64.7 kN` and `-3` stay as they are,
/// because a list cannot begin in a cell.
pub fn markdown_cell(text: &str) -> String {
    backslash_escaped(line(text).trim(), |_, _| false)
}

/// Puts a backslash before each character that Markdown interprets, and before each character for which
/// `is_special(position, character)` is true.
fn backslash_escaped(text: &str, is_special: impl Fn(usize, char) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    for (place, c) in text.char_indices() {
        let rest = &text[place..];
        let is_markup = match c {
            '.' if text[..place].ends_with("www") => true,
            ':' => rest.starts_with(":/"),
            _ => "\\`*_[]<>#|~@&$^".contains(c),
        };
        if is_markup || is_special(place, c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Quotes text for a cell of a CSV file. An apostrophe is added if a spreadsheet would read the text as a formula.
pub fn csv(text: &str) -> String {
    let line = line(text);
    let is_formula = line.trim_start().starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠']);
    let mark = if is_formula { "'" } else { "" };
    format!("\"{mark}{}\"", line.replace('"', "\"\""))
}

/// Escapes text as one word for the command line of a POSIX shell. The result is one line, in quotes if necessary.
///
/// ```
/// use drystone::internals::text::shell;
/// assert_eq!(shell("walls/a-1.json"), "walls/a-1.json");
/// assert_eq!(shell("it's $(a).json"), r"'it'\''s $(a).json'");
/// assert_eq!(shell("-o.json"), "./-o.json");
/// ```
pub fn shell(word: &str) -> String {
    let word = line(word);
    let word = if word.len() > 1 && word.starts_with('-') {
        // A file name that starts with a dash would be read as an option.
        format!("./{word}")
    } else {
        word
    };
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+,:=@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word;
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// Returns JSON text with the same values. Characters that a terminal would interpret are replaced by escapes.
///
/// In valid JSON, such characters occur only inside strings, where escapes are allowed.
pub fn json(text: &str) -> Cow<'_, str> {
    // Most text has no character to replace, and testing bytes is much faster than decoding characters.
    if text.as_bytes().iter().all(is_plain) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        let kept = matches!(c, '\n' | '\t' | '\r');
        if !kept && (is_hidden(c) || matches!(c, '\u{2028}' | '\u{2029}')) {
            out.push_str(&format!("\\u{:04x}", u32::from(c)));
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

/// True for a byte of a character that [`json`] never replaces.
pub(crate) fn is_plain(byte: &u8) -> bool {
    matches!(byte, b' '..=b'~' | b'\n' | b'\t' | b'\r')
}

/// Escapes text for a GitHub annotation: `%` becomes `%25`, and a line break becomes `%0A`. Other characters are
/// replaced as by [`line()`].
pub fn github(text: &str) -> String {
    let lines: Vec<String> = text.split('\n').map(line).collect();
    lines.join("\n").replace('%', "%25").replace('\n', "%0A")
}

/// Escapes text for a property of a GitHub annotation, such as its file or title.
pub fn github_property(text: &str) -> String {
    github(&line(text)).replace(':', "%3A").replace(',', "%2C")
}

/// Returns ` and 3 more` for the parts of a list that are left out, and nothing if no part is.
pub fn and_more(left_out: usize) -> String {
    if left_out == 0 { String::new() } else { format!(" and {left_out} more") }
}

/// Joins the first parts of a list by commas, at most `max`, and adds how many are left out.
///
/// ```
/// use drystone::internals::text::first_of;
/// assert_eq!(first_of(["a", "b"], 2), "a, b");
/// assert_eq!(first_of(["a", "b", "c", "d"], 2), "a, b and 2 more");
/// ```
pub fn first_of<T, I>(parts: I, max: usize) -> String
where
    T: Into<String>,
    I: IntoIterator<Item = T, IntoIter: ExactSizeIterator>,
{
    let parts = parts.into_iter();
    let left_out = parts.len().saturating_sub(max);
    let shown: Vec<String> = parts.take(max).map(Into::into).collect();
    shown.join(", ") + &and_more(left_out)
}

/// Writes a finite number with at most `most` decimals, without zeros at their end and without −0.
///
/// # Panics
/// Panics if the number is not finite.
pub fn decimals(value: f64, most: usize) -> String {
    assert!(value.is_finite(), "a drawing holds the number {value}; every number of a drawing is finite");
    match without_zeros(&format!("{value:.most$}")) {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

/// Leaves out zeros at the end of the decimals of a number: `2.50` becomes `2.5`, and `10.0` becomes `10`. A number
/// with an exponent stays as it is.
pub fn without_zeros(number: &str) -> &str {
    let has_decimals = number.contains('.') && !number.contains('e');
    if has_decimals { number.trim_end_matches('0').trim_end_matches('.') } else { number }
}

/// True if a line is a conflict marker of a version control system: it starts with seven `<`, `=` or `>`.
pub fn is_conflict_mark(line: &str) -> bool {
    let marks = |c: char| line.chars().take(7).filter(|found| *found == c).count() == 7;
    marks('<') || marks('=') || marks('>')
}

/// A value with a name. A user chooses one of a few such values.
pub trait Word: Copy + Send + Sync + 'static {
    /// Returns all values, in the order in which help lists them.
    fn all() -> Vec<Self>;

    /// Returns the name of the value. Words in a name are joined by hyphens.
    fn word(self) -> &'static str;

    /// Returns a line of help; empty if the name says enough.
    fn help(self) -> &'static str {
        ""
    }

    /// Returns the name with underscores, as results write it, if this differs from [`Word::word`].
    fn alias(self) -> Option<&'static str> {
        None
    }

    /// True if help and messages do not list the name.
    fn is_hidden(self) -> bool {
        false
    }

    /// Returns the value with this name. An underscore counts as a hyphen, and capital letters count as small letters.
    fn from_word(word: &str) -> Option<Self> {
        let word = word.replace('_', "-").to_ascii_lowercase();
        Self::all().into_iter().find(|value| value.word() == word)
    }
}

/// Returns the parser of the command line for the name of a value.
#[cfg(feature = "cli")]
pub(crate) fn typed_word<T: Word>() -> impl clap::builder::TypedValueParser<Value = T> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
    let shown = |value: T| {
        let shown = PossibleValue::new(value.word()).aliases(value.alias()).hide(value.is_hidden());
        if value.help().is_empty() { shown } else { shown.help(value.help()) }
    };
    let values = T::all().into_iter().map(shown);
    PossibleValuesParser::new(values).try_map(|typed| T::from_word(&typed).ok_or("there is no such value"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_its_length_but_no_control_characters() {
        let hostile = "a\u{1b}[31m\tb\r\n\u{9b}c\u{202e}d\u{2028}e\u{0}";
        assert_eq!(line(hostile), "a\u{fffd}[31m b  \u{fffd}c\u{fffd}d e\u{fffd}");
        assert_eq!(line("עברית‏ ü 石"), "עברית‏ ü 石", "other scripts stay");
        assert_eq!(heading("a \n\n   b", 9), "a b");
        assert_eq!(heading("abcdef", 4), "abc…");
    }

    #[test]
    fn xml_escapes_markup_and_drops_forbidden_code_points() {
        assert_eq!(xml("<a b='\"'>&\u{fffe}\u{1ffff}\n"), "&lt;a b=&#39;&quot;&#39;&gt;&amp; ");
    }

    #[test]
    fn markdown_syntax_is_escaped() {
        for (text, written) in [
            ("[a](javascript:b)", "\\[a\\](javascript:b)"),
            ("# a", "\\# a"),
            ("1. a", "1\\. a"),
            ("12) a 3. b", "12\\) a 3. b"),
            ("- a - b", "\\- a - b"),
            ("http://a.b www.c.d", "http\\://a.b www\\.c.d"),
            ("a\n\n# b", "a  \\# b"),
            ("An arch, 0.7 m (thin).", "An arch, 0.7 m (thin)."),
        ] {
            assert_eq!(markdown(text), written);
        }
        assert_eq!(markdown_cell("64.7 kN"), "64.7 kN");
        assert_eq!(markdown_cell("-3 | 1. `a`"), "-3 \\| 1. \\`a\\`");
    }

    #[test]
    fn annotations_stay_on_one_line_and_shells_read_one_word() {
        assert_eq!(github("50 %\n::error::x"), "50 %25%0A::error::x");
        assert_eq!(github_property("a,b:c\n\u{1b}"), "a%2Cb%3Ac \u{fffd}");
        assert_eq!(shell("scenes/arch.json"), "scenes/arch.json");
        assert_eq!(shell("it's $(x)"), "'it'\\''s $(x)'");
    }

    #[test]
    fn csv_cells_are_quoted_and_are_never_formulas() {
        assert_eq!(csv("a,\"b\""), "\"a,\"\"b\"\"\"");
        assert_eq!(csv(" =1+1"), "\"' =1+1\"");
        assert_eq!(csv("\t@a\nb"), "\"' @a b\"");
        assert_eq!(csv("a-b"), "\"a-b\"");
    }

    #[test]
    fn choices_are_joined_with_commas_and_or() {
        assert_eq!(choice(["a".to_string(), "b".to_string(), "c".to_string()]), "a, b or c");
        assert_eq!(choice(["a".to_string()]), "a");
    }
}
