//! [`Given`]: the keys of one JSON object that ask for something, such as a figure.
//!
//! Every reading of a key also says that the key exists. A struct of options is therefore its own list of keys, and can
//! read itself from the same object as others.

use super::{
    Dialect, Expected, Fields, Kind, Mark, Mistake, Node, NodeKind, Notation, Problems, Reader, Trail, from_text,
};
use crate::text::Word;

/// The keys of one object, and the reader that collects their mistakes.
#[derive(Debug, Default)]
pub struct Given<'r, 's> {
    object: Option<(&'r mut Reader<'s>, Fields<'s>)>,
    known: Vec<&'static str>,
}

/// Reads what a user asks for from the text of a JSON object.
///
/// # Errors
/// All problems of the text, in its order.
pub fn requested<T>(text: &str, dialect: &Dialect, read: impl Fn(&mut Given<'_, '_>) -> T) -> Result<T, Problems> {
    let mut names = Given::none();
    read(&mut names);
    from_text(text, Notation::Json, dialect, |reader, node, at| {
        let fields = reader.object(node, at, &names.known)?;
        Some(read(&mut Given { object: Some((reader, fields)), known: Vec::new() }))
    })
}

impl<'s> Given<'_, 's> {
    /// No keys: every option has its default value.
    pub fn none() -> Given<'static, 'static> {
        Given::default()
    }

    /// Reads the value of `key` with the function `read`. `None` if the key is absent, if its value is `null`, or if it
    /// does not fit.
    pub fn key<T>(
        &mut self,
        key: &'static str,
        read: impl FnOnce(&mut Reader<'s>, &'s Node<'s>, &Trail<'_>) -> Option<T>,
    ) -> Option<T> {
        self.known.push(key);
        let (reader, fields) = self.object.as_mut()?;
        reader.optional(*fields, &Trail::Top, key, read)
    }

    /// Reads `true` or `false`. An absent key is false.
    pub fn flag(&mut self, key: &'static str) -> bool {
        self.key(key, |r, node, at| r.flag(node, at)).unwrap_or_default()
    }

    /// Reads a string.
    pub fn text(&mut self, key: &'static str) -> Option<String> {
        self.key(key, |r, node, at| r.text(node, at))
    }

    /// Reads a finite number.
    pub fn number(&mut self, key: &'static str) -> Option<f64> {
        self.key(key, |r, node, at| r.number(node, at))
    }

    /// Reads a whole number in a range.
    pub fn whole(&mut self, key: &'static str, range: [u32; 2]) -> Option<u32> {
        self.key(key, |r, node, at| r.whole_within(node, at, range))
    }

    /// Reads the name of a value.
    pub fn word<T: Word>(&mut self, key: &'static str) -> Option<T> {
        self.key(key, word)
    }

    /// Reads a number or a string with `parse`, which reads the same option on the command line.
    pub fn value<T>(&mut self, key: &'static str, parse: impl Fn(&str) -> Result<T, String>) -> Option<T> {
        self.key(key, |r, node, at| value(r, node, at, &parse))
    }

    /// Reads a list in which `read` reads each entry, or one entry without a list.
    pub fn list<T>(
        &mut self,
        key: &'static str,
        read: impl Fn(&mut Reader<'s>, &'s Node<'s>, &Trail<'_>) -> Option<T>,
    ) -> Option<Vec<T>> {
        self.key(key, |r, node, at| entries(r, node, at, read))
    }

    /// Reads the names of some values. `true` asks for all values, which is an empty list, and `false` for none.
    pub fn all_or_some<T: Word>(&mut self, key: &'static str) -> Option<Vec<T>> {
        self.key(key, |r, node, at| match node.kind {
            NodeKind::Flag(all) => all.then(Vec::new),
            _ => entries(r, node, at, word),
        })
    }
}

/// Reads a list in which `read` reads each entry, or one entry without a list. `None` if some entry does not fit.
fn entries<'s, T>(
    r: &mut Reader<'s>,
    node: &'s Node<'s>,
    at: &Trail<'_>,
    read: impl Fn(&mut Reader<'s>, &'s Node<'s>, &Trail<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    let NodeKind::List(list) = &node.kind else {
        return Some(vec![read(r, node, at)?]);
    };
    let entries = r.items(list).iter().enumerate();
    let read: Vec<Option<T>> = entries.map(|(i, entry)| read(r, entry, &at.index(i))).collect();
    read.into_iter().collect()
}

/// Reads the name of a value. An underscore counts as a hyphen.
pub fn word<T: Word>(r: &mut Reader<'_>, node: &Node<'_>, at: &Trail<'_>) -> Option<T> {
    let found = match &node.kind {
        NodeKind::Text(text) => T::from_word(text),
        _ => None,
    };
    found.or_else(|| {
        let shown = T::all().into_iter().filter(|v| !v.is_hidden());
        let names: Vec<(&str, T)> = shown.map(|v| (v.alias().unwrap_or(v.word()), v)).collect();
        r.choice(node, at, &names)
    })
}

/// Reads a number or a string with a function that parses a text.
pub fn value<T>(
    r: &mut Reader<'_>,
    node: &Node<'_>,
    at: &Trail<'_>,
    parse: impl Fn(&str) -> Result<T, String>,
) -> Option<T> {
    let parsed = match &node.kind {
        NodeKind::Text(text) => parse(text),
        NodeKind::Number(_) => parse(&r.written(node)),
        _ => {
            r.wrong(node, at, Expected::Other("a number or a string"));
            return None;
        }
    };
    parsed.map_err(|why| r.report(at, Mark::Value, Mistake::new(Kind::WrongType, why, ""))).ok()
}
