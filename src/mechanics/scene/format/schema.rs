//! Generates the JSON Schema of a scene file.

use super::SceneFile;
use schemars::generate::SchemaSettings;

/// Returns the JSON Schema (draft 2020-12) of a scene file. Editors use the schema to complete and check a scene.
///
/// ```
/// assert!(drystone::scene::format::schema().contains("\"title\": \"drystone scene\""));
/// ```
pub fn schema() -> String {
    let schema = SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<SceneFile>();
    let mut text = format!("{:#}", schema.as_value());
    text.push('\n');
    text
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::mechanics::scene::reading::KEYS;

    #[test]
    fn the_schema_is_made_from_the_types() {
        let schema: Value = serde_json::from_str(&schema()).expect("JSON");
        assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
        assert_eq!(schema["additionalProperties"], false);
        assert_eq!(schema["required"], serde_json::json!(["drystone", "blocks"]));
        assert_eq!(schema["properties"]["friction"]["default"], 0.7);
        assert!(schema["properties"]["gravity"]["description"].as_str().expect("a description").contains("m/s²"));
        assert!(schema.get("$id").is_none());
    }

    #[test]
    fn the_reader_lists_the_keys_of_all_types() {
        let schema: Value = serde_json::from_str(&schema()).expect("JSON");
        let definitions = schema["$defs"].as_object().expect("definitions");
        let objects = definitions.iter().filter(|d| d.1["type"] == "object").count();
        assert_eq!(KEYS.len(), objects + 1);
        for (name, keys) in KEYS {
            let object = definitions.get(*name).unwrap_or(&schema);
            let properties = object["properties"].as_object().expect("properties");
            let named: Vec<&str> = properties.keys().map(String::as_str).collect();
            assert_eq!(*keys, named, "{name}");
        }
    }
}
