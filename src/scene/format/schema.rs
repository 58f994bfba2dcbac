//! The JSON Schema of a scene file, and what it expects of a file that does not keep to it.

use schemars::generate::SchemaSettings;
use serde_json::Value;

use super::SceneFile;
use crate::scene::expectation::{Expectation, Key};

/// The JSON Schema (draft 2020-12) of a scene file, for editors that complete and check while one types.
///
/// ```
/// assert!(drystone::scene::format::schema().contains("\"title\": \"drystone scene\""));
/// ```
pub fn schema() -> String {
    let schema = SchemaSettings::draft2020_12()
        .into_generator()
        .into_root_schema_for::<SceneFile>();
    let mut text = format!("{:#}", schema.as_value());
    text.push('\n');
    text
}

/// What a scene file's types expect, read from its JSON Schema.
pub(crate) fn expected() -> Expectation {
    let mut settings = SchemaSettings::draft2020_12();
    settings.inline_subschemas = true;
    expectation(
        settings
            .into_generator()
            .into_root_schema_for::<SceneFile>()
            .as_value(),
    )
}

/// Translates the part of JSON Schema that [`SceneFile`] gives rise to.
fn expectation(schema: &Value) -> Expectation {
    if let Some(Value::String(name)) = schema.get("const") {
        return Expectation::Name(vec![name.clone()]);
    }
    if let Some(Value::Array(names)) = schema.get("enum") {
        return Expectation::Name(
            names
                .iter()
                .filter_map(|n| n.as_str().map(String::from))
                .collect(),
        );
    }
    if let Some(Value::Array(choices)) = schema.get("anyOf").or_else(|| schema.get("oneOf")) {
        return Expectation::any(choices.iter().map(expectation).collect());
    }
    match schema.get("type") {
        Some(Value::String(kind)) => of_type(kind, schema),
        Some(Value::Array(kinds)) => Expectation::any(
            kinds
                .iter()
                .filter_map(Value::as_str)
                .map(|kind| of_type(kind, schema))
                .collect(),
        ),
        _ => Expectation::Anything,
    }
}

fn of_type(kind: &str, schema: &Value) -> Expectation {
    let count = |key: &str| {
        schema
            .get(key)
            .and_then(Value::as_u64)
            .and_then(|n| usize::try_from(n).ok())
    };
    match kind {
        "number" => Expectation::Number,
        "integer" => Expectation::Whole,
        "string" => Expectation::Text,
        "boolean" => Expectation::Flag,
        "null" => Expectation::Null,
        "array" => match (schema.get("prefixItems"), schema.get("items")) {
            (Some(Value::Array(items)), _) => {
                Expectation::Tuple(items.iter().map(expectation).collect())
            }
            (_, Some(item)) => {
                let item = expectation(item);
                match (count("minItems"), count("maxItems")) {
                    (Some(least), Some(most)) if least == most => {
                        Expectation::Tuple(vec![item; least])
                    }
                    _ => Expectation::List(Box::new(item)),
                }
            }
            _ => Expectation::Anything,
        },
        "object" => {
            let required: Vec<&str> = match schema.get("required") {
                Some(Value::Array(keys)) => keys.iter().filter_map(Value::as_str).collect(),
                _ => Vec::new(),
            };
            match (schema.get("properties"), schema.get("additionalProperties")) {
                (Some(Value::Object(keys)), _) => Expectation::Object(
                    keys.iter()
                        .map(|(name, value)| Key {
                            name: name.clone(),
                            required: required.contains(&name.as_str()),
                            value: expectation(value),
                        })
                        .collect(),
                ),
                (None, Some(value @ Value::Object(_))) => {
                    Expectation::Map(Box::new(expectation(value)))
                }
                _ => Expectation::Anything,
            }
        }
        _ => Expectation::Anything,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_is_made_from_the_types() {
        let schema: Value = serde_json::from_str(&schema()).expect("JSON");
        assert_eq!(
            schema["$schema"],
            "https://json-schema.org/draft/2020-12/schema"
        );
        assert_eq!(schema["additionalProperties"], false);
        assert_eq!(
            schema["required"],
            serde_json::json!(["drystone", "blocks"])
        );
        assert_eq!(schema["properties"]["friction"]["default"], 0.7);
        assert!(
            schema["properties"]["gravity"]["description"]
                .as_str()
                .expect("described")
                .contains("m/s²")
        );
        assert!(schema.get("$id").is_none());
    }

    #[test]
    fn no_expectation_is_lost_in_translation() {
        fn sound(e: &Expectation) -> bool {
            match e {
                Expectation::Anything => false,
                Expectation::Any(all) | Expectation::Tuple(all) => all.iter().all(sound),
                Expectation::List(one) | Expectation::Map(one) => sound(one),
                Expectation::Object(keys) => keys.iter().all(|k| sound(&k.value)),
                _ => true,
            }
        }
        assert!(sound(&expected()));
    }
}
