//! A person's table of an analysis: a line per frame, and under it what fails, in words with numbers and units.

use std::fmt::Write;

use clap::builder::styling::{AnsiColor, Style};

use crate::analysis::{Analysis, EffectName, FrameAnalysis, Verdict};
use crate::cli::page::{Page, broken, seen};
use crate::result::Timing;
use crate::scene::Scene;
use crate::text::heading;
use crate::wording::number::{digits, duration, letter, tenths};
use crate::wording::verdict::plain;
use crate::wording::{failure, margin, proof};

/// What the columns mean, and what a verdict says and what it does not, for under the tables.
const LIMITS: [[&str; 2]; 8] = [
    [
        "stands",
        "some set of admissible forces balances every block. Rigid blocks, laid dry, at rest; a wedged balance counts.",
    ],
    ["falls", "none does, and a motion shows why."],
    ["forces", "sum of all normal, friction and robot forces"],
    [
        "sticking",
        "what would have to be glued to make up for the rest",
    ],
    ["friction", "most of it that is used anywhere"],
    ["robots", "most of a limit that is used"],
    [
        "proof",
        "in parts of the forces on each block; of a motion in parts of the loads of what moves",
    ],
    [
        "margins",
        "at which values it stands, then the present one; first the factor on the loads, else the margin nearest to its end",
    ],
];
/// Before the meanings, and in how many columns these are broken into lines on wide terminals.
const MEANING: [usize; 2] = [10, 68];

/// The words of the table with their meanings, for a terminal of `width` columns.
pub(crate) fn explained(width: Option<usize>) -> Page {
    let [indent, most] = MEANING;
    let most = width.map_or(most, |width| most.min(width.saturating_sub(indent)));
    let mut page = Page::default();
    for [word, meaning] in LIMITS {
        let gap = " ".repeat(indent);
        for (number, line) in broken(meaning, Some(most)).lines().enumerate() {
            let word = if number == 0 { word } else { "" };
            page.line(&format!("{word}{}{line}", &gap[word.len()..]));
        }
    }
    page
}

/// So many failures of a frame are described in words; the figure and the JSON have them all.
const MOST_LISTED: usize = 12;
/// A frame's longer title is cut.
const TITLE: usize = 40;
/// A scene's longer title is cut: a terminal would break the line, and what stands behind the break would look like a row.
const HEADING: usize = 60;

/// A narrow terminal cuts titles of frames to no less.
const SHORTEST: usize = 8;

/// The table of one scene, for a terminal of `width` columns.
///
/// Where the rows would be wider, proofs stand below them, and titles are cut as far as it takes; where that is not enough,
/// every value has a line of its own. What is said below the rows may be wider than the terminal: [`Page::fitted`] breaks it.
pub(crate) fn of(name: &str, analysis: &Analysis, timing: Timing, width: Option<usize>) -> Page {
    let scene = &analysis.scene;
    let mut page = Page::default();
    page.styled(Style::new().bold(), name);
    if !scene.title.is_empty() {
        page.words("  ");
        page.words(&heading(&scene.title, HEADING));
    }
    page.end();
    let mut rows: Vec<[String; 7]> = scene
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
    let widest = |rows: &[[String; 7]], column: usize| {
        let cells = rows.iter().chain([&heads]).map(|row| seen(&row[column]));
        cells.max().unwrap_or(0)
    };
    let mut widths: [usize; 7] = std::array::from_fn(|column| widest(&rows, column));
    let mut columns = widths.len();
    let least: [usize; 7] = std::array::from_fn(|column| match column {
        0 => widths[0].min(SHORTEST),
        _ => widths[column],
    });
    let is_narrow = width.is_some_and(|width| taken(&least[..columns - 1]) > width);
    if let Some(width) = width.filter(|width| !is_narrow && taken(&widths) > *width) {
        columns -= 1;
        let beyond = taken(&widths[..columns]).saturating_sub(width);
        let most = widths[0].saturating_sub(beyond).max(SHORTEST);
        for row in &mut rows {
            row[0] = shortened(&row[0], most);
        }
        widths[0] = widest(&rows, 0);
    }
    let dim = Style::new().dimmed();
    if !is_narrow {
        line(&mut page, &heads, &widths[..columns], [dim; 7]);
    }
    for (frame, cells) in analysis.frames.iter().zip(&rows) {
        let mut styles = [Style::new(); 7];
        styles[1] = style(frame.verdict);
        if is_narrow {
            record(&mut page, &heads, cells, styles);
        } else {
            line(&mut page, cells, &widths[..columns], styles);
        }
        if columns < cells.len() {
            page.line(&format!("      proof: {}", cells[columns]));
        }
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

/// Before the first column, and before every other.
const GAPS: [&str; 2] = ["  ", "   "];

/// How many columns of a terminal a row takes whose cells are so wide.
fn taken(widths: &[usize]) -> usize {
    let gaps = GAPS[0].len() + GAPS[1].len() * (widths.len() - 1);
    widths.iter().sum::<usize>() + gaps
}

/// The first cells of a row: words to the left, numbers to the right of their columns.
fn line(page: &mut Page, cells: &[String; 7], widths: &[usize], styles: [Style; 7]) {
    for (column, (cell, width)) in cells.iter().zip(widths).enumerate() {
        let gap = " ".repeat(width.saturating_sub(seen(cell)));
        page.words(GAPS[usize::from(column > 0)]);
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

/// The same below each other: the frame, and every value behind its name.
fn record(page: &mut Page, heads: &[String; 7], cells: &[String; 7], styles: [Style; 7]) {
    page.line(&format!("  {}", cells[0]));
    let widest = heads.iter().map(|head| seen(head)).max().unwrap_or(0);
    for ((head, cell), style) in heads.iter().zip(cells).zip(styles).skip(1) {
        page.words("      ");
        page.styled(Style::new().dimmed(), head);
        page.words(&" ".repeat(widest - seen(head) + 2));
        page.styled(style, cell);
        page.end();
    }
}

/// Words in no more columns than this; what is cut off leaves a mark.
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
    remarks.extend(failure::unsupported(scene, frame, MOST_LISTED));
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
    remarks.extend(margin::lines(scene, frame));
    remarks.extend(frame.notices.iter().map(|n| format!("note: {n}")));
    remarks
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;
    use crate::analysis::Options;
    use crate::scene::format::{BlockEntry, LimitsEntry, RobotEntry, StepEntry};

    fn assert_fits(name: &str, analysis: &Analysis) {
        for width in [40, 50, 60, 70, 79, 80, 100] {
            let page = of(name, analysis, Timing::Included, Some(width)).fitted(width);
            for line in page.text().lines() {
                assert!(seen(line) <= width, "{width}: {line}");
            }
        }
        // A file or another program gets every row whole.
        let page = of(name, analysis, Timing::Included, None);
        assert!(page.text().contains("robots\u{1b}[0m   \u{1b}[2mproof"));
    }

    #[test]
    fn words_are_explained_beside_them_at_any_width() {
        for (width, lines) in [(None, 11), (Some(100), 11), (Some(60), 14), (Some(40), 20)] {
            let page = explained(width);
            let found: Vec<&str> = page.text().lines().collect();
            let widest = found.iter().map(|line| seen(line)).max();
            assert!(
                widest <= Some(width.unwrap_or(78).min(78)),
                "{}",
                page.text()
            );
            assert!(
                found
                    .iter()
                    .all(|line| line.is_char_boundary(10) && !line[9..].starts_with("  "))
            );
            assert_eq!(found.len(), lines, "{}", page.text());
        }
    }

    #[test]
    fn every_scene_of_the_assets_fits_a_terminal() {
        let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
        let mut seen = 0;
        for folder in ["thesis", "study"] {
            for entry in fs::read_dir(assets.join(folder)).expect("a folder") {
                let path = entry.expect("an entry").path();
                let name = path.to_string_lossy();
                let scene = Scene::from_json(&fs::read_to_string(&path).expect("text"));
                let scene = scene.expect("a sound scene");
                let options = match folder {
                    "thesis" => Options::default().margins(true),
                    _ => Options::default().verdict_only(true),
                };
                assert_fits(&name, &Analysis::with(scene, &options));
                seen += 1;
            }
        }
        assert!(seen > 30, "{seen}");
    }

    /// Long words and wide letters as titles and names, blocks that pull apart, robots that are not strong enough, and forces of
    /// many digits.
    #[test]
    fn strange_names_and_many_robots_fit_a_terminal() {
        let names = [
            "n".repeat(300),
            "石".repeat(120),
            "a stone of many words ".repeat(12),
            "e\u{301}".repeat(90),
            "  all   stands   5 N   none".into(),
        ];
        let square = |x: f64, y: f64| [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]];
        for name in names {
            let ids: Vec<String> = (0..9).map(|k| format!("{name}{k}")).collect();
            let mut scene = Scene::builder()
                .title(&name)
                .friction(0.5)
                .ground(square(-1.0, -1.0))
                .ground(square(0.0, -1.0));
            for (k, id) in (0_u8..).zip(&ids) {
                let polygon = square(0.75 * f64::from(k), f64::from(k));
                scene = scene.block(BlockEntry::new(id).polygon(polygon).weight(1.234_567_8e7));
            }
            let mut held = StepEntry::new(&name).place(&ids[5..]);
            for id in &ids[5..] {
                let limits = LimitsEntry::default().force(1.0).torque(1.0);
                scene = scene.robot(RobotEntry::new(id).limits(limits));
                held = held.hold(id, id);
            }
            let scene = scene
                .step(StepEntry::new(&name).place(&ids[..5]))
                .step(held);
            let scene = scene.build().expect("a sound scene");
            let options = Options::default().margins(true);
            assert_fits(&format!("{name}.json"), &Analysis::with(scene, &options));
        }
    }
}
