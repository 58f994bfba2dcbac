//! [`Study`]: an accuracy study, which measures the time and the error of solution methods.
//!
//! Every [`Method`] solves every frame at every tolerance several times. The results are compared with a certified
//! [`Reference`] in extended precision. Times are wall times on this machine, so only their ratios are meaningful.
//! All other numbers are the same on every machine.

mod double;
mod least;
mod method;
mod optimum;
mod outcome;
mod reference;
mod skyline;
mod summary;

pub use method::Method;
pub use outcome::Outcome;
pub use reference::Reference;
pub use summary::{Summary, summary};

use crate::clock::Instant;
use crate::mechanics::analysis::Verdict;
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::Proof;
use crate::mechanics::scene::{Frame, Scene};
use crate::mechanics::statics::effect::{self, FrameContext};
use crate::mechanics::statics::interface::Interfaces;

/// The solver tolerances of the study.
pub const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-12];

/// The default tolerance of an analysis.
pub const DEFAULT_TOLERANCE: f64 = crate::mechanics::solve::TOLERANCE;

/// If a falling frame would need at most this much adhesion to stand, relative to the heaviest load, the verdict
/// `stable` of a method is not counted as wrong. This is within the documented tolerance of the proofs.
const MAX_NEGLIGIBLE_ADHESION: f64 = 10.0 * Proof::IMBALANCE_TOL;

/// The results of a study.
#[derive(Clone, Debug)]
pub struct Study {
    /// One case per frame, in the order of the scenes.
    pub cases: Vec<Case>,
}

/// One frame with the results of all methods.
#[derive(Clone, Debug)]
pub struct Case {
    /// The title of the scene. If the scene has several frames, the title or the number of the frame follows.
    pub name: String,
    /// The number of placed blocks.
    pub blocks: usize,
    /// The certified verdict and values with which the runs are compared.
    pub truth: FrameReference,
    /// One run per method and tolerance.
    pub runs: Vec<Run>,
}

/// The reference for a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameReference {
    /// The exact verdict, without a tolerance; `Undecided` if it could not be certified.
    pub verdict: Verdict,
    /// The least total force if the frame stands; the least total adhesion if it falls; in N.
    pub total: Option<f64>,
    /// The largest resultant at a contact or grip, N, if the frame stands. It is that of the unique forces: the optimal
    /// forces with the least sum of squares. `None` if it could not be certified.
    pub largest: Option<f64>,
    /// The largest possible relative error of `total`.
    pub gap: f64,
    /// Whether the frame falls, but needs so little adhesion that it may be called stable within the documented
    /// tolerance.
    pub within_band: bool,
}

/// The comparison of a verdict with the reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// The verdict is correct, or wrong only within the documented tolerance.
    Right,
    /// The verdict is wrong.
    Wrong,
    /// The method did not reach a verdict.
    Undecided,
    /// There is no certified reference.
    Unknown,
}

/// The result of one method at one tolerance for one frame.
#[derive(Clone, Debug)]
pub struct Run {
    /// The method.
    pub method: Method,
    /// The tolerance of the solver.
    pub tolerance: f64,
    /// The median of the wall times, in s.
    pub seconds: f64,
    /// The result.
    pub outcome: Outcome,
    /// The comparison of the verdict with the reference.
    pub mark: Mark,
    /// The relative error of the total force, or of the total adhesion if the frame falls.
    pub total_error: Option<f64>,
    /// The relative error of the largest single force, if the frame stands.
    pub largest_error: Option<f64>,
}

/// The input of the methods: one frame.
pub(super) struct Task {
    scene: Scene,
    programs: Vec<Program>,
}

/// Runs the study on all frames of some scenes. Calls `tick` with the name of each frame before the frame starts.
pub fn study(scenes: &[Scene], tolerances: &[f64], tick: &mut dyn FnMut(&str)) -> Study {
    let mut cases = Vec::new();
    for scene in scenes {
        for (number, frame) in scene.frames.iter().enumerate() {
            let name = name(scene, frame, number);
            tick(&name);
            let task = Task::new(scene, frame);
            cases.push(case(name, frame.placed.len(), &task, tolerances));
        }
    }
    Study { cases }
}

fn name(scene: &Scene, frame: &Frame, number: usize) -> String {
    let title = if scene.title.is_empty() { "untitled" } else { &scene.title };
    match (scene.frames.len(), frame.title.as_str()) {
        (1, _) => title.to_owned(),
        (_, "") => format!("{title} · {}", number + 1),
        (_, step) => format!("{title} · {step}"),
    }
}

impl Task {
    /// Builds the linear programs of a frame, one for each independent part with loads, in the same way as
    /// `Analysis`.
    fn new(scene: &Scene, frame: &Frame) -> Task {
        let mut scene = scene.clone();
        scene.frames = vec![frame.clone()];
        let found = Interfaces::new(&scene);
        let interfaces = found.in_frame(&scene, frame);
        let (assembly, _) = effect::assemble(&FrameContext { scene: &scene, frame, interfaces: &interfaces });
        let programs = assembly
            .components()
            .iter()
            .filter(|component| component.heaviest_load() > 0.0)
            .map(|component| Program::new(component, Scale::from_assembly(component)))
            .collect();
        Task { scene, programs }
    }
}

/// Computes the reference solution of each independent part of a frame, and combines these solutions to one for the
/// frame.
fn truth(programs: &[Program]) -> FrameReference {
    let references: Vec<(&Program, Reference)> = programs.iter().map(|p| (p, Reference::new(p))).collect();
    let verdict = references.iter().map(|r| r.1.verdict).max().unwrap_or(Verdict::Stable);
    let decided = references.iter().all(|r| r.1.verdict != Verdict::Undecided);
    let described = || references.iter().filter(|r| r.1.verdict == verdict);
    let newtons = |p: &Program, v: Option<f64>| v.map(|v| v * p.scale.force);
    let total = described().map(|(p, r)| newtons(p, r.total)).try_fold(0.0, |sum, v| v.map(|v| sum + v));
    let largest = described().map(|(p, r)| newtons(p, r.largest)).try_fold(0.0, |most: f64, v| v.map(|v| most.max(v)));
    let falls = verdict == Verdict::Unstable;
    let barely = |r: &Reference| r.total.is_some_and(|t| t <= MAX_NEGLIGIBLE_ADHESION * Scale::HEAVIEST);
    FrameReference {
        verdict: if decided || falls { verdict } else { Verdict::Undecided },
        total: if decided { total } else { None },
        largest: if decided && !falls { largest } else { None },
        gap: references.iter().map(|r| r.1.gap).fold(0.0, f64::max),
        within_band: falls && described().all(|(_, r)| barely(r)),
    }
}

fn case(name: String, blocks: usize, task: &Task, tolerances: &[f64]) -> Case {
    let truth = truth(&task.programs);
    let mut runs = Vec::with_capacity(Method::ALL.len() * tolerances.len());
    for method in Method::ALL {
        for tolerance in tolerances {
            runs.push(run(method, *tolerance, task, &truth));
        }
    }
    Case { name, blocks, truth, runs }
}

/// Runs a method at least three times, and up to nine times as long as the total time is below 0.02 s. The time of the
/// run is the median.
fn run(method: Method, tolerance: f64, task: &Task, truth: &FrameReference) -> Run {
    let mut times = Vec::with_capacity(9);
    let mut outcome = Outcome::empty();
    let mut spent = 0.0;
    while times.len() < 3 || (times.len() < 9 && spent < 0.02) {
        let start = Instant::now();
        outcome = method.solve(task, tolerance);
        let seconds = outcome.seconds.unwrap_or(start.elapsed().as_secs_f64());
        times.push(seconds);
        spent += seconds;
    }
    times.sort_by(f64::total_cmp);
    let mark = match (outcome.verdict, truth.verdict) {
        (_, Verdict::Undecided) => Mark::Unknown,
        (Verdict::Undecided, _) => Mark::Undecided,
        (a, b) if a == b => Mark::Right,
        (Verdict::Stable, Verdict::Unstable) if truth.within_band => Mark::Right,
        _ => Mark::Wrong,
    };
    let same = outcome.verdict == truth.verdict;
    let error = |found: Option<f64>, exact: Option<f64>| match (same, found, exact) {
        (true, Some(found), Some(exact)) if exact > 0.0 => Some((found - exact).abs() / exact),
        _ => None,
    };
    Run {
        method,
        tolerance,
        seconds: times[times.len() / 2],
        mark,
        total_error: error(outcome.total, truth.total),
        largest_error: error(outcome.largest, truth.largest),
        outcome,
    }
}
