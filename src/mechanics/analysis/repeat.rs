//! Frames in the same state are analysed at most twice, and share their results: a scene may have thousands of steps that
//! change nothing. The second analysis says how much it takes from the first, and a third would say the same.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{Analysis, FrameAnalysis};
use crate::mechanics::scene::{Frame, Scene};

/// Returns for each frame the index of the frame whose results it has: its own, or that of the second frame in the same
/// state.
pub(super) fn source_of_each(frames: &[Frame]) -> Vec<usize> {
    let mut known = BTreeMap::new();
    let mut source = Vec::with_capacity(frames.len());
    for (number, frame) in frames.iter().enumerate() {
        let holds = frame.holds.iter().map(|h| (h.robot, h.block, [h.at.x, h.at.y].map(f64::to_bits), h.at_centroid));
        let (count, latest) = known.entry((&frame.placed, holds.collect::<Vec<_>>())).or_insert((0, number));
        if *count < 2 {
            (*count, *latest) = (*count + 1, number);
        }
        source.push(*latest);
    }
    source
}

/// Returns the scene with only those frames that have their own results.
pub(super) fn without_repeats(scene: &Arc<Scene>, source: &[usize]) -> Arc<Scene> {
    let own = || source.iter().enumerate().filter(|(number, source)| number == *source);
    if own().count() == source.len() {
        return scene.clone();
    }
    let frames = own().map(|(number, _)| scene.frames[number].clone()).collect();
    Arc::new(Scene { frames, ..Scene::clone(scene) })
}

/// Returns the results of every frame. `own` are those of the frames that have their own.
pub(super) fn with_repeats(mut own: Vec<FrameAnalysis>, source: &[usize]) -> Vec<Arc<FrameAnalysis>> {
    // A frame has about 2 kB without its lists, so the list of many frames shrinks while they move.
    let mut moved = Vec::with_capacity(own.len());
    while let Some(frame) = own.pop() {
        moved.push(Arc::new(frame));
        if own.len().is_multiple_of(1024) {
            own.shrink_to_fit();
        }
    }
    shared(moved.into_iter().rev(), source)
}

/// Returns the results of every frame, which frames with the same source share.
fn shared(mut own: impl Iterator<Item = Arc<FrameAnalysis>>, source: &[usize]) -> Vec<Arc<FrameAnalysis>> {
    let mut all: Vec<Arc<FrameAnalysis>> = Vec::with_capacity(source.len());
    for (number, source) in source.iter().enumerate() {
        all.extend(if *source == number { own.next() } else { Some(all[*source].clone()) });
    }
    all
}

impl Analysis {
    /// Returns `of` for each frame, by its number from 0. It is computed for the first of all frames that share their
    /// results, and the others have the same: it must follow from the state and the results of a frame.
    pub(crate) fn of_each<T: Clone>(&self, mut of: impl FnMut(usize) -> T) -> Vec<T> {
        let mut known = BTreeMap::new();
        let frames = self.frames.iter().enumerate();
        frames.map(|(number, frame)| known.entry(Arc::as_ptr(frame)).or_insert_with(|| of(number)).clone()).collect()
    }

    /// Changes the results of each frame. Frames that share their results are changed once, as the first of them, and
    /// still share them. `change` has the number of the frame, from 0, and the scene to which its results belong.
    pub(crate) fn change_each(&mut self, mut change: impl FnMut(usize, &Arc<Scene>, &mut Arc<FrameAnalysis>)) {
        let first = self.of_each(|number| number);
        // Results that are held only once are changed in place.
        let frames = std::mem::take(&mut self.frames).into_iter().enumerate();
        let mut own: Vec<_> = frames.filter(|(number, _)| first[*number] == *number).collect();
        for (number, frame) in &mut own {
            change(*number, self.scene_of(*number), frame);
        }
        self.frames = shared(own.into_iter().map(|(_, frame)| frame), &first);
    }
}
