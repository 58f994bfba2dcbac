//! The signed margin: a number for frames that stand and for frames that fall.

use drystone::Analysis;
use drystone::analysis::{MarginKind, MarginKinds, Options, Verdict};
use serde_json::{Value, json};

use crate::oracle::random;
use crate::structure::{on_floor, rectangle, scene};

fn number(file: &Value, kind: MarginKind) -> Option<f64> {
    let analysis = Analysis::with(scene(file), &Options::default().margins(MarginKinds::ALL));
    analysis.at(0).signed_margin(kind)
}

fn near(found: Option<f64>, expected: f64) {
    assert!(found.is_some_and(|found| (found - expected).abs() < 2e-6), "{found:?}, not {expected}");
}

/// A block 2 m wide and 4 m high that weighs 8 N, on friction 0.4, with a push at its middle.
fn pushed(push: f64) -> Value {
    json!({ "drystone": 1, "friction": 0.4, "kernel": 0.25, "ground": [{ "polygon": rectangle(-9.0, -1.0, 18.0, 1.0) }],
        "blocks": [{ "id": "a", "polygon": rectangle(0.0, 0.0, 2.0, 4.0), "weight": 8 }],
        "loads": [{ "block": "a", "force": [push, 0], "at": [1, 2] }] })
}

#[test]
fn the_signed_margin_is_the_distance_to_the_limit_on_both_sides() {
    // It slides at 3.2 N. With the kernel 0.25, it topples about a point 0.75 m from its middle, at 8 N · 0.75 m / 2 m = 3 N.
    for push in [0.5, 1.5, 2.999, 3.001, 4.0, 6.0, 30.0] {
        let ratio = 3.0 / push;
        let expected = if ratio >= 1.0 { 1.0 - 1.0 / ratio } else { ratio - 1.0 };
        near(number(&pushed(push), MarginKind::LoadFactor), expected);
        // Nothing but sliding: 3.2 N.
        let ratio = 3.2 / push;
        near(number(&pushed(push), MarginKind::Sliding), if ratio >= 1.0 { 1.0 - 1.0 / ratio } else { ratio - 1.0 });
        near(number(&pushed(push), MarginKind::HorizontalLoad), ((3.0 - push) / 8.0).max(-1.0));
        // With a kernel k, it topples at 8 N · (1 − k) / 2.
        let kernel = 1.0 - push / 4.0;
        let expected = match kernel {
            _ if push > 3.2 => None,
            kernel if kernel >= 0.25 => Some((kernel - 0.25) / 0.75),
            kernel => Some(kernel / 0.25 - 1.0),
        };
        match expected {
            Some(expected) => near(number(&pushed(push), MarginKind::Kernel), expected),
            // No kernel helps against sliding.
            None => {
                assert!(number(&pushed(push), MarginKind::Kernel).is_some_and(|found| found < -1.0 && found > -2.0))
            }
        }
    }
    // No friction keeps it from toppling, and the missing force grows with the push.
    let falls = [4.0, 6.0].map(|push| number(&pushed(push), MarginKind::FrictionFactor).expect("decided"));
    assert!(falls[1] < falls[0] && falls[0] < -1.0, "{falls:?}");
    near(number(&pushed(2.0), MarginKind::FrictionFactor), 1.0 - 2.0 / 3.2);
    // A tilt θ turns the weight by θ, not the push: 8 N · (0.75 m · cos θ ± 2 m · sin θ) = 2 m · push.
    let tilt = number(&pushed(4.0), MarginKind::Tilt).expect("decided");
    let angle = (90.0 * -tilt).to_radians();
    assert!(tilt < 0.0 && (8.0 * (0.75 * libm::cos(angle) + 2.0 * libm::sin(angle)) - 8.0).abs() < 1e-4, "{tilt}");
}

#[test]
fn a_margin_without_meaning_or_without_a_present_value() {
    let standing = on_floor(0.5, vec![json!({ "id": "a", "polygon": rectangle(0.0, 0.0, 2.0, 1.0) })]);
    let hanging = on_floor(0.5, vec![json!({ "id": "a", "polygon": rectangle(0.0, 1.0, 2.0, 1.0) })]);
    near(number(&standing, MarginKind::LoadFactor), 1.0);
    // Its whole weight is missing.
    near(number(&hanging, MarginKind::LoadFactor), -1.5);
    near(number(&hanging, MarginKind::Tilt), -1.5);
    for kind in [MarginKind::Friction, MarginKind::Robots] {
        assert_eq!(number(&standing, kind), None);
    }
    let analysis = Analysis::with(scene(&hanging), &Options::default());
    assert_eq!(analysis.at(0).signed_margin(MarginKind::Tilt), None, "not requested");
}

#[test]
fn the_sign_is_that_of_the_verdict_in_random_scenes() {
    let mut counts = [0; 3];
    for n in 0..60 {
        let analysis = Analysis::with(scene(&random::scene(n).1), &Options::default().margins(MarginKinds::ALL));
        for solved in analysis.each() {
            for kind in [MarginKind::Tilt, MarginKind::LoadFactor, MarginKind::FrictionFactor, MarginKind::Kernel] {
                let Some(number) = solved.signed_margin(kind) else { continue };
                match solved.found.verdict {
                    Verdict::Stable => assert!((0.0..=1.0).contains(&number), "{n} {kind:?} {number}"),
                    _ => assert!(number > -2.0 && number <= 0.0, "{n} {kind:?} {number}"),
                }
                counts[if number >= 0.0 { 0 } else { 1 + usize::from(number < -1.0) }] += 1;
            }
        }
    }
    assert!(counts.iter().all(|count| *count > 10), "{counts:?}");
}
