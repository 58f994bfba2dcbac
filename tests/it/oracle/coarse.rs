//! Tolerances as large as blocks: healing may close gaps with them, but what it cannot heal makes no statement false.
//!
//! The bodies of these scenes touch to the last bit, so the exact program knows the verdict of the outlines. They are looked at as
//! they are, and with every corner off by a thousandth of the smallest block.
//! `DRYSTONE_ORACLE_COARSE=3000` looks at more of them, `DRYSTONE_ORACLE_FIRST` is the number of the first.

use drystone::Analysis;
use drystone::analysis::Verdict;
use drystone::scene::Scene;
use rayon::prelude::*;
use serde_json::{Value, json};

use super::balance::Balance;
use super::{number_of, random, touch};
use crate::random::Random;

/// Tolerances in parts of the smallest block, the square root of its area.
const SHARES: [f64; 4] = [0.05, 0.3, 1.0, 3.0];

/// How far corners are off, in parts of the smallest block.
const OFF: f64 = 1e-3;
/// By which share of its loads a structure must be clear of its limit for corners that are off to change nothing.
const CLEAR: f64 = 0.02;

/// The exact programs of more blocks take long.
const MOST_BLOCKS: usize = 5;

/// What one scene gave with one tolerance.
struct Found {
    number: u64,
    share: f64,
    is_off: bool,
    /// Corners that moved, and bodies left as written.
    moved: usize,
    kept: usize,
    /// Interfaces beyond those of the outlines as written.
    more: i64,
    is_wrong: bool,
    text: String,
}

fn found(number: u64) -> Vec<Found> {
    let (kind, file) = random::scene(number);
    let sound = |file: &Value| {
        let scene = Scene::from_json(&file.to_string()).ok()?;
        scene.penetrations().is_empty().then_some(scene)
    };
    let Some(written) = sound(&file).filter(|_| random::KINDS[kind].1 && kind >= 2) else {
        return Vec::new();
    };
    if written.blocks().len() > MOST_BLOCKS {
        return Vec::new();
    }
    let touches = touch::touches(&written);
    let groups = Balance::groups(&written, &touches);
    let falls = groups.iter().any(|group| !group.stands());
    let areas = written
        .blocks()
        .iter()
        .map(|block| block.body.polygon.area());
    let least = areas.fold(f64::INFINITY, f64::min).sqrt();
    let is_clear = match falls {
        true => groups.iter().any(|group| group.distance() > CLEAR),
        false => groups.iter().all(|group| group.stands_with_margin(CLEAR)),
    };
    let both = SHARES
        .into_iter()
        .flat_map(|share| [(share, false), (share, true)]);
    let each = both
        .filter(|(_, is_off)| is_clear || !is_off)
        .filter_map(|(share, is_off)| {
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

/// A verdict that differs from that of the outlines as written needs corners that moved or gaps that were closed.
#[test]
#[expect(
    clippy::print_stdout,
    reason = "the counts are the result of a long run"
)]
fn tolerances_as_large_as_blocks_change_no_verdict_without_closing_a_gap() {
    let first = number_of("DRYSTONE_ORACLE_FIRST", 0);
    let wanted = number_of("DRYSTONE_ORACLE_COARSE", 36);
    let all: Vec<Found> = (first..first + wanted)
        .into_par_iter()
        .flat_map_iter(found)
        .collect();
    let count = |f: &dyn Fn(&&Found) -> bool| all.iter().filter(f).count();
    println!(
        "{} scenes with a tolerance, {} of them with corners that are off, {} with bodies left as written; {} other verdicts, {} of them with such bodies",
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
    let bad: Vec<u64> = all
        .iter()
        .filter(|f| f.is_wrong && f.moved == 0 && f.more == 0)
        .map(|f| f.number)
        .collect();
    assert!(bad.is_empty(), "{bad:?}");
}
