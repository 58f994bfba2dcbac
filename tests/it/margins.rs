//! Margins are compared with values computed by hand or known from the literature, and with verdicts of changed
//! scenes.

mod robots;
mod signed;

use std::sync::Arc;

use drystone::analysis::{
    EffectName, End, FrameAnalysis, Interval, MarginKind, MarginKinds, Margins, Options, Verdict,
};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::structure::{arch, block, on_floor, on_slope, rectangle, scene, verdict, wall};

fn frames(scene: &Scene) -> Vec<Arc<FrameAnalysis>> {
    let options = Options::default().margins(MarginKinds::ALL);
    Analysis::with(scene, &options).frames
}

fn margins(file: &Value) -> Margins {
    frames(&scene(file))[0].margins.clone().expect("margins were requested")
}

fn thesis(name: &str) -> Vec<Arc<FrameAnalysis>> {
    let path = format!("{}/assets/thesis/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a scene of the source");
    frames(&Scene::from_json(&text).expect("sound"))
}

fn step(name: &str, number: usize) -> Margins {
    thesis(name)[number].margins.clone().expect("margins were requested")
}

/// The lower end of the interval of a parameter.
fn low(found: &Margins, kind: MarginKind) -> End {
    found.of(kind).and_then(Interval::low).expect("an interval").clone()
}

/// The upper end of the interval of a parameter.
fn high(found: &Margins, kind: MarginKind) -> End {
    found.of(kind).and_then(Interval::high).expect("an interval").clone()
}

/// The lower end of the interval of a tilt or a horizontal load, positive to the left.
fn left(found: &Margins, kind: MarginKind) -> End {
    let mut end = low(found, kind);
    if let End::At { value, .. } = &mut end {
        *value = 0.0 - *value;
    }
    end
}

/// True if the frame falls at the present value 0 of a parameter, or at every value, and so has no margin.
fn has_none(found: &Margins, kind: MarginKind) -> bool {
    found.of(kind).is_some_and(|interval| interval.excludes(0.0))
        && (found.least(kind), found.most(kind)) == (None, None)
}

#[track_caller]
fn near(end: &End, expected: f64, within: f64) {
    match end {
        End::At { value, mechanism } => {
            assert!((value - expected).abs() <= within, "{value} instead of {expected}, off by {:e}", value - expected);
            assert!(!mechanism.is_empty() || expected == 0.0, "{value} has no mechanism");
        }
        other => panic!("{other:?} instead of {expected}"),
    }
}

/// A right-angled wedge, tip down, in a notch. The left face of the notch rises at 60°, the right one at 30°.
fn wedge(friction: f64) -> Value {
    let (left, right) = (-1.0 / libm::sqrt(3.0), libm::sqrt(3.0));
    json!({ "drystone": 1, "friction": friction,
        "ground": [{ "polygon": [[-3, -1], [3, -1], [3, 1], [right, 1], [0, 0], [left, 1], [-3, 1]] }],
        "blocks": [{ "id": "wedge", "polygon": [[0, 0], [right, 1], [left, 1]], "weight": 6 }] })
}

/// Tilted to the right, the wedge leaves the left face and slides up the right one. This begins at a tilt of the
/// slope of that face plus the friction angle.
#[test]
fn a_wedge_leaves_its_notch_at_the_slope_of_a_face_plus_the_friction_angle() {
    for friction in [0.2, 0.5, 0.7] {
        let found = margins(&wedge(friction));
        let angle = libm::atan(friction).to_degrees();
        near(&high(&found, MarginKind::Tilt), 30.0 + angle, 1e-6);
        near(&left(&found, MarginKind::Tilt), 60.0 + angle, 1e-6);
        near(&low(&found, MarginKind::Friction), 0.0, 0.0);
        assert_eq!(found.of(MarginKind::LoadFactor), None);
    }
}

#[test]
fn a_block_on_a_slope_slides_down_or_up() {
    let file = on_slope(30.0, 4.0, 0.5, 0.8, 0.0);
    let found = margins(&file);
    let angle = libm::atan(0.8).to_degrees();
    // The slope rises to the right, so the block slides down to the left.
    near(&left(&found, MarginKind::Tilt), angle - 30.0, 1e-6);
    near(&high(&found, MarginKind::Tilt), angle + 30.0, 1e-6);
    let tan = |degrees: f64| libm::tan(degrees.to_radians());
    near(&left(&found, MarginKind::HorizontalLoad), tan(angle - 30.0), 1e-7);
    near(&high(&found, MarginKind::HorizontalLoad), tan(angle + 30.0), 1e-5);
    near(&low(&found, MarginKind::Friction), tan(30.0), 1e-6);
    // The line of action of the weight meets the contact, 4 m long, at 2 − 0.25·tan 30° from its nearer end.
    near(&high(&found, MarginKind::Kernel), 1.0 - 0.25 * tan(30.0) / 2.0, 1e-6);
}

#[test]
fn figure_6_stands_up_to_a_kernel_of_a_quarter() {
    near(&high(&step("figure-6-kernel-0", 1), MarginKind::Kernel), 0.25, 1e-6);
    near(&low(&step("figure-6-kernel-02", 1), MarginKind::Friction), 0.3464, 5e-5);
    // In the first frame, the centre of gravity lies above a corner: the link stands, but its tilt margin to that
    // side is 0.
    let upright = step("figure-6-kernel-0", 0);
    let least = [left(&upright, MarginKind::Tilt), high(&upright, MarginKind::Tilt)]
        .map(|end| end.value().expect("a tilt at which it falls"));
    assert_eq!(least[0].min(least[1]), 0.0);
    assert!(least[0].max(least[1]) > 1.0);
}

#[test]
fn figure_3b_needs_little_friction() {
    near(&low(&step("figure-3b", 0), MarginKind::Friction), 0.2277, 5e-5);
}

#[test]
fn a_thick_arch_needs_a_friction_of_about_a_third() {
    near(&low(&margins(&arch(181, 0.3, 0.7)), MarginKind::Friction), 0.3092, 0.002);
}

#[test]
fn the_minimum_thickness_of_an_arch_is_found_by_bisection() {
    let (mut falls, mut stands) = (0.1, 0.12);
    while stands - falls > 1e-5 {
        let middle = 0.5 * (stands + falls);
        match verdict(&arch(181, middle, 0.9)) {
            Verdict::Stable => stands = middle,
            _ => falls = middle,
        }
    }
    assert!((stands - 0.10745).abs() < 1e-4, "{stands}");
}

/// A block 2 m wide and 3 m high with a load of 1 N to the left and 0.5 N downwards at its upper right corner.
#[test]
fn a_load_grows_until_the_block_topples() {
    let mut file = on_floor(0.9, vec![block("a", rectangle(0.0, 0.0, 2.0, 3.0), 6.0)]);
    file["loads"] = json!([{ "block": "a", "force": [-1, -0.5], "at": [2, 3] }]);
    let found = margins(&file);
    // Moments about the left foot: 6·1 + λ·0.5·2 = λ·1·3.
    near(&high(&found, MarginKind::LoadFactor), 3.0, 1e-7);
    // To the left 6·1 + 0.5·2 − 1·3 = h·6·1.5. To the right, about the lower right corner, 6·1 + 1·3 = h·6·1.5.
    near(&left(&found, MarginKind::HorizontalLoad), 4.0 / 9.0, 1e-7);
    near(&high(&found, MarginKind::HorizontalLoad), 1.0, 1e-7);
    // Moments about the left foot: the tilted weight exerts 6 cos θ − 9 sin θ, and the loads exert 1·3 − 0.5·2 = 2.
    let left = left(&found, MarginKind::Tilt).value().expect("it topples").to_radians();
    let moment = 6.0 * libm::cos(left) - 9.0 * libm::sin(left);
    assert!((moment - 2.0).abs() < 1e-5, "{moment}");
    assert_eq!(found.most(MarginKind::Tilt).map(|a| a > 40.0), Some(true));
}

#[test]
fn structures_that_fall_at_any_value_have_no_margin() {
    let flying = margins(&on_floor(0.5, vec![block("a", rectangle(0.0, 1.0, 1.0, 1.0), 6.0)]));
    for kind in [MarginKind::Friction, MarginKind::Tilt, MarginKind::HorizontalLoad, MarginKind::Kernel] {
        assert!(has_none(&flying, kind) && matches!(flying.of(kind), Some(Interval::Empty(_))), "{kind:?}");
    }
    assert_eq!(flying.of(MarginKind::LoadFactor), None);
}

#[test]
fn a_squeezed_block_needs_almost_no_friction() {
    let file = json!({ "drystone": 1, "friction": 0.5,
        "ground": [{ "polygon": rectangle(-2.0, -1.0, 2.0, 3.0) }, { "polygon": rectangle(1.0, -1.0, 2.0, 3.0) }],
        "blocks": [block("a", rectangle(0.0, 0.0, 1.0, 1.0), 6.0)] });
    let found = margins(&file);
    assert!(found.least(MarginKind::Friction).expect("it stands") < 1e-6);
    assert_eq!(left(&found, MarginKind::Tilt), End::Unbounded);
    assert_eq!(high(&found, MarginKind::HorizontalLoad), End::Unbounded);
    assert_eq!(high(&found, MarginKind::Kernel), End::Unbounded);
}

#[test]
fn the_margin_of_a_frame_is_that_of_its_worst_group() {
    let tower = |height: f64| {
        on_floor(
            0.9,
            vec![
                block("low", rectangle(0.0, 0.0, 1.0, 1.0), 6.0),
                block("high", rectangle(5.0, 0.0, 1.0, height), 6.0),
            ],
        )
    };
    near(&left(&margins(&tower(4.0)), MarginKind::HorizontalLoad), 0.25, 1e-7);
    near(&left(&margins(&tower(1.25)), MarginKind::HorizontalLoad), 0.8, 1e-7);
}

#[test]
fn margins_are_an_effect_on_request() {
    let file = on_floor(0.5, vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 6.0)]);
    let scene = scene(&file);
    let report = |frame: &FrameAnalysis| {
        let effect = frame.effects.iter().find(|e| e.effect == EffectName::Margins);
        let effect = effect.expect("every effect is listed");
        (effect.simulated, effect.why.clone())
    };
    let plain = Analysis::new(&scene).frames.remove(0);
    assert_eq!(report(&plain), (false, "not requested".to_string()));
    assert_eq!(plain.margins, None);
    let with_margins = frames(&scene).remove(0);
    let (simulated, why) = report(&with_margins);
    assert!(simulated && why.starts_with("requested"), "{why}");
    assert_eq!(with_margins.verdict, plain.verdict);
}

#[test]
fn a_ladder_at_a_smooth_wall_needs_a_multiple_of_its_friction() {
    use drystone::starter::Ladder;
    for (friction, wall_friction) in [(0.4, 0.0), (0.7, 0.0), (0.3, 0.2)] {
        let scene =
            Scene::new(Ladder { friction, wall_friction, angle: 45.0, ..Ladder::default() }.scene()).expect("sound");
        let found = Analysis::with(&scene, &Options::default().margins(MarginKinds::ALL));
        let margins = found.frames[0].margins.as_ref().expect("margins were requested");
        let (corners, lever) = (scene.blocks()[0].body.polygon.outline().to_vec(), scene.blocks()[0].centroid.x);
        let top = corners[1];
        // With the factor f, both contacts slide. Forces along x: N = f μ (W − f ν N), with the force N of the wall. Moments
        // about the foot: N (y + f ν x) = W c, with the contact at (x, y) and the centroid at the distance c. Here W = 1.
        let slides = |factor: f64| {
            let n = lever / (top.y + factor * wall_friction * top.x);
            factor * friction * (1.0 - factor * wall_friction * n) - n
        };
        let (mut low, mut high) = (0.0, 100.0);
        for _ in 0..200 {
            let middle = (low + high) / 2.0;
            if slides(middle) < 0.0 { low = middle } else { high = middle }
        }
        near(&self::low(margins, MarginKind::FrictionFactor), low, 1e-5 * low);
        let verdict = if low > 1.0 { Verdict::Unstable } else { Verdict::Stable };
        assert_eq!(found.frames[0].verdict, verdict, "{friction} {low}");
    }
}

#[test]
fn with_one_coefficient_the_factor_on_the_friction_is_the_least_friction_over_it() {
    let found = margins(&arch(11, 0.3, 0.7));
    let [End::At { value: factor, .. }, End::At { value: least, .. }] =
        [MarginKind::FrictionFactor, MarginKind::Friction].map(|kind| low(&found, kind))
    else {
        panic!("both ends are confirmed")
    };
    assert!((factor - least / 0.7).abs() < 1e-12, "{factor} {least}");
    // Smooth joints have no factor.
    let mut smooth = wall(3, 2);
    smooth["friction"] = json!(0);
    assert!(margins(&smooth).of(MarginKind::FrictionFactor).is_none());
}

#[test]
fn an_equal_frame_has_the_margins_of_the_earlier_one() {
    let mut file = on_floor(
        0.5,
        vec![block("a", rectangle(0.0, 0.0, 1.0, 1.0), 6.0), block("b", rectangle(0.25, 1.0, 1.0, 1.0), 6.0)],
    );
    file["steps"] = json!([{ "place": ["a", "b"] }, { "remove": ["b"] }, { "place": ["b"] }]);
    let frames = frames(&scene(&file));
    assert_ne!(frames[0].margins, frames[1].margins);
    assert_eq!(frames[0].margins, frames[2].margins);
    let why = |k: usize| {
        let effect = frames[k].effects.iter().find(|e| e.effect == EffectName::Margins);
        effect.expect("every effect is listed").why.clone()
    };
    assert!(!why(0).contains(" 0 verdicts"), "{}", why(0));
    assert!(why(2).contains(" 0 verdicts"), "{}", why(2));
}

/// On a slope steeper than its friction angle, a block falls. With gravity tilted towards the slope, it would stand.
#[test]
fn a_block_that_falls_has_no_tilt_margin_even_if_it_would_stand_tilted() {
    let file = on_slope(30.0, 4.0, 0.5, 0.3, 0.0);
    let found = margins(&file);
    assert!(has_none(&found, MarginKind::Tilt));
    let mut turned = file;
    let angle = 20f64.to_radians();
    turned["gravity"] = json!([libm::sin(angle), -libm::cos(angle)]);
    assert_eq!(verdict(&turned), Verdict::Stable);
}

/// Margins of the scenes of the thesis, checked by analysing changed scene files.
#[test]
fn a_scene_stands_just_inside_each_margin_and_falls_just_beyond_it() {
    let folder = format!("{}/assets/thesis", env!("CARGO_MANIFEST_DIR"));
    let mut compared = 0;
    for name in ["figure-3b", "figure-5", "figure-6-kernel-02", "figure-8-left"] {
        let text = std::fs::read_to_string(format!("{folder}/{name}.json")).expect("a scene");
        let file: Value = serde_json::from_str(&text).expect("JSON");
        for (number, frame) in thesis(name).iter().enumerate() {
            let found = frame.margins.as_ref().expect("margins were requested");
            let mut agrees = |end: Option<f64>, more_is_worse: bool, change: &dyn Fn(f64) -> Value| {
                let Some(at) = end.filter(|at| *at > 0.0) else {
                    return;
                };
                for (share, inside) in [(1.0 - 1e-4, more_is_worse), (1.0 + 1e-4, !more_is_worse)] {
                    let scene = scene(&change(at * share));
                    let verdict = Analysis::new(&scene).frames[number].verdict;
                    let expected = if inside { Verdict::Stable } else { Verdict::Unstable };
                    assert_eq!(verdict, expected, "{name}, frame {number}: {at} times {share}");
                    compared += 1;
                }
            };
            let with = |key: &str, value: Value| {
                let mut changed = file.clone();
                changed[key] = value;
                changed
            };
            // These scenes have one friction coefficient and gravity (0, −1), so each change needs a single key.
            agrees(found.least(MarginKind::Friction), false, &|mu| with("friction", json!(mu)));
            agrees(found.most(MarginKind::Kernel), true, &|kernel| with("kernel", json!(kernel)));
            let tilts = [found.least(MarginKind::Tilt), found.most(MarginKind::Tilt)];
            for (end, side) in tilts.into_iter().zip([-1.0, 1.0]) {
                agrees(end.map(|end| side * end), true, &|degrees| {
                    let angle = degrees.to_radians();
                    with("gravity", json!([side * libm::sin(angle), -libm::cos(angle)]))
                });
            }
        }
    }
    assert_eq!(compared, 30);
}

/// The number of verdicts that were computed for the margins.
fn verdicts(frame: &FrameAnalysis) -> usize {
    let effect = frame.effects.iter().find(|e| e.effect == EffectName::Margins);
    let why = &effect.expect("every effect is listed").why;
    let mut words = why.split_whitespace();
    let number = words.find_map(|word| word.parse().ok());
    number.unwrap_or_else(|| panic!("no number of verdicts in {why:?}"))
}

/// A margin that one program computes is confirmed by the forces and the motion of this program. A search needs about
/// one step for each one or two digits. So few verdicts are computed.
#[test]
fn a_margin_needs_few_verdicts_of_verdicts() {
    for (file, most) in [(wall(8, 8), 6), (arch(31, 0.3, 0.7), 60)] {
        let frame = frames(&scene(&file)).remove(0);
        let count = verdicts(&frame);
        assert!(count <= most, "{count} verdicts were computed");
        let found = frame.margins.as_ref().expect("margins were requested");
        let ends = [found.least(MarginKind::HorizontalLoad), found.most(MarginKind::Tilt)];
        assert!(ends.iter().all(Option::is_some), "{ends:?}");
    }
}

#[test]
fn a_margin_requested_alone_has_the_same_value() {
    let file = scene(&arch(15, 0.3, 0.7));
    let all = frames(&file).remove(0);
    let options = Options::default().margins(MarginKinds::new(&[MarginKind::Friction]));
    let alone = Analysis::with(&file, &options).frames.remove(0);
    assert!(verdicts(&alone) < verdicts(&all));
    let (all, alone) = (
        all.margins.as_ref().expect("margins were requested"),
        alone.margins.as_ref().expect("margins were requested"),
    );
    let [a, b] = [&all, &alone].map(|found| found.least(MarginKind::Friction).expect("it slides"));
    assert!((a - b).abs() < 1e-7, "{a} and {b}");
    assert_eq!(alone.kinds, MarginKinds::new(&[MarginKind::Friction]));
    assert!(alone.each.iter().all(|margin| margin.kind == MarginKind::Friction), "{:?}", alone.each);
}

/// Mechanisms on both sides exclude half-lines of horizontal loads that overlap. They have no other ends that could meet.
#[test]
fn a_tower_may_fall_under_every_horizontal_load() {
    let stones = [
        (0.125, 0.0, 2.0, 1.0, 3.0),
        (0.0, 1.0, 2.0, 1.0, 7.0),
        (0.25, 2.0, 2.0, 1.0, 0.09),
        (0.5, 3.0, 2.0, 1.0, 2e-10),
        (0.125, 4.0, 2.0, 1.0, 0.001),
        (2.124_511_718_75, 5.0, 0.001_953_125, 0.001_953_125, 0.007),
        (0.124_968_528_747_558_6, 5.0, 0.000_061_035_156_25, 0.000_061_035_156_25, 2.0),
    ];
    let stones = stones.into_iter().enumerate();
    let blocks =
        stones.map(|(i, (x, y, width, height, weight))| block(&i.to_string(), rectangle(x, y, width, height), weight));
    let mut tower = on_floor(0.5, blocks.collect());
    tower["gravity"] = json!([-5, -12]);
    tower["loads"] = json!([{ "block": "6", "force": [1e-6, 0] }]);
    assert!(has_none(&margins(&tower), MarginKind::HorizontalLoad));
}
