//! Reads values from JSON and TOML, and reports all mistakes at once, each with line, column, path and remedy. Scene
//! files, style files, settings and options are read in this way.
//!
//! A type implements [`Read`]: it reads itself from a value of the syntax tree ([`tree::Tree`]) with the help of the
//! [`Reader`], which collects the mistakes. [`from_text`] reads a whole text.
//!
//! The macro `read_keys!` implements [`Read`] for a struct whose fields are keys. All keys may be absent; they then keep
//! the value of `Default`. After `as` stands the function that reads the value, for ranges and words; without it, the
//! value is read as its type says. A field that is not listed is no key:
//!
//! ```ignore
//! #[derive(Default)]
//! pub struct Page {
//!     /// The title.
//!     pub title: Option<String>,
//!     /// The width in millimetres.
//!     pub width: Option<f64>,
//! }
//! read_keys! { Page { title, width as |r, node, at| r.number_within(node, at, [2.0, 5080.0], "a width").map(Some) } }
//! let page: Page = from_text(r#"{ "width": 180 }"#, Notation::Json, &Dialect::plain("page"), Page::read)?;
//! ```

pub mod file;
mod given;
pub mod mistake;
pub mod path;
pub mod reader;
pub mod source;
pub mod syntax;
#[cfg(feature = "toml")]
mod toml;
pub mod tree;

pub use given::{Given, requested, word};
pub use mistake::{Broken, Cause, Dialect, Expected, Kind, Mistake, Problem, Problems};
pub use path::{Path, Segment, Trail};
pub use reader::{Fields, Finding, Reader};
pub use source::{Mark, Notation, Source};
pub use tree::{Node, NodeKind};

/// A value that can be read from a syntax tree.
pub trait Read: Sized {
    /// Reads the value `node`, whose path in the text is `at`. If it does not fit, reports this to the reader and
    /// returns `None`.
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Self>;
}

/// A struct whose keys are all optional: an object changes only the fields whose keys it contains.
pub trait Update {
    /// Reads the object `node`, whose path in the text is `at`, and sets the fields whose keys it contains.
    fn update<'s>(&mut self, r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>);
}

/// Reads a text. `read` reads the topmost value, for example `Options::read`.
///
/// # Errors
/// All problems of the text, in its order.
pub fn from_text<T>(
    text: &str,
    notation: Notation,
    dialect: &Dialect,
    read: impl for<'s> FnOnce(&mut Reader<'s>, &'s Node<'s>, &Trail<'_>) -> Option<T>,
) -> Result<T, Problems> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = match notation {
        Notation::Json => syntax::json(text, dialect).map_err(|broken| vec![broken]),
        #[cfg(feature = "toml")]
        Notation::Toml => syntax::toml(text, dialect),
    };
    let source = source.map_err(|broken| {
        let plain = Source::plain(text);
        Problems(broken.into_iter().map(|b| plain.problem(b.span.start, "", b.mistake)).collect())
    })?;
    let mut reader = Reader::new(&source, dialect);
    let value = source.tree.as_ref().and_then(|tree| read(&mut reader, &tree.root, &Trail::Top));
    match (value, reader.problems()) {
        (Some(value), None) => Ok(value),
        (_, problems) => Err(problems.unwrap_or(Problems(Vec::new()))),
    }
}

/// Implements [`Read`] and [`Update`] for a struct, for the listed fields, such as `width` or `page.width`. A field may
/// have another name in the text, which stands after it in quotes. After `as` stands the function that reads its value.
macro_rules! read_keys {
    ($name:ty { $($($field:ident).+ $($key:literal)? $(as $how:expr)?),* $(,)? }) => {
        impl $crate::read::Update for $name {
            fn update<'s>(
                &mut self,
                r: &mut $crate::read::Reader<'s>,
                node: &'s $crate::read::Node<'s>,
                at: &$crate::read::Trail<'_>,
            ) {
                if let Some(fields) = r.object(node, at, &[$([$($key,)? stringify!($($field).+)][0]),*]) {
                    $(
                        let key = [$($key,)? stringify!($($field).+)][0];
                        if let Some(value) = r.optional(fields, at, key, $crate::read::how!($($how)?)) {
                            self.$($field).+ = value;
                        }
                    )*
                }
            }
        }

        impl $crate::read::Read for $name {
            fn read<'s>(
                r: &mut $crate::read::Reader<'s>,
                node: &'s $crate::read::Node<'s>,
                at: &$crate::read::Trail<'_>,
            ) -> Option<Self> {
                let mut value = <$name>::default();
                $crate::read::Update::update(&mut value, r, node, at);
                Some(value)
            }
        }
    };
}

/// The function that reads a value: the given one, or that of the value's type.
macro_rules! how {
    () => {
        $crate::read::Read::read
    };
    ($how:expr) => {
        $how
    };
}

pub(crate) use {how, read_keys};

impl Read for f64 {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<f64> {
        r.number(node, at)
    }
}

impl Read for bool {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<bool> {
        r.flag(node, at)
    }
}

impl Read for String {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<String> {
        r.text(node, at)
    }
}

/// A point [x, y]. [`Reader::vector`] reads a vector.
impl Read for [f64; 2] {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<[f64; 2]> {
        r.point(node, at)
    }
}

/// A value that may be absent. `null` counts as absent.
impl<T: Read> Read for Option<T> {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Option<T>> {
        match node.kind {
            NodeKind::Null => Some(None),
            _ => T::read(r, node, at).map(Some),
        }
    }
}

/// A list. An entry that does not fit is replaced by the default value, so that the other entries keep their indices.
impl<T: Read + Default> Read for Vec<T> {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Vec<T>> {
        r.entries(node, at, T::read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, Default, PartialEq)]
    struct Page {
        title: Option<String>,
        width: Option<f64>,
        copies: u32,
        paper: u8,
        margins: Vec<f64>,
        draft: bool,
    }

    read_keys! {
        Page {
            title,
            width as |r, node, at| r.number_within(node, at, [2.0, 5080.0], "a width").map(Some),
            copies as |r, node, at| r.whole_within(node, at, [1, 9]),
            paper as |r, node, at| r.choice(node, at, &[("white", 1), ("none", 0)]),
            margins,
            draft,
        }
    }

    const PAGE: Dialect = Dialect::plain("page");

    #[test]
    fn options_are_read_from_an_object_and_keep_their_defaults() {
        let page = from_text(r#"{ "width": 180, "paper": "white", "title": null }"#, Notation::Json, &PAGE, Page::read);
        assert_eq!(page, Ok(Page { width: Some(180.0), paper: 1, ..Page::default() }));
        let mut page = page.expect("options");
        let changed = from_text("{ \"draft\": true }", Notation::Json, &PAGE, |r, node, at| {
            page.update(r, node, at);
            Some(())
        });
        assert!(changed.is_ok() && page.draft && page.paper == 1);
    }

    #[test]
    fn all_problems_of_options_are_reported_at_once_with_their_places() {
        let text = "{ \"widht\": 3, \"width\": 1,\n \"paper\": \"whit\", \"copies\": 1.5, \"margins\": [1, \"2\"] }";
        let problems = from_text(text, Notation::Json, &PAGE, Page::read).expect_err("wrong").to_string();
        let messages: Vec<&str> = problems.lines().collect();
        assert_eq!(
            messages,
            [
                "line 1, column 3, widht: unknown key `widht`",
                "  help: the nearest known key is `width`",
                "line 1, column 24, width: expected a width from 2 to 5080, found the number 1",
                "  help: write a width from 2 to 5080 here",
                "line 2, column 11, paper: expected \"white\" or \"none\", found \"whit\"",
                "  help: did you mean \"white\"?",
                "line 2, column 29, copies: expected a whole number from 1 to 9, found the number 1.5",
                "  help: write a whole number from 1 to 9 here",
                "line 2, column 49, margins[1]: expected a number, found the string \"2\"",
                "  help: write 2 without quotes",
            ]
        );
        for (text, words) in [("", "the file is empty"), ("[]", "expected an object"), ("{} {}", "the end of the page")]
        {
            let problems = from_text(text, Notation::Json, &PAGE, Page::read).expect_err(text);
            assert!(problems.to_string().contains(words), "{problems}");
        }
    }

    #[cfg(feature = "toml")]
    #[test]
    fn toml_is_read_like_json() {
        let text = "title = 'a' # one\nwidth = 1_00.5\ncopies = 0x3\nmargins = [1, inf]\ndraft = 2020-01-01\n";
        let problems = from_text(text, Notation::Toml, &PAGE, Page::read).expect_err("wrong").to_string();
        assert_eq!(
            problems.lines().step_by(2).collect::<Vec<_>>(),
            [
                "line 4, column 15, margins[1]: the number inf is too large",
                "line 5, column 9, draft: expected true or false, found the date 2020-01-01",
            ]
        );
        let page = from_text("width = 100.5\n[other]", Notation::Toml, &PAGE, Page::read).expect_err("an unknown key");
        assert_eq!((page.0[0].line, page.0[0].path.as_str()), (2, "other"));
        let broken = from_text("a = 1\nb = ", Notation::Toml, &PAGE, Page::read).expect_err("broken");
        assert_eq!(broken.0[0].line, 2);
    }
}
