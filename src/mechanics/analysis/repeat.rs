//! Frames in the same state are analysed at most twice, and share their results: a scene may have thousands of steps that
//! change nothing. The second analysis says how much it takes from the first, and a third would say the same.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::FrameAnalysis;
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
    let mut all: Vec<Arc<FrameAnalysis>> = Vec::with_capacity(source.len());
    for (number, source) in source.iter().enumerate() {
        all.extend(if *source == number { moved.pop() } else { Some(all[*source].clone()) });
    }
    all
}
