//! [`accuracy_json`]: writes an accuracy study as JSON for other programs.

use super::json::{Json, object};
use crate::products::study::Case;
use crate::text::json;

/// Writes an accuracy study as one JSON object that ends with a line feed. Times are in seconds, forces in newtons,
/// and errors are relative.
pub fn accuracy_json(study: &[Case]) -> String {
    let page = object! { drystone: env!("CARGO_PKG_VERSION"), frames: Json::list(study.iter().map(frame)) };
    let mut text =
        serde_json::to_string_pretty(&page).expect("plain structures with text keys always serialise into memory");
    text.push('\n');
    json(&text).into_owned()
}

fn frame(case: &Case) -> Json<'_> {
    let runs = case.runs.iter().map(|run| {
        object! {
            method: run.method.name(),
            tolerance: run.tolerance,
            seconds: run.outcome.seconds,
            iterations: run.outcome.iterations,
            verdict: run.outcome.verdict.word(),
            mark: run.mark.word(),
            total_error: Json::or_null(run.total_error),
            largest_error: Json::or_null(run.largest_error),
            failures: run.outcome.failures,
            imbalance: Json::or_null(run.outcome.imbalance),
            violation: Json::or_null(run.outcome.violation),
        }
    });
    object! {
        frame: &case.name,
        blocks: case.blocks,
        verdict: case.reference.verdict.word(),
        total: Json::or_null(case.reference.total),
        largest: Json::or_null(case.reference.largest),
        gap: Json::or_null(case.reference.gap),
        runs: Json::list(runs),
    }
}
