//! [`page`]: writes the findings as one HTML file for review.
//!
//! The page shows the expected picture, the difference and the new picture side by side. With a slider or a blink
//! button, a user compares the expected and the new picture in the same place. The page also lists the changes in
//! words and the commands that accept them. All pictures are PNG data in the file itself, so the page loads nothing
//! from the network.

use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::discovery::shown;
use super::layer::Layer;
use super::outcome::{CheckOutcome, Finding, Snapshot};
use crate::text::{line, shell};

const STYLE: &str = include_str!("../../../assets/snapshot/review.css");
const SCRIPT: &str = include_str!("../../../assets/snapshot/review.js");
/// Longer lists of changes of an SVG are collapsed, because the pictures show most of these changes.
const MAX_OPEN_CHANGES: usize = 12;
/// Largest number of changes of one file that the page lists. All further changes are only counted.
const MAX_LISTED_CHANGES: usize = 60;

/// Writes the review page of a check as HTML. `folders` are the folders on the command line, which the commands on
/// the page repeat.
///
/// # Example
/// ```
/// use drystone::snapshot::{CheckOutcome, review::page};
/// let page = page(&CheckOutcome::default(), &["scenes".into()]);
/// assert!(page.contains("Everything matches its references"));
/// ```
pub fn page(report: &CheckOutcome, folders: &[std::path::PathBuf]) -> String {
    let failing: Vec<&Snapshot> = report.failing().collect();
    let places: Vec<String> = folders.iter().map(|f| shell(&shown(f))).collect();
    let places = places.join(" ");
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { "Snapshots" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Snapshots" }
                p.pale { (report.summary()) "." }
                @if report.matches() {
                    p { "Everything matches its references." }
                } @else if !failing.is_empty() {
                    (command(&format!("drystone snapshot {places} --accept"), "Accept all"))
                    nav {
                        @for (number, snapshot) in failing.iter().enumerate() {
                            a href=(format!("#s{number}")) { (line(&snapshot.name)) } " "
                        }
                    }
                }
                @for (number, snapshot) in failing.iter().enumerate() {
                    section id=(format!("s{number}")) {
                        h2 { (line(&snapshot.name)) }
                        @for finding in &snapshot.findings { (described(finding)) }
                        (command(&format!("drystone snapshot {places} --accept --only {}", shell(&snapshot.name)), "Accept this one"))
                    }
                }
                @if !report.faults.is_empty() {
                    section {
                        h2 { "Scenes that could not be checked" }
                        ul {
                            @for (path, words) in report.fault_descriptions() {
                                li { code { (line(&shown(path))) } " " (line(&words)) }
                            }
                        }
                    }
                }
                @if !report.orphans.is_empty() {
                    section {
                        h2 { "Orphaned references" }
                        ul {
                            @for (path, words) in &report.orphans {
                                li { code { (line(&shown(path))) } " " (line(words)) }
                            }
                        }
                    }
                }
                script { (PreEscaped(SCRIPT)) }
            }
        }
    };
    page.into_string()
}

fn command(words: &str, what: &str) -> Markup {
    html! {
        div.command { span { (what) ":" } code { (words) } button type="button" { "Copy" } }
    }
}

fn described(finding: &Finding) -> Markup {
    html! {
        h3 { span.state { (finding.layer.name()) " " (finding.state.name()) } " " (line(&shown(&finding.file))) }
        @if finding.words.len() > MAX_OPEN_CHANGES && finding.layer == Layer::Svg {
            details { summary { (finding.words.len()) " changes" } (words(finding)) }
        } @else {
            (words(finding))
        }
        @if finding.layer == Layer::Pixels { (pictures(finding)) }
    }
}

fn words(finding: &Finding) -> Markup {
    html! {
        ul {
            @for words in finding.words.iter().take(MAX_LISTED_CHANGES) { li { (line(words)) } }
            @if finding.words.len() > MAX_LISTED_CHANGES { li { "… and " (finding.words.len() - MAX_LISTED_CHANGES) " more" } }
        }
    }
}

fn pictures(finding: &Finding) -> Markup {
    let shown = finding.pictures();
    html! {
        div.three {
            @for (what, bytes) in shown {
                @if let Some(bytes) = bytes {
                    figure { (picture(bytes, what, &finding.file)) figcaption { (what) } }
                }
            }
        }
        @if let Some(expected) = shown[0].1 {
            div.onion {
                div.controls {
                    span { "expected" }
                    input type="range" min="0" max="100" value="50" aria-label="blend from the expected picture to the found picture";
                    span { "found" }
                    button type="button" aria-pressed="false" { "Blink" }
                }
                div.stack {
                    (picture(expected, "Expected", &finding.file))
                    (picture(&finding.fresh, "Found", &finding.file))
                }
            }
        }
    }
}

fn picture(png: &[u8], what: &str, file: &Path) -> Markup {
    let source = format!("data:image/png;base64,{}", STANDARD.encode(png));
    let words = format!("{what}: {}", line(&shown(file)));
    html! { img src=(source) alt=(words); }
}
