//! [`SolvedFrame`]: the results of a frame, and the scene to which these results belong.
//!
//! With load cases, the forces of a frame balance the weights and loads of its worst case, and each frame may have another
//! worst case. Code that needs results and their scene gets both together, from [`Analysis::at`] or [`Analysis::each`].

use std::collections::BTreeMap;
use std::sync::Arc;

use super::condition::Condition;
use super::{Analysis, FrameAnalysis, Interval, MarginKind, Options, Verdict, position};
use crate::mechanics::scene::{Frame, Scene};

/// A frame of an analysis, with its results and the scene to which they belong.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct SolvedFrame<'a> {
    /// The scene with the weights and loads to which the results of the frame belong. With load cases, these are the weights
    /// and loads in the worst case of this frame. If the frame falls under the vehicle, its axles are among the loads.
    pub scene: &'a Scene,
    /// The index of the frame, from 0.
    pub number: usize,
    /// The results of the frame.
    pub found: &'a FrameAnalysis,
}

impl<'a> SolvedFrame<'a> {
    /// Returns the frame in the scene: its title, its blocks and the robots that hold them.
    pub fn frame(&self) -> &'a Frame {
        &self.scene.frames[self.number]
    }

    /// Returns one number that is positive if the frame stands, and negative if it falls: how far the present value of a
    /// parameter is from the end of the interval in which the frame stands, as a share. It serves as the reward of a search.
    ///
    /// | parameter | if the frame stands | if it would stand at another value |
    /// |---|---|---|
    /// | factor on the loads, up to λ | 1 − 1/λ | λ − 1 |
    /// | factor on the friction, from φ | 1 − φ | 1/φ − 1 |
    /// | tilt, up to θ or from θ | θ/90° | −θ/90° |
    /// | horizontal load, up to h or from h | h | −h |
    /// | kernel, up to k; now k₀ | (k − k₀)/(1 − k₀) | k/k₀ − 1 |
    ///
    /// These values lie between −1 and 1. If the interval has two ends, the nearer one counts; 1 means that there is no end.
    /// If the frame stands at no value of the parameter, the number is −1 − M/(M + W), between −1 and −2: M are the missing
    /// forces ([`FrameAnalysis::total_sticking`], and the weights of blocks that nothing supports), W is the weight. It is
    /// therefore less than any number of a frame that the parameter helps.
    ///
    /// The number is a continuous function of the scene wherever the end of the interval is one. It is not continuous where
    /// the number of contacts changes, and where the parameter ceases to help.
    ///
    /// [`MarginKind::Sliding`], [`MarginKind::Overturning`] and [`MarginKind::MiddleThird`] are margins of a changed structure:
    /// their numbers are positive if that structure stands.
    ///
    /// `None` if the margin was not requested, if the frame or the interval is undecided, if only the verdict was requested
    /// and the missing forces are therefore not known, and for [`MarginKind::Friction`] and [`MarginKind::Robots`], which have
    /// no single present value.
    ///
    /// ```
    /// use drystone::{Analysis, Scene, analysis::{MarginKind, MarginKinds, Options}};
    /// let number = |friction: f64, push: f64, kind: MarginKind| {
    ///     let scene = Scene::from_json(&format!(r#"{{ "drystone": 1, "friction": {friction},
    ///         "ground": [{{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }}],
    ///         "blocks": [{{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 8 }}],
    ///         "loads": [{{ "block": "a", "force": [{push}, 0], "at": [1, 1] }}] }}"#))?;
    ///     let analysis = Analysis::with(&scene, &Options::default().margins(MarginKinds::ALL));
    ///     Ok::<f64, drystone::scene::SceneError>(analysis.at(0).signed_margin(kind).expect("decided"))
    /// };
    /// let near = |number: f64, expected: f64| assert!((number - expected).abs() < 1e-6, "{number}");
    /// // The block can carry a push of 4 N: it may be 2 times as large, or must be half as large.
    /// near(number(0.5, 2.0, MarginKind::LoadFactor)?, 0.5);
    /// near(number(0.5, 8.0, MarginKind::LoadFactor)?, -0.5);
    /// near(number(0.5, 8.0, MarginKind::FrictionFactor)?, -0.5);
    /// // Without friction, no factor on it helps: 8 N are missing, as much as the weight.
    /// near(number(0.0, 8.0, MarginKind::FrictionFactor)?, -1.5);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn signed_margin(self, kind: MarginKind) -> Option<f64> {
        let margins = self.found.margins.as_ref().filter(|margins| margins.kinds.has(kind))?;
        if !MarginKind::with_sign().any(|own| own == kind) {
            return None;
        }
        let share = |interval: &Interval| {
            let low = interval.low().map(|end| kind.share(self.scene.kernel, end.stands(f64::NEG_INFINITY), false));
            let high = interval.high().map(|end| kind.share(self.scene.kernel, end.stands(f64::INFINITY), true));
            low.into_iter().chain(high).fold(1.0, f64::min)
        };
        let is_changed = kind.about().structure.is_some();
        match (self.found.verdict, margins.of(kind)) {
            (Verdict::Undecided, _) | (_, Some(Interval::Undecided)) => None,
            (_, Some(interval @ Interval::Between { .. })) if is_changed => Some(share(interval).max(-1.0)),
            (Verdict::Stable, Some(Interval::Empty(_))) if is_changed => Some(-1.0),
            (Verdict::Stable, None) => Some(1.0),
            (Verdict::Stable, Some(Interval::Empty(_))) => Some(0.0),
            (Verdict::Stable, Some(interval)) => Some(share(interval).max(0.0)),
            (Verdict::Unstable, Some(interval @ Interval::Between { .. })) => Some(share(interval).clamp(-1.0, 0.0)),
            (Verdict::Unstable, None | Some(Interval::Empty(_))) => {
                let hanging: f64 = self.found.unsupported.iter().map(|block| self.scene.blocks[block.0].weight).sum();
                let missing = self.found.total_sticking + hanging;
                (missing > 0.0).then(|| -1.0 - missing / (missing + self.found.weight))
            }
        }
    }

    /// Returns the frame with other results for the same weights and loads.
    pub(crate) fn with_results(self, found: &'a FrameAnalysis) -> SolvedFrame<'a> {
        SolvedFrame { found, ..self }
    }
}

impl Analysis {
    /// Returns an analysis without notes, of a scene whose frames have these results.
    pub(crate) fn of_parts(scene: impl Into<Arc<Scene>>, frames: Vec<Arc<FrameAnalysis>>) -> Analysis {
        Analysis { given: scene.into(), of_frames: Vec::new(), frames, options: Options::default(), notes: Vec::new() }
    }

    /// Returns the scene as its author wrote it, with its load cases and its vehicle. Results of a frame may belong to other
    /// weights and loads: [`Analysis::at`] returns their scene.
    pub fn given(&self) -> &Arc<Scene> {
        &self.given
    }

    /// Returns a frame with its results and the scene to which they belong. `number` is counted from 0.
    ///
    /// # Panics
    /// If there is no such frame.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene};
    /// let scene = Scene::from_json(r#"{ "drystone": 1, "friction": 0.5,
    ///     "ground": [{ "polygon": [[0, 0], [9, 0], [9, -1], [0, -1]] }],
    ///     "blocks": [{ "id": "a", "polygon": [[1, 0], [4, 0], [4, 2], [1, 2]], "weight": 6 }],
    ///     "loads": [{ "id": "push", "block": "a", "force": [2, 0], "at": [1, 1] }],
    ///     "cases": [{ "id": "calm", "loads": {} }, { "id": "storm", "loads": { "push": 2 } }] }"#)?;
    /// let analysis = Analysis::new(&scene);
    /// // The author wrote 2 N; the worst case, to which the results belong, has 4 N.
    /// assert_eq!(analysis.given().loads()[0].force.x, 2.0);
    /// assert_eq!(analysis.at(0).scene.loads()[0].force.x, 4.0);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn at(&self, number: usize) -> SolvedFrame<'_> {
        SolvedFrame { scene: self.scene_of(number), number, found: &self.frames[number] }
    }

    /// Returns the scene to which the results of a frame belong.
    pub(super) fn scene_of(&self, number: usize) -> &Arc<Scene> {
        self.of_frames.get(number).unwrap_or(&self.given)
    }

    /// Returns each frame with its results and the scene to which they belong, in order.
    pub fn each(&self) -> impl DoubleEndedIterator<Item = SolvedFrame<'_>> + ExactSizeIterator + Clone {
        (0..self.frames.len()).map(|number| self.at(number))
    }

    /// Returns the scene with the weights and loads of a condition of a frame.
    pub(crate) fn scene_in(&self, number: usize, condition: Condition) -> Arc<Scene> {
        let (scene, found) = (self.scene_of(number), &self.frames[number]);
        let is_of_given = self.of_frames.is_empty() && found.vehicle.is_none();
        if is_of_given || condition == found.condition() {
            return scene.clone();
        }
        let case = condition.case.and_then(|case| self.given.in_cases().nth(case));
        let bare = case.map_or_else(|| Scene::clone(&self.given), |(_, scene)| scene);
        let line = found.vehicle.as_ref().zip(condition.position);
        let loaded = line.and_then(|(line, position)| position::scene_with_axles(&bare, line.positions.get(position)?));
        Arc::new(loaded.unwrap_or(bare))
    }

    /// Returns the analysis of one frame alone, whose scene has only this frame too. `number` is counted from 0. `None`
    /// if there is no such frame.
    pub(crate) fn alone(&self, number: usize) -> Option<Analysis> {
        let frames = vec![self.frames.get(number)?.clone()];
        let given = self.given.alone(number)?.into();
        let own = self.of_frames.get(number).and_then(|scene| scene.alone(number));
        let of_frames = own.into_iter().map(Arc::new).collect();
        Some(Analysis { given, of_frames, frames, options: self.options, notes: self.notes.clone() })
    }

    /// Changes the scene as it was given, and the scenes of all frames, in the same way, such as the names in them.
    pub(crate) fn change_scenes(&mut self, change: impl Fn(&Scene) -> Scene) {
        // Frames share their scenes, and still do afterwards.
        let mut known = BTreeMap::new();
        for scene in std::iter::once(&mut self.given).chain(&mut self.of_frames) {
            // The old scene is kept too, so that no new one gets its address.
            let (_, new) = known.entry(Arc::as_ptr(scene)).or_insert_with(|| (scene.clone(), Arc::new(change(scene))));
            *scene = new.clone();
        }
    }
}
