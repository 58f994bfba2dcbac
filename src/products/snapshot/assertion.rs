//! The macros for tests: [`assert_scene!`](crate::assert_scene), [`assert_scenes!`](crate::assert_scenes) and
//! [`assert_figure!`](crate::assert_figure).
//!
//! Paths are relative to the folder of the crate that calls the macros. If a result differs, the test fails and
//! describes the changes. Two environment variables decide which files are written:
//!
//! | `CI` | `UPDATE_SNAPSHOTS` | written |
//! |---|---|---|
//! | not set | not set | the results, as `.new.*` and `.diff.png` next to the references |
//! | not set | 1 | the references |
//! | set | any | nothing |
//!
//! Each test locks the folders of its references. Tests can therefore run at the same time, in one process or, as with
//! nextest, in several processes.

use std::path::{Component, Path, PathBuf};

use super::check::{self, check};
use super::discovery::{discover, settings_in};
use super::layer::Layer;
use super::outcome::{Acceptance, CheckOutcome, Finding, Snapshot, folders};
use super::reference::{Part, parts};
use super::setting::{self, Settings};
use super::store::{self, Access};
use crate::mechanics::analysis::Analysis;
use crate::pictures::drawing::Drawing;

/// What accepts changes, for messages.
const UPDATE: &str = "UPDATE_SNAPSHOTS=1";
/// The folder for the references of figures, relative to the crate.
const FIGURE_FOLDER: &str = "tests/snapshots";

/// Fails if a scene differs from the references next to it: `arch.txt`, `arch.svg` and `arch.png` for `arch.json`.
///
/// The path is relative to the folder of your crate.
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

/// Fails if any scene in a folder or its subfolders differs from its references, or if a reference is orphaned (its
/// scene does not exist, or the settings do not include it).
///
/// The path is relative to the folder of your crate.
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

/// Fails if a drawing differs from its references: `tests/snapshots/NAME.svg` and `NAME.png` in the folder of your
/// crate.
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
        $crate::snapshot::assertion::figure(env!("CARGO_MANIFEST_DIR").as_ref(), $name.as_ref(), $drawing)
    };
}

/// Implements [`assert_scene!`](crate::assert_scene). `path` is the scene file, relative to `crate_folder`.
///
/// # Panics
/// If a reference does not match, if the scene does not exist, or if the scene or the settings are not valid.
#[track_caller]
pub fn scene(crate_folder: &Path, path: &Path) {
    scenes(crate_folder, path);
}

/// Implements [`assert_scenes!`](crate::assert_scenes). `path` is the folder of the scenes, relative to
/// `crate_folder`.
///
/// # Panics
/// If a reference does not match or is orphaned, if a scene or the settings are not valid, or if there is no scene.
#[track_caller]
pub fn scenes(crate_folder: &Path, path: &Path) {
    let what = path.display().to_string();
    let found = discover(&[place(crate_folder, path)], None).unwrap_or_else(|errors| fail(&errors));
    if found.jobs.is_empty() && found.faults.is_empty() {
        fail(&[format!("there is no scene file at {what}")]);
    }
    let files = found.jobs.iter().flat_map(|j| &j.parts).map(|p| &p.file);
    let lock = store::lock_folders(folders(files), access());
    let report = check(found, &|_| {});
    let ended = finish(report, access(), &what, UPDATE);
    drop(lock);
    if let Err(lines) = ended {
        fail(&lines);
    }
}

/// Implements [`assert_figure!`](crate::assert_figure). `name` is the file name of the references without extension.
///
/// # Panics
/// If a reference does not match, if the settings are not valid, or if the name is empty or leads out of the folder of
/// references.
#[track_caller]
pub fn figure(crate_folder: &Path, name: &Path, drawing: &Drawing) {
    let inside = name.components().all(|c| matches!(c, Component::Normal(_)));
    if !inside || name.as_os_str().is_empty() {
        fail(&[format!(
            "{:?} is not a valid name for a figure: it leads out of {FIGURE_FOLDER}; use a plain file name",
            name.display().to_string()
        )]);
    }
    let base = place(crate_folder, &Path::new(FIGURE_FOLDER).join(name));
    let find = |parts: &mut Vec<Part>, settings: &Settings| {
        parts.retain(|p| p.layer != Layer::Facts && p.view == settings.kinds[0] && p.theme == settings.themes[0]);
        check::check_drawing(drawing, parts, settings)
    };
    let what = format!("the figure {}", name.display());
    if let Err(lines) = compared(&base, access(), (&what, UPDATE), find) {
        fail(&lines);
    }
}

/// Compares an analysis with its references, as `drystone snapshot` compares a scene: `base.txt`, `base.svg` and
/// `base.png`. With `accepts`, writes the references that differ, unless the environment variable `CI` is set. The
/// fixture of pytest in the Python package calls this function.
///
/// # Errors
/// The differences in lines, or why the settings are not valid.
pub fn analysis(base: &Path, analysis: &Analysis, accepts: bool) -> Result<(), Vec<String>> {
    let access = if accepts && may_write() { Access::Write } else { Access::Read };
    let find = |parts: &mut Vec<Part>, settings: &Settings| check::check_analysis(analysis, parts, settings);
    let what = base.display().to_string();
    compared(base, access, (&what, "--drystone-accept"), find)
}

/// Compares the results that `find` compares with the references of `base`. The words are the name of the results and
/// the option that accepts changes.
fn compared(
    base: &Path,
    access: Access,
    (what, option): (&str, &str),
    find: impl FnOnce(&mut Vec<Part>, &Settings) -> Vec<Finding>,
) -> Result<(), Vec<String>> {
    let folder = base.parent().unwrap_or(Path::new(".")).to_owned();
    let settings = setting::nearest(&folder).map_or_else(|| Ok(Settings::default()), |file| settings_in(&file))?;
    let mut parts = parts(base, &settings);
    if may_write() {
        // Ignore an error here: writing the files below then fails and reports it.
        let _ = std::fs::create_dir_all(&folder);
    }
    let lock = store::lock_folders([folder], access);
    let findings = find(&mut parts, &settings);
    let name = base.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let references = parts.into_iter().map(|part| part.file).collect();
    let snapshot = Snapshot::new(name, None, references, findings);
    let report = CheckOutcome { snapshots: vec![snapshot], ..CheckOutcome::default() };
    let ended = finish(report, access, what, option);
    drop(lock);
    ended
}

/// Joins the folder of the crate and a path relative to it. `crate_folder` is the folder at compile time. If it does
/// not exist on the machine that runs the test, the function uses the environment variable `CARGO_MANIFEST_DIR`, which
/// Cargo and nextest set.
fn place(crate_folder: &Path, path: &Path) -> PathBuf {
    let now = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    match now {
        Some(now) if !crate_folder.is_dir() => now.join(path),
        _ => crate_folder.join(path),
    }
}

fn may_write() -> bool {
    !store::in_ci()
}

fn access() -> Access {
    if store::update_requested() && may_write() { Access::Write } else { Access::Read }
}

/// Writes what may be written, and describes the differences that remain.
fn finish(mut report: CheckOutcome, access: Access, what: &str, option: &str) -> Result<(), Vec<String>> {
    let accepts = access == Access::Write;
    if report.matches() && !may_write() {
        return Ok(());
    }
    let failing: Vec<PathBuf> = report.failing().flat_map(|s| s.findings.iter().map(|f| f.file.clone())).collect();
    let mut lines = Vec::new();
    let mut unwritten = Vec::new();
    if may_write() {
        let acceptance = if accepts { Acceptance::Accept } else { Acceptance::Propose };
        if let Err(failed) = report.store(acceptance) {
            unwritten = failed.iter().map(ToString::to_string).collect();
        }
    }
    if report.matches() && unwritten.is_empty() {
        return Ok(());
    }
    lines.push(format!("{what} differs from its references ({}).", report.summary()));
    lines.extend(report.lines());
    lines.extend(unwritten);
    if !may_write() {
        lines.push("The environment variable CI is set, so nothing was written. Run the test on your own machine to see the difference.".into());
    } else {
        let pictures = failing.iter().map(|file| store::difference_file(file));
        let others = failing.iter().map(|file| store::new_file(file));
        let first = pictures.chain(others).find(|file| file.exists());
        lines.extend(first.map(|file| format!("Look at {}.", file.display())));
        lines.push(format!("If the change is intended, run the test again with {option}."));
    }
    Err(lines)
}

#[track_caller]
#[allow(clippy::panic, reason = "an assertion that does not hold ends its test")]
fn fail(lines: &[String]) -> ! {
    panic!("{}", lines.join("\n"))
}
