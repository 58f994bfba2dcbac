//! How a value of drystone is computed: one margin, one verdict, or a search between two values.

use drystone::Analysis;
use drystone::analysis::{
    FrameAnalysis, Margin, MarginKind, MarginKinds, Margins, Options, Verdict,
};
use serde_json::Value;

use crate::structure::scene;

/// The first frame with all its forces.
pub fn frame(file: &Value) -> FrameAnalysis {
    Analysis::new(scene(file)).frames.remove(0)
}

fn margins(file: &Value, kind: MarginKind) -> Margins {
    let asked = Options::default()
        .margins(true)
        .margin_kinds(MarginKinds::new(&[kind]));
    let mut frames = Analysis::with(scene(file), &asked).frames;
    frames.remove(0).margins.expect("margins were asked for")
}

fn at(margin: &Margin) -> f64 {
    margin.at().unwrap_or_else(|| panic!("{margin:?}"))
}

/// The least friction coefficient.
pub fn friction(file: &Value) -> f64 {
    at(&margins(file, MarginKind::Friction).friction)
}

/// The largest tilt to the right, degrees.
pub fn tilt(file: &Value) -> f64 {
    at(&margins(file, MarginKind::Tilt).tilt.right)
}

/// The largest horizontal load to the right, as a share of the weights.
pub fn horizontal(file: &Value) -> f64 {
    at(&margins(file, MarginKind::HorizontalLoad)
        .horizontal_load
        .right)
}

/// 1 if the first frame stands only by wedging, otherwise 0.
pub fn only_by_wedging(file: &Value) -> f64 {
    let asked = Options::default().wedging(true);
    let frame = Analysis::with(scene(file), &asked).frames.remove(0);
    f64::from(u8::from(frame.only_by_wedging == Some(true)))
}

/// Whether the first frame stands; neither forces nor failures are computed.
pub fn stands(file: &Value) -> bool {
    let asked = Options::default().verdict_only(true);
    let frame = Analysis::with(scene(file), &asked).frames.remove(0);
    assert_ne!(frame.verdict, Verdict::Undecided, "{}", frame.doubt());
    frame.verdict == Verdict::Stable
}

/// The value between one that `falls` and one that `stands` at which the verdict changes, to `within`.
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
