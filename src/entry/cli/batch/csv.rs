//! Writes the answers of a batch as CSV: one row for each frame, and one row for each scene that is not valid. The
//! columns are the same in every run.

use crate::mechanics::analysis::{Analysis, FrameAnalysis};
use crate::mechanics::scene::Problem;
use crate::products::result::Origin;
use crate::products::wording::verdict::word;
use crate::text;

/// The first row: the names of the columns. Forces are in newtons, and all numbers have at most twelve significant
/// digits. `friction_used` is the largest used fraction of the available friction at any contact, and `limit_used` the
/// largest used fraction of the limits of any robot.
pub(super) const HEADER: &str = "file,line,scene,frame,title,verdict,weight_n,largest_force_n,total_force_n,total_sticking_n,friction_used,limit_used,problem\n";

/// Returns the rows of a scene, one for each frame.
pub(super) fn rows(origin: &Origin, analysis: &Analysis) -> String {
    let scene = &analysis.scene;
    let frames = analysis.frames.iter().zip(&scene.frames).enumerate();
    let row = |(number, (answer, frame)): (usize, (&FrameAnalysis, &crate::mechanics::scene::Frame))| {
        let [start, title] = [place(origin), cell(&frame.title)];
        let name = cell(&scene.title);
        let verdict = word(answer.verdict);
        let forces = answer.contacts.iter().map(|c| c.resultant.force.norm());
        let numbers = [
            answer.weight,
            forces.fold(0.0, f64::max),
            answer.total_force,
            answer.total_sticking,
            (answer.contacts.iter().map(|c| c.friction_used)).fold(0.0, f64::max),
            (answer.robots.iter().map(|r| r.limit_used)).fold(0.0, f64::max),
        ];
        let numbers = numbers.map(|number| rounded(number).to_string()).join(",");
        format!("{start},{name},{},{title},{verdict},{numbers},\n", number + 1)
    };
    frames.map(row).collect()
}

/// Returns the CSV row of a scene that is not valid. The row contains only the first problem of the scene.
pub(super) fn problem_row(origin: &Origin, problems: &[Problem]) -> String {
    // If the scene is a line of the input, its own lines do not matter.
    let words = problems.first().map_or(String::new(), |problem| match origin.line.unwrap_or(problem.line) {
        0 => problem.message.clone(),
        line => format!("line {line}: {}", problem.message),
    });
    let between = ",".repeat(HEADER.matches(',').count() - 1);
    format!("{}{between}{}\n", place(origin), cell(&words))
}

/// Rounds a number to twelve significant digits. The digits after these are rounding errors of sums.
fn rounded(number: f64) -> f64 {
    format!("{number:.11e}").parse().unwrap_or(number)
}

fn place(origin: &Origin) -> String {
    let file = origin.file.as_deref().map_or(String::new(), text::csv);
    let line = origin.line.map_or(String::new(), |line| line.to_string());
    format!("{file},{line}")
}

fn cell(words: &str) -> String {
    if words.is_empty() { String::new() } else { text::csv(words) }
}
