//! The pages that describe every key of the formats, compared with the types and with real results.
//!
//! The tables are enclosed by marks in `src/doc/format.md` and `src/doc/result.md`. `UPDATE_SNAPSHOTS=1` writes them
//! again.

mod format;
mod result;

use std::collections::BTreeSet;
use std::path::Path;

use drystone::analysis::{Analysis, CapacityRequest, MarginKind, MarginKinds, Options};
use drystone::certificate::Certificate;
use drystone::result::key::{KEYS, Key, REFUSAL_KEYS, Type, paths};
use drystone::result::{Layout, Timing, refusal, schema, to_json_with_blocks};
use drystone::scene::{Code, NoteCode, Scene};
use serde_json::Value;

/// The words of a page, separated by single spaces.
fn words_of(page: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(page);
    let text = std::fs::read_to_string(path).expect("the page is there");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Compares a table with the one between its marks, or writes it there with `UPDATE_SNAPSHOTS=1`.
fn table(page: &str, mark: &str, rows: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(page);
    let text = std::fs::read_to_string(&path).expect("the page is there");
    let (begin, end) = (format!("<!-- {mark} -->\n"), format!("<!-- end of {mark} -->"));
    let from = text.find(&begin).expect("the mark is there") + begin.len();
    let to = text.find(&end).expect("the end is there");
    let wanted = format!("\n{rows}\n");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        let new = format!("{}{wanted}{}", &text[..from], &text[to..]);
        std::fs::write(&path, new).expect("the page can be written");
        return;
    }
    assert_eq!(&text[from..to], wanted, "{page}: run once with UPDATE_SNAPSHOTS=1");
}

/// The permitted values of a key of the scene format, in words.
fn words(schema: &Value, definitions: &Value) -> String {
    if let Some(path) = schema["$ref"].as_str() {
        let name = path.trim_start_matches("#/$defs/");
        let inner = &definitions[name];
        return match inner["type"].as_str() {
            Some("object") => title(name).to_lowercase(),
            _ => words(inner, definitions),
        };
    }
    let choices = schema["anyOf"].as_array().or(schema["oneOf"].as_array());
    if let Some(choices) = choices {
        let all: Vec<String> = choices.iter().map(|c| words(c, definitions)).collect();
        let some: Vec<String> = all.into_iter().filter(|w| w != "null").collect();
        return some.join(" or ");
    }
    if let Some(word) = schema["const"].as_str() {
        return format!("`\"{word}\"`");
    }
    if let Some(names) = schema["enum"].as_array() {
        let names: Vec<String> = names.iter().map(|n| format!("`{n}`")).collect();
        return names.join(" or ");
    }
    let kind = schema["type"].as_str().or_else(|| {
        let kinds = schema["type"].as_array()?;
        kinds.iter().filter_map(Value::as_str).find(|k| *k != "null")
    });
    match kind.expect("a type") {
        "number" => "number".into(),
        "integer" => "integer".into(),
        "string" => "text".into(),
        "boolean" => "boolean".into(),
        "null" => "null".into(),
        "object" => {
            let entry = words(&schema["additionalProperties"], definitions);
            format!("object: {entry} by name")
        }
        "array" => match schema["prefixItems"].as_array() {
            Some(items) => {
                let items: Vec<String> = items.iter().map(|i| words(i, definitions)).collect();
                format!("[{}]", items.join(", ").replace("number, number", "x, y"))
            }
            None => {
                let item = words(&schema["items"], definitions);
                match (item.as_str(), schema["maxItems"].as_u64()) {
                    ("number", Some(2)) => "[x, y]".into(),
                    (_, Some(2)) => format!("[{item}, {item}]"),
                    ("[x, y]", None) => "list of [x, y]".into(),
                    _ => format!("list: {item}"),
                }
            }
        },
        other => panic!("{other} is not in the scene format"),
    }
}

/// The name of a type of the format on the page.
fn title(name: &str) -> &str {
    match name {
        "MaterialEntry" => "A material",
        "FrictionPairEntry" => "A friction pair",
        "JointSetEntry" => "A joint set",
        "GridEntry" => "A grid",
        "ShapeEntry" => "A shape",
        "GroundEntry" => "A part of the ground",
        "BlockEntry" => "A block",
        "CircleEntry" => "A circle",
        "RobotEntry" => "A robot",
        "LimitsEntry" => "Limits",
        "LoadEntry" => "A load",
        "DepthEntry" => "A pressure that grows with the depth",
        "CaseEntry" => "A load case",
        "MovementEntry" => "A movement",
        "VehicleEntry" => "A vehicle",
        "AxleEntry" => "An axle",
        "StepEntry" => "A step",
        "GripEntry" => "A grip",
        "UnitsEntry" => "Units",
        "ContactEntry" => "A contact",
        other => panic!("{other} has no title on the page"),
    }
}

/// The table of an object's keys. Keys that equal those of a block share the last row.
fn object_table(schema: &Value, definitions: &Value) -> String {
    let block = &definitions["BlockEntry"]["properties"];
    let mut as_for_a_block = Vec::new();
    let required: Vec<&str> =
        schema["required"].as_array().map(|keys| keys.iter().filter_map(Value::as_str).collect()).unwrap_or_default();
    let mut rows = String::from("| key | value | meaning |\n|---|---|---|\n");
    let keys = schema["properties"].as_object().expect("keys");
    for (key, value) in keys {
        if schema["properties"] != *block && block[key] == *value {
            as_for_a_block.push(format!("`{key}`"));
            continue;
        }
        let meaning = (value["description"].as_str()).expect("every key is described");
        // A description may have several lines, but a row of a table may not.
        let meaning = meaning.split_whitespace().collect::<Vec<_>>().join(" ");
        let default = match &value["default"] {
            _ if required.contains(&key.as_str()) => ", required".to_owned(),
            Value::Null => String::new(),
            Value::Array(list) if list.is_empty() => String::new(),
            Value::Object(map) if map.is_empty() => String::new(),
            other => format!(", default `{}`", other.to_string().replace(".0", "").replace(',', ", ")),
        };
        // The default in the description must be that of the schema.
        let (meaning, stated) = match meaning.split_once(" Default ") {
            Some((meaning, stated)) if !value["default"].is_null() => (meaning.to_owned(), Some(stated.to_owned())),
            _ => (meaning, None),
        };
        if let Some(stated) = stated {
            let stated: Value = serde_json::from_str(stated.trim_end_matches('.')).unwrap_or(Value::Null);
            let (stated, expected) = (stated.to_string(), value["default"].to_string());
            let [stated, expected] = [stated, expected].map(|text| text.replace(".0", ""));
            assert_eq!(stated, expected, "{key}");
        }
        if words(value, definitions) == "number" {
            let units = [
                "metres",
                "kg",
                "newtons",
                "length unit of the scene",
                "force unit of the scene",
                "N·m",
                "degrees",
                "coefficient",
                "kernel",
                "Factor",
            ];
            assert!(units.iter().any(|u| meaning.contains(u)), "{key} has no unit: {meaning}");
        }
        let cell = |text: &str| text.replace('|', "\\|");
        let kind = cell(&words(value, definitions));
        rows += &format!("| `{key}` | {kind}{default} | {} |\n", cell(&meaning));
    }
    if !as_for_a_block.is_empty() {
        rows += &format!("| {} | | As for a block. |\n", as_for_a_block.join(", "));
    }
    rows
}

#[test]
fn the_format_page_describes_every_key_of_a_scene_file() {
    let root: Value = serde_json::from_str(&drystone::scene::schema()).expect("JSON");
    let definitions = &root["$defs"];
    let mut text = format!("## The scene\n\n{}", object_table(&root, definitions));
    let order = [
        "BlockEntry",
        "GroundEntry",
        "CircleEntry",
        "ShapeEntry",
        "MaterialEntry",
        "FrictionPairEntry",
        "JointSetEntry",
        "GridEntry",
        "RobotEntry",
        "LimitsEntry",
        "LoadEntry",
        "DepthEntry",
        "CaseEntry",
        "MovementEntry",
        "VehicleEntry",
        "AxleEntry",
        "StepEntry",
        "GripEntry",
        "UnitsEntry",
        "ContactEntry",
    ];
    for name in order {
        let about = definitions[name]["description"].as_str().expect("described");
        let rows = object_table(&definitions[name], definitions);
        text += &format!("\n## {}\n\n{about}\n\n{rows}", title(name));
    }
    let objects = definitions.as_object().expect("definitions").iter();
    let listed: BTreeSet<&str> = order.into_iter().collect();
    let all: BTreeSet<&str> = (objects.filter(|d| d.1["type"] == "object")).map(|d| d.0.as_str()).collect();
    assert_eq!(listed, all, "every object has a table");
    table("src/doc/format.md", "keys", &text);
}

fn key_table(keys: &[Key]) -> String {
    let mut rows = String::from("| key | value | meaning |\n|---|---|---|\n");
    let text = |key: &Key| {
        let unit = if key.unit.is_empty() { String::new() } else { format!(", {}", key.unit) };
        let when = if key.when.is_empty() { String::new() } else { format!("*{}:* ", key.when) };
        format!("{}{unit} | {when}{}", key.kind.words(), key.meaning)
    };
    // Neighbours with the same text share a row.
    for same in paths(keys).chunk_by(|a, b| text(&a.1) == text(&b.1)) {
        let paths: Vec<String> = same.iter().map(|key| format!("`{}`", key.0)).collect();
        rows += &format!("| {} | {} |\n", paths.join(", "), text(&same[0].1));
    }
    rows
}

#[test]
fn the_result_page_describes_every_key_and_code() {
    table("src/doc/result.md", "keys", &key_table(KEYS));
    table("src/doc/result.md", "refusal keys", &key_table(REFUSAL_KEYS));
    let mut rows = String::from("| code | meaning |\n|---|---|\n");
    for code in Code::ALL {
        rows += &format!("| `{code}` | {} |\n", code.meaning());
    }
    table("src/doc/result.md", "codes", &rows);
    let mut rows = String::from("| code | meaning |\n|---|---|\n");
    for code in NoteCode::ALL {
        rows += &format!("| `{code}` | {} |\n", code.meaning());
    }
    table("src/doc/result.md", "notes", &rows);
}

/// Whether a value has the type of its key.
fn fits(kind: Type, value: &Value) -> bool {
    let number = |v: &Value| v.is_number() || v.is_null();
    let list = |v: &Value, each: &dyn Fn(&Value) -> bool| v.as_array().is_some_and(|l| l.iter().all(each));
    let two = |v: &Value| v.as_array().is_some_and(|l| l.len() == 2);
    let pair = |v: &Value| two(v) && list(v, &number);
    let motion = |m: &Value| m["block"].is_string() && pair(&m["velocity"]) && number(&m["spin"]);
    match kind {
        Type::Text => value.is_string(),
        Type::Word(words) => value.as_str().is_some_and(|w| words.contains(&w)),
        Type::Flag => value.is_boolean(),
        Type::FlagOrOpen => value.is_boolean() || value.is_null(),
        Type::Count => value.is_u64(),
        Type::Place => value.is_null() || value.as_u64().is_some_and(|n| n > 0),
        Type::Index => value.is_null() || value.is_u64(),
        Type::Number => number(value),
        Type::Bound | Type::Margin => number(value) || value == "unbounded",
        Type::Slope => number(value) || value == "at_kink",
        Type::SlopePair => pair(value) || value == "at_kink" || value.is_null(),
        Type::Pair => pair(value),
        Type::Pairs => two(value) && list(value, &pair),
        Type::Points => list(value, &pair),
        Type::Rings => list(value, &|ring| list(ring, &pair)),
        Type::Names => two(value) && list(value, &Value::is_string),
        Type::NameList => list(value, &Value::is_string),
        Type::Motions => list(value, &motion),
        Type::Interval => {
            let ends = two(value) && list(value, &|end| number(end) || end == "withheld");
            ends || value.is_null() || value == "withheld"
        }
        Type::MotionPairs => two(value) && list(value, &|m| list(m, &motion)),
        Type::Exclusions => list(value, &|reason| {
            number(&reason["from"]) && number(&reason["to"]) && list(&reason["mechanism"], &motion)
        }),
        Type::Object | Type::ByRobot => value.is_object(),
        Type::Objects => list(value, &Value::is_object),
    }
}

/// Checks an object against the keys, and records the paths of the keys that occur.
fn walk(object: &Value, path: &str, keys: &[Key], seen: &mut BTreeSet<String>) {
    let entries = object.as_object().expect("an object");
    for (name, value) in entries {
        let here = format!("{path}{name}");
        let key = (keys.iter().find(|k| k.name == name)).unwrap_or_else(|| panic!("{here} is not described"));
        assert!(fits(key.kind, value), "{here}: {value} is not a {:?}", key.kind);
        match key.kind {
            Type::Object => walk(value, &format!("{here}."), key.keys, seen),
            Type::Objects => {
                for entry in value.as_array().into_iter().flatten() {
                    walk(entry, &format!("{here}[]."), key.keys, seen);
                }
            }
            Type::ByRobot => {
                for robot in value.as_object().into_iter().flatten() {
                    walk(robot.1, &format!("{here}.*."), key.keys, seen);
                }
            }
            _ => {}
        }
        seen.insert(here);
    }
    for key in keys.iter().filter(|k| k.when.is_empty()) {
        assert!(entries.contains_key(key.name), "{path}{} is always present, but not in {object}", key.name);
    }
}

#[test]
fn every_key_of_real_results_is_described_and_every_described_key_occurs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut seen = BTreeSet::new();
    let extra = [
        // Blocks without support, a robot without torque, a gap that decides the verdict, coordinates with three
        // decimals.
        r#"{ "drystone": 1, "blocks": [{ "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]] }] }"#.to_owned(),
        r#"{ "drystone": 1, "friction": 0.6, "ground": [{ "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]] },
            { "polygon": [[3, -1], [4, -1], [4, 0], [3, 0]] }],
            "blocks": [{ "polygon": [[0, 0], [4, 0.004], [4, 1], [0, 1]] }] }"#
            .to_owned(),
        r#"{ "drystone": 1, "ground": [{ "polygon": [[0.125, -1.001], [7.333, -1.002], [7.333, 0.001], [0.125, 0.002]] }],
            "blocks": [{ "polygon": [[1.118, 0.002], [2.226, 0.001], [2.223, 1.007], [1.119, 1.003]] }] }"#
            .to_owned(),
    ];
    let mut texts: Vec<String> = extra.into();
    // A bar between two walls, which stands only by wedging.
    texts.push(
        r#"{ "drystone": 1, "friction": 0.7, "ground": [{ "polygon": [[-1, 0], [0, 0], [0, 1], [-1, 1]] },
            { "polygon": [[3, 0], [4, 0], [4, 1], [3, 1]] }],
            "blocks": [{ "polygon": [[0, 0], [3, 0], [3, 1], [0, 1]] }] }"#
            .to_owned(),
    );
    // A block that hangs in the air next to one that a robot holds: the scene stands at no value of any parameter.
    texts.push(
        r#"{ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": [[-1, 0], [0, 0], [0, 9], [-1, 9]] }],
            "blocks": [{ "id": "held", "polygon": [[0, 5], [1, 5], [1, 6], [0, 6]] },
                { "id": "hangs", "polygon": [[8, 3], [9, 3], [9, 4], [8, 4]] }],
            "loads": [{ "block": "held", "force": [1, 0] }], "robots": [{ "id": "r", "holds": "held" }] }"#
            .to_owned(),
    );
    // A block with a hole.
    texts.push(
        r#"{ "drystone": 1, "ground": [{ "polygon": [[-1, -1], [5, -1], [5, 0], [-1, 0]] }],
            "blocks": [{ "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]], "holes": [[[1, 1], [2, 1], [2, 2]]] }] }"#
            .to_owned(),
    );
    // A block with load cases.
    texts.push(
        r#"{ "drystone": 1, "ground": [{ "polygon": [[-1, -1], [5, -1], [5, 0], [-1, 0]] }],
            "blocks": [{ "id": "a", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]], "weight": 9 }],
            "loads": [{ "id": "push", "block": "a", "force": [1, 0] }],
            "cases": [{ "id": "with" }, { "id": "without", "loads": {} }] }"#
            .to_owned(),
    );
    // A ladder that stands only by its corner.
    texts.push(
        r#"{ "drystone": 1, "friction": 0.6, "ground": [
                { "polygon": [[-3, -1], [3.2, -1], [3.2, 0], [-3, 0]] },
                { "polygon": [[2.2, 0], [3.2, 0], [3.2, 6], [2.2, 6]] }],
            "blocks": [{ "polygon": [[0, 0], [0.12, 0], [2.2, 4.5], [2.1, 4.55]], "weight": 100 }] }"#
            .to_owned(),
    );
    // A beam that falls under an axle at its end.
    texts.push(
        r#"{ "drystone": 1, "ground": [{ "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]] }],
            "blocks": [{ "polygon": [[-1, 0], [2, 0], [2, 1], [-1, 1]], "weight": 6 }],
            "vehicle": { "axles": [{ "weight": 4 }] } }"#
            .to_owned(),
    );
    // A beam that stands under an axle at its end while a block lies on it.
    texts.push(
        r#"{ "drystone": 1, "ground": [{ "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]] }],
            "blocks": [{ "polygon": [[-1, 0], [2, 0], [2, 1], [-1, 1]], "weight": 6 },
                { "polygon": [[0, 1], [1, 1], [1, 2], [0, 2]], "weight": 20 }],
            "vehicle": { "axles": [{ "weight": 4 }] } }"#
            .to_owned(),
    );
    // A block on two parts of the ground, of which one moves, in two cases.
    texts.push(
        r#"{ "drystone": 1, "ground": [{ "id": "left", "polygon": [[0, -1], [1, -1], [1, 0], [0, 0]] },
                { "id": "right", "polygon": [[2, -1], [3, -1], [3, 0], [2, 0]] }],
            "blocks": [{ "id": "lintel", "polygon": [[0, 0], [3, 0], [3, 1], [0, 1]], "weight": 6 }],
            "movements": [{ "ground": "right", "translation": [0, -0.1] }],
            "loads": [{ "id": "wind", "block": "lintel", "force": [1, 0] }],
            "cases": [{ "id": "calm", "loads": {} }, { "id": "wind" }] }"#
            .to_owned(),
    );
    for folder in ["assets/questions", "assets/thesis", "tests/scenes"] {
        let mut files: Vec<_> = std::fs::read_dir(root.join(folder))
            .expect("readable")
            .map(|entry| entry.expect("readable").path())
            .filter(|p| p.extension().is_some_and(|e| e == "json"))
            .collect();
        files.sort();
        let large = ["wall200", "steps30", "tinyhuge", "archri4", "bridge-vehicle"];
        files.retain(|p| !large.iter().any(|l| p.to_string_lossy().contains(l)));
        texts.extend(files.iter().map(|p| std::fs::read_to_string(p).expect("readable")));
    }
    for (number, text) in texts.iter().enumerate() {
        let scene = Scene::from_json(text).expect("sound");
        let mut options =
            Options::default().margins(MarginKinds::ALL).wedging(true).sensitivity(MarginKind::LoadFactor);
        // For a few scenes, the forces that the first block can carry are requested too.
        if number < 6 {
            let first = scene.block_named(&scene.blocks()[0].id);
            options.ask.capacity = first.map(CapacityRequest::of_block);
            options.ask.placement = true;
            options.ask.removable = true;
        }
        // The conditions that decide these answers are named.
        if text.contains("retains earth") || text.contains("\"vehicle\"") {
            // A bridge of many stones takes long.
            (options.ask.placement, options.ask.removable) = (true, scene.blocks().len() < 20);
        }
        if text.contains("\"cases\"") || text.contains("\"vehicle\"") && scene.blocks().len() < 20 {
            options.ask.capacity = scene.block_named(&scene.blocks()[0].id).map(CapacityRequest::of_block);
        }
        let mut analysis = Analysis::with(&scene, &options);
        if number < 6 {
            Certificate::new(&mut analysis, String::new(), false);
        }
        let json = to_json_with_blocks(Some("a.json"), &analysis, Timing::Included, Layout::OneLine);
        walk(&serde_json::from_str(&json).expect("JSON"), "", KEYS, &mut seen);
    }
    let missing: Vec<String> = paths(KEYS).into_iter().map(|k| k.0).filter(|p| !seen.contains(p)).collect();
    // Only the option `--set` of the command line gives this key.
    assert_eq!(missing, ["set"], "no scene shows these keys");
}

#[test]
fn a_refused_file_has_the_described_keys() {
    let problems = Scene::from_json(r#"{ "drystone": 1, "bloks": [] }"#).expect_err("refused");
    let json: Value = serde_json::from_str(&refusal("é.json", &problems.list, Layout::Lines)).expect("JSON");
    let mut seen = BTreeSet::new();
    walk(&json, "", REFUSAL_KEYS, &mut seen);
    assert_eq!(seen.len(), paths(REFUSAL_KEYS).len());
    assert_eq!(json["problems"][1]["code"], "unknown_key");
    assert_eq!(json["problems"][1]["path"], "bloks");
}

#[test]
fn the_schema_of_results_has_the_same_keys() {
    let schema: Value = serde_json::from_str(&schema()).expect("JSON");
    for (number, keys) in [KEYS, REFUSAL_KEYS].into_iter().enumerate() {
        let object = &schema["anyOf"][number];
        for (path, key) in paths(keys) {
            let mut here = object;
            for segment in path.split('.') {
                here = match segment.strip_suffix("[]") {
                    Some(list) => &here["properties"][list]["items"],
                    None if segment == "*" => &here["additionalProperties"],
                    None => &here["properties"][segment],
                };
            }
            let described = here["description"].as_str().expect("described");
            assert!(described.contains(key.unit), "{path}: {described}");
        }
        assert!(object["required"].as_array().expect("some").contains(&keys[0].name.into()) || number == 1);
    }
}
