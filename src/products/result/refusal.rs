//! Writes the problems of a file that is not a valid scene as a JSON object, in place of a result.

use serde::Serialize;

use super::{Layout, Origin};
use crate::mechanics::scene::Problem;
use crate::mechanics::scene::format::Lines;
#[cfg(feature = "wasm")]
use crate::sources::import::Remark;
use crate::text;

#[derive(Serialize)]
struct Refusal<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    problems: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Entry<'a> {
    code: &'static str,
    path: &'a str,
    line: Option<usize>,
    column: Option<usize>,
    message: &'a str,
    hint: &'a str,
}

/// Writes the problems of a file as one JSON object: `{ "file", "problems": [{ code, path, line, column, message,
/// hint }] }`.
///
/// Lines and columns count from 1; columns count characters. Both are `null` if the problem has no position in a
/// text.
///
/// # Example
/// ```
/// use drystone::result::{Layout, refusal};
/// use drystone::scene::Scene;
///
/// let problems = Scene::from_json("{ }").unwrap_err();
/// let json = refusal("empty.json", &problems.list, Layout::OneLine);
/// assert!(json.starts_with(r#"{"file":"empty.json","problems":[{"code":"missing_key","path":"drystone","line":1,"#));
/// ```
pub fn refusal(file: &str, problems: &[Problem], layout: Layout) -> String {
    written(&Refusal { file: Some(file), line: None, problems: entries(problems, 0) }, layout)
}

/// Writes problems as one JSON list: the value of `problems` in [`refusal`], on one line without a line feed.
#[cfg(feature = "wasm")]
pub(crate) fn problem_list(problems: &[Problem]) -> String {
    listed(&entries(problems, 0))
}

/// Writes the problems of a drawing as one JSON list, `[{ element, message, hint }]`, on one line without a line
/// feed.
#[cfg(feature = "wasm")]
pub(crate) fn remark_list(remarks: &[Remark]) -> String {
    let entries = remarks.iter().map(|remark| DrawingEntry {
        element: &remark.element,
        message: &remark.message,
        hint: &remark.help,
    });
    listed(&entries.collect::<Vec<_>>())
}

#[cfg(feature = "wasm")]
#[derive(Serialize)]
struct DrawingEntry<'a> {
    element: &'a str,
    message: &'a str,
    hint: &'a str,
}

#[cfg(feature = "wasm")]
fn listed<T: Serialize>(entries: &[T]) -> String {
    let json = serde_json::to_string(entries);
    text::json(&json.expect("plain structures with text keys always serialise into memory"))
}

/// Writes the problems of one scene of a batch as one line that ends with a line feed.
///
/// Line and column numbers refer to the input file, so that an editor can go to the position. If the scene is one
/// line of the input, all its problems are on this line.
pub fn problem_line(origin: &Origin, problems: &[Problem]) -> String {
    let before = origin.line.map_or(0, |line| line - 1);
    written(
        &Refusal { file: origin.file.as_deref(), line: origin.line, problems: entries(problems, before) },
        Layout::OneLine,
    )
}

/// Makes the JSON entries for the problems of a text. `before` is the number of lines in the file before this text.
fn entries(problems: &[Problem], before: usize) -> Vec<Entry<'_>> {
    let place = |number: usize| (number > 0).then_some(number);
    problems
        .iter()
        .map(|problem| Entry {
            code: problem.code.word(),
            path: &problem.path,
            line: place(problem.line).map(|line| before + line),
            column: place(problem.column),
            message: &problem.message,
            hint: &problem.help,
        })
        .collect()
}

fn written(refusal: &Refusal<'_>, layout: Layout) -> String {
    let mut bytes = Vec::new();
    let written = match layout {
        Layout::Lines => refusal.serialize(&mut serde_json::Serializer::with_formatter(&mut bytes, Lines::new(1))),
        Layout::OneLine => serde_json::to_writer(&mut bytes, refusal),
    };
    written.expect("plain structures with text keys always serialise into memory");
    bytes.push(b'\n');
    text::json(&String::from_utf8(bytes).expect("serde_json writes UTF-8"))
}
