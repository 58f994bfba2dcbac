//! [`Mistake`]: what is wrong with a text or a value, with a message and a remedy. [`Problem`]: a mistake at its place
//! in a text.
//!
//! What was expected and what was found are values until the message is written, so that a format can give a remedy of
//! its own ([`Dialect`]).

use std::fmt;
use std::ops::Range;

use super::path::Trail;
use super::tree::NodeKind;

/// The kind of a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The bytes are not UTF-8.
    NotUtf8,
    /// The text is empty.
    Empty,
    /// The text ends before its brackets or quotes are closed.
    EndsEarly,
    /// Too many brackets are open at once.
    TooDeep,
    /// The text is written in another format.
    OtherFormat,
    /// The text does not follow the grammar of JSON or TOML.
    Syntax,
    /// A value has the wrong type.
    WrongType,
    /// A list has too many or too few entries.
    WrongLength,
    /// The object has no such key.
    UnknownKey,
    /// A key occurs twice in one object.
    DuplicateKey,
    /// A required key is missing.
    MissingKey,
    /// A word is not an allowed value.
    UnknownChoice,
    /// A number is too large.
    TooLarge,
    /// There are more mistakes than the list contains.
    More,
}

/// The kind of a mistake, a message with what was found, and a remedy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The kind.
    pub kind: Kind,
    /// The description.
    pub message: String,
    /// The remedy.
    pub help: String,
}

impl Mistake {
    /// Creates a mistake.
    pub fn new(kind: Kind, message: impl Into<String>, help: impl Into<String>) -> Mistake {
        Mistake { kind, message: message.into(), help: help.into() }
    }
}

/// What was expected in place of a value of the wrong type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expected<'a> {
    /// A number.
    Number,
    /// A whole number.
    Whole,
    /// A string.
    Text,
    /// `true` or `false`.
    Flag,
    /// A list.
    List,
    /// An object.
    Object,
    /// A point [x, y].
    Point,
    /// A vector [x, y].
    Vector,
    /// Anything else, in words that complete the sentences "expected …" and "write … here".
    Other(&'a str),
}

impl fmt::Display for Expected<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Expected::Number => "a number",
            Expected::Whole => "a whole number",
            Expected::Text => "a string",
            Expected::Flag => "true or false",
            Expected::List => "a list",
            Expected::Object => "an object",
            Expected::Point => "a point [x, y]",
            Expected::Vector => "a vector [x, y]",
            Expected::Other(words) => words,
        })
    }
}

/// The cause of a mistake for which a format may have a remedy of its own.
#[derive(Clone, Copy, Debug)]
pub enum Cause<'a> {
    /// A value of the wrong type.
    WrongType {
        /// The path of the value.
        at: &'a Trail<'a>,
        /// The right type.
        expected: Expected<'a>,
        /// The value that was found.
        found: &'a NodeKind<'a>,
        /// The value as it is written in the text; shortened if it is long.
        written: &'a str,
    },
    /// A key that the object does not have. Contains this key and the known keys.
    UnknownKey(&'a str, &'a [&'a str]),
    /// A required key that is missing.
    MissingKey(&'a str),
    /// The text is empty.
    Empty,
    /// The text is written in this other format instead of JSON.
    OtherFormat(&'a str),
    /// The text does not follow the grammar of TOML.
    NotToml,
    /// Too many brackets are open at once.
    TooDeep,
    /// A comment in JSON.
    Comment,
    /// A word such as `NaN` in place of a number.
    NotANumber,
}

/// What the reader must know about a format to write messages about it.
#[derive(Clone, Copy, Debug)]
pub struct Dialect {
    /// What a text in this format describes, such as "scene".
    pub noun: &'static str,
    /// Returns the remedy for a cause, if the format has a better one than the reader.
    pub remedy: fn(Cause<'_>) -> Option<String>,
    /// The number of lines before the text in its file. Messages that name another place count these lines too.
    pub lines_before: usize,
}

impl Dialect {
    /// Creates a dialect without remedies of its own. `noun` says what a text describes, such as "options".
    pub const fn plain(noun: &'static str) -> Dialect {
        Dialect { noun, remedy: |_| None, lines_before: 0 }
    }

    /// Returns the remedy of this format for a cause, or else the general remedy `general`.
    pub(super) fn help(&self, cause: Cause<'_>, general: impl Into<String>) -> String {
        (self.remedy)(cause).unwrap_or_else(|| general.into())
    }
}

/// A mistake in a text, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Problem {
    /// The path of the value or key, such as `widths.force` or `arrows[2]`; empty for the whole text.
    pub path: String,
    /// Line in the text, from 1.
    pub line: usize,
    /// Column in that line in characters, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// The remedy.
    pub help: String,
}

/// All problems of a text, in the order of the text; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems(pub Vec<Problem>);

/// Writes a problem with its line, column, path and remedy. `place` is the line and the column; the line is 0 if there
/// is no text.
pub fn write_problem(
    f: &mut fmt::Formatter<'_>,
    (line, column): (usize, usize),
    path: &str,
    message: &str,
    help: &str,
) -> fmt::Result {
    if line > 0 {
        write!(f, "line {line}, column {column}{}", if path.is_empty() { ": " } else { ", " })?;
    }
    if !path.is_empty() {
        write!(f, "{path}: ")?;
    }
    f.write_str(message)?;
    if !help.is_empty() {
        write!(f, "\n  help: {help}")?;
    }
    Ok(())
}

/// Writes one problem on each line.
pub fn write_problems(f: &mut fmt::Formatter<'_>, list: &[impl fmt::Display]) -> fmt::Result {
    for (i, problem) in list.iter().enumerate() {
        write!(f, "{}{problem}", if i > 0 { "\n" } else { "" })?;
    }
    Ok(())
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_problem(f, (self.line, self.column), &self.path, &self.message, &self.help)
    }
}

impl fmt::Display for Problems {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_problems(f, &self.0)
    }
}

impl std::error::Error for Problem {}
impl std::error::Error for Problems {}

/// A mistake and the range of bytes in which it lies, in a text that cannot be parsed.
#[derive(Clone, Debug)]
pub struct Broken {
    /// The range of bytes.
    pub span: Range<usize>,
    /// The mistake.
    pub mistake: Mistake,
}
