//! [`Value`]: a value of a style file, read from JSON or from TOML. No other file of `drawing` uses serde, serde_json
//! or toml.

use core::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use super::StyleProblem;

/// A value of a style file, before its key is interpreted.
#[derive(Debug)]
pub(super) enum Value {
    Number(f64),
    Text(String),
    List(Vec<Value>),
    /// Keys and values in the order of the file; a key may occur twice.
    Table(Vec<(String, Value)>),
    Other(&'static str),
}

impl Value {
    /// Returns a short description of the value for messages, for example `the number 3`.
    pub(super) fn stated(&self) -> String {
        match self {
            Value::Number(number) => format!("the number {number}"),
            Value::Text(text) if text.chars().count() <= 30 => format!("the text {text:?}"),
            Value::Text(_) => "a long text".into(),
            Value::List(list) => format!("a list with {} entries", list.len()),
            Value::Table(_) => "a table".into(),
            Value::Other(what) => (*what).into(),
        }
    }
}

/// Parses a style file in JSON.
pub(super) fn json(text: &str) -> Result<Value, StyleProblem> {
    serde_json::from_str(text).map_err(|error| StyleProblem {
        path: String::new(),
        message: format!("not JSON: {error}"),
        help: "the name of a style file in TOML must end in .toml".into(),
    })
}

/// Parses a style file in TOML.
#[cfg(feature = "toml")]
pub(super) fn toml(text: &str) -> Result<Value, StyleProblem> {
    toml::from_str(text).map_err(|error| {
        let before = error.span().and_then(|span| text.get(..span.start));
        let line = before.map_or(1, |before| before.matches('\n').count() + 1);
        StyleProblem {
            path: String::new(),
            message: format!("not TOML: {} at line {line}", error.message()),
            help: "the name of a style file in JSON must end in .json".into(),
        }
    })
}

impl<'de> Deserialize<'de> for Value {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(AnyValue)
    }
}

struct AnyValue;

impl<'de> Visitor<'de> for AnyValue {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Other(if value { "true" } else { "false" }))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(Value::Number(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(Value::Number(value as f64))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(Value::Number(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(Value::Text(value.to_owned()))
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Other("null"))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = entries.next_element()? {
            list.push(value);
        }
        Ok(Value::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut table = Vec::new();
        while let Some(entry) = entries.next_entry()? {
            table.push(entry);
        }
        Ok(Value::Table(table))
    }
}
