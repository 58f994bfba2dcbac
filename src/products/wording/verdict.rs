//! Describes in words whether a frame stands, and the reasons why not.

use super::failure::{by_amount, missing_phrase, missing_sentence, shortened, unsupported_phrase};
use super::number::listed;
use crate::mechanics::analysis::{FALLS, FrameAnalysis, STANDS, UNDECIDED, Verdict};
use crate::mechanics::scene::Scene;

/// Largest number of failures that a sentence names. All further failures are only counted.
const MAX_FAILURES_IN_SENTENCE: usize = 4;
/// Largest number of failures that the line below a figure names. This line has less space.
const MAX_FAILURES_BELOW_FIGURE: usize = 3;

/// Returns the word for a verdict in JSON results: `stable`, `unstable`, `undecided`. Text for people uses `plain`
/// and `counted`.
pub fn word(verdict: Verdict) -> &'static str {
    verdict.word()
}

/// Returns the word for a verdict in tables, figures and sentences: `stands`, `falls`, `undecided`.
pub fn plain(verdict: Verdict) -> &'static str {
    verdict.plain()
}

/// Writes how many frames or scenes have a verdict: `1 stands`, `3 fall`.
pub fn counted(count: usize, verdict: Verdict) -> String {
    let word = match (verdict, count) {
        (Verdict::Stable, n) if n != 1 => "stand",
        (Verdict::Unstable, n) if n != 1 => "fall",
        _ => plain(verdict),
    };
    format!("{count} {word}")
}

/// Writes how many frames or scenes have each verdict: `5 stand, 1 falls`.
pub fn tally(verdicts: &[Verdict]) -> String {
    let kinds = [Verdict::Stable, Verdict::Unstable, Verdict::Undecided];
    let counts = kinds.map(|kind| (verdicts.iter().filter(|verdict| **verdict == kind).count(), kind));
    let words = counts.into_iter().filter(|(count, _)| *count > 0).map(|(count, kind)| counted(count, kind));
    words.collect::<Vec<_>>().join(", ")
}

/// Describes briefly why a frame does not stand, or that it stands only by wedging. Figures show this text below the
/// verdict. The text is empty for all other frames.
pub fn reason(scene: &Scene, frame_analysis: &FrameAnalysis) -> String {
    if frame_analysis.verdict == Verdict::Undecided && !frame_analysis.doubts.is_empty() {
        // The text must fit in two lines, so it contains only the first part of the doubt, which is the reason. The
        // report and the terminal also show the remedies.
        let doubt = frame_analysis.doubt();
        return doubt.split("; ").next().unwrap_or_default().to_owned();
    }
    let mut sentences = Vec::new();
    sentences.extend(unsupported_phrase(scene, frame_analysis));
    if !frame_analysis.failures.is_empty() {
        let failures = by_amount(frame_analysis).into_iter();
        let parts = failures.map(|f| missing_phrase(scene, f)).collect();
        sentences.push(format!("missing: {}", listed(&shortened(parts, MAX_FAILURES_BELOW_FIGURE))));
    }
    if frame_analysis.only_by_wedging == Some(true) {
        sentences.push("only by wedging: its loads alone do not build up the forces that hold it".to_owned());
    }
    sentences.join("; ")
}

/// Describes why a frame does not stand, or that it stands only by wedging, as clauses of a sentence. The text is
/// empty for all other frames.
pub fn reasons(scene: &Scene, frame_analysis: &FrameAnalysis) -> String {
    let mut parts: Vec<String> = Vec::new();
    parts.extend(unsupported_phrase(scene, frame_analysis));
    let failures = by_amount(frame_analysis).into_iter();
    let failures: Vec<String> = failures.map(|f| missing_sentence(scene, f)).collect();
    parts.extend(shortened(failures, MAX_FAILURES_IN_SENTENCE));
    if frame_analysis.only_by_wedging == Some(true) {
        parts.push("only by wedging: its loads alone do not build up the forces that hold it".to_owned());
    }
    if frame_analysis.verdict == Verdict::Undecided {
        parts.push(frame_analysis.doubt());
    }
    parts.retain(|p| !p.is_empty());
    parts.join("; ")
}

/// Writes a sentence with the verdict and its reasons, for readers who do not program.
pub fn sentence(scene: &Scene, frame_analysis: &FrameAnalysis) -> String {
    match frame_analysis.verdict {
        Verdict::Stable if frame_analysis.only_by_wedging == Some(true) => {
            "It stands, but only by wedging: forces that hold every block at rest exist, but the loads alone do not \
             build them up."
                .into()
        }
        Verdict::Stable if frame_analysis.robots.is_empty() => {
            format!("It {STANDS}: pressure and friction at the contacts can hold every block at rest.")
        }
        Verdict::Stable => {
            format!("It {STANDS}: pressure and friction at the contacts, and the robots, can hold every block at rest.")
        }
        Verdict::Unstable => match reasons(scene, frame_analysis) {
            reasons if reasons.is_empty() => {
                format!("It {FALLS}: no forces that contacts and robots can give would hold every block at rest.")
            }
            reasons => format!("It {FALLS}: {reasons}."),
        },
        Verdict::Undecided => format!(
            "It is {UNDECIDED}: neither balancing forces nor a collapse motion could be proved; {}.",
            frame_analysis.doubt()
        ),
    }
}
