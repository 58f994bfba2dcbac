//! A person's table of an analysis: a line per frame, and under it what fails, in words with numbers and units.

use std::fmt::Write;

use clap::builder::styling::{AnsiColor, Style};

use crate::analysis::{Analysis, EffectName, FrameAnalysis, Verdict};
use crate::cli::page::Page;
use crate::report::result::Timing;
use crate::scene::Scene;
use crate::text::heading;
use crate::wording::number::{digits, duration, letter, tenths};
use crate::wording::verdict::plain;
use crate::wording::{failure, margin, proof};

/// What the columns mean, and what a verdict says and what it does not, for under the tables.
pub(crate) const LIMITS: &str = "\
stands    some set of admissible forces balances every block. Rigid blocks,
          laid dry, at rest; a wedged balance counts.
falls     none does, and a motion shows why.
forces    sum of all normal, friction and robot forces
sticking  what would have to be glued to make up for the rest
friction  most of it that is used anywhere
robots    most of a limit that is used
proof     in parts of the forces on each block; of a motion in parts of the
          loads of what moves
";

/// So many failures of a frame are described in words; the figure and the JSON have them all.
const MOST_LISTED: usize = 12;
/// A frame's longer title is cut.
const TITLE: usize = 40;
/// A scene's longer title is cut: a terminal would break the line, and what stands behind the break would look like a row.
const HEADING: usize = 60;

/// The table of one scene.
pub(crate) fn of(name: &str, analysis: &Analysis, timing: Timing) -> Page {
    let scene = &analysis.scene;
    let mut page = Page::default();
    page.styled(Style::new().bold(), name);
    if !scene.title.is_empty() {
        page.words("  ");
        page.words(&heading(&scene.title, HEADING));
    }
    page.end();
    let rows: Vec<[String; 7]> = scene
        .frames
        .iter()
        .zip(&analysis.frames)
        .enumerate()
        .map(|(i, (step, f))| row(label(scene, i, &step.title), f, timing))
        .collect();
    let heads = [
        "frame", "verdict", "forces", "sticking", "friction", "robots", "proof",
    ]
    .map(String::from);
    let width = |column: usize| {
        let cells = rows
            .iter()
            .chain([&heads])
            .map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: [usize; 7] = std::array::from_fn(width);
    let dim = Style::new().dimmed();
    line(&mut page, &heads, &widths, [dim; 7]);
    for (frame, cells) in analysis.frames.iter().zip(&rows) {
        let mut styles = [Style::new(); 7];
        styles[1] = style(frame.verdict);
        line(&mut page, cells, &widths, styles);
        for remark in remarks(scene, frame) {
            page.line(&format!("      {remark}"));
        }
    }
    if let Some(words) = scene.tolerance_words() {
        page.styled(dim, &format!("  {words}"));
        page.end();
    }
    page
}

fn style(verdict: Verdict) -> Style {
    let colour = match verdict {
        Verdict::Stable => AnsiColor::Green,
        Verdict::Unstable => AnsiColor::Red,
        Verdict::Undecided => AnsiColor::Yellow,
    };
    colour.on_default().bold()
}

/// Words to the left, numbers to the right of their columns.
fn line(page: &mut Page, cells: &[String; 7], widths: &[usize; 7], styles: [Style; 7]) {
    for (column, (cell, width)) in cells.iter().zip(widths).enumerate() {
        let gap = " ".repeat(width - cell.chars().count());
        page.words(if column == 0 { "  " } else { "   " });
        if (2..6).contains(&column) {
            page.words(&gap);
        }
        page.styled(styles[column], cell);
        if column < 2 {
            page.words(&gap);
        }
    }
    page.end();
}

/// A frame by its letter, where it needs one, and its title.
fn label(scene: &Scene, number: usize, title: &str) -> String {
    let title = heading(title, TITLE);
    match (scene.frames.len(), title.is_empty()) {
        (1, true) => "all".into(),
        (1, false) => title,
        _ => format!("({}) {title}", letter(number)).trim_end().into(),
    }
}

fn row(label: String, frame: &FrameAnalysis, timing: Timing) -> [String; 7] {
    let friction = frame
        .contacts
        .iter()
        .map(|c| c.friction_used)
        .fold(0.0, f64::max);
    let limit = frame
        .robots
        .iter()
        .map(|r| r.limit_used)
        .fold(0.0, f64::max);
    let mut proof = proof::short(frame.proof);
    if timing == Timing::Included {
        let _ = write!(proof, ", {}", duration(frame.solve.seconds));
    }
    [
        label,
        plain(frame.verdict).into(),
        format!("{} N", digits(frame.total_force)),
        if is_left_out(frame) {
            "unknown".into()
        } else if frame.total_sticking == 0.0 {
            "none".into()
        } else {
            format!("{} N", digits(frame.total_sticking))
        },
        tenths(friction),
        if frame.robots.is_empty() {
            "no robot".into()
        } else {
            tenths(limit)
        },
        proof,
    ]
}

/// Whether a frame falls and what would have to stick was not found out.
fn is_left_out(frame: &FrameAnalysis) -> bool {
    let falls = frame.verdict == Verdict::Unstable;
    falls && frame.failures.is_empty() && frame.unsupported.is_empty()
}

/// What a reader needs to know of a frame beyond its line, a sentence each.
fn remarks(scene: &Scene, frame: &FrameAnalysis) -> Vec<String> {
    let mut remarks: Vec<String> = frame
        .failures
        .iter()
        .take(MOST_LISTED)
        .map(|f| failure::sentence(scene, f))
        .collect();
    if frame.failures.len() > MOST_LISTED {
        remarks.push(format!("and {} more", frame.failures.len() - MOST_LISTED));
    }
    if !frame.unsupported.is_empty() {
        let names: Vec<&str> = frame
            .unsupported
            .iter()
            .take(MOST_LISTED)
            .map(|id| scene.blocks[id.0].id.as_str())
            .collect();
        let more = frame.unsupported.len() - names.len();
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        remarks.push(format!(
            "nothing carries {}{more}: no way from there to the ground or to a robot",
            names.join(", ")
        ));
    }
    if !frame.doubts.is_empty() {
        remarks.push(frame.doubt());
    }
    if frame.only_by_wedging == Some(true) {
        remarks.push("stands only by wedging: nothing that acts on it builds up the forces that would hold it".into());
    }
    let wedging = frame
        .effects
        .iter()
        .find(|e| e.effect == EffectName::Wedging && e.simulated);
    if let Some(effect) = wedging.filter(|_| frame.only_by_wedging != Some(false)) {
        remarks.push(format!("wedging: {}", effect.why));
    }
    if let Some(margins) = &frame.margins {
        remarks.extend(margin::lines(scene, margins));
    }
    remarks.extend(frame.notices.iter().map(|n| format!("note: {n}")));
    remarks
}
