//! [`Report`]: many scenes on one page, in any of four forms.
//!
//! A scene becomes an [`Entry`], and that at once its [`Piece`] of the page in the form that is wanted; then the entry, its
//! figures and its analysis are gone. So a report of a thousand scenes takes the memory of its own text and no more, and
//! scenes can be made in any order and by many threads.

use super::entry::{Entry, Row};
use super::{html, markdown, print};
use crate::analysis::Verdict;
use crate::output::pdf::PdfError;
use crate::result::{Counts, Layout, refusal, report_json};
use crate::scene::Problem;
use crate::text;
use crate::wording::number::counted;

/// What a report is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One file that holds everything, for a browser.
    Html,
    /// An index and a page for each scene, for a browser.
    Split,
    /// Markdown, with figures beside it.
    Markdown,
    /// For print.
    Pdf,
    /// For other programs.
    Json,
}

/// A file that is no scene, and why.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The file as it was given.
    pub name: String,
    /// What is wrong with it: the problems of a scene, or one without a place where the file cannot be read.
    pub problems: Vec<Problem>,
}

/// A file beside others: its name, with `/` between folders, and what is in it.
pub type OutputFile = (String, Vec<u8>);

/// A scene's part of a report.
#[derive(Debug)]
pub struct Piece {
    /// Its line in the table of all scenes.
    pub row: Row,
    body: Body,
}

#[derive(Debug)]
enum Body {
    Text(String),
    Files(String, Vec<OutputFile>),
    Sheets(Vec<print::Page>),
}

/// Many scenes on one page.
#[derive(Debug)]
pub struct Report {
    /// What stands above all.
    pub title: String,
    /// The scenes, in their order.
    pub pieces: Vec<Piece>,
    /// The files that are none.
    pub refused: Vec<Refused>,
    /// What else is to be reported above the scenes, a sentence each.
    pub notes: Vec<String>,
    /// Whether each piece compares two scenes.
    pub compares: bool,
    /// A theme whose page is dark or light whatever the reader's system says.
    pub dark: Option<bool>,
}

/// A form that could not be written.
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
    /// A scene's part of a report: its number from 1, the file's stem for files of its own.
    ///
    /// # Errors
    /// Where a figure's words cannot be laid out.
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

/// The results of an entry; of a comparison an object of both and what is reported of them.
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
    /// How the scenes came out.
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

    /// `12 scenes: 9 stand, 2 fall, 1 is undecided; 1 file is no scene`; of comparisons how many verdicts changed, and how
    /// the second scenes came out.
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
            let refused = verb(counts.refused, "file is no scene", "files are no scenes");
            words.push_str(&format!("; {refused}"));
        }
        words
    }

    /// The files of the report, the main one first; `stem` is its name without its ending.
    ///
    /// # Errors
    /// Where a PDF cannot be written.
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
    /// The problems, each as one line: where, what, and what to do about it.
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
