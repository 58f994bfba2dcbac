//! [`cost`]: the table of the effects of a step, with their unknowns and times.
//!
//! All effects share one linear program, which is solved once. Unknowns are therefore counted by effect, but times by
//! stage. Only margins and wedging are computed separately and have times of their own.

use super::Grid;
use crate::analysis::{EffectName, FrameAnalysis};
use crate::result::Timing;
use crate::text::line;
use crate::wording::number::{counted, duration};

/// Makes the table of the effects of a step. Times are in it only if `timing` includes them.
pub(super) fn cost(found: &FrameAnalysis, timing: Timing) -> Grid {
    let timed = timing == Timing::Included;
    let (caption, heads): (&str, &[&str]) = match timed {
        true => (
            "What was simulated, what was left out, and what it cost",
            &["effect or stage", "simulated", "why", "#unknowns", "#time"],
        ),
        false => (
            "What was simulated, and what was left out",
            &["effect", "simulated", "why", "#unknowns"],
        ),
    };
    let mut grid = Grid::new(caption, heads);
    let mut add = |cells: [String; 4], time: String| {
        grid.add("", cells.into_iter().chain(timed.then_some(time)));
    };
    let (solve, stages) = (&found.solve, &found.solve.stages);
    for described in &found.effects {
        let time = match described.effect {
            _ if !described.simulated => "none".to_owned(),
            EffectName::Margins => duration(stages.margins),
            EffectName::Wedging => duration(stages.wedging),
            _ => "shared".to_owned(),
        };
        let meaning = described.effect.meaning();
        let name = format!("{}: {meaning}", described.effect);
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
        add([name, simulated.to_owned(), why, unknowns], time);
    }
    if timed {
        let stage = |name: &str, why: &str| {
            [
                name.to_owned(),
                String::new(),
                why.to_owned(),
                String::new(),
            ]
        };
        let posing = stage(
            "posing",
            "the contributions of all effects, assembled to one program",
        );
        add(posing, duration(stages.assembly));
        let solving = stage(
            "solving and proving",
            "all unknowns together: no time can be given for a single effect",
        );
        add(solving, duration(stages.solution));
    }
    let simulated = found.effects.iter().filter(|e| e.simulated);
    let unknowns: usize = simulated.map(|e| e.unknowns).sum();
    let how = format!(
        "{}, {}; {}, of which earlier steps answered {}",
        counted(solve.programs, "program"),
        counted(solve.iterations, "iteration"),
        counted(solve.groups, "separate part"),
        solve.reused
    );
    let name = format!("all together, decided by: {}", solve.method.name());
    let cells = [name, String::new(), how, unknowns.to_string()];
    add(cells, duration(solve.seconds));
    grid
}
