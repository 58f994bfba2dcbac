//! The verdict in words, and what is said with it.

use super::failure::{by_amount, lacking, missing, shortened, uncarried};
use super::number::listed;
use crate::analysis::{FrameAnalysis, Verdict};
use crate::scene::Scene;

/// Above so many things that are missing the rest is counted in a caption.
const MOST: usize = 4;

/// The verdict's word in results, for programs. People read [`plain`] and [`counted`].
pub fn word(verdict: Verdict) -> &'static str {
    verdict.word()
}

/// The verdict's word for people, in tables, figures and sentences: what the structure does.
pub fn plain(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "stands",
        Verdict::Unstable => "falls",
        Verdict::Undecided => "undecided",
    }
}

/// A number of frames or scenes with one verdict, for people: `1 stands`, `3 fall`.
pub fn counted(count: usize, verdict: Verdict) -> String {
    let word = match (verdict, count) {
        (Verdict::Stable, 1) => "stands",
        (Verdict::Stable, _) => "stand",
        (Verdict::Unstable, 1) => "falls",
        (Verdict::Unstable, _) => "fall",
        (Verdict::Undecided, _) => "undecided",
    };
    format!("{count} {word}")
}

/// Why a frame does not stand, in few words for below a figure; empty where it does.
pub fn reason(scene: &Scene, found: &FrameAnalysis) -> String {
    let mut sentences = Vec::new();
    sentences.extend(uncarried(scene, found));
    if !found.failures.is_empty() {
        let failures = by_amount(found).into_iter();
        let parts = failures.map(|f| missing(scene, f)).collect();
        sentences.push(format!("missing: {}", listed(&shortened(parts, 3))));
    }
    if found.only_by_wedging == Some(true) {
        sentences.push("only by wedging: its loads alone do not build up what holds it".to_owned());
    }
    if found.verdict == Verdict::Undecided && !found.doubts.is_empty() {
        sentences.push(found.doubt());
    }
    sentences.join("; ")
}

/// What a frame lacks to stand, for a sentence; empty where it stands.
pub fn lacks(scene: &Scene, found: &FrameAnalysis) -> String {
    let mut parts: Vec<String> = Vec::new();
    parts.extend(uncarried(scene, found));
    let failures = by_amount(found).into_iter();
    let failures: Vec<String> = failures.map(|f| lacking(scene, f)).collect();
    parts.extend(shortened(failures, MOST));
    if found.only_by_wedging == Some(true) {
        parts.push("only wedged, by forces that its loads alone do not build up".to_owned());
    }
    if found.verdict == Verdict::Undecided {
        parts.push(found.doubt());
    }
    parts.retain(|p| !p.is_empty());
    parts.join("; ")
}

/// The verdict in a sentence for somebody who knows nothing of programs, with its reason.
pub fn sentence(scene: &Scene, found: &FrameAnalysis) -> String {
    match found.verdict {
        Verdict::Stable if found.only_by_wedging == Some(true) => {
            "It stands, but only by wedging: forces that hold every block at rest exist, and nothing that acts on it \
             builds them up."
                .into()
        }
        Verdict::Stable if found.robots.is_empty() => {
            "It stands: contacts can press and rub so that every block stays at rest.".into()
        }
        Verdict::Stable => {
            "It stands: contacts can press and rub, and robots hold, so that every block stays at rest.".into()
        }
        Verdict::Unstable => match lacks(scene, found) {
            lacks if lacks.is_empty() => {
                "It falls: no forces that contacts and robots can give hold every block at rest."
                    .into()
            }
            lacks => format!("It falls: {lacks}."),
        },
        Verdict::Undecided => format!(
            "It is undecided: neither forces that hold it nor a motion by which it falls could be proved; {}.",
            found.doubt()
        ),
    }
}
