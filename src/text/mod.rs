//! Text from files in what we write: one function per kind of output, through which every string goes that is not ours.
//!
//! A title, an id, a file's name or a piece of a file may hold anything: line breaks that would begin a row of a table,
//! escape sequences of terminals, marks that turn the order of reading round, markup, formulas of spreadsheets. After these
//! functions it is words on one line and nothing else. What cannot be seen becomes [`HIDDEN`], so that it is seen.

mod spelling;

pub use spelling::nearest;

/// Stands for a character that cannot be seen and would do something.
pub const HIDDEN: char = '\u{fffd}';

/// A 64-bit hash of some bytes (FNV-1a), the same on every machine and in every version of Rust. It finds accidental
/// differences; it does not protect against somebody who makes two texts of one hash.
///
/// ```
/// use drystone::internals::text::hash;
/// assert_eq!(hash(b"a"), 0xaf63_dc4c_8601_ec8c);
/// ```
pub fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Words on one line: line breaks and tabs become spaces; other controls and what turns the order of reading round become
/// [`HIDDEN`]. As many characters as before.
///
/// ```
/// use drystone::internals::text::line;
/// assert_eq!(line("x\n  all  stable"), "x   all  stable");
/// assert_eq!(line("\u{1b}[31mred"), "\u{fffd}[31mred");
/// ```
pub fn line(text: &str) -> String {
    text.chars().map(shown).collect()
}

/// As [`line()`], with white space narrowed to single spaces and at most `most` characters: for a heading, which a terminal
/// may break where it ends.
pub fn heading(text: &str, most: usize) -> String {
    let line = line(text);
    let words: Vec<&str> = line.split(' ').filter(|word| !word.is_empty()).collect();
    let words = words.join(" ");
    if words.chars().count() <= most {
        return words;
    }
    words
        .chars()
        .take(most.saturating_sub(1))
        .chain(['…'])
        .collect()
}

fn shown(c: char) -> char {
    match c {
        '\t' | '\n' | '\u{b}' | '\u{c}' | '\r' | '\u{85}' | '\u{2028}' | '\u{2029}' => ' ',
        c if is_hidden(c) => HIDDEN,
        c => c,
    }
}

/// Controls, and marks that overrule or embed a direction of writing ([UAX9] 2.1 to 2.4).
///
/// [UAX9]: https://www.unicode.org/reports/tr9/
fn is_hidden(c: char) -> bool {
    c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Text for SVG and any other XML, as content or between quotes: one line, its marks replaced, without the code points that
/// XML forbids.
pub fn xml(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars().map(shown) {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            ' '..='\u{7e}' | '\u{a0}'..='\u{fdcf}' | '\u{fdf0}'..='\u{fffd}' => out.push(c),
            // Above the first plane the last two code points of each plane are no characters.
            '\u{10000}'.. if u32::from(c) & 0xfffe != 0xfffe => out.push(c),
            _ => {}
        }
    }
    out
}

/// Text for Markdown within a line: no emphasis, heading, list, link, code or HTML begins in it, and no address is made a
/// link of.
pub fn markdown(text: &str) -> String {
    let line = line(text);
    let text = line.trim();
    let number = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    // A list or a heading begins at the beginning of a line only.
    let begins = |place: usize, c: char| match c {
        '-' | '+' | '=' => place == 0,
        _ => matches!(c, '.' | ')') && place == number && number > 0,
    };
    escaped(text, begins)
}

/// Text as a cell of a table of Markdown, where no line begins: as [`markdown`], but `64.7 kN` and `-3` stay as they are.
pub fn markdown_cell(text: &str) -> String {
    escaped(line(text).trim(), |_, _| false)
}

/// Text with a backslash before what Markdown would act on, and before what `more` says of a character at its place.
fn escaped(text: &str, more: impl Fn(usize, char) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    for (place, c) in text.char_indices() {
        let rest = &text[place..];
        let begins = match c {
            '.' if text[..place].ends_with("www") => true,
            ':' => rest.starts_with(":/"),
            _ => "\\`*_[]<>#|~@&$^".contains(c),
        };
        if begins || more(place, c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Text as a cell of a table of comma separated values: in quotes, and with an apostrophe before what a spreadsheet would
/// take for a formula.
pub fn csv(text: &str) -> String {
    let line = line(text);
    let formula = line
        .trim_start()
        .starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠']);
    let mark = if formula { "'" } else { "" };
    format!("\"{mark}{}\"", line.replace('"', "\"\""))
}

/// A word of a command line as a shell of POSIX takes it: quoted where it must be, on one line.
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
        // A file's name is no option.
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

/// JSON whose strings hold nothing that a terminal would act on: the same values, written with escapes. Outside of strings
/// there are no such characters.
pub fn json(text: &str) -> String {
    // Most text has no such character, and is looked through byte by byte at a fraction of the cost.
    let is_plain = |b: &u8| matches!(b, b' '..=b'~' | b'\n' | b'\t' | b'\r');
    if text.as_bytes().iter().all(is_plain) {
        return text.to_string();
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
    out
}

/// Text of an annotation of GitHub, which ends at a line break and knows its own escapes; lines stay lines.
pub fn github(text: &str) -> String {
    let lines: Vec<String> = text.split('\n').map(line).collect();
    lines.join("\n").replace('%', "%25").replace('\n', "%0A")
}

/// Text of a property of such an annotation, its file or title.
pub fn github_property(text: &str) -> String {
    github(&line(text)).replace(':', "%3A").replace(',', "%2C")
}

/// Whether a line is a mark that a version control system leaves between two versions of a place.
pub fn is_conflict_mark(line: &str) -> bool {
    let marks = |c: char| line.chars().take(7).filter(|found| *found == c).count() == 7;
    marks('<') || marks('=') || marks('>')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_keeps_its_length_and_nothing_that_acts() {
        let hostile = "a\u{1b}[31m\tb\r\n\u{9b}c\u{202e}d\u{2028}e\u{0}";
        assert_eq!(
            line(hostile),
            "a\u{fffd}[31m b  \u{fffd}c\u{fffd}d e\u{fffd}"
        );
        assert_eq!(line("עברית‏ ü 石"), "עברית‏ ü 石", "other scripts stay");
        assert_eq!(heading("a \n\n   b", 9), "a b");
        assert_eq!(heading("abcdef", 4), "abc…");
    }

    #[test]
    fn xml_has_no_marks_and_no_forbidden_code_points() {
        assert_eq!(
            xml("<a b='\"'>&\u{fffe}\u{1ffff}\n"),
            "&lt;a b=&#39;&quot;&#39;&gt;&amp; "
        );
    }

    #[test]
    fn markdown_stays_words() {
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
    fn annotations_end_where_they_end_and_shells_read_one_word() {
        assert_eq!(github("50 %\n::error::x"), "50 %25%0A::error::x");
        assert_eq!(github_property("a,b:c\n\u{1b}"), "a%2Cb%3Ac \u{fffd}");
        assert_eq!(shell("scenes/arch.json"), "scenes/arch.json");
        assert_eq!(shell("it's $(x)"), "'it'\\''s $(x)'");
    }

    #[test]
    fn cells_are_text() {
        assert_eq!(csv("a,\"b\""), "\"a,\"\"b\"\"\"");
        assert_eq!(csv(" =1+1"), "\"' =1+1\"");
        assert_eq!(csv("\t@a\nb"), "\"' @a b\"");
        assert_eq!(csv("a-b"), "\"a-b\"");
    }
}
