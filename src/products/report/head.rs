//! [`Head`]: the part of a report above its scenes. This file also has the errors of the report writers and functions
//! that the writers share.

use super::entry::Row;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::scene::Problem;
use crate::pictures::output::pdf::PdfError;
use crate::pictures::output::svg::OutlineError;
use crate::text;

/// A file to write: its name, with `/` between folders, and its content.
pub type OutputFile = (String, Vec<u8>);

/// The part of a report above its scenes.
pub(super) struct Head<'r> {
    /// The title of the report.
    pub title: &'r str,
    /// The numbers of scenes with each verdict and of invalid files, as a sentence without a full stop.
    pub summary: String,
    /// Further sentences, shown after the summary.
    pub notes: &'r [String],
    /// The files that are not valid scenes.
    pub refused: &'r [Refused],
    /// The rows of the table of all scenes.
    pub rows: Vec<&'r Row>,
    /// Whether each scene is a comparison of two scenes.
    pub compares: bool,
    /// Whether the page has dark colours (`true`) or light colours; `None` to follow the colours of the reader's
    /// system.
    pub dark: Option<bool>,
    /// The script that makes the figures interactive; `None` for a report without interactive figures.
    pub interactive: Option<&'r str>,
}

/// An explanation of the word “stands” in HTML and PDF reports.
pub(super) const STANDS_MEANING: &str = "“Stands” means that a balance of forces exists for rigid blocks at rest, laid dry (no mortar, no cohesion). A balance \
     that exists only by wedging counts. Motion in time is not considered: no impact, no earthquake.";

/// A file that is not a valid scene, with its problems.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The path as given by the user.
    pub name: String,
    /// The problems of the file. A file that cannot be read has one problem without a position.
    pub problems: Vec<Problem>,
}

impl Refused {
    /// Returns one line for each problem, with its position in the file, its message and its remedy.
    pub fn lines(&self) -> Vec<String> {
        let described = self.problems.iter().map(|problem| {
            let place = match (problem.line, problem.path.as_str()) {
                (0, "") => String::new(),
                (0, path) => format!("{path}: "),
                (line, "") => format!("line {line}, column {}: ", problem.column),
                (line, path) => format!("line {line}, column {}, {path}: ", problem.column),
            };
            let help = if problem.help.is_empty() { String::new() } else { format!(" ({})", problem.help) };
            text::line(&format!("{place}{}{help}", problem.message))
        });
        described.collect()
    }
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

impl From<OutlineError> for ReportError {
    fn from(error: OutlineError) -> ReportError {
        ReportError(error.to_string())
    }
}

/// Converts a title to a part of a file name: ASCII letters in lower case and digits, with `-` in place of other
/// characters, at most 40 characters. Returns `scene` if the title has no ASCII letter and no digit.
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
    if slug.is_empty() { "scene".into() } else { slug.into() }
}

/// Returns the mark of a verdict: `✓` for stable, `✗` for unstable, `?` for undecided.
pub(super) fn sign(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "✓",
        Verdict::Unstable => "✗",
        Verdict::Undecided => "?",
    }
}
