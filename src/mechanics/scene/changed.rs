//! Reads a scene in which some values are replaced, by [`Setting`]s.

use std::borrow::Cow;

use super::format::Setting;
use super::format::setting::{changed, is_within};
use super::note::{Lines, Note, NoteCode};
use super::{Scene, SceneError};

impl Scene {
    /// Reads and checks the bytes of a scene file, like [`Scene::from_slice_within`], with other values in place of
    /// some. In its file, `lines_before` lines stand before it. Also returns the bytes of the scene with these values.
    pub(crate) fn from_slice_set<'b>(
        lines_before: usize,
        bytes: &'b [u8],
        tolerance: Option<f64>,
        settings: &[Setting],
    ) -> Result<(Scene, Cow<'b, [u8]>), SceneError> {
        let plain = |bytes: &[u8]| Scene::from_slice_after(lines_before, bytes, tolerance);
        let text = std::str::from_utf8(bytes).ok().filter(|_| !settings.is_empty());
        let Some(text) = text else { return plain(bytes).map(|scene| (scene, bytes.into())) };
        let (set, paths) = changed(text, settings)?;
        let mut scene = plain(set.as_bytes()).map_err(|mut problems| {
            for problem in &mut problems.list {
                if let Some((setting, _)) = paths.iter().find(|(_, path)| is_within(&problem.path, path)) {
                    // The value does not stand in the file, so a line of the file would not show it.
                    (problem.line, problem.column, problem.span) = (0, 0, None);
                    problem.message = format!("--set {setting}: {}", problem.message);
                }
            }
            problems
        })?;
        scene.set = settings.iter().map(ToString::to_string).collect();
        for (number, (setting, path)) in paths.iter().enumerate() {
            let mut others = settings.to_vec();
            others.remove(number);
            let without = changed(text, &others).ok().and_then(|(text, _)| plain(text.as_bytes()).ok());
            if setting.name != "title" && without.is_some_and(|without| without.structure() == scene.structure()) {
                scene.notes.push(Note {
                    code: NoteCode::SetUnused,
                    path: path.clone(),
                    line: 0,
                    message: format!("--set {setting} changes nothing"),
                    hint: "the scene has this value already, or its bodies have values of their own".into(),
                });
            }
        }
        Ok((scene, set.into_bytes().into()))
    }

    /// Returns all that the verdict depends on, as text to be compared.
    fn structure(&self) -> String {
        let (title, notes, lines, set) = (String::new(), Vec::new(), Lines::default(), Vec::new());
        format!("{:?}", Scene { title, notes, lines, set, ..self.clone() })
    }
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
    fn a_number_may_begin_with_a_point() {
        for (typed, read) in [("kernel=.5", "kernel=0.5"), ("tilt=-.25", "tilt=-0.25"), ("title=.x", "title=\".x\"")] {
            assert_eq!(typed.parse::<Setting>().expect("a setting").to_string(), read);
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
