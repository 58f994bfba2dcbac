//! Round stones: bodies with many corners, whose edges are as short as the contact tolerance or shorter.
//!
//! `DRYSTONE_PEBBLES=6000` checks more random pebbles than the usual 300. `DRYSTONE_PEBBLES_FIRST` is the number of
//! the first pebble.

use drystone::analysis::Verdict;
use drystone::{Analysis, Scene};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::random::Random;

type Outline = Vec<[f64; 2]>;

/// The number that a file contains if it is written with this many decimals; `None` keeps all digits.
fn written(x: f64, decimals: Option<usize>) -> f64 {
    match decimals {
        Some(decimals) => format!("{x:.decimals$}").parse().unwrap(),
        None => x,
    }
}

fn rounded(outline: &Outline, decimals: Option<usize>) -> Outline {
    outline.iter().map(|p| p.map(|x| written(x, decimals))).collect()
}

/// A scene of one stone on flat ground, which extends from −`reach` to `reach`.
fn on_ground(stone: &Outline, reach: f64, tolerance: Option<f64>) -> Value {
    let mut file = json!({
        "drystone": 1,
        "ground": [{ "polygon": [[-reach, -reach], [reach, -reach], [reach, 0.0], [-reach, 0.0]] }],
        "blocks": [{ "id": "stone", "polygon": stone }],
    });
    if let Some(tolerance) = tolerance {
        file["contact_tolerance"] = json!(tolerance);
    }
    file
}

/// The corners of a regular polygon that rests with its lowest edge on y = 0.
fn circle(radius: f64, corners: usize) -> Outline {
    let half = core::f64::consts::PI / corners as f64;
    let lowest = radius * libm::cos(half);
    let corner = |k: usize| {
        let angle = (2 * k + 1) as f64 * half - core::f64::consts::FRAC_PI_2;
        let (sin, cos) = libm::sincos(angle);
        [radius * cos, lowest + radius * sin]
    };
    (0..corners).map(corner).collect()
}

/// The outline without corners that equal the previous corner.
fn without_repeats(outline: Outline) -> Outline {
    let mut out: Outline = Vec::with_capacity(outline.len());
    for p in outline {
        if out.last() != Some(&p) {
            out.push(p);
        }
    }
    while out.len() > 1 && out.first() == out.last() {
        out.pop();
    }
    out
}

fn verdict(file: &Value) -> Result<(Verdict, String), String> {
    let scene = Scene::from_json(&file.to_string()).map_err(|problems| problems.to_string())?;
    let frame = Analysis::new(&scene).frames.remove(0);
    assert!(frame.proof.holds() || frame.verdict == Verdict::Undecided, "{file}");
    Ok((frame.verdict, frame.doubt()))
}

#[test]
fn stones_with_edges_shorter_than_the_tolerance_stand() {
    for text in [include_str!("pebbles/many-corners.json"), include_str!("pebbles/circle-200.json")] {
        let file: Value = serde_json::from_str(text).expect("JSON");
        assert_eq!(verdict(&file).expect("sound").0, Verdict::Stable);
    }
}

/// A circle stands on its lowest edge, whatever its size, its number of corners and the decimals in the file.
#[test]
fn a_circle_of_any_size_and_any_number_of_corners_stands_on_its_lowest_edge() {
    let counts = [20, 50, 200, 500, 2000, 5000];
    let mut cases = Vec::new();
    for (radius, most) in [(0.1, 6), (5.0, 6), (100.0, 4)] {
        for corners in counts {
            for decimals in (0..=most).map(Some).chain([None]) {
                cases.push((radius, corners, decimals));
            }
        }
    }
    let wrong: Vec<String> = cases
        .par_iter()
        .filter_map(|(radius, corners, decimals)| {
            let stone = without_repeats(rounded(&circle(*radius, *corners), *decimals));
            let file = on_ground(&stone, 10.0 * radius, None);
            match verdict(&file) {
                Ok((Verdict::Stable, _)) => None,
                // Rounding has left fewer than three corners.
                Err(_) if stone.len() < 3 => None,
                other => Some(format!("{radius} {corners} {decimals:?}: {other:?}")),
            }
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A contact tolerance from a thousandth of the radius to a thousand times the radius does not change an outline.
#[test]
fn a_tolerance_larger_than_the_block_does_not_change_its_outline() {
    let mut cases = Vec::new();
    for corners in [3, 4, 5, 20, 77, 200, 1000] {
        for ratio in [0.001, 0.01, 0.1, 1.0, 10.0, 1000.0] {
            cases.push((corners, ratio));
        }
    }
    let wrong: Vec<String> = cases
        .par_iter()
        .filter_map(|(corners, ratio)| {
            let file = on_ground(&circle(0.1, *corners), 1.0, Some(0.1 * ratio));
            match verdict(&file) {
                Ok((Verdict::Stable, _)) => None,
                other => Some(format!("{corners} {ratio}: {other:?}")),
            }
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The corners of the convex hull, anticlockwise, beginning with the leftmost corner.
fn hull(mut points: Outline) -> Outline {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let chain = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Outline = Vec::new();
        for p in points {
            while chain.len() > 1 && turn(chain[chain.len() - 2], chain[chain.len() - 1], *p) <= 0.0 {
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let mut out = chain(&mut points.iter());
    out.extend(chain(&mut points.iter().rev()));
    out
}

fn centroid(outline: &Outline) -> [f64; 2] {
    let base = outline[0];
    let (mut area, mut x, mut y) = (0.0, 0.0, 0.0);
    for (i, a) in outline.iter().enumerate() {
        let b = outline[(i + 1) % outline.len()];
        let (a, b) = ([a[0] - base[0], a[1] - base[1]], [b[0] - base[0], b[1] - base[1]]);
        let cross = a[0] * b[1] - a[1] * b[0];
        area += cross;
        x += cross * (a[0] + b[0]);
        y += cross * (a[1] + b[1]);
    }
    [base[0] + x / (3.0 * area), base[1] + y / (3.0 * area)]
}

/// Corners of an ellipse at random angles, each moved inwards by up to `rough` of its radius.
fn pebble(chance: &mut Random, radius: f64, corners: usize, rough: f64) -> Outline {
    let turn = core::f64::consts::TAU;
    let mut angles: Vec<f64> = (0..corners).map(|_| turn * chance.share()).collect();
    angles.sort_by(f64::total_cmp);
    let flat = 0.4 + 0.6 * chance.share();
    let corner = |angle: f64, off: f64| {
        let (sin, cos) = libm::sincos(angle);
        [radius * off * cos, radius * off * flat * sin]
    };
    angles.into_iter().map(|angle| corner(angle, 1.0 - rough * chance.share())).collect()
}

/// The stone, rotated and moved so that an edge of its hull lies on y = 0. With a probability of 70 %, the centre of
/// gravity lies above this edge; otherwise it is any edge.
fn laid_down(chance: &mut Random, stone: &Outline) -> Outline {
    let around = hull(stone.clone());
    let centre = centroid(stone);
    let edge = |i: usize| (around[i], around[(i + 1) % around.len()]);
    let all: Vec<usize> = (0..around.len()).collect();
    let bears = |i: &usize| {
        let (a, b) = edge(*i);
        let along = [b[0] - a[0], b[1] - a[1]];
        let s = along[0] * (centre[0] - a[0]) + along[1] * (centre[1] - a[1]);
        s > 0.0 && s < along[0] * along[0] + along[1] * along[1]
    };
    let bearing: Vec<usize> = all.iter().copied().filter(bears).collect();
    let bottom = if chance.percent(70) { chance.one_of(&bearing) } else { chance.one_of(&all) };
    let (a, b) = edge(bottom);
    let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
    let (cos, sin) = ((b[0] - a[0]) / length, (b[1] - a[1]) / length);
    let place = |p: &[f64; 2]| {
        let d = [p[0] - a[0], p[1] - a[1]];
        let y = cos * d[1] - sin * d[0];
        // Both corners of this edge lie exactly on the ground.
        let y = if *p == a || *p == b { 0.0 } else { y };
        [cos * d[0] + sin * d[1], y]
    };
    stone.iter().map(place).collect()
}

/// The stone, rotated by a random angle, with its lowest corner on y = 0.
fn dropped(chance: &mut Random, stone: &Outline) -> Outline {
    let (sin, cos) = libm::sincos(core::f64::consts::TAU * chance.share());
    let turned = |p: &[f64; 2]| [cos * p[0] - sin * p[1], sin * p[0] + cos * p[1]];
    let turned: Outline = stone.iter().map(turned).collect();
    let lowest = turned.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    turned.iter().map(|p| [p[0], p[1] - lowest]).collect()
}

/// A random pebble: its scene file, its outline as written, and by how many metres rounding may have lifted its
/// corners off the ground.
fn random(number: u64) -> (Value, Outline, f64) {
    let mut chance = Random::new(number);
    let radius = chance.one_of(&[0.01, 0.05, 0.1, 0.5, 1.0, 5.0, 100.0]);
    let corners = chance.whole(20, 80) as usize;
    let rough = chance.one_of(&[0.0, 0.0, 0.02, 0.1]);
    let stone = pebble(&mut chance, radius, corners, rough);
    // A rough stone on an edge of its hull would touch the ground only at two corners, and corners carry no force.
    let stone =
        if rough == 0.0 && chance.percent(50) { laid_down(&mut chance, &stone) } else { dropped(&mut chance, &stone) };
    // At least three digits of the radius are kept.
    let least = (2.5 - libm::log10(radius)).ceil().max(0.0) as usize;
    let decimals = match chance.whole(0, 5) {
        5 => None,
        more => Some(least + more as usize),
    };
    let stone = without_repeats(rounded(&stone, decimals));
    // As in `scene::heal`: three times the rounding error of a coordinate.
    let slack = decimals.map_or(0.0, |k| 1.5 * libm::pow(10.0, -(k as f64)) * (1.0 + 1e-9));
    (on_ground(&stone, 10.0 * radius, None), stone, slack)
}

/// Whether a stone on y = 0 stands: its centre of gravity lies above the edges on the ground. Corners up to `slack`
/// above the ground count as on it.
fn stands(stone: &Outline, slack: f64) -> bool {
    let mut rests = (f64::INFINITY, f64::NEG_INFINITY);
    for (i, a) in stone.iter().enumerate() {
        let b = stone[(i + 1) % stone.len()];
        if a[1] <= slack && b[1] <= slack {
            rests = (rests.0.min(a[0].min(b[0])), rests.1.max(a[0].max(b[0])));
        }
    }
    let centre = centroid(stone)[0];
    rests.0 <= centre && centre <= rests.1
}

/// The number of a pebble, its verdict and doubt or its problems, and whether it should stand: exactly, and if
/// corners within rounding of the ground count as on it.
type Answer = (u64, Result<(Verdict, String), String>, [bool; 2]);

#[test]
#[allow(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn few_random_pebbles_are_undecided() {
    let number = |name: &str, usual: u64| {
        let value = std::env::var(name).ok();
        value.map_or(usual, |v| v.parse().expect("a number"))
    };
    let first = number("DRYSTONE_PEBBLES_FIRST", 0);
    let count = number("DRYSTONE_PEBBLES", 300);
    let found: Vec<Answer> = (first..first + count)
        .into_par_iter()
        .map(|number| {
            let (file, stone, slack) = random(number);
            let by_hand = [0.0, slack].map(|slack| stands(&stone, slack));
            (number, verdict(&file), by_hand)
        })
        .collect();
    let mut undecided = Vec::new();
    let mut wrong = Vec::new();
    let mut refused = Vec::new();
    let mut standing = 0;
    for (number, verdict, [exactly, within_rounding]) in found {
        match (verdict, exactly) {
            (Err(problems), _) => refused.push(format!("{number}: {problems}")),
            (Ok((Verdict::Undecided, doubt)), _) => undecided.push(format!("{number}: {doubt}")),
            (Ok((Verdict::Stable, _)), true) => standing += 1,
            (Ok((Verdict::Unstable, _)), false) => {}
            // The two expected answers differ, so either verdict is permitted.
            (Ok(_), _) if exactly != within_rounding => {}
            (Ok((verdict, _)), _) => wrong.push(format!("{number}: {verdict:?}")),
        }
    }
    println!("{count} pebbles: {standing} stand, {} are undecided, {} are refused", undecided.len(), refused.len());
    let few = |list: &[String]| list[..list.len().min(20)].join("\n");
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), few(&wrong));
    assert!(undecided.len() as u64 <= 1 + count / 300, "{} undecided:\n{}", undecided.len(), few(&undecided));
    assert!(refused.len() as u64 <= count / 10, "{}", few(&refused));
}

/// Circles and pebbles with all digits keep their verdict if they are rotated with gravity, mirrored, or made a
/// million times larger or smaller.
#[test]
fn a_stone_keeps_its_verdict_if_it_is_rotated_mirrored_or_scaled() {
    let mut stones: Vec<(String, Outline)> =
        [20, 200, 2000].into_iter().map(|corners| (format!("circle of {corners}"), circle(0.1, corners))).collect();
    stones.extend((0..60).map(|number| {
        let mut chance = Random::new(number);
        let corners = chance.whole(20, 80) as usize;
        let stone = pebble(&mut chance, 0.1, corners, 0.0);
        (format!("pebble {number}"), laid_down(&mut chance, &stone))
    }));
    let moves: [(&str, [f64; 4]); 6] = [
        ("mirrored", [-1.0, 0.0, 0.0, 1.0]),
        ("upright", [0.0, -1.0, 1.0, 0.0]),
        ("turned by 36.9°", [0.8, -0.6, 0.6, 0.8]),
        ("turned by 100°", {
            let (sin, cos) = libm::sincos(100_f64.to_radians());
            [cos, -sin, sin, cos]
        }),
        ("a million times as large", [1e6, 0.0, 0.0, 1e6]),
        ("a million times as small", [1e-6, 0.0, 0.0, 1e-6]),
    ];
    let wrong: Vec<String> = stones
        .par_iter()
        .flat_map_iter(|(name, stone)| {
            let moved = |m: &[f64; 4]| {
                let place = |p: &[f64; 2]| [m[0] * p[0] + m[1] * p[1], m[2] * p[0] + m[3] * p[1]];
                let is_mirrored = m[0] * m[3] - m[1] * m[2] < 0.0;
                let ring = |ring: &Outline| {
                    let mut ring: Outline = ring.iter().map(place).collect();
                    if is_mirrored {
                        ring.reverse();
                    }
                    ring
                };
                let down = place(&[0.0, -1.0]);
                let length = libm::hypot(down[0], down[1]);
                let ground = vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 0.0], [-1.0, 0.0]];
                let file = json!({
                    "drystone": 1,
                    "gravity": down.map(|d| 9.81 * d / length),
                    "ground": [{ "polygon": ring(&ground) }],
                    "blocks": [{ "id": "stone", "polygon": ring(stone), "weight": 1.0 }],
                });
                verdict(&file)
            };
            let plain = moved(&[1.0, 0.0, 0.0, 1.0]).expect("sound").0;
            let mut wrong = Vec::new();
            for (word, by) in &moves {
                match moved(by) {
                    Ok((verdict, _)) if verdict == plain => {}
                    other => wrong.push(format!("{name} {word}: {plain:?}, then {other:?}")),
                }
            }
            wrong
        })
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
