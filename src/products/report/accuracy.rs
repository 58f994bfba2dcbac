//! Writes an accuracy study as an HTML page, a CSV table, a Markdown table or an SVG chart.
//!
//! No form states a date, and all except the Markdown table state the version of drystone. [`result::accuracy_json`]
//! writes the same study as JSON.
//!
//! [`result::accuracy_json`]: crate::products::result::accuracy_json

use maud::{DOCTYPE, PreEscaped, html};

use crate::mechanics::analysis::{Accuracy, Verdict};
use crate::pictures::chart::{ChartError, Point, Scatter, Series, scatter};
use crate::products::study::{Case, Mark, Method, Run, Summary, summary};
use crate::products::wording::number::counted;
use crate::text;

/// Relative errors below this value are drawn at this value and written as 0. They are rounding errors, because the
/// unit roundoff of f64 is 1.1e-16.
const MIN_SHOWN_ERROR: f64 = 1e-16;
/// Relative errors above this value are drawn at this value. So are methods with wrong verdicts and without a known
/// error.
const MAX_SHOWN_ERROR: f64 = 1.0;

const STYLE: &str = include_str!("../../../assets/accuracy.css");

/// The heads of the columns of a summary, which are those of the Markdown table.
const HEADS: [&str; 9] = [
    "method",
    "tolerance",
    "relative time",
    "iterations",
    "median error of total force",
    "worst error of total force",
    "worst error of largest force",
    "wrong",
    "undecided",
];

/// Returns the introduction of an accuracy page: the version, the number of frames, and which numbers depend on the
/// machine.
pub fn heading(study: &[Case]) -> String {
    format!(
        "drystone {}, {}. Times are medians of this run, and only their ratios are meaningful. Verdicts, errors and \
         iterations are the same on every machine.",
        env!("CARGO_PKG_VERSION"),
        counted(study.len(), "frame")
    )
}

/// Draws a chart as SVG. The x axis is the time relative to the method `standard`, and the y axis is the largest
/// relative error of the total force. The chart has a line for each method, and red crosses for wrong verdicts.
///
/// # Errors
/// If the chart cannot be drawn.
pub fn svg(study: &[Case]) -> Result<String, ChartError> {
    let lines = summary(study);
    let point = |line: &Summary| Point {
        x: line.time.max(1e-6),
        y: line.total_error.unwrap_or(MAX_SHOWN_ERROR).clamp(MIN_SHOWN_ERROR, MAX_SHOWN_ERROR),
        wrong: line.wrong > 0,
    };
    let shown = |line: &&Summary| line.total_error.is_some() || line.wrong > 0;
    let series = Method::ALL.map(|method| Series {
        name: method.name().to_owned(),
        colour: match method {
            Method::Clarabel => [140, 95, 175],
            Method::Level(Accuracy::Standard) => [55, 145, 70],
            Method::Level(Accuracy::Proved | Accuracy::Exact) => [15, 85, 50],
        },
        points: lines.iter().filter(|l| l.method == method).filter(shown).map(point).collect(),
    });
    scatter(&Scatter {
        title: format!(
            "What accuracy costs: {}, drystone {}",
            counted(study.len(), "frame"),
            env!("CARGO_PKG_VERSION")
        ),
        x: "time, relative to standard".into(),
        y: "worst relative error of the total force".into(),
        series: series.into(),
        wrong: "wrong verdicts".into(),
    })
}

/// Formats a relative error: `1.2e-9`, `0` below [`MIN_SHOWN_ERROR`], or `–` for `None`.
fn small(value: Option<f64>) -> String {
    value.map_or("–".into(), |v| if v < MIN_SHOWN_ERROR { "0".into() } else { format!("{v:.1e}") })
}

/// The cells of a line of the summary, in the order of [`HEADS`].
fn cells(line: &Summary) -> [String; 9] {
    [
        line.method.name().to_owned(),
        format!("{:.0e}", line.tolerance),
        format!("{:.2}", line.time),
        line.iterations.to_string(),
        small(line.median_error),
        small(line.total_error),
        small(line.largest_error),
        line.wrong.to_string(),
        line.undecided.to_string(),
    ]
}

/// Returns the summary as a Markdown table with one row for each combination of method and tolerance.
pub fn markdown(study: &[Case]) -> String {
    let mut text = format!("| {} |\n|{}\n", HEADS.join(" | "), "---|".repeat(HEADS.len()));
    for line in summary(study) {
        let mut cells = cells(&line);
        if line.wrong > 0 {
            cells[7] = format!("**{}**", line.wrong);
        }
        text += &format!("| {} |\n", cells.join(" | "));
    }
    text
}

/// Returns a CSV table with one line for each combination of frame, method and tolerance.
pub fn csv(study: &[Case]) -> String {
    let mut text = String::from(
        "drystone,frame,blocks,truth,method,tolerance,seconds,iterations,verdict,mark,total_error,largest_error,\
         failures,imbalance,violation\n",
    );
    let number = |v: Option<f64>| v.map_or(String::new(), |v| format!("{v:e}"));
    for case in study {
        for Run { method, tolerance, outcome, mark, total_error, largest_error } in &case.runs {
            let cells = [
                env!("CARGO_PKG_VERSION").to_owned(),
                text::csv(&case.name),
                case.blocks.to_string(),
                case.reference.verdict.word().to_owned(),
                method.name().to_owned(),
                format!("{tolerance:e}"),
                format!("{:e}", outcome.seconds),
                outcome.iterations.to_string(),
                outcome.verdict.word().to_owned(),
                if *mark == Mark::Wrong { "WRONG" } else { mark.word() }.to_owned(),
                number(*total_error),
                number(*largest_error),
                outcome.failures.to_string(),
                number(outcome.imbalance),
                number(outcome.violation),
            ];
            text += &(cells.join(",") + "\n");
        }
    }
    text
}

/// Returns an HTML page with the chart, the summary, and a collapsible table of runs for each frame.
///
/// # Errors
/// If the chart cannot be drawn.
pub fn page(study: &[Case]) -> Result<String, ChartError> {
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
                    "The reference is the level proved with a tolerance far below the others. "
                    "The solver clarabel alone proves nothing, and finds no sticking. "
                    "A red cross marks a method and tolerance with at least one wrong verdict."
                }
                h2 { "All frames together" }
                table {
                    tr { @for head in HEADS { th { (head) } } }
                    @for line in summary(study) {
                        tr.wrong[line.wrong > 0] { @for cell in cells(&line) { td { (cell) } } }
                    }
                }
                h2 { "Frame by frame" }
                @for case in study { (frame(case)) }
            }
        }
    };
    Ok(page.into_string())
}

fn frame(case: &Case) -> maud::Markup {
    let wrong = case.runs.iter().filter(|r| r.mark == Mark::Wrong).count();
    let reference = &case.reference;
    html! {
        details {
            summary {
                (text::line(&case.name)) ": " (reference.verdict.plain()) ", " (counted(case.blocks, "block"))
                @if wrong > 0 { ", " (counted(wrong, "wrong verdict")) }
            }
            p.small {
                @match (reference.verdict, reference.total) {
                    (Verdict::Undecided, _) => { "The reference of this frame is undecided." }
                    (_, Some(total)) => { "Reference " (format!("{total:.15e}")) " N." }
                    (_, None) => { "There is no finite total to compare." }
                }
                @if let Some(gap) = reference.gap { " A motion proves this least total to " (small(Some(gap))) "." }
                @if let Some(largest) = reference.largest { " Largest force " (format!("{largest:.15e}")) " N." }
            }
            table {
                tr {
                    th { "method" } th { "tolerance" } th { "milliseconds" } th { "iterations" } th { "verdict" }
                    th { "error of total" } th { "of largest force" } th { "failures" } th { "imbalance" } th { "violation" }
                }
                @for Run { method, tolerance, outcome, mark, total_error, largest_error } in &case.runs {
                    tr.wrong[*mark == Mark::Wrong] {
                        td { (method.name()) }
                        td { (format!("{tolerance:.0e}")) }
                        td { (format!("{:.3}", 1e3 * outcome.seconds)) }
                        td { (outcome.iterations) }
                        td.undecided[*mark == Mark::Undecided] { (outcome.verdict.plain()) @if *mark == Mark::Wrong { " (wrong)" } }
                        td { (small(*total_error)) }
                        td { (small(*largest_error)) }
                        td { (outcome.failures) }
                        td { (small(outcome.imbalance)) }
                        td { (small(outcome.violation)) }
                    }
                }
            }
        }
    }
}
