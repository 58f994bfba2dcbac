//! Contact tolerances as large as blocks: healing may close gaps, but if healing fails, no result may be false.
//!
//! The bodies of these scenes touch exactly, so the exact program gives the verdict of the outlines. Each scene is
//! analysed as written, and with every corner moved by up to a thousandth of the size of the smallest block.
//! `DRYSTONE_ORACLE_COARSE=3000` sets the number of scenes, `DRYSTONE_ORACLE_FIRST` the number of the first scene.

use drystone::Analysis;
use drystone::analysis::Verdict;
use drystone::internals::geometry::Point;
use drystone::scene::{BodyId, Scene};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::balance::Balance;
use super::{Standing, judged, number_of, random, touch};
use crate::random::Random;

/// Contact tolerances relative to the size of the smallest block, which is the square root of its area.
const SHARES: [f64; 4] = [0.05, 0.3, 1.0, 3.0];

/// How far corners are moved, relative to the size of the smallest block.
const OFF: f64 = 1e-3;
/// Scenes with moved corners are checked only if the structure is farther from its limit than this fraction of its
/// loads.
const CLEAR: f64 = 0.02;

/// The exact program is slow for more blocks.
const MAX_BLOCKS: usize = 5;

/// The result of one scene with one contact tolerance.
struct Found {
    number: u64,
    share: f64,
    is_off: bool,
    /// The number of corners that healing moved.
    moved: usize,
    /// The number of bodies left as written.
    kept: usize,
    /// The number of interfaces minus the number of interfaces of the outlines as written.
    more: i64,
    is_wrong: bool,
    text: String,
}

/// The results of one random scene with each tolerance. Empty if the scene is invalid or too large.
fn found(number: u64) -> Vec<Found> {
    let (kind, file) = random::scene(number);
    let sound = |file: &Value| {
        let scene = Scene::from_json(&file.to_string()).ok()?;
        scene.penetrations().is_empty().then_some(scene)
    };
    let Some(written) = sound(&file).filter(|_| random::KINDS[kind].1 && kind >= 2) else {
        return Vec::new();
    };
    if written.blocks().len() > MAX_BLOCKS {
        return Vec::new();
    }
    let touches = touch::touches(&written);
    let groups = Balance::groups(&written, &touches);
    let falls = groups.iter().any(|group| !group.stands());
    let areas = written.blocks().iter().map(|block| block.body.polygon.area());
    let least = areas.fold(f64::INFINITY, f64::min).sqrt();
    let is_clear = if falls {
        groups.iter().any(|group| group.distance() > CLEAR)
    } else {
        groups.iter().all(|group| group.stands_with_margin(CLEAR))
    };
    let both = SHARES.into_iter().flat_map(|share| [(share, false), (share, true)]);
    let each = both.filter(|(_, is_off)| is_clear || !is_off).filter_map(|(share, is_off)| {
        let mut file = file.clone();
        if is_off {
            jitter(&mut file, OFF * least, number);
        }
        file["contact_tolerance"] = json!(share * least);
        let scene = sound(&file)?;
        let analysis = Analysis::new(&scene);
        let frame = &analysis.frames[0];
        let is_wrong = match frame.verdict {
            Verdict::Stable => falls,
            Verdict::Unstable => !falls,
            Verdict::Undecided => false,
        };
        let is_wrong = is_wrong && !groups.iter().any(Balance::is_borderline);
        let healed = scene.healed();
        let words = scene.tolerance_words().unwrap_or_default();
        Some(Found {
            number,
            share,
            is_off,
            moved: healed.corners,
            kept: healed.kept,
            more: frame.contacts.len() as i64 - touches.len() as i64,
            is_wrong,
            text: format!("{:?} {words}", frame.verdict),
        })
    });
    each.collect()
}

/// Moves every corner by up to `off` along each axis.
fn jitter(file: &mut Value, off: f64, number: u64) {
    let mut chance = Random::new(number ^ 0x00c0_a45e);
    for bodies in ["ground", "blocks"] {
        for body in file[bodies].as_array_mut().into_iter().flatten() {
            for corner in body["polygon"].as_array_mut().into_iter().flatten() {
                for axis in 0..2 {
                    let at = corner[axis].as_f64().expect("a number");
                    corner[axis] = json!(at + off * (2.0 * chance.share() - 1.0));
                }
            }
        }
    }
}

/// A verdict may differ from that of the outlines as written only if corners moved or gaps were closed.
#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn tolerances_as_large_as_blocks_change_no_verdict_without_closing_a_gap() {
    let first = number_of("DRYSTONE_ORACLE_FIRST", 0);
    let wanted = number_of("DRYSTONE_ORACLE_COARSE", 36);
    let all: Vec<Found> = (first..first + wanted).into_par_iter().flat_map_iter(found).collect();
    let count = |f: &dyn Fn(&&Found) -> bool| all.iter().filter(f).count();
    println!(
        "{} scenes with a tolerance, {} of them with moved corners, {} with bodies left as written; {} different verdicts, {} of them with such bodies",
        all.len(),
        count(&|f| f.is_off),
        count(&|f| f.kept > 0),
        count(&|f| f.is_wrong),
        count(&|f| f.is_wrong && f.kept > 0),
    );
    for f in all.iter().filter(|f| f.is_wrong) {
        println!(
            "{} {} {}: moved {}, kept {}, interfaces {:+}: {}",
            f.number, f.share, f.is_off, f.moved, f.kept, f.more, f.text
        );
    }
    let bad: Vec<u64> = all.iter().filter(|f| f.is_wrong && f.moved == 0 && f.more == 0).map(|f| f.number).collect();
    assert!(bad.is_empty(), "{bad:?}");
}

/// Three stones. Two have nine corners and stand on separate ground below their lowest edges. With a tolerance of
/// 0.05 m, healing would push corners of some stones into other stones.
fn stones(number: u64) -> Value {
    let mut chance = Random::new(number ^ 0x0057_0e35);
    let mut near = |at: [f64; 2]| at.map(|v| v + 0.02 * (2.0 * chance.share() - 1.0));
    let a: Vec<[f64; 2]> = [
        [0.98, 0.21],
        [0.84, 0.54],
        [0.29, 0.96],
        [0.0, 1.0],
        [-0.4, 0.92],
        [-0.53, 0.85],
        [-0.76, 0.65],
        [-0.3, -1.0],
        [0.4, -0.96],
    ]
    .map(&mut near)
    .into();
    let b: Vec<[f64; 2]> = [
        [2.97, 0.39],
        [2.65, 0.85],
        [2.57, 0.91],
        [2.44, 0.98],
        [1.59, 0.97],
        [1.06, 0.34],
        [1.55, -0.82],
        [2.7, -0.85],
        [3.02, 0.01],
    ]
    .map(&mut near)
    .into();
    let c: Vec<[f64; 2]> = [[1.61, 2.52], [0.78, 2.71], [0.0, 1.65], [1.54, 0.89], [1.56, 0.9]].map(&mut near).into();
    // The ground below an edge ends at the corners of the edge.
    let below = |from: [f64; 2], to: [f64; 2]| json!({ "polygon": [from, [from[0], -2.0], [to[0], -2.0], to] });
    let friction = chance.one_of(&[0.1, 0.3, 0.7, 1.5]);
    // In some scenes a robot holds the third stone.
    let robots = if chance.percent(60) { json!([{ "id": "r", "holds": "c" }]) } else { json!([]) };
    json!({ "drystone": 1, "contact_tolerance": 0.05, "friction": friction, "robots": robots,
        "ground": [below(a[7], a[8]), below(b[6], b[7])],
        "blocks": [
            { "id": "a", "polygon": a },
            { "id": "b", "polygon": b },
            { "id": "c", "polygon": c }
        ] })
}

/// The distance of a point from the outline of a body, metres.
fn distance(scene: &Scene, body: BodyId, at: Point) -> f64 {
    let body = match body {
        BodyId::Block(id) => &scene.blocks()[id.0].body,
        BodyId::Ground(part) => &scene.ground()[part].body,
    };
    let outline = body.polygon.outline();
    let away = (0..outline.len()).map(|k| {
        let (from, to) = (outline[k], outline[(k + 1) % outline.len()]);
        let along = to - from;
        let share = (at - from).dot(&along) / along.norm_squared();
        (at - from - along * share.clamp(0.0, 1.0)).norm()
    });
    away.fold(f64::INFINITY, f64::min)
}

/// A body that cannot be healed stays as written. The results are true of the outlines that the analysis uses: the
/// exact program over the contacts found has the same verdict and sums, and bodies touch only within the stated
/// tolerance. `DRYSTONE_ORACLE_KEPT=2000` sets the number of scenes.
#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn results_are_true_of_the_outlines_of_bodies_that_healing_left_as_written() {
    let wanted = number_of("DRYSTONE_ORACLE_KEPT", 60);
    let (mut kept, mut touching) = (0, 0);
    let mut verdicts = [0; 3];
    for number in 0..wanted {
        let Ok(scene) = Scene::from_json(&stones(number).to_string()) else {
            continue;
        };
        if scene.healed().kept == 0 || !scene.penetrations().is_empty() {
            continue;
        }
        kept += 1;
        let analysis = Analysis::new(&scene);
        let frame = &analysis.frames[0];
        verdicts[frame.verdict as usize] += 1;
        let (standing, error) = judged(&scene, &touch::as_found(&scene), frame, true);
        let is_true = !matches!(standing, Standing::Wrong | Standing::Undecided);
        assert!(is_true, "{number}: {standing:?} {:?}", frame.verdict);
        assert!(error.is_none_or(|e| e < 1e-6), "{number}: {error:?}");
        let words = scene.tolerance_words().expect("no lattice");
        assert!(words.contains("stayed as written"), "{words}");
        for contact in &frame.contacts {
            touching += 1;
            for (end, body) in contact
                .interface
                .ends
                .iter()
                .flat_map(|end| contact.interface.bodies.iter().map(move |body| (*end, *body)))
            {
                let off = distance(&scene, body, end);
                assert!(off <= scene.tolerance().gap, "{number}: {off} m");
            }
        }
    }
    println!("{kept} of {wanted} scenes with bodies left as written, {touching} contacts, verdicts {verdicts:?}");
    assert!(kept > wanted / 10, "{kept}");
    assert!(verdicts[0] > 0 && verdicts[2] > 0, "{verdicts:?}");
}
