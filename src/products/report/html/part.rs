//! [`section`]: writes a scene as a part of a page.

use maud::{Markup, PreEscaped, html};

use super::{path, thumbnail, verdict, verdicts};
use crate::pictures::chart;
use crate::pictures::drawing::Drawing;
use crate::pictures::output::svg::{self, Options};
use crate::products::report::entry::{
    Badge, BarEnd, Chart, Entry, Figure, Grid, HoverTarget, MarginBar, Section, SheetPart, TableCell, touched,
};
use crate::products::wording::margin::Position;

/// Tables with more rows are collapsed.
const MAX_OPEN_ROWS: usize = 24;

/// Writes a scene as a collapsible part of a page. `number` is the number of the scene, counted from 1.
pub(crate) fn section(entry: &Entry, number: usize) -> String {
    let row = &entry.row;
    let body = html! {
        div.scene-body {
            @if !entry.details.is_empty() { p.details { @for detail in &entry.details { bdi { (detail) } " " } } }
            @for (place, section) in entry.sections.iter().enumerate() {
                (self::step(section, (number, place + 1)))
            }
            p.small { (entry.origin) }
            (again(entry, number))
        }
    };
    html! {
        details.scene id=(format!("scene-{number}")) data-verdict=(row.verdict.plain()) {
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

/// Writes a section of a scene. `number` is the number of the scene, and `place` the number of the section in the
/// scene. Both count from 1.
fn step(section: &Section, (number, place): (usize, usize)) -> Markup {
    let id = format!("scene-{number}-step-{place}");
    let label = format!("{} {}", section.letter, section.title);
    // The label of an ARIA landmark must be unique on the page, so it includes the number of the scene.
    let label = match label.trim() {
        "" => None,
        label => Some(format!("Scene {number}: {label}")),
    };
    let mut writer = Writer {
        mark: format!("s{number}x{place}x"),
        place: format!("{number}.{place}"),
        level: if section.title.is_empty() { 3 } else { 4 },
        figures: 0,
        tables: 0,
    };
    html! {
        section.step.newpage[section.begins_page] id=(id) aria-label=[label] {
            @if !section.title.is_empty() {
                h3 {
                    @if !section.letter.is_empty() { "(" (section.letter) ") " }
                    bdi { (section.title) }
                    @if !section.letter.is_empty() { " " (verdict(section.verdict)) }
                }
            }
            (writer.parts(&section.parts))
        }
    }
}

/// Writes the parts of a section and numbers its figures.
struct Writer {
    /// The prefix of all ids in the figures of the section. It makes these ids unique on the page.
    mark: String,
    /// The numbers of the scene and of the section: `3.1`.
    place: String,
    /// The level of the HTML headings above parts: 3 or 4.
    level: u8,
    /// The number of drawings written so far.
    figures: usize,
    /// The number of tables written so far.
    tables: usize,
}

impl Writer {
    fn parts(&mut self, parts: &[SheetPart]) -> Markup {
        html! { @for part in parts { (self.part(part)) } }
    }

    fn part(&mut self, part: &SheetPart) -> Markup {
        html! {
            @match part {
                SheetPart::Badge(of) => (badge(of)),
                SheetPart::Heading(words) => {
                    @if self.level == 3 { h3.part { bdi dir="ltr" { (words) } } }
                    @else { h4.part { bdi dir="ltr" { (words) } } }
                },
                // Sentences run from left to right, even if they begin with a name in another script.
                SheetPart::Text(words) => p.text { bdi dir="ltr" { (words) } },
                SheetPart::Note(words) => p.small { bdi dir="ltr" { (words) } },
                SheetPart::Figures(figures) => div.plates { @for figure in figures { (self.plate(figure)) } },
                SheetPart::Table(of) => (self.grid(of)),
                SheetPart::Columns(columns) => div.columns { @for parts in columns { div { (self.parts(parts)) } } },
                SheetPart::Charts(charts) => div.charts { @for of in charts { (chart(of)) } },
            }
        }
    }

    fn grid(&mut self, of: &Grid) -> Markup {
        if of.lines.is_empty() {
            return html! {};
        }
        self.tables += 1;
        let what = match (of.caption.as_str(), of.heads.first()) {
            ("", Some((head, _))) => head,
            (caption, _) => caption,
        };
        let label = format!("Table {}.{}: {what}", self.place, self.tables);
        let table = html! {
            div.wide tabindex="0" role="region" aria-label=(label) {
                table.sums[of.has_sum].margins[of.heads.iter().any(|h| h.0 == "range")] {
                    @if !of.caption.is_empty() { caption { (of.caption) } }
                    thead { tr { @for (head, number) in &of.heads { th.number[*number] scope="col" { (head) } } } }
                    tbody {
                        @for line in &of.lines {
                            tr data-mark=[(!line.mark.is_empty()).then_some(&line.mark)] {
                                @for (i, of_cell) in line.cells.iter().enumerate() {
                                    td.number[of.heads.get(i).is_some_and(|h| h.1)] { (cell(of_cell)) }
                                }
                            }
                        }
                    }
                }
            }
        };
        html! {
            @if of.lines.len() > MAX_OPEN_ROWS {
                details.long { summary { (label) ": " (of.lines.len()) " lines" } (table) }
            } @else { (table) }
        }
    }

    fn plate(&mut self, figure: &Figure) -> Markup {
        let mut drawn = |drawing: &Drawing| {
            self.figures += 1;
            picture(drawing, &format!("{}{}", self.mark, self.figures), &figure.touches)
        };
        let light = drawn(&figure.drawing);
        let dark = figure.dark.as_ref().map(drawn);
        let kind = figure.subject.map(|(kind, _)| kind.name());
        let step = figure.subject.map(|(_, index)| index + 1);
        html! {
            figure.plate data-kind=[kind] data-step=[step] {
                @match dark {
                    Some(dark) => { div.paper.light { (light) } div.paper.dark { (dark) } },
                    None => div.paper { (light) },
                }
                @if !figure.touches.is_empty() {
                    p.readout aria-hidden="true" { "Point at a joint, a robot or a table row to highlight it." }
                }
                figcaption { (figure.caption) }
            }
        }
    }
}

fn picture(drawing: &Drawing, mark: &str, touches: &[HoverTarget]) -> Markup {
    let drawing = touched(drawing, touches);
    let options = Options { mark: Some(mark.to_owned()), ..Options::default() };
    // These options write text with font names, not as outlines. Such text needs no layout, so this call cannot fail.
    PreEscaped(svg::write_with(&drawing, &options).unwrap_or_else(|_| svg::write(&drawing)))
}

fn badge(badge: &Badge) -> Markup {
    html! {
        div.badge.(badge.verdict.plain()) {
            p.word { (verdict(badge.verdict)) }
            div {
                @if !badge.headline.is_empty() { p.headline { strong { bdi dir="ltr" { (badge.headline) } } } }
                @if !badge.sentence.is_empty() { p.sentence { bdi dir="ltr" { (badge.sentence) } } }
            }
        }
    }
}

fn chart(of: &Chart) -> Markup {
    if of.wide {
        return html! {
            figure.chart.study { div.paper.always { (PreEscaped(&of.svg)) } figcaption { (of.caption) } }
        };
    }
    // The page may have a dark background, so the chart uses the colours of the page.
    let svg = of.svg.replace(chart::INK, "currentColor").replace(chart::GRID, "var(--rule)");
    html! {
        figure.chart { (PreEscaped(svg)) figcaption { (of.caption) } }
    }
}

fn cell(cell: &TableCell) -> Markup {
    html! {
        @if let Some(of) = &cell.bar { (bar(of)) }
        @else if let Some(picture) = &cell.picture { (thumbnail(picture)) }
        @else if cell.strong { strong { bdi dir="ltr" { (cell.words) } } }
        @else { bdi dir="ltr" { (cell.words) } }
    }
}

/// Writes the commands that make the results of a scene again, and the text of its file.
fn again(entry: &Entry, number: usize) -> Markup {
    html! {
        details.again {
            summary { "Repeat it: commands" @if !entry.source.is_empty() { " and the scene’s file" } }
            @for (what, command) in &entry.commands {
                p { "For " (what) ": " code.command { (command) } }
            }
            @if !entry.source.is_empty() {
                p { label for=(format!("source-{number}")) { "The scene file, to copy:" } }
                textarea.source id=(format!("source-{number}")) readonly rows="12" spellcheck="false" {
                    // Browsers ignore the first line feed of a text area. Add one, so that the source stays complete.
                    "\n" (entry.source)
                }
            }
        }
    }
}

/// Width and height of a bar, pixels.
const BAR_SIZE: (f64, f64) = (220.0, 20.0);
/// Distance between an end of the scale and the end of the picture, pixels. It is space for marks and arrows at the
/// ends of the scale.
const INSET: f64 = 7.0;

/// Draws a margin as a bar that covers the values at which the structure stands. An end is a stroke, which is dashed
/// if the end is not confirmed, or an arrow if the structure stands at all values beyond. An end at the limit of the
/// parameter's domain has no mark. The current value is a disc inside the bar, a cross outside it, or a ring if its
/// position is unknown. If there are several current values, the least and the largest are drawn. The shapes differ, so
/// that they are clear without colours.
fn bar(bullet: &MarginBar) -> Markup {
    let (width, height) = BAR_SIZE;
    let at = |value: f64| {
        let room = width - 2.0 * INSET;
        let x = ((INSET + room * bullet.share(value)) * 10.0).round() / 10.0;
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

/// Draws the mark of the current value. `at` is its x coordinate in pixels.
fn now(position: Position, at: f64) -> Markup {
    html! {
        @match position {
            Position::Inside => circle.now cx=(at) cy="10" r="4.5" {},
            Position::Outside => path.now.outside d=(format!("M{} 5l10 10m0 -10l-10 10", at - 5.0)) {},
            Position::Unknown => circle.now.unknown cx=(at) cy="10" r="4" {},
        }
    }
}
