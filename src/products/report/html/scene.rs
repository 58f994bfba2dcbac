//! A scene's part of a page.

use maud::{Markup, PreEscaped, html};

use super::{path, thumbnail, verdict, verdicts};
use crate::chart;
use crate::output::svg::{self, Options};
use crate::report::entry::{BarEnd, Chart, Entry, Figure, Grid, MarginBar, Step, touched};
use crate::wording::margin::Position;

/// Tables of more lines are folded.
const LONG: usize = 24;
/// Width and height of a margin's bar.
const BAR: (f64, f64) = (220.0, 20.0);
/// The scale ends this far from the bar's ends: marks and arrows there stay inside.
const INSET: f64 = 7.0;

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
                @if let Some(first) = step.bullets.first() {
                    p.headline { strong { bdi dir="ltr" { (first.short()) } } }
                }
                (bullets(&step.bullets))
                p.small { (BAR_SHAPES) }
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

/// What the shapes of bars mean.
const BAR_SHAPES: &str = "A bar covers the values at which it stands. Stroke at an end: it falls beyond; dashed: that was not \
                          confirmed. Arrow: it stands at every value beyond. The present value is a disc inside, a cross \
                          outside, a ring where it is undecided.";

fn bullets(bullets: &[MarginBar]) -> Markup {
    html! {
        div.wide tabindex="0" role="region" aria-label="Margins" {
            table.margins {
                caption { "At which values it stands, the most important margin first" }
                thead { tr { th scope="col" { "margin" } th scope="col" { "bar" } th scope="col" { "in words" } } }
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

/// A bar from the lower to the upper end of the interval, on a scale. Shapes tell what colours tell: a stroke at an end that
/// was found, a dashed one where it was not confirmed, an arrow where there is no end; a disc for a present value inside, a
/// cross for one outside, a ring where neither was shown.
fn bar(bullet: &MarginBar) -> Markup {
    let (width, height) = BAR;
    let (low, high) = bullet.scale;
    let at = |value: f64| {
        let share = if high > low {
            (value - low) / (high - low)
        } else {
            0.0
        };
        let room = width - 2.0 * INSET;
        let x = ((INSET + room * share.clamp(0.0, 1.0)) * 10.0).round() / 10.0;
        if x.is_finite() { x } else { 0.0 }
    };
    let end = |end: BarEnd, at: f64, outward: f64| {
        html! {
            @match end {
                BarEnd::Domain => {}
                BarEnd::Edge => line.edge x1=(at) y1="2" x2=(at) y2="18" {},
                BarEnd::Unconfirmed => line.edge.unconfirmed x1=(at) y1="2" x2=(at) y2="18" {},
                BarEnd::Open => path.open d=(format!("M{at} 3l{} 7l{} 7z", outward * INSET, -outward * INSET)) {},
            }
        }
    };
    html! {
        svg.bar viewBox=(format!("0 0 {width} {height}")) width=(width) height=(height) role="img"
            aria-label=(format!("{}: {}", bullet.name, bullet.words)) {
            rect.all x=(INSET) y="8.5" width=(width - 2.0 * INSET) height="3" {}
            @if let Some((from, to)) = bullet.safe {
                rect.safe x=(at(from)) y="6" width=(((at(to) - at(from)) * 10.0).round() / 10.0) height="8" {}
                (end(bullet.ends.0, at(from), -1.0))
                (end(bullet.ends.1, at(to), 1.0))
            }
            @if let Some((least, most)) = bullet.now {
                @if least < most { line.between x1=(at(least)) y1="10" x2=(at(most)) y2="10" {} }
                (now(bullet.position, at(least)))
                @if least < most { (now(bullet.position, at(most))) }
            }
        }
    }
}

/// The mark of the present value.
fn now(position: Position, at: f64) -> Markup {
    html! {
        @match position {
            Position::Inside => circle.now cx=(at) cy="10" r="4.5" {},
            Position::Outside => path.now.outside d=(format!("M{} 5l10 10m0 -10l-10 10", at - 5.0)) {},
            Position::Unknown => circle.now.unknown cx=(at) cy="10" r="4" {},
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
