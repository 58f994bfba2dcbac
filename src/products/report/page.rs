//! [`Report`]: a report on one or more scenes, in one of five forms: HTML, split HTML, Markdown, PDF or JSON.
//!
//! Each scene becomes an [`Entry`], which is written at once as a [`Piece`] in the requested form. The entry, its
//! figures and its analysis can then be dropped. A report on a thousand scenes therefore needs little more memory than
//! its own text, and several threads can write the pieces in any order.

pub use super::head::{OutputFile, Refused, ReportError};

use super::entry::{Entry, Row};
use super::head::Head;
use super::{html, markdown, print};
use crate::mechanics::analysis::Verdict;
use crate::products::result::{Counts, Layout, refusal, report_json};
use crate::products::wording::number::counted;
use crate::products::wording::verdict::counted as counted_by;

/// The form of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One HTML file that contains everything.
    Html,
    /// An HTML index, and an HTML page for each scene.
    Split,
    /// A Markdown file, with the figures in a folder next to it.
    Markdown,
    /// A PDF for print.
    Pdf,
    /// JSON for programs.
    Json,
}

/// The part of a report for one scene.
#[derive(Debug)]
pub struct Piece {
    /// The row of the scene in the table of all scenes.
    pub row: Row,
    body: PieceContent,
}

/// The content of a [`Piece`] in the form of its report.
#[derive(Debug)]
enum PieceContent {
    Text(String),
    Files(String, Vec<OutputFile>),
    Sheets(Vec<print::Page>),
}

/// A report on one or more scenes.
#[derive(Debug)]
pub struct Report {
    /// The title of the report.
    pub title: String,
    /// The scenes, in the given order.
    pub pieces: Vec<Piece>,
    /// The files that are not valid scenes.
    pub refused: Vec<Refused>,
    /// More sentences for the beginning of the report.
    pub notes: Vec<String>,
    /// Whether each piece compares two scenes.
    pub compares: bool,
    /// Whether HTML pages have dark colours (`true`) or light colours; `None` to follow the colours of the reader's
    /// system.
    pub dark: Option<bool>,
    /// The script that makes the figures of HTML pages interactive: the text of the file `interactive.js`, which
    /// `examples/playground/build.sh` makes. It is inserted without escaping. `None` for figures that are not
    /// interactive.
    pub interactive: Option<String>,
}

impl Piece {
    /// Writes the part of a report for one scene. `number` is the number of the scene, from 1. `stem` is the name of
    /// the report file without its extension. The folder with the figures of a Markdown report is named after `stem`.
    ///
    /// # Errors
    /// If the text of a figure cannot be laid out.
    pub fn new(entry: &Entry, number: usize, form: Form, stem: &str) -> Result<Piece, ReportError> {
        let body = match form {
            Form::Html | Form::Split => PieceContent::Text(html::section(entry, number)),
            Form::Markdown => {
                let (words, files) = markdown::section(entry, number, stem)?;
                PieceContent::Files(words, files)
            }
            Form::Pdf => PieceContent::Sheets(print::section(entry)),
            Form::Json => PieceContent::Text(json(entry)),
        };
        Ok(Piece { row: Row { number, ..entry.row.clone() }, body })
    }
}

/// Returns the result of an entry as JSON. For a comparison, the object has the changes and both results.
fn json(entry: &Entry) -> String {
    match entry.results.as_slice() {
        [one] => one.clone(),
        several => {
            let stated = entry.changes.iter().map(|words| crate::products::result::quoted(words));
            let stated: Vec<String> = stated.collect();
            format!("{{\"changes\":[{}],\"scenes\":[{}]}}", stated.join(","), several.join(","))
        }
    }
}

impl Default for PieceContent {
    fn default() -> PieceContent {
        PieceContent::Text(String::new())
    }
}

impl Report {
    /// Counts the scenes with each verdict, and the files that are not valid scenes.
    pub fn counts(&self) -> Counts {
        let of = |verdict| {
            let rows = self.pieces.iter().map(|p| &p.row);
            rows.filter(|row| row.verdict == verdict).count()
        };
        Counts {
            stable: of(Verdict::Stable),
            unstable: of(Verdict::Unstable),
            undecided: of(Verdict::Undecided),
            refused: self.refused.len(),
        }
    }

    /// Returns a summary: `12 scenes: 9 stand, 2 fall, 1 is undecided; 1 file is not a valid scene`. For comparisons,
    /// the summary counts the verdicts that changed, and the verdicts of the second scenes.
    pub fn summary(&self) -> String {
        let counts = self.counts();
        let what = if self.compares { "comparison" } else { "scene" };
        let number = self.pieces.len();
        let verb = |n: usize, one: &str, many: &str| match n {
            1 => format!("1 {one}"),
            n => format!("{n} {many}"),
        };
        let mut parts =
            vec![counted_by(counts.stable, Verdict::Stable), counted_by(counts.unstable, Verdict::Unstable)];
        if counts.undecided > 0 {
            parts.push(verb(counts.undecided, "is undecided", "are undecided"));
        }
        if number == 1 {
            parts.retain(|part| !part.starts_with('0'));
        }
        let mut words = format!("{}: ", counted(number, what));
        if self.compares {
            let rows = self.pieces.iter().map(|p| &p.row);
            let changed = rows.filter(|r| r.before.is_some_and(|b| b != r.verdict));
            words.push_str(&match changed.count() {
                0 => "no verdict changed; ".to_owned(),
                changed => format!("{} changed; now ", counted(changed, "verdict")),
            });
        }
        words.push_str(&parts.join(", "));
        if counts.refused > 0 {
            let refused = verb(counts.refused, "file is not a valid scene", "files are not valid scenes");
            words.push_str(&format!("; {refused}"));
        }
        words
    }

    /// Returns the content of the part above the scenes.
    fn head(&self) -> Head<'_> {
        Head {
            title: &self.title,
            summary: self.summary(),
            notes: &self.notes,
            refused: &self.refused,
            rows: self.pieces.iter().map(|p| &p.row).collect(),
            compares: self.compares,
            dark: self.dark,
            interactive: self.interactive.as_deref(),
        }
    }

    /// Returns the files of the report, the main file first. `form` must be the form of all pieces. `stem` is the name
    /// of the main file without its extension. [`Form::Split`] does not use `stem`.
    ///
    /// # Errors
    /// If a PDF cannot be written.
    pub fn files(mut self, form: Form, stem: &str) -> Result<Vec<OutputFile>, ReportError> {
        let bodies: Vec<PieceContent> = self.pieces.iter_mut().map(|p| std::mem::take(&mut p.body)).collect();
        let head = self.head();
        let texts = || bodies.iter().map(PieceContent::text).collect::<Vec<_>>();
        match form {
            Form::Html => {
                let page = html::whole(&head, &texts());
                Ok(vec![(format!("{stem}.html"), page.into_bytes())])
            }
            Form::Split => Ok(html::split(&head, &texts())),
            Form::Markdown => {
                let text = markdown::head(&head) + &texts().concat();
                let mut files = vec![(format!("{stem}.md"), text.into_bytes())];
                for body in bodies {
                    if let PieceContent::Files(_, made) = body {
                        files.extend(made);
                    }
                }
                Ok(files)
            }
            Form::Pdf => {
                let scenes = bodies.into_iter().map(|body| match body {
                    PieceContent::Sheets(pages) => pages,
                    _ => Vec::new(),
                });
                let bytes = printed(&head, scenes.collect())?;
                Ok(vec![(format!("{stem}.pdf"), bytes)])
            }
            Form::Json => {
                let mut objects: Vec<String> = texts().into_iter().map(str::to_owned).collect();
                let refused = self.refused.iter();
                objects.extend(refused.map(|r| refusal(&r.name, &r.problems, Layout::OneLine)));
                let list = if self.compares { "comparisons" } else { "scenes" };
                let json = report_json(self.counts(), list, &objects);
                Ok(vec![(format!("{stem}.json"), json.into_bytes())])
            }
        }
    }
}

impl PieceContent {
    /// Returns the text of an HTML, Markdown or JSON piece, or an empty text for PDF pages.
    fn text(&self) -> &str {
        match self {
            PieceContent::Text(text) | PieceContent::Files(text, _) => text,
            PieceContent::Sheets(_) => "",
        }
    }
}

/// Writes a report as PDF. It begins with the summary and the table of contents. Both are left out for a single scene
/// without notes and without invalid files.
fn printed(head: &Head<'_>, scenes: Vec<Vec<print::Page>>) -> Result<Vec<u8>, ReportError> {
    let is_short = scenes.len() == 1 && head.refused.is_empty() && head.notes.is_empty();
    // Count the pages before the scenes. The page numbers in the contents are placeholders here, because they do not
    // change the number of pages.
    let first = if is_short { 0 } else { print::head(head, &vec![999; scenes.len()]).len() };
    // `starts` has the index of the first page of each scene, in the order of the scene numbers. The scenes may have
    // been sorted differently.
    let mut starts = vec![0; scenes.len()];
    let mut next = first;
    for (row, pages) in head.rows.iter().zip(&scenes) {
        if let Some(start) = starts.get_mut(row.number - 1) {
            *start = next;
        }
        next += pages.len();
    }
    let numbers: Vec<usize> = starts.iter().map(|page| page + 1).collect();
    let mut pages = if is_short { Vec::new() } else { print::head(head, &numbers) };
    pages.extend(scenes.into_iter().flatten());
    print::written(&mut pages, head.title, &head.summary, &starts)
}
