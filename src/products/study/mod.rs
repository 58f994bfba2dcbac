//! [`Study`]: what accuracy costs in time, measured here and now.
//!
//! Every frame of some scenes is solved by every [`Method`] at every tolerance, several times, and compared with a
//! certified [`Reference`] in extended precision. Times are wall times of this run on this machine and mean something only
//! beside each other; everything else is the same on every machine.

mod double;
mod least;
mod method;
mod reference;
mod skyline;
mod summary;

use std::time::Instant;

pub use method::{Method, Outcome};
pub use reference::Reference;
pub use summary::{Summary, summary};

use crate::analysis::Verdict;
use crate::effect::{self, FrameContext};
use crate::interface::Interfaces;
use crate::program::{Program, Scale};
use crate::proof::Proof;
use crate::scene::{Frame, Scene};

/// The solver tolerances that are measured.
pub const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-12];

/// The tolerance that an analysis has where nothing else is asked.
pub const DEFAULT_TOLERANCE: f64 = crate::solve::TOLERANCE;

/// Where a frame's groups are so near the edge, in parts of the heaviest load, calling a falling one stable is no mistake.
const BAND: f64 = 10.0 * Proof::IMBALANCE_TOL;

/// Everything that was measured.
#[derive(Clone, Debug)]
pub struct Study {
    /// Frame by frame, in the scenes' order.
    pub cases: Vec<Case>,
}

/// One frame of a scene and what the methods made of it.
#[derive(Clone, Debug)]
pub struct Case {
    /// The scene's title and the frame's, or its number.
    pub name: String,
    /// Placed blocks.
    pub blocks: usize,
    /// What is true.
    pub truth: Truth,
    /// Method by method, tolerance by tolerance.
    pub runs: Vec<Run>,
}

/// What is true of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// The verdict, without any band; `Undecided` where it could not be certified.
    pub verdict: Verdict,
    /// Least total force where it stands, least total sticking where it falls, N.
    pub total: Option<f64>,
    /// The largest resultant of the unique forces where it stands, N.
    pub largest: Option<f64>,
    /// How well `total` is certified, relative.
    pub gap: f64,
    /// Whether it falls by so little that the stated band calls it stable.
    pub within_band: bool,
}

/// How a verdict compares with the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// It is the truth, or within the stated band of it.
    Right,
    /// It is not.
    Wrong,
    /// No verdict was given.
    Undecided,
    /// The truth could not be certified.
    Unknown,
}

/// One method at one tolerance on one frame.
#[derive(Clone, Debug)]
pub struct Run {
    /// How it was solved.
    pub method: Method,
    /// What the solver was asked for.
    pub tolerance: f64,
    /// Median wall time, s.
    pub seconds: f64,
    /// What came out.
    pub outcome: Outcome,
    /// How the verdict compares with the truth.
    pub mark: Mark,
    /// Relative error of the total force (of the total sticking where it falls).
    pub total_error: Option<f64>,
    /// Relative error of the largest single force, where it stands.
    pub largest_error: Option<f64>,
}

/// A frame as the methods get it.
pub(super) struct Task {
    scene: Scene,
    programs: Vec<Program>,
}

/// Measures scenes.
///
/// `tick` is called before each frame with its name.
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
    let title = if scene.title.is_empty() {
        "untitled"
    } else {
        &scene.title
    };
    match (scene.frames.len(), frame.title.as_str()) {
        (1, _) => title.to_owned(),
        (_, "") => format!("{title} · {}", number + 1),
        (_, step) => format!("{title} · {step}"),
    }
}

impl Task {
    /// The programs of a frame, as `Analysis` poses them.
    fn new(scene: &Scene, frame: &Frame) -> Task {
        let mut scene = scene.clone();
        scene.frames = vec![frame.clone()];
        let found = Interfaces::new(&scene);
        let interfaces = found.in_frame(&scene, frame);
        let (assembly, _) = effect::assemble(&FrameContext {
            scene: &scene,
            frame,
            interfaces: &interfaces,
        });
        let programs = assembly
            .components()
            .iter()
            .filter(|component| component.heaviest_load() > 0.0)
            .map(|component| Program::new(component, Scale::from_assembly(component)))
            .collect();
        Task { scene, programs }
    }
}

fn truth(programs: &[Program]) -> Truth {
    let references: Vec<(&Program, Reference)> =
        programs.iter().map(|p| (p, Reference::new(p))).collect();
    let verdict = references
        .iter()
        .map(|r| r.1.verdict)
        .max()
        .unwrap_or(Verdict::Stable);
    let decided = references.iter().all(|r| r.1.verdict != Verdict::Undecided);
    let described = || references.iter().filter(|r| r.1.verdict == verdict);
    let newtons = |p: &Program, v: Option<f64>| v.map(|v| v * p.scale.force);
    let total = described()
        .map(|(p, r)| newtons(p, r.total))
        .try_fold(0.0, |sum, v| v.map(|v| sum + v));
    let largest = described()
        .map(|(p, r)| newtons(p, r.largest))
        .try_fold(0.0, |most: f64, v| v.map(|v| most.max(v)));
    let falls = verdict == Verdict::Unstable;
    let barely = |r: &Reference| r.total.is_some_and(|t| t <= BAND * Scale::HEAVIEST);
    Truth {
        verdict: if decided || falls {
            verdict
        } else {
            Verdict::Undecided
        },
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
    Case {
        name,
        blocks,
        truth,
        runs,
    }
}

/// Times a run: three times at least, up to nine while they are short.
fn run(method: Method, tolerance: f64, task: &Task, truth: &Truth) -> Run {
    let mut times = Vec::with_capacity(9);
    let mut outcome = Outcome::none();
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
