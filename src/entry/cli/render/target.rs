//! Chooses the files for figures: one for each scene, or one for each part of a figure.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use crate::entry::cli::destination::Destination;
use crate::entry::cli::error::CliError;
use crate::entry::cli::picture::Format;
use crate::entry::cli::source::{name, stem};

/// Returns the path of one part of a figure: `name-a.svg` for the figure `name.svg` and the part `a`.
pub(super) fn part_path(path: &Path, part: &str) -> PathBuf {
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
                    return Err(CliError::CommandLine(format!("{a} and {b} would both become {shown}; rename one")));
                }
                paths.push(path);
            }
            Ok(paths)
        }
    }
}
