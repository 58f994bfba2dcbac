//! [`Report`]: a report on many scenes, in one of five forms.
//!
//! Each scene becomes an [`Entry`], which is written at once as a [`Piece`] in the requested form. The entry, its figures
//! and its analysis are then dropped. A report on a thousand scenes therefore needs only the memory of its own text, and
//! several threads can write the pieces in any order.

use super::entry::{Entry, Row};
use super::{html, markdown, print};
use crate::analysis::Verdict;
use crate::output::pdf::PdfError;
use crate::result::{Counts, Layout, refusal, report_json};
use crate::scene::Problem;
use crate::text;
use crate::wording::number::counted;

/// The form of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One HTML file that contains everything.
    Html,
    /// An HTML index, and an HTML page for each scene.
    Split,
    /// Markdown, with the figures in files next to it.
    Markdown,
    /// A PDF for print.
    Pdf,
    /// JSON for programs.
    Json,
}

/// A file that is not a valid scene, with its problems.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The path as given by the user.
    pub name: String,
    /// The problems of the scene. A file that cannot be read has one problem without a place.
    pub problems: Vec<Problem>,
}

/// A file to write: its name, with `/` between folders, and its content.
pub type OutputFile = (String, Vec<u8>);

/// The part of a report for one scene.
#[derive(Debug)]
pub struct Piece {
    /// Its row in the table of all scenes.
    pub row: Row,
    body: Body,
}

#[derive(Debug)]
enum Body {
    Text(String),
    Files(String, Vec<OutputFile>),
    Sheets(Vec<print::Page>),
}

/// A report on many scenes.
#[derive(Debug)]
pub struct Report {
    /// The title of the page.
    pub title: String,
    /// The scenes, in the given order.
    pub pieces: Vec<Piece>,
    /// The files that are not valid scenes.
    pub refused: Vec<Refused>,
    /// More sentences for the top of the page.
    pub notes: Vec<String>,
    /// Whether each piece compares two scenes.
    pub compares: bool,
    /// Whether the page is dark (`true`) or light; `None` to follow the reader's system.
    pub dark: Option<bool>,
}

/// An error while writing a report.
#[derive(Debug, thiserror::Error)]
#[error("the report could not be written: {0}")]
pub struct ReportError(String);

impl From<PdfError> for ReportError {
    fn from(error: PdfError) -> ReportError {
        ReportError(error.to_string())
    }
}

impl From<crate::output::svg::OutlineError> for ReportError {
    fn from(error: crate::output::svg::OutlineError) -> ReportError {
        ReportError(error.to_string())
    }
}

impl Piece {
    /// Writes the part of a report for one scene. `number` counts from 1; `stem` begins the names of figure files.
    ///
    /// # Errors
    /// If the text of a figure cannot be laid out.
    pub fn new(entry: &Entry, number: usize, form: Form, stem: &str) -> Result<Piece, ReportError> {
        let body = match form {
            Form::Html | Form::Split => Body::Text(html::section(entry, number)),
            Form::Markdown => {
                let (words, files) = markdown::section(entry, number, stem)?;
                Body::Files(words, files)
            }
            Form::Pdf => Body::Sheets(print::section(entry)),
            Form::Json => Body::Text(json(entry)),
        };
        Ok(Piece {
            row: entry.row.clone(),
            body,
        })
    }
}

/// The result of an entry as JSON. A comparison gives an object with both results and the changes.
fn json(entry: &Entry) -> String {
    match entry.results.as_slice() {
        [one] => one.clone(),
        several => {
            let stated: Vec<String> = entry
                .steps
                .iter()
                .map(|s| crate::result::quoted(&s.sentence))
                .collect();
            format!(
                "{{\"changes\":[{}],\"scenes\":[{}]}}",
                stated.join(","),
                several.join(",")
            )
        }
    }
}

impl Report {
    /// The number of scenes with each verdict.
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

    /// A summary: `12 scenes: 9 stand, 2 fall, 1 is undecided; 1 file is not a valid scene`. For comparisons, it counts the
    /// verdicts that changed and the verdicts of the second scenes.
    pub fn summary(&self) -> String {
        let counts = self.counts();
        let what = if self.compares { "comparison" } else { "scene" };
        let number = self.pieces.len();
        let verb = |n: usize, one: &str, many: &str| match n {
            1 => format!("1 {one}"),
            n => format!("{n} {many}"),
        };
        let mut parts = vec![
            verb(counts.stable, "stands", "stand"),
            verb(counts.unstable, "falls", "fall"),
        ];
        if counts.undecided > 0 {
            parts.push(verb(counts.undecided, "is undecided", "are undecided"));
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
            let refused = verb(
                counts.refused,
                "file is not a valid scene",
                "files are not valid scenes",
            );
            words.push_str(&format!("; {refused}"));
        }
        words
    }

    /// The files of the report, the main file first. `stem` is its name without the extension.
    ///
    /// # Errors
    /// If a PDF cannot be written.
    pub fn files(self, form: Form, stem: &str) -> Result<Vec<OutputFile>, ReportError> {
        let summary = self.summary();
        match form {
            Form::Html => {
                let bodies: Vec<&str> = self.pieces.iter().map(Piece::text).collect();
                let page = html::whole(&self, &summary, &bodies);
                Ok(vec![(format!("{stem}.html"), page.into_bytes())])
            }
            Form::Split => Ok(html::split(&self, &summary)),
            Form::Markdown => {
                let head = markdown::head(&self, &summary);
                let mut text = head;
                let mut files = Vec::new();
                for piece in self.pieces {
                    if let Body::Files(words, made) = piece.body {
                        text.push_str(&words);
                        files.extend(made);
                    }
                }
                files.insert(0, (format!("{stem}.md"), text.into_bytes()));
                Ok(files)
            }
            Form::Pdf => {
                let mut pages = print::head(&self, &summary);
                for piece in self.pieces {
                    if let Body::Sheets(more) = piece.body {
                        pages.extend(more);
                    }
                }
                let bytes = print::written(&mut pages, &self.title, &summary)?;
                Ok(vec![(format!("{stem}.pdf"), bytes)])
            }
            Form::Json => {
                let mut objects: Vec<String> =
                    self.pieces.iter().map(|p| p.text().to_owned()).collect();
                let refused = self.refused.iter();
                objects.extend(refused.map(|r| refusal(&r.name, &r.problems, Layout::OneLine)));
                let list = if self.compares {
                    "comparisons"
                } else {
                    "scenes"
                };
                let json = report_json(self.counts(), list, &objects);
                Ok(vec![(format!("{stem}.json"), json.into_bytes())])
            }
        }
    }
}

impl Piece {
    pub(super) fn text(&self) -> &str {
        match &self.body {
            Body::Text(text) => text,
            Body::Files(text, _) => text,
            Body::Sheets(_) => "",
        }
    }
}

impl Refused {
    /// The problems, one line each: place, message and remedy.
    pub fn lines(&self) -> Vec<String> {
        let described = self.problems.iter().map(|problem| {
            let place = match (problem.line, problem.path.as_str()) {
                (0, "") => String::new(),
                (0, path) => format!("{path}: "),
                (line, "") => format!("line {line}, column {}: ", problem.column),
                (line, path) => format!("line {line}, column {}, {path}: ", problem.column),
            };
            let help = if problem.help.is_empty() {
                String::new()
            } else {
                format!(" ({})", problem.help)
            };
            text::line(&format!("{place}{}{help}", problem.message))
        });
        described.collect()
    }
}
