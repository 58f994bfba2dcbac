//! Reads the scenes of a command: files, the files in folders, or standard input.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use crate::entry::cli::error::CliError;
use crate::mechanics::scene::{Scene, isolate};

/// A scene and the path from which it was read.
#[derive(Debug)]
pub(crate) struct Source {
    /// The path as typed, `-` for standard input.
    pub(crate) path: PathBuf,
    /// The checked scene.
    pub(crate) scene: Scene,
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

    /// Removes all frames of the scene except the chosen one. Returns an error if the scene has no such frame.
    fn only_frame(&mut self, choice: FrameChoice) -> Result<(), CliError> {
        let count = self.scene.frames.len();
        let number = match choice {
            FrameChoice::Number(number) => number,
            FrameChoice::Last => count - 1,
        };
        if number >= count {
            let has = if count == 1 { "one frame".into() } else { format!("{count} frames") };
            let why = format!("there is no frame {} in {}: it has {has}", number + 1, self.name());
            return Err(CliError::NoSuchFrame(why));
        }
        self.scene.frames = vec![self.scene.frames[number].clone()];
        Ok(())
    }
}

/// The frame that `--frame` selects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FrameChoice {
    /// The frame with this number, counted from 0.
    Number(usize),
    /// The last frame.
    Last,
}

impl FrameChoice {
    /// Returns the number of the frame, from 0; `None` for the last frame.
    pub(crate) fn number(self) -> Option<usize> {
        match self {
            FrameChoice::Number(number) => Some(number),
            FrameChoice::Last => None,
        }
    }
}

impl FromStr for FrameChoice {
    type Err = String;

    /// Parses a frame: its number, counted from 1, its letter in the figure (`a`, `b`, … `z`, `aa`, …), or `last`.
    fn from_str(typed: &str) -> Result<FrameChoice, String> {
        if typed == "last" {
            return Ok(FrameChoice::Last);
        }
        let number = match typed.parse::<usize>() {
            Ok(number) => Some(number),
            Err(_) if typed.is_empty() || typed.len() > 3 || !typed.bytes().all(|b| b.is_ascii_lowercase()) => None,
            Err(_) => Some(typed.bytes().fold(0, |sum, b| 26 * sum + usize::from(b - b'a') + 1)),
        };
        match number {
            Some(number) if number > 0 => Ok(FrameChoice::Number(number - 1)),
            _ => Err("give a frame: its number, counted from 1, its letter, or `last`".into()),
        }
    }
}

/// Reads all scenes. If any file cannot be read or is not a valid scene, returns the errors of all such files. With
/// `frame`, each scene keeps only this frame. A `tolerance` in metres replaces the contact tolerances of the scenes.
pub(crate) fn read(
    paths: &[PathBuf],
    frame: Option<FrameChoice>,
    tolerance: Option<f64>,
) -> Result<Vec<Source>, Vec<CliError>> {
    match read_apart_from_faults(paths, frame, tolerance)? {
        (sources, faults) if faults.is_empty() => Ok(sources),
        (_, faults) => Err(faults),
    }
}

/// Reads all scenes. Returns the scenes, and separately the errors of files on which the program itself failed. If any
/// file has another error, returns the errors of all files instead.
pub(crate) fn read_apart_from_faults(
    paths: &[PathBuf],
    frame: Option<FrameChoice>,
    tolerance: Option<f64>,
) -> Result<(Vec<Source>, Vec<CliError>), Vec<CliError>> {
    let mut sources = Vec::new();
    let mut complaints = Vec::new();
    for (_, source) in read_each(paths, frame, tolerance).map_err(|c| vec![c])? {
        match source {
            Ok(source) => sources.push(source),
            Err(complaint) => complaints.push(complaint),
        }
    }
    match complaints.iter().all(CliError::is_internal_fault) {
        true => Ok((sources, complaints)),
        false => Err(complaints),
    }
}

/// A path, and the scene that was read from it or the error.
pub(crate) type ReadResult = (PathBuf, Result<Source, CliError>);

/// Reads all scenes, and returns a scene or an error for each file. The files are in the order of `paths`, and the
/// files of a folder in the order of their names. Returns a single error if a folder cannot be read or has no `.json`
/// file, or if `paths` contains standard input twice.
pub(crate) fn read_each(
    paths: &[PathBuf],
    frame: Option<FrameChoice>,
    tolerance: Option<f64>,
) -> Result<Vec<ReadResult>, CliError> {
    let paths = files(paths)?;
    if paths.iter().filter(|p| *p == Path::new("-")).count() > 1 {
        return Err(CliError::CommandLine("standard input (-) can be read only once".into()));
    }
    let outcome = |path: PathBuf| {
        let source = read_one(&path, tolerance).and_then(|mut source| match frame {
            Some(choice) => source.only_frame(choice).map(|()| source),
            None => Ok(source),
        });
        (path, source)
    };
    Ok(paths.into_iter().map(outcome).collect())
}

/// Replaces each folder by the `.json` files in it, sorted by name. Subfolders are not read. Returns an error if a
/// folder has no `.json` file.
pub(crate) fn files(paths: &[PathBuf]) -> Result<Vec<PathBuf>, CliError> {
    let mut all = Vec::new();
    for path in paths {
        if !path.is_dir() {
            all.push(path.clone());
            continue;
        }
        let listed = fs::read_dir(path)
            .and_then(|entries| (entries.map(|entry| entry.map(|e| e.path()))).collect::<io::Result<Vec<PathBuf>>>());
        let listed = listed.map_err(|error| CliError::NotRead { what: name(path), why: error.to_string() })?;
        let is_scene = |file: &PathBuf| file.extension() == Some(OsStr::new("json"));
        let mut scenes: Vec<PathBuf> = (listed.into_iter()).filter(|file| is_scene(file) && file.is_file()).collect();
        if scenes.is_empty() {
            return Err(CliError::NotRead { what: name(path), why: "the folder contains no .json files".into() });
        }
        scenes.sort();
        all.append(&mut scenes);
    }
    Ok(all)
}

fn read_one(path: &Path, tolerance: Option<f64>) -> Result<Source, CliError> {
    Ok(with_text(path, tolerance)?.0)
}

/// Reads one scene. Returns the scene together with the text of its file.
pub(crate) fn with_text(path: &Path, tolerance: Option<f64>) -> Result<(Source, String), CliError> {
    let bytes = if path == Path::new("-") {
        let mut bytes = Vec::new();
        io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
    } else {
        fs::read(path)
    };
    let bytes = bytes.map_err(|error| CliError::NotRead { what: name(path), why: error.to_string() })?;
    let scene = isolated(path, || Scene::from_slice_within(&bytes, tolerance))?;
    let scene = scene.map_err(|problems| CliError::Scene { name: name(path), problems })?;
    let source = Source { path: path.to_owned(), scene };
    let text = String::from_utf8_lossy(&bytes);
    Ok((source, text.trim_start_matches('\u{feff}').to_owned()))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_chosen_by_number_or_letter() {
        for (typed, number) in [("1", 0), ("12", 11), ("a", 0), ("f", 5), ("z", 25), ("aa", 26), ("ab", 27)] {
            assert_eq!(typed.parse(), Ok(FrameChoice::Number(number)), "{typed}");
        }
        assert_eq!("last".parse(), Ok(FrameChoice::Last));
        // The letters of a longer word are not the number of a frame.
        for typed in ["0", "", "-1", "A", "1.5", "abcde", "é", "next", "first"] {
            assert!(typed.parse::<FrameChoice>().is_err(), "{typed}");
        }
    }
}
