//! Describes the load cases of a frame.

use super::number::three_down;
use crate::mechanics::analysis::{CaseResult, FrameAnalysis, Verdict};
use crate::text::line;

/// Names the case to which the results of a frame belong; `None` if the scene has no cases.
pub fn worst(found: &FrameAnalysis) -> Option<String> {
    let cases = found.cases.as_ref()?;
    let governing = &cases.each[cases.governing];
    let word = if is_compared(governing) { "worst case" } else { "case" };
    Some(format!("{word}: {}", line(&governing.id)))
}

/// True if a case is known to be the worst: it does not stand, or the margins of all cases were computed. Otherwise it is
/// the first of several cases that stand.
fn is_compared(governing: &CaseResult) -> bool {
    governing.verdict != Verdict::Stable || governing.margins.is_some()
}

/// Returns a line for each case with its verdict and its margin, the worst case marked.
pub fn lines(found: &FrameAnalysis) -> Vec<String> {
    let Some(cases) = &found.cases else {
        return Vec::new();
    };
    let mark = |number: usize| match is_compared(&cases.each[cases.governing]) {
        _ if number != cases.governing => "",
        true => " (the worst case)",
        false => " (its forces are listed)",
    };
    let each = cases.each.iter().enumerate();
    each.map(|(number, case)| format!("case {}: {}{}", line(&case.id), verdict(case), mark(number))).collect()
}

/// Returns the verdict of a case in words, with its load factor or its tilt if they were computed.
pub fn verdict(case: &CaseResult) -> String {
    let words = case.verdict.plain();
    let Some(margins) = case.margins.as_ref().filter(|_| case.verdict == Verdict::Stable) else {
        return words.to_owned();
    };
    match (margins.load_factor.at(), margins.tilt.left.at(), margins.tilt.right.at()) {
        (Some(factor), ..) => format!("{words}, carries its loads times {}", three_down(factor)),
        (None, Some(left), Some(right)) => {
            format!("{words}, falls at {}° to the left, {}° to the right", three_down(left), three_down(right))
        }
        _ => words.to_owned(),
    }
}
