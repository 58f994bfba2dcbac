//! Parses the strings of a JSON text.

use std::borrow::Cow;

use super::{Parser, SyntaxError, Why};

impl<'t> Parser<'t> {
    /// Reads a JSON string and replaces its escape sequences. A string without escape sequences is borrowed from the
    /// text.
    pub(super) fn string(&mut self) -> Result<Cow<'t, str>, SyntaxError> {
        let quote = self.at;
        self.at += 1;
        let mut start = self.at;
        let mut resolved: Option<String> = None;
        loop {
            match self.peek() {
                Some(b'"') => break,
                Some(b'\\') => {
                    let before = &self.text[start..self.at];
                    let c = self.escape(quote)?;
                    let text = resolved.get_or_insert_default();
                    text.push_str(before);
                    text.push(c);
                    start = self.at;
                }
                Some(0..0x20) => return Err(self.fault(Why::Control(quote))),
                Some(_) => self.at += 1,
                None => return Err(self.cut(quote)),
            }
        }
        let rest = &self.text[start..self.at];
        self.at += 1;
        Ok(match resolved {
            None => Cow::Borrowed(rest),
            Some(text) => Cow::Owned(text + rest),
        })
    }

    /// Returns the error for a text that ends within a string. `quote` is the byte at which the string begins.
    fn cut(&self, quote: usize) -> SyntaxError {
        SyntaxError { at: self.at, why: Why::End(Some(('"', quote))) }
    }

    fn escape(&mut self, quote: usize) -> Result<char, SyntaxError> {
        let start = self.at;
        let wrong = |why| SyntaxError { at: start, why };
        self.at += 1;
        let c = match self.peek() {
            Some(b'"') => '"',
            Some(b'\\') => '\\',
            Some(b'/') => '/',
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => {
                self.at += 1;
                let first = self.hex(quote, start)?;
                let is_first = (0xD800..0xDC00).contains(&first);
                if is_first && self.bytes[self.at..].starts_with(b"\\u") {
                    self.at += 2;
                    let second = self.hex(quote, start)?;
                    if !(0xDC00..0xE000).contains(&second) {
                        return Err(wrong(Why::Surrogate));
                    }
                    let code = 0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00);
                    return char::from_u32(code).ok_or(wrong(Why::Surrogate));
                }
                return char::from_u32(first).ok_or(wrong(Why::Surrogate));
            }
            Some(_) => return Err(wrong(Why::Escape)),
            None => return Err(self.cut(quote)),
        };
        self.at += 1;
        Ok(c)
    }

    /// Reads the four hexadecimal digits of a `\u` escape sequence and returns their value.
    fn hex(&mut self, quote: usize, start: usize) -> Result<u32, SyntaxError> {
        let mut code = 0;
        for _ in 0..4 {
            let digit = match self.peek() {
                None => return Err(self.cut(quote)),
                Some(c) => char::from(c).to_digit(16),
            };
            code = 16 * code + digit.ok_or(SyntaxError { at: start, why: Why::Escape })?;
            self.at += 1;
        }
        Ok(code)
    }
}
