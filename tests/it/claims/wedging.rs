//! The statements about structures that stand only by wedging.

use drystone::analysis::Options;
use serde_json::{Value, json};

use super::{Checked, check, check_with, list, number};
use crate::structure::{block, harmonic, rectangle, wall};

/// `only_by_wedging` is absent if it was not requested or if the frame falls. Otherwise the entry `wedging` of
/// `effects` states the reason.
#[test]
fn wedging_is_reported_with_its_reason() {
    let with_wedging = Options::default().wedging(true);
    let between = json!({ "drystone": 1, "friction": 0.7,
        "ground": [{ "polygon": rectangle(-2.0, -2.0, 2.0, 4.0) }, { "polygon": rectangle(3.0, -2.0, 2.0, 4.0) }],
        "blocks": [block("bar", rectangle(0.0, 0.0, 3.0, 0.5), 7.0)] });
    let frame = |checked: &Checked| checked.json["frames"][0].clone();
    let why = |frame: &Value| {
        let effect = list(&frame["effects"]).iter().find(|e| e["effect"] == "wedging");
        effect.expect("every effect is listed")["why"].as_str().expect("words").to_string()
    };
    assert!(frame(&check(&between)).get("only_by_wedging").is_none());
    let wedged = frame(&check_with(&between, &with_wedging));
    assert_eq!(wedged["only_by_wedging"], json!(true));
    // Friction of 0.7 must carry 7 N, so both faces together press with at least 10 N.
    assert!(why(&wedged).contains("sum to 10 N"), "{}", why(&wedged));
    assert!(why(&wedged).contains("these blocks move: bar (they press no contact)"), "{}", why(&wedged));
    let stands = frame(&check_with(&wall(2, 2), &with_wedging));
    assert_eq!(stands["only_by_wedging"], json!(false));
    let falls = frame(&check_with(&harmonic(4, 1.1), &with_wedging));
    assert!(falls.get("only_by_wedging").is_none());
}

/// The certificate that a frame stands only by wedging is checked with the result alone: with its interfaces, their
/// forces and two motions.
#[test]
fn the_certificate_of_wedging_is_checked_from_the_result_alone() {
    let with_wedging = Options::default().wedging(true);
    let walls = json!([{ "polygon": rectangle(-2.0, -2.0, 2.0, 4.0) }, { "polygon": rectangle(3.0, -2.0, 2.0, 4.0) }]);
    // Friction of μ must carry the weight, so both faces together press with at least weight/μ.
    for (mu, weight) in [(0.7, 7.0), (0.25, 3.0)] {
        let least = weight / mu;
        let file = json!({ "drystone": 1, "friction": mu, "ground": walls,
            "blocks": [block("bar", rectangle(0.0, 0.0, 3.0, 0.5), weight)] });
        let checked = check_with(&file, &with_wedging);
        let frame = &checked.json["frames"][0];
        assert_eq!(frame["only_by_wedging"], json!(true));
        let wedging = &frame["wedging"];
        let at_least = number(&wedging["normal_force_at_least"]);
        assert!((at_least - least).abs() < 1e-6 * least, "{wedging}");
        let interfaces = list(&frame["interfaces"]);
        let mut must = vec![false; interfaces.len()];
        for face in list(&wedging["must_press"]) {
            let k = face["interface"].as_u64().expect("a number") as usize;
            assert_eq!(face["bodies"], interfaces[k]["bodies"]);
            must[k] = true;
        }
        let pair = |v: &Value| [number(&v[0]), number(&v[1])];
        let velocity = |motion: &Value, body: &Value, at: [f64; 2]| {
            let of = list(motion).iter().find(|m| m["block"] == *body);
            of.map_or([0.0, 0.0], |m| {
                let ([x, y], [u, v], spin) = (pair(&m["at"]), pair(&m["velocity"]), number(&m["spin"]));
                [u - spin * (at[1] - y), v + spin * (at[0] - x)]
            })
        };
        // The velocities at which a face opens and slides at an application point.
        let apart = |motion: &Value, face: &Value, point: usize| {
            let at = pair(&face["application_points"][point]);
            let [on, from] = [0, 1].map(|side| velocity(motion, &face["bodies"][side], at));
            let ([x, y], [u, v]) = (pair(&face["normal"]), [on[0] - from[0], on[1] - from[1]]);
            (x * u + y * v, x * v - y * u)
        };
        let (mut power, mut pressed) = (0.0, 0.0);
        for (face, must) in interfaces.iter().zip(&must) {
            let normal = [0, 1].map(|k| number(&face["normal_forces"][k]));
            for (point, normal) in normal.into_iter().enumerate() {
                // In the motion `gives_way`, only the listed faces move apart or slide, and no face is pressed.
                let (opens, slides) = apart(&wedging["gives_way"], face, point);
                assert!(opens > -1e-5, "{face}");
                assert!(*must || opens.abs().max(slides.abs()) < 1e-5, "{face}");
                // In the motion `bound`, the other faces take no power, and each newton on a listed face takes at
                // most 1.
                let (opens, slides) = apart(&wedging["bound"], face, point);
                let taken = number(&face["mu"]) * slides.abs() - opens;
                assert!(taken < f64::from(u8::from(*must)) + 1e-6, "{taken} {face}");
                power -= normal * opens;
            }
            let (_, slides) = apart(&wedging["bound"], face, 0);
            power -= number(&face["friction_force"]) * slides;
            pressed += if *must { normal[0] + normal[1] } else { 0.0 };
        }
        assert_eq!(wedging["presses_nothing"], json!(true));
        // The contact forces take the power of the loads. So in any balance, the listed faces press with at least
        // this force.
        assert!((power - at_least).abs() < 1e-5 * at_least, "{power} {at_least}");
        assert!(pressed > (1.0 - 1e-6) * at_least, "{pressed} {at_least}");
    }
}
