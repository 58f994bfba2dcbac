//! [`report_json`]: a report as JSON: the number of scenes per verdict, and the result of every scene.

use serde::Serialize;

use crate::text;

/// How the scenes of a report came out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counts {
    /// Scenes of which every step stands.
    pub stable: usize,
    /// Scenes of which some step falls.
    pub unstable: usize,
    /// Scenes of which no step falls and some is undecided.
    pub undecided: usize,
    /// Files that are no scene.
    pub refused: usize,
}

/// Text as a JSON string.
pub fn quoted(words: &str) -> String {
    let string = serde_json::to_string(words).expect("a string always serialises into memory");
    text::json(&string)
}

/// A report as one JSON object that ends with a line feed: the counts, and the JSON objects of the scenes, one per line.
///
/// ```
/// use drystone::result::{Counts, report_json};
/// let json = report_json(Counts { stable: 1, ..Counts::default() }, "scenes", &["{\"scene\":\"a\"}".into()]);
/// assert!(json.contains("\"stable\":1") && json.ends_with("\n]}\n"));
/// ```
pub fn report_json(counts: Counts, list: &str, objects: &[String]) -> String {
    let summary =
        serde_json::to_string(&counts).expect("plain structures always serialise into memory");
    let objects: Vec<&str> = objects.iter().map(|o| o.trim_end()).collect();
    format!(
        "{{\"drystone\":{},\"summary\":{summary},{}:[\n{}\n]}}\n",
        quoted(env!("CARGO_PKG_VERSION")),
        quoted(list),
        objects.join(",\n")
    )
}
