//! Converts text, or a [`SceneFile`] built in code, to a checked [`Scene`]. If the scene is not valid, returns all its
//! problems.
//!
//! A text is read once, into a syntax tree. The scene file is made from that tree. A value that does not fit is
//! reported and left out. All other values are still checked.

use std::cell::LazyCell;

use super::Scene;
use super::finding::{self, Finding, UnreadParts};
use super::format::{SceneFile, convert};
use super::note::{self, Lines};
use super::problem::{SCENE, SceneError};
use super::resolution::resolve;
use crate::read::{self, Dialect, Read, Reader, Source, Trail, syntax};

impl Scene {
    /// Reads and checks a scene file.
    ///
    /// # Errors
    /// All problems of the scene, each with line, column and path. If the text is not JSON, only the first error in it.
    ///
    /// # Example
    /// ```
    /// use drystone::scene::Scene;
    /// let scene = Scene::from_json(r#"{ "drystone": 1,
    ///     "ground": [{ "polygon": [[-1, -1], [4, -1], [4, 0], [-1, 0]] }],
    ///     "blocks": [{ "id": "a", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "density": 3 }] }"#)?;
    /// assert!((scene.blocks()[0].weight - 3.0 * 2.0 * 9.81).abs() < 1e-12);
    ///
    /// let problems = Scene::from_json(r#"{ "drystone": 1, "blokcs": [] }"#).unwrap_err();
    /// assert!(problems.to_string().contains("the nearest known key is `blocks`"));
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn from_json(text: &str) -> Result<Scene, SceneError> {
        Scene::from_json_within(text, None)
    }

    /// Reads and checks a scene file, like [`Scene::from_json`]. If `tolerance` is given, in metres and at least 0, it
    /// replaces the contact tolerance of the file.
    ///
    /// # Errors
    /// The same errors as [`Scene::from_json`].
    pub fn from_json_within(text: &str, tolerance: Option<f64>) -> Result<Scene, SceneError> {
        from_text(0, text, tolerance, &unchanged).map(|(scene, _)| scene)
    }

    /// Reads and checks the bytes of a scene file.
    ///
    /// # Errors
    /// The same errors as [`Scene::from_json`], and an error if the bytes are not UTF-8.
    pub fn from_slice(bytes: &[u8]) -> Result<Scene, SceneError> {
        Scene::from_slice_within(bytes, None)
    }

    /// Reads and checks the bytes of a scene file, like [`Scene::from_slice`]. If `tolerance` is given, in metres and
    /// at least 0, it replaces the contact tolerance of the file.
    ///
    /// # Errors
    /// The same errors as [`Scene::from_slice`].
    pub fn from_slice_within(bytes: &[u8], tolerance: Option<f64>) -> Result<Scene, SceneError> {
        from_bytes(0, bytes, tolerance, &unchanged).map(|(scene, _)| scene)
    }

    /// Starts a scene that is built in code: returns an empty [`SceneFile`], whose methods set the keys of a scene
    /// file. The method [`build`](SceneFile::build) then checks the file and returns the scene.
    ///
    /// # Example
    /// ```
    /// use drystone::scene::format::{BlockEntry, LimitsEntry, RobotEntry, StepEntry};
    /// use drystone::{Analysis, Scene, analysis::Verdict};
    ///
    /// let scene = Scene::builder()
    ///     .title("A lintel, and a robot that helps")
    ///     .friction(0.6)
    ///     .ground([[-1.0, -1.0], [7.0, -1.0], [7.0, 0.0], [-1.0, 0.0]])
    ///     .shape("post", [[0.0, 0.0], [1.0, 0.0], [1.0, 3.0], [0.0, 3.0]])
    ///     .block(BlockEntry::new("left").shape("post").weight(60.0))
    ///     .block(BlockEntry::new("lintel").polygon([[0.0, 3.0], [6.0, 3.0], [6.0, 4.0], [0.0, 4.0]]).weight(110.0))
    ///     .robot(RobotEntry::new("crane").limits(LimitsEntry::default().force(100.0)))
    ///     .step(StepEntry::new("One post").place(["left"]))
    ///     .step(StepEntry::new("The crane helps").place(["lintel"]).hold_at("crane", "lintel", [5.0, 4.0]))
    ///     .step(StepEntry::new("It lets go").release(["crane"]))
    ///     .build()?;
    /// let verdicts = Analysis::new(&scene).frames.iter().map(|frame| frame.verdict).collect::<Vec<_>>();
    /// assert_eq!(verdicts, [Verdict::Stable, Verdict::Stable, Verdict::Unstable]);
    ///
    /// let flat = Scene::builder().block(BlockEntry::new("a").polygon([[0.0, 0.0], [1.0, 0.0]]));
    /// assert_eq!(flat.build().unwrap_err().list[0].path, "blocks[0].polygon");
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn builder() -> SceneFile {
        SceneFile::default()
    }

    /// Checks a scene file that was built in code, and converts it to a scene.
    ///
    /// # Errors
    /// All problems of the scene, each with its path.
    ///
    /// # Example
    /// ```
    /// use drystone::Scene;
    /// let scene = Scene::new(Scene::builder().density(2.0).block([[0.0, 0.0], [3.0, 0.0], [0.0, 1.0]]))?;
    /// assert_eq!(scene.blocks()[0].id, "1");
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn new(file: SceneFile) -> Result<Scene, SceneError> {
        let mut scene = resolve(&file, UnreadParts::default()).map_err(|findings| finding::located(findings, None))?;
        scene.notes = note::of(&file, &scene, || None);
        Ok(scene)
    }
}

impl SceneFile {
    /// Reads a scene file from JSON text. Only the types of the values are checked; [`SceneFile::build`] checks the rest.
    ///
    /// # Errors
    /// All values of a wrong type, all unknown, missing and repeated keys, or the first error in the syntax.
    ///
    /// # Example
    /// ```
    /// use drystone::scene::format::SceneFile;
    /// let file = SceneFile::from_json(r#"{ "drystone": 1, "blocks": [{ "weight": -3 }] }"#)?;
    /// assert_eq!(file.blocks[0].weight, Some(-3.0));
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn from_json(text: &str) -> Result<SceneFile, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut source = syntax::json(text, &SCENE).map_err(|broken| SceneError::broken(text, broken))?;
        convert(&mut source);
        match read(&source, &SCENE) {
            (file, findings, _) if findings.is_empty() => Ok(file),
            (_, findings, _) => Err(finding::located(findings, Some(&source))),
        }
    }
}

/// Changes the values of a text before the scene file is made from them.
pub(super) type Edit<'e, 't> = &'e dyn Fn(&mut Source<'t>) -> Result<(), SceneError>;

/// Changes nothing.
pub(super) fn unchanged(_: &mut Source<'_>) -> Result<(), SceneError> {
    Ok(())
}

/// Reads and checks the bytes of a scene file, like [`Scene::from_slice_within`], after `edit` has changed its values. In
/// its file, `lines_before` lines stand before it: lines in messages count them, but not the lines of the problems. Also
/// returns the scene file with the changed values, without the tolerance.
pub(super) fn from_bytes<'t>(
    lines_before: usize,
    bytes: &'t [u8],
    tolerance: Option<f64>,
    edit: Edit<'_, 't>,
) -> Result<(Scene, SceneFile), SceneError> {
    match std::str::from_utf8(bytes) {
        Ok(text) => from_text(lines_before, text, tolerance, edit),
        Err(_) => Err(not_utf8(bytes)),
    }
}

/// Returns the error of bytes that are not UTF-8.
pub(super) fn not_utf8(bytes: &[u8]) -> SceneError {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let valid = std::str::from_utf8(bytes).err().map_or(0, |error| error.valid_up_to());
    let text = String::from_utf8_lossy(bytes);
    SceneError::broken(&text, syntax::not_utf8(bytes, valid, &text))
}

fn from_text<'t>(
    lines_before: usize,
    text: &'t str,
    tolerance: Option<f64>,
    edit: Edit<'_, 't>,
) -> Result<(Scene, SceneFile), SceneError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let dialect = Dialect { lines_before, ..SCENE };
    let parsed = || {
        let mut source = syntax::json(text, &dialect).map_err(|broken| SceneError::broken(text, broken))?;
        edit(&mut source)?;
        convert(&mut source);
        Ok(source)
    };
    let source = parsed()?;
    let (mut file, findings, unread) = read(&source, &dialect);
    let lines = Lines::new(&source);
    // The syntax tree takes more memory than the scene. It is made again if a message has a place in the text.
    drop(source);
    let source = LazyCell::new(|| parsed().ok());
    let own_tolerance = file.contact_tolerance;
    file.tolerate(tolerance);
    let all = match resolve(&file, unread) {
        Ok(mut scene) if findings.is_empty() => {
            scene.lines = lines;
            scene.notes = note::of(&file, &scene, || source.as_ref());
            file.contact_tolerance = own_tolerance;
            return Ok((scene, file));
        }
        Ok(_) => findings,
        Err(more) => findings.into_iter().chain(more).collect(),
    };
    Err(finding::located(all, source.as_ref()))
}

/// Returns a small example as the text of a scene file. Its structure stands after every step. Users can extend it.
///
/// ```
/// let scene = drystone::scene::Scene::from_json(drystone::scene::starter())?;
/// assert!(scene.frames().len() > 1);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn starter() -> &'static str {
    include_str!("../../../assets/starter.json")
}

/// Returns the example of [`starter`] with one more step, in which a block tips over because a robot releases it too
/// early.
///
/// ```
/// let scene = drystone::scene::Scene::from_json(drystone::scene::falling_starter())?;
/// assert_eq!(drystone::Analysis::new(&scene).verdict(), drystone::analysis::Verdict::Unstable);
/// # Ok::<(), drystone::scene::SceneError>(())
/// ```
pub fn falling_starter() -> &'static str {
    include_str!("../../../assets/starter-falls.json")
}

/// Reads the scene file from the syntax tree of `source`. Returns the file, the problems found while reading, and the
/// parts that could not be read.
pub(super) fn read<'s>(source: &'s Source<'s>, dialect: &'s Dialect) -> (SceneFile, Vec<Finding>, UnreadParts) {
    let mut reader = Reader::new(source, dialect);
    let file = match &source.tree {
        Some(tree) => SceneFile::read(&mut reader, &tree.root, &Trail::Top).unwrap_or_default(),
        None => SceneFile::default(),
    };
    let finding = |f: read::Finding| Finding { path: f.path, mark: f.mark, wording: f.mistake.into() };
    (file, reader.findings.into_iter().map(finding).collect(), UnreadParts { paths: reader.unread })
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::read::tree::Tree;
    use crate::read::{Node, NodeKind};

    /// The values of a text as JSON, with all numbers as floats, and without what a scene file may leave out: `null`, and
    /// empty lists and objects of its own keys.
    fn values(text: &str) -> Value {
        fn plain(value: Value) -> Value {
            match value {
                Value::Number(x) => x.as_f64().into(),
                Value::Array(list) => list.into_iter().map(plain).collect(),
                Value::Object(map) => {
                    let is_empty = |v: &Value| match v {
                        Value::Null => true,
                        Value::Array(list) => list.is_empty(),
                        Value::Object(map) => map.is_empty(),
                        _ => false,
                    };
                    map.into_iter().map(|(k, v)| (k, plain(v))).filter(|(_, v)| !is_empty(v)).collect()
                }
                other => other,
            }
        }
        plain(serde_json::from_str(text).expect("JSON"))
    }

    const EVERYTHING: &str = r##"{ "$schema": "s", "drystone": 1, "title": null, "author": "A. Mason", "project": "Mill Lane", "date": "2026-11-23", "units": { "length": "mm", "force": "kN" }, "gravity": [1, -2], "friction": 0.5, "kernel": 0,
        "density": 2, "thickness": 3, "materials": { "oak": { "density": 700, "friction": 0.1, "fill": "#123" }, "b": {} },
        "friction_pairs": [{ "between": ["oak", "b"], "friction": 1e-3 }], "grid": { "kind": "square", "side": 2 },
        "shapes": { "s": { "polygon": [[0, 0], [1, 0], [1, 1]], "holes": [[[0.1, 0.1]]] }, "t": { "cells": [[0, 1]] } },
        "ground": [{ "id": "left", "shape": "s", "at": [1, 2], "angle": 90, "material": "b", "friction": 2, "fill": "#abc" },
                   { "polygon": [[0, 0]], "holes": [] }, { "cells": [[1, 2, "up"], [3, 4, "down"]] }],
        "blocks": [{ "id": "a", "polygon": [[0, 0]], "holes": [[[1, 2]]], "material": "oak", "weight": 1, "mass": 2, "density": 3,
                     "friction": 4, "fill": "#fff", "shape": null, "at": [5, 6], "angle": -90, "centre": [1, 2], "cells": [[7, 8]] }, {}],
        "contacts": [{ "bodies": ["a", "ground"], "at": [1, 2], "normal": 90, "friction": 0.2 }],
        "robots": [{ "id": "r", "holds": "a", "at": [1, 1], "limits": { "fx": 1, "fy": 2, "torque": 3, "force": 4 } }, {}],
        "loads": [{ "block": "a", "force": [1, 2], "at": [3, 4], "torque": 5, "id": "l", "fixed": true },
            { "block": "a", "side": "top", "pressure": [1, 2] }, { "between": [[1, 2], [3, 4]], "pressure": 2.5 },
            { "block": "a", "side": "left", "pressure": { "surface": 1, "unit_weight": 2, "coefficient": 3, "friction_angle": 4 } }],
        "cases": [{ "id": "c", "weights": 0.9, "loads": { "l": 1.5 } }],
        "movements": [{ "ground": "left", "translation": [1, 2], "rotation": 0.1, "about": [0, 0] }],
        "vehicle": { "axles": [{ "weight": 1, "offset": 2 }], "over": ["a"], "step": 0.5, "both_ways": false }, "contact_tolerance": 1e-9,
        "corner_contacts": true, "steps": [{ "title": "t", "release": ["r"], "remove": ["a"], "place": ["a"],
            "hold": { "r": "a", "q": { "block": "a", "at": [1, 2] } }, "plan": { "r": "a" } }, {}], "silence": ["x"] }"##;

    #[test]
    fn a_file_has_all_values_of_its_text() {
        let figure = include_str!("../../../assets/thesis/figure-4.json");
        for text in [EVERYTHING, include_str!("../../../assets/starter.json"), figure] {
            let file = SceneFile::from_json(text).expect("a scene file");
            assert_eq!(values(&file.to_json()), values(text));
            assert_eq!(SceneFile::from_json(&file.to_json()), Ok(file));
        }
    }

    #[test]
    fn a_changed_text_is_refused_or_read_with_all_its_values() {
        // Replace every value in turn, and every key.
        let source = syntax::json(EVERYTHING, &SCENE).expect("JSON");
        let mut places = Vec::new();
        let tree = source.tree.as_ref().expect("a syntax tree");
        places_of(tree, &tree.root, &mut places);
        assert!(places.len() > 100);
        let (mut refused, mut read) = (0, 0);
        for range in places {
            for other in
                ["null", "true", "-1", "0.5", "\"x\"", "[]", "{}", "[1, 2]", "\"up\"", "[1, 2, \"up\"]", "1e999"]
            {
                let text = format!("{}{other}{}", &EVERYTHING[..range.start], &EVERYTHING[range.end..]);
                match SceneFile::from_json(&text) {
                    Ok(file) => {
                        read += 1;
                        assert_eq!(values(&file.to_json()), values(&text), "{text}");
                    }
                    Err(_) => refused += 1,
                }
            }
        }
        assert!(refused > 800 && read > 200, "{refused} {read}");
    }

    fn places_of(tree: &Tree<'_>, node: &Node<'_>, places: &mut Vec<std::ops::Range<usize>>) {
        places.push(node.range.clone());
        match &node.kind {
            NodeKind::List(list) => (tree.items(list).iter()).for_each(|n| places_of(tree, n, places)),
            NodeKind::Object(object) => {
                for entry in tree.entries(object) {
                    places.push(entry.name_range.clone());
                    places_of(tree, &entry.value, places);
                }
            }
            _ => {}
        }
    }
}
