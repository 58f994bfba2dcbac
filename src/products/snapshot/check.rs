//! [`check`](check()): what is not as its reference says, in three layers, each of which explains the next.
//!
//! Makes a [`CheckOutcome`] from scenes and the references beside them. Nothing is written here but by [`CheckOutcome::settle`].

use std::path::{Path, PathBuf};
use std::sync::Arc;

use rayon::prelude::*;

use super::discovery::{Found, Job, Part, shown};
use super::element;
use super::fact::Facts;
use super::picture::{Difference, Picture, Subject};
use super::setting::Settings;
use super::store;
use crate::analysis::Analysis;
use crate::drawing::{Drawing, Theme};
use crate::figure::{self, Options};
use crate::output::file::WriteError;
use crate::output::png;
use crate::output::svg;
use crate::scene::{Problem, SceneError, isolate};

/// So many changes of one file are described in words.
const MOST_LISTED: usize = 12;

/// The folders of some files, each once.
pub(crate) fn folders<'f>(files: impl IntoIterator<Item = &'f PathBuf>) -> Vec<PathBuf> {
    let folders = files.into_iter().filter_map(|f| f.parent());
    let mut folders: Vec<PathBuf> = folders
        .map(|f| {
            if f.as_os_str().is_empty() {
                Path::new(".")
            } else {
                f
            }
        })
        .map(Path::to_owned)
        .collect();
    folders.sort();
    folders.dedup();
    folders
}

/// What is compared. Read from top to bottom, each explains the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Layer {
    /// Verdict, interfaces and forces, as text.
    Facts,
    /// The elements of the drawing.
    Svg,
    /// The pixels of the picture.
    Pixels,
}

impl Layer {
    /// All of them, in the order in which they explain.
    pub const ALL: [Layer; 3] = [Layer::Facts, Layer::Svg, Layer::Pixels];

    /// Its name in settings and reports.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Facts => "facts",
            Layer::Svg => "svg",
            Layer::Pixels => "pixels",
        }
    }

    /// The layer of a name.
    pub fn named(name: &str) -> Option<Layer> {
        Layer::ALL.into_iter().find(|layer| layer.name() == name)
    }
}

/// What is the matter with a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum State {
    /// There is none.
    Missing,
    /// It says something else.
    Changed,
    /// It cannot be read.
    PictureError,
    /// It agrees, and takes more bytes than it may.
    Large,
}

/// A reference that does not hold.
#[derive(Clone, Debug)]
pub struct Finding {
    /// What it compares.
    pub layer: Layer,
    /// The reference.
    pub file: PathBuf,
    /// What is the matter.
    pub state: State,
    /// What changed, in words, what matters most first.
    pub words: Vec<String>,
    /// What the reference would be now.
    pub fresh: Vec<u8>,
    /// What it is; `None` where it is missing.
    pub expected: Option<Vec<u8>>,
    /// A PNG of the difference of two pictures.
    pub difference: Option<Vec<u8>>,
}

/// A scene or figure, and what is the matter with its references.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// What a person calls it.
    pub name: String,
    /// The scene's file; `None` for a figure of a test.
    pub scene: Option<PathBuf>,
    /// Its references.
    pub references: Vec<PathBuf>,
    /// Those that do not hold; none where all is well.
    pub findings: Vec<Finding>,
}

/// What a check found.
#[derive(Clone, Debug, Default)]
pub struct CheckOutcome {
    /// Every scene, by name.
    pub snapshots: Vec<Snapshot>,
    /// References without a scene, each with what to do.
    pub orphans: Vec<(PathBuf, String)>,
    /// Scenes on which the program failed by its own fault.
    pub faults: Vec<(PathBuf, SceneError)>,
}

/// What becomes of what was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Acceptance {
    /// It lies beside the references, for a person to look at.
    Beside,
    /// It takes their places.
    Accept,
}

/// Checks scenes against their references, in parallel. `done` is called after each.
pub fn check(found: Found, done: &(dyn Fn(&str) + Sync)) -> CheckOutcome {
    let one = |job: &Job| {
        let findings = isolate(&shown(&job.path), || of_scene(job));
        done(&job.name);
        match findings {
            Ok(findings) => Ok(Snapshot {
                name: job.name.clone(),
                scene: Some(job.path.clone()),
                references: job.parts.iter().map(|p| p.file.clone()).collect(),
                findings,
            }),
            Err(fault) => Err((job.path.clone(), fault)),
        }
    };
    let all: Vec<Result<Snapshot, (PathBuf, SceneError)>> =
        found.jobs.par_iter().map(one).collect();
    let mut outcome = CheckOutcome {
        orphans: found.orphans,
        faults: found.faults,
        ..CheckOutcome::default()
    };
    for one in all {
        match one {
            Ok(snapshot) => outcome.snapshots.push(snapshot),
            Err(fault) => outcome.faults.push(fault),
        }
    }
    outcome
}

fn of_scene(job: &Job) -> Vec<Finding> {
    let analysis = Analysis::new(Arc::clone(&job.scene));
    let mut findings = Vec::new();
    let mut drawn: Option<(&Part, String)> = None;
    for part in &job.parts {
        if part.layer == Layer::Facts {
            let facts = Facts::new(&analysis, job.settings.digits);
            findings.extend(facts_finding(part, &facts));
            continue;
        }
        let known = drawn
            .take()
            .filter(|(p, _)| p.kind == part.kind && p.theme == part.theme);
        let (_, text) = drawn.insert(known.unwrap_or_else(|| {
            let options = Options {
                theme: Theme::named(&part.theme).unwrap_or_default(),
                ..Options::default()
            };
            (
                part,
                svg::write(&figure::draw(&analysis, part.kind, &options)),
            )
        }));
        findings.extend(drawing_finding(part, text, &job.settings, Subject::Scene));
    }
    findings
}

/// Checks a drawing against its references.
pub(super) fn of_drawing(drawing: &Drawing, parts: &[Part], settings: &Settings) -> Vec<Finding> {
    let text = svg::write(drawing);
    let findings = parts.iter().filter(|p| p.layer != Layer::Facts);
    findings
        .filter_map(|part| drawing_finding(part, &text, settings, Subject::Figure))
        .collect()
}

fn finding(part: &Part, state: State, words: Vec<String>) -> Finding {
    Finding {
        layer: part.layer,
        file: part.file.clone(),
        state,
        words,
        fresh: Vec::new(),
        expected: None,
        difference: None,
    }
}

/// The bytes of a reference, or what is the matter where it is missing or cannot be opened.
fn reference(part: &Part) -> Result<Vec<u8>, (State, String)> {
    match store::read(&part.file) {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err((State::Missing, "there is no reference".into())),
        Err(error) => Err((State::PictureError, format!("it cannot be read: {error}"))),
    }
}

fn facts_finding(part: &Part, facts: &Facts) -> Option<Finding> {
    let fresh = facts.text().into_bytes();
    let bytes = match reference(part) {
        Ok(bytes) => bytes,
        Err((state, words)) => {
            return Some(Finding {
                fresh,
                ..finding(part, state, vec![words])
            });
        }
    };
    if bytes == fresh {
        return None;
    }
    let (state, words) = match Facts::read(&String::from_utf8_lossy(&bytes)) {
        Err(error) => (State::PictureError, vec![error.to_string()]),
        // What is written is what is compared: both went through the same rounding.
        Ok(expected) => {
            let changes = expected.changes(facts);
            (
                State::Changed,
                changes.into_iter().map(|c| c.words).collect(),
            )
        }
    };
    (!words.is_empty()).then(|| Finding {
        fresh,
        expected: Some(bytes),
        ..finding(part, state, words)
    })
}

fn drawing_finding(
    part: &Part,
    text: &str,
    settings: &Settings,
    subject: Subject,
) -> Option<Finding> {
    match part.layer {
        Layer::Pixels => pixels_finding(part, text, settings, subject),
        _ => svg_finding(part, text),
    }
}

fn svg_finding(part: &Part, text: &str) -> Option<Finding> {
    let fresh = text.as_bytes().to_vec();
    let bytes = match reference(part) {
        Ok(bytes) => bytes,
        Err((state, words)) => {
            return Some(Finding {
                fresh,
                ..finding(part, state, vec![words])
            });
        }
    };
    if bytes == fresh {
        return None;
    }
    let (state, words) = match element::changes(&String::from_utf8_lossy(&bytes), text) {
        Ok(words) => (State::Changed, words),
        Err(error) => (State::PictureError, vec![error.to_string()]),
    };
    (!words.is_empty()).then(|| Finding {
        fresh,
        expected: Some(bytes),
        ..finding(part, state, words)
    })
}

fn pixels_finding(
    part: &Part,
    text: &str,
    settings: &Settings,
    subject: Subject,
) -> Option<Finding> {
    let size = part.width.map_or(png::Size::Natural, png::Size::Width);
    let found = match png::rgba(text, size) {
        Ok(raster) => Picture::new(raster.width, raster.height, raster.rgba),
        Err(error) => return Some(finding(part, State::PictureError, vec![error.to_string()])),
    };
    // Made only where it is needed: packing a picture takes longer than comparing it.
    let fresh = || found.encode(Some(subject)).unwrap_or_default();
    let bytes = match reference(part) {
        Ok(bytes) => bytes,
        Err((state, words)) => {
            return Some(Finding {
                fresh: fresh(),
                ..finding(part, state, vec![words])
            });
        }
    };
    let expected = match Picture::decode(&bytes) {
        Ok(expected) => expected,
        Err(error) => {
            return Some(Finding {
                fresh: fresh(),
                expected: Some(bytes),
                ..finding(part, State::PictureError, vec![error.to_string()])
            });
        }
    };
    let difference = Difference::new(&expected, &found, settings.tolerance);
    if difference.is_none() {
        let panels = text.matches("class=\"frame\"").count().max(1) as u64;
        let most = settings
            .most_kilobytes
            .unwrap_or(u64::MAX)
            .saturating_mul(panels);
        if bytes.len() as u64 <= most.saturating_mul(1000) {
            return None;
        }
        let words = format!(
            "it takes {:.1} kB, more than the {most} kB that the settings allow it; make it narrower with `widths`",
            bytes.len() as f64 / 1000.0
        );
        return Some(finding(part, State::Large, vec![words]));
    }
    let mut words = vec![difference.words()];
    if expected.lost_its_note() {
        words.push("the reference does not say how its colours were rounded, as ours do; another program may have packed it anew".into());
    }
    Some(Finding {
        fresh: fresh(),
        difference: difference.image(&expected).encode(None).ok(),
        expected: Some(bytes),
        ..finding(part, State::Changed, words)
    })
}

impl Snapshot {
    /// Whether all of its references hold.
    pub fn holds(&self) -> bool {
        self.findings.is_empty()
    }

    /// The folders in which its references lie.
    pub fn folders(&self) -> Vec<PathBuf> {
        folders(&self.references)
    }

    /// What is the matter, a line each.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for finding in &self.findings {
            let what = match finding.state {
                State::Missing => "new",
                State::Changed => "changed",
                State::PictureError => "unreadable",
                State::Large => "large",
            };
            let head = format!("{} {what}, {}", finding.layer.name(), shown(&finding.file));
            match finding.words.as_slice() {
                [one] => lines.push(format!("  {head}: {one}")),
                several => {
                    lines.push(format!("  {head}:"));
                    lines.extend(several.iter().take(MOST_LISTED).map(|w| format!("    {w}")));
                    if several.len() > MOST_LISTED {
                        lines.push(format!("    … and {} more", several.len() - MOST_LISTED));
                    }
                }
            }
        }
        lines
    }

    /// What of it would be written as references.
    fn acceptable(&self) -> Vec<(PathBuf, Vec<u8>)> {
        let fresh = self.findings.iter().filter(|f| !f.fresh.is_empty());
        fresh.map(|f| (f.file.clone(), f.fresh.clone())).collect()
    }

    /// Writes what was found, beside the references or in their places, and takes away what lies beside those that hold.
    ///
    /// # Errors
    /// The file that could not be written. The references of this snapshot are then as they were.
    pub fn settle(&mut self, acceptance: Acceptance) -> Result<(), WriteError> {
        if acceptance == Acceptance::Accept {
            store::write(&self.acceptable())?;
            self.findings.retain(|f| f.fresh.is_empty());
        }
        let mut beside = Vec::new();
        for finding in self.findings.iter().filter(|f| !f.fresh.is_empty()) {
            beside.push((store::found(&finding.file), finding.fresh.clone()));
            if let Some(difference) = &finding.difference {
                beside.push((store::difference(&finding.file), difference.clone()));
            }
        }
        let kept = |path: &Path| beside.iter().any(|(b, _)| b == path);
        for reference in &self.references {
            for stale in [store::found(reference), store::difference(reference)] {
                if !kept(&stale) {
                    store::remove(&stale);
                }
            }
        }
        store::write(&beside)
    }
}

impl CheckOutcome {
    /// Whether everything is as its references say.
    pub fn holds(&self) -> bool {
        self.faults.is_empty() && self.orphans.is_empty() && self.failing().next().is_none()
    }

    /// References without a scene and scenes on which the program failed, each with what is the matter.
    pub(crate) fn others(&self) -> impl Iterator<Item = (&Path, String)> {
        let orphans = self.orphans.iter().map(|(path, words)| {
            let words = format!("a reference without a scene: {words}");
            (path.as_path(), words)
        });
        let faults = self.faults.iter().map(|(path, fault)| {
            let of = |p: &Problem| format!("{}; {}", p.message, p.help);
            let words: Vec<String> = fault.list.iter().map(of).collect();
            (path.as_path(), words.join("; "))
        });
        orphans.chain(faults)
    }

    /// The snapshots that do not hold.
    pub fn failing(&self) -> impl Iterator<Item = &Snapshot> {
        self.snapshots.iter().filter(|s| !s.holds())
    }

    /// What is the matter, line by line; empty where all is well.
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

    /// All in one line.
    pub fn summary(&self) -> String {
        let all = self.snapshots.len();
        let failing = self.failing().count();
        let plural = if all == 1 { "" } else { "s" };
        let mut words = format!("{all} snapshot{plural}: {} hold", all - failing);
        if failing > 0 {
            let is = |state| move |s: &&Snapshot| s.findings.iter().any(|f| f.state == state);
            let new = self
                .failing()
                .filter(|s| s.findings.iter().all(|f| f.state == State::Missing));
            let new = new.count();
            let broken = self.failing().filter(is(State::PictureError)).count();
            words.push_str(&format!(", {} changed, {new} new", failing - new));
            if broken > 0 {
                words.push_str(&format!(", {broken} with unreadable references"));
            }
        }
        match self.orphans.len() {
            0 => {}
            n => words.push_str(&format!(", {n} references without a scene")),
        }
        match self.faults.len() {
            0 => {}
            1 => words.push_str(", 1 scene on which the program failed"),
            n => words.push_str(&format!(", {n} scenes on which the program failed")),
        }
        words
    }

    /// As [`Snapshot::settle`], for all of them; those that cannot be written do not keep the others from it.
    ///
    /// # Errors
    /// Every file that could not be written.
    pub fn settle(&mut self, acceptance: Acceptance) -> Result<(), Vec<WriteError>> {
        let settled = self.snapshots.iter_mut().map(|s| s.settle(acceptance));
        let failed: Vec<WriteError> = settled.filter_map(Result::err).collect();
        if failed.is_empty() {
            Ok(())
        } else {
            Err(failed)
        }
    }
}
