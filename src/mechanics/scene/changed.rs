//! Reads a scene in which some values are replaced, by [`Setting`]s.

use std::borrow::Cow;
use std::cell::RefCell;

use super::format::setting::{Paths, apply, is_within};
use super::format::{SceneFile, Setting};
use super::note::{Lines, Note, NoteCode};
use super::reading::{from_bytes, unchanged};
use super::{Code, Scene, SceneError};
use crate::read::Source;

impl Scene {
    /// Reads and checks the bytes of a scene file, like [`Scene::from_slice_within`], with other values in place of
    /// some. In its file, `lines_before` lines stand before it. Also returns the bytes of a scene file with these values.
    pub(crate) fn from_slice_set<'b>(
        lines_before: usize,
        bytes: &'b [u8],
        tolerance: Option<f64>,
        settings: &[Setting],
    ) -> Result<(Scene, Cow<'b, [u8]>), SceneError> {
        if settings.is_empty() {
            return from_bytes(lines_before, bytes, tolerance, &unchanged).map(|(scene, _)| (scene, bytes.into()));
        }
        let (result, paths) = read(lines_before, bytes, tolerance, settings);
        let (mut scene, file) = result.map_err(|problems| of_settings(problems, settings, &paths, "--set "))?;
        scene.set = settings.iter().map(ToString::to_string).collect();
        for (number, (setting, path)) in settings.iter().zip(paths).enumerate() {
            let others = [&settings[..number], &settings[number + 1..]].concat();
            let without = read(lines_before, bytes, tolerance, &others).0;
            if setting.name != "title" && without.is_ok_and(|(without, _)| without.structure() == scene.structure()) {
                scene.notes.push(Note {
                    code: NoteCode::SetUnused,
                    path,
                    line: 0,
                    message: format!("--set {setting} changes nothing"),
                    hint: "the scene has this value already, or its bodies have values of their own".into(),
                });
            }
        }
        Ok((scene, file.to_json().into_bytes().into()))
    }

    /// Reads and checks the bytes of a scene file with other values in place of some. Does not note which of them change
    /// nothing. Also returns the file with these values.
    pub(crate) fn from_slice_changed(
        bytes: &[u8],
        tolerance: Option<f64>,
        settings: &[Setting],
    ) -> Result<(Scene, SceneFile), SceneError> {
        let (result, paths) = read(0, bytes, tolerance, settings);
        result.map_err(|problems| of_settings(problems, settings, &paths, ""))
    }

    /// Returns all that the verdict depends on, as text to be compared.
    fn structure(&self) -> String {
        let (title, notes, lines, set) = (String::new(), Vec::new(), Lines::default(), Vec::new());
        format!("{:?}", Scene { title, notes, lines, set, ..self.clone() })
    }
}

/// Adds to each problem the setting that causes it, and removes the line: the value of a setting is not in the file.
fn of_settings(mut problems: SceneError, settings: &[Setting], paths: &Paths, option: &str) -> SceneError {
    for problem in &mut problems.list {
        if problem.code == Code::UnknownName && paths.is_empty() {
            problem.message.insert_str(0, option);
            continue;
        }
        let found = paths.iter().position(|path| is_within(&problem.path, path));
        if let Some(setting) = found.and_then(|number| settings.get(number)) {
            (problem.line, problem.column, problem.span) = (0, 0, None);
            problem.message = format!("{option}{setting}: {}", problem.message);
        }
    }
    problems
}

/// Reads a scene with these settings. Also returns the paths of their values.
fn read<'t>(
    lines_before: usize,
    bytes: &'t [u8],
    tolerance: Option<f64>,
    settings: &'t [Setting],
) -> (Result<(Scene, SceneFile), SceneError>, Paths) {
    let paths = RefCell::default();
    let edit = |source: &mut Source<'t>| apply(settings, source).map(|found| *paths.borrow_mut() = found);
    (from_bytes(lines_before, bytes, tolerance, &edit), paths.take())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = r#"{ "drystone": 1, "title": "Two",
        "ground": [{ "polygon": [[-9, -1], [9, -1], [9, 0], [-9, 0]] }],
        "blocks": [{ "id": "a.b", "polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "density": 3 },
                   { "polygon": [[0, 1], [2, 1], [2, 2], [0, 2]], "weight": 3, "friction": 0.4 }],
        "loads": [{ "block": "2", "force": [1, -2], "torque": 3 }] }"#;

    fn set(typed: &[&str]) -> Result<(Scene, String), SceneError> {
        let settings: Vec<Setting> = typed.iter().map(|typed| typed.parse().expect("a setting")).collect();
        let (scene, text) = Scene::from_slice_set(0, SCENE.as_bytes(), None, &settings)?;
        Ok((scene, String::from_utf8(text.into_owned()).expect("UTF-8")))
    }

    #[test]
    fn values_are_replaced_and_stated_in_the_title() {
        let typed = ["friction=0.5", "kernel=0.1", "blocks.a.b.weight=20", "blocks.2.friction=0.9", "load_factor=2"];
        let (scene, text) = set(&typed).expect("a scene");
        assert_eq!((scene.kernel, scene.blocks[0].weight, scene.blocks[1].body.friction), (0.1, 20.0, 0.9));
        assert_eq!((scene.loads[0].force.y, scene.loads[0].torque), (-4.0, 6.0));
        assert_eq!(scene.ground[0].body.friction, 0.5);
        assert!(scene.title.starts_with("Two, with friction = 0.5, kernel = 0.1, blocks.a.b.weight = 20"), "{text}");
        assert_eq!(scene.set, typed);
        // The text alone says the same.
        let again = Scene::from_json(&text).expect("a scene");
        assert_eq!(again.structure(), scene.structure());
        assert_eq!(again.title, scene.title);
    }

    #[test]
    fn a_body_moves_by_one_coordinate_of_its_position() {
        let (scene, _) = set(&["blocks[0].at[0]=0.5", "blocks[0].at[1]=2"]).expect("a scene");
        let least = scene.blocks[0].body.polygon.bounds().min;
        assert_eq!((least.x, least.y), (0.5, 2.0));
        // A load without a place acts at the centre of gravity, not at the origin.
        assert!(set(&["loads[0].at[0]=0.5"]).is_err() && set(&["blocks[0].at[2]=1"]).is_err());
    }

    #[test]
    fn a_number_may_begin_with_a_point() {
        let (scene, _) = set(&["friction=.5", "tilt=-.5", "blocks[0].friction=.25"]).expect("a scene");
        assert_eq!((scene.ground[0].body.friction, scene.blocks[0].body.friction), (0.5, 0.25));
        assert!(
            (scene.gravity.x / scene.gravity.y - libm::tan(0.5_f64.to_radians())).abs() < 1e-12,
            "{:?}",
            scene.gravity
        );
        assert_eq!(scene.set, ["friction=0.5", "tilt=-0.5", "blocks[0].friction=0.25"]);
        // Other words with a point at the beginning are strings.
        for typed in ["title=.", "title=.5.", "title=-.", "title=.a"] {
            let (scene, _) = set(&[typed]).expect("a scene");
            assert_eq!(format!("title={}", scene.title), typed);
        }
    }

    #[test]
    fn missing_keys_are_added_and_lines_are_those_of_the_file() {
        let (scene, text) =
            set(&["units.length=mm", "blocks[1]={ \"mass\": 2, \"polygon\": [[0,1],[2,1],[2,2]] }"]).expect("a scene");
        assert_eq!(scene.units.length().symbol(), "mm");
        assert_eq!((scene.blocks[1].weight, scene.lines.blocks.as_slice()), (2.0 * 9.81, [3, 4].as_slice()));
        assert!(text.contains("\"length\": \"mm\""), "{text}");
        let wrong = set(&["unit.length=mm", "friction=1e999"]).expect_err("two values").to_string();
        for words in ["--set unit.length=\"mm\": unknown key `unit`", "the number inf is too large"] {
            assert!(wrong.contains(words), "{wrong}");
        }
        let wrong = set(&["title.x=1"]).expect_err("a string").to_string();
        assert!(wrong.contains("\"Two\" has no key \"x\""), "{wrong}");
        let wrong = set(&["units=3", "units.length=m"]).expect_err("a number").to_string();
        assert!(wrong.contains("the value set before has no key \"length\""), "{wrong}");
        let deep = "a.".repeat(60_000);
        assert!(format!("{deep}a=1").parse::<Setting>().is_err());
        assert!(set(&[&format!("{}=1", "a.b.".repeat(30))]).is_err());
    }

    #[test]
    fn a_tilt_turns_gravity_as_the_margin_does() {
        let (right, _) = set(&["gravity=[0,-2]", "tilt=90"]).expect("a scene");
        assert!((right.gravity.x - 2.0).abs() < 1e-12 && right.gravity.y.abs() < 1e-12, "{:?}", right.gravity);
    }

    #[test]
    fn all_wrong_settings_are_reported_at_once_with_suggestions() {
        let wrong = set(&["blocks.a.c.weight=1", "loads[7].torque=2"]).expect_err("two names").to_string();
        for words in ["no entry \"a.c\" here", "did you mean \"a.b\"?", "no entry [7]"] {
            assert!(wrong.contains(words), "{wrong}");
        }
        let wrong = set(&["fricton=0.5", "kernel=3", "blocks.2.weight=-1"]).expect_err("three values");
        let shown = wrong.to_string();
        for words in ["--set fricton=0.5: ", "the nearest known key is `friction`", "--set kernel=3: ", "weight=-1: "] {
            assert!(shown.contains(words), "{shown}");
        }
        assert_eq!(wrong.list.len(), 3);
        for typed in ["friction", "=3", "kernel=", "tilt=left", "load_factor=x"] {
            assert!(typed.parse::<Setting>().is_err(), "{typed}");
        }
    }

    #[test]
    fn a_setting_without_effect_is_noted() {
        let (scene, _) = set(&["friction=0.7", "kernel=0.2"]).expect("a scene");
        let notes: Vec<&str> = scene.notes.iter().map(|note| note.message.as_str()).collect();
        assert!(notes.contains(&"--set friction=0.7 changes nothing"), "{notes:?}");
        assert!(!notes.iter().any(|note| note.contains("kernel")), "{notes:?}");
    }
}
