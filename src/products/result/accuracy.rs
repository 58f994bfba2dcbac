//! [`accuracy_json`]: writes an accuracy study as JSON for other programs.

use serde::Serialize;

use super::{Number, word};
use crate::products::study::Case;
use crate::text::json;

#[derive(Serialize)]
struct Page<'a> {
    drystone: &'static str,
    frames: Vec<Frame<'a>>,
}

#[derive(Serialize)]
struct Frame<'a> {
    frame: &'a str,
    blocks: usize,
    verdict: &'static str,
    total: Option<Number>,
    largest: Option<Number>,
    gap: Option<Number>,
    runs: Vec<Run>,
}

#[derive(Serialize)]
struct Run {
    method: &'static str,
    tolerance: Number,
    seconds: Number,
    iterations: usize,
    verdict: &'static str,
    mark: &'static str,
    total_error: Option<Number>,
    largest_error: Option<Number>,
    failures: usize,
    imbalance: Option<Number>,
    violation: Option<Number>,
}

impl<'a> Frame<'a> {
    fn new(case: &'a Case) -> Frame<'a> {
        let number = |v: Option<f64>| v.map(Number);
        let runs = case.runs.iter().map(|run| Run {
            method: run.method.name(),
            tolerance: Number(run.tolerance),
            seconds: Number(run.outcome.seconds),
            iterations: run.outcome.iterations,
            verdict: word(run.outcome.verdict),
            mark: run.mark.word(),
            total_error: number(run.total_error),
            largest_error: number(run.largest_error),
            failures: run.outcome.failures,
            imbalance: number(run.outcome.imbalance),
            violation: number(run.outcome.violation),
        });
        Frame {
            frame: &case.name,
            blocks: case.blocks,
            verdict: word(case.reference.verdict),
            total: number(case.reference.total),
            largest: number(case.reference.largest),
            gap: number(case.reference.gap),
            runs: runs.collect(),
        }
    }
}

/// Writes an accuracy study as one JSON object that ends with a line feed. Times are in seconds, forces in newtons,
/// and errors are relative.
pub fn accuracy_json(study: &[Case]) -> String {
    let page = Page { drystone: env!("CARGO_PKG_VERSION"), frames: study.iter().map(Frame::new).collect() };
    let mut text =
        serde_json::to_string_pretty(&page).expect("plain structures with text keys always serialise into memory");
    text.push('\n');
    json(&text).into_owned()
}
