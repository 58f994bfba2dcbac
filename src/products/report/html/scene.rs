//! A scene's part of a page.

use maud::{Markup, PreEscaped, html};

use super::{path, thumbnail, verdict, verdicts};
use crate::chart;
use crate::output::svg::{self, Options};
use crate::report::entry::{Chart, Entry, Figure, Grid, MarginBar, Step, touched};

/// Tables of more lines are folded.
const LONG: usize = 24;
/// Width and height of a margin's bar.
const BAR: (f64, f64) = (220.0, 16.0);

/// A scene as a part of a page that unfolds.
pub(crate) fn section(entry: &Entry, number: usize) -> String {
    let row = &entry.row;
    let several = entry.steps.len() > 1;
    let body = html! {
        div.scene-body {
            @for remark in &entry.remarks { p.small { (remark) } }
            @if several { (strip(entry, number)) }
            @for (place, step) in entry.steps.iter().enumerate() {
                (self::step(step, (number, place + 1), several))
            }
            @if !entry.charts.is_empty() {
                div.charts { @for chart in &entry.charts { (self::chart(chart)) } }
            }
            @if let Some(study) = &entry.study {
                figure.chart.study { div.paper { (PreEscaped(&study.svg)) } figcaption { (study.caption) } }
            }
            (again(entry, number))
        }
    };
    html! {
        details.scene id=(format!("scene-{number}")) data-verdict=(crate::wording::verdict::plain(row.verdict)) {
            summary {
                (thumbnail(&row.thumbnail))
                h2 { bdi { (row.title) } }
                " "
                (verdicts(row))
                span.file { (path(&row.name)) }
            }
            noscript { (body) }
        }
    }
    .into_string()
}

/// Links to the steps, each with its verdict; scripts make buttons of them.
fn strip(entry: &Entry, number: usize) -> Markup {
    html! {
        nav.steps aria-label="Steps" {
            ol {
                @for (place, step) in entry.steps.iter().enumerate() {
                    li {
                        a href=(format!("#scene-{number}-step-{}", place + 1)) data-verdict=(crate::wording::verdict::plain(step.verdict)) {
                            "(" (step.letter) ") " bdi { (step.title) } " " (verdict(step.verdict))
                        }
                    }
                }
            }
        }
    }
}

fn step(step: &Step, (number, place): (usize, usize), several: bool) -> Markup {
    let id = format!("scene-{number}-step-{place}");
    let mark = |plate: usize| format!("s{number}x{place}x{}-", plate + 1);
    html! {
        section.step id=(id) aria-label=(if several { format!("Step {}: {}", step.letter, step.title) } else { step.title.clone() }) {
            @if several { h3 { "(" (step.letter) ") " bdi { (step.title) } " " (verdict(step.verdict)) } }
            // Our sentences run from the left, whatever script the first name in them is of.
            p.sentence { bdi dir="ltr" { (step.sentence) } }
            @for remark in &step.remarks { p.small { bdi dir="ltr" { (remark) } } }
            div.plates {
                @for (i, plate) in step.plates.iter().enumerate() {
                    (self::plate(plate, &mark(i), if i == 0 { &step.touches } else { &[] }))
                }
            }
            @if !step.bullets.is_empty() {
                h4 { "Margins" }
                (bullets(&step.bullets))
            }
            @for grid in &step.grids { (self::grid(grid)) }
            @if !step.proof.is_empty() { p.proof { strong { "What the proof means: " } (step.proof) } }
            @if !step.charts.is_empty() {
                div.charts { @for chart in &step.charts { (self::chart(chart)) } }
            }
        }
    }
}

fn plate(plate: &Figure, mark: &str, touches: &[crate::report::entry::HoverTarget]) -> Markup {
    let drawing = touched(&plate.drawing, touches);
    let options = Options {
        mark: Some(mark.trim_end_matches('-').to_owned()),
        ..Options::default()
    };
    // Words by the names of their fonts need no laying out, so that nothing can fail.
    let svg = svg::write_with(&drawing, &options).unwrap_or_else(|_| svg::write(&drawing));
    html! {
        figure.plate {
            div.paper { (PreEscaped(svg)) }
            @if !touches.is_empty() { p.readout aria-hidden="true" { "Point at an interface, a robot or a line of a table." } }
            figcaption { (plate.caption) }
        }
    }
}

fn chart(of: &Chart) -> Markup {
    // In the page's own ink, which may be light on dark.
    let svg = of
        .svg
        .replace(chart::INK, "currentColor")
        .replace(chart::GRID, "var(--rule)");
    html! {
        figure.chart { (PreEscaped(svg)) figcaption { (of.caption) } }
    }
}

fn grid(of: &Grid) -> Markup {
    let table = html! {
        div.wide tabindex="0" role="region" aria-label=(of.caption) {
            table {
                caption { (of.caption) }
                thead { tr { @for (head, number) in &of.heads { th.number[*number] scope="col" { (head) } } } }
                tbody {
                    @for line in &of.lines {
                        tr data-mark=[(!line.mark.is_empty()).then_some(&line.mark)] {
                            @for (i, cell) in line.cells.iter().enumerate() {
                                td.number[of.heads.get(i).is_some_and(|h| h.1)] { bdi dir="ltr" { (cell) } }
                            }
                        }
                    }
                }
            }
        }
    };
    html! {
        @if of.lines.len() > LONG {
            details.long { summary { (of.caption) ": " (of.lines.len()) " lines" } (table) }
        } @else { (table) }
    }
}

fn bullets(bullets: &[MarginBar]) -> Markup {
    html! {
        div.wide tabindex="0" role="region" aria-label="Margins" {
            table.margins {
                caption { "How far it is from the edge: the bar is where it stands, the line where it is now." }
                thead { tr { th scope="col" { "margin" } th scope="col" { "bar" } th scope="col" { "in numbers" } } }
                tbody {
                    @for bullet in bullets {
                        tr {
                            th scope="row" { bdi dir="ltr" { (bullet.name) } }
                            td { (bar(bullet)) }
                            td { bdi { (bullet.words) } }
                        }
                    }
                }
            }
        }
    }
}

fn bar(bullet: &MarginBar) -> Markup {
    let (width, height) = BAR;
    let (low, high) = bullet.scale;
    let at = |value: f64| {
        let share = if high > low {
            (value - low) / (high - low)
        } else {
            0.0
        };
        let x = (width * share.clamp(0.0, 1.0) * 10.0).round() / 10.0 + 0.0;
        if x.is_finite() { x } else { 0.0 }
    };
    html! {
        svg.bar viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img"
            aria-label=(format!("{}: {}", bullet.name, bullet.words)) {
            rect.all x="0" y="4" width=(width) height="8" {}
            @if let Some((from, to)) = bullet.safe {
                rect.safe x=(at(from)) y="4" width=((at(to) - at(from)).max(1.0)) height="8" {}
            }
            @if let Some(now) = bullet.now {
                rect.now x=((at(now) - 1.5).clamp(0.0, width - 3.0)) y="0" width="3" height=(height) {}
            }
        }
    }
}

fn again(entry: &Entry, number: usize) -> Markup {
    html! {
        details.again {
            summary { "Make it again: commands" @if !entry.source.is_empty() { " and the scene’s file" } }
            @for (what, command) in &entry.commands {
                p { "For " (what) ": " code.command { (command) } }
            }
            @if !entry.source.is_empty() {
                p { label for=(format!("source-{number}")) { "The scene’s own JSON, to copy:" } }
                textarea.source id=(format!("source-{number}")) readonly rows="12" spellcheck="false" {
                    // A browser drops the first line feed of a text area.
                    "\n" (entry.source)
                }
            }
        }
    }
}
