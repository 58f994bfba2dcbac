//! [`Page`]: text for a terminal. It escapes all text that may come from files.
//!
//! All messages for people are pages. Fixed text of the program is `&'static str`. All other text is escaped when it
//! is added, so that the title of a scene cannot begin a line, set a colour or move the cursor. No message can skip
//! this step, because there is no other way to add text.

use clap::builder::styling::Style;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use crate::text;

/// Lines for a terminal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Page {
    text: String,
}

impl Page {
    /// Escapes a text, and makes a page with this text as its only line.
    pub(crate) fn new(words: &str) -> Page {
        let mut page = Page::default();
        page.line(words);
        page
    }

    /// Appends fixed text of this program without escaping.
    pub(crate) fn literal(&mut self, text: &'static str) {
        self.text.push_str(text);
    }

    /// Escapes a text, and appends it to the current line.
    pub(crate) fn words(&mut self, words: &str) {
        self.text.push_str(&text::line(words));
    }

    /// Escapes a text, and appends it to the current line in a style such as a colour or bold.
    pub(crate) fn styled(&mut self, style: Style, words: &str) {
        self.text.push_str(&style.render().to_string());
        self.words(words);
        self.text.push_str(&style.render_reset().to_string());
    }

    /// Ends the current line.
    pub(crate) fn end(&mut self) {
        self.text.push('\n');
    }

    /// Escapes a text, appends it to the current line, and ends the line.
    pub(crate) fn line(&mut self, words: &str) {
        self.words(words);
        self.end();
    }

    /// Appends several lines whose parts are already escaped with [`text::line`]. Line feeds and colours are kept; any
    /// other control character is escaped.
    pub(crate) fn block(&mut self, lines: &str) {
        let mut rest = lines;
        while let Some(c) = rest.chars().next() {
            let length = colour(rest).unwrap_or(c.len_utf8());
            let (piece, behind) = rest.split_at(length);
            match c {
                '\n' | '\u{1b}' if length > 1 || c == '\n' => self.text.push_str(piece),
                _ => self.words(piece),
            }
            rest = behind;
        }
        if !lines.ends_with('\n') {
            self.end();
        }
    }

    /// Appends another page.
    pub(crate) fn append(&mut self, page: &Page) {
        self.text.push_str(&page.text);
    }

    /// Returns the page with lines of at most `width` columns. The rest of a longer line follows on the next line.
    /// The continuation is indented further than the rows of a table, so that it does not look like a row.
    pub(crate) fn fitted(&self, width: usize) -> Page {
        let mut page = Page::default();
        for line in self.text.lines() {
            page.broken(line, width);
        }
        page
    }

    /// Appends a line, broken into lines of at most `width` columns as in [`Page::fitted`].
    fn broken(&mut self, line: &str, width: usize) {
        let indent = line.len() - line.trim_start_matches(' ').len();
        let hang = (indent + 2).clamp(4, 12).min(width / 2);
        let (mut column, mut gap, mut is_begun) = (0, 0, false);
        for (number, word) in line.split(' ').enumerate() {
            gap += usize::from(number > 0);
            if word.is_empty() {
                continue;
            }
            if is_begun && column + gap + seen(word) > width {
                self.text.push('\n');
                (column, gap) = (0, hang);
            }
            self.text.extend(std::iter::repeat_n(' ', gap));
            column += gap;
            (gap, is_begun) = (0, true);
            let mut rest = word;
            while let Some(c) = rest.chars().next() {
                let escape = colour(rest);
                let (piece, behind) = rest.split_at(escape.unwrap_or(c.len_utf8()));
                let wide = escape.map_or(c.width().unwrap_or(0), |_| 0);
                if column + wide > width && column > hang {
                    self.text.push('\n');
                    self.text.extend(std::iter::repeat_n(' ', hang));
                    column = hang;
                }
                self.text.push_str(piece);
                column += wide;
                rest = behind;
            }
        }
        self.end();
    }

    /// Returns the text of the page with its escape codes.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}

/// Breaks a text at spaces into lines of at most `most` columns. A longer word gets a line of its own. If `most` is
/// `None`, the text stays one line.
pub(crate) fn broken(words: &str, most: Option<usize>) -> String {
    let mut lines = String::new();
    let mut column = 0;
    for word in words.split(' ') {
        if column > 0 && most.is_some_and(|most| column + 1 + seen(word) > most) {
            lines.push('\n');
            column = 0;
        } else if column > 0 {
            lines.push(' ');
            column += 1;
        }
        lines.push_str(word);
        column += seen(word);
    }
    lines
}

/// Returns the width of a text in columns, without the escape sequences for colours.
pub(crate) fn seen(text: &str) -> usize {
    let Some(at) = text.find('\u{1b}') else {
        return text.width();
    };
    let (before, rest) = text.split_at(at);
    let behind = &rest[colour(rest).unwrap_or(1)..];
    before.width() + seen(behind)
}

/// Returns the length, in bytes, of the colour escape sequence at the beginning of a text; `None` if there is none.
fn colour(text: &str) -> Option<usize> {
    let inside = text.strip_prefix("\u{1b}[")?;
    let digits = inside.find(|c: char| !c.is_ascii_digit() && c != ';')?;
    inside[digits..].starts_with('m').then_some(2 + digits + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_from_files_cannot_break_lines_or_set_colours() {
        let mut page = Page::new("a\n\u{1b}[31mb\rc");
        page.literal("x\n");
        assert_eq!(page.text(), "a \u{fffd}[31mb c\nx\n");
    }

    #[test]
    fn a_line_wider_than_the_terminal_continues_indented_without_loss() {
        let mut page = Page::default();
        page.styled(Style::new().bold(), "one two");
        page.words(" three ");
        page.line("abcdefghijklmnopqrstuvwxyz");
        page.line("      石石石石 石石石 a");
        page.line("  a  b");
        let plain = page.fitted(16).text().replace("\u{1b}[1m", "");
        let lines: Vec<&str> = plain.lines().collect();
        let expected = [
            "one two\u{1b}[0m three",
            "    abcdefghijkl",
            "    mnopqrstuvwx",
            "    yz",
            "      石石石石",
            "        石石石 a",
            "  a  b",
        ];
        assert_eq!(lines, expected);
        assert!(lines.iter().all(|line| seen(line) <= 16));
        assert_eq!(page.fitted(200), page);
    }

    #[test]
    fn a_block_keeps_only_line_breaks_and_colours() {
        let mut page = Page::default();
        page.block("\u{1b}[1;31ma\u{1b}[0m\nb\u{1b}[2Jc\u{1b}]0;t\u{7}\u{1b}");
        let kept = "\u{1b}[1;31ma\u{1b}[0m\nb\u{fffd}[2Jc\u{fffd}]0;t\u{fffd}\u{fffd}\n";
        assert_eq!(page.text(), kept);
    }
}
