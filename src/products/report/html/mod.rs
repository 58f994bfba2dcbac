//! A report as HTML: one file that needs nothing else, no network and, to be read, no script.
//!
//! maud escapes what is put into markup, and what came from files is one harmless line before that; the only markup that
//! is put in as it is are our own SVG writers' figures and charts. Scripts add sorting, filtering, stepping and the marks
//! that follow the mouse. The body of a scene stands in a `noscript`: with scripts it is plain text until somebody opens
//! the scene, so that a page of a thousand scenes opens at once; without scripts the browser reads it as it is.

mod scene;

use maud::{DOCTYPE, Markup, PreEscaped, html};

pub(super) use scene::section;

use super::entry::{Row, Thumbnail};
use super::page::{OutputFile, Report};
use crate::analysis::Verdict;
use crate::text;
use crate::wording::verdict::plain;

const STYLE: &str = include_str!("../../../../assets/report/report.css");
const SCRIPT: &str = include_str!("../../../../assets/report/report.js");

/// Up to so many scenes are open from the beginning.
const OPEN: usize = 12;

/// A page that holds everything.
pub(super) fn whole(report: &Report, summary: &str, bodies: &[&str]) -> String {
    let main = html! {
        (refused(report))
        @if report.pieces.len() > 1 { (overview(report, &|number| format!("#scene-{number}"))) }
        section #scenes aria-label="Scenes" data-open=(bodies.len() <= OPEN) {
            @for body in bodies { (PreEscaped(body)) }
        }
    };
    page(report, &report.title, summary, &main)
}

/// An index and a page for each scene.
pub(super) fn split(report: &Report, summary: &str) -> Vec<OutputFile> {
    let names: Vec<String> = report
        .pieces
        .iter()
        .enumerate()
        .map(|(i, piece)| format!("{:04}-{}.html", i + 1, slug(&piece.row.title)))
        .collect();
    let link = |number: usize| names[number - 1].clone();
    let index = html! {
        (refused(report))
        (overview(report, &link))
    };
    let mut files = vec![(
        "index.html".to_owned(),
        page(report, &report.title, summary, &index).into_bytes(),
    )];
    for (number, piece) in report.pieces.iter().enumerate() {
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
            section #scenes aria-label="Scenes" data-open="true" { (PreEscaped(piece.text())) }
        };
        let stated = format!("scene {} of {}", number + 1, names.len());
        let page = page(report, &piece.row.title, &stated, &main);
        files.push((names[number].clone(), page.into_bytes()));
    }
    files
}

/// A piece of a file's name made of a title.
pub(super) fn slug(title: &str) -> String {
    let mut slug = String::new();
    for c in title.chars() {
        match c.to_ascii_lowercase() {
            c if c.is_ascii_alphanumeric() => slug.push(c),
            _ if !slug.ends_with('-') && !slug.is_empty() => slug.push('-'),
            _ => {}
        }
        if slug.len() >= 40 {
            break;
        }
    }
    let slug = slug.trim_end_matches('-');
    if slug.is_empty() {
        "scene".into()
    } else {
        slug.into()
    }
}

fn page(report: &Report, title: &str, summary: &str, main: &Markup) -> String {
    let dark = report.dark.map(|dark| if dark { "dark" } else { "light" });
    let title = text::line(title);
    html! {
        (DOCTYPE)
        html lang="en" data-theme=[dark] {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { bdi { (title) } }
                    p.summary { (summary) "." }
                }
                main {
                    @for note in &report.notes { p.small { (text::line(note)) } }
                    (main)
                }
                footer {
                    p {
                        "“Stands” says that a balance of forces exists: for rigid blocks, laid dry (no mortar, no cohesion), at "
                        "rest. A balance that lives on wedging counts. Nothing here moves in time: no impact, no earthquake."
                    }
                    p { "drystone " (env!("CARGO_PKG_VERSION")) }
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    }
    .into_string()
}

fn refused(report: &Report) -> Markup {
    html! {
        @if !report.refused.is_empty() {
            section.refused aria-labelledby="refused" {
                h2 #refused { "Files that are no scenes" }
                p { "These are not in the report. Each is listed with everything that is wrong with it." }
                @for file in &report.refused {
                    h3 { bdi { (text::line(&file.name)) } }
                    ul { @for line in file.lines() { li { (line) } } }
                }
            }
        }
    }
}

/// The mark and the word of a verdict.
fn verdict(verdict: Verdict) -> Markup {
    let (class, sign) = match verdict {
        Verdict::Stable => ("stands", "✓"),
        Verdict::Unstable => ("falls", "✗"),
        Verdict::Undecided => ("undecided", "?"),
    };
    html! { span.verdict.(class) { span aria-hidden="true" { (sign) } " " (plain(verdict)) } }
}

/// The verdict, of a comparison both, on one line.
fn verdicts(row: &Row) -> Markup {
    html! {
        span.verdicts {
            @if let Some(before) = row.before { (verdict(before)) " → " }
            (verdict(row.verdict))
        }
    }
}

/// A file's path, which may be broken after a folder before it is broken within a name.
fn path(name: &str) -> Markup {
    html! {
        bdi { @for part in name.split_inclusive('/') { (part) wbr; } }
    }
}

fn overview(report: &Report, link: &dyn Fn(usize) -> String) -> Markup {
    let rows = || report.pieces.iter().map(|p| &p.row);
    let margins = rows().any(|row| row.closest.is_some());
    let fails = if report.compares {
        "what changed"
    } else {
        "what fails"
    };
    html! {
        section.overview aria-labelledby="overview" {
            h2 #overview { "All of them" }
            div.wide tabindex="0" role="region" aria-label="Table of all scenes" {
                table.all data-sortable="true" {
                    thead {
                        tr {
                            th scope="col" { "picture" }
                            th scope="col" data-sort="text" { "name" }
                            th scope="col" data-sort="text" { "verdict" }
                            @if margins { th scope="col" data-sort="number" { "closest margin" } }
                            th.number scope="col" data-sort="number" { "friction used, where it stands" }
                            th.number scope="col" data-sort="number" { "blocks" }
                            th.number scope="col" data-sort="number" { "largest force, where it stands" }
                            th scope="col" data-sort="text" { (fails) }
                        }
                    }
                    tbody {
                        @for (i, row) in rows().enumerate() { (line(row, &link(i + 1), margins)) }
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
        tr data-verdict=(plain(row.verdict)) {
            td.picture { (thumbnail(&row.thumbnail)) }
            th scope="row" {
                a href=(link) { bdi { (row.title) } }
                span.file { (path(&row.name)) }
            }
            td data-value=(plain(row.verdict)) {
                (verdicts(row))
                @if !steps.is_empty() { span.file { (steps) } }
            }
            @if margins {
                @match &row.closest {
                    Some((words, reserve)) => td data-value=(reserve) { (words) },
                    None => td data-value="2" { "–" },
                }
            }
            td.number data-value=(row.friction.unwrap_or(-1.0)) { (row.friction_words()) }
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
