//! Reads the scenes of a command: files, the files in folders, or standard input.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

use crate::entry::cli::error::CliError;
use crate::entry::cli::terminal::Terminal;
use crate::entry::request::AnalysisArgs;
use crate::entry::value::FrameChoice;
use crate::mechanics::scene::{Scene, SceneError, isolate};
use crate::pictures::output::attachment::{file_in, is_picture};
use crate::products::snapshot::discovery::looks_like_scene;
use crate::products::snapshot::setting::matches_pattern;
use crate::read::file;

/// Reading a scene may exceed the time limit by this duration. A program with debug assertions is many times slower.
const GRACE: Duration = Duration::from_millis(if cfg!(debug_assertions) { 10_000 } else { 300 });

/// A scene and the path from which it was read.
#[derive(Debug)]
pub(crate) struct Source {
    /// The path as typed, `-` for standard input.
    pub(crate) path: PathBuf,
    /// The checked scene.
    pub(crate) scene: Arc<Scene>,
    /// Its file, with the values that `--set` changes.
    pub(crate) file: Vec<u8>,
}

impl Source {
    /// Returns the file name without folders and extension; `scene` for standard input.
    pub(crate) fn stem(&self) -> String {
        stem(&self.path)
    }

    /// Returns the path of the file for messages; `standard input` for `-`.
    pub(crate) fn name(&self) -> String {
        name(&self.path)
    }

    /// Returns the file as text.
    pub(crate) fn text(&self) -> String {
        String::from_utf8_lossy(&self.file).trim_start_matches('\u{feff}').to_owned()
    }
}

/// Reads all scenes. If any file cannot be read or is not a valid scene, returns the errors of all such files. With
/// `frame`, each scene keeps only this frame. `level` has the contact tolerance and
/// the values that replace those of the scenes.
pub(crate) fn read(
    paths: &[PathBuf],
    frame: Option<FrameChoice>,
    level: &AnalysisArgs,
) -> Result<Vec<Source>, Vec<CliError>> {
    match read_apart_from_faults(files(paths)?.scenes, frame, level)? {
        (sources, faults) if faults.is_empty() => Ok(sources),
        (_, faults) => Err(faults),
    }
}

/// Reads all scenes. Returns the scenes, and separately the errors of files on which the program itself failed. If any
/// file has another error, returns the errors of all files instead.
pub(crate) fn read_apart_from_faults(
    files: Vec<PathBuf>,
    frame: Option<FrameChoice>,
    level: &AnalysisArgs,
) -> Result<(Vec<Source>, Vec<CliError>), Vec<CliError>> {
    let mut sources = Vec::new();
    let mut complaints = Vec::new();
    for (_, source) in read_each(files, frame, level)? {
        match source {
            Ok(source) => sources.push(source),
            Err(complaint) => complaints.push(complaint),
        }
    }
    if complaints.iter().all(CliError::is_internal_fault) { Ok((sources, complaints)) } else { Err(complaints) }
}

/// A path, and the scene that was read from it or the error.
pub(crate) type ReadResult = (PathBuf, Result<Source, CliError>);

/// Reads all scenes, and returns a scene or an error for each file. Returns a single error if `files` contains standard
/// input twice.
pub(crate) fn read_each(
    files: Vec<PathBuf>,
    frame: Option<FrameChoice>,
    level: &AnalysisArgs,
) -> Result<Vec<ReadResult>, CliError> {
    if files.iter().filter(|p| *p == Path::new("-")).count() > 1 {
        return Err(CliError::CommandLine("standard input (-) can be read only once".into()));
    }
    let outcome = |path: PathBuf| {
        let source = read_one(&path, level).and_then(|mut source| {
            if let Some(frame) = frame {
                source.scene = frame.of(&source.scene, &source.name()).map_err(CliError::NoSuchFrame)?.into();
            }
            Ok(source)
        });
        (path, source)
    };
    Ok(files.into_iter().map(outcome).collect())
}

/// The files that a command reads.
#[derive(Default)]
pub(crate) struct Files {
    /// The scene files in the order of the given paths. The files of a folder are sorted by name.
    pub(crate) scenes: Vec<PathBuf>,
    /// The `.json` files in folders that are no scenes, because they have no key `drystone`.
    foreign: Vec<PathBuf>,
}

impl Files {
    /// Names the files that are no scenes, and returns the scene files.
    pub(crate) fn noted(self, terminal: &Terminal) -> Vec<PathBuf> {
        for file in self.foreign {
            terminal.note(&format!("{}: left out, because it has no key \"drystone\"", name(&file)));
        }
        self.scenes
    }
}

/// Replaces each folder by the scene files in it. Subfolders are not read. Returns an error if a folder cannot be read or
/// has no scene file.
pub(crate) fn files(paths: &[PathBuf]) -> Result<Files, CliError> {
    let mut files = Files::default();
    for path in expanded(paths)? {
        if !path.is_dir() {
            files.scenes.push(path);
            continue;
        }
        let found = files_in(&path, &["json"], false)?;
        if found.is_empty() {
            return Err(CliError::not_read(name(&path), "the folder contains no .json files"));
        }
        // A file that cannot be read is reported later.
        let is_scene = |path: &PathBuf| file::bytes(path).map_or(true, |bytes| looks_like_scene(&bytes));
        let (scenes, others): (Vec<PathBuf>, Vec<PathBuf>) = found.into_iter().partition(is_scene);
        if scenes.is_empty() {
            let why = "none of the .json files in the folder has the key \"drystone\"";
            return Err(CliError::not_read(name(&path), why));
        }
        files.scenes.extend(scenes);
        files.foreign.extend(others);
    }
    Ok(files)
}

/// Replaces each pattern, a path with `*` in its last part that no file has as its name, by the files that match it,
/// sorted by name. A shell does this too, unless the pattern is in quotes. Returns an error if no file matches, or if one
/// of several paths is a pipe or a device.
pub(crate) fn expanded(paths: &[PathBuf]) -> Result<Vec<PathBuf>, CliError> {
    let mut all = Vec::new();
    if paths.len() > 1 {
        refuse_streams(paths)?;
    }
    for path in paths {
        let pattern = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        if !pattern.contains('*') || path.exists() {
            all.push(path.clone());
            continue;
        }
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let listed = fs::read_dir(folder.unwrap_or(Path::new("."))).into_iter().flatten().flatten();
        let names = listed.filter(|entry| entry.path().is_file() || entry.path().is_dir());
        let names = names.map(|entry| entry.file_name());
        let mut found: Vec<PathBuf> = (names.filter(|name| matches_pattern(&pattern, &name.to_string_lossy())))
            .map(|name| path.with_file_name(name))
            .collect();
        if found.is_empty() {
            return Err(CliError::not_read(name(path), "no file matches this pattern"));
        }
        found.sort();
        all.append(&mut found);
    }
    Ok(all)
}

/// Refuses pipes and devices, which can be read only once, and may never end.
pub(crate) fn refuse_streams(paths: &[PathBuf]) -> Result<(), CliError> {
    let is_stream = |path: &&PathBuf| fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    match paths.iter().find(is_stream) {
        Some(stream) => Err(CliError::not_read(name(stream), file::NO_FILE)),
        None => Ok(()),
    }
}

/// Returns the files at `paths` and all `.json` files in folders, without reading them. A folder that cannot be read has
/// none.
pub(crate) fn candidates(paths: &[PathBuf]) -> Vec<PathBuf> {
    let each =
        |path: PathBuf| if path.is_dir() { files_in(&path, &["json"], false).unwrap_or_default() } else { vec![path] };
    expanded(paths).unwrap_or_default().into_iter().flat_map(each).collect()
}

/// Returns the files in a folder whose names have one of these extensions, sorted by path. `is_deep` includes those in
/// subfolders. Links to folders are not followed: they may form a cycle.
pub(crate) fn files_in(folder: &Path, extensions: &[&str], is_deep: bool) -> Result<Vec<PathBuf>, CliError> {
    let unread = |path: &Path, error: io::Error| CliError::not_read(name(path), error);
    let (mut files, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).map_err(|error| unread(&folder, error))? {
            let entry = entry.map_err(|error| unread(&folder, error))?;
            let path = entry.path();
            if is_deep && entry.file_type().map_err(|error| unread(&path, error))?.is_dir() {
                folders.push(path);
            } else if extensions.contains(&file::ending(&path).as_str()) && path.is_file() {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// The extensions of drawings, which only `import` reads.
const DRAWINGS: [&str; 3] = ["dxf", "svg", "wkt"];

/// Reads the file that the user named, which may be a pipe, or standard input for `-`.
pub(crate) fn bytes(path: &Path) -> Result<Vec<u8>, CliError> {
    let read = if path == Path::new("-") {
        file::all(io::stdin().lock())
    } else if refuse_streams(&[path.to_owned()]).is_err() {
        File::open(path).and_then(file::all)
    } else {
        file::bytes(path)
    };
    read.map_err(|error| CliError::not_read(name(path), error))
}

/// Reads a scene file, or the one that a PNG or a PDF carries.
pub(crate) fn scene_bytes(path: &Path) -> Result<Vec<u8>, CliError> {
    let bytes = bytes(path)?;
    if DRAWINGS.contains(&file::ending(path).as_str()) && !bytes.trim_ascii_start().starts_with(b"{") {
        let shown = name(path);
        return Err(format!("{shown} is a drawing: drystone import {shown} -o scene.json makes a scene of it").into());
    }
    if is_picture(&bytes) { carried(path, &bytes) } else { Ok(bytes) }
}

/// Returns the scene file that a picture carries.
pub(crate) fn carried(path: &Path, picture: &[u8]) -> Result<Vec<u8>, CliError> {
    file_in(picture).map_err(|error| CliError::not_read(name(path), error))
}

/// Reads one scene.
pub(crate) fn read_one(path: &Path, level: &AnalysisArgs) -> Result<Source, CliError> {
    let bytes = scene_bytes(path)?;
    match read_in_time(&name(path), 0, bytes, level) {
        Ok(Ok((scene, file))) => Ok(Source { path: path.to_owned(), scene: scene.into(), file }),
        Ok(Err(problems)) => Err(CliError::Scene { name: name(path), problems }),
        Err(late) => Err(CliError::not_read(name(path), late)),
    }
}

/// Reads a scene from bytes like [`AnalysisArgs::read_scene`], but only until the time limit. An internal error becomes a
/// problem of the scene `name`.
///
/// # Errors
/// Words that say that the time limit was reached.
pub(crate) fn read_in_time(
    name: &str,
    lines_before: usize,
    bytes: Vec<u8>,
    level: &AnalysisArgs,
) -> Result<Result<(Scene, Vec<u8>), SceneError>, String> {
    let (own, own_level) = (name.to_owned(), level.clone());
    in_time(level, move || {
        let read = || own_level.read_scene(lines_before, &bytes).map(|(scene, file)| (scene, file.into_owned()));
        isolate(&own, read).flatten()
    })
}

/// Does work that keeps no time limit itself, in a thread of its own if there is a limit.
///
/// # Errors
/// Words that say that the time limit was reached. The work then goes on until the program ends.
fn in_time<R: Send + 'static>(level: &AnalysisArgs, work: impl FnOnce() -> R + Send + 'static) -> Result<R, String> {
    let Some(limit) = level.time_limit else { return Ok(work()) };
    let (done, result) = channel();
    let left = limit.left(GRACE);
    if !left.is_zero() {
        thread::spawn(move || {
            // Nobody receives the scene after the time limit.
            let _ = done.send(work());
        });
    }
    result
        .recv_timeout(left)
        .map_err(|_| format!("the time limit of {:?} was reached while the file was checked", limit.given))
}

/// Runs `work` for one scene file. A panic in `work` becomes an error of this file.
pub(crate) fn isolated<R>(path: &Path, work: impl FnOnce() -> R) -> Result<R, CliError> {
    let name = name(path);
    isolate(&name, work).map_err(|problems| CliError::Scene { name, problems })
}

/// Returns the file name of a path without folders and extension; `scene` for standard input.
pub(crate) fn stem(path: &Path) -> String {
    if path == Path::new("-") {
        return "scene".into();
    }
    let stem = path.file_stem().unwrap_or(OsStr::new("scene"));
    stem.to_string_lossy().into_owned()
}

/// Returns a path as text for messages; `standard input` for `-`.
pub(crate) fn name(path: &Path) -> String {
    if path == Path::new("-") { "standard input".into() } else { path.display().to_string() }
}
