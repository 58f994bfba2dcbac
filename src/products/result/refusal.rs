//! Writes the problems of a file that is not a valid scene as a JSON object, in place of a result.

#[cfg(feature = "wasm")]
use super::json::compact;
use super::json::{Json, object, written};
use super::{Layout, Origin};
use crate::mechanics::scene::Problem;
#[cfg(feature = "wasm")]
use crate::sources::import::Remark;

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
    written(&object! { file: file, problems: entries(problems, 0) }, layout, 1)
}

/// Writes problems as one JSON list: the value of `problems` in [`refusal`], on one line without a line feed.
#[cfg(feature = "wasm")]
pub(crate) fn problem_list(problems: &[Problem]) -> String {
    compact(&entries(problems, 0))
}

/// Writes the problems of a drawing as one JSON list, `[{ element, message, hint }]`, on one line without a line
/// feed.
#[cfg(feature = "wasm")]
pub(crate) fn remark_list(remarks: &[Remark]) -> String {
    compact(&Json::list(remarks.iter().map(|remark| {
        object! { element: &remark.element, message: &remark.message, hint: &remark.help }
    })))
}

/// Writes the problems of one scene of a batch as one line that ends with a line feed.
///
/// Line and column numbers refer to the input file, so that an editor can go to the position. If the scene is one
/// line of the input, all its problems are on this line.
pub fn problem_line(origin: &Origin, problems: &[Problem]) -> String {
    let before = origin.line.map_or(0, |line| line - 1);
    let refusal = object! {
        file: origin.file.as_deref(),
        line: origin.line,
        problems: entries(problems, before),
    };
    written(&refusal, Layout::OneLine, 1)
}

/// Makes the JSON entries for the problems of a text. `before` is the number of lines in the file before this text.
fn entries(problems: &[Problem], before: usize) -> Json<'_> {
    let place = |number: usize| (number > 0).then_some(number);
    Json::list(problems.iter().map(|problem| {
        object! {
            code: problem.code.word(),
            path: &problem.path,
            line: Json::or_null(place(problem.line).map(|line| before + line)),
            column: Json::or_null(place(problem.column)),
            message: &problem.message,
            hint: &problem.help,
        }
    }))
}
