//! [`SolvedFrame`]: the results of a frame, and the scene to which these results belong.
//!
//! With load cases, the forces of a frame balance the weights and loads of its worst case, and each frame may have another
//! worst case. Code that needs results and their scene gets both together, from [`Analysis::at`] or [`Analysis::each`].

use std::collections::BTreeMap;
use std::sync::Arc;

use super::condition::Condition;
use super::{Analysis, FrameAnalysis, Options, position};
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
