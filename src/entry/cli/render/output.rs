//! Chooses the files for figures, one for each scene or one for each part of a figure, and writes them; with
//! `--broken`, it draws the outlines of a scene that is not valid, and marks its problems.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::Render;
use crate::entry::cli::destination::{self, Destination};
use crate::entry::cli::error::{CliError, Ended};
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::picture::Format;
use crate::entry::cli::source::{self, isolated, name, stem};
use crate::entry::cli::terminal::Terminal;
use crate::mechanics::analysis::{Analysis, Verdict};
use crate::mechanics::scene::Sketch;
use crate::pictures::output::file::Existing;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;
use crate::products::wording::number::letter;
use crate::products::wording::verdict::tally;

/// Returns the path of one part of a figure: `name-a.svg` for the figure `name.svg` and the part `a`.
fn part_path(path: &Path, part: &str) -> PathBuf {
    let text = |part: Option<&OsStr>| part.map(|p| p.to_string_lossy().into_owned());
    let stem = text(path.file_stem()).unwrap_or_default();
    let ending = text(path.extension()).map_or_else(String::new, |e| format!(".{e}"));
    path.with_file_name(format!("{stem}-{part}{ending}"))
}

/// Returns the path of each scene's figure, in the order of the scenes. The list is empty for standard output.
pub(super) fn paths(destination: &Destination, scenes: &[&Path], format: Format) -> Result<Vec<PathBuf>, CliError> {
    match destination {
        Destination::Stdout => Ok(Vec::new()),
        Destination::File(path) => Ok(vec![path.clone()]),
        Destination::Folder(folder) => {
            let mut paths: Vec<PathBuf> = Vec::new();
            for scene in scenes {
                let path = folder.join(format!("{}.{}", stem(scene), format.ending()));
                if let Some(first) = paths.iter().position(|p| *p == path) {
                    let (a, b, shown) = (name(scenes[first]), name(scene), path.display());
                    return Err(format!("{a} and {b} would both become {shown}; rename one").into());
                }
                paths.push(path);
            }
            Ok(paths)
        }
    }
}

/// A figure, with the exit status and a summary of its scene.
pub(super) struct Rendered {
    /// The content of each file; there are several if each panel or page is a separate file.
    pub(super) bytes: Vec<Vec<u8>>,
    pub(super) ending: ExitStatus,
    pub(super) summary: String,
}

/// Moves internal faults of the program to `faults`. Returns the results of the other scenes, and the paths of their
/// figures. `paths` has one path for each result, or is empty for standard output.
pub(super) fn without_faults(
    rendered: Vec<Result<Rendered, CliError>>,
    paths: Vec<PathBuf>,
    faults: &mut Vec<CliError>,
) -> (Vec<Result<Rendered, CliError>>, Vec<PathBuf>) {
    let (mut results, mut targets) = (Vec::new(), Vec::new());
    let mut paths = paths.into_iter();
    for result in rendered {
        // Standard output has no paths, so `path` may be `None`.
        let path = paths.next();
        match result {
            Err(complaint) if complaint.is_internal_fault() => faults.push(complaint),
            other => {
                results.push(other);
                targets.extend(path);
            }
        }
    }
    (results, targets)
}

impl Render {
    /// Writes all picture files or none, and then prints a line about each scene. To standard output, writes only the
    /// pictures.
    pub(super) fn write(
        &self,
        rendered: Vec<Rendered>,
        destination: &Destination,
        paths: &[PathBuf],
        terminal: &Terminal,
    ) -> Result<(), CliError> {
        if let Destination::Stdout = destination {
            for picture in rendered.iter().flat_map(|r| &r.bytes) {
                terminal.print_bytes(picture)?;
            }
            return Ok(());
        }
        if let Destination::Folder(folder) = destination {
            destination::make_folder(folder, folder)?;
        }
        let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
        let mut summaries = Vec::new();
        for (path, rendered) in paths.iter().zip(rendered) {
            let count = rendered.bytes.len();
            summaries.push((self.written(path, count), rendered.summary));
            for (number, bytes) in rendered.bytes.into_iter().enumerate() {
                files.push((self.target(path, number, count), bytes));
            }
        }
        destination::write(&files, Existing::Replace, destination.typed())?;
        for (written, summary) in summaries {
            terminal.note(&format!("{written}: {summary}"));
        }
        Ok(())
    }

    /// Returns the name of a figure's file, `a.pdf`, or the names of its first and last file, `a-1.pdf to a-3.pdf`.
    fn written(&self, path: &Path, parts: usize) -> String {
        let first = self.target(path, 0, parts).display().to_string();
        match parts {
            0 | 1 => first,
            2 => format!("{first} and {}", self.target(path, 1, parts).display()),
            _ => format!("{first} to {}", self.target(path, parts - 1, parts).display()),
        }
    }

    /// Returns the path of one of `count` parts of a figure; `number` counts the parts from 0. If the figure is one
    /// file, returns the path unchanged.
    fn target(&self, path: &Path, number: usize, count: usize) -> PathBuf {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if (self.pages || self.panels) && (name.contains("{p}") || name.contains("{0p}")) {
            let (page, digits) = (number + 1, count.to_string().len());
            let name = name.replace("{p}", &page.to_string()).replace("{0p}", &format!("{page:0digits$}"));
            path.with_file_name(name)
        } else if self.pages {
            part_path(path, &(number + 1).to_string())
        } else if self.panels {
            part_path(path, &letter(number))
        } else {
            path.to_owned()
        }
    }
}

/// Returns how many frames have each verdict, in words: `6 frames: 5 stand, 1 falls`. For a single frame, returns only
/// its verdict.
pub(super) fn summary(analysis: &Analysis) -> String {
    let verdicts: Vec<Verdict> = analysis.frames.iter().map(|frame| frame.verdict).collect();
    match verdicts.as_slice() {
        [one] => one.plain().into(),
        several => format!("{} frames: {}", several.len(), tally(several)),
    }
}

impl Render {
    /// Draws and writes the outlines of all scenes, and then returns their problems as errors.
    pub(super) fn sketched(
        &self,
        scenes: &[PathBuf],
        destination: &Destination,
        format: Format,
        fonts: &Fonts,
        terminal: &Terminal,
    ) -> Ended {
        let options = self.draw.options()?;
        let targets: Vec<&Path> = scenes.iter().map(PathBuf::as_path).collect();
        let paths = paths(destination, &targets, format)?;
        let inputs: Vec<&Path> = targets.iter().copied().chain(self.draw.look.file()).collect();
        destination::refuse_overwrites(&paths, &inputs)?;

        let (mut rendered, mut drawn, mut complaints) = (Vec::new(), Vec::new(), Vec::new());
        for (number, path) in scenes.iter().enumerate() {
            match self.sketch(path, &options, format, fonts)? {
                Ok((sketch, picture)) => {
                    // Standard output has no paths.
                    drawn.extend(paths.get(number).cloned());
                    let (ending, summary) = (ExitStatus::Done, "outlines and problems".to_owned());
                    rendered.push(Rendered { bytes: vec![picture], ending, summary });
                    if !sketch.problems.list.is_empty() {
                        complaints.push(CliError::Scene { name: name(path), problems: sketch.problems });
                    }
                }
                Err(fault) => complaints.push(fault),
            }
        }
        self.write(rendered, destination, &drawn, terminal)?;
        if complaints.is_empty() { Ok(ExitStatus::Done) } else { Err(complaints) }
    }

    /// Reads one scene and draws its outlines. The outer error, such as a file that cannot be read, ends the command.
    /// The inner error means that the program itself failed on this scene; other scenes can still be drawn.
    pub(super) fn sketch(
        &self,
        path: &Path,
        options: &figure::Options,
        format: Format,
        fonts: &Fonts,
    ) -> Result<Result<(Sketch, Vec<u8>), CliError>, CliError> {
        let bytes = source::scene_bytes(path)?;
        let sketched = isolated(path, || {
            let sketch = Sketch::from_bytes(&bytes, self.draw.figure.level.contact_tolerance);
            let drawing = figure::broken(&sketch, options);
            let picture = self.draw.picture.bytes(drawing, format, fonts)?;
            Ok((sketch, picture))
        });
        match sketched {
            Ok(sketched) => sketched.map(Ok),
            Err(fault) => Ok(Err(fault)),
        }
    }
}
