//! Writes an accuracy study as an HTML page, a CSV table, a Markdown table or an SVG picture.
//!
//! All forms come from one [`Study`]. No form states a date, and all except the Markdown table state the version of
//! drystone. [`result::accuracy_json`] writes the same study as JSON.
//!
//! [`result::accuracy_json`]: crate::products::result::accuracy_json

mod picture;

pub use picture::picture;

use std::fmt::Write as _;

use maud::{DOCTYPE, PreEscaped, html};

use crate::mechanics::analysis::{Accuracy, Verdict};
use crate::pictures::chart::{ChartError, Point, Scatter, Series, scatter};
use crate::products::result::word;
use crate::products::study::{Case, Mark, Method, Run, Study, Summary, summary};
use crate::products::wording::verdict::plain;
use crate::text;

/// Relative errors below this value are drawn at this value and written as 0. They are rounding errors, because the
/// unit roundoff of f64 is 1.1e-16.
const MIN_SHOWN_ERROR: f64 = 1e-16;
/// Relative errors above this value are drawn at this value. So are methods with wrong verdicts and without a known
/// error.
const MAX_SHOWN_ERROR: f64 = 1.0;

const STYLE: &str = include_str!("../../../assets/accuracy.css");

/// Writes the number of frames of a study: `41 frames`, `1 frame`.
fn frames(study: &Study) -> String {
    match study.cases.len() {
        1 => "1 frame".into(),
        n => format!("{n} frames"),
    }
}

/// Returns the introduction of an accuracy page: the version, the number of frames, and which numbers depend on the
/// machine.
pub fn heading(study: &Study) -> String {
    format!(
        "drystone {}, {}. Times are medians of this run, and only their ratios are meaningful. Verdicts, errors and \
         iterations are the same on every machine.",
        env!("CARGO_PKG_VERSION"),
        frames(study)
    )
}

fn colour(method: Method) -> [u8; 3] {
    match method {
        Method::Source(2) => [214, 196, 225],
        Method::Source(4) => [184, 150, 205],
        Method::Source(6) => [140, 95, 175],
        Method::Source(_) => [95, 50, 135],
        Method::ForceForm => [150, 150, 150],
        Method::Kinematic => [120, 185, 225],
        Method::Unique => [40, 125, 190],
        Method::Level(Accuracy::Standard) => [55, 145, 70],
        Method::Level(Accuracy::Proved) => [15, 85, 50],
    }
}

/// Draws a chart as SVG. The x axis is the time relative to the method `standard`, and the y axis is the largest
/// relative error of the total force. The chart has a line for each method, the Pareto front, and red crosses for wrong
/// verdicts.
///
/// # Errors
/// If the chart cannot be drawn.
pub fn svg(study: &Study) -> Result<String, ChartError> {
    let lines = summary(study);
    let place = |line: &Summary| Point {
        x: line.time.max(1e-6),
        y: line.total_error.unwrap_or(MAX_SHOWN_ERROR).clamp(MIN_SHOWN_ERROR, MAX_SHOWN_ERROR),
        wrong: line.wrong > 0,
    };
    let shown = |line: &&Summary| line.total_error.is_some() || line.wrong > 0;
    let series = Method::ALL.map(|method| Series {
        name: method.name().to_owned(),
        colour: colour(method),
        points: lines.iter().filter(|l| l.method == method).filter(shown).map(place).collect(),
    });
    let mut front: Vec<(f64, f64)> = lines.iter().filter(|l| l.best).map(|l| (place(l).x, place(l).y)).collect();
    front.sort_by(|a, b| a.0.total_cmp(&b.0));
    scatter(&Scatter {
        title: format!("What accuracy costs: {}, drystone {}", frames(study), env!("CARGO_PKG_VERSION")),
        x: "time, relative to standard".into(),
        y: "worst relative error of the total force".into(),
        series: series.into(),
        wrong: "wrong verdicts".into(),
        front: ("Pareto front".into(), front),
    })
}

/// Formats a relative error: `1.2e-9`, `0` below [`MIN_SHOWN_ERROR`], or `–` for `None`.
fn small(value: Option<f64>) -> String {
    value.map_or("–".into(), |v| match v {
        v if v < MIN_SHOWN_ERROR => "0".into(),
        v => format!("{v:.1e}"),
    })
}

/// Returns a CSV table with one line for each combination of frame, method and tolerance.
pub fn csv(study: &Study) -> String {
    let mut text = String::from(
        "drystone,frame,blocks,truth,method,tolerance,seconds,iterations,verdict,mark,total_error,largest_error,\
         failures,imbalance,violation\n",
    );
    let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:e}"));
    for case in &study.cases {
        for run in &case.runs {
            // Writing to a `String` cannot fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{:e},{:e},{},{},{},{},{},{},{},{}",
                env!("CARGO_PKG_VERSION"),
                text::csv(&case.name),
                case.blocks,
                word(case.truth.verdict),
                text::csv(run.method.name()),
                run.tolerance,
                run.seconds,
                run.outcome.iterations,
                word(run.outcome.verdict),
                mark(run.mark),
                number(run.total_error),
                number(run.largest_error),
                run.outcome.points,
                number(run.outcome.imbalance),
                number(run.outcome.violation),
            );
        }
    }
    text
}

fn mark(mark: Mark) -> &'static str {
    match mark {
        Mark::Right => "right",
        Mark::Wrong => "WRONG",
        Mark::Undecided => "undecided",
        Mark::Unknown => "unknown",
    }
}

/// Returns the summary as a Markdown table with one row for each combination of method and tolerance.
pub fn markdown(study: &Study) -> String {
    let mut text = String::from(
        "| method | tolerance | relative time | iterations | median error of total force | worst error of total force | worst error of largest force | wrong | undecided |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for line in summary(study) {
        let _ = writeln!(
            text,
            "| {} | {:.0e} | {:.2} | {} | {} | {} | {} | {} | {} |",
            text::markdown(line.method.name()),
            line.tolerance,
            line.time,
            line.iterations,
            small(line.median_error),
            small(line.total_error),
            small(line.largest_error),
            match line.wrong {
                0 => "0".into(),
                n => format!("**{n}**"),
            },
            line.undecided
        );
    }
    text
}

/// Returns an HTML page with the chart, the summary, and a collapsible table of runs for each frame.
///
/// # Errors
/// If the chart cannot be drawn.
pub fn page(study: &Study) -> Result<String, ChartError> {
    let picture = svg(study)?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { "What accuracy costs" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "What accuracy costs" }
                p { (heading(study)) }
                (PreEscaped(picture))
                p.small {
                    "Errors are relative errors of the total force, or of the total sticking if a frame falls. "
                    "The reference values are computed in extended precision. The error of each reference total has a certified bound. "
                    "A red cross marks a method and tolerance with at least one wrong verdict. "
                    "The golden band is the Pareto front: no other method without wrong verdicts is both faster and more accurate."
                }
                h2 { "All frames together" }
                (lines(&summary(study)))
                h2 { "Frame by frame" }
                @for case in &study.cases { (frame(case)) }
            }
        }
    };
    Ok(page.into_string())
}

fn lines(lines: &[Summary]) -> maud::Markup {
    html! {
        table {
            tr {
                th { "method" } th { "tolerance" } th { "relative time" } th { "iterations" }
                th { "median error of total" } th { "worst error of total" } th { "worst error of largest force" } th { "wrong" } th { "undecided" }
            }
            @for line in lines {
                tr.best[line.best].wrong[line.wrong > 0] {
                    td { (line.method.name()) }
                    td { (format!("{:.0e}", line.tolerance)) }
                    td { (format!("{:.2}", line.time)) }
                    td { (line.iterations) }
                    td { (small(line.median_error)) }
                    td { (small(line.total_error)) }
                    td { (small(line.largest_error)) }
                    td { (line.wrong) " of " (line.frames) }
                    td { (line.undecided) }
                }
            }
        }
    }
}

fn frame(case: &Case) -> maud::Markup {
    let wrong = case.runs.iter().filter(|r| r.mark == Mark::Wrong).count();
    let truth = &case.truth;
    html! {
        details {
            summary {
                (text::line(&case.name)) ": " (plain(truth.verdict)) ", " (case.blocks) " blocks"
                @if truth.within_band { ", within the band" }
                @if wrong > 0 { ", " (wrong) " wrong verdicts" }
            }
            p.small {
                @match (truth.verdict, truth.total) {
                    (Verdict::Undecided, _) => { "No reference value could be certified for this frame." }
                    (_, Some(total)) => { "Reference " (format!("{total:.15e}")) " N, certified to " (small(Some(truth.gap))) "." }
                    (_, None) => { "The verdict is certified; there is no finite total to compare." }
                }
                @if let Some(largest) = truth.largest { " Largest force " (format!("{largest:.15e}")) " N." }
            }
            table {
                tr {
                    th { "method" } th { "tolerance" } th { "milliseconds" } th { "iterations" } th { "verdict" }
                    th { "error of total" } th { "of largest force" } th { "failures" } th { "imbalance" } th { "violation" }
                }
                @for run in &case.runs { (line(run)) }
            }
        }
    }
}

fn line(run: &Run) -> maud::Markup {
    html! {
        tr.wrong[run.mark == Mark::Wrong] {
            td { (run.method.name()) }
            td { (format!("{:.0e}", run.tolerance)) }
            td { (format!("{:.3}", 1e3 * run.seconds)) }
            td { (run.outcome.iterations) }
            td.undecided[run.mark == Mark::Undecided] { (plain(run.outcome.verdict)) @if run.mark == Mark::Wrong { " (wrong)" } }
            td { (small(run.total_error)) }
            td { (small(run.largest_error)) }
            td { (run.outcome.points) }
            td { (small(run.outcome.imbalance)) }
            td { (small(run.outcome.violation)) }
        }
    }
}
