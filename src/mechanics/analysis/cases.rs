//! Load cases: each frame is analysed in every case, and its results are those of its worst case.
//!
//! The worst case has the worst verdict. Of the cases in which the frame stands, it has the least load factor, and of
//! cases with the same load factor the least tilt, if these margins were computed; otherwise it is the first.

use std::sync::Arc;

use super::{Analysis, FrameAnalysis, Influence, MarginKind, Margins, Options, Verdict, reach, repeat};
use crate::mechanics::scene::{Case, Load, Note, Scene};

/// The results of all load cases of one frame.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct LoadCases {
    /// The index of the case to which the results of the frame belong: its worst case.
    pub governing: usize,
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

/// The scenes of an analysis with load cases, or of frames that fall under a vehicle.
#[derive(Clone, Debug)]
pub(crate) struct CaseScenes {
    /// The scene as its author wrote it, with its cases.
    given: Arc<Scene>,
    /// For each frame, the scene with the weights and loads to which its results belong.
    of_frames: Vec<Arc<Scene>>,
}

impl CaseScenes {
    /// Returns the scene of a frame, to change it.
    pub(super) fn scene_mut(&mut self, number: usize) -> &mut Scene {
        Arc::make_mut(&mut self.of_frames[number])
    }

    /// Returns the scenes with only one of their frames. `None` if there is no such frame.
    pub(super) fn alone(&self, number: usize) -> Option<CaseScenes> {
        let own = self.of_frames.get(number)?.alone(number)?;
        Some(CaseScenes { given: self.given.alone(number)?.into(), of_frames: vec![own.into()] })
    }
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
        // A change must reach its target in all cases.
        let alone = Options { reach: None, ..*options };
        let source = repeat::source_of_each(&scene.frames);
        let (mut frames, mut scenes, mut notes) = (Vec::<Arc<FrameAnalysis>>::new(), Vec::new(), Vec::new());
        let mut cases: Vec<LoadCases> = Vec::new();
        let mut lines: Vec<Option<Influence>> = Vec::new();
        let mut latest: Option<Analysis> = None;
        for (k, (case, in_case)) in scene.in_cases().enumerate() {
            // If nothing was decided before the deadline, nothing is decided in the other cases either.
            let is_undecided = |found: &Analysis| found.frames.iter().all(|f| f.verdict == Verdict::Undecided);
            if !(options.is_late() && latest.as_ref().is_some_and(is_undecided)) {
                latest = Some(Analysis::with(in_case, &alone));
            }
            let Some(found) = &mut latest else { continue };
            if k == 0 {
                notes = std::mem::take(&mut found.notes);
                frames.clone_from(&found.frames);
                scenes = (0..frames.len()).map(|number| found.scene_of(number).clone()).collect();
                lines = frames.iter().map(|frame| frame.vehicle.clone()).collect();
                let range = |k: usize| if source[k] == k { envelope(&frames[k]) } else { Vec::new() };
                let first = |k| LoadCases { governing: 0, each: Vec::new(), envelope: range(k) };
                cases = (0..frames.len()).map(first).collect();
            }
            for (number, frame) in found.frames.iter().enumerate().filter(|(k, _)| source[*k] == *k) {
                let (id, verdict, margins) = (case.id.clone(), frame.verdict, frame.margins.clone());
                cases[number].each.push(CaseResult { id, verdict, margins });
                for (range, own) in cases[number].envelope.iter_mut().zip(envelope(frame)) {
                    range.normal = wider(range.normal, own.normal);
                    range.friction = wider(range.friction, own.friction);
                }
                // At each position, the influence line has the least factor of all cases.
                lines[number] = lines[number].take().zip(frame.vehicle.as_ref()).map(|(mut line, own)| {
                    line.keep_least(own);
                    line
                });
                if is_worse(frame, &frames[number]) {
                    frames[number] = frame.clone();
                    scenes[number] = found.scene_of(number).clone();
                    cases[number].governing = k;
                }
            }
        }
        let own = frames.iter_mut().enumerate().filter(|(k, _)| source[*k] == *k);
        let mut own: Vec<_> = own.map(|(k, frame)| (k, Arc::make_mut(frame))).collect();
        for (k, frame) in &mut own {
            frame.cases = Some(std::mem::take(&mut cases[*k]));
            frame.vehicle = lines[*k].take();
        }
        reach::add_reach(&scene, own.into_iter(), options);
        for (k, source) in source.into_iter().enumerate() {
            (frames[k], scenes[k]) = (frames[source].clone(), scenes[source].clone());
        }
        Analysis::of_conditions(scene, frames, scenes, notes)
    }

    /// Returns an analysis from its parts: the scene as it was `given`, the results of its frames, and for each frame the
    /// scene with the weights and loads to which these results belong.
    pub(super) fn of_conditions(
        given: Arc<Scene>,
        frames: Vec<Arc<FrameAnalysis>>,
        of_frames: Vec<Arc<Scene>>,
        notes: Vec<Note>,
    ) -> Analysis {
        // Results of the whole scene, such as a list of inputs, show the condition of the worst frame.
        let scene = of_frames.get(worst_of(&frames)).unwrap_or(&given).clone();
        Analysis { scene, frames, notes, cases: Some(CaseScenes { given, of_frames }) }
    }

    /// Returns the scene with the weights and loads to which the results of a frame belong. With load cases, these are those
    /// of its worst case. If the frame falls under the vehicle, the loads contain the axles.
    pub fn scene_of(&self, frame: usize) -> &Arc<Scene> {
        self.cases.as_ref().and_then(|cases| cases.of_frames.get(frame)).unwrap_or(&self.scene)
    }

    /// Returns the results of a frame, with the scene of [`Analysis::scene_of`].
    pub(crate) fn at(&self, frame: usize) -> (&Arc<Scene>, &FrameAnalysis) {
        (self.scene_of(frame), &self.frames[frame])
    }

    /// Returns the scene as its author wrote it, with its load cases.
    #[cfg(any(feature = "python", feature = "wasm"))]
    pub(crate) fn given(&self) -> &Arc<Scene> {
        self.cases.as_ref().map_or(&self.scene, |cases| &cases.given)
    }
}

/// Returns the index of the worst of several results; of equal ones the first.
fn worst_of(found: &[Arc<FrameAnalysis>]) -> usize {
    (1..found.len()).fold(0, |worst, next| if is_worse(&found[next], &found[worst]) { next } else { worst })
}

/// True if a frame is worse in the first case than in the second.
fn is_worse(first: &FrameAnalysis, second: &FrameAnalysis) -> bool {
    let [a, b] = [first, second].map(reserve);
    first.verdict > second.verdict || (first.verdict == second.verdict && a < b)
}

/// Returns the margins by which cases are compared: the load factor, then the tilt in degrees. A margin is infinite if it
/// is not known or has no limit, such as the load factor of a case without loads.
fn reserve(found: &FrameAnalysis) -> [f64; 2] {
    let margins = found.margins.as_ref();
    let least = |kind: MarginKind| {
        let ends = margins.map_or([None; 2], |margins| [margins.least(kind), margins.most(kind)]);
        ends.into_iter().flatten().map(f64::abs).fold(f64::INFINITY, f64::min)
    };
    let factor = margins.and_then(|margins| margins.most(MarginKind::LoadFactor));
    [factor.unwrap_or(f64::INFINITY), least(MarginKind::Tilt)]
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
