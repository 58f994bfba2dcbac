//! `drystone render --broken`: draws the outlines of a scene that is not valid, and marks its problems.

use std::path::{Path, PathBuf};

use super::Render;
use super::output::paths;
use crate::entry::cli::destination::{self, Destination};
use crate::entry::cli::error::CliError;
use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::picture::Format;
use crate::entry::cli::source::{self, isolated, name};
use crate::entry::cli::terminal::Terminal;
use crate::mechanics::scene::Sketch;
use crate::pictures::output::file::Existing;
use crate::pictures::output::fonts::Fonts;
use crate::products::figure;

impl Render {
    /// Draws and writes the outlines of all scenes, and then returns their problems as errors.
    pub(super) fn sketched(
        &self,
        scenes: &[PathBuf],
        destination: &Destination,
        format: Format,
        fonts: &Fonts,
        terminal: &Terminal,
    ) -> Result<ExitStatus, Vec<CliError>> {
        let options = self.draw.options()?;
        let targets: Vec<&Path> = scenes.iter().map(PathBuf::as_path).collect();
        let paths = paths(destination, &targets, format)?;
        let inputs: Vec<&Path> = targets.iter().copied().chain(self.draw.look.file()).collect();
        destination::refuse_overwrites(&paths, &inputs)?;

        let mut pictures = Vec::new();
        let mut complaints = Vec::new();
        let mut drawn: Vec<PathBuf> = Vec::new();
        for (path, target) in scenes.iter().zip(&targets_of(&paths, scenes.len())) {
            match self.sketch(path, &options, format, fonts)? {
                Ok((sketch, picture)) => {
                    drawn.push(target.clone());
                    pictures.push(picture);
                    if !sketch.problems.list.is_empty() {
                        complaints.push(CliError::Scene { name: name(path), problems: sketch.problems });
                    }
                }
                Err(fault) => complaints.push(fault),
            }
        }
        self.write_sketches(destination, drawn, pictures, terminal)?;
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

    /// Writes all picture files or none. The destination may also be standard output.
    fn write_sketches(
        &self,
        destination: &Destination,
        paths: Vec<PathBuf>,
        pictures: Vec<Vec<u8>>,
        terminal: &Terminal,
    ) -> Result<(), CliError> {
        if let Destination::Stdout = destination {
            for picture in &pictures {
                terminal.print_bytes(picture)?;
            }
            return Ok(());
        }
        if let Destination::Folder(folder) = destination {
            destination::make_folder(folder)?;
        }
        let files: Vec<(PathBuf, Vec<u8>)> = paths.iter().cloned().zip(pictures).collect();
        destination::write(&files, Existing::Replace)?;
        for path in &paths {
            terminal.note(&format!("{}: outlines and problems", path.display()));
        }
        Ok(())
    }
}

/// Returns a path for each of `count` scenes. For standard output, which has no paths, all of them are empty.
fn targets_of(paths: &[PathBuf], count: usize) -> Vec<PathBuf> {
    let mut paths = paths.to_vec();
    paths.resize(count, PathBuf::new());
    paths
}
