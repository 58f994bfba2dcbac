//! [`Type`]: the types of the values of a result.

use serde_json::{Value, json};

/// The type of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// Any text.
    Text,
    /// One of the listed words.
    Word(&'static [&'static str]),
    /// `true` or `false`.
    Flag,
    /// `true`, `false`, or `null` if it could not be decided.
    FlagOrOpen,
    /// A whole number, at least 0.
    Count,
    /// A line or column number from 1, or `null` if there is no position.
    Place,
    /// A whole number from 0, or `null` if there is no such index.
    Index,
    /// A number; `null` if it could not be computed, which happens only in undecided frames.
    Number,
    /// A number, or `"unbounded"`.
    Bound,
    /// A number; `null` if there is no value, for example because the frame falls at every value; `"unbounded"` if the
    /// interval of values at which the frame stands has no end in this direction.
    Margin,
    /// An interval `[low, high]`, `null` if it is empty, or `"withheld"`. Each end is a number, `null` if there is no
    /// limit, or `"withheld"`.
    Interval,
    /// A derivative: a number; `[backward, forward]` at a kink; or `"at_kink"`.
    Slope,
    /// Derivatives along x and y: `[x, y]`; at a kink, two such pairs `[backward, forward]`, or `"at_kink"`; `null`
    /// for a vertex that cannot move.
    SlopePair,
    /// Two lists of motions: just beyond the lower end and just beyond the upper end of an interval.
    MotionPairs,
    /// A point or vector, `[x, y]`.
    Pair,
    /// Two points, `[[x, y], [x, y]]`.
    Pairs,
    /// Any number of points, `[[x, y], …]`.
    Points,
    /// A list of lists of points.
    Rings,
    /// Two names.
    Names,
    /// A list of names.
    NameList,
    /// A list of `{ "block", "velocity", "spin" }`: how blocks move.
    Motions,
    /// A list of `{ "from", "to", "mechanism" }`: values at which a frame falls by one motion. An end that is `null`
    /// has no limit.
    Exclusions,
    /// An object.
    Object,
    /// A list of objects.
    Objects,
    /// An object with a key for each robot, by its name.
    ByRobot,
}

impl Type {
    /// Describes the type in words, for the table of keys.
    pub fn words(self) -> String {
        let fixed = match self {
            Type::Word(words) => {
                let quoted: Vec<String> = words.iter().map(|w| format!("`\"{w}\"`")).collect();
                return quoted.join(", ");
            }
            Type::Text => "text",
            Type::Flag => "boolean",
            Type::FlagOrOpen => "boolean or null",
            Type::Count => "integer",
            Type::Place | Type::Index => "integer or null",
            Type::Number => "number",
            Type::Bound => "number or `\"unbounded\"`",
            Type::Margin => "margin",
            Type::Interval => "interval",
            Type::Slope => "derivative",
            Type::SlopePair => "two derivatives",
            Type::MotionPairs => "two motions",
            Type::Pair => "[x, y]",
            Type::Pairs => "two points",
            Type::Points => "points",
            Type::Rings => "lists of points",
            Type::Names => "two names",
            Type::NameList => "texts",
            Type::Motions => "motion",
            Type::Exclusions => "exclusions",
            Type::Object => "object",
            Type::Objects => "objects",
            Type::ByRobot => "object by robot",
        };
        fixed.into()
    }

    /// Returns the JSON Schema of the type.
    pub(super) fn schema(self) -> Value {
        let number = json!({ "type": ["number", "null"] });
        let pair = json!({ "type": "array", "items": number, "minItems": 2, "maxItems": 2 });
        let unbounded = json!({ "const": "unbounded" });
        match self {
            Type::Text => json!({ "type": "string" }),
            Type::Word(words) => json!({ "type": "string", "enum": words }),
            Type::Flag => json!({ "type": "boolean" }),
            Type::FlagOrOpen => json!({ "type": ["boolean", "null"] }),
            Type::Count => json!({ "type": "integer", "minimum": 0 }),
            Type::Place => json!({ "type": ["integer", "null"], "minimum": 1 }),
            Type::Index => json!({ "type": ["integer", "null"], "minimum": 0 }),
            Type::Number => number,
            Type::Bound | Type::Margin => json!({ "anyOf": [number, unbounded] }),
            Type::Interval => {
                let withheld = json!({ "const": "withheld" });
                let end = json!({ "anyOf": [number, withheld] });
                let both = json!({ "type": "array", "items": end, "minItems": 2, "maxItems": 2 });
                json!({ "anyOf": [both, { "type": "null" }, withheld] })
            }
            Type::Slope => json!({ "anyOf": [number, pair, { "const": "at_kink" }] }),
            Type::SlopePair => {
                let both = json!({ "type": "array", "items": pair, "minItems": 2, "maxItems": 2 });
                json!({ "anyOf": [pair, both, { "const": "at_kink" }, { "type": "null" }] })
            }
            Type::MotionPairs => {
                let motions = json!({ "type": "array", "items": { "$ref": "#/$defs/motion" } });
                json!({ "type": "array", "items": motions, "minItems": 2, "maxItems": 2 })
            }
            Type::Pair => pair,
            Type::Pairs => json!({ "type": "array", "items": pair, "minItems": 2, "maxItems": 2 }),
            Type::Points => json!({ "type": "array", "items": pair }),
            Type::Rings => {
                json!({ "type": "array", "items": { "type": "array", "items": pair } })
            }
            Type::Names => {
                json!({ "type": "array", "items": { "type": "string" }, "minItems": 2, "maxItems": 2 })
            }
            Type::NameList => json!({ "type": "array", "items": { "type": "string" } }),
            Type::Motions => {
                json!({ "type": "array", "items": { "$ref": "#/$defs/motion" } })
            }
            Type::Exclusions => {
                json!({ "type": "array", "items": { "$ref": "#/$defs/exclusion" } })
            }
            Type::Object => json!({ "type": "object" }),
            Type::Objects => json!({ "type": "array", "items": { "type": "object" } }),
            Type::ByRobot => {
                json!({ "type": "object", "additionalProperties": { "type": "object" } })
            }
        }
    }
}
