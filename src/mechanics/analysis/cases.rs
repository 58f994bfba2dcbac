//! Load cases: each frame is analysed in every case.
//!
//! The verdict and the forces of a frame are those of its worst case: the case with the worst verdict. If several cases have
//! this verdict, it is the one with the least load factor, and then the first. The load factor is always computed for this,
//! so the worst case does not depend on what else is asked.
//!
//! Every answer must hold in all cases. [`Answers`] combines the answers of the cases, and of the positions of the vehicle. It
//! names the [`Condition`] that decides each answer. Movements of supports have an answer for each case.

use std::sync::Arc;

use super::answers::Answers;
use super::condition::Condition;
use super::decide::decided_forces;
use super::margin::{END_TOL, largest_load_factor};
use super::{Analysis, FrameAnalysis, Influence, Margins, Options, SupportMovement, Verdict, repeat};
use crate::mechanics::scene::{Case, Load, Scene};
use crate::mechanics::solve::{DeadlineGuard, is_late};
use crate::mechanics::statics::assembly::Assembly;
use crate::mechanics::statics::effect;
use crate::mechanics::statics::interface::Interfaces;

/// The results of all load cases of one frame.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LoadCases {
    /// The index of the case to which the results of the frame belong: its worst case.
    pub governing: usize,
    /// Whether the case is worse than others in its verdict or its load factor, or all cases may be as bad. Otherwise no
    /// case has a limit of its loads, and the first one is taken.
    pub is_worst: bool,
    /// The result of each case, in the order of the scene.
    pub each: Vec<CaseResult>,
    /// For each interface of the frame, the least and the greatest normal force and friction force of the listed
    /// balances of all cases, N.
    pub envelope: Vec<Envelope>,
}

/// The verdict on one load case.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct CaseResult {
    /// The id of the case.
    pub id: String,
    /// Whether the frame stands in this case.
    pub verdict: Verdict,
    /// How far the frame is from its limit in this case, if requested.
    pub margins: Option<Margins>,
    /// How the frame follows the movements of the scene in this case.
    pub movements: Vec<SupportMovement>,
}

/// The least and the greatest forces at one interface, N.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Envelope {
    /// The sum of the normal forces.
    pub normal: [f64; 2],
    /// The friction force, in the direction of the tangent.
    pub friction: [f64; 2],
}

impl Scene {
    /// Returns each load case, and the scene in it: with the factors on its weights and loads, and without cases.
    pub(crate) fn in_cases(&self) -> impl Iterator<Item = (&Case, Scene)> {
        // If the scene of each case were copied with all cases, many cases would take quadratic time.
        let without_cases = Scene { cases: Vec::new(), ..self.clone() };
        self.cases.iter().map(move |case| (case, without_cases.in_case(case)))
    }

    fn in_case(&self, case: &Case) -> Scene {
        let mut scene = self.clone();
        for block in &mut scene.blocks {
            block.weight *= case.weights;
        }
        let loads = self.loads.iter().filter(|load| case.loads[load.entry] != 0.0);
        scene.loads = loads.map(|load| times(load, case.loads[load.entry])).collect();
        scene
    }
}

/// Returns a load multiplied by a factor.
fn times(load: &Load, factor: f64) -> Load {
    let mut load = *load;
    load.force *= factor;
    load.torque *= factor;
    if let Some(spread) = &mut load.spread {
        spread.force = spread.force.map(|force| force * factor);
    }
    load
}

impl Analysis {
    /// Analyses a scene with load cases.
    pub(super) fn of_cases(scene: Arc<Scene>, options: &Options) -> Analysis {
        let interfaces = Interfaces::new(&scene);
        let _until = DeadlineGuard::new(options.deadline);
        let source = repeat::source_of_each(&scene.frames);
        let (mut frames, mut scenes, mut notes) = (Vec::<Arc<FrameAnalysis>>::new(), Vec::new(), Vec::new());
        let mut cases: Vec<LoadCases> = Vec::new();
        let mut lines: Vec<Option<Influence>> = Vec::new();
        let mut answers: Vec<Answers> = Vec::new();
        let mut worst: Vec<f64> = Vec::new();
        let mut latest: Option<Analysis> = None;
        for (k, (case, in_case)) in scene.in_cases().enumerate() {
            // If nothing was decided before the deadline, nothing is decided in the other cases either.
            let is_undecided = |found: &Analysis| found.frames.iter().all(|f| f.verdict == Verdict::Undecided);
            if !(options.is_late() && latest.as_ref().is_some_and(is_undecided)) {
                latest = Some(Analysis::decide(in_case.into(), options));
            }
            let Some(found) = &mut latest else { continue };
            if k == 0 {
                notes = std::mem::take(&mut found.notes);
                frames.clone_from(&found.frames);
                scenes = (0..frames.len()).map(|number| found.scene_of(number).clone()).collect();
                lines = frames.iter().map(|frame| frame.vehicle.clone()).collect();
                worst = vec![f64::INFINITY; frames.len()];
                let range = |k: usize| if source[k] == k { envelope(&frames[k]) } else { Vec::new() };
                let first = |k| LoadCases { governing: 0, is_worst: false, each: Vec::new(), envelope: range(k) };
                cases = (0..frames.len()).map(first).collect();
            }
            for (place, (number, frame)) in
                found.frames.iter().enumerate().filter(|(k, _)| source[*k] == *k).enumerate()
            {
                cases[number].each.push(CaseResult {
                    id: case.id.clone(),
                    verdict: frame.verdict,
                    margins: frame.margins.clone(),
                    movements: frame.movements.clone(),
                });
                let own = Answers::of(frame, Condition { case: Some(k), position: None });
                if k == 0 {
                    answers.push(own);
                } else if let Some(answers) = answers.get_mut(place) {
                    answers.also(own);
                }
                for (range, own) in cases[number].envelope.iter_mut().zip(envelope(frame)) {
                    range.normal = wider(range.normal, own.normal);
                    range.friction = wider(range.friction, own.friction);
                }
                // At each position, the influence line has the least factor of all cases.
                lines[number] = lines[number].take().zip(frame.vehicle.as_ref()).map(|(mut line, own)| {
                    line.keep_least(own);
                    line
                });
                // Only the worst case has forces that are shown, so a lone verdict needs no load factor.
                let verdict = frame.verdict;
                let is_compared = !options.verdict_only && scene.cases.len() > 1 && verdict >= frames[number].verdict;
                let factor =
                    if is_compared { load_factor(&found.given, number, frame, &interfaces) } else { f64::INFINITY };
                let is_less = factor < worst[number] * (1.0 - END_TOL);
                if k == 0 || verdict > frames[number].verdict || verdict == frames[number].verdict && is_less {
                    (frames[number], worst[number]) = (frame.clone(), factor);
                    scenes[number] = found.scene_of(number).clone();
                    cases[number].governing = k;
                }
            }
        }
        let own = frames.iter_mut().enumerate().filter(|(k, _)| source[*k] == *k);
        let mut own: Vec<_> = own.map(|(k, frame)| (k, Arc::make_mut(frame))).collect();
        for ((k, frame), answers) in own.iter_mut().zip(answers) {
            if scene.cases.len() > 1 {
                answers.give_to(&scene, frame);
            }
            cases[*k].is_worst = frame.verdict != Verdict::Stable || worst[*k].is_finite();
            frame.cases = Some(std::mem::take(&mut cases[*k]));
            frame.vehicle = lines[*k].take();
        }
        for (k, source) in source.into_iter().enumerate() {
            (frames[k], scenes[k]) = (frames[source].clone(), scenes[source].clone());
        }
        Analysis { given: scene, of_frames: scenes, frames, options: *options, notes }
    }
}

/// Returns the largest factor on the loads of a frame in a load case, and on its vehicle. It is infinite if it has no limit,
/// or if it is not known: the frame needs its loads, or the deadline has passed.
fn load_factor(scene: &Scene, number: usize, found: &FrameAnalysis, interfaces: &Interfaces) -> f64 {
    let of = |component: &Assembly| {
        let unloaded = decided_forces(&component.clone().with_load_factor(0.0))?.0;
        largest_load_factor(component, &unloaded).value()
    };
    let loaded = !scene.loads.is_empty() && !is_late();
    let components = loaded.then(|| effect::assembly_of(scene, &scene.frames[number], interfaces).components());
    let of_loads = components.iter().flatten().filter_map(of);
    let of_vehicle = found.vehicle.as_ref().and_then(|line| line.positions[line.governing?].factor);
    of_loads.chain(of_vehicle).fold(f64::INFINITY, f64::min)
}

/// Returns the forces at each interface, as ranges without length. All cases have the same interfaces.
fn envelope(case: &FrameAnalysis) -> Vec<Envelope> {
    let of_contact = |contact: &super::Contact| Envelope {
        normal: [contact.normal_force(); 2],
        friction: [contact.friction_force; 2],
    };
    case.contacts.iter().map(of_contact).collect()
}

/// Returns the range that contains two ranges.
fn wider(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}
