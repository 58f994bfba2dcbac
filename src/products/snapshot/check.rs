//! [`check`](check()): compares scenes with their references in three layers.
//!
//! 1. Facts: verdict and forces as JSON.
//! 2. SVG: the text of the drawing.
//! 3. Pixels: the rendered picture.
//!
//! A difference in one layer usually explains the differences in later layers. The result is a [`CheckOutcome`]. Only
//! [`CheckOutcome::store`] writes files.

use std::path::PathBuf;
use std::sync::Arc;

use rayon::prelude::*;

use super::discovery::{Discovered, Job, shown};
use super::fact::Facts;
use super::layer::{Layer, UnreadableReference};
use super::outcome::{CheckOutcome, Finding, Snapshot, State};
use super::picture::{Difference, Picture};
use super::reference::{HASH_WORDS, Part};
use super::setting::Settings;
use super::{store, svg as svg_text};
use crate::mechanics::analysis::Analysis;
use crate::mechanics::scene::{SceneError, isolate};
use crate::pictures::drawing::{Drawing, Theme};
use crate::pictures::output::png;
use crate::pictures::output::svg;
use crate::products::figure::{self, Options};

/// Compares scenes with their references, in parallel. Calls `done` with the name of each scene after it is compared.
pub fn check(found: Discovered, done: &(dyn Fn(&str) + Sync)) -> CheckOutcome {
    let one = |job: &Job| {
        let findings = isolate(&shown(&job.path), || {
            check_analysis(&Analysis::new(Arc::clone(&job.scene)), &job.parts, &job.settings)
        });
        done(&job.name);
        match findings {
            Ok(findings) => {
                let references = job.parts.iter().map(|p| p.file.clone()).collect();
                Ok(Snapshot::new(job.name.clone(), Some(job.path.clone()), references, findings))
            }
            Err(fault) => Err((job.path.clone(), fault)),
        }
    };
    let all: Vec<Result<Snapshot, (PathBuf, SceneError)>> = found.jobs.par_iter().map(one).collect();
    let mut outcome = CheckOutcome { orphans: found.orphans, faults: found.faults, ..CheckOutcome::default() };
    for one in all {
        match one {
            Ok(snapshot) => outcome.snapshots.push(snapshot),
            Err(fault) => outcome.faults.push(fault),
        }
    }
    outcome
}

/// Compares the facts and drawings of an analysis with its references.
pub(super) fn check_analysis(analysis: &Analysis, parts: &[Part], settings: &Settings) -> Vec<Finding> {
    let mut findings = Vec::new();
    // Keep the SVG text of the last figure, because the SVG layer and all widths of the pixel layer use the same
    // text.
    let mut drawn: Option<(&Part, String)> = None;
    for part in parts {
        if part.layer == Layer::Facts {
            let facts = Facts::new(analysis, settings.digits);
            findings.extend(text_finding(part, facts.text(), |text| Ok(Facts::read(text)?.changes(&facts))));
            continue;
        }
        let known = drawn.take().filter(|(p, _)| p.view == part.view && p.theme == part.theme);
        let (_, text) = drawn.insert(known.unwrap_or_else(|| {
            // The first theme of all stands for the default, which is another theme for scenes on a lattice.
            let theme = Theme::named(&part.theme).filter(|_| part.theme != Theme::NAMES[0]).unwrap_or_default();
            let options = part.view.options(&Options { theme, ..Options::default() });
            (part, svg::write(&figure::draw(analysis, part.view.kind, &options)))
        }));
        findings.extend(drawing_finding(part, text, settings));
    }
    findings
}

/// Compares a drawing with its SVG and PNG references.
pub(super) fn check_drawing(drawing: &Drawing, parts: &[Part], settings: &Settings) -> Vec<Finding> {
    let text = svg::write(drawing);
    let findings = parts.iter().filter(|p| p.layer != Layer::Facts);
    findings.filter_map(|part| drawing_finding(part, &text, settings)).collect()
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
        picture: None,
        is_invisible: false,
    }
}

/// Returns the bytes of a reference file. If there is no file or it cannot be read, returns the state of the
/// reference and the reason in words.
fn reference(part: &Part) -> Result<Vec<u8>, (State, String)> {
    match store::read(&part.file) {
        Ok(Some(bytes)) => Ok(bytes),
        Ok(None) => Err((State::Missing, "this reference file does not exist yet".into())),
        Err(error) => Err((State::Unreadable, format!("it cannot be read: {error}"))),
    }
}

/// Compares the new text `fresh` with its reference. Returns `None` if there is no change. The function `changes` is
/// called with the text of the reference. It returns the changes in words, or the reason why the reference cannot be
/// read.
fn text_finding(
    part: &Part,
    fresh: String,
    changes: impl FnOnce(&str) -> Result<Vec<String>, UnreadableReference>,
) -> Option<Finding> {
    let fresh = fresh.into_bytes();
    let bytes = match reference(part) {
        Ok(bytes) => bytes,
        Err((state, words)) => return Some(Finding { fresh, ..finding(part, state, vec![words]) }),
    };
    if bytes == fresh {
        return None;
    }
    let (state, words) = match changes(&String::from_utf8_lossy(&bytes)) {
        Ok(words) => (State::Changed, words),
        Err(error) => (State::Unreadable, vec![error.to_string()]),
    };
    (!words.is_empty()).then(|| Finding { fresh, expected: Some(bytes), ..finding(part, state, words) })
}

fn drawing_finding(part: &Part, text: &str, settings: &Settings) -> Option<Finding> {
    if part.layer != Layer::Pixels {
        return text_finding(part, text.to_owned(), |expected| svg_text::changes(expected, text));
    }
    let size = part.width.map_or(png::Size::Natural, png::Size::Width);
    let found = match png::rgba(text, size) {
        Ok(raster) => Picture::new(raster.width, raster.height, raster.rgba),
        Err(error) => return Some(finding(part, State::Unreadable, vec![error.to_string()])),
    };
    // Encode the picture only if it differs: encoding takes longer than comparing.
    let picture = || png::render(text, size).unwrap_or_default();
    if part.is_hash() {
        let changed = "the pixels have another hash; the setting `pixels = \"hash\"` keeps no picture to compare";
        let finding = text_finding(part, hash_line(&found), |_| Ok(vec![changed.into()]));
        return finding.map(|finding| Finding { picture: Some(picture()), ..finding });
    }
    let bytes = match reference(part) {
        Ok(bytes) => bytes,
        Err((state, words)) => return Some(Finding { fresh: picture(), ..finding(part, state, vec![words]) }),
    };
    let expected = match Picture::decode(&bytes) {
        Ok(expected) => expected,
        Err(error) => {
            let finding = finding(part, State::Unreadable, vec![error.to_string()]);
            return Some(Finding { fresh: picture(), expected: Some(bytes), ..finding });
        }
    };
    let difference = Difference::new(&expected, &found, settings.channel_tolerance);
    if difference.is_none() {
        let panels = text.matches("class=\"frame\"").count().max(1) as u64;
        let max = settings.most_kilobytes.unwrap_or(u64::MAX).saturating_mul(panels);
        if bytes.len() as u64 <= max.saturating_mul(1000) {
            return None;
        }
        let words = format!(
            "it has {:.1} kB, more than the {max} kB that the settings allow; reduce its width with `widths`",
            bytes.len() as f64 / 1000.0
        );
        return Some(finding(part, State::TooLarge, vec![words]));
    }
    Some(Finding {
        fresh: picture(),
        is_invisible: difference.is_invisible(),
        difference: difference.image(&expected).encode().ok(),
        expected: Some(bytes),
        ..finding(part, State::Changed, vec![difference.words()])
    })
}

/// Returns the content of a reference that stores only the size of a picture and a hash of its pixels.
fn hash_line(picture: &Picture) -> String {
    let hash = crate::text::hash(picture.pixels().as_flattened());
    format!("{HASH_WORDS}{} × {}, hash {hash:016x}\n", picture.width, picture.height)
}
