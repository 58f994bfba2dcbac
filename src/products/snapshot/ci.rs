//! Writes findings for other programs: JUnit XML, annotations that GitHub shows next to the code, and JSON.

use serde_json::{Value, json};

use super::discovery::shown;
use super::outcome::{CheckOutcome, Finding, Snapshot};
use crate::products::result::{self, Layout};
use crate::text::{self, github, github_property, xml};

/// Writes the findings as JUnit XML, with one test case for each snapshot, each orphaned reference, and each scene
/// that could not be checked. The XML contains no times, so that equal findings give equal bytes.
pub fn junit(report: &CheckOutcome) -> String {
    let mut cases = Vec::new();
    for snapshot in &report.snapshots {
        cases.push(case(&snapshot.name, &snapshot.lines()));
    }
    for (path, words) in report.others() {
        cases.push(case(&shown(path), &[words]));
    }
    let failures = report.failing().count() + report.others().count();
    let counts = format!("tests=\"{}\" failures=\"{failures}\"", cases.len());
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {counts}>\n<testsuite name=\"drystone snapshot\" {counts}>\n\
         {}</testsuite>\n</testsuites>\n",
        cases.concat()
    )
}

fn case(name: &str, lines: &[String]) -> String {
    let (folder, short) = name.rsplit_once('/').unwrap_or(("", name));
    let head = format!("<testcase classname=\"{}\" name=\"{}\"", xml(folder), xml(short));
    let Some(first) = lines.first() else {
        return format!("{head}/>\n");
    };
    let all: Vec<String> = lines.iter().map(|line| xml(line)).collect();
    format!("{head}>\n<failure message=\"{}\">{}</failure>\n</testcase>\n", xml(first.trim()), all.join("\n"))
}

/// Returns the findings as GitHub annotations, such as `::error file=scenes/arch.json,title=…::…`. There is one
/// annotation for each snapshot that does not match, each orphaned reference, and each scene that could not be checked. GitHub shows an annotation at its file only if the path of the file starts at the root of the repository.
pub fn annotations(report: &CheckOutcome) -> Vec<String> {
    let failing = report.failing().map(annotation);
    let others = report.others();
    let others = others.map(|(path, words)| error(&shown(path), "drystone snapshot", &words));
    failing.chain(others).collect()
}

fn annotation(snapshot: &Snapshot) -> String {
    let file = snapshot.scene.as_deref().map_or_else(|| snapshot.name.clone(), shown);
    error(&file, &format!("drystone snapshot {}", snapshot.name), &snapshot.lines().join("\n"))
}

fn error(file: &str, title: &str, words: &str) -> String {
    let (file, title) = (github_property(file), github_property(title));
    format!("::error file={file},title={title}::{}", github(words))
}

/// Returns the outcome as JSON: a summary, all snapshots with the references that do not match, orphaned references,
/// and scenes that could not be checked. `accepted` and `pruned` list the references that were written and deleted.
///
/// # Example
/// ```
/// use drystone::snapshot::{CheckOutcome, ci};
/// let outcome: serde_json::Value = serde_json::from_str(&ci::json(&CheckOutcome::default()))?;
/// assert_eq!(outcome["matches"], true);
/// # Ok::<(), serde_json::Error>(())
/// ```
pub fn json(report: &CheckOutcome) -> String {
    let finding = |f: &Finding| json!({ "layer": f.layer.name(), "file": shown(&f.file), "state": f.state.name(), "changes": f.words });
    let snapshot = |s: &Snapshot| {
        let findings: Vec<Value> = s.findings.iter().map(finding).collect();
        json!({ "name": s.name, "scene": s.scene.as_deref().map(shown), "matches": s.matches(), "findings": findings, "notes": s.notes })
    };
    let snapshots: Vec<Value> = report.snapshots.iter().map(snapshot).collect();
    let orphans = report.orphans.iter().map(|(path, reason)| json!({ "file": shown(path), "reason": reason }));
    let refused = report.faults.iter().map(|(path, fault)| {
        let text = result::refusal(&shown(path), &fault.list, Layout::OneLine);
        serde_json::from_str(&text).unwrap_or(Value::Null)
    });
    let files = |paths: &[std::path::PathBuf]| paths.iter().map(|path| shown(path)).collect::<Vec<_>>();
    let outcome = json!({
        "summary": report.summary(),
        "matches": report.matches(),
        "snapshots": snapshots,
        "orphans": orphans.collect::<Vec<_>>(),
        "refused": refused.collect::<Vec<Value>>(),
        "accepted": files(&report.accepted),
        "pruned": files(&report.pruned),
    });
    text::json(&format!("{outcome:#}\n")).into_owned()
}
