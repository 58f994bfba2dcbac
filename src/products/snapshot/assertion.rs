//! The macros for tests: [`assert_scene!`](crate::assert_scene), [`assert_scenes!`](crate::assert_scenes) and [`assert_figure!`](crate::assert_figure).
//!
//! Paths begin at the folder of the crate that calls them. `UPDATE_SNAPSHOTS=1` writes references, never where `CI` is set; without
//! it what was found lies beside them as `.new.*` and `.diff.png`, and the test fails with what changed in words. Under `CI`
//! nothing is written at all. Every test takes its turn on the folder of its references, so that tests of one program and several
//! programs at once, as nextest runs them, do not get in each other's way.

use std::path::{Component, Path, PathBuf};

use super::check::{self, Acceptance, CheckOutcome, Snapshot, check, folders};
use super::discovery::{DiscoveryError, discover, parts};
use super::setting::{self, Settings};
use super::store::{self, Use};
use crate::drawing::Drawing;

/// The folder of the references of figures, in the crate's own.
const FIGURES: &str = "tests/snapshots";

/// Fails where a scene is not as the references beside it say: `arch.txt`, `arch.svg` and `arch.png` for `arch.json`.
///
/// The path begins at the folder of your crate.
///
/// ```no_run
/// #[test]
/// fn the_arch_stands_as_it_did() {
///     drystone::snapshot::assert_scene!("scenes/arch.json");
/// }
/// ```
#[macro_export]
macro_rules! assert_scene {
    ($path:expr $(,)?) => {
        $crate::snapshot::assertion::scene(env!("CARGO_MANIFEST_DIR").as_ref(), $path.as_ref())
    };
}

/// Fails where any scene in a folder, or below it, is not as the references beside it say, and where a reference has no scene.
///
/// The path begins at the folder of your crate.
///
/// ```no_run
/// #[test]
/// fn all_scenes_are_as_they_were() {
///     drystone::snapshot::assert_scenes!("scenes");
/// }
/// ```
#[macro_export]
macro_rules! assert_scenes {
    ($path:expr $(,)?) => {
        $crate::snapshot::assertion::scenes(env!("CARGO_MANIFEST_DIR").as_ref(), $path.as_ref())
    };
}

/// Fails where a drawing is not as its references say: `tests/snapshots/NAME.svg` and `NAME.png` in the folder of your crate.
///
/// ```no_run
/// use drystone::{Analysis, Scene, figure, snapshot::assert_figure};
///
/// #[test]
/// fn the_thrust_line_is_drawn_as_it_was() {
///     let scene = Scene::from_json(&std::fs::read_to_string("scenes/arch.json").unwrap()).unwrap();
///     let drawing = figure::draw(&Analysis::new(&scene), figure::Kind::Thrust, &figure::Options::default());
///     assert_figure!("thrust in an arch", &drawing);
/// }
/// ```
#[macro_export]
macro_rules! assert_figure {
    ($name:expr, $drawing:expr $(,)?) => {
        $crate::snapshot::assertion::figure(
            env!("CARGO_MANIFEST_DIR").as_ref(),
            $name.as_ref(),
            $drawing,
        )
    };
}

/// What [`assert_scene!`](crate::assert_scene) calls: a scene, by its path from the folder of a crate.
///
/// # Panics
/// Where a reference does not hold, and where the scene is wrong.
#[track_caller]
pub fn scene(crate_folder: &Path, path: &Path) {
    let place = place(crate_folder, path);
    scenes_at(&[place], &place_words(path));
}

/// What [`assert_scenes!`](crate::assert_scenes) calls: all scenes in a folder, by its path from the folder of a crate.
///
/// # Panics
/// Where a reference does not hold or has no scene, and where a scene is wrong or there is none.
#[track_caller]
pub fn scenes(crate_folder: &Path, path: &Path) {
    let place = place(crate_folder, path);
    scenes_at(&[place], &place_words(path));
}

/// What [`assert_figure!`](crate::assert_figure) calls: a drawing, by a name for its references.
///
/// # Panics
/// Where a reference does not hold, and where the name leads out of the folder of references.
#[track_caller]
pub fn figure(crate_folder: &Path, name: &Path, drawing: &Drawing) {
    let inside = name.components().all(|c| matches!(c, Component::Normal(_)));
    if !inside || name.as_os_str().is_empty() {
        fail(&[format!(
            "{:?} is no name for a figure: it leads out of {FIGURES}",
            name.display().to_string()
        )]);
    }
    let base = place(crate_folder, &Path::new(FIGURES).join(name));
    let folder = base.parent().unwrap_or(crate_folder).to_owned();
    let settings = match settings(&folder) {
        Ok(settings) => settings,
        Err(lines) => fail(&lines),
    };
    let parts = parts(&base, &settings);
    let references: Vec<PathBuf> = parts
        .iter()
        .filter(|p| {
            p.layer != check::Layer::Facts
                && p.kind == settings.kinds[0]
                && p.theme == settings.themes[0]
        })
        .map(|p| p.file.clone())
        .collect();
    let parts: Vec<_> = parts
        .into_iter()
        .filter(|p| references.contains(&p.file))
        .collect();
    if may_write() {
        // Where it cannot be made, writing into it tells.
        let _ = std::fs::create_dir_all(&folder);
    }
    let turn = store::turn([folder], usage());
    let snapshot = Snapshot {
        name: name.display().to_string(),
        scene: None,
        references,
        findings: check::of_drawing(drawing, &parts, &settings),
    };
    let report = CheckOutcome {
        snapshots: vec![snapshot],
        ..CheckOutcome::default()
    };
    settle(report, &format!("the figure {}", name.display()));
    drop(turn);
}

fn settings(folder: &Path) -> Result<Settings, Vec<String>> {
    let Some(file) = setting::nearest(folder) else {
        return Ok(Settings::default());
    };
    let text = std::fs::read_to_string(&file)
        .map_err(|e| vec![format!("cannot read {}: {e}", file.display())])?;
    Settings::read(&text).map_err(|problems| {
        let described = problems.into_iter();
        described
            .map(|p| format!("{}:{p}", file.display()))
            .collect()
    })
}

/// Where a path of a crate leads. The folder of the crate when it was built may be gone where the test runs; cargo and nextest then say
/// where it is now.
fn place(crate_folder: &Path, path: &Path) -> PathBuf {
    let now = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    match now {
        Some(now) if !crate_folder.is_dir() => now.join(path),
        _ => crate_folder.join(path),
    }
}

fn place_words(path: &Path) -> String {
    path.display().to_string()
}

fn may_write() -> bool {
    !store::in_ci()
}

fn usage() -> Use {
    if store::asked_to_update() && may_write() {
        Use::Accept
    } else {
        Use::Check
    }
}

#[track_caller]
fn scenes_at(places: &[PathBuf], what: &str) {
    let found = match discover(places, None) {
        Ok(found) => found,
        Err(faults) => fail(
            &faults
                .iter()
                .map(DiscoveryError::to_string)
                .collect::<Vec<_>>(),
        ),
    };
    if found.jobs.is_empty() && found.faults.is_empty() {
        fail(&[format!("there is no scene at {what}")]);
    }
    let files = found.jobs.iter().flat_map(|j| &j.parts).map(|p| &p.file);
    let turn = store::turn(folders(files), usage());
    let report = check(found, &|_| {});
    settle(report, what);
    drop(turn);
}

#[track_caller]
fn settle(mut report: CheckOutcome, what: &str) {
    let accepts = usage() == Use::Accept;
    if report.holds() && !may_write() {
        return;
    }
    let failing: Vec<PathBuf> = report
        .failing()
        .flat_map(|s| s.findings.iter().map(|f| f.file.clone()))
        .collect();
    let mut lines = Vec::new();
    let mut unwritten = Vec::new();
    if may_write() {
        let acceptance = if accepts {
            Acceptance::Accept
        } else {
            Acceptance::Beside
        };
        if let Err(failed) = report.settle(acceptance) {
            unwritten = failed.iter().map(ToString::to_string).collect();
        }
    }
    if report.holds() && unwritten.is_empty() {
        return;
    }
    lines.push(format!(
        "{what} is not as its references say ({}).",
        report.summary()
    ));
    lines.extend(report.lines());
    lines.extend(unwritten);
    if !may_write() {
        lines.push("CI is set: nothing was written. Run the test on your own machine to see the difference.".into());
    } else {
        let picture = failing.iter().find(|f| store::difference(f).exists());
        let other = failing.iter().find(|f| store::found(f).exists());
        match (picture, other) {
            (Some(file), _) => lines.push(format!(
                "Look at {}, and at {} beside {}.",
                store::difference(file).display(),
                store::found(file).display(),
                file.display()
            )),
            (None, Some(file)) => lines.push(format!("Look at {}.", store::found(file).display())),
            (None, None) => {}
        }
        lines.push("If it is meant to be so, run the test again with UPDATE_SNAPSHOTS=1.".into());
    }
    fail(&lines);
}

#[track_caller]
#[allow(
    clippy::panic,
    reason = "an assertion that does not hold ends its test"
)]
fn fail(lines: &[String]) -> ! {
    panic!("{}", lines.join("\n"))
}
