//! A person's table of an analysis: a line per frame, and under it what fails, in words with numbers and units.

use std::fmt::Write;

use clap::builder::styling::{AnsiColor, Style};

use crate::analysis::{Analysis, Failure, FrameAnalysis, Margin, Margins, Proof, Sides, Verdict};
use crate::cli::page::Page;
use crate::figure::letter;
use crate::geometry::Point;
use crate::report::result::{Timing, word};
use crate::scene::{BlockId, RobotId, Scene};
use crate::text::heading;

/// What a verdict says and what it does not, for under the tables.
pub(crate) const LIMITS: &str = "\
stable    some set of admissible forces balances every block. Rigid blocks, laid dry, at rest; a wedged balance counts.
forces    sum of all normal, friction and robot forces; sticking: what would have to be glued to make up for the rest
friction  most of it that is used anywhere; robots: most of a limit that is used
proof     in parts of the largest weight; the motion's fastest point has speed 1
";

/// So many failures of a frame are told in words; the figure and the JSON have them all.
const TOLD: usize = 12;
/// A frame's longer title is cut.
const TITLE: usize = 40;
/// A scene's longer title is cut: a terminal would break the line, and what stands behind the break would look like a row.
const HEADING: usize = 60;

/// The table of one scene.
pub(crate) fn of(name: &str, analysis: &Analysis, timing: Timing) -> Page {
    let scene = analysis.scene;
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
    let mut proof = proof(frame.proof);
    if timing == Timing::Included {
        let _ = write!(proof, ", {}", duration(frame.solve.seconds));
    }
    [
        label,
        word(frame.verdict).into(),
        format!("{} N", digits(frame.total_force)),
        if is_left_out(frame) {
            "unknown".into()
        } else if frame.total_sticking == 0.0 {
            "none".into()
        } else {
            format!("{} N", digits(frame.total_sticking))
        },
        percent(friction),
        if frame.robots.is_empty() {
            "no robot".into()
        } else {
            percent(limit)
        },
        proof,
    ]
}

/// Whether a frame falls and what would have to stick was not found out.
fn is_left_out(frame: &FrameAnalysis) -> bool {
    let falls = frame.verdict == Verdict::Unstable;
    falls && frame.failures.is_empty() && frame.unsupported.is_empty()
}

fn proof(proof: Proof) -> String {
    match proof {
        Proof::Forces {
            worst_imbalance,
            worst_pull,
            worst_slip,
            ..
        } => {
            format!(
                "forces balance to {}",
                rough(worst_imbalance.max(worst_pull).max(worst_slip))
            )
        }
        Proof::Mechanism { power, .. } => {
            let ruled_out = match proof.rules_out() {
                sum if sum.is_finite() => format!("no balance below {} loads", rough(sum)),
                _ => "no balance at all".into(),
            };
            format!("motion of power {}: {ruled_out}", digits(power))
        }
    }
}

/// One digit is enough to see how small a number is.
fn rough(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else {
        format!("{x:.0e}")
    }
}

/// What a reader needs to know of a frame beyond its line, a sentence each.
fn remarks(scene: &Scene, frame: &FrameAnalysis) -> Vec<String> {
    let mut remarks: Vec<String> = frame
        .failures
        .iter()
        .take(TOLD)
        .map(|f| sentence(scene, f))
        .collect();
    if frame.failures.len() > TOLD {
        remarks.push(format!("and {} more", frame.failures.len() - TOLD));
    }
    if !frame.unsupported.is_empty() {
        let names: Vec<&str> = frame
            .unsupported
            .iter()
            .take(TOLD)
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
    if !frame.doubt.is_empty() {
        remarks.push(frame.doubt.clone());
    }
    if frame.only_by_wedging == Some(true) {
        remarks.push("stands only by wedging: nothing that acts on it builds up the forces that would hold it".into());
    }
    let wedging = frame
        .effects
        .iter()
        .find(|e| e.effect == "wedging" && e.simulated);
    if let Some(effect) = wedging.filter(|_| frame.only_by_wedging != Some(false)) {
        remarks.push(format!("wedging: {}", effect.why));
    }
    if let Some(margins) = &frame.margins {
        remarks.extend(edges(scene, margins));
    }
    remarks.extend(frame.notices.iter().map(|n| format!("note: {n}")));
    remarks
}

/// How far a frame is from the edge, a line per margin that was asked for.
fn edges(scene: &Scene, margins: &Margins) -> Vec<String> {
    let or = |margin: &Margin, unit: &str, none: &str| match margin {
        Margin::Value { at, .. } => format!("{}{unit}", digits(*at)),
        Margin::None => none.into(),
        Margin::Unbounded => "any".into(),
        Margin::Unconfirmed { .. } => "withheld".into(),
        Margin::NotAsked => "not asked for".into(),
    };
    let edge = |margin: &Margin, unit: &str| or(margin, unit, "none (it falls at any)");
    let one = |name: &str, margin: &Margin| {
        (*margin != Margin::NotAsked).then(|| format!("{name}: {}", edge(margin, "")))
    };
    let two = |name: &str, sides: &Sides, unit: &str, none: &str| {
        let (left, right) = (or(&sides.left, unit, none), or(&sides.right, unit, none));
        let asked = sides.left != Margin::NotAsked;
        asked.then(|| format!("{name}: left {left}, right {right}"))
    };
    let share = "largest horizontal share of the weights";
    let lines = [
        one("least friction", &margins.friction),
        two(
            "largest tilt",
            &margins.tilt,
            "°",
            "none (it falls unturned)",
        ),
        two(
            share,
            &margins.horizontal_load,
            "",
            "none (it falls at any)",
        ),
        one("largest kernel", &margins.kernel),
        one("largest factor on the loads", &margins.load_factor),
    ];
    let mut lines: Vec<String> = lines.into_iter().flatten().collect();
    lines.extend(margins.robots.iter().map(|robot| {
        format!(
            "least limits of robot {}, each alone: fx {}, fy {}, torque {}",
            scene.robots[robot.robot.0].id,
            edge(&robot.fx, " N"),
            edge(&robot.fy, " N"),
            edge(&robot.torque, " N·m")
        )
    }));
    lines
}

/// A failure in words.
fn sentence(scene: &Scene, failure: &Failure) -> String {
    let robot = |id: RobotId| scene.robots[id.0].id.as_str();
    let block = |id: BlockId| scene.blocks[id.0].id.as_str();
    match *failure {
        Failure::Tension {
            bodies: [a, b],
            at,
            force,
        } => {
            let (a, b, at) = (scene.name(a), scene.name(b), place(at));
            format!(
                "{a} comes off {b} at {at}: holding on would take a pull of {} N",
                digits(force.norm())
            )
        }
        Failure::Friction {
            bodies: [a, b],
            at,
            force,
        } => {
            let (a, b, at) = (scene.name(a), scene.name(b), place(at));
            format!(
                "{a} slides along {b} at {at}: holding on would take {} N more than friction gives",
                digits(force.norm())
            )
        }
        Failure::RobotForce {
            robot: r,
            block: held,
            force,
            ..
        } => {
            let (x, y) = (digits(force.x), digits(force.y));
            format!(
                "robot {} cannot hold {}: it would have to give ({x}, {y}) N beyond its limits",
                robot(r),
                block(held)
            )
        }
        Failure::RobotTorque {
            robot: r,
            block: held,
            torque,
            ..
        } => {
            let torque = digits(torque);
            format!(
                "robot {} cannot hold {}: it would have to give {torque} N·m beyond its limit",
                robot(r),
                block(held)
            )
        }
    }
}

fn place(p: Point) -> String {
    format!("({}, {}) m", digits(p.x), digits(p.y))
}

fn percent(share: f64) -> String {
    format!("{} %", digits((share * 1000.0).round() / 10.0))
}

fn duration(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{} ms", digits(seconds * 1e3))
    } else {
        format!("{} s", digits(seconds))
    }
}

/// Four significant digits, without zeros that say nothing.
fn digits(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{x:.3e}");
    }
    let before = if size >= 1.0 {
        libm::log10(size).floor() as usize + 1
    } else {
        0
    };
    let text = format!("{x:.*}", 4usize.saturating_sub(before));
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_keep_four_digits() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (43.371_94, "43.37"),
            (24.0, "24"),
            (1234.56, "1235"),
            (-0.5, "-0.5"),
            (0.054_12, "0.0541"),
            (9.999_99, "10"),
            (123_456.0, "123456"),
            (1e9, "1.000e9"),
            (1e-6, "1.000e-6"),
            (f64::INFINITY, "inf"),
        ];
        for (x, text) in cases {
            assert_eq!(digits(x), text, "{x}");
        }
    }
}
