//! [`accuracy_json`]: writes an accuracy study as JSON for other programs.

use serde::Serialize;

use super::{Number, word};
use crate::products::study::{Case, Mark, Study};
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
    gap: Number,
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
            seconds: Number(run.seconds),
            iterations: run.outcome.iterations,
            verdict: word(run.outcome.verdict),
            mark: match run.mark {
                Mark::Right => "right",
                Mark::Wrong => "wrong",
                Mark::Undecided => "undecided",
                Mark::Unknown => "unknown",
            },
            total_error: number(run.total_error),
            largest_error: number(run.largest_error),
            failures: run.outcome.points,
            imbalance: number(run.outcome.imbalance),
            violation: number(run.outcome.violation),
        });
        Frame {
            frame: &case.name,
            blocks: case.blocks,
            verdict: word(case.truth.verdict),
            total: number(case.truth.total),
            largest: number(case.truth.largest),
            gap: Number(case.truth.gap),
            runs: runs.collect(),
        }
    }
}

/// Writes an accuracy study as one JSON object that ends with a line feed. Times are in seconds, forces in newtons,
/// and errors are relative.
pub fn accuracy_json(study: &Study) -> String {
    let page = Page { drystone: env!("CARGO_PKG_VERSION"), frames: study.cases.iter().map(Frame::new).collect() };
    let mut text =
        serde_json::to_string_pretty(&page).expect("plain structures with text keys always serialise into memory");
    text.push('\n');
    json(&text)
}
