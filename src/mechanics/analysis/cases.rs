//! Load cases: each frame is analysed in every case, and its results are those of its worst case.
//!
//! The worst case has the worst verdict. Of the cases in which the frame stands, it has the least load factor, and of
//! cases with the same load factor the least tilt, if these margins were computed; otherwise it is the first.

use std::sync::Arc;

use super::{Analysis, FrameAnalysis, Margin, Margins, Options, Verdict, reach};
use crate::mechanics::scene::{Case, Load, Scene};

/// The results of all load cases of one frame.
#[derive(Clone, Debug)]
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

/// The scenes of an analysis with load cases.
#[derive(Clone, Debug)]
pub(crate) struct CaseScenes {
    /// The scene with its cases.
    given: Arc<Scene>,
    /// For each frame, the scene in the worst case of this frame.
    of_frames: Vec<Arc<Scene>>,
}

impl CaseScenes {
    /// Returns the scenes with only one of their frames. `None` if there is no such frame.
    pub(super) fn alone(&self, number: usize) -> Option<CaseScenes> {
        let own = self.of_frames.get(number)?.alone(number)?;
        Some(CaseScenes { given: self.given.alone(number)?.into(), of_frames: vec![own.into()] })
    }
}

impl Scene {
    /// Returns the scene in one load case: with the factors on its weights and loads, and without cases.
    pub(crate) fn in_case(&self, case: &Case) -> Scene {
        let mut scene = self.clone();
        scene.cases.clear();
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
        let each = scene.cases.iter().map(|case| Analysis::with(scene.in_case(case), &alone));
        let mut each: Vec<Analysis> = each.collect();
        let notes = each.first_mut().map(|first| std::mem::take(&mut first.notes)).unwrap_or_default();
        let mut frames = Vec::with_capacity(scene.frames.len());
        let mut scenes = Vec::with_capacity(scene.frames.len());
        for number in 0..scene.frames.len() {
            let found: Vec<&FrameAnalysis> = each.iter().map(|case| &case.frames[number]).collect();
            let governing = worst_of(&found);
            let results = scene.cases.iter().zip(&found).map(|(case, found)| CaseResult {
                id: case.id.clone(),
                verdict: found.verdict,
                margins: found.margins.clone(),
            });
            let cases = LoadCases { governing, each: results.collect(), envelope: envelope(&found) };
            let mut frame = found[governing].clone();
            frame.cases = Some(cases);
            frames.push(frame);
            scenes.push(each[governing].scene.clone());
        }
        reach::add_reach(&scene, &mut frames, options);
        // Results of the whole scene, such as a list of inputs, show the case of the worst frame.
        let worst = worst_of(&frames.iter().collect::<Vec<_>>());
        let shown = scenes.get(worst).unwrap_or(&scene).clone();
        Analysis { scene: shown, frames, notes, cases: Some(CaseScenes { given: scene, of_frames: scenes }) }
    }

    /// Returns the scene with the loads and weights to which the results of a frame belong: those of its worst load
    /// case, or the scene itself if it has no cases.
    pub fn scene_of(&self, frame: usize) -> &Arc<Scene> {
        self.cases.as_ref().and_then(|cases| cases.of_frames.get(frame)).unwrap_or(&self.scene)
    }

    /// Returns the scene as it was given to the analysis, with its load cases.
    #[cfg(any(feature = "python", feature = "wasm"))]
    pub(crate) fn given(&self) -> &Arc<Scene> {
        self.cases.as_ref().map_or(&self.scene, |cases| &cases.given)
    }
}

/// Returns the index of the worst of several results; of equal ones the first.
fn worst_of(found: &[&FrameAnalysis]) -> usize {
    (1..found.len()).fold(0, |worst, next| if is_worse(found[next], found[worst]) { next } else { worst })
}

/// True if a frame is worse in the first case than in the second.
fn is_worse(first: &FrameAnalysis, second: &FrameAnalysis) -> bool {
    let [a, b] = [first, second].map(reserve);
    first.verdict > second.verdict || (first.verdict == second.verdict && a < b)
}

/// Returns the margins by which cases are compared: the load factor, then the tilt in degrees. A margin is infinite if it
/// is not known or has no limit, such as the load factor of a case without loads.
fn reserve(found: &FrameAnalysis) -> [f64; 2] {
    let margin = |of: &Margin| of.at().unwrap_or(f64::INFINITY);
    let margins = found.margins.as_ref();
    margins.map_or([f64::INFINITY; 2], |margins| {
        [margin(&margins.load_factor), margin(&margins.tilt.left).min(margin(&margins.tilt.right))]
    })
}

/// Returns the range of the forces at each interface over all cases. All cases have the same interfaces.
fn envelope(cases: &[&FrameAnalysis]) -> Vec<Envelope> {
    let Some((first, others)) = cases.split_first() else {
        return Vec::new();
    };
    let range = |contact: usize, force: &dyn Fn(&super::Contact) -> f64| {
        let at_first = force(&first.contacts[contact]);
        let forces = others.iter().filter_map(|case| case.contacts.get(contact)).map(force);
        forces.fold([at_first; 2], |[low, high], force| [f64::min(low, force), f64::max(high, force)])
    };
    let of_contact = |contact: usize| Envelope {
        normal: range(contact, &|contact| contact.normal_forces.iter().sum()),
        friction: range(contact, &|contact| contact.friction_force),
    };
    (0..first.contacts.len()).map(of_contact).collect()
}
