//! [`Json`]: a JSON value whose keys keep their order. The macro `object!` makes an object of keys and values, and
//! [`write()`] writes it.

use std::borrow::Cow;
use std::io;

use serde::{Serialize, Serializer};

use super::Layout;
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::Motion;
use crate::mechanics::scene::Scene;
use crate::mechanics::scene::format::Lines;
use crate::text;

/// A JSON value.
#[derive(Clone, Debug)]
pub(super) enum Json<'a> {
    /// No value: an object leaves out the key.
    Absent,
    Null,
    Flag(bool),
    Count(usize),
    /// A number: −0 is written as 0.0, and a number that is not finite as `null`.
    Number(f64),
    Text(Cow<'a, str>),
    List(Vec<Json<'a>>),
    Object(Vec<(&'a str, Json<'a>)>),
}

/// Makes an object with these keys, in this order. A key whose value is `None` or [`Json::Absent`] is left out.
macro_rules! object {
    ($($key:ident: $value:expr),* $(,)?) => {
        $crate::products::result::json::Json::object([$((stringify!($key), $value.into())),*])
    };
}
pub(super) use object;

impl<'a> Json<'a> {
    pub(super) fn object(entries: impl IntoIterator<Item = (&'a str, Json<'a>)>) -> Json<'a> {
        Json::Object(entries.into_iter().filter(|(_, value)| !matches!(value, Json::Absent)).collect())
    }

    pub(super) fn list<T: Into<Json<'a>>>(entries: impl IntoIterator<Item = T>) -> Json<'a> {
        Json::List(entries.into_iter().map(Into::into).collect())
    }

    /// Returns `null` in place of no value.
    pub(super) fn or_null(value: impl Into<Json<'a>>) -> Json<'a> {
        match value.into() {
            Json::Absent => Json::Null,
            value => value,
        }
    }

    /// Leaves out an empty text, list or object.
    pub(super) fn unless_empty(self) -> Json<'a> {
        let is_empty = match &self {
            Json::Text(text) => text.is_empty(),
            Json::List(list) => list.is_empty(),
            Json::Object(entries) => entries.is_empty(),
            _ => false,
        };
        if is_empty { Json::Absent } else { self }
    }

    /// Returns the keys of an object with their values; none for another value.
    pub(super) fn into_entries(self) -> Vec<(&'a str, Json<'a>)> {
        match self {
            Json::Object(entries) => entries,
            _ => Vec::new(),
        }
    }

    /// Appends the keys of another object to this object.
    pub(super) fn and(mut self, more: Json<'a>) -> Json<'a> {
        if let Json::Object(entries) = &mut self {
            entries.extend(more.into_entries());
        }
        self
    }
}

impl Serialize for Json<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Json::Absent | Json::Null => serializer.serialize_unit(),
            Json::Flag(flag) => serializer.serialize_bool(*flag),
            Json::Count(count) => count.serialize(serializer),
            // Adding 0 turns −0 into 0 and does not change any other number.
            Json::Number(number) => serializer.serialize_f64(number + 0.0),
            Json::Text(text) => serializer.serialize_str(text),
            Json::List(list) => serializer.collect_seq(list),
            Json::Object(entries) => serializer.collect_map(entries.iter().map(|(key, value)| (key, value))),
        }
    }
}

macro_rules! from {
    ($($type:ty: $value:ident => $json:expr;)*) => {
        $(impl<'a> From<$type> for Json<'a> {
            fn from($value: $type) -> Json<'a> {
                $json
            }
        })*
    };
}

from! {
    bool: flag => Json::Flag(flag);
    usize: count => Json::Count(count);
    f64: number => Json::Number(number);
    &'a str: text => Json::Text(text.into());
    &'a String: text => Json::Text(text.into());
    String: text => Json::Text(text.into());
    &'a [String]: texts => Json::list(texts);
    Point: point => Json::list([point.x, point.y]);
    Vector: vector => Json::list([vector.x, vector.y]);
}

impl<'a, T: Into<Json<'a>>> From<Option<T>> for Json<'a> {
    fn from(value: Option<T>) -> Json<'a> {
        value.map_or(Json::Absent, Into::into)
    }
}

impl<'a, T: Into<Json<'a>>, const N: usize> From<[T; N]> for Json<'a> {
    fn from(list: [T; N]) -> Json<'a> {
        Json::list(list)
    }
}

/// Returns how blocks move: `[{ block, velocity, spin }]`.
pub(super) fn motions<'a>(scene: &'a Scene, motions: &[Motion]) -> Json<'a> {
    Json::list(motions.iter().map(|motion| {
        object! { block: &scene.blocks[motion.block.0].id, velocity: motion.velocity, spin: motion.spin }
    }))
}

/// Writes a value as JSON that ends with a line feed. With [`Layout::Lines`], objects that are nested deeper than `depth`
/// are written on one line.
pub(super) fn written(value: &impl Serialize, layout: Layout, depth: usize) -> String {
    let mut bytes = Vec::new();
    write(&mut bytes, value, layout, depth).expect("plain structures with text keys always serialise into memory");
    String::from_utf8(bytes).expect("serde_json writes UTF-8")
}

/// Writes a value like [`written`].
pub(super) fn write(out: &mut dyn io::Write, value: &impl Serialize, layout: Layout, depth: usize) -> io::Result<()> {
    let mut out = Escaping(out);
    match layout {
        Layout::Lines => value.serialize(&mut serde_json::Serializer::with_formatter(&mut out, Lines::new(depth)))?,
        Layout::OneLine => serde_json::to_writer(&mut out, value)?,
    }
    out.0.write_all(b"\n")
}

/// Replaces the characters of JSON that a terminal would interpret.
struct Escaping<'w>(&'w mut dyn io::Write);

impl io::Write for Escaping<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // serde_json writes pieces of text that divide no character. Most are short and plain.
        if bytes.iter().all(text::is_plain) {
            self.0.write_all(bytes)?;
        } else {
            let piece = std::str::from_utf8(bytes).map_err(io::Error::other)?;
            self.0.write_all(text::json(piece).as_bytes())?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Writes a value as JSON on one line, without a line feed.
pub(super) fn compact(value: &(impl Serialize + ?Sized)) -> String {
    text::json(
        serde_json::to_string(value).expect("plain structures with text keys always serialise into memory").as_str(),
    )
    .into_owned()
}
