//! [`Map`]: an object of the scene file whose keys are names chosen by the author.
//!
//! Entries keep the order of the file. In a map that was read from a file, each key occurs only once. A map that was
//! built in code is checked together with the rest of the scene.

#[cfg(feature = "schema")]
use std::borrow::Cow;

#[cfg(feature = "schema")]
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::read::{Node, Read, Reader, Trail};

/// Entries by name, in the order of the file. Each name may occur only once.
#[derive(Clone, Debug, PartialEq)]
pub struct Map<T>(pub Vec<(String, T)>);

impl<T> Default for Map<T> {
    fn default() -> Self {
        Map(Vec::new())
    }
}

impl<T> Map<T> {
    /// True if the map has no entries.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T: Serialize> Serialize for Map<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (key, value) in &self.0 {
            map.serialize_entry(key, value)?;
        }
        map.end()
    }
}

/// If a name occurs twice, this is reported, and only the first entry counts.
impl<T: Read + Default> Read for Map<T> {
    fn read<'s>(r: &mut Reader<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Map<T>> {
        r.names(node, at, T::read).map(Map)
    }
}

#[cfg(feature = "schema")]
impl<T: JsonSchema> JsonSchema for Map<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("MapOf{}", T::schema_name()).into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let entry = generator.subschema_for::<T>();
        schemars::json_schema!({ "type": "object", "additionalProperties": entry })
    }
}
