//! Cases close to the limit between standing and falling. Outside the tolerance, verdicts are decided and right, and
//! every fall is proved.

use drystone::analysis::{FrameAnalysis, Proof, Verdict};
use serde_json::{Value, json};

use crate::hard::wedge;
use crate::laboratory::study::study;
use crate::structure::{arch, block, first, on_floor, rectangle, scene, verdict, wall};

const STANDS: Verdict = Verdict::Stable;
const FALLS: Verdict = Verdict::Unstable;

/// The scene with an additional horizontal load on every block: `share` times its weight.
fn pushed(mut file: Value, share: f64) -> Value {
    file["gravity"] = json!([10.0 * share, -10.0]);
    for block in file["blocks"].as_array_mut().expect("a list") {
        let weight = block["weight"].as_f64().expect("a number");
        block["weight"] = json!(weight * libm::hypot(1.0, share));
    }
    file
}

/// The sum of forces below which the proof excludes a balance, relative to the loads. The frame must fall.
fn rules_out(frame: &FrameAnalysis) -> f64 {
    assert_eq!(frame.verdict, FALLS, "{}", frame.doubt());
    frame.proof.excluded_force_sum()
}

/// A wall of 410 bricks that falls if the horizontal load exceeds 0.481616 of the weights. Near this limit, programs
/// that must decide between "balanced" and "no balance" end without an answer. Motions that violate contacts by a
/// ten-thousandth of their speed look like a fall.
#[test]
fn a_large_wall_is_decided_on_both_sides_of_its_limit() {
    for share in [0.4815, 0.4816157] {
        let frame = first(&pushed(wall(20, 20), share));
        assert_eq!(frame.verdict, STANDS, "{share}: {:?}", frame.proof);
    }
    for share in [0.481617, 0.482] {
        let frame = first(&pushed(wall(20, 20), share));
        assert!(rules_out(&frame) > 1e12, "{share}: {:?} {}", frame.proof, frame.doubt());
    }
}

/// `THINNEST` was found by bisection with a certified reference. Verdicts are checked at a thickness smaller and
/// larger by a millionth of the radius.
#[test]
fn an_arch_is_decided_a_millionth_from_its_minimum_thickness() {
    for (voussoirs, least) in THINNEST {
        for (thickness, expected) in [(least - 1e-6, FALLS), (least + 1e-6, STANDS)] {
            let file = arch(voussoirs, thickness, 0.9);
            assert_eq!(verdict(&file), expected, "{voussoirs} at {thickness}");
            let known = study(&[("arch".into(), scene(&file))], &[], &mut |_| {}).cases.remove(0).truth;
            assert_eq!(known.verdict, expected, "{voussoirs} at {thickness}");
        }
    }
}

/// Numbers of voussoirs, and the ratio of the minimum thickness to the radius of such a semicircular arch.
const THINNEST: [(usize, f64); 2] = [(27, 0.106_720_9), (181, 0.107_462_3)];

/// When an inverted wedge falls, its contacts open by as little as a ten-millionth of the distance. This is no more
/// than the error of a solver.
#[test]
fn a_flat_wedge_that_falls_is_proved_to_fall() {
    for exponent in 2..=7 {
        let half_angle = libm::exp10(-f64::from(exponent));
        let frame = first(&wedge(-half_angle));
        assert!(rules_out(&frame).is_infinite(), "1e-{exponent}: {:?}", frame.proof);
        // The upright wedge stands. Here a force that is slightly larger than its weight lifts it.
        let mut file = wedge(half_angle);
        file["loads"] = json!([{ "block": "wedge", "force": [0, 6.0 * (1.0 + 1e-5)] }]);
        let frame = first(&file);
        assert!(rules_out(&frame).is_infinite(), "1e-{exponent}: {:?}", frame.proof);
    }
}

/// A very flat wedge stands in its notch, but 16 digits are too few to balance its thrust. A motion into the notch
/// violates the contacts by less than the error of a solver, and must not be reported as a fall.
#[test]
fn a_wedge_too_flat_for_sixteen_digits_is_not_reported_as_unstable() {
    for exponent in 8..=13 {
        let frame = first(&wedge(libm::exp10(-f64::from(exponent))));
        assert_ne!(frame.verdict, FALLS, "1e-{exponent}: {:?}", frame.proof);
    }
}

/// Several blocks locked between two walls: their thrust is unbounded, and no motion opens every contact.
#[test]
fn a_row_of_blocks_between_walls_stands_only_with_friction() {
    let row = |friction: f64| {
        let blocks: Vec<Value> =
            (0..5).map(|k| block(&format!("{k}"), rectangle(f64::from(k), 0.0, 1.0, 1.0), 6.0)).collect();
        let sides = [-2.0, 5.0].map(|x| json!({ "polygon": rectangle(x, -1.0, 2.0, 3.0) }));
        json!({ "drystone": 1, "friction": friction, "ground": sides, "blocks": blocks })
    };
    for friction in [0.02, 0.5] {
        let frame = first(&row(friction));
        assert_eq!(frame.verdict, STANDS, "{friction}: {}", frame.doubt());
        // The friction at each wall carries half of the weight, 15 N.
        let ends = frame.contacts.iter().filter(|c| c.friction_force.abs() > 14.9);
        let thrust: Vec<f64> = ends.map(|c| c.normal_forces[0] + c.normal_forces[1]).collect();
        assert_eq!(thrust.len(), 2, "{friction}");
        for pressed in thrust {
            assert!(pressed >= 15.0 / friction * (1.0 - 1e-9), "{friction}: {pressed}");
        }
    }
    // Without friction they fall and slide along faces that cannot open. This is proved only up to rounding.
    let frame = first(&row(0.0));
    assert!(rules_out(&frame) > 1e12, "{:?}", frame.proof);
    // In a gap that narrows downwards, a wedge stands without any friction.
    assert_eq!(verdict(&wedge(1e-3)), STANDS);
}

/// A proof by a motion excludes every balance whose forces sum to less than its power divided by its worst violation.
#[test]
fn a_motion_excludes_balances_with_small_forces() {
    let file = on_floor(0.5, vec![block("a", rectangle(0.0, 1.0, 1.0, 1.0), 6.0)]);
    assert!(rules_out(&first(&file)).is_infinite(), "nothing touches it");
    let doubtful = Proof::Mechanism { power: 0.25, worst_violation: 1e-4 };
    assert_eq!(doubtful.excluded_force_sum(), 2500.0);
    assert!(!doubtful.holds(), "forces of 2500 loads do occur");
}
