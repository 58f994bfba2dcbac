//! [`lack`] describes what a falling frame lacks to stand, for example which fraction of its load it
//! carries.

use super::super::number::{NO_BREAK, three_down, three_up};
use super::confirmed;
use super::list::friction;
use crate::mechanics::analysis::{FrameAnalysis, Interval, Verdict};
use crate::mechanics::scene::Scene;

/// Describes what a falling frame lacks to stand: `carries 33 % of its load`. Returns `None` if the frame stands or is
/// undecided, or if no computed margin shows what is lacking.
pub(super) fn lack(scene: &Scene, frame_analysis: &FrameAnalysis) -> Option<String> {
    if frame_analysis.verdict != Verdict::Unstable {
        return None;
    }
    let intervals = &frame_analysis.margins.as_ref()?.intervals;
    let loads = intervals.load_factor.as_ref();
    loads
        .and_then(|interval| load_lack(scene, interval))
        .or_else(|| friction_lack(frame_analysis, intervals.friction.as_ref()?))
}

/// Describes which fraction of its loads a falling frame carries, or how many times its loads it would need to stand.
/// Returns `None` if neither is known.
fn load_lack(scene: &Scene, interval: &Interval) -> Option<String> {
    let mut entries: Vec<usize> = scene.loads.iter().map(|load| load.entry).collect();
    entries.dedup();
    let loads = match entries.len() {
        1 => "load",
        _ => "loads",
    };
    let [low, high] = [interval.low()?, interval.high()?].map(confirmed);
    match (low, high) {
        // Round down, so that the frame carries at least the written fraction.
        (_, Some(high)) if high < 1.0 => Some(if high >= 0.01 {
            format!("carries {}{NO_BREAK}% of its {loads}", three_down(100.0 * high))
        } else {
            format!("carries less than 1{NO_BREAK}% of its {loads}")
        }),
        (Some(low), _) if low > 1.0 => Some(format!("would need {} times its {loads}", three_up(low))),
        _ => None,
    }
}

/// Describes the friction coefficient with which a falling frame would stand, or states that no coefficient would hold
/// it. Returns `None` if the smallest present coefficient is large enough, if the margin is undecided, or if there are
/// no interfaces.
fn friction_lack(frame_analysis: &FrameAnalysis, interval: &Interval) -> Option<String> {
    let (least, most) = friction(frame_analysis)?;
    match interval {
        Interval::Empty(_) => Some("no friction coefficient would hold it".to_owned()),
        Interval::Undecided => None,
        Interval::Between { low, .. } => {
            let low = confirmed(low).filter(|low| *low > least)?;
            let everywhere = if least < most { " at every joint" } else { "" };
            Some(format!("would need friction {}{everywhere}", three_up(low)))
        }
    }
}
