//! [`markdown`]: writes the findings as Markdown, for a comment on a pull request or the summary of a job.

use std::fmt::Write as _;

use super::discovery::shown;
use super::layer::Layer;
use super::outcome::{CheckOutcome, Finding, MAX_LISTED_CHANGES};
use crate::text::{and_more, markdown_cell};

/// Largest number of snapshots that are described. All further snapshots are only counted, because a comment on GitHub
/// has at most 65 536 characters.
const MAX_SNAPSHOTS: usize = 20;

/// Writes the findings as Markdown, those with changed verdicts first. Each snapshot has a table of the changes in its
/// first layer that differs, and its old and new pictures with their difference. Also returns the names and contents of
/// the pictures, whose paths in the text begin with `folder`.
///
/// # Example
/// ```
/// use drystone::snapshot::{CheckOutcome, summary::markdown};
/// let (text, pictures) = markdown(&CheckOutcome::default(), "pictures");
/// assert!(text.starts_with("### Snapshots\n\n0 snapshots") && pictures.is_empty());
/// ```
pub fn markdown(report: &CheckOutcome, folder: &str) -> (String, Vec<(String, Vec<u8>)>) {
    let mut out = format!("### Snapshots\n\n{}.\n", report.summary());
    let mut pictures = Vec::new();
    for (path, words) in report.others() {
        let _ = write!(out, "\n- **{}**: {}\n", markdown_cell(&shown(path)), markdown_cell(&words));
    }
    let failing = report.failing_by_importance();
    for snapshot in failing.iter().take(MAX_SNAPSHOTS) {
        let _ = write!(out, "\n#### {}\n\n| what | change |\n|---|---|\n", markdown_cell(&snapshot.name));
        let first = snapshot.findings.iter().map(|finding| finding.layer).min();
        let changes = snapshot.findings.iter().filter(|f| Some(f.layer) == first);
        let changes: Vec<(&Finding, &String)> = changes.flat_map(|f| f.words.iter().map(move |w| (f, w))).collect();
        for (finding, words) in changes.iter().take(MAX_LISTED_CHANGES) {
            // Titles and values may contain a colon, and begin with a quotation mark or follow an arrow.
            let end = words.find(['"', '→']).unwrap_or(words.len());
            let place = words[..end].rfind(": ");
            let (what, change) =
                place.map_or((finding.layer.name(), &words[..]), |at| (&words[..at], &words[at + 2..]));
            let _ = writeln!(out, "| {} | {} |", markdown_cell(what), markdown_cell(change));
        }
        if changes.len() > MAX_LISTED_CHANGES {
            let _ = writeln!(out, "| | …{} |", and_more(changes.len() - MAX_LISTED_CHANGES));
        }
        let drawn: Vec<&Finding> = snapshot.findings.iter().filter(|f| f.layer == Layer::Pixels).collect();
        if !drawn.is_empty() {
            out.push_str("\n| old | new | difference |\n|---|---|---|\n");
        }
        for finding in drawn {
            let [old, difference, new] = finding.pictures();
            let file = markdown_cell(&shown(&finding.file));
            for (what, bytes) in [old, new, difference] {
                let Some(bytes) = bytes else {
                    out.push_str("| – ");
                    continue;
                };
                let name = format!("{}.png", pictures.len() + 1);
                let _ = write!(out, "| ![{what}: {file}](<{folder}/{name}>) ");
                pictures.push((name, bytes.to_vec()));
            }
            out.push_str("|\n");
        }
    }
    if failing.len() > MAX_SNAPSHOTS {
        let _ = write!(out, "\n…{} that differ.\n", and_more(failing.len() - MAX_SNAPSHOTS));
    }
    (out, pictures)
}
