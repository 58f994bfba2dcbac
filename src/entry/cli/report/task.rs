//! [`Task`]: one scene of a report, or two scenes that the report compares.

use std::path::{Path, PathBuf};

use super::Report;
use crate::entry::cli::error::CliError;
use crate::entry::cli::source;

/// One scene of a report, or two scenes that the report compares.
pub(super) enum Task {
    One(PathBuf),
    Two([PathBuf; 2]),
}

impl Report {
    /// Returns the tasks of the report: single scenes, or pairs to compare. Also returns notes about files that only
    /// one of two compared folders contains.
    pub(super) fn tasks(&self) -> Result<(Vec<Task>, Vec<String>), Vec<CliError>> {
        if self.compare {
            return self.pairs();
        }
        if self.scenes.iter().filter(|p| *p == Path::new("-")).count() > 1 {
            let why = "standard input (-) can be read only once";
            return Err(vec![CliError::from(why)]);
        }
        let mut tasks = Vec::new();
        let mut complaints = Vec::new();
        for path in &source::expanded(&self.scenes)? {
            if !path.is_dir() {
                tasks.push(Task::One(path.clone()));
                continue;
            }
            match below(path) {
                Ok(files) if files.is_empty() => {
                    let why = format!("{}: there is no .json file in this folder", path.display());
                    complaints.push(CliError::CommandLine(why));
                }
                Ok(files) => tasks.extend(files.into_iter().map(Task::One)),
                Err(complaint) => complaints.push(complaint),
            }
        }
        if complaints.is_empty() { Ok((tasks, Vec::new())) } else { Err(complaints) }
    }

    fn pairs(&self) -> Result<(Vec<Task>, Vec<String>), Vec<CliError>> {
        let refuse = |why: &str| vec![CliError::from(why)];
        source::refuse_streams(&self.scenes)?;
        let (a, b) = match self.scenes.as_slice() {
            [a, b] => (a, b),
            // The scenes are compared with themselves as the option `set` changes them.
            [both] if !self.level.set.is_empty() => (both, both),
            _ => return Err(refuse("--compare needs two scenes, two folders of scenes, or one of these and --set")),
        };
        match (a.is_dir(), b.is_dir()) {
            (false, false) => Ok((vec![Task::Two([a.clone(), b.clone()])], Vec::new())),
            (true, true) => {
                let (first, second) = (below(a)?, below(b)?);
                let mut tasks = Vec::new();
                let mut notes = Vec::new();
                for path in &first {
                    let inside = path.strip_prefix(a).unwrap_or(path);
                    let other = b.join(inside);
                    if second.contains(&other) {
                        tasks.push(Task::Two([path.clone(), other]));
                    } else {
                        notes.push(format!("Only in the first folder: {}", inside.display()));
                    }
                }
                for path in &second {
                    let inside = path.strip_prefix(b).unwrap_or(path);
                    if !first.contains(&a.join(inside)) {
                        notes.push(format!("Only in the second folder: {}", inside.display()));
                    }
                }
                if tasks.is_empty() {
                    return Err(refuse("--compare finds no .json file with the same path in both folders"));
                }
                Ok((tasks, notes))
            }
            _ => Err(refuse("--compare needs two files or two folders, not one of each")),
        }
    }
}

impl Task {
    pub(super) fn paths(&self) -> Vec<&Path> {
        match self {
            Task::One(path) => vec![path.as_path()],
            Task::Two(paths) => paths.iter().map(PathBuf::as_path).collect(),
        }
    }

    pub(super) fn name(&self) -> String {
        let names = self.paths().into_iter();
        names.map(|p| p.display().to_string()).collect::<Vec<_>>().join(" → ")
    }
}

/// Returns all `.json` files in a folder and its subfolders, sorted by path.
fn below(folder: &Path) -> Result<Vec<PathBuf>, CliError> {
    source::files_in(folder, &["json"], true)
}
