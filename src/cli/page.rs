//! [`Page`]: what a person reads on a terminal, put together from words of ours and from words of others.
//!
//! The terminal takes nothing else. Words of ours are those that stand in this program, `&'static str`; all other words are
//! made one harmless line on their way in, so that no title begins a line, sets a colour or moves the cursor. A new message
//! cannot forget that: there is no other way onto the page.

use clap::builder::styling::Style;

use crate::text;

/// Lines for a terminal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Page {
    text: String,
}

impl Page {
    /// A page of one line.
    pub(crate) fn of(words: &str) -> Page {
        let mut page = Page::default();
        page.line(words);
        page
    }

    /// Text of this program, as it is.
    pub(crate) fn ours(&mut self, text: &'static str) {
        self.text.push_str(text);
    }

    /// Words that go on in the same line.
    pub(crate) fn words(&mut self, words: &str) {
        self.text.push_str(&text::line(words));
    }

    /// Likewise, in colour.
    pub(crate) fn styled(&mut self, style: Style, words: &str) {
        self.text.push_str(&style.render().to_string());
        self.words(words);
        self.text.push_str(&style.render_reset().to_string());
    }

    /// The line ends.
    pub(crate) fn end(&mut self) {
        self.text.push('\n');
    }

    /// Words, and the line ends.
    pub(crate) fn line(&mut self, words: &str) {
        self.words(words);
        self.end();
    }

    /// Several lines that are put together elsewhere, from parts each of which is [`text::line`]: lines and colours stay,
    /// every other control is made visible once more.
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

    /// Another page below.
    pub(crate) fn append(&mut self, page: &Page) {
        self.text.push_str(&page.text);
    }

    /// The page with its escape codes.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}

/// How many bytes of a text are an escape sequence that sets a colour, if it begins with one.
fn colour(text: &str) -> Option<usize> {
    let inside = text.strip_prefix("\u{1b}[")?;
    let digits = inside.find(|c: char| !c.is_ascii_digit() && c != ';')?;
    inside[digits..].starts_with('m').then_some(2 + digits + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foreign_words_begin_no_line_and_set_no_colour() {
        let mut page = Page::of("a\n\u{1b}[31mb\rc");
        page.ours("x\n");
        assert_eq!(page.text(), "a \u{fffd}[31mb c\nx\n");
    }

    #[test]
    fn a_block_keeps_lines_and_colours_alone() {
        let mut page = Page::default();
        page.block("\u{1b}[1;31ma\u{1b}[0m\nb\u{1b}[2Jc\u{1b}]0;t\u{7}\u{1b}");
        let kept = "\u{1b}[1;31ma\u{1b}[0m\nb\u{fffd}[2Jc\u{fffd}]0;t\u{fffd}\u{fffd}\n";
        assert_eq!(page.text(), kept);
    }
}
