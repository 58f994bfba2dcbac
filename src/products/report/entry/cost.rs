//! [`cost`]: the table of the effects that the analysis of a frame simulated or left out. It has the number of unknowns
//! of each effect and, on request, the time of each stage.
//!
//! All effects share the linear programs of the frame. Unknowns are therefore counted by effect, but times by stage.
//! Only margins and wedging are computed separately and have separate times.

use super::Grid;
use crate::mechanics::analysis::{EffectName, EffectReport, FrameAnalysis, Stages};
use crate::products::result::Timing;
use crate::products::wording::number::{counted, duration};
use crate::text::line;

/// Makes the table of the effects that were simulated or left out in a frame. The table has times only if `timing`
/// includes them.
pub(super) fn cost(frame_analysis: &FrameAnalysis, timing: Timing) -> Grid {
    let timed = timing == Timing::Included;
    let (caption, heads): (&str, &[&str]) = match timed {
        true => (
            "What was simulated, what was left out, and what it cost",
            &["effect or stage", "simulated", "why", "#unknowns", "#time"],
        ),
        false => ("What was simulated, and what was left out", &["effect", "simulated", "why", "#unknowns"]),
    };
    let mut grid = Grid::new(caption, heads);
    let mut add = |(cells, time): ([String; 4], String)| {
        grid.add("", cells.into_iter().chain(timed.then_some(time)));
    };
    for described in &frame_analysis.effects {
        add(effect(described, &frame_analysis.solve.stages));
    }
    if timed {
        stages(&frame_analysis.solve.stages).into_iter().for_each(&mut add);
    }
    add(sum(frame_analysis));
    grid
}

/// Returns the table cells of an effect, and its time in words: `none` for an effect that was left out, `shared` for an
/// effect without a time of its own.
fn effect(described: &EffectReport, stages: &Stages) -> ([String; 4], String) {
    let time = match described.effect {
        _ if !described.simulated => "none".to_owned(),
        EffectName::Margins => duration(stages.margins),
        EffectName::Wedging => duration(stages.wedging),
        _ => "shared".to_owned(),
    };
    let name = format!("{}: {}", described.effect, described.effect.meaning());
    let simulated = match described.simulated {
        true => "yes",
        false => "left out",
    };
    let unknowns = match (described.simulated, described.unknowns) {
        (_, 0) => "none".to_owned(),
        (true, n) => n.to_string(),
        (false, n) => format!("{n} saved"),
    };
    let why = line(&described.why);
    ([name, simulated.to_owned(), why, unknowns], time)
}

/// Returns the table cells of the stages that all effects share, and their times.
fn stages(stages: &Stages) -> [([String; 4], String); 2] {
    let stage = |name: &str, why: &str, seconds: f64| {
        let cells = [name, "", why, ""].map(str::to_owned);
        (cells, duration(seconds))
    };
    [
        stage(
            "setting up",
            "the equations of all effects are set up together, so no time can be given for a single effect",
            stages.assembly,
        ),
        stage(
            "solving and proving",
            "all effects are solved together and have no times of their own, except margins and wedging",
            stages.solution,
        ),
    ]
}

/// Returns the table cells of the last row, which has the sums over all effects, and the total time.
fn sum(frame_analysis: &FrameAnalysis) -> ([String; 4], String) {
    let solve = &frame_analysis.solve;
    let simulated = frame_analysis.effects.iter().filter(|e| e.simulated);
    let unknowns: usize = simulated.map(|e| e.unknowns).sum();
    let how = format!(
        "{}, {}; {}, {} of them with results of earlier steps",
        counted(solve.programs, "program"),
        counted(solve.iterations, "iteration"),
        counted(solve.groups, "separate part"),
        solve.reused
    );
    let name = format!("all together, decided by: {}", solve.method.name());
    let cells = [name, String::new(), how, unknowns.to_string()];
    (cells, duration(solve.seconds))
}
