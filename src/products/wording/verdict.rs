//! Describes in words whether a frame stands, the reasons why not, and the proof of its verdict.

use super::failure::{by_amount, missing_phrase, missing_sentence, shortened, unsupported_phrase};
use super::number::{digits, listed, rough};
use crate::mechanics::analysis::{FALLS, Proof, STANDS, SolvedFrame, UNDECIDED, Verdict};

/// Largest number of failures that a sentence names. All further failures are only counted.
const MAX_FAILURES_IN_SENTENCE: usize = 4;
/// Largest number of failures that the line below a figure names. This line has less space.
const MAX_FAILURES_BELOW_FIGURE: usize = 3;
/// Why a frame that stands may fall all the same.
const ONLY_BY_WEDGING: &str = "only by wedging: its loads alone do not build up the forces that hold it";

/// Writes how many frames or scenes have a verdict: `1 stands`, `3 fall`.
pub fn counted(count: usize, verdict: Verdict) -> String {
    let word = match (verdict, count) {
        (Verdict::Stable, n) if n != 1 => "stand",
        (Verdict::Unstable, n) if n != 1 => "fall",
        _ => verdict.plain(),
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
pub fn reason(solved: SolvedFrame<'_>) -> String {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    if frame_analysis.verdict == Verdict::Undecided && !frame_analysis.doubts.is_empty() {
        // The text must fit in two lines, so it contains only the first part of the doubt, which is the reason. The
        // report and the terminal also show the remedies.
        let doubt = frame_analysis.doubt();
        return doubt.split("; ").next().unwrap_or_default().to_owned();
    }
    let mut sentences = Vec::new();
    sentences.extend(unsupported_phrase(solved));
    if !frame_analysis.failures.is_empty() {
        let failures = by_amount(frame_analysis).into_iter();
        let parts = failures.map(|f| missing_phrase(scene, f)).collect();
        sentences.push(format!("missing: {}", listed(&shortened(parts, MAX_FAILURES_BELOW_FIGURE))));
    }
    if frame_analysis.only_by_wedging == Some(true) {
        sentences.push(ONLY_BY_WEDGING.to_owned());
    }
    sentences.join("; ")
}

/// Describes why a frame does not stand, or that it stands only by wedging, as clauses of a sentence. The text is
/// empty for all other frames.
pub fn reasons(solved: SolvedFrame<'_>) -> String {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut parts: Vec<String> = Vec::new();
    parts.extend(unsupported_phrase(solved));
    let failures = by_amount(frame_analysis).into_iter();
    let failures: Vec<String> = failures.map(|f| missing_sentence(scene, f)).collect();
    parts.extend(shortened(failures, MAX_FAILURES_IN_SENTENCE));
    if frame_analysis.only_by_wedging == Some(true) {
        parts.push(ONLY_BY_WEDGING.to_owned());
    }
    if frame_analysis.verdict == Verdict::Undecided {
        parts.push(frame_analysis.doubt());
    }
    parts.retain(|p| !p.is_empty());
    parts.join("; ")
}

/// Writes a sentence with the verdict and its reasons, for readers who do not program.
pub fn sentence(solved: SolvedFrame<'_>) -> String {
    let SolvedFrame { found: frame_analysis, .. } = solved;
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
        Verdict::Unstable => match reasons(solved) {
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

/// Describes a proof in a few words, for one line of a table: `forces balance to 3e-12`.
pub fn proof_in_short(proof: Proof) -> String {
    match proof {
        Proof::Forces { worst_imbalance, worst_pull, worst_slip, .. } => {
            format!("forces balance to {}", rough(worst_imbalance.max(worst_pull).max(worst_slip)))
        }
        Proof::Mechanism { power, .. } => {
            let ruled_out = match proof.excluded_force_sum() {
                sum if sum.is_finite() => format!("no balance below {} loads", rough(sum)),
                _ => "no balance at all".into(),
            };
            format!("motion of power {}: {ruled_out}", digits(power))
        }
    }
}

/// Returns the numbers that characterize a proof, each with a label that says what it measures.
pub fn proof_numbers(proof: Proof) -> Vec<(&'static str, String)> {
    match proof {
        Proof::Forces { worst_imbalance, worst_pull, worst_slip, .. } => vec![
            ("worst imbalance of a block, relative to the forces on it", rough(worst_imbalance)),
            ("worst pull at a contact, relative to the forces at this contact", rough(worst_pull)),
            ("worst excess over a friction limit or robot limit, relative to the force there", rough(worst_slip)),
        ],
        Proof::Mechanism { power, worst_violation } => vec![
            (
                "power of the loads along the motion, less what robots can absorb, relative to the loads of the moving blocks",
                digits(power),
            ),
            (
                "worst speed against a contact or robot, relative to the speed of the fastest point",
                rough(worst_violation),
            ),
            (
                "lower bound on the sum of balancing forces, relative to the loads of the moving blocks",
                match proof.excluded_force_sum() {
                    sum if sum.is_finite() => rough(sum),
                    _ => "unbounded".into(),
                },
            ),
        ],
    }
}

/// Explains in one or more sentences what a proof shows, for readers who do not know the method.
pub fn proof_sentence(proof: Proof) -> String {
    match proof {
        Proof::Forces { worst_imbalance, worst_pull, worst_slip, .. } => {
            let worst = worst_imbalance.max(worst_pull).max(worst_slip);
            let band = rough(Proof::IMBALANCE_TOL);
            if proof.holds() {
                format!(
                    "The listed forces hold every block at rest. This was checked from the outlines and weights alone: \
                     the forces balance exactly if each force changes by at most {} times its size. The limit is \
                     {band}.",
                    rough(worst)
                )
            } else {
                format!(
                    "The best forces found do not prove that the structure stands: to balance and to respect the \
                     contacts, they would have to change by {} times their size. The limit is {band}.",
                    rough(worst)
                )
            }
        }
        Proof::Mechanism { .. } => {
            let ruled_out = match proof.excluded_force_sum() {
                sum if sum.is_finite() => format!(
                    "so no forces balance the structure if their sum is less than {} times the loads of the moving blocks",
                    rough(sum)
                ),
                _ => "so no forces balance the structure, however large".into(),
            };
            let weak = if proof.holds() {
                ""
            } else {
                " The power of the loads is too small for a proof, or blocks move too fast against a contact or robot."
            };
            format!(
                "There is a motion that no contact resists, and along which the loads do work, more than robots can absorb if there are any, {ruled_out}.{weak}"
            )
        }
    }
}
