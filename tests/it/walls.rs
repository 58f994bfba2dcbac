//! Dams and walls: the factors of safety against sliding and overturning, the pressures at the base, and loads that are fixed
//! in one direction. The numbers are those of public exercises, whose data the scenes have.

use drystone::Scene;
use drystone::analysis::{Analysis, End, FrameAnalysis, Interval, MarginKind, MarginKinds, Options, Verdict};
use drystone::certificate::Certificate;
use serde_json::{Value, json};

fn analysed(file: &Value) -> FrameAnalysis {
    let scene = Scene::from_json(&file.to_string()).unwrap_or_else(|problems| panic!("{problems}"));
    (*Analysis::with(scene, &Options::default().margins(MarginKinds::ALL)).frames[0]).clone()
}

fn factor(found: &FrameAnalysis, kind: MarginKind) -> f64 {
    found.margins.as_ref().and_then(|margins| margins.most(kind)).unwrap_or_else(|| panic!("no {kind:?}"))
}

/// A wall on level ground, with its weight in kN/m³ and one pressure.
fn wall(outline: &Value, unit_weight: f64, friction: f64, load: &Value) -> Value {
    json!({ "drystone": 1, "units": { "force": "kN" }, "friction": friction,
        "ground": [{ "polygon": [[-5, -1], [15, -1], [15, 0], [-5, 0]] }],
        "blocks": [{ "id": "wall", "polygon": outline, "density": unit_weight * 1e3 / 9.81 }], "loads": [load] })
}

/// A concrete dam of 23 kN/m³ holds 3 m of water: μN/H = 0.7 · 82.8 / 44.1; overturning M_r / M_o about the toe.
fn dam() -> Value {
    let water = json!({ "block": "wall", "side": "left", "pressure": { "surface": 3, "unit_weight": 9.81 } });
    wall(&json!([[0, 0], [1.8, 0], [0.6, 3], [0, 3]]), 23.0, 0.7, &water)
}

#[test]
fn a_dam_and_a_wall_have_their_published_factors_of_safety() {
    let found = analysed(&dam());
    assert!((factor(&found, MarginKind::Sliding) - 1.3129).abs() < 1e-4);
    assert!((factor(&found, MarginKind::Overturning) - 2.1570).abs() < 1e-4);
    // It slides before it turns over, so the factor of all conditions together is that of sliding.
    assert!((factor(&found, MarginKind::LoadFactor) - factor(&found, MarginKind::Sliding)).abs() < 1e-6);
    // By hand, moments about the end of the middle third, 0.6 m from the toe; the water acts at a height of 1 m.
    let (weight, water): (f64, f64) = (82.8, 9.81 * 3.0 * 3.0 / 2.0);
    let about_toe = 23.0 * (0.6 * 3.0 * 1.5 + 0.5 * 1.2 * 3.0 * 0.8);
    let wanted = (about_toe - weight * 0.6) / (water * 1.0);
    assert!((factor(&found, MarginKind::MiddleThird) - wanted).abs() < 1e-4, "{wanted}");
    // 1.6 m of earth behind a wall of 24 kN/m³, which leans on it.
    let earth = json!({ "block": "wall", "side": "right",
        "pressure": { "surface": 1.6, "unit_weight": 18, "coefficient": 0.490_290_596_566 } });
    let found = analysed(&wall(&json!([[0, 0], [0.8, 0], [0.8, 1.6], [0.4, 1.6]]), 24.0, 0.7, &earth));
    assert!((factor(&found, MarginKind::Sliding) - 1.4277).abs() < 2e-4, "{}", factor(&found, MarginKind::Sliding));
    assert!(
        (factor(&found, MarginKind::Overturning) - 1.8696).abs() < 2e-4,
        "{}",
        factor(&found, MarginKind::Overturning)
    );
    // A smooth joint cannot slide either.
    let mut smooth = dam();
    smooth["friction"] = json!(0);
    assert!((factor(&analysed(&smooth), MarginKind::Overturning) - 2.1570).abs() < 1e-4);
}

#[test]
fn the_base_of_a_wall_has_its_published_pressures() {
    let earth = json!({ "block": "wall", "side": "left", "pressure": { "surface": 6, "unit_weight": 16, "coefficient": 1.0 / 3.0 } });
    let found = analysed(&wall(&json!([[0, 0], [3.5, 0], [1.5, 6], [0, 6]]), 22.5, 0.6, &earth));
    let contact = &found.contacts[0];
    let [toe, heel] = contact.pressure(1.0).expect("it presses");
    assert!((contact.resultant.at.x - 1.8856).abs() < 1e-4);
    assert!((toe / 1e3 - 118.8).abs() < 0.05 && (heel / 1e3 - 74.0).abs() < 0.05, "{toe}, {heel}");
    assert_eq!(contact.is_in_middle_third(), Some(true));
    // Outside of the middle third only a part presses: twice the mean pressure over three times the distance from the end.
    let push = json!({ "block": "wall", "force": [-10, 0], "at": [0.5, 2.0] });
    let found = analysed(&wall(&json!([[0, 0], [1, 0], [1, 2], [0, 2]]), 25.0, 1.0, &push));
    let [left, right] = found.contacts[0].pressure(2.0).expect("it presses");
    // N = 50 kN at 0.5 − 20/50 = 0.1 m from the left end.
    let (near, far) = (left.max(right), left.min(right));
    assert!((near - 2.0 * 50e3 / (3.0 * 0.1) / 2.0).abs() < 1.0 && far == 0.0, "{left}, {right}");
    assert_eq!(found.contacts[0].is_in_middle_third(), Some(false));
}

/// A block of 60 N, 1 m wide: a push of 20 N to the right at 1.5 m, with 30 N downwards that stay.
#[test]
fn a_load_may_be_fixed_in_one_direction() {
    let file = |fixed: Value, gravity: [f64; 2], push: [f64; 2]| {
        json!({ "drystone": 1, "friction": 0.6, "gravity": gravity,
            "ground": [{ "polygon": [[-3, -1], [5, -1], [5, 0], [-3, 0]] }],
            "blocks": [{ "id": "w", "polygon": [[0, 0], [1, 0], [1, 2], [0, 2]], "weight": 60 }],
            "loads": [{ "id": "p", "block": "w", "force": push, "at": [0.25, 1.5], "fixed": fixed }] })
    };
    let vertical = file(json!("vertical"), [0.0, -9.81], [20.0, -30.0]);
    let found = analysed(&vertical);
    // μ (W + V) / H, and (W · 0.5 + V · 0.75) / (H · 1.5).
    assert!((factor(&found, MarginKind::Sliding) - 2.7).abs() < 1e-6);
    assert!((factor(&found, MarginKind::Overturning) - 1.75).abs() < 1e-6);
    assert!((factor(&found, MarginKind::LoadFactor) - 1.75).abs() < 1e-6);
    // The same with the weight and the fixed part as loads of their own.
    let mut parts = vertical.clone();
    parts["loads"] = json!([{ "block": "w", "force": [20, 0], "at": [0.25, 1.5] },
        { "block": "w", "force": [0, -30], "at": [0.25, 1.5], "fixed": true }]);
    let other = analysed(&parts);
    for kind in [MarginKind::LoadFactor, MarginKind::Sliding, MarginKind::Overturning, MarginKind::MiddleThird] {
        assert!((factor(&found, kind) - factor(&other, kind)).abs() < 1e-7, "{kind:?}");
    }
    // Across gravity: only the vertical part grows, without a limit.
    let found = analysed(&file(json!("horizontal"), [0.0, -9.81], [20.0, -30.0]));
    let interval = found.margins.as_ref().and_then(|margins| margins.of(MarginKind::LoadFactor));
    assert!(matches!(interval, Some(Interval::Between { high: End::Unbounded, .. })), "{interval:?}");
    // Load cases multiply the whole load, and the answer names the case.
    let mut cased = vertical.clone();
    cased["cases"] = json!([{ "id": "half", "loads": { "p": 0.5 } }, { "id": "all", "loads": { "p": 1 } }]);
    let found = analysed(&cased);
    assert!((factor(&found, MarginKind::Sliding) - 2.7).abs() < 1e-6);
    let margin = found.margins.as_ref().and_then(|margins| margins.margin(MarginKind::Sliding)).expect("a margin");
    assert_eq!(margin.conditions[1].case, Some(1));
    // A certificate has both parts, and proves all margins.
    let scene = Scene::from_json(&vertical.to_string()).expect("a scene");
    let mut analysis = Analysis::with(scene, &Options::default().margins(MarginKinds::ALL));
    let certificate = Certificate::new(&mut analysis, String::new(), true);
    let checked = certificate.check().expect("a sound certificate");
    assert!(checked.is_exact() && checked.limits.len() > 10, "{:?}", checked.limits);
}

#[test]
fn a_load_is_fixed_in_no_other_direction() {
    let mut file = dam();
    file["loads"][0]["fixed"] = json!("upwards");
    let problems = Scene::from_json(&file.to_string()).expect_err("no such direction").to_string();
    assert!(problems.contains("vertical") && problems.contains("horizontal"), "{problems}");
    file["loads"][0]["fixed"] = json!(1);
    let problems = Scene::from_json(&file.to_string()).expect_err("no such direction").to_string();
    assert!(problems.contains("\"vertical\" or \"horizontal\""), "{problems}");
}

/// A part without loads decides too: it must have forces within the middle third of its joints.
#[test]
fn a_part_without_loads_counts_in_the_middle_third() {
    let mut file = dam();
    file["blocks"] = json!([file["blocks"][0],
        { "id": "low", "polygon": [[8, 0], [9, 0], [9, 1], [8, 1]], "weight": 10 },
        { "id": "off", "polygon": [[8.4, 1], [9.4, 1], [9.4, 2], [8.4, 2]], "weight": 10 }]);
    let found = analysed(&file);
    assert_eq!(found.verdict, Verdict::Stable);
    // The upper stone stands 0.4 m beside the lower one: its weight is outside of the middle third of their joint.
    let interval = found.margins.as_ref().and_then(|margins| margins.of(MarginKind::MiddleThird));
    assert!(matches!(interval, Some(Interval::Empty(excluded)) if !excluded.is_empty()), "{interval:?}");
    assert!((factor(&found, MarginKind::Sliding) - 1.3129).abs() < 1e-4);
}
