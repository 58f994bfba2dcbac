//! [`Study`]: an accuracy study, which measures the time and the error of solution methods.
//!
//! Every [`Method`] solves every frame at every tolerance several times. The results are compared with a certified
//! [`Reference`] in extended precision. Times are wall times on this machine, so only their ratios are meaningful.
//! All other numbers are the same on every machine. The page `src/doc/accuracy.md` and the picture
//! `assets/accuracy.svg` show the results.

pub mod double;
mod method;
mod optimum;
pub mod picture;
mod reference;
pub mod skyline;
pub mod vallat;

pub use method::{Method, Outcome};
pub use reference::Reference;

use std::time::Instant;

use drystone::Scene;
use drystone::analysis::{Accuracy, Proof, Verdict};
use drystone::internals::effect::{self, FrameContext};
use drystone::internals::interface::Interfaces;
use drystone::internals::program::{Program, Scale};
use drystone::internals::solve::TOLERANCE;

/// The solver tolerances of the study.
pub const TOLERANCES: [f64; 6] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-12];

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
pub struct Task<'s> {
    scene: &'s Scene,
    /// The index of the frame.
    frame: usize,
    /// A linear program for each independent part of the frame that has loads.
    programs: Vec<Program>,
}

/// Runs the study on all frames of some scenes, each with its name. Calls `tick` with the name of each frame before the
/// frame starts.
pub fn study(scenes: &[(String, Scene)], tolerances: &[f64], tick: &mut dyn FnMut(&str)) -> Study {
    let mut cases = Vec::new();
    for (title, scene) in scenes {
        for (number, frame) in scene.frames().iter().enumerate() {
            let name = name(title, scene, number);
            tick(&name);
            let task = Task::new(scene, number);
            cases.push(case(name, frame.placed.len(), &task, tolerances));
        }
    }
    Study { cases }
}

fn name(title: &str, scene: &Scene, number: usize) -> String {
    match (scene.frames().len(), scene.frames()[number].title.as_str()) {
        (1, _) => title.to_owned(),
        (_, "") => format!("{title} · {}", number + 1),
        (_, step) => format!("{title} · {step}"),
    }
}

impl<'s> Task<'s> {
    /// Builds the linear programs of a frame in the same way as `Analysis`.
    fn new(scene: &'s Scene, number: usize) -> Task<'s> {
        let frame = &scene.frames()[number];
        let found = Interfaces::new(scene);
        let interfaces = found.in_frame(frame);
        let (assembly, _) = effect::assemble(&FrameContext { scene, frame, interfaces: &interfaces });
        let programs = assembly
            .components()
            .iter()
            .filter(|component| component.heaviest_load() > 0.0)
            .map(|component| Program::new(component, Scale::from_assembly(component)))
            .collect();
        Task { scene, frame: number, programs }
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

fn case(name: String, blocks: usize, task: &Task<'_>, tolerances: &[f64]) -> Case {
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
fn run(method: Method, tolerance: f64, task: &Task<'_>, truth: &FrameReference) -> Run {
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

/// The results of one method at one tolerance over all frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// The method.
    pub method: Method,
    /// The tolerance of the solver.
    pub tolerance: f64,
    /// The median over the frames of the time relative to `standard` at the default tolerance.
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
    /// The number of frames with a certified reference.
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
///
/// The time of a frame is divided by the time of the method `standard` on the same frame, at the tolerance nearest to
/// the default. Large frames therefore do not dominate small ones.
pub fn summary(study: &Study) -> Vec<Summary> {
    let Some(first) = study.cases.first() else {
        return Vec::new();
    };
    let base: Vec<f64> = study
        .cases
        .iter()
        .map(|case| {
            let standard = case.runs.iter().filter(|r| r.method == Method::Level(Accuracy::Standard));
            let far = |r: &&Run| libm::log10(r.tolerance / TOLERANCE).abs();
            standard.min_by(|a, b| far(a).total_cmp(&far(b))).map_or(1.0, |r| r.seconds).max(1e-9)
        })
        .collect();
    (0..first.runs.len())
        .map(|k| {
            let runs = || study.cases.iter().map(move |case| &case.runs[k]);
            let count = |mark: Mark| runs().filter(|r| r.mark == mark).count();
            let worst = |of: fn(&Run) -> Option<f64>| runs().filter_map(of).reduce(f64::max);
            let times = runs().zip(&base).map(|(r, base)| r.seconds / base);
            let iterations = runs().map(|r| r.outcome.iterations as f64);
            Summary {
                method: first.runs[k].method,
                tolerance: first.runs[k].tolerance,
                time: median(times.collect()).unwrap_or(1.0),
                total_error: worst(|r| r.total_error),
                median_error: median(runs().filter_map(|r| r.total_error).collect()),
                largest_error: worst(|r| r.largest_error),
                wrong: count(Mark::Wrong),
                undecided: count(Mark::Undecided),
                frames: study.cases.len() - count(Mark::Unknown),
                iterations: median(iterations.collect()).unwrap_or(0.0) as usize,
            }
        })
        .collect()
}

/// Writes a relative error: `1.2e-9`, `0` below the rounding error of f64, or `–` for `None`.
fn small(value: Option<f64>) -> String {
    value.map_or("–".into(), |v| if v < 1e-16 { "0".into() } else { format!("{v:.1e}") })
}

/// Returns the summary as the Markdown table of `src/doc/accuracy.md`, with one row for each combination of method and
/// tolerance.
pub fn table(study: &Study) -> String {
    let mut text = String::from(
        "| method | tolerance | relative time | iterations | median error of total | worst error of total | worst error of largest force | wrong | undecided |\n\
         |---|---|---|---|---|---|---|---|---|\n",
    );
    for line in summary(study) {
        let errors = [line.median_error, line.total_error, line.largest_error].map(small).join(" | ");
        let wrong = if line.wrong == 0 { "0".into() } else { format!("**{}**", line.wrong) };
        text += &format!(
            "| {} | {:.0e} | {:.2} | {} | {errors} | {wrong} | {} |\n",
            line.method.name(),
            line.tolerance,
            line.time,
            line.iterations,
            line.undecided
        );
    }
    text
}
