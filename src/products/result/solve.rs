//! [`Solve`]: the method that decided a frame, its iterations and its time, as written in a result.

use serde::Serialize;

use super::{Number, Timing};
use crate::mechanics::analysis::{SolveReport, Stages};

#[derive(Serialize)]
pub(super) struct Solve {
    method: &'static str,
    iterations: usize,
    programs: usize,
    groups: usize,
    reused: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stages: Option<StageSeconds>,
}

#[derive(Serialize)]
struct StageSeconds {
    assembly: Number,
    solution: Number,
    wedging: Number,
    margins: Number,
}

impl Solve {
    pub(super) fn new(solve: &SolveReport, timing: Timing) -> Solve {
        let timed = timing == Timing::Included;
        let of = |stages: Stages| StageSeconds {
            assembly: Number(stages.assembly),
            solution: Number(stages.solution),
            wedging: Number(stages.wedging),
            margins: Number(stages.margins),
        };
        Solve {
            method: solve.method.name(),
            iterations: solve.iterations,
            programs: solve.programs,
            groups: solve.groups,
            reused: solve.reused,
            seconds: timed.then_some(Number(solve.seconds)),
            stages: timed.then(|| of(solve.stages)),
        }
    }
}
