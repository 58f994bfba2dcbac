//! Writes a report as HTML. A page contains all of its figures and styles, and is readable without network and without
//! scripts.
//!
//! `maud` escapes all text. Only figures, charts, the style sheet, the scripts and finished parts of the page are
//! inserted without escaping. Scripts add sorting and filtering, marks that follow the mouse, and buttons that enlarge
//! a figure or copy the scene file. The details of each scene are in a `noscript` element. A browser without scripts shows
//! them at once. With scripts, they are only displayed when the reader opens the scene, so that a page with a thousand
//! scenes opens quickly.

mod part;

use maud::{DOCTYPE, Markup, PreEscaped, html};

pub(super) use part::section;

use super::entry::{Row, Thumbnail};
use super::head::{Head, OutputFile, STANDS_MEANING, sign, slug};
use crate::mechanics::analysis::Verdict;
use crate::text;

const STYLE: &str = include_str!("../../../../assets/report/report.css");
const SCRIPT: &str = include_str!("../../../../assets/report/report.js");

/// The content security policy of a page. It forbids all network requests.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";
/// The content security policy of a page with interactive figures. Their script starts web workers from its own
/// source text.
const INTERACTIVE_POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline' blob: 'wasm-unsafe-eval'; \
     worker-src blob:; img-src data:";

/// If a page has more scenes than this, they are collapsed when the page opens.
const MAX_OPEN_SCENES: usize = 12;

/// Writes one page with all scenes. `bodies` has the HTML of each scene from [`section`].
pub(super) fn whole(head: &Head<'_>, bodies: &[&str]) -> String {
    let main = html! {
        (refused(head))
        @if head.rows.len() > 1 { (overview(head, &|number| format!("#scene-{number}"))) }
        section #scenes aria-label="Scenes" data-open=(bodies.len() <= MAX_OPEN_SCENES) {
            @for body in bodies { (PreEscaped(body)) }
        }
    };
    page(head, head.title, &head.summary, &main)
}

/// Writes an index page, and a page for each scene. `bodies` has the HTML of each scene from [`section`].
pub(super) fn split(head: &Head<'_>, bodies: &[&str]) -> Vec<OutputFile> {
    let name = |row: &&Row| format!("{:04}-{}.html", row.number, slug(&row.title));
    let names: Vec<String> = head.rows.iter().map(name).collect();
    let link = |number: usize| {
        let place = head.rows.iter().position(|row| row.number == number);
        place.map_or(String::new(), |place| names[place].clone())
    };
    let index = html! {
        (refused(head))
        (overview(head, &link))
    };
    let mut files = vec![("index.html".to_owned(), page(head, head.title, &head.summary, &index).into_bytes())];
    for (number, (row, body)) in head.rows.iter().zip(bodies).enumerate() {
        let beside = |number: Option<usize>, words: &str| {
            let name = number.and_then(|n| names.get(n));
            html! { @if let Some(name) = name { a href=(name) { (words) } " " } }
        };
        let main = html! {
            nav aria-label="Report" {
                a href="index.html" { "All scenes" } " "
                (beside(number.checked_sub(1), "Previous scene"))
                (beside(Some(number + 1), "Next scene"))
            }
            section #scenes aria-label="Scenes" data-open="true" { (PreEscaped(body)) }
        };
        let stated = format!("scene {} of {}", number + 1, names.len());
        let page = page(head, &row.title, &stated, &main);
        files.push((names[number].clone(), page.into_bytes()));
    }
    files
}

fn page(head: &Head<'_>, title: &str, summary: &str, main: &Markup) -> String {
    let dark = head.dark.map(|dark| if dark { "dark" } else { "light" });
    let title = text::line(title);
    let policy = match head.interactive {
        Some(_) => INTERACTIVE_POLICY,
        None => POLICY,
    };
    html! {
        (DOCTYPE)
        html lang="en" data-theme=[dark] {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(policy);
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { bdi { (title) } }
                    p.summary { (summary) "." }
                }
                main {
                    @for note in head.notes { p.small { (text::line(note)) } }
                    (main)
                }
                footer {
                    p {
                        (STANDS_MEANING)
                    }
                    p { "drystone " (env!("CARGO_PKG_VERSION")) }
                }
                script { (PreEscaped(SCRIPT)) }
                @if let Some(interactive) = head.interactive { script { (PreEscaped(interactive)) } }
            }
        }
    }
    .into_string()
}

fn refused(head: &Head<'_>) -> Markup {
    html! {
        @if !head.refused.is_empty() {
            section.refused aria-labelledby="refused" {
                h2 #refused { "Files that are not valid scenes" }
                p { "These files are not in the report. All problems of each file are listed below its name." }
                @for file in head.refused {
                    h3 { bdi { (text::line(&file.name)) } }
                    ul { @for line in file.lines() { li { (line) } } }
                }
            }
        }
    }
}

/// Writes a verdict with its mark: `✓ stands`.
fn verdict(verdict: Verdict) -> Markup {
    html! { span.verdict.(verdict.plain()) { span aria-hidden="true" { (sign(verdict)) } " " (verdict.plain()) } }
}

/// Writes the verdict of a scene, or both verdicts of a comparison, on one line.
fn verdicts(row: &Row) -> Markup {
    html! {
        span.verdicts {
            @if let Some(before) = row.before { (verdict(before)) " → " }
            (verdict(row.verdict))
            @if row.before.is_none() { (row.steps) }
        }
    }
}

/// Writes a path. The browser may break the line after each folder.
fn path(name: &str) -> Markup {
    html! {
        bdi { @for part in name.split_inclusive('/') { (part) wbr; } }
    }
}

fn overview(head: &Head<'_>, link: &dyn Fn(usize) -> String) -> Markup {
    let margins = head.rows.iter().any(|row| !row.headline.is_empty());
    let fails = if head.compares { "what changed" } else { "what fails" };
    html! {
        section.overview aria-labelledby="overview" {
            h2 #overview { "All scenes" }
            div.wide tabindex="0" role="region" aria-label="Table of all scenes" {
                table.all data-sortable="true" {
                    thead {
                        tr {
                            th scope="col" { "picture" }
                            th scope="col" data-sort="text" { "name" }
                            th scope="col" data-sort="text" { "verdict" }
                            @if margins { th scope="col" data-sort="number" { "headline margin" } }
                            th.number scope="col" data-sort="number" { "blocks" }
                            th.number scope="col" data-sort="number" { "largest force in one balance (standing steps)" }
                            th scope="col" data-sort="text" { (fails) }
                        }
                    }
                    tbody {
                        @for row in &head.rows { (line(row, &link(row.number), margins)) }
                    }
                }
            }
        }
    }
}

fn line(row: &Row, link: &str, margins: bool) -> Markup {
    let steps = match row.stand {
        (_, 1) => String::new(),
        (stand, all) => format!(" {stand} of {all} steps stand"),
    };
    html! {
        tr data-verdict=(row.verdict.plain()) {
            td.picture { (thumbnail(&row.thumbnail)) }
            th scope="row" {
                a href=(link) { bdi { (row.title) } }
                span.file { (path(&row.name)) }
            }
            td data-value=(row.verdict.plain()) {
                (verdicts(row))
                @if !steps.is_empty() { span.file { (steps) } }
            }
            @if margins { td data-value=(row.reserve) { (row.margin_words()) } }
            td.number data-value=(row.blocks) { (row.blocks) }
            td.number data-value=(row.largest.unwrap_or(-1.0)) { (row.largest_words()) }
            td.fails { bdi dir="ltr" { (row.fails) } }
        }
    }
}

fn thumbnail(thumbnail: &Thumbnail) -> Markup {
    html! {
        @if !thumbnail.blocks.is_empty() {
            svg.thumbnail viewBox="0 0 96 60" width="96" height="60" aria-hidden="true" focusable="false" {
                @if !thumbnail.ground.is_empty() { path.ground d=(thumbnail.ground) {} }
                path.blocks d=(thumbnail.blocks) {}
            }
        }
    }
}
