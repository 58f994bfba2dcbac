//! [`schema()`]: makes the JSON Schema of a result from the list of its keys.

use serde_json::{Value, json};

use super::key::Type::{
    Bound, ByRobot, Count, Exclusions, Flag, FlagOrOpen, Index, Interval, Margin, MotionPairs, Motions, NameList,
    Names, Number, Object, Objects, Pair, Pairs, Place, Points, Rings, Slope, SlopePair, Text, Word,
};
use super::key::{KEYS, Key, REFUSAL_KEYS, Type};
use crate::mechanics::scene::Code;

/// Returns the JSON Schema (draft 2020-12) of the output of `check --json` for one file: a result, or the problems of
/// a file that is not a valid scene.
///
/// Later versions add keys, so programs should accept unknown keys. The schema accepts them too.
///
/// ```
/// assert!(drystone::result::schema().contains("\"total_sticking\""));
/// ```
pub fn schema() -> String {
    let mut refusal = object(REFUSAL_KEYS);
    let codes: Vec<&str> = Code::ALL.iter().map(|code| code.word()).collect();
    refusal["properties"]["problems"]["items"]["properties"]["code"]["examples"] = json!(codes);
    let velocity =
        described(Pair, "velocity of the centroid of the block, relative to the fastest point, whose speed is 1");
    let spin = described(Number, "1/m, anticlockwise positive");
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "drystone result",
        "description": "The output of `drystone check --json` for one scene file. Units are SI, and y points up.",
        "anyOf": [object(KEYS), refusal],
        "$defs": { "motion": {
            "type": "object",
            "properties": {
                "block": described(Text, "the block"),
                "velocity": velocity,
                "spin": spin,
            },
            "required": ["block", "velocity", "spin"],
        }, "exclusion": {
            "type": "object",
            "properties": {
                "from": described(Number, "lower end of the values; null if they have no lower end"),
                "to": described(Number, "upper end of the values; null if they have no upper end"),
                "mechanism": described(Motions, "the motion with which the frame falls at these values"),
            },
            "required": ["from", "to", "mechanism"],
        } },
    });
    format!("{schema:#}\n")
}

fn described(kind: Type, meaning: &str) -> Value {
    let mut schema = kind.schema();
    schema["description"] = meaning.into();
    schema
}

/// Makes the JSON Schema of an object with these keys, including the objects inside it.
fn object(keys: &[Key]) -> Value {
    let mut object = json!({ "type": "object" });
    for key in keys {
        let meaning = match (key.unit, key.when) {
            ("", "") => key.meaning.to_owned(),
            (unit, "") => format!("{} ({unit})", key.meaning),
            ("", when) => format!("{}; {when}", key.meaning),
            (unit, when) => format!("{} ({unit}); {when}", key.meaning),
        };
        let mut value = described(key.kind, &meaning.replace('\\', ""));
        if !key.keys.is_empty() {
            let inside = match key.kind {
                Objects => &mut value["items"],
                ByRobot => &mut value["additionalProperties"],
                _ => &mut value,
            };
            if let (Value::Object(own), Value::Object(keys)) = (inside, self::object(key.keys)) {
                own.extend(keys);
            }
        }
        object["properties"][key.name] = value;
        if key.when.is_empty() {
            match object.get_mut("required") {
                Some(Value::Array(required)) => required.push(key.name.into()),
                _ => object["required"] = json!([key.name]),
            }
        }
    }
    object
}

impl Type {
    /// Returns the JSON Schema of the type.
    fn schema(self) -> Value {
        let list = |items: Value| json!({ "type": "array", "items": items });
        let two = |items: Value| json!({ "type": "array", "items": items, "minItems": 2, "maxItems": 2 });
        let any = |kinds: &[Value]| json!({ "anyOf": kinds });
        let (null, object, text) =
            (json!({ "type": "null" }), json!({ "type": "object" }), json!({ "type": "string" }));
        let number = json!({ "type": ["number", "null"] });
        let (pair, motions) = (two(number.clone()), list(json!({ "$ref": "#/$defs/motion" })));
        let (at_kink, withheld) = (json!({ "const": "at_kink" }), json!({ "const": "withheld" }));
        match self {
            Text => text,
            Word(words) => json!({ "type": "string", "enum": words }),
            Flag => json!({ "type": "boolean" }),
            FlagOrOpen => json!({ "type": ["boolean", "null"] }),
            Count => json!({ "type": "integer", "minimum": 0 }),
            Place => json!({ "type": ["integer", "null"], "minimum": 1 }),
            Index => json!({ "type": ["integer", "null"], "minimum": 0 }),
            Number => number,
            Bound | Margin => any(&[number, json!({ "const": "unbounded" })]),
            Interval => any(&[two(any(&[number, withheld.clone()])), null, withheld]),
            Slope => any(&[number, at_kink]),
            SlopePair => any(&[pair, at_kink, null]),
            MotionPairs => two(motions),
            Pair => pair,
            Pairs => two(pair),
            Points => list(pair),
            Rings => list(list(pair)),
            Names => two(text),
            NameList => list(text),
            Motions => motions,
            Exclusions => list(json!({ "$ref": "#/$defs/exclusion" })),
            Object => object,
            Objects => list(object),
            ByRobot => json!({ "type": "object", "additionalProperties": object }),
        }
    }
}
