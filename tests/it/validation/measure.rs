//! How a value of drystone is computed: from a margin, from a verdict, or by bisection between two values.

use std::sync::Arc;

use drystone::Analysis;
use drystone::analysis::{FrameAnalysis, MarginKind, MarginKinds, Options, Verdict};
use serde_json::Value;

use crate::structure::scene;

/// The first frame with all its forces.
pub fn frame(file: &Value) -> Arc<FrameAnalysis> {
    Analysis::new(scene(file)).frames.remove(0)
}

/// The lower and the upper end of the interval of a parameter.
fn ends(file: &Value, kind: MarginKind) -> [f64; 2] {
    let options = Options::default().margins(MarginKinds::new(&[kind]));
    let frames = Analysis::with(scene(file), &options).frames;
    let margins = frames[0].margins.as_ref().expect("margins were requested");
    [margins.least(kind), margins.most(kind)].map(|end| end.unwrap_or(f64::NAN))
}

/// The least friction coefficient.
pub fn friction(file: &Value) -> f64 {
    ends(file, MarginKind::Friction)[0]
}

/// The largest tilt to the right, degrees.
pub fn tilt(file: &Value) -> f64 {
    ends(file, MarginKind::Tilt)[1]
}

/// The largest horizontal load to the right, as a fraction of the weights.
pub fn horizontal(file: &Value) -> f64 {
    ends(file, MarginKind::HorizontalLoad)[1]
}

/// 1 if the first frame stands only by wedging, otherwise 0.
pub fn only_by_wedging(file: &Value) -> f64 {
    let options = Options::default().wedging(true);
    let frame = Analysis::with(scene(file), &options).frames.remove(0);
    f64::from(u8::from(frame.only_by_wedging == Some(true)))
}

/// Whether the first frame stands. Neither forces nor failures are computed.
pub fn stands(file: &Value) -> bool {
    let options = Options::default().verdict_only(true);
    let frame = Analysis::with(scene(file), &options).frames.remove(0);
    assert_ne!(frame.verdict, Verdict::Undecided, "{}", frame.doubt());
    frame.verdict == Verdict::Stable
}

/// The value at which the verdict changes, between a value with which the scene falls and one with which it stands.
/// The error is at most `within`.
pub fn limit([falls, stood]: [f64; 2], within: f64, file: impl Fn(f64) -> Value) -> f64 {
    let (mut falls, mut stood) = (falls, stood);
    while (stood - falls).abs() > within {
        let middle = 0.5 * (falls + stood);
        if stands(&file(middle)) {
            stood = middle;
        } else {
            falls = middle;
        }
    }
    stood
}
