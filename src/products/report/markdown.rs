//! A report as Markdown, its figures as SVG files beside it.

use std::fmt::Write as _;

use super::entry::{Chart, Entry, Grid, Step};
use super::html::slug;
use super::page::{OutputFile, Report, ReportError};
use crate::output::svg::{self, Options, Words};
use crate::text::{self, markdown, markdown_cell};
use crate::wording::verdict::plain;

/// The folder of a report's figures, beside it.
fn folder(stem: &str) -> String {
    format!("{}-figures", slug(stem))
}

/// What stands above the scenes.
pub(super) fn head(report: &Report, summary: &str) -> String {
    let mut out = format!("# {}\n\n{summary}.\n\n", markdown(&report.title));
    for note in &report.notes {
        push(&mut out, &format!("{}\n", markdown(note)));
    }
    if !report.refused.is_empty() {
        out.push_str("## Files that are no scenes\n\n");
        for file in &report.refused {
            push(&mut out, &format!("- **{}**", markdown(&file.name)));
            for line in file.lines() {
                push(&mut out, &format!("  - {}", markdown(&line)));
            }
        }
        out.push('\n');
    }
    if report.pieces.len() > 1 {
        let margins = report.pieces.iter().any(|p| p.row.closest.is_some());
        let mut grid = Grid::new(
            "",
            &[
                "name",
                "verdict",
                "closest margin",
                "#friction used, where it stands",
                "#blocks",
                "#largest force, where it stands",
                if report.compares {
                    "what changed"
                } else {
                    "what fails"
                },
            ],
        );
        for piece in &report.pieces {
            let row = &piece.row;
            let closest = row.closest.as_ref().map_or("–", |c| c.0.as_str());
            let cells = [
                row.title.clone(),
                match row.before {
                    Some(before) => format!("{} → {}", plain(before), plain(row.verdict)),
                    None => plain(row.verdict).to_owned(),
                },
                closest.to_owned(),
                row.friction_words(),
                row.blocks.to_string(),
                row.largest_words(),
                row.fails.clone(),
            ];
            grid.add("", cells);
        }
        if !margins {
            grid.heads.remove(2);
            for line in &mut grid.lines {
                line.cells.remove(2);
            }
        }
        // The names are links to their scenes.
        table(&mut out, &grid, &|place, words| match place {
            (line, 0) => format!("[{words}](#scene-{})", line + 1),
            _ => words,
        });
    }
    out
}

/// A line; a `String` takes every character.
fn push(out: &mut String, line: &str) {
    let _ = writeln!(out, "{line}");
}

/// A scene's part, and its figures.
pub(super) fn section(
    entry: &Entry,
    number: usize,
    stem: &str,
) -> Result<(String, Vec<OutputFile>), ReportError> {
    let mut out = String::new();
    let mut files = Vec::new();
    let row = &entry.row;
    let place = format!("{}/{number:04}-{}", folder(stem), slug(&row.title));
    push(
        &mut out,
        &format!(
            "<a id=\"scene-{number}\"></a>\n\n## {}: {}\n",
            markdown(&row.title),
            match row.before {
                Some(before) => format!("{} → {}", plain(before), plain(row.verdict)),
                None => plain(row.verdict).to_owned(),
            }
        ),
    );
    push(&mut out, &format!("File: {}\n", markdown(&row.name)));
    for remark in &entry.remarks {
        push(&mut out, &format!("{}\n", markdown(remark)));
    }
    for step in &entry.steps {
        self::step(&mut out, &mut files, step, &place)?;
    }
    for (which, chart) in entry.charts.iter().chain(&entry.study).enumerate() {
        self::chart(
            &mut out,
            &mut files,
            chart,
            &format!("{place}-over-{}", which + 1),
        );
    }
    if !entry.commands.is_empty() {
        push(&mut out, "Make it again:\n");
        for (what, command) in &entry.commands {
            push(
                &mut out,
                &format!("- {}: {}", markdown(what), code(command)),
            );
        }
        out.push('\n');
    }
    Ok((out, files))
}

/// Words as code, between more backticks than they hold.
fn code(words: &str) -> String {
    let words = text::line(words);
    let mut fence = "`".to_owned();
    while words.contains(&fence) {
        fence.push('`');
    }
    if fence.len() > 1 {
        format!("{fence} {words} {fence}")
    } else {
        format!("{fence}{words}{fence}")
    }
}

fn step(
    out: &mut String,
    files: &mut Vec<OutputFile>,
    step: &Step,
    place: &str,
) -> Result<(), ReportError> {
    if !step.letter.is_empty() {
        let (letter, title) = (&step.letter, markdown(&step.title));
        push(
            out,
            &format!("### ({letter}) {title}: {}\n", plain(step.verdict)),
        );
    }
    push(out, &format!("{}\n", markdown(&step.sentence)));
    for remark in &step.remarks {
        push(out, &format!("{}\n", markdown(remark)));
    }
    for (number, plate) in step.plates.iter().enumerate() {
        // Letters as outlines: whoever shows the page may have other fonts.
        let options = Options {
            words: Words::Outlines,
            ..Options::default()
        };
        let svg = svg::write_with(&plate.drawing, &options)?;
        let name = format!("{place}{}-{}.svg", dash(&step.letter), number + 1);
        let caption = markdown(&plate.caption);
        push(out, &format!("![{caption}](<{name}>)\n\n*{caption}*\n"));
        files.push((name, svg.into_bytes()));
    }
    if !step.bullets.is_empty() {
        let mut grid = Grid::new("Margins", &["margin", "in words"]);
        for bullet in &step.bullets {
            grid.add("", [bullet.name.clone(), bullet.words.clone()]);
        }
        table(out, &grid, &|_, words| words);
    }
    for grid in &step.grids {
        table(out, grid, &|_, words| words);
    }
    if !step.proof.is_empty() {
        push(out, &format!("{}\n", markdown(&step.proof)));
    }
    for (number, chart) in step.charts.iter().enumerate() {
        let name = format!("{place}{}-chart-{}", dash(&step.letter), number + 1);
        self::chart(out, files, chart, &name);
    }
    Ok(())
}

fn dash(letter: &str) -> String {
    if letter.is_empty() {
        String::new()
    } else {
        format!("-{letter}")
    }
}

fn chart(out: &mut String, files: &mut Vec<OutputFile>, chart: &Chart, name: &str) {
    let caption = markdown(&chart.caption);
    push(out, &format!("![{caption}](<{name}.svg>)\n\n*{caption}*\n"));
    // A file of its own says what it is.
    let svg = chart.document().into_owned();
    files.push((format!("{name}.svg"), svg.into_bytes()));
}

fn table(out: &mut String, grid: &Grid, cell: &dyn Fn((usize, usize), String) -> String) {
    if !grid.caption.is_empty() {
        push(out, &format!("**{}**\n", markdown(&grid.caption)));
    }
    let heads: Vec<String> = grid.heads.iter().map(|h| markdown_cell(&h.0)).collect();
    push(out, &format!("| {} |", heads.join(" | ")));
    let rules: Vec<&str> = grid
        .heads
        .iter()
        .map(|h| if h.1 { "---:" } else { "---" })
        .collect();
    push(out, &format!("|{}|", rules.join("|")));
    for (number, line) in grid.lines.iter().enumerate() {
        let cells = line.cells.iter().enumerate();
        let cells: Vec<String> = cells
            .map(|(i, words)| cell((number, i), markdown_cell(words)))
            .collect();
        push(out, &format!("| {} |", cells.join(" | ")));
    }
    out.push('\n');
}
