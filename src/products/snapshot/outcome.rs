//! [`CheckOutcome`]: the references that do not match, with descriptions and new contents.

use std::path::{Path, PathBuf};

use super::discovery::shown;
use super::layer::Layer;
use super::store;
use crate::mechanics::analysis::{FALLS, STANDS, UNDECIDED};
use crate::mechanics::scene::{Code, Problem, SceneError};
use crate::pictures::output::file::WriteError;
use crate::products::wording::number::counted;

/// Largest number of changes of one file that a message lists. All further changes are only counted.
pub(super) const MAX_LISTED_CHANGES: usize = 12;

/// The same for the files of a scene after the first that changed.
const MAX_IMPLIED_CHANGES: usize = 3;

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

impl State {
    /// Returns the word for this state in reports.
    pub fn name(self) -> &'static str {
        match self {
            State::Missing => "new",
            State::Changed => "changed",
            State::Unreadable => "unreadable",
            State::TooLarge => "large",
        }
    }
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
    /// The new picture as PNG, if the reference stores only a hash of its pixels.
    pub picture: Option<Vec<u8>>,
    /// True if nobody can see the difference of the pictures.
    pub is_invisible: bool,
}

impl Finding {
    /// Returns the expected picture, the difference and the new picture as PNG, each with its name in reports. The
    /// expected picture is left out if it cannot be read, or only its hash is stored.
    pub(super) fn pictures(&self) -> [(&'static str, Option<&[u8]>); 3] {
        let found = self.picture.as_ref().unwrap_or(&self.fresh);
        [
            ("Expected", self.expected.as_deref().filter(|_| self.difference.is_some())),
            ("Difference", self.difference.as_deref()),
            ("Found", Some(found.as_slice()).filter(|found| !found.is_empty())),
        ]
    }
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
    /// What differs although all references match: pixels that nobody can see.
    pub notes: Vec<String>,
}

/// The result of a check.
#[derive(Clone, Debug, Default)]
pub struct CheckOutcome {
    /// All checked scenes or figures. Scenes are sorted by the paths of their files.
    pub snapshots: Vec<Snapshot>,
    /// Orphaned references, whose scene does not exist or which the settings do not include. Each has the reason and
    /// the remedy.
    pub orphans: Vec<(PathBuf, String)>,
    /// Scenes that could not be checked, because they are not valid or because of an error in the program, each with the
    /// problems.
    pub faults: Vec<(PathBuf, SceneError)>,
    /// References that [`CheckOutcome::store`] has written.
    pub accepted: Vec<PathBuf>,
    /// Orphaned references that [`CheckOutcome::prune`] has deleted.
    pub pruned: Vec<PathBuf>,
}

/// Where the new contents of references are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acceptance {
    /// Next to the references as `.new.*`, for review.
    Propose,
    /// In place of the references.
    Accept,
    /// As references if there was no reference, otherwise as `.new.*`.
    AcceptNew,
}

impl Snapshot {
    /// Makes a snapshot. If nothing differs but pixels that nobody can see, the references match, with notes.
    pub(super) fn new(name: String, scene: Option<PathBuf>, references: Vec<PathBuf>, found: Vec<Finding>) -> Snapshot {
        let notes = found.iter().filter(|f| f.is_invisible);
        let notes = notes.map(|f| format!("{}: {}, which nobody can see", shown(&f.file), f.words.join("; ")));
        let (notes, findings) =
            if found.iter().all(|f| f.is_invisible) { (notes.collect(), Vec::new()) } else { (Vec::new(), found) };
        Snapshot { name, scene, references, findings, notes }
    }

    /// True if all references match.
    pub fn matches(&self) -> bool {
        self.findings.is_empty()
    }

    /// Returns the folders of the references of this snapshot, sorted and without duplicates.
    pub fn folders(&self) -> Vec<PathBuf> {
        folders(&self.references)
    }

    /// Describes the findings of this snapshot, each in one or more lines; one line names all new references.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        let (new, others): (Vec<&Finding>, Vec<&Finding>) =
            self.findings.iter().partition(|finding| finding.state == State::Missing);
        if !new.is_empty() {
            let files: Vec<String> = new.iter().map(|finding| shown(&finding.file)).collect();
            lines.push(format!("  {}: {}: no reference exists yet", State::Missing.name(), files.join(", ")));
        }
        // What changes in the facts explains what changes in the drawing, so of the second only an impression is given.
        let mut most = MAX_LISTED_CHANGES;
        for finding in others {
            let head = format!("{} {}, {}", finding.layer.name(), finding.state.name(), shown(&finding.file));
            match finding.words.as_slice() {
                [one] => lines.push(format!("  {head}: {one}")),
                several => {
                    lines.push(format!("  {head}:"));
                    lines.extend(several.iter().take(most).map(|w| format!("    {w}")));
                    if several.len() > most {
                        lines.push(format!("    … and {} more", several.len() - most));
                    }
                }
            }
            most = MAX_IMPLIED_CHANGES;
        }
        lines
    }

    /// Writes the new contents of references, as `acceptance` states: next to the references, with images of the
    /// differences, or in place of the references. Deletes `.new.*` and `.diff.png` files that are out of date. Returns
    /// the references that were written.
    ///
    /// # Errors
    /// The file that could not be written. In this case the references of this snapshot are unchanged.
    pub fn store(&mut self, acceptance: Acceptance) -> Result<Vec<PathBuf>, WriteError> {
        let accepts = |f: &Finding| match acceptance {
            Acceptance::Propose => false,
            Acceptance::Accept => !f.fresh.is_empty(),
            Acceptance::AcceptNew => !f.fresh.is_empty() && f.state == State::Missing,
        };
        let accepted = self.findings.iter().filter(|f| accepts(f)).map(|f| (f.file.clone(), f.fresh.clone()));
        let accepted: Vec<(PathBuf, Vec<u8>)> = accepted.collect();
        store::write(&accepted)?;
        self.findings.retain(|f| !accepts(f));
        let mut beside = Vec::new();
        for finding in self.findings.iter().filter(|f| !f.fresh.is_empty()) {
            beside.push((store::new_file(&finding.file), finding.fresh.clone()));
            let difference = finding.difference.iter();
            beside.extend(difference.map(|png| (store::difference_file(&finding.file), png.clone())));
            let picture = finding.picture.iter();
            beside.extend(picture.map(|png| (store::new_file(&finding.file.with_extension("png")), png.clone())));
        }
        let kept = |path: &PathBuf| beside.iter().any(|(b, _)| b == path);
        for reference in &self.references {
            store::results(reference).into_iter().filter(|stale| !kept(stale)).for_each(|stale| store::remove(&stale));
        }
        store::write(&beside)?;
        Ok(accepted.into_iter().map(|(file, _)| file).collect())
    }
}

impl CheckOutcome {
    /// True if all references match, no reference is orphaned, and all scenes could be checked.
    pub fn matches(&self) -> bool {
        self.faults.is_empty() && self.orphans.is_empty() && self.failing().next().is_none()
    }

    /// Iterates over the orphaned references and the scenes that could not be checked. Each path has a message.
    pub(crate) fn others(&self) -> impl Iterator<Item = (&Path, String)> {
        let orphans = self.orphans.iter().map(|(path, words)| {
            let words = format!("an orphaned reference: {words}");
            (path.as_path(), words)
        });
        orphans.chain(self.fault_descriptions())
    }

    /// Iterates over the scenes that could not be checked, with a description of the problems of each.
    pub(super) fn fault_descriptions(&self) -> impl Iterator<Item = (&Path, String)> {
        self.faults.iter().map(|(path, fault)| {
            let of = |p: &Problem| {
                let place = if p.line > 0 { format!("{}:{}: ", p.line, p.column) } else { String::new() };
                format!("{place}{}; {}", p.message, p.help)
            };
            let words: Vec<String> = fault.list.iter().map(of).collect();
            (path.as_path(), words.join("; "))
        })
    }

    /// Iterates over the snapshots with findings.
    pub fn failing(&self) -> impl Iterator<Item = &Snapshot> {
        self.snapshots.iter().filter(|s| !s.matches())
    }

    /// Returns the snapshots with findings: changed verdicts first, then other facts, drawings and pixels.
    pub(super) fn failing_by_importance(&self) -> Vec<&Snapshot> {
        let is_verdict = |words: &String| [STANDS, FALLS, UNDECIDED].iter().any(|v| words.ends_with(&format!("→ {v}")));
        let mut failing: Vec<&Snapshot> = self.failing().collect();
        failing.sort_by_key(|snapshot| {
            let facts = snapshot.findings.iter().filter(|f| f.layer == Layer::Facts);
            let has_verdict = facts.flat_map(|f| &f.words).any(is_verdict);
            (!has_verdict, snapshot.findings.iter().map(|finding| finding.layer).min())
        });
        failing
    }

    /// Describes all findings in lines; empty if everything matches.
    pub fn lines(&self) -> Vec<String> {
        let faults = self.fault_descriptions().map(|(path, words)| format!("{}: {words}", shown(path)));
        self.changes().into_iter().chain(faults).collect()
    }

    /// Describes the references that differ, changed verdicts first, and the orphaned references in lines.
    pub(crate) fn changes(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for snapshot in self.failing_by_importance() {
            lines.push(snapshot.name.clone());
            lines.extend(snapshot.lines());
        }
        let orphans = self.orphans.iter();
        lines.extend(orphans.map(|(path, words)| format!("{}: an orphaned reference: {words}", shown(path))));
        lines
    }

    /// Returns the numbers of snapshots that match and that do not match, in one line:
    /// `12 snapshots: 10 match, 1 changed, 1 new`. Orphaned references and scenes that could not be checked follow if
    /// there are any.
    pub fn summary(&self) -> String {
        let all = self.snapshots.len();
        let failing = self.failing().count();
        let mut words = format!("{}: {} match", counted(all, "snapshot"), all - failing);
        if failing > 0 {
            let new = self.failing().filter(|s| s.findings.iter().all(|f| f.state == State::Missing)).count();
            let broken = self.failing().filter(|s| s.findings.iter().any(|f| f.state == State::Unreadable)).count();
            words.push_str(&format!(", {} changed, {new} new", failing - new));
            if broken > 0 {
                words.push_str(&format!(", {broken} with unreadable references"));
            }
        }
        let mut add = |count: usize, one: &str, several: &str| match count {
            0 => {}
            1 => words.push_str(&format!(", 1 {one}")),
            n => words.push_str(&format!(", {n} {several}")),
        };
        add(self.orphans.len(), "orphaned reference", "orphaned references");
        let is_internal = |fault: &SceneError| fault.list.iter().any(|p| p.code == Code::InternalFault);
        let internal = self.faults.iter().filter(|(_, fault)| is_internal(fault)).count();
        add(self.faults.len() - internal, "scene that is not valid", "scenes that are not valid");
        add(internal, "scene on which the program failed", "scenes on which the program failed");
        words
    }

    /// Calls [`Snapshot::store`] for all snapshots, and adds the written references to `accepted`. If it fails for one
    /// snapshot, the others are still stored.
    ///
    /// # Errors
    /// All files that could not be written.
    pub fn store(&mut self, acceptance: Acceptance) -> Result<(), Vec<WriteError>> {
        let mut failed = Vec::new();
        for snapshot in &mut self.snapshots {
            match snapshot.store(acceptance) {
                Ok(files) => self.accepted.extend(files),
                Err(error) => failed.push(error),
            }
        }
        if failed.is_empty() { Ok(()) } else { Err(failed) }
    }

    /// Deletes the orphaned references, and their `.new.*` and `.diff.png` files.
    ///
    /// # Errors
    /// All files that could not be deleted; they stay in `orphans`.
    pub fn prune(&mut self) -> Result<(), Vec<WriteError>> {
        let mut failed = Vec::new();
        for (path, words) in std::mem::take(&mut self.orphans) {
            match std::fs::remove_file(&path) {
                Ok(()) => {
                    store::results(&path).iter().for_each(|file| store::remove(file));
                    self.pruned.push(path);
                }
                Err(why) => {
                    self.orphans.push((path.clone(), words));
                    failed.push(WriteError { path, why });
                }
            }
        }
        if failed.is_empty() { Ok(()) } else { Err(failed) }
    }
}
