//! [`CliError`]: all errors of a command, and their messages.
//!
//! No other file uses the crate `ariadne`, which prints the line of a scene file that contains a problem, with a mark
//! below it. `ariadne` gets only this line, so that a long file takes no more time than a short one.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;

use ariadne::{Color, Config, Label, Report, ReportKind, Source};

use crate::entry::cli::exit_status::ExitStatus;
use crate::entry::cli::page::{Page, broken, seen};
use crate::mechanics::scene::{Code, Problem, SceneError};
use crate::pictures::drawing::style;
use crate::text::{first_of, line};

/// At most this many problems of one file are shown. If there are more, they usually have one cause, which is among
/// the first.
const MAX_SHOWN_PROBLEMS: usize = 30;
/// If a file has more problems of one kind, only the first of them is shown, and the others are counted.
const MAX_ALIKE_PROBLEMS: usize = 3;
/// The largest number of paths that are listed for the other problems of a kind.
const MAX_LISTED_PLACES: usize = 5;
/// A line with more characters, or wider than the terminal, is not shown completely: an excerpt shows the characters
/// around the problem.
const MAX_LINE_CHARACTERS: usize = 160;
/// The width of an excerpt in columns, of which at most a third are before the problem. On a narrow terminal, the
/// excerpt is narrower.
const EXCERPT_COLUMNS: usize = 120;
/// The least width of an excerpt in columns.
const MIN_EXCERPT_COLUMNS: usize = 12;

/// How a command ends: with an exit status, or with all its errors.
pub(crate) type Ended = Result<ExitStatus, Vec<CliError>>;

/// An error that ends the command, or only the work on one scene.
#[derive(Debug)]
pub(crate) enum CliError {
    /// A scene is not valid.
    Scene {
        /// The file's name.
        name: String,
        /// The problems of the scene.
        problems: SceneError,
    },
    /// A style file is not valid.
    Style {
        /// The file's name.
        name: String,
        /// The problems of the style file.
        problems: style::format::StyleProblems,
    },
    /// An input cannot be read.
    NotRead {
        /// The path of the input, or `standard input`.
        what: String,
        /// The reason, mostly from the operating system.
        why: String,
    },
    /// A scene does not have the selected frame; the text is the message.
    NoSuchFrame(String),
    /// A drawing cannot be imported; the page is the message.
    Drawing(Page),
    /// Scenes in a book cannot be drawn. Each entry is a message of one or more lines, whose parts are escaped by
    /// [`line`].
    Book(Vec<String>),
    /// The command line is wrong; the text is the message.
    CommandLine(String),
    /// An output cannot be written.
    NotWritten {
        /// The path of the output, or a description such as `the picture`.
        what: String,
        /// The reason, mostly from the operating system.
        why: String,
    },
}

impl From<String> for CliError {
    fn from(why: String) -> CliError {
        CliError::CommandLine(why)
    }
}

impl From<&str> for CliError {
    fn from(why: &str) -> CliError {
        CliError::CommandLine(why.into())
    }
}

impl From<CliError> for Vec<CliError> {
    fn from(one: CliError) -> Vec<CliError> {
        vec![one]
    }
}

impl CliError {
    /// Returns the error for an input that cannot be read.
    pub(crate) fn not_read(what: impl ToString, why: impl ToString) -> CliError {
        CliError::NotRead { what: what.to_string(), why: why.to_string() }
    }

    /// Returns the error for an output that cannot be written.
    pub(crate) fn not_written(what: impl ToString, why: impl ToString) -> CliError {
        CliError::NotWritten { what: what.to_string(), why: why.to_string() }
    }

    /// Returns the exit status for this error.
    pub(crate) fn ending(&self) -> ExitStatus {
        match self {
            CliError::NotWritten { .. } => ExitStatus::NotWritten,
            CliError::Scene { .. }
            | CliError::Style { .. }
            | CliError::NotRead { .. }
            | CliError::NoSuchFrame(_)
            | CliError::Drawing(_)
            | CliError::Book(_)
            | CliError::CommandLine(_) => ExitStatus::WrongInput,
        }
    }

    /// True if the error is an internal fault of drystone in one scene. The command then still answers the other
    /// scenes.
    pub(crate) fn is_internal_fault(&self) -> bool {
        match self {
            CliError::Scene { problems, .. } => {
                (problems.list.iter()).any(|problem| problem.code == Code::InternalFault)
            }
            _ => false,
        }
    }

    /// Returns the error as problems of one file, for JSON output.
    pub(crate) fn problems(&self) -> Vec<Problem> {
        let alone = |code, message: String, help: &str| vec![Problem::alone(code, line(&message), help)];
        match self {
            CliError::Scene { problems, .. } => problems.list.clone(),
            CliError::NoSuchFrame(what) => alone(Code::NoSuchFrame, what.clone(), "give a smaller number"),
            CliError::NotRead { .. } => {
                alone(Code::NotReadable, self.message(), "check the path and the permissions of the file")
            }
            // The other errors have only a message.
            other => alone(Code::NotReadable, other.message(), ""),
        }
    }

    /// Returns the name of the file with the error; empty for an error of the command line.
    pub(crate) fn file(&self) -> &str {
        match self {
            CliError::Scene { name, .. } | CliError::Style { name, .. } => name,
            CliError::NotRead { what, .. } | CliError::NotWritten { what, .. } => what,
            _ => "",
        }
    }

    /// Returns what is wrong, without advice about the command line.
    pub(crate) fn message(&self) -> String {
        match self {
            CliError::Scene { name, problems } => format!("{name}: {problems}"),
            CliError::Style { name, problems } => format!("{name}: {problems}"),
            CliError::NotRead { what, why } => format!("cannot read {what}: {why}"),
            CliError::NotWritten { what, why } => format!("cannot write {what}: {why}"),
            CliError::Drawing(page) => page.text().to_owned(),
            CliError::Book(problems) => problems.join("\n"),
            CliError::CommandLine(why) | CliError::NoSuchFrame(why) => why.clone(),
        }
    }

    /// Returns the message for people. A quoted line of a scene file is shortened if it does not fit into `width`, the
    /// number of columns of the terminal. `width` is `None` if the output is not a terminal.
    pub(crate) fn page(&self, width: Option<usize>) -> Page {
        let mut page = Page::default();
        match self {
            CliError::Scene { name, problems } => {
                page.block(&all(name, problems.text.as_deref(), &problems.list, width));
                let has_lines = [".ndjson", ".jsonl"].iter().any(|end| name.ends_with(end));
                if has_lines {
                    page.line("for a file with one scene on each line, use: drystone batch FILE");
                }
                if problems.list.iter().any(|problem| problem.place.is_some()) {
                    page.line("drystone render --broken draws the outlines of this scene and marks these problems");
                }
            }
            CliError::Style { name, problems } => {
                for problem in &problems.0 {
                    page.line(&format!("error: {name}: {problem}"));
                }
            }
            CliError::Drawing(page) => return page.clone(),
            CliError::CommandLine(what) | CliError::NoSuchFrame(what) => {
                page.line(&format!("error: {what}"));
                page.literal("\nFor more information, try '--help'.\n");
            }
            CliError::Book(problems) => {
                for (number, problem) in problems.iter().enumerate() {
                    if number > 0 {
                        page.end();
                    }
                    page.words("error: ");
                    page.block(problem);
                }
            }
            CliError::NotRead { .. } | CliError::NotWritten { .. } => {
                page.line(&format!("error: {}", self.message()));
            }
        }
        page
    }
}

/// Returns the values of all results, or all errors if there is at least one error.
pub(crate) fn all_or_errors<T>(results: Vec<Result<T, CliError>>) -> Result<Vec<T>, Vec<CliError>> {
    let mut good = Vec::with_capacity(results.len());
    let mut complaints = Vec::new();
    for result in results {
        match result {
            Ok(value) => good.push(value),
            Err(complaint) => complaints.push(complaint),
        }
    }
    if complaints.is_empty() { Ok(good) } else { Err(complaints) }
}

/// Returns the messages of the first [`MAX_SHOWN_PROBLEMS`] problems of a file, and the number of further problems.
fn all(name: &str, text: Option<&str>, problems: &[Problem], width: Option<usize>) -> String {
    let name = line(name);
    let mut out = String::new();
    let groups = grouped(problems);
    for group in groups.iter().take(MAX_SHOWN_PROBLEMS) {
        let problem = group[0];
        let place = text.zip(problem.span.clone()).and_then(|(text, span)| ProblemLine::new(text, span));
        out += &match place {
            Some(place) if place.is_shown_whole(problem, width) => pointed(&name, problem, &place, width),
            Some(place) => windowed(&name, problem, &place, width),
            None => plain(&name, problem),
        };
        if let [_, next, ..] = group.as_slice() {
            let places = first_of(group[1..].iter().map(|p| p.path.as_str()), MAX_LISTED_PLACES);
            let _ = match group.len() - 1 {
                1 => writeln!(out, "... and one more problem of this kind, at {}", line(&next.path)),
                more => writeln!(out, "... and {more} more problems of this kind, at {}", line(&places)),
            };
        }
    }
    let more: usize = groups.iter().skip(MAX_SHOWN_PROBLEMS).map(Vec::len).sum();
    if more > 0 {
        let _ = writeln!(out, "... and {more} more in {name}");
    }
    out
}

/// Groups problems that probably have one cause: more than [`MAX_ALIKE_PROBLEMS`] problems of one kind, at paths that
/// differ only in indices, with the same remedy. If robots take second blocks, this is one misconception about `release`. The groups are
/// in the order of their first problems.
fn grouped(problems: &[Problem]) -> Vec<Vec<&Problem>> {
    let pattern = |problem: &Problem| -> (Code, String, String) {
        if problem.code == Code::HoldsTwo {
            return (problem.code, String::new(), String::new());
        }
        let path: String = problem.path.split(']').map(|part| part.split('[').next().unwrap_or("")).collect();
        (problem.code, path, problem.help.clone())
    };
    let mut by_pattern: BTreeMap<(Code, String, String), Vec<&Problem>> = BTreeMap::new();
    for problem in problems {
        by_pattern.entry(pattern(problem)).or_default().push(problem);
    }
    let mut groups = Vec::new();
    for problem in problems {
        let key = pattern(problem);
        match by_pattern.get(&key) {
            Some(group) if group.len() <= MAX_ALIKE_PROBLEMS && problem.code != Code::HoldsTwo => {
                groups.push(vec![problem])
            }
            Some(_) => groups.extend(by_pattern.remove(&key)),
            None => {}
        }
    }
    groups
}

/// The line of a problem, and the range of the problem in this line, in characters.
struct ProblemLine<'a> {
    line: &'a str,
    range: Range<usize>,
}

impl<'a> ProblemLine<'a> {
    /// Finds the line in which a byte range of a text begins, and the part of the range in this line. Returns `None` if
    /// the range is not inside the text.
    fn new(text: &'a str, span: Range<usize>) -> Option<ProblemLine<'a>> {
        let before = text.get(..span.start)?;
        let start = before.rfind('\n').map_or(0, |n| n + 1);
        let line = text[start..].lines().next().unwrap_or("");
        let from = text.get(start..span.start)?.chars().count();
        let inside = text.get(span.clone())?.lines().next().unwrap_or("").chars().count();
        let end = line.chars().count();
        Some(ProblemLine { line, range: from.min(end)..(from + inside.max(1)).min(end.max(from + 1)) })
    }

    /// True if the whole line can be shown: it has at most [`MAX_LINE_CHARACTERS`] characters, and fits into `width`
    /// columns with the mark and its label.
    fn is_shown_whole(&self, problem: &Problem, width: Option<usize>) -> bool {
        if self.line.chars().count() > MAX_LINE_CHARACTERS {
            return false;
        }
        let before: String = self.line.chars().take(self.range.start).collect();
        let label = seen(&line(&before)) + ARROW_COLUMNS + seen(&label(problem));
        // `ariadne` draws the arrow to the label from the middle of the marked text.
        let label = label + self.range.len().div_ceil(2);
        let columns = margin(problem) + label.max(seen(&line(self.line)) + 1);
        width.is_none_or(|width| columns <= width)
    }
}

/// The number of columns from the middle of the marked text to its label (`╰──── `), plus one.
const ARROW_COLUMNS: usize = 8;

/// Returns the number of columns before the text of a quoted line. The line number is shown in these columns.
fn margin(problem: &Problem) -> usize {
    problem.line.to_string().len() + 4
}

/// Returns the label below the marked text: the path of the problem in the scene, or `here` if it has no path.
fn label(problem: &Problem) -> String {
    match problem.path.as_str() {
        "" => "here".into(),
        path => line(path),
    }
}

/// Returns the message of a problem, preceded by the path of the problem in the scene if it has one.
fn headline(problem: &Problem) -> String {
    let message = line(&problem.message);
    if problem.path.is_empty() { message } else { format!("{}: {message}", line(&problem.path)) }
}

/// Returns the message of a problem without quoting the line of the file.
fn plain(name: &str, problem: &Problem) -> String {
    let at = if problem.line == 0 { String::new() } else { format!(":{}:{}", problem.line, problem.column) };
    let mut out = format!("error: {name}{at}: {}\n", headline(problem));
    if !problem.help.is_empty() {
        let _ = writeln!(out, "  help: {}", line(&problem.help));
    }
    out
}

/// Returns the message of a problem with the line of the file and a mark below the problem. Empty lines replace the
/// lines of the file before this line, so that `ariadne` shows the right line number.
fn pointed(name: &str, problem: &Problem, place: &ProblemLine, width: Option<usize>) -> String {
    let above = problem.line.saturating_sub(1);
    // Add a space at the end of the line, so that a problem after the last character, such as a missing `}`, can be
    // marked.
    let source = Source::from(format!("{}{} ", "\n".repeat(above), line(place.line)));
    let range = place.range.start + above..place.range.end + above;
    let mut report = Report::build(ReportKind::Error, (name, range.clone()))
        .with_config(Config::default())
        .with_message(line(&problem.message))
        .with_label(Label::new((name, range)).with_message(label(problem)).with_color(Color::Red));
    if !problem.help.is_empty() {
        // Further lines of the help are indented by the width of "Help: ", with which its first line begins.
        let room = width.map(|width| width.saturating_sub(margin(problem) + "Help: ".len()));
        report = report.with_help(broken(&line(&problem.help), room));
    }
    let mut bytes = Vec::new();
    match report.finish().write((name, source), &mut bytes) {
        Ok(()) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(_) => plain(name, problem),
    }
}

/// Returns the message of a problem with a part of the line of the file, for a line that is too long to be shown
/// completely.
fn windowed(name: &str, problem: &Problem, place: &ProblemLine, width: Option<usize>) -> String {
    // Reserve four columns: two spaces before the text, and one `…` at each of its ends.
    let room =
        width.map_or(EXCERPT_COLUMNS, |width| width.saturating_sub(4).clamp(MIN_EXCERPT_COLUMNS, EXCERPT_COLUMNS));
    let text = line(place.line);
    let letters: Vec<char> = text.chars().collect();
    let start = place.range.start.min(letters.len());
    let wide = |c: &char| seen(c.encode_utf8(&mut [0; 4]));
    // Choose which characters are shown: at most a third of the width for text before the problem, and the rest of the
    // width for the text from the problem on.
    let fits = |letters: &mut dyn Iterator<Item = &char>, most: usize| {
        let mut left = most;
        let fit = letters.take_while(|c| {
            let fit = wide(c) <= left;
            left -= wide(c).min(left);
            fit
        });
        fit.count()
    };
    let from = start - fits(&mut letters[..start].iter().rev(), room / 3);
    let to = from + fits(&mut letters[from..].iter(), room);
    let columns = |from: usize, to: usize| letters[from..to].iter().map(wide).sum::<usize>();
    let marks = columns(start, place.range.end.clamp(start, to)).max(1);
    let out = plain(name, problem);
    let (first, help) = out.split_once('\n').unwrap_or((&out, ""));
    let lead = if from > 0 { "…" } else { " " };
    let tail = if to < letters.len() { "…" } else { "" };
    let gap = " ".repeat(columns(from, start) + 1);
    let piece: String = letters[from..to].iter().collect();
    format!("{first}\n  {lead}{piece}{tail}\n  {gap}{}\n{help}", "^".repeat(marks))
}

#[cfg(test)]
mod tests;
