//! Load cases: each frame is analysed in every case, and its results are those of its worst case.
//!
//! The worst case has the worst verdict. Of the cases in which the frame stands, it has the least load factor, or else
//! the least tilt, if these margins were computed; otherwise it is the first.

use std::sync::Arc;

use super::{Analysis, FrameAnalysis, Margin, Margins, Options, Verdict};
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
        let each = scene.cases.iter().map(|case| Analysis::with(scene.in_case(case), options));
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
        // Results of the whole scene, such as a list of inputs, show the case of the worst frame.
        let worst = worst_of(&frames.iter().collect::<Vec<_>>());
        let shown = scenes.get(worst).cloned().unwrap_or(scene);
        Analysis { scene: shown, frames, notes, case_scenes: scenes }
    }

    /// Returns the scene with the loads and weights to which the results of a frame belong: those of its worst load
    /// case, or the scene itself if it has no cases.
    pub fn scene_of(&self, frame: usize) -> &Arc<Scene> {
        self.case_scenes.get(frame).unwrap_or(&self.scene)
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

/// Returns the least margin by which cases are compared: the load factor, or else the tilt in degrees. Infinite if it is
/// not known.
fn reserve(found: &FrameAnalysis) -> f64 {
    let Some(margins) = &found.margins else {
        return f64::INFINITY;
    };
    let of_tilt = || [&margins.tilt.left, &margins.tilt.right].into_iter().filter_map(Margin::at);
    margins.load_factor.at().unwrap_or_else(|| of_tilt().fold(f64::INFINITY, f64::min))
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
