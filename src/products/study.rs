//! [`study`]: measures what accuracy costs on given scenes.
//!
//! The accuracy levels of drystone, and the solver clarabel alone, solve every frame at several tolerances. Each result
//! is compared with a reference of higher precision: the level `proved` at the tolerance `REFERENCE_TOLERANCE`, whose
//! forces are refined on the optimal face with sums of 32 digits. Times are wall times on this machine, so only their
//! ratios are meaningful. All other numbers are the same on every machine.
//!
//! The benchmark in `tests/bench/accuracy` compares more methods, with a reference of 32 digits.

use crate::clock::Instant;
use crate::mechanics::analysis::{Accuracy, Analysis, Options, Verdict};
use crate::mechanics::program::{Program, Scale, columns, force_primal};
use crate::mechanics::proof::Proof;
use crate::mechanics::scene::Scene;
use crate::mechanics::solve::{Amounts, Conditioning, SolverSettings, Status, TOLERANCE, by_clarabel};
use crate::mechanics::statics::effect::{self, FrameContext};
use crate::mechanics::statics::interface::Interfaces;
use crate::text::Word;

/// The solver tolerances of the study.
pub const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-12];

/// The solver tolerance of the reference.
const REFERENCE_TOLERANCE: f64 = 1e-13;

/// A way to solve a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The solver clarabel alone: the forces with the least sum that balance the loads, without a proof and without
    /// the missing forces of a frame that falls.
    Clarabel,
    /// The complete analysis of the command `check` at an accuracy level.
    Level(Accuracy),
}

impl Method {
    /// All methods, in the order of the table.
    pub const ALL: [Method; 3] = [Method::Clarabel, Method::Level(Accuracy::Standard), Method::Level(Accuracy::Proved)];

    /// Returns the name of the method for tables.
    pub fn name(self) -> &'static str {
        match self {
            Method::Clarabel => "clarabel",
            Method::Level(level) => level.word(),
        }
    }
}

/// The result of a method for one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The verdict.
    pub verdict: Verdict,
    /// The total force if the frame stands, the total of the missing forces if it falls, N; `None` if not computed.
    pub total: Option<f64>,
    /// The largest relative error that `total` can have, according to a lower bound that a motion proves; `None`
    /// without such a bound.
    pub gap: Option<f64>,
    /// The largest resultant at an interface or of a robot, N, if the frame stands.
    pub largest: Option<f64>,
    /// The number of failures.
    pub failures: usize,
    /// The largest imbalance of a block relative to the forces on it, if forces prove the verdict.
    pub imbalance: Option<f64>,
    /// The largest violation of the motion relative to its power, if a motion proves the verdict.
    pub violation: Option<f64>,
    /// The number of iterations of the solvers.
    pub iterations: usize,
    /// The solving time, s.
    pub seconds: f64,
}

/// The comparison of a verdict with the reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The verdict is that of the reference.
    Right,
    /// The verdict is wrong.
    Wrong,
    /// The method did not reach a verdict.
    Undecided,
    /// The reference is undecided.
    Unknown,
}

impl Mark {
    /// Returns the mark as one lower-case word.
    pub fn word(self) -> &'static str {
        match self {
            Mark::Right => "right",
            Mark::Wrong => "wrong",
            Mark::Undecided => "undecided",
            Mark::Unknown => "unknown",
        }
    }
}

/// One frame with the results of all methods.
#[derive(Clone, Debug)]
pub struct Case {
    /// The title of the scene. If the scene has several frames, the title or the number of the frame follows.
    pub name: String,
    /// The number of placed blocks.
    pub blocks: usize,
    /// The result with which the runs are compared.
    pub reference: Outcome,
    /// One run per method and tolerance.
    pub runs: Vec<Run>,
}

/// One method at one tolerance for one frame.
#[derive(Clone, Debug)]
pub struct Run {
    /// The method.
    pub method: Method,
    /// The tolerance of the solver.
    pub tolerance: f64,
    /// The result. Its time is the median of several runs.
    pub outcome: Outcome,
    /// The comparison of the verdict with the reference.
    pub mark: Mark,
    /// The relative error of the total, if the verdict is that of the reference.
    pub total_error: Option<f64>,
    /// The relative error of the largest single force, if the frame stands.
    pub largest_error: Option<f64>,
}

/// Runs the study on all frames of some scenes: one case per frame. Calls `tick` with the name of each frame before the
/// frame starts.
pub fn study(scenes: &[Scene], tolerances: &[f64], tick: &mut dyn FnMut(&str)) -> Vec<Case> {
    let mut cases = Vec::new();
    for scene in scenes {
        let title = if scene.title.is_empty() { "untitled" } else { &scene.title };
        for (number, frame) in scene.frames.iter().enumerate() {
            let name = match (scene.frames.len(), frame.title.as_str()) {
                (1, _) => title.to_owned(),
                (_, "") => format!("{title} · {}", number + 1),
                (_, step) => format!("{title} · {step}"),
            };
            tick(&name);
            let mut alone = scene.clone();
            alone.frames = vec![frame.clone()];
            cases.push(case(name, &alone, tolerances));
        }
    }
    cases
}

/// Runs all methods on a scene with one frame.
fn case(name: String, scene: &Scene, tolerances: &[f64]) -> Case {
    let reference = by_level(scene, Accuracy::Proved, REFERENCE_TOLERANCE);
    let programs = programs(scene);
    let mut runs = Vec::with_capacity(Method::ALL.len() * tolerances.len());
    for method in Method::ALL {
        for tolerance in tolerances {
            let outcome = repeated(|| match method {
                Method::Clarabel => alone(&programs, *tolerance),
                Method::Level(accuracy) => by_level(scene, accuracy, *tolerance),
            });
            let mark = match (outcome.verdict, reference.verdict) {
                (_, Verdict::Undecided) => Mark::Unknown,
                (Verdict::Undecided, _) => Mark::Undecided,
                (found, truth) if found == truth => Mark::Right,
                _ => Mark::Wrong,
            };
            let error = |found: Option<f64>, truth: Option<f64>| {
                let (found, truth) = found.zip(truth).filter(|_| mark == Mark::Right)?;
                (truth > 0.0).then(|| (found - truth).abs() / truth)
            };
            runs.push(Run {
                method,
                tolerance: *tolerance,
                outcome,
                mark,
                total_error: error(outcome.total, reference.total),
                largest_error: error(outcome.largest, reference.largest),
            });
        }
    }
    Case { name, blocks: scene.frames.first().map_or(0, |frame| frame.placed.len()), reference, runs }
}

/// Solves at least three times, and up to nine times as long as the total time is below 0.02 s. Returns the outcome with
/// the median of the times.
fn repeated(solve: impl Fn() -> Outcome) -> Outcome {
    let mut outcome = solve();
    let mut times = vec![outcome.seconds];
    while times.len() < 3 || (times.len() < 9 && times.iter().sum::<f64>() < 0.02) {
        times.push(solve().seconds);
    }
    outcome.seconds = median(times).unwrap_or(0.0);
    outcome
}

/// Runs the complete analysis of a scene with one frame. The measured time begins after the interfaces have been found.
fn by_level(scene: &Scene, accuracy: Accuracy, tolerance: f64) -> Outcome {
    let analysis = Analysis::with(scene, &Options { accuracy, tolerance: Some(tolerance), ..Options::default() });
    let Some(frame) = analysis.frames.first() else { return NOTHING };
    let stands = frame.verdict == Verdict::Stable;
    let falls = frame.verdict == Verdict::Unstable && frame.unsupported.is_empty();
    let largest = frame.largest_force();
    let bound = frame.force_bound.filter(|_| stands && frame.total_force > 0.0);
    let (imbalance, violation) = match frame.proof {
        Proof::Forces { worst_imbalance, .. } => (Some(worst_imbalance), None),
        Proof::Mechanism { power, worst_violation } => (None, Some(worst_violation / power)),
    };
    Outcome {
        verdict: frame.verdict,
        total: if stands { Some(frame.total_force) } else { falls.then_some(frame.total_sticking) },
        gap: bound.map(|bound| ((frame.total_force - bound) / frame.total_force).max(0.0)),
        largest: stands.then_some(largest),
        failures: frame.failures.len(),
        imbalance,
        violation,
        iterations: frame.solve.iterations,
        seconds: frame.solve.seconds,
    }
}

/// The outcome for a frame without loads.
const NOTHING: Outcome = Outcome {
    verdict: Verdict::Stable,
    total: Some(0.0),
    gap: None,
    largest: Some(0.0),
    failures: 0,
    imbalance: None,
    violation: None,
    iterations: 0,
    seconds: 0.0,
};

/// Builds the linear programs of a scene with one frame, one for each independent part with loads, in the same way as
/// [`Analysis`].
fn programs(scene: &Scene) -> Vec<Program> {
    let Some(frame) = scene.frames.first() else { return Vec::new() };
    let found = Interfaces::new(scene);
    let interfaces = found.in_frame(frame);
    let (assembly, _) = effect::assemble(&FrameContext { scene, frame, interfaces: &interfaces });
    let parts = assembly.components();
    let loaded = parts.iter().filter(|part| part.heaviest_load() > 0.0);
    loaded.map(|part| Program::new(part, Scale::from_assembly(part))).collect()
}

/// Solves all parts of a frame with clarabel alone: it finds the least sum of forces that balance the loads, or that no
/// forces balance them. The measured time includes setting up the programs of the solver.
fn alone(programs: &[Program], tolerance: f64) -> Outcome {
    let start = Instant::now();
    let settings = SolverSettings { tolerance, ..Conditioning::Full.into() };
    let (mut whole, mut total, mut largest) = (NOTHING, 0.0, 0.0_f64);
    for program in programs {
        let columns = columns(program);
        let problem = force_primal(&program.loads, &columns, |column| column.cost, None);
        let answer = by_clarabel(&problem, settings);
        whole.iterations += answer.iterations;
        whole.verdict = whole.verdict.max(match answer.status {
            Status::Solved => Verdict::Stable,
            Status::Infeasible => Verdict::Unstable,
            _ => Verdict::Undecided,
        });
        let mut amounts = Amounts::zero(program);
        columns.iter().zip(&answer.x).for_each(|(column, x)| amounts.add(column.force, *x));
        let contacts = amounts.normal.iter().zip(&amounts.friction).map(|(n, t)| libm::hypot(n[0] + n[1], *t));
        let grips = amounts.grip.iter().map(|g| libm::hypot(g[0], g[1]));
        total += amounts.total() * program.scale.force;
        largest = contacts.chain(grips).fold(largest, |most, force| most.max(force * program.scale.force));
    }
    let stands = whole.verdict == Verdict::Stable;
    let seconds = start.elapsed().as_secs_f64();
    Outcome { total: stands.then_some(total), largest: stands.then_some(largest), seconds, ..whole }
}

/// The results of one method at one tolerance over all frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// The method.
    pub method: Method,
    /// The tolerance of the solver.
    pub tolerance: f64,
    /// The median over the frames of the time relative to `standard` at the tolerance nearest to the default. Large
    /// frames therefore do not dominate small ones.
    pub time: f64,
    /// The largest relative error of the total among frames with the right verdict.
    pub total_error: Option<f64>,
    /// The median of these relative errors.
    pub median_error: Option<f64>,
    /// The largest relative error of the largest single force, among frames with the right verdict.
    pub largest_error: Option<f64>,
    /// The number of wrong verdicts.
    pub wrong: usize,
    /// The number of frames without a verdict.
    pub undecided: usize,
    /// The number of frames with a decided reference.
    pub frames: usize,
    /// The median of the iterations.
    pub iterations: usize,
}

/// Returns the middle value of a list; of two middle values, the larger one. Returns `None` for an empty list.
fn median(mut list: Vec<f64>) -> Option<f64> {
    list.sort_by(f64::total_cmp);
    list.get(list.len() / 2).copied()
}

/// Summarises a study over all its frames. Returns one entry for each combination of method and tolerance, in the
/// order of the runs.
pub fn summary(cases: &[Case]) -> Vec<Summary> {
    let standard = |case: &Case| {
        let runs = case.runs.iter().filter(|run| run.method == Method::Level(Accuracy::Standard));
        let far = |run: &&Run| libm::log10(run.tolerance / TOLERANCE).abs();
        runs.min_by(|a, b| far(a).total_cmp(&far(b))).map_or(1.0, |run| run.outcome.seconds).max(1e-9)
    };
    let base: Vec<f64> = cases.iter().map(standard).collect();
    let first = cases.first().map_or(&[][..], |case| &case.runs);
    let line = |(place, run): (usize, &Run)| {
        let runs = || cases.iter().map(move |case| &case.runs[place]);
        let count = |mark: Mark| runs().filter(|run| run.mark == mark).count();
        let worst = |of: fn(&Run) -> Option<f64>| runs().filter_map(of).reduce(f64::max);
        let times = runs().zip(&base).map(|(run, base)| run.outcome.seconds / base);
        Summary {
            method: run.method,
            tolerance: run.tolerance,
            time: median(times.collect()).unwrap_or(1.0),
            total_error: worst(|run| run.total_error),
            median_error: median(runs().filter_map(|run| run.total_error).collect()),
            largest_error: worst(|run| run.largest_error),
            wrong: count(Mark::Wrong),
            undecided: count(Mark::Undecided),
            frames: cases.len() - count(Mark::Unknown),
            iterations: median(runs().map(|run| run.outcome.iterations as f64).collect()).unwrap_or(0.0) as usize,
        }
    };
    first.iter().enumerate().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_value() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(Vec::new()), None);
    }
}
