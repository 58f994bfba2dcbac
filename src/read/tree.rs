//! [`Tree`]: the syntax tree of a JSON or TOML text, with the position of every value and key, and the parser of JSON.
//!
//! The entries of all lists are stored in one vector, and those of all objects in another. A file with many points
//! therefore needs few allocations.
//!
//! The parser accepts strict JSON (RFC 8259), like serde_json; a test compares both parsers. There is one difference: a
//! number that is too large for a float is not an error here, but is reported later. The parser stops at the first
//! error, and [`SyntaxError`] describes what was expected at this place.

use std::borrow::Cow;
use std::ops::Range;

/// The largest number of brackets that may be open at the same time.
pub const MAX_DEPTH: usize = 127;

/// The syntax tree of a text.
#[derive(Debug)]
pub struct Tree<'t> {
    /// The topmost value.
    pub root: Node<'t>,
    /// The entries of all lists.
    pub items: Vec<Node<'t>>,
    /// The entries of all objects.
    pub entries: Vec<Entry<'t>>,
}

impl<'t> Tree<'t> {
    /// Returns the entries of a list.
    pub fn items(&self, list: &List) -> &[Node<'t>] {
        &self.items[list.0.clone()]
    }

    /// Returns the entries of an object, in the order of the text. A key may occur twice.
    pub fn entries(&self, object: &Object) -> &[Entry<'t>] {
        &self.entries[object.0.clone()]
    }

    /// Parses another text and returns its value, which the caller puts somewhere in the tree. The value and its parts
    /// count as empty ranges of bytes at `home`.
    pub fn add(&mut self, text: &'t str, home: usize) -> Result<Node<'t>, SyntaxError> {
        let (items, entries) = (self.items.len(), self.entries.len());
        let added = self.read(text)?;
        self.items[items..].iter_mut().for_each(|item| item.range = home..home);
        for entry in &mut self.entries[entries..] {
            (entry.name_range, entry.value.range) = (home..home, home..home);
        }
        Ok(Node { range: home..home, ..added })
    }

    /// Parses a text that must contain exactly one JSON value.
    fn read(&mut self, text: &'t str) -> Result<Node<'t>, SyntaxError> {
        let mut parser = Parser {
            text,
            bytes: text.as_bytes(),
            at: 0,
            open: Vec::new(),
            items: std::mem::take(&mut self.items),
            entries: std::mem::take(&mut self.entries),
            loose_items: Vec::new(),
            loose_entries: Vec::new(),
        };
        let root = parser.document();
        (self.items, self.entries) = (parser.items, parser.entries);
        root
    }
}

/// The range of a list's entries within the entries of all lists.
#[derive(Clone, Debug, PartialEq)]
pub struct List(pub Range<usize>);

impl List {
    /// Returns the number of entries in the list.
    pub fn len(&self) -> usize {
        self.0.len()
    }
}

/// The range of an object's entries within the entries of all objects.
#[derive(Clone, Debug, PartialEq)]
pub struct Object(pub Range<usize>);

/// A value with its position in the text.
#[derive(Clone, Debug, PartialEq)]
pub struct Node<'t> {
    /// The range of its bytes in the text.
    pub range: Range<usize>,
    /// Its kind and content.
    pub kind: NodeKind<'t>,
}

/// The kind and content of a value.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeKind<'t> {
    /// `null`
    Null,
    /// `true` or `false`
    Flag(bool),
    /// A number; infinite if it is too large for a float.
    Number(f64),
    /// A string, with its escape sequences resolved.
    Text(Cow<'t, str>),
    /// A list.
    List(List),
    /// An object; TOML calls it a table.
    Object(Object),
    /// A date or time of TOML.
    Date,
}

/// A key and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry<'t> {
    /// The key, with its escape sequences resolved.
    pub name: Cow<'t, str>,
    /// The range of the key's bytes in the text, including the quotes.
    pub name_range: Range<usize>,
    /// The value.
    pub value: Node<'t>,
}

/// The place and the reason of an error in a JSON text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// The index of the byte at which the error lies.
    pub at: usize,
    /// The reason.
    pub why: Why,
}

/// The reason why a text is not JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// The text ends too early. Contains the innermost open bracket or quote, with the index of its byte; `None` if
    /// nothing is open.
    End(Option<(char, usize)>),
    /// More brackets are open than [`MAX_DEPTH`].
    TooDeep,
    /// A string that began at this byte holds a line break or another control character.
    Control(usize),
    /// A backslash does not begin a valid escape.
    Escape,
    /// An escape is half of a surrogate pair.
    Surrogate,
    /// A closing bracket follows the comma at this byte.
    TrailingComma(usize),
    /// A value is expected.
    Value,
    /// A key in quotes is expected.
    Key,
    /// A colon is expected.
    Colon,
    /// A comma, or this bracket, is expected.
    Comma(char),
    /// The end of the text is expected.
    Behind,
}

/// Parses a text that must contain exactly one JSON value.
pub fn parse(text: &str) -> Result<Tree<'_>, SyntaxError> {
    let root = Node { range: 0..0, kind: NodeKind::Null };
    let items = Vec::with_capacity(text.len() / MIN_BYTES_PER_ITEM);
    let mut tree = Tree { root, items, entries: Vec::new() };
    tree.root = tree.read(text)?;
    Ok(tree)
}

/// An estimate of the number of bytes of text for each list entry, used to reserve memory.
const MIN_BYTES_PER_ITEM: usize = 8;

struct Parser<'t> {
    text: &'t str,
    bytes: &'t [u8],
    at: usize,
    /// The open brackets, each with its byte in the text.
    open: Vec<(char, usize)>,
    items: Vec<Node<'t>>,
    entries: Vec<Entry<'t>>,
    /// The entries of the lists that are still open, those of the innermost list last.
    loose_items: Vec<Node<'t>>,
    /// The entries of the objects that are still open, those of the innermost object last.
    loose_entries: Vec<Entry<'t>>,
}

impl<'t> Parser<'t> {
    fn document(&mut self) -> Result<Node<'t>, SyntaxError> {
        self.blanks();
        let root = self.value()?;
        self.blanks();
        if self.peek().is_some() { Err(self.fault(Why::Behind)) } else { Ok(root) }
    }

    fn peek(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn blanks(&mut self) {
        while let Some(b' ' | b'\t' | b'\n' | b'\r') = self.peek() {
            self.at += 1;
        }
    }

    /// Returns the error `why` at the current byte. If the text ends here, the error says instead that the text ends
    /// too early.
    fn fault(&self, why: Why) -> SyntaxError {
        let why = match self.peek() {
            None => Why::End(self.open.last().copied()),
            Some(_) => why,
        };
        SyntaxError { at: self.at, why }
    }

    fn value(&mut self) -> Result<Node<'t>, SyntaxError> {
        let start = self.at;
        let kind = match self.peek() {
            Some(b'{') => NodeKind::Object(self.object()?),
            Some(b'[') => NodeKind::List(self.list()?),
            Some(b'"') => NodeKind::Text(self.string()?),
            Some(b'-' | b'0'..=b'9') => NodeKind::Number(self.number()?),
            _ => self.word()?,
        };
        Ok(Node { range: start..self.at, kind })
    }

    fn word(&mut self) -> Result<NodeKind<'t>, SyntaxError> {
        let words = [("null", NodeKind::Null), ("true", NodeKind::Flag(true)), ("false", NodeKind::Flag(false))];
        for (word, kind) in words {
            if self.text[self.at..].starts_with(word) {
                self.at += word.len();
                return Ok(kind);
            }
        }
        Err(self.fault(Why::Value))
    }

    fn number(&mut self) -> Result<f64, SyntaxError> {
        let start = self.at;
        let broken = SyntaxError { at: start, why: Why::Value };
        self.at += usize::from(self.peek() == Some(b'-'));
        let whole = self.digits();
        let leading_zero = whole > 1 && self.bytes[self.at - whole] == b'0';
        if whole == 0 || leading_zero {
            return Err(broken);
        }
        if self.peek() == Some(b'.') {
            self.at += 1;
            if self.digits() == 0 {
                return Err(broken);
            }
        }
        if let Some(b'e' | b'E') = self.peek() {
            self.at += 1;
            self.at += usize::from(matches!(self.peek(), Some(b'+' | b'-')));
            if self.digits() == 0 {
                return Err(broken);
            }
        }
        self.text[start..self.at].parse().map_err(|_| broken)
    }

    fn digits(&mut self) -> usize {
        let start = self.at;
        while let Some(b'0'..=b'9') = self.peek() {
            self.at += 1;
        }
        self.at - start
    }

    fn enter(&mut self, bracket: char) -> Result<(), SyntaxError> {
        if self.open.len() == MAX_DEPTH {
            return Err(self.fault(Why::TooDeep));
        }
        self.open.push((bracket, self.at));
        self.at += 1;
        self.blanks();
        Ok(())
    }

    fn leave(&mut self) {
        self.open.pop();
        self.at += 1;
    }

    /// Reads the comma after a value in a list or object. Returns true if a comma and another entry follow the value,
    /// and false if the closing bracket `close` follows. The bracket itself is not read.
    fn another(&mut self, close: char) -> Result<bool, SyntaxError> {
        self.blanks();
        let comma = self.at;
        match self.peek() {
            Some(b',') => self.at += 1,
            Some(c) if char::from(c) == close => return Ok(false),
            _ => return Err(self.fault(Why::Comma(close))),
        }
        self.blanks();
        if self.peek().map(char::from) == Some(close) {
            return Err(self.fault(Why::TrailingComma(comma)));
        }
        Ok(true)
    }

    fn list(&mut self) -> Result<List, SyntaxError> {
        self.enter('[')?;
        let outer = self.loose_items.len();
        let mut more = self.peek() != Some(b']');
        while more {
            let item = self.value()?;
            self.loose_items.push(item);
            more = self.another(']')?;
        }
        self.leave();
        let first = self.items.len();
        self.items.extend(self.loose_items.drain(outer..));
        Ok(List(first..self.items.len()))
    }

    fn object(&mut self) -> Result<Object, SyntaxError> {
        self.enter('{')?;
        let outer = self.loose_entries.len();
        let mut more = self.peek() != Some(b'}');
        while more {
            let start = self.at;
            if self.peek() != Some(b'"') {
                return Err(self.fault(Why::Key));
            }
            let name = self.string()?;
            let name_range = start..self.at;
            self.blanks();
            if self.peek() != Some(b':') {
                return Err(self.fault(Why::Colon));
            }
            self.at += 1;
            self.blanks();
            let value = self.value()?;
            self.loose_entries.push(Entry { name, name_range, value });
            more = self.another('}')?;
        }
        self.leave();
        let first = self.entries.len();
        self.entries.extend(self.loose_entries.drain(outer..));
        Ok(Object(first..self.entries.len()))
    }
}

impl<'t> Parser<'t> {
    /// Reads a JSON string and replaces its escape sequences. A string without escape sequences is borrowed from the
    /// text.
    fn string(&mut self) -> Result<Cow<'t, str>, SyntaxError> {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// True if the parser of this module and serde_json read the same values from a text, or both reject it.
    fn agrees(text: &str) -> bool {
        fn value(tree: &Tree<'_>, node: &Node<'_>) -> serde_json::Value {
            match &node.kind {
                NodeKind::Null => serde_json::Value::Null,
                NodeKind::Flag(flag) => (*flag).into(),
                NodeKind::Number(x) => (*x).into(),
                NodeKind::Text(text) => text.as_ref().into(),
                NodeKind::Date => unreachable!("JSON has no dates"),
                NodeKind::List(list) => (tree.items(list).iter().map(|n| value(tree, n))).collect(),
                NodeKind::Object(object) => (tree.entries(object).iter())
                    .map(|e| (e.name.clone().into_owned(), value(tree, &e.value)))
                    .collect(),
            }
        }
        /// Converts every number to a float, because the syntax tree stores all numbers as floats.
        fn floats(value: serde_json::Value) -> serde_json::Value {
            match value {
                serde_json::Value::Number(x) => x.as_f64().into(),
                serde_json::Value::Array(list) => list.into_iter().map(floats).collect(),
                serde_json::Value::Object(map) => map.into_iter().map(|(k, v)| (k, floats(v))).collect(),
                other => other,
            }
        }
        match (parse(text), serde_json::from_str(text)) {
            (Ok(tree), Ok(other)) => value(&tree, &tree.root) == floats(other),
            (Err(_), Err(_)) => true,
            // A number that is too large for a float is an error for serde_json, but not for the syntax tree. It is
            // reported later, when values are read.
            (Ok(_), Err(error)) => error.to_string().contains("number out of range"),
            (Err(_), Ok(_)) => false,
        }
    }

    #[test]
    fn the_same_texts_are_accepted_as_by_serde_json_with_the_same_values() {
        let sound = [
            r#"{ "a": [1, -2.5e3, 0, -0, 1E+2, 0.1e-7], "é\n\u00e9\ud83d\ude00\/": { "b": [] }, "c": {} }"#,
            "\t[ true , false, null, \"\", [[[]]], \"\\\"\\\\\\b\\f\\r\\t\" ]\r\n",
            "123456789.123456789",
            "\"\u{7f}\u{ffff}\"",
        ];
        for text in sound {
            assert!(parse(text).is_ok(), "{text}");
            assert!(agrees(text), "{text}");
        }
        for text in sound {
            for (at, _) in text.char_indices() {
                assert!(agrees(&text[..at]), "{}", &text[..at]);
                let end = at + text[at..].chars().next().map_or(0, char::len_utf8);
                for other in ["", "\"", "[", "}", ",", ":", "0", "-", ".", "e", "\\", "u", "\n", " ", "\u{1}", "t"] {
                    let changed = format!("{}{other}{}", &text[..at], &text[end..]);
                    assert!(agrees(&changed), "{changed}");
                }
            }
        }
        for wrong in ["", " ", "nulll", "1 2", "[1,]", "{\"a\":1,}", "01", "1.", "+1", "\u{a0}1"] {
            assert!(parse(wrong).is_err() && agrees(wrong), "{wrong}");
        }
    }

    #[test]
    fn brackets_may_be_nested_up_to_the_limit() {
        let nested = |depth: usize| format!("{}{}", "[".repeat(depth), "]".repeat(depth));
        assert!(parse(&nested(MAX_DEPTH)).is_ok());
        let fault = parse(&nested(MAX_DEPTH + 1)).expect_err("too deep");
        assert_eq!((fault.at, fault.why), (MAX_DEPTH, Why::TooDeep));
    }
}
