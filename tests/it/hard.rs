//! Hard cases of shapes and supports: a tolerance or a rounding error could reverse the verdict. The comment of each
//! test states why its case is hard.

mod numbers;

use drystone::Analysis;
use drystone::analysis::{Failure, MarginKind, MarginKinds, Options, Proof, Verdict};
use drystone::scene::BodyId;
use serde_json::{Value, json};

use crate::structure::{arch, block, first, on_floor, on_slope, rectangle, scene, tower, verdict, wall};

const STANDS: Verdict = Verdict::Stable;
const FALLS: Verdict = Verdict::Unstable;

/// A frictionless wedge between two slopes. The angle between each side and the vertical is `half_angle`.
pub fn wedge(half_angle: f64) -> Value {
    let d = libm::tan(half_angle);
    json!({ "drystone": 1, "friction": 0,
        "ground": [{ "polygon": [[-3, 0], [-0.5, 0], [-0.5 - d, 1], [-3, 1]] },
                   { "polygon": [[0.5, 0], [3, 0], [3, 1], [0.5 + d, 1]] }],
        "blocks": [{ "id": "wedge", "polygon": [[-0.5, 0], [0.5, 0], [0.5 + d, 1], [-0.5 - d, 1]], "weight": 6 }] })
}

/// A block whose centre of gravity lies `beyond` the edge of its support. With `pair` the support is another block.
pub fn overhang(beyond: f64, pair: bool) -> Value {
    let mut blocks = vec![block("a", rectangle(0.5 + beyond, if pair { 0.5 } else { 0.0 }, 1.0, 0.5), 6.0)];
    if pair {
        blocks.push(block("b", rectangle(0.0, 0.0, 1.0, 0.5), 6.0));
    }
    json!({ "drystone": 1, "ground": [{ "polygon": rectangle(0.0, -1.0, 1.0, 1.0) }], "blocks": blocks })
}

/// Errors add up from the top to the bottom of a long chain.
#[test]
fn a_tower_of_a_thousand_blocks() {
    let frame = first(&tower(1000, 0.5));
    assert_eq!(frame.verdict, STANDS);
    let foot: f64 = frame
        .contacts
        .iter()
        .filter(|c| c.interface.ends[0].y == 0.0)
        .map(|c| c.normal_forces[0] + c.normal_forces[1])
        .sum();
    assert!((foot - 6000.0).abs() < 1e-6 * 6000.0, "{foot}");
}

/// The thrust of a slender frictionless wedge grows as 1/α. Above 10⁶ times the weight, a big-M program would report
/// a failure.
#[test]
fn a_flat_wedge_stands_however_large_its_thrust() {
    for exponent in 2..=7 {
        let half_angle = libm::exp10(-f64::from(exponent));
        let frame = first(&wedge(half_angle));
        assert_eq!(frame.verdict, STANDS, "half-angle 1e-{exponent}: {:?}", frame.proof);
        let expected = 6.0 / (2.0 * libm::sin(half_angle));
        let sum: f64 = frame.contacts.iter().flat_map(|c| c.normal_forces).sum::<f64>() / 2.0;
        assert!((sum / expected - 1.0).abs() < 1e-6, "half-angle 1e-{exponent}: {sum} instead of {expected}");
    }
}

/// Within about 10⁻⁷ of L beyond the edge, a balance is accepted. Farther out, the block must fall.
#[test]
fn a_centre_of_gravity_on_the_edge() {
    for pair in [false, true] {
        for inside in [0.0, -1e-9, -1e-8, -1e-7, -1e-6, -1e-5] {
            assert_eq!(verdict(&overhang(inside, pair)), STANDS, "{inside:e}, pair: {pair}");
        }
        assert_eq!(verdict(&overhang(1e-9, pair)), STANDS, "a balance within the tolerance counts");
        for beyond in [2e-7, 1e-6, 1e-5] {
            assert_eq!(verdict(&overhang(beyond, pair)), FALLS, "{beyond:e}, pair: {pair}");
        }
    }
}

/// With kernel 1 both application points of a joint coincide, so that it cannot transmit a moment.
#[test]
fn kernels_of_zero_and_one() {
    for kernel in [0.0, 1.0] {
        let mut file = wall(4, 4);
        file["kernel"] = json!(kernel);
        assert_eq!(verdict(&file), STANDS, "{kernel}");
    }
    let mut file = arch(11, 0.2, 0.7);
    file["kernel"] = json!(1.0);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    assert_eq!(frame.unsupported.len(), 11, "adhesion in the middle of the joints cannot hold a chain of hinges");
}

/// At the limit between two verdicts, the status that a solver returns is not reliable.
#[test]
fn an_arch_at_its_minimum_thickness() {
    // The limit of an arch of 181 voussoirs is slightly below that of the continuous arch (0.1075), because the
    // hinges of a continuous arch may also lie between these joints.
    for (thickness, expected) in [(0.10743, FALLS), (0.10746, FALLS), (0.1075, STANDS), (0.1076, STANDS)] {
        assert_eq!(verdict(&arch(181, thickness, 0.9)), expected, "{thickness}");
    }
}

/// The last bit of the rounded tan θ would decide. A balance within the tolerance counts, so the block stands.
#[test]
fn friction_exactly_at_the_slope() {
    for degrees in [10.0f64, 30.0, 45.0, 60.0] {
        let friction = libm::tan(degrees.to_radians());
        assert_eq!(verdict(&on_slope(degrees, 4.0, 0.5, friction, 0.0)), STANDS, "{degrees}");
    }
}

/// There are more supports than needed, so many distributions of forces are optimal. The least-squares distribution
/// is symmetric.
#[test]
fn redundant_supports_carry_symmetric_forces() {
    let mut blocks: Vec<Value> =
        (0..5).map(|k| block(&format!("post {k}"), rectangle(2.0 * k as f64, 0.0, 1.0, 1.0), 1.0)).collect();
    blocks.push(block("beam", rectangle(0.0, 1.0, 9.0, 0.5), 45.0));
    let frame = first(&on_floor(0.5, blocks));
    assert_eq!(frame.verdict, STANDS);
    let carried: Vec<f64> =
        frame.contacts.iter().filter(|c| c.interface.ends[0].y == 1.0).map(|c| c.resultant.force.y.abs()).collect();
    assert_eq!(carried.len(), 5);
    for (a, b) in carried.iter().zip(carried.iter().rev()) {
        assert!((a - b).abs() < 1e-6, "{carried:?}");
    }
    assert!((carried.iter().sum::<f64>() - 45.0).abs() < 1e-9);
}

/// Forces are missing in every course, but adhesion at fewer than 60 points suffices.
#[test]
fn a_wall_on_a_tilted_table_fails_in_every_course() {
    let mut file = wall(10, 10);
    file["gravity"] = json!([6.0, -8.0]);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    assert!(frame.total_sticking > 0.0 && frame.failures.len() < 60, "{} points", frame.failures.len());
}

/// Each tower is a small independent program.
#[test]
fn a_thousand_towers_are_solved_separately() {
    let blocks = (0..1000).flat_map(|k| {
        (0..3).map(move |j| {
            let at = rectangle(f64::from(k) * 0.15 - 90.0, f64::from(j) * 0.1, 0.1, 0.1);
            block(&format!("{k}-{j}"), at, 1.0)
        })
    });
    let frame = first(&on_floor(0.5, blocks.collect()));
    assert_eq!((frame.verdict, frame.solve.groups), (STANDS, 1000));
}

/// Self-stress: the thrust between the two walls is unbounded, and no motion opens every contact.
#[test]
fn a_block_squeezed_between_walls_counts_as_balanced() {
    let file = json!({ "drystone": 1, "friction": 0.01,
        "ground": [{ "polygon": rectangle(-2.0, -1.0, 2.0, 3.0) }, { "polygon": rectangle(1.0, -1.0, 2.0, 3.0) }],
        "blocks": [block("a", rectangle(0.0, 0.0, 1.0, 1.0), 6.0)] });
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS);
    // In the balance of least forces, the friction μN on each side is half of the weight, 3 N.
    for contact in &frame.contacts {
        let pressed = contact.normal_forces[0] + contact.normal_forces[1];
        assert!((pressed - 300.0).abs() < 1e-6, "{pressed}");
    }
}

/// Effects are simulated only if a frame needs them. A frame with the same blocks as an earlier one is not solved
/// again.
#[test]
fn effects_that_a_frame_does_not_need_are_not_simulated() {
    let mut file = wall(2, 2);
    file["friction"] = json!(0.0);
    file["steps"] = json!([
        { "place": ["0", "1"] }, { "place": ["2", "3", "4"] }, { "remove": ["2", "3", "4"] }
    ]);
    let scene = scene(&file);
    let analysis = Analysis::new(&scene);
    let effect = |name: &str| {
        analysis.frames[1]
            .effects
            .iter()
            .find(|e| e.effect.word() == name)
            .unwrap_or_else(|| panic!("no effect {name}"))
    };
    for (name, simulated) in [
        ("weight", true),
        ("contact", true),
        ("friction", false),
        ("kernel", false),
        ("robots", false),
        ("sticking", false),
    ] {
        assert_eq!(effect(name).simulated, simulated, "{name}: {}", effect(name).why);
    }
    let contacts = analysis.frames[1].contacts.len();
    assert_eq!(effect("contact").unknowns, 2 * contacts);
    assert_eq!(effect("friction").unknowns, 4 * contacts, "the unknowns that friction would add");
    // The third frame is equal to the first.
    let last = &analysis.frames[2];
    assert_eq!((last.solve.reused, last.solve.groups, last.solve.programs), (1, 1, 0));
    let Proof::Forces { worst_imbalance, .. } = last.proof else { panic!("{:?}", last.proof) };
    assert!(worst_imbalance < 1e-9);
}

/// A pile that is wedged between walls and still falls. The forces of the balance with the least adhesion are
/// unbounded, but the result must not state that no adhesion could hold the pile.
#[test]
fn a_wedged_pile_that_falls_could_be_held_by_adhesion() {
    let polygon = |corners: [[f64; 2]; 4]| json!({ "polygon": corners });
    let file = json!({ "drystone": 1, "friction": 1000.0, "kernel": 0.2,
        "ground": [polygon([[-9.0, -13.0], [15.0, 5.0], [12.0, 9.0], [-12.0, -9.0]]),
                   polygon([[-12.0, -9.0], [-8.0, -6.0], [-14.75, 3.0], [-18.75, 0.0]]),
                   polygon([[8.0, 6.0], [12.0, 9.0], [3.75, 20.0], [-0.25, 17.0]])],
        "blocks": [block("0", json!([[-4.0, -3.0], [-1.0, -0.75], [-2.5, 1.25], [-5.5, -1.0]]), 2.0),
                   block("1", json!([[1.0, 0.75], [8.0, 6.0], [6.5, 8.0], [-0.5, 2.75]]), 3.0),
                   block("2", json!([[-6.0, -1.375], [-5.0, -0.625], [-8.0, 3.375], [-9.0, 2.625]]), 1.0),
                   block("3", json!([[-5.0, -0.625], [1.0, 3.875], [-2.0, 7.875], [-8.0, 3.375]]), 2.0),
                   block("4", json!([[-8.5, 3.0], [-4.5, 6.0], [-7.5, 10.0], [-11.5, 7.0]]), 5.0)] });
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    assert!(frame.unsupported.is_empty(), "{:?}", frame.unsupported);
    assert!((frame.total_sticking / 1.325_152_168_800_875 - 1.0).abs() < 1e-7, "{}", frame.total_sticking);
}

/// At a friction of 10⁶ a motion may not slide at all. The rounding of a violation is relative to a force with
/// N + |T| = 1; relative to N = 1 it would be a million times larger, and no motion would be proved. An exact rational
/// simplex method finds that no forces balance this heap without gravity.
#[test]
fn a_fall_is_proved_at_a_friction_of_a_million() {
    let blocks = [
        ("b0", 0.0, 0.0, 1.0, 1.0),
        ("b1", 2.0, 0.0, 0.375, 1.0),
        ("b2", 2.375, 0.0, 0.25, 1.0),
        ("b3", 2.75, 0.0, 0.375, 1.0),
        ("b4", 3.25, 0.0, 0.625, 1.0),
        ("b5", 4.875, 0.0, 0.75, 1.0),
        ("b6", -0.125, 1.0, 5.625, 0.625),
        ("b7", 0.0, 1.625, 0.75, 1.5),
        ("b8", 1.75, 1.625, 0.625, 1.5),
        ("b9", 2.75, 1.625, 0.5, 1.5),
        ("b10", 3.25, 1.625, 0.25, 1.5),
        ("b11", 0.0, 3.125, 5.125, 0.75),
    ];
    let blocks = blocks.map(|(id, x, y, width, height)| block(id, rectangle(x, y, width, height), 1.0));
    let mut file = on_floor(1e6, blocks.to_vec());
    file["kernel"] = json!(0.5);
    file["gravity"] = json!([0, 0]);
    file["loads"] = json!([{ "block": "b2", "force": [-2.57, -3.55], "at": [4, 3] },
        { "block": "b1", "force": [2.22, 0.621] }, { "block": "b3", "torque": -1.42 }]);
    assert_eq!(verdict(&file), FALLS);
}

/// Gravity acts upwards, so each block needs a pull of its weight, or more if it carries others. The program's error is
/// 10⁻⁹ of the heaviest weight.
#[test]
fn no_failure_is_left_out_at_weights_of_sixteen_powers_of_ten() {
    let mut file = json!({ "drystone": 1, "gravity": [0, 3],
        "ground": [{ "polygon": rectangle(-20.0, -1.0, 80.0, 1.0) }],
        "blocks": [block("b1", rectangle(1.0, 0.0, 0.875, 1.125), 10.0),
                   block("b2", rectangle(3.625, 0.0, 0.5, 1.125), 1e9),
                   block("b3", rectangle(-1.375, 1.125, 6.625, 0.25), 1e-7)] });
    file["blocks"][0]["friction"] = json!(0);
    file["blocks"][1]["friction"] = json!(0.1);
    let (scene, frame) = (scene(&file), first(&file));
    assert_eq!(frame.verdict, FALLS);
    // The pull on each block from below, minus the pull from above: its weight.
    let mut pulls = [0.0; 3];
    for failure in &frame.failures {
        let Failure::Tension { bodies, force, .. } = failure else { panic!("{failure:?}") };
        for (body, sign) in bodies.iter().zip([-1.0, 1.0]) {
            if let BodyId::Block(block) = body {
                pulls[block.0] += sign * force.y;
            }
        }
    }
    for (block, pull) in scene.blocks().iter().zip(pulls) {
        assert!((pull / block.weight - 1.0).abs() < 1e-6, "{}: {pull} {:?}", block.id, frame.failures);
    }
}

#[test]
fn a_row_of_round_stones_passes_on_a_push_for_ever() {
    // Each stone turns its push N into friction N at the same joint, so friction below 1 cannot hold the row. The push
    // that is left shrinks by (1 - μ) / (1 + μ) from stone to stone, far below the weight of a stone.
    for (friction, count) in
        [(0.5, 3), (0.5, 6), (0.5, 10), (0.3, 12), (0.5, 12), (0.5, 16), (0.8, 12), (0.5, 20), (0.5, 60)]
    {
        let stone =
            |k: usize| json!({ "id": format!("c{k}"), "circle": { "centre": [k, 0.5], "radius": 0.5 }, "weight": 100 });
        let file = json!({ "drystone": 1, "friction": friction,
            "ground": [{ "polygon": rectangle(-2.0, -1.0, count as f64 + 3.0, 1.0) }],
            "blocks": (0..count).map(stone).collect::<Vec<_>>(),
            "loads": [{ "block": "c0", "force": [1, 0], "at": [-0.5, 0.5] }] });
        let options = Options::default().margins(MarginKinds::new(&[MarginKind::Friction]));
        let found = Analysis::with(scene(&file), &options).frames.remove(0);
        assert_ne!(found.verdict, Verdict::Stable, "{count} stones");
        let least = found.margins.as_ref().and_then(|margins| margins.least(MarginKind::Friction));
        assert!(least.is_none_or(|least| (0.995..1.0 + 1e-6).contains(&least)), "{count} stones: {least:?}");
        assert!(found.verdict == Verdict::Unstable || !found.doubt().is_empty());
        if count <= 12 && friction < 0.8 {
            assert!(found.verdict == Verdict::Unstable, "{count} stones: {}", found.doubt());
        }
    }
}
