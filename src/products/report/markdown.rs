//! Writes a report as Markdown. The figures are SVG files in a folder next to the report.

use std::fmt::Write as _;

use super::entry::{Badge, Chart, Entry, Figure, Grid, MarginBar, Section, SheetPart, TableCell, overview};
use super::head::{Head, OutputFile, ReportError, sign, slug};
use crate::pictures::output::svg::{self, Options, Words};
use crate::products::wording::margin::Position;
use crate::text::{self, markdown, markdown_cell};

/// The number of characters of a bar.
const BAR_CHARACTERS: usize = 24;

/// Returns the name of the folder with the figures of a report. The folder is next to the report file. `stem` is the
/// name of the report file without its extension.
fn folder(stem: &str) -> String {
    format!("{}-figures", slug(stem))
}

/// Writes the part of a report above its scenes: title, summary, notes, the list of invalid files if there are any, and
/// an overview table if there is more than one scene.
pub(super) fn head(head: &Head<'_>) -> String {
    let mut out = format!("# {}\n\n{}.\n\n", markdown(head.title), head.summary);
    for note in head.notes {
        push(&mut out, &format!("{}\n", markdown(note)));
    }
    if !head.refused.is_empty() {
        out.push_str("## Files that are not valid scenes\n\n");
        for file in head.refused {
            push(&mut out, &format!("- **{}**", markdown(&file.name)));
            for line in file.lines() {
                push(&mut out, &format!("  - {}", markdown(&line)));
            }
        }
        out.push('\n');
    }
    if head.rows.len() > 1 {
        table(&mut out, &overview(&head.rows, head.compares, None));
    }
    out
}

/// Appends a line; writing to a `String` cannot fail.
fn push(out: &mut String, line: &str) {
    let _ = writeln!(out, "{line}");
}

/// Returns the text for a scene, and the files of its figures. `number` is the number of the scene, from 1. `stem` is
/// the name of the report file without its extension.
pub(super) fn section(entry: &Entry, number: usize, stem: &str) -> Result<(String, Vec<OutputFile>), ReportError> {
    let row = &entry.row;
    let mut writer = Writer {
        out: String::new(),
        files: Vec::new(),
        place: format!("{}/{number:04}-{}", folder(stem), slug(&row.title)),
    };
    let title = format!("{}: {}", markdown(&row.title), row.verdict_words());
    writer.line(&format!("<a id=\"scene-{number}\"></a>\n\n## {title}\n"));
    for detail in &entry.details {
        writer.line(&format!("{}\n", markdown(detail)));
    }
    for section in &entry.sections {
        writer.section(section)?;
    }
    let file = markdown(&row.name);
    writer.line(&format!("File: {file}; {}\n", markdown(&entry.origin)));
    if !entry.commands.is_empty() {
        writer.line("Repeat it:\n");
        for (what, command) in &entry.commands {
            writer.line(&format!("- {}: {}", markdown(what), code(command)));
        }
        writer.line("");
    }
    Ok((writer.out, writer.files))
}

/// Writes text as inline code. The fence around it has more backticks than any run of backticks in the text.
fn code(words: &str) -> String {
    let words = text::line(words);
    let mut fence = "`".to_owned();
    while words.contains(&fence) {
        fence.push('`');
    }
    if fence.len() > 1 { format!("{fence} {words} {fence}") } else { format!("{fence}{words}{fence}") }
}

struct Writer {
    out: String,
    files: Vec<OutputFile>,
    /// The prefix of the paths of the figure files: the folder, and the beginning of the file names.
    place: String,
}

impl Writer {
    fn line(&mut self, line: &str) {
        push(&mut self.out, line);
    }

    fn section(&mut self, section: &Section) -> Result<(), ReportError> {
        match (section.letter.as_str(), section.title.as_str()) {
            ("", "") => {}
            ("", title) => self.line(&format!("### {}\n", markdown(title))),
            (letter, title) => {
                let verdict = section.verdict.plain();
                self.line(&format!("### ({letter}) {}: {verdict}\n", markdown(title)));
            }
        }
        self.parts(&section.parts)
    }

    fn parts(&mut self, parts: &[SheetPart]) -> Result<(), ReportError> {
        for part in parts {
            match part {
                SheetPart::Badge(badge) => self.badge(badge),
                SheetPart::Heading(words) => self.line(&format!("#### {}\n", markdown(words))),
                SheetPart::Text(words) | SheetPart::Note(words) => {
                    self.line(&format!("{}\n", markdown(words)));
                }
                SheetPart::Figures(figures) => {
                    for figure in figures {
                        self.figure(figure)?;
                    }
                }
                SheetPart::Table(grid) => table(&mut self.out, grid),
                SheetPart::Columns(columns) => {
                    for column in columns {
                        self.parts(column)?;
                    }
                }
                SheetPart::Charts(charts) => charts.iter().for_each(|chart| self.chart(chart)),
            }
        }
        Ok(())
    }

    fn badge(&mut self, badge: &Badge) {
        let mark = sign(badge.verdict);
        let verdict = badge.verdict.plain();
        let headline = match badge.headline.as_str() {
            "" => String::new(),
            words => format!(" · {}", markdown(words)),
        };
        self.line(&format!("**{mark} {verdict}{headline}**\n"));
        if !badge.sentence.is_empty() {
            self.line(&format!("{}\n", markdown(&badge.sentence)));
        }
    }

    fn file(&mut self, svg: Vec<u8>) -> String {
        let name = format!("{}-{}.svg", self.place, self.files.len() + 1);
        self.files.push((name.clone(), svg));
        name
    }

    fn figure(&mut self, figure: &Figure) -> Result<(), ReportError> {
        // Text is drawn as outlines, because the reader may have other fonts.
        let options = Options { words: Words::Outlines, ..Options::default() };
        let svg = svg::write_with(&figure.drawing, &options)?;
        let name = self.file(svg.into_bytes());
        let caption = markdown(&figure.caption);
        self.line(&format!("![{caption}](<{name}>)\n\n*{caption}*\n"));
        Ok(())
    }

    fn chart(&mut self, chart: &Chart) {
        // A separate SVG file needs the XML namespace.
        let name = self.file(chart.document().into_owned().into_bytes());
        let caption = markdown(&chart.caption);
        self.line(&format!("![{caption}](<{name}>)\n\n*{caption}*\n"));
    }
}

/// Draws a margin as a row of characters. The character `█` covers the values at which the structure stands. The
/// current value is a disc if the structure is known to stand there, a cross if it falls there, and a ring if neither is
/// known. Of several current values, the least is drawn.
fn drawn(bar: &MarginBar) -> String {
    let place = |value: f64| {
        let share = bar.share(value);
        // The cast cannot overflow, because the fraction is between 0 and 1.
        ((share * BAR_CHARACTERS as f64) as usize).min(BAR_CHARACTERS - 1)
    };
    let mut cells = ['─'; BAR_CHARACTERS];
    if let Some((from, to)) = bar.safe {
        cells[place(from)..=place(to)].fill('█');
    }
    if let Some((least, _)) = bar.now {
        cells[place(least)] = match bar.position {
            Position::Inside => '●',
            Position::Outside => '✗',
            Position::Unknown => '○',
        };
    }
    cells.iter().collect()
}

fn cell(cell: &TableCell) -> String {
    if let Some(bar) = &cell.bar {
        return format!("`{}`", drawn(bar));
    }
    let words = markdown_cell(&cell.words);
    match (cell.scene, cell.strong && !words.is_empty()) {
        (Some(scene), _) => format!("[{words}](#scene-{scene})"),
        (None, true) => format!("**{words}**"),
        (None, false) => words,
    }
}

fn table(out: &mut String, grid: &Grid) {
    if grid.lines.is_empty() {
        return;
    }
    // Leave out columns with small pictures, because these pictures are not written as files.
    let pictured = |column: &usize| {
        let mut cells = grid.lines.iter().filter_map(|l| l.cells.get(*column));
        cells.any(|c| c.picture.is_some())
    };
    let columns: Vec<usize> = (0..grid.heads.len()).filter(|c| !pictured(c)).collect();
    if !grid.caption.is_empty() {
        push(out, &format!("**{}**\n", markdown(&grid.caption)));
    }
    let heads = columns.iter().map(|c| markdown_cell(&grid.heads[*c].0));
    push(out, &format!("| {} |", heads.collect::<Vec<_>>().join(" | ")));
    let rules = columns.iter().map(|c| if grid.heads[*c].1 { "---:" } else { "---" });
    push(out, &format!("|{}|", rules.collect::<Vec<_>>().join("|")));
    for line in &grid.lines {
        let cells = columns.iter().filter_map(|c| line.cells.get(*c)).map(cell);
        push(out, &format!("| {} |", cells.collect::<Vec<_>>().join(" | ")));
    }
    out.push('\n');
}
