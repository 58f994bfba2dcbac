//! Small stones: whether a pebble on a tower, next to a wall or in its joints stands depends only on the forces on
//! the pebble, even if it is very light.

mod pebble;

use drystone::analysis::{Options, Verdict, verdicts};
use drystone::internals::geometry::{Point, Vector, cross, zonotope_gauge};
use drystone::scene::{BlockId, BodyId};
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::hard::wedge;
use crate::structure::{arch, block, harmonic, on_floor, on_slope, rectangle, rotated, verdict, wall};

const STANDS: Verdict = Verdict::Stable;
const FALLS: Verdict = Verdict::Unstable;

/// Ten scene files with verdicts found by hand. A pebble falls if its centre of gravity lies beyond its support, if
/// the slope is steeper than its friction angle, or if it only touches the side of a wall.
#[test]
fn ten_small_stones_have_the_verdicts_known_by_hand() {
    let cases = [
        (include_str!("small/beside-0.json"), FALLS),
        (include_str!("small/light-10.json"), FALLS),
        (include_str!("small/light-18.json"), FALLS),
        (include_str!("small/slope-0.1-0.3-0.29.json"), STANDS),
        (include_str!("small/slope-0.1-0.3-0.31.json"), FALLS),
        (include_str!("small/tower10-0.0001-0.3.json"), STANDS),
        (include_str!("small/tower10-0.01-0.49.json"), STANDS),
        (include_str!("small/tower10-0.01-0.6.json"), FALLS),
        (include_str!("small/tower3-0.001-0.9.json"), FALLS),
        (include_str!("small/tower30-0.01-0.51.json"), FALLS),
    ];
    for (text, expected) in cases {
        let file: Value = serde_json::from_str(text).expect("a scene file");
        assert_eq!(verdict(&file), expected, "{}", file["title"]);
    }
}

/// A tower of bricks of 2 m × 1 m with a square stone of side `size` on top. The fraction `beyond` of the stone's
/// width lies beyond the edge of the tower.
fn topped(bricks: usize, size: f64, beyond: f64) -> Value {
    let mut blocks: Vec<Value> = (0..bricks)
        .map(|k| {
            let at = rectangle(0.0, k as f64, 2.0, 1.0);
            json!({ "id": format!("b{k}"), "polygon": at })
        })
        .collect();
    let at = rectangle(2.0 - size * (1.0 - beyond), bricks as f64, size, size);
    blocks.push(json!({ "id": "pebble", "polygon": at }));
    json!({ "drystone": 1, "friction": 0.6, "density": 2000,
        "ground": [{ "polygon": rectangle(-20.0, -1.0, 40.0, 1.0) }], "blocks": blocks })
}

/// Stones from 1 m to 10⁻⁶ m, weights down to about 10⁻¹² of a brick's, towers of 1 to 30 bricks, upright and rotated
/// by odd angles. The verdict depends only on which side of the edge the stone's centre of gravity lies.
#[test]
fn a_stone_on_a_tower_falls_where_its_centre_of_gravity_is_beyond_the_edge() {
    for bricks in [1, 2, 3, 5, 10, 20, 30] {
        for size in [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            for (beyond, expected) in [(0.49, STANDS), (0.51, FALLS), (0.55, FALLS), (0.75, FALLS), (0.99, FALLS)] {
                for degrees in [0.0, 17.3, 41.3] {
                    let file = rotated(&topped(bricks, size, beyond), degrees);
                    assert_eq!(verdict(&file), expected, "{bricks}, {size:e}, {beyond}, {degrees}°");
                }
            }
        }
    }
}

/// Small stones on a ramp on top of such towers. A stone slides if the slope of the ramp exceeds its friction
/// coefficient.
#[test]
fn stones_slide_on_towers_if_the_ramp_is_too_steep() {
    for bricks in [1, 5, 20] {
        for size in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
            for slope in [0.0625, 0.5] {
                for (friction, expected) in [(slope * 1.01, STANDS), (slope * 0.99, FALLS), (0.0, FALLS)] {
                    let mut file = topped(bricks, 1.0, 0.0);
                    let top = f64::from(bricks as u32);
                    let along = [1.0, slope].map(|v| v / libm::hypot(1.0, slope));
                    let at = |u: f64, v: f64| {
                        json!([
                            0.7 + size * (u * along[0] - v * along[1]),
                            top + 0.7 * slope + size * (u * along[1] + v * along[0])
                        ])
                    };
                    let stone = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 0.5), at(0.0, 0.5)];
                    let blocks = file["blocks"].as_array_mut().expect("a list");
                    let ramp = json!([[0, top], [2, top], [2, top + 2.0 * slope]]);
                    blocks[bricks] = json!({ "id": "ramp", "polygon": ramp });
                    blocks.push(json!({ "id": "stone", "polygon": stone, "friction": friction }));
                    for degrees in [0.0, 17.3] {
                        assert_eq!(
                            verdict(&rotated(&file, degrees)),
                            expected,
                            "{bricks}, {size:e}, {slope} {friction}, {degrees}°"
                        );
                    }
                }
            }
        }
    }
}

/// A block that is 1 m wide at the top and only `base` wide at the bottom, on which it stands. The horizontal
/// distance of its centre of gravity from the middle of the bottom edge is `off * base`.
fn on_a_tip(base: f64, off: f64, height: f64) -> Value {
    // The centroid of a trapezium lies on the line through the middles of its parallel sides, at this fraction of its
    // height.
    let share = (base + 2.0) / (3.0 * (base + 1.0));
    let lean = off * base / share;
    let tip = json!([
        [1.0 - 0.5 * base, 1.0],
        [1.0 + 0.5 * base, 1.0],
        [1.5 + lean, 1.0 + height],
        [0.5 + lean, 1.0 + height]
    ]);
    let mut file = topped(1, 1.0, 0.0);
    file["blocks"][1]["polygon"] = tip;
    file
}

/// A contact as short as a millionth of a block counts as a contact if the edge has no other contact. A force may be
/// moved by 10⁻⁷ of the block's radius, so a centre of gravity this close to the end of the tip is within the
/// tolerance (`band`). For rotated tips of 10⁻⁶ m, f64 leaves ten digits for the normal, and a few of these cases are
/// undecided.
#[test]
fn large_blocks_stand_on_small_tips() {
    let (mut wrong, mut undecided) = (Vec::new(), Vec::new());
    for base in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        for height in [0.1, 0.5, 2.0] {
            let band = 4e-7 * f64::max(height, 1.0) / base;
            for degrees in [0.0, 17.3, 41.3, 73.9, 203.1] {
                let stands = [0.0, 0.17, -0.29, 0.33, -0.41, 0.49];
                let falls = [0.51 + band, -0.7 - band, 1.5 + band];
                for off in stands.into_iter().chain(falls) {
                    let file = rotated(&on_a_tip(base, off, height), degrees);
                    let expected = if off.abs() < 0.5 { STANDS } else { FALLS };
                    let what = format!("{base:e} {height} {degrees}° {off}");
                    match verdict(&file) {
                        found if found == expected => {}
                        Verdict::Undecided if base == 1e-6 => undecided.push(what),
                        found => wrong.push(format!("{what}: {found:?}")),
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
    assert!(undecided.len() <= 8, "{undecided:?}");
}

/// If two bricks overlap by a very short length, they may be neighbours, or one may support the other. If the verdict
/// depends on this, it is undecided with a reason. With a contact tolerance below or above this length, it is
/// decided.
#[test]
fn tiny_overlaps_that_decide_leave_the_verdict_undecided() {
    let length = 3e-7;
    let mut file = topped(1, 1.0, 0.0);
    // A lintel that rests on the left post over a length of only 3e-7 m, and on the right post over the full width of
    // the post.
    let blocks = json!([
        { "id": "left", "polygon": rectangle(0.0, 0.0, 1.0, 1.0) },
        { "id": "right", "polygon": rectangle(3.0, 0.0, 1.0, 1.0) },
        { "id": "lintel", "polygon": rectangle(1.0 - length, 1.0, 3.0 + length, 0.5) },
        { "id": "end", "polygon": rectangle(1.0, 1.5, 0.5, 4.0) }
    ]);
    file["blocks"] = blocks;
    file["blocks"][1]["polygon"] = rectangle(2.9, 0.0, 0.2, 1.0);
    let scene = Scene::from_json(&file.to_string()).expect("a scene");
    let frame = Analysis::new(&scene).frames.remove(0);
    assert_eq!(frame.verdict, Verdict::Undecided, "{:?}", frame.notices);
    assert!(frame.doubt().contains("left") && frame.doubt().contains("contact_tolerance"));
    assert_eq!(verdicts(&scene, &Options::default()), [Verdict::Undecided]);
    for (tolerance, expected) in [(0.5 * length, STANDS), (1.01 * length, FALLS)] {
        file["contact_tolerance"] = json!(tolerance);
        assert_eq!(verdict(&file), expected, "{tolerance:e}: {}", frame.doubt());
    }
}

/// If the verdict depends on a slight overlap, `verdicts` leaves it undecided, as the complete analysis does.
#[test]
fn verdicts_alone_are_undecided_where_an_overlap_decides() {
    let file = on_floor(
        0.7,
        vec![
            block("left", rectangle(0.0, 0.0, 1.0, 1.0), 20.0),
            block("right", rectangle(3.0, 0.0, 1.0, 1.001), 20.0),
            block("lintel", rectangle(0.2, 1.0, 3.6, 0.5), 10.0),
        ],
    );
    let scene = Scene::from_json(&file.to_string()).expect("a scene");
    assert_eq!(scene.penetrations().len(), 1);
    let frame = Analysis::new(&scene).frames.remove(0);
    assert_eq!(frame.verdict, Verdict::Undecided, "{:?}", frame.notices);
    let alone = verdicts(&scene, &Options::default());
    assert_eq!(alone, [Verdict::Undecided]);
}

/// A brick on two pins of heights from 1/4 m down to 2⁻²⁰ m. Without pins, a gap as narrow as the lowest ones would
/// count as a contact. The upper brick rests on the pins only, never on the brick below them.
#[test]
fn pins_keep_a_gap_open_however_low() {
    for exponent in 2..=20 {
        let height = libm::exp2(-f64::from(exponent));
        for (x, expected) in [(-0.05, STANDS), (-1.5, FALLS), (0.95, FALLS), (1.45, FALLS)] {
            let mut file = topped(1, 1.0, 0.0);
            let blocks = file["blocks"].as_array_mut().expect("a list");
            let pin = |x: f64| rectangle(x, 1.0, height, height);
            blocks[1] = json!({ "id": "left pin", "polygon": pin(0.125) });
            blocks.push(json!({ "id": "right pin", "polygon": pin(1.5) }));
            let above = rectangle(x, 1.0 + height, 2.0, 1.0);
            blocks.push(json!({ "id": "above", "polygon": above }));
            for degrees in [0.0, 17.3] {
                let found = verdict(&rotated(&file, degrees));
                assert_eq!(found, expected, "{height:e} {x} {degrees}°");
            }
        }
    }
}

/// The same towers with a stone 1 m wide whose given weight is 10⁻² to 10⁻¹² of a brick's.
#[test]
fn light_stones_on_towers() {
    for bricks in [1, 3, 10, 30] {
        for exponent in [2, 4, 6, 8, 10, 12] {
            for (beyond, expected) in [(0.49, STANDS), (0.51, FALLS), (0.75, FALLS)] {
                let mut file = topped(bricks, 1.0, beyond);
                let blocks = file["blocks"].as_array_mut().expect("a list");
                for block in blocks.iter_mut() {
                    block["weight"] = json!(7.0);
                }
                blocks[bricks]["weight"] = json!(7.0 * libm::exp10(-f64::from(exponent)));
                assert_eq!(verdict(&file), expected, "{bricks}, 1e-{exponent}, {beyond}");
            }
        }
    }
}

/// A ramp on a tower and a light stone on it. The stone slides if the slope exceeds its friction coefficient.
#[test]
fn light_stones_on_slopes() {
    for bricks in [1, 5, 20] {
        for exponent in [0, 3, 6, 9, 12] {
            for slope in [0.0625, 0.5] {
                for (friction, expected) in [(slope * 1.01, STANDS), (slope * 0.99, FALLS), (0.0, FALLS)] {
                    let mut blocks: Vec<Value> = (0..bricks)
                        .map(|k| {
                            let at = rectangle(0.0, f64::from(k), 2.0, 1.0);
                            block(&format!("b{k}"), at, 5.0)
                        })
                        .collect();
                    let y = f64::from(bricks);
                    let ramp = json!([[0, y], [2, y], [2, y + 2.0 * slope]]);
                    blocks.push(block("ramp", ramp, 5.0));
                    let (left, right) = (y + 0.5 * slope, y + slope);
                    let stone = json!([[0.5, left], [1.0, right], [1.0, right + 0.25], [0.5, left + 0.25]]);
                    let mut stone = block("stone", stone, 5.0 * libm::exp10(-f64::from(exponent)));
                    stone["friction"] = json!(friction);
                    blocks.push(stone);
                    assert_eq!(
                        verdict(&on_floor(0.7, blocks)),
                        expected,
                        "{bricks}, 1e-{exponent}, {slope} {friction}"
                    );
                }
            }
        }
    }
}

/// Small stones in the gaps of a wall stand if they rest on the course below. A stone without friction that only
/// touches the sides of two bricks falls, even if it is very small.
#[test]
fn small_stones_in_the_joints_of_a_wall_stand_unless_they_are_lifted() {
    for size in [0.1, 0.01, 0.001] {
        for courses in [2, 6] {
            let mut blocks = Vec::new();
            for course in 0..courses {
                for k in 0..3 {
                    let x = f64::from(k) * (1.0 + size) + if course % 2 == 1 { 0.5 } else { 0.0 };
                    let y = f64::from(course) * 0.5;
                    let id = format!("{course}-{k}");
                    let at = rectangle(x, y, 1.0, 0.5);
                    blocks.push(json!({ "id": id, "polygon": at }));
                    if k < 2 && course > 0 {
                        // The stone is as wide as the gap, half as high as wide, and rests on the course below.
                        let at = rectangle(x + 1.0, y, size, 0.5 * size);
                        blocks.push(json!({ "id": format!("pin {id}"), "polygon": at }));
                    }
                }
            }
            let file = |blocks: Vec<Value>| {
                json!({ "drystone": 1, "friction": 0.6, "density": 2000,
                    "ground": [{ "polygon": rectangle(-5.0, -1.0, 12.0, 1.0) }], "blocks": blocks })
            };
            assert_eq!(verdict(&file(blocks.clone())), STANDS, "{size}, {courses}");
            // The last stone is raised above the course below. It has no friction, and touches only the sides of two
            // bricks.
            let lifted = blocks.iter_mut().rev().find(|b| b["id"].as_str().is_some_and(|id| id.starts_with("pin")));
            if let Some(pin) = lifted {
                pin["friction"] = json!(0.0);
                for corner in pin["polygon"].as_array_mut().expect("corners") {
                    let y = corner[1].as_f64().expect("a number");
                    corner[1] = json!(y + 0.2);
                }
            }
            assert_eq!(verdict(&file(blocks)), FALLS, "{size}, {courses}, lifted");
        }
    }
}

/// The reported forces balance each block if each force may change by 10⁻⁷ of its magnitude and may be moved by 10⁻⁷
/// of the block's radius. This is the tolerance of a proof.
#[test]
fn reported_forces_balance_every_block_within_the_tolerance() {
    let mut files =
        vec![wall(5, 5), arch(11, 0.4, 0.9), harmonic(6, 0.95), wedge(1e-2), on_slope(20.0, 3.0, 1.0, 0.5, 0.2)];
    for size in [1.0, 1e-2, 1e-4] {
        files.extend([1, 4, 12].map(|bricks| topped(bricks, size, 0.4)));
    }
    for file in files {
        let scene = Scene::from_json(&file.to_string()).expect("a scene");
        let frame = Analysis::new(&scene).frames.remove(0);
        assert_eq!(frame.verdict, STANDS, "{file}");
        for (number, block) in scene.blocks().iter().enumerate() {
            let outline = block.body.polygon.outline().iter();
            let reach = outline.map(|p| (p - block.centroid).norm());
            let radius = reach.fold(0.0, f64::max);
            let mut all = vec![(block.centroid, scene.down() * block.weight)];
            for contact in &frame.contacts {
                let normal = contact.interface.normal;
                let tangent = Vector::new(-normal.y, normal.x);
                let sides = contact.interface.bodies.iter().zip([1.0, -1.0]);
                for (_, sign) in sides.filter(|s| *s.0 == BodyId::Block(BlockId(number))) {
                    let points = contact.application_points;
                    all.push((points[0], normal * (sign * contact.normal_forces[0])));
                    all.push((points[1], normal * (sign * contact.normal_forces[1])));
                    all.push((contact.interface.ends[0], tangent * (sign * contact.friction_force)));
                }
            }
            let column =
                |(at, force): &(Point, Vector)| [force.x, force.y, cross(at - block.centroid, *force) / radius];
            let mut generators: Vec<[f64; 3]> = all.iter().map(column).collect();
            let left = generators.iter().fold([0.0; 3], |sum, g| [sum[0] + g[0], sum[1] + g[1], sum[2] + g[2]]);
            let total: f64 = all.iter().map(|(_, force)| force.norm()).sum();
            generators.push([0.0, 0.0, total]);
            // Generators are scaled by at most 10⁻⁷, so these two permit a rounding error of 10⁻¹⁵ of the forces.
            generators.push([1e-8 * total, 0.0, 0.0]);
            generators.push([0.0, 1e-8 * total, 0.0]);
            let scale = zonotope_gauge(&generators, left);
            assert!(scale <= 1e-7, "{}: {scale:e}\n{file}", block.id);
        }
    }
}
