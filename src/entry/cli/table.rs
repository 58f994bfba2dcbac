//! Writes an analysis as a table for people: a row for each frame, and below it failures, margins and other remarks.

use std::fmt::Write;

use clap::builder::styling::{AnsiColor, Style};

use super::page::{Page, broken, seen};
use crate::mechanics::analysis::{Analysis, EffectName, FrameAnalysis, Options, SolvedFrame, Verdict};
use crate::mechanics::scene::format::Expectation;
use crate::mechanics::scene::{Limits, Scene};
use crate::products::result::Timing;
use crate::products::wording::number::{duration, letter, quantity, tenths};
use crate::products::wording::question::{self, thrust_range};
use crate::products::wording::{answer, failure, margin, verdict};
use crate::text::heading;

/// The words in the tables and in the lines below them, with their meanings.
const MEANINGS: [[&str; 2]; 18] = [
    [
        "stands",
        "some set of admissible forces balances every block. The blocks are rigid, laid dry and at rest; a balance that exists only by wedging counts too.",
    ],
    ["falls", "no set of admissible forces balances every block, and a motion proves it."],
    ["undecided", "it was proved neither that the frame stands nor that it falls; the reason is below the row."],
    ["weight", "the weight of all placed blocks"],
    [
        "margin",
        "how far the frame is from falling, or what it lacks, rounded to the safe side, if this takes little time; --margins computes every margin",
    ],
    [
        "balance",
        "many sets of forces can balance a frame; verdict and margins hold for all of them. The numbers of robots, and of forces with --verbose, belong to one of them, that of least forces; --explain prints the range of the horizontal thrust",
    ],
    [
        "case",
        "a load case: loads and weights with factors. The frame stands only if it stands in all cases; margins hold in all of them.",
    ],
    [
        "vehicle",
        "a structure stands only if it stands without the vehicle and at each of its positions; the factor multiplies the weights of its axles",
    ],
    [
        "movement",
        "how the blocks follow a small movement of a support: the joints that open, per millimetre of it, and the force on the support",
    ],
    [
        "robots",
        "in one balance, the largest ratio of a robot's force or torque to its limit; without limits, the largest force of a robot",
    ],
    ["-", "no value, because it is not known or takes long to compute"],
    ["comes off", "the two bodies separate; the number is the pull that would have to hold them together"],
    ["slides", "the contact exceeds its friction; the number is the force that is missing"],
    ["forces", "with --verbose: the sum of all normal, friction and robot forces of one balance"],
    ["sticking", "with --verbose: the sum of the missing forces, with which the frame would stand"],
    [
        "proof",
        "with --verbose: the error of the balance relative to the forces on a block; or the power of a motion relative to the loads of the moving blocks",
    ],
    [
        "margins",
        "with --margins: the values at which the frame stands, and the current value; the factor on the loads comes first, or otherwise the margin closest to its limit",
    ],
    ["note", "an input that is allowed but rarely intended, and how to silence this note"],
];
/// The indentation of the meanings, and the width of their lines on wide terminals, in columns.
const MEANING_INDENT_AND_WIDTH: [usize; 2] = [10, 68];

/// Returns the words of the tables with their meanings, in lines of at most `width` columns.
pub(crate) fn explained(width: Option<usize>) -> Page {
    let [indent, most] = MEANING_INDENT_AND_WIDTH;
    let most = width.map_or(most, |width| most.min(width.saturating_sub(indent)));
    let mut page = Page::default();
    for [word, meaning] in MEANINGS {
        let gap = " ".repeat(indent);
        for (number, line) in broken(meaning, Some(most)).lines().enumerate() {
            let word = if number == 0 { word } else { "" };
            page.line(&format!("{word}{}{line}", &gap[word.len()..]));
        }
    }
    page
}

/// The largest number of failures of a frame that are described in words; figures and JSON have all.
const MAX_LISTED_FAILURES: usize = 12;
/// Titles of frames with more columns are shortened.
const MAX_FRAME_TITLE: usize = 40;
/// Titles of scenes with more columns are shortened, because a terminal would break their line.
const MAX_SCENE_TITLE: usize = 60;

/// On narrow terminals, titles of frames keep at least this many columns.
const MIN_TITLE: usize = 8;

/// If rows are too wide, titles of frames and margins are first shortened to no less than these numbers of
/// columns. If rows are then still too wide, both are shortened further.
const READABLE_WIDTHS: [usize; 2] = [20, 12];
/// The index of the column with the headline margin.
const MARGIN_COLUMN: usize = 3;

/// The amount of detail in a table.
#[derive(Clone, Debug, Default)]
pub(crate) struct Detail {
    /// Also the sums of forces, the proof and the contact tolerance, and the time if it is included.
    pub full: Option<Timing>,
    /// Also all computed margins.
    pub margins: bool,
    /// Also the range of the horizontal thrust, until the deadline of these options.
    pub ranges: Option<Options>,
}

/// Writes the table of one scene, for a terminal of `width` columns.
///
/// If the rows would be wider than that, titles and names are shortened as far as needed. If that is not enough, every
/// value is written on a separate line. The remarks below the rows may be wider than the terminal; [`Page::fitted`]
/// breaks them.
pub(crate) fn of(name: &str, analysis: &Analysis, detail: &Detail, width: Option<usize>) -> Page {
    let scene = analysis.given();
    let mut page = Page::default();
    page.styled(Style::new().bold(), name);
    let title = heading(&scene.title, MAX_SCENE_TITLE);
    if !title.is_empty() {
        page.words("  ");
        page.words(&title);
    }
    page.end();
    // The title ends with the changes, and a long one is cut.
    if !scene.set.is_empty() && title != scene.title {
        page.line(&format!("  with {}", scene.set.join(", ")));
    }
    let has_robots = analysis.frames.iter().any(|f| !f.robots.is_empty());
    let columns = COLUMN_HEADS.len() - usize::from(!has_robots);
    let heads: Vec<String> = COLUMN_HEADS[..columns].iter().map(|h| (*h).to_owned()).collect();
    let mut rows: Vec<Vec<String>> = analysis
        .each()
        .map(|solved| {
            let mut cells = row(solved, label(scene, solved.number, &solved.frame().title));
            cells.truncate(columns);
            cells
        })
        .collect();
    let fits = width.is_none_or(|width| cut(&mut rows, &heads, width));
    let widths = widths(&rows, &heads);
    let dim = Style::new().dimmed();
    if fits {
        line(&mut page, &heads, &widths, [dim, dim]);
    }
    let has_range = || detail.ranges.is_some_and(|options| !options.is_late());
    let ranges = analysis.of_each(|number| has_range().then(|| thrust_range(analysis, number)).flatten());
    for ((number, frame), cells) in analysis.frames.iter().enumerate().zip(&rows) {
        let styles = [Style::new(), style(frame.verdict)];
        if fits {
            line(&mut page, cells, &widths, styles)
        } else {
            record(&mut page, &heads, cells, styles)
        }
        for remark in remarks(analysis, number, detail, ranges[number].as_deref()) {
            page.line(&format!("      {remark}"));
        }
    }
    let matters = scene.healed.corners > 0 || scene.healed.kept > 0 || detail.full.is_some();
    if let Some(words) = scene.tolerance_words().filter(|_| matters) {
        page.styled(dim, &format!("  {words}"));
        page.end();
    }
    page
}

/// The headings of the columns. The last column is present only if there are robots.
const COLUMN_HEADS: [&str; 5] = ["frame", "verdict", "weight", "margin", "robots"];

fn widths(rows: &[Vec<String>], heads: &[String]) -> Vec<usize> {
    let widest = |column: usize| {
        let cells = rows.iter().map(|row| seen(&row[column]));
        cells.max().unwrap_or(0).max(seen(&heads[column]))
    };
    (0..heads.len()).map(widest).collect()
}

/// Shortens titles of frames and margins so that rows have at most `width` columns; false if this is impossible.
fn cut(rows: &mut [Vec<String>], heads: &[String], width: usize) -> bool {
    let least = [MIN_TITLE.max(seen(&heads[0])), seen(&heads[MARGIN_COLUMN])];
    for (column, least) in
        [(0, READABLE_WIDTHS[0]), (MARGIN_COLUMN, READABLE_WIDTHS[1]), (MARGIN_COLUMN, least[1]), (0, least[0])]
    {
        let widths = widths(rows, heads);
        let beyond = row_width(&widths).saturating_sub(width);
        if beyond == 0 {
            return true;
        }
        let most = widths[column].saturating_sub(beyond).max(least);
        for row in rows.iter_mut() {
            row[column] = shortened(&row[column], most);
        }
    }
    row_width(&widths(rows, heads)) <= width
}

fn style(verdict: Verdict) -> Style {
    let colour = match verdict {
        Verdict::Stable => AnsiColor::Green,
        Verdict::Unstable => AnsiColor::Red,
        Verdict::Undecided => AnsiColor::Yellow,
    };
    colour.on_default().bold()
}

/// The gaps before the first column, and before every other column.
const COLUMN_GAPS: [&str; 2] = ["  ", "  "];

/// Returns the width of a row with cells of these widths, in columns of the terminal.
fn row_width(widths: &[usize]) -> usize {
    let gaps = COLUMN_GAPS[0].len() + COLUMN_GAPS[1].len() * (widths.len() - 1);
    widths.iter().sum::<usize>() + gaps
}

/// Writes the cells of a row. Words are left-aligned, and numbers are right-aligned. The second style is for the
/// verdict, the first for all other cells.
fn line(page: &mut Page, cells: &[String], widths: &[usize], styles: [Style; 2]) {
    for (column, (cell, width)) in cells.iter().zip(widths).enumerate() {
        let gap = " ".repeat(width.saturating_sub(seen(cell)));
        let is_words = matches!(column, 0 | 1 | MARGIN_COLUMN);
        page.words(COLUMN_GAPS[usize::from(column > 0)]);
        if !is_words {
            page.words(&gap);
        }
        page.styled(styles[usize::from(column == 1)], cell);
        if is_words && column + 1 < cells.len() {
            page.words(&gap);
        }
    }
    page.end();
}

/// Writes the cells of a row on separate lines: first the frame, then each value after the name of its column.
fn record(page: &mut Page, heads: &[String], cells: &[String], styles: [Style; 2]) {
    page.line(&format!("  {}", cells[0]));
    let widest = heads.iter().map(|head| seen(head)).max().unwrap_or(0);
    for (column, (head, cell)) in heads.iter().zip(cells).enumerate().skip(1) {
        page.words("      ");
        page.styled(Style::new().dimmed(), head);
        page.words(&" ".repeat(widest - seen(head) + 2));
        page.styled(styles[usize::from(column == 1)], cell);
        page.end();
    }
}

/// Shortens text to at most `most` columns. The character `…` replaces the rest.
fn shortened(words: &str, most: usize) -> String {
    if seen(words) <= most {
        return words.into();
    }
    let mut short = String::new();
    for c in words.chars() {
        short.push(c);
        if seen(&short) >= most {
            short.pop();
            break;
        }
    }
    short + "…"
}

/// Returns the name of a frame: its title, with its letter if there are several frames, or `all` for a single frame
/// without a title.
fn label(scene: &Scene, number: usize, title: &str) -> String {
    let title = heading(title, MAX_FRAME_TITLE);
    match (scene.frames.len(), title.is_empty()) {
        (1, true) => "all".into(),
        (1, false) => title,
        _ => format!("({}) {title}", letter(number)).trim_end().into(),
    }
}

/// True if a robot has no limit of which it could use a part.
fn is_free(limits: &Limits) -> bool {
    limits.fx.is_infinite() && limits.fy.is_infinite() && (limits.torque.is_infinite() || limits.torque == 0.0)
}

/// Returns the cells of the row of a frame, in the order of [`COLUMN_HEADS`].
fn row(solved: SolvedFrame<'_>, label: String) -> Vec<String> {
    let SolvedFrame { scene, found: frame, .. } = solved;
    // The forces of a frame that falls are balanced only together with the missing forces, and the forces of an
    // undecided frame are not proved. So they are not shown.
    let stands = frame.verdict == Verdict::Stable;
    let margin = margin::governing(solved).words.into_iter().next();
    let robots = match frame.robots.as_slice() {
        _ if !stands => "-".into(),
        [] => "none".into(),
        // Without a limit, the force says how strong the robot must be.
        robots if robots.iter().all(|r| is_free(&scene.robots[r.robot.0].limits)) => {
            let most = robots.iter().map(|robot| robot.force.norm()).fold(0.0, f64::max);
            quantity(most, scene.units.force())
        }
        robots => tenths(robots.iter().map(|r| r.limit_used).fold(0.0, f64::max)),
    };
    let weight = quantity(frame.weight, scene.units.force());
    vec![label, frame.verdict.plain().into(), weight, margin.unwrap_or_else(|| "-".into()), robots]
}

/// Returns a line with the sum of all forces, the sum of the missing forces, the proof and the time.
fn sums(solved: SolvedFrame<'_>, timing: Timing) -> String {
    let SolvedFrame { scene, found: frame, .. } = solved;
    let sticking = match (is_left_out(frame), frame.total_sticking == 0.0) {
        (true, _) => "unknown".into(),
        (_, true) => "none".into(),
        _ => quantity(frame.total_sticking, scene.units.force()),
    };
    let mut words = format!(
        "forces {}, sticking {sticking}; proof: {}",
        quantity(frame.total_force, scene.units.force()),
        verdict::proof_in_short(frame.proof)
    );
    if timing == Timing::Included {
        let _ = write!(words, ", {}", duration(frame.solve.seconds));
    }
    words
}

/// True if a frame falls but its missing forces were not computed.
fn is_left_out(frame: &FrameAnalysis) -> bool {
    let falls = frame.verdict == Verdict::Unstable;
    falls && frame.failures.is_empty() && frame.unsupported.is_empty()
}

/// Returns the remarks below the row of a frame, with the range of its thrust. Each remark is printed on a separate line.
fn remarks(analysis: &Analysis, number: usize, detail: &Detail, range: Option<&str>) -> Vec<String> {
    let solved @ SolvedFrame { scene, found: frame, .. } = analysis.at(number);
    let state = &scene.frames[number];
    let mut remarks = Vec::new();
    if let Some(timing) = detail.full {
        remarks.push(sums(solved, timing));
    }
    remarks.extend(range.map(str::to_owned));
    remarks.extend(match (state.expected, frame.verdict) {
        (Some(Expectation::Unstable), Verdict::Unstable) => Some("falls, as expected".to_owned()),
        (Some(Expectation::Unstable), Verdict::Stable) => Some("stands, but its `expect` says unstable".to_owned()),
        (Some(Expectation::Stable), Verdict::Unstable) => Some("falls, but its `expect` says stable".to_owned()),
        _ => None,
    });
    let failures: Vec<String> =
        frame.failures.iter().take(MAX_LISTED_FAILURES).map(|f| failure::sentence(scene, f)).collect();
    remarks.extend(failures);
    if frame.failures.len() > MAX_LISTED_FAILURES {
        remarks.push(format!("and {} more", frame.failures.len() - MAX_LISTED_FAILURES));
    }
    remarks.extend(failure::unsupported(solved, MAX_LISTED_FAILURES));
    if !frame.doubts.is_empty() {
        remarks.push(frame.doubt());
    }
    if frame.only_by_wedging == Some(true) {
        remarks.push("stands only by wedging: its loads alone do not build up the forces that hold it".into());
    }
    let wedging = frame.effects.iter().find(|e| e.effect == EffectName::Wedging && e.simulated);
    if let Some(effect) = wedging.filter(|_| frame.only_by_wedging != Some(false)) {
        remarks.push(format!("wedging: {}", effect.why));
    }
    remarks.extend(question::case_lines(frame));
    if detail.margins {
        remarks.extend(margin::lines(solved));
    }
    remarks.extend(answer::sentences(solved).iter().map(|(name, words)| format!("{name}: {words}")));
    let helped = frame.removable.iter().flat_map(|rows| question::removable_rows(scene, rows));
    let helped = helped.filter(|[_, may, _]| may.starts_with("while")).take(MAX_LISTED_FAILURES);
    remarks.extend(helped.map(|[block, may, _]| format!("removable: {block} {may}")));
    remarks.extend(frame.notices.iter().map(|n| format!("note: {n}")));
    remarks
}

#[cfg(test)]
mod tests;
