//! [`governing`] finds the governing step of a scene. [`headline_words`] states the most important margin of a frame.

use super::bullet;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, Verdict};
use crate::mechanics::scene::Scene;
use crate::products::wording::headline::headline;
use crate::products::wording::margin::{Parameter, StatedMargin, stated};
use crate::text::line;

/// Returns the index of the governing step, from 0. This is the first step that falls. If no step falls, it is the
/// first undecided step. If all steps stand, it is the step whose headline margin has the smallest relative reserve.
pub(super) fn governing(analysis: &Analysis) -> usize {
    let of = |verdict| analysis.frames.iter().position(|f| f.verdict == verdict);
    let first = of(Verdict::Unstable).or_else(|| of(Verdict::Undecided));
    first.unwrap_or_else(|| {
        let reserve = |number: &usize| {
            let bars = bullet::margin_bars(&analysis.scene, &analysis.frames[*number]);
            bars.first().map_or(1.0, |bar| bar.reserve)
        };
        // If several steps have the same reserve, the last of them governs, because it usually has the most blocks.
        let steps = (0..analysis.frames.len()).rev();
        steps.min_by(|a, b| reserve(a).total_cmp(&reserve(b))).unwrap_or(0)
    })
}

/// Returns the most important margin of a frame as a sentence without a full stop; empty if no margin was computed.
pub(super) fn headline_words(scene: &Scene, number: usize, frame_analysis: &FrameAnalysis) -> String {
    let placed = &scene.frames[number].placed;
    let loads = scene.loads.iter().filter(|l| placed.contains(&l.block)).count();
    let margins = stated(scene, frame_analysis);
    let first = margins.first();
    let Some(first) = first else {
        return String::new();
    };
    let mut words = headline(first, frame_analysis.verdict, loads);
    let load = margins.iter().skip(1).find(|m| m.parameter == Parameter::LoadFactor);
    if load.is_some_and(StatedMargin::has_no_limit) {
        let load = if loads == 1 { "load" } else { "loads" };
        words.push_str(&format!(" and carries any multiple of its {load}"));
    }
    line(&words)
}
