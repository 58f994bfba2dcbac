//! [`report_json`]: writes a report as JSON, with the number of scenes for each verdict and the result of every
//! scene.

use serde::Serialize;

use crate::text;

/// The number of scenes with each verdict in a report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Scenes in which every step stands.
    pub stable: usize,
    /// Scenes in which at least one step falls.
    pub unstable: usize,
    /// Scenes in which no step falls and at least one is undecided.
    pub undecided: usize,
    /// Files that are not valid scenes.
    pub refused: usize,
}

/// Writes text as a JSON string, with its quotation marks.
pub fn quoted(words: &str) -> String {
    let string = serde_json::to_string(words).expect("a string always serialises into memory");
    text::json(&string)
}

/// Writes a report as one JSON object that ends with a line feed. The object has the counts and a list of the scenes.
/// `list` is the key of this list. `objects` has the entries of the list as JSON, one for each scene, and each entry is
/// written on a line of its own.
///
/// ```
/// use drystone::result::{Counts, report_json};
/// let json = report_json(Counts { stable: 1, ..Counts::default() }, "scenes", &["{\"scene\":\"a\"}".into()]);
/// assert!(json.contains("\"stable\":1") && json.ends_with("\n]}\n"));
/// ```
pub fn report_json(counts: Counts, list: &str, objects: &[String]) -> String {
    let summary = serde_json::to_string(&counts).expect("plain structures always serialise into memory");
    let objects: Vec<&str> = objects.iter().map(|o| o.trim_end()).collect();
    format!(
        "{{\"drystone\":{},\"summary\":{summary},{}:[\n{}\n]}}\n",
        quoted(env!("CARGO_PKG_VERSION")),
        quoted(list),
        objects.join(",\n")
    )
}
