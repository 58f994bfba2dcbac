//! [`CheckOutcome`]: the references that do not match, with descriptions and new contents.

use std::path::{Path, PathBuf};

use super::discovery::shown;
use super::layer::Layer;
use super::store;
use crate::mechanics::scene::{Problem, SceneError};
use crate::pictures::output::file::WriteError;

/// Largest number of changes of one file that a message lists. All further changes are only counted.
const MAX_LISTED_CHANGES: usize = 12;

/// Returns the folders of the files, sorted and without duplicates.
pub(crate) fn folders<'f>(files: impl IntoIterator<Item = &'f PathBuf>) -> Vec<PathBuf> {
    let folders = files.into_iter().filter_map(|f| f.parent());
    let mut folders: Vec<PathBuf> =
        folders.map(|f| if f.as_os_str().is_empty() { Path::new(".") } else { f }).map(Path::to_owned).collect();
    folders.sort();
    folders.dedup();
    folders
}

/// The reason why a reference does not match.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum State {
    /// The reference does not exist.
    Missing,
    /// The result differs from the reference.
    Changed,
    /// The reference cannot be read.
    Unreadable,
    /// The result matches, but the reference file is larger than the settings allow.
    TooLarge,
}

/// A reference that does not match.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The layer of the reference.
    pub layer: Layer,
    /// The path of the reference.
    pub file: PathBuf,
    /// The reason why the reference does not match.
    pub state: State,
    /// The changes, or another reason, in words. Changes of facts begin with changes of the scene itself; changes of
    /// results follow, the most important first.
    pub words: Vec<String>,
    /// The new content of the reference; empty if there is none.
    pub fresh: Vec<u8>,
    /// The present content of the reference file; `None` if the file does not exist, cannot be read or is too large.
    pub expected: Option<Vec<u8>>,
    /// A PNG that shows the differing pixels; `None` unless two pictures were compared and differ.
    pub difference: Option<Vec<u8>>,
}

/// A scene or figure with the references that do not match.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The name of the scene or figure in messages.
    pub name: String,
    /// The path of the scene; `None` for a figure from a test.
    pub scene: Option<PathBuf>,
    /// The paths of all its references.
    pub references: Vec<PathBuf>,
    /// The references that do not match.
    pub findings: Vec<Finding>,
}

/// The result of a check.
#[derive(Clone, Debug, Default)]
pub struct CheckOutcome {
    /// All checked scenes or figures. Scenes are sorted by the paths of their files.
    pub snapshots: Vec<Snapshot>,
    /// Orphaned references, whose scene does not exist or which the settings do not include. Each has the reason and
    /// the remedy.
    pub orphans: Vec<(PathBuf, String)>,
    /// Scenes that could not be checked because of an error in the program, each with a description of the error.
    pub faults: Vec<(PathBuf, SceneError)>,
}

/// Where the new contents of references are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acceptance {
    /// Next to the references as `.new.*`, for review.
    Propose,
    /// In place of the references.
    Accept,
}

impl Snapshot {
    /// True if all references match.
    pub fn matches(&self) -> bool {
        self.findings.is_empty()
    }

    /// Returns the folders of the references of this snapshot, sorted and without duplicates.
    pub fn folders(&self) -> Vec<PathBuf> {
        folders(&self.references)
    }

    /// Describes the findings of this snapshot, each in one or more lines.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for finding in &self.findings {
            let what = match finding.state {
                State::Missing => "new",
                State::Changed => "changed",
                State::Unreadable => "unreadable",
                State::TooLarge => "large",
            };
            let head = format!("{} {what}, {}", finding.layer.name(), shown(&finding.file));
            match finding.words.as_slice() {
                [one] => lines.push(format!("  {head}: {one}")),
                several => {
                    lines.push(format!("  {head}:"));
                    lines.extend(several.iter().take(MAX_LISTED_CHANGES).map(|w| format!("    {w}")));
                    if several.len() > MAX_LISTED_CHANGES {
                        lines.push(format!("    … and {} more", several.len() - MAX_LISTED_CHANGES));
                    }
                }
            }
        }
        lines
    }

    /// Returns the paths of the references that have a new content, each with this content.
    fn acceptable(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let fresh = self.findings.iter().filter(|f| !f.fresh.is_empty());
        fresh.map(|f| (f.file.clone(), f.fresh.clone())).collect()
    }

    /// Writes the new contents of references, as `acceptance` states: next to the references, with images of the
    /// differences, or in place of the references. Deletes `.new.*` and `.diff.png` files that are out of date.
    ///
    /// # Errors
    /// The file that could not be written. In this case the references of this snapshot are unchanged.
    pub fn store(&mut self, acceptance: Acceptance) -> Result<(), WriteError> {
        if acceptance == Acceptance::Accept {
            store::write(&self.acceptable())?;
            self.findings.retain(|f| f.fresh.is_empty());
        }
        let mut beside = Vec::new();
        for finding in self.findings.iter().filter(|f| !f.fresh.is_empty()) {
            beside.push((store::new_file(&finding.file), finding.fresh.clone()));
            if let Some(difference) = &finding.difference {
                beside.push((store::difference_file(&finding.file), difference.clone()));
            }
        }
        let kept = |path: &Path| beside.iter().any(|(b, _)| b == path);
        for reference in &self.references {
            for stale in [store::new_file(reference), store::difference_file(reference)] {
                if !kept(&stale) {
                    store::remove(&stale);
                }
            }
        }
        store::write(&beside)
    }
}

impl CheckOutcome {
    /// True if all references match, no reference is orphaned, and the program did not fail on any scene.
    pub fn matches(&self) -> bool {
        self.faults.is_empty() && self.orphans.is_empty() && self.failing().next().is_none()
    }

    /// Iterates over the orphaned references and the scenes on which the program failed. Each path has a message.
    pub(crate) fn others(&self) -> impl Iterator<Item = (&Path, String)> {
        let orphans = self.orphans.iter().map(|(path, words)| {
            let words = format!("an orphaned reference: {words}");
            (path.as_path(), words)
        });
        orphans.chain(self.fault_descriptions())
    }

    /// Iterates over the scenes on which the program failed, with a description of each failure.
    pub(super) fn fault_descriptions(&self) -> impl Iterator<Item = (&Path, String)> {
        self.faults.iter().map(|(path, fault)| {
            let of = |p: &Problem| format!("{}; {}", p.message, p.help);
            let words: Vec<String> = fault.list.iter().map(of).collect();
            (path.as_path(), words.join("; "))
        })
    }

    /// Iterates over the snapshots with findings.
    pub fn failing(&self) -> impl Iterator<Item = &Snapshot> {
        self.snapshots.iter().filter(|s| !s.matches())
    }

    /// Describes all findings in lines; empty if everything matches.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for snapshot in self.failing() {
            lines.push(snapshot.name.clone());
            lines.extend(snapshot.lines());
        }
        for (path, words) in self.others() {
            lines.push(format!("{}: {words}", shown(path)));
        }
        lines
    }

    /// Returns the numbers of snapshots that match and that do not match, in one line:
    /// `12 snapshots: 10 match, 1 changed, 1 new`. Orphaned references and failures of the program follow if there are
    /// any.
    pub fn summary(&self) -> String {
        let all = self.snapshots.len();
        let failing = self.failing().count();
        let plural = if all == 1 { "" } else { "s" };
        let mut words = format!("{all} snapshot{plural}: {} match", all - failing);
        if failing > 0 {
            let is = |state| move |s: &&Snapshot| s.findings.iter().any(|f| f.state == state);
            let new = self.failing().filter(|s| s.findings.iter().all(|f| f.state == State::Missing));
            let new = new.count();
            let broken = self.failing().filter(is(State::Unreadable)).count();
            words.push_str(&format!(", {} changed, {new} new", failing - new));
            if broken > 0 {
                words.push_str(&format!(", {broken} with unreadable references"));
            }
        }
        match self.orphans.len() {
            0 => {}
            1 => words.push_str(", 1 orphaned reference"),
            n => words.push_str(&format!(", {n} orphaned references")),
        }
        match self.faults.len() {
            0 => {}
            1 => words.push_str(", 1 scene on which the program failed"),
            n => words.push_str(&format!(", {n} scenes on which the program failed")),
        }
        words
    }

    /// Calls [`Snapshot::store`] for all snapshots. If it fails for one snapshot, the others are still stored.
    ///
    /// # Errors
    /// All files that could not be written.
    pub fn store(&mut self, acceptance: Acceptance) -> Result<(), Vec<WriteError>> {
        let stored = self.snapshots.iter_mut().map(|s| s.store(acceptance));
        let failed: Vec<WriteError> = stored.filter_map(Result::err).collect();
        if failed.is_empty() { Ok(()) } else { Err(failed) }
    }
}
