//! Capacities of random scenes, compared with exact programs.

use drystone::analysis::{CapacityError, CapacityRequest, CapacityShape, ForceAt};
use drystone::{Analysis, Scene};
use rayon::prelude::*;

use super::of;
use crate::oracle::balance::Balance;
use crate::oracle::number_of;
use crate::oracle::touch::touches;

/// In each of 90 directions, the set extends as far as the exact set, up to a millionth of its size.
/// `DRYSTONE_CAPACITY_SCENES=1000` compares more scenes than the usual 30.
#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn random_sets_are_those_of_an_exact_program() {
    let first = number_of("DRYSTONE_CAPACITY_FIRST", 0);
    let wanted = number_of("DRYSTONE_CAPACITY_SCENES", 30);
    let directions: Vec<[f64; 2]> = (0..90)
        .map(|k| libm::sincos(0.013 + f64::from(k) * std::f64::consts::TAU / 90.0))
        .map(|(sin, cos)| [cos, sin])
        .collect();
    let all: Vec<Result<Compared, String>> =
        (first..first + wanted).into_par_iter().map(|number| compared(number, &directions)).collect();
    let bad: Vec<&String> = all.iter().filter_map(|found| found.as_ref().err()).collect();
    let good: Vec<_> = all.iter().flatten().flatten().collect();
    let skipped: Vec<&Skipped> = all.iter().flatten().filter_map(|found| found.as_ref().err()).collect();
    let worst = good.iter().fold([0.0, 0.0], |[a, b]: [f64; 2], c| [a.max(c.0), b.max(c.1)]);
    println!(
        "{} sets, beyond the exact set by at most {:.1e}, short of it by at most {:.1e}; {} wrong",
        good.len(),
        worst[0],
        worst[1],
        bad.len()
    );
    for shape in ["empty", "point", "segment", "polygon", "unbounded", "everything"] {
        let count = good.iter().filter(|c| c.2.word() == shape).count();
        println!("{shape}: {count}");
    }
    let count = |why: Skipped| skipped.iter().filter(|found| ***found == why).count();
    let withheld: Vec<u64> = skipped
        .iter()
        .filter_map(|found| match found {
            Skipped::Withheld(number) => Some(*number),
            _ => None,
        })
        .collect();
    println!(
        "not compared: {} no scene, {} within the band, {} withheld: {withheld:?}",
        count(Skipped::NoScene),
        count(Skipped::InBand),
        withheld.len()
    );
    assert!(bad.is_empty(), "{bad:#?}");
    assert!(good.len() as u64 * 2 > wanted);
    assert!(withheld.len() as u64 <= 2 + wanted / 100, "{withheld:?}");
}

/// The largest distances by which the set extends beyond the exact set and falls short of it, both divided by the
/// size of the set. Otherwise the reason why the scene is not compared.
type Compared = Result<(f64, f64, CapacityShape), Skipped>;

/// Why a scene is not compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Skipped {
    /// The scene is not valid, its blocks overlap, or rounding opens a contact of the exact program.
    NoScene,
    /// The other blocks are within the tolerance of their limit, or the set is empty in exact numbers but not empty
    /// within the tolerance.
    InBand,
    /// The capacity is withheld, because the proved forces and the proved motions do not agree closely enough.
    Withheld(u64),
}

/// Compares the capacity of one block of a random scene. An error is a text that describes a wrong set.
fn compared(number: u64, directions: &[[f64; 2]]) -> Result<Compared, String> {
    let file = crate::oracle::random::scene(number).1;
    let Ok(scene) = Scene::from_json(&file.to_string()) else {
        return Ok(Err(Skipped::NoScene));
    };
    let touches = touches(&scene);
    let frame = Analysis::new(&scene).frames.remove(0);
    let doubtful = !scene.penetrations().is_empty() || touches.len() != frame.contacts.len();
    if doubtful {
        return Ok(Err(Skipped::NoScene));
    }
    let groups = Balance::groups(&scene, &touches);
    let block = (number as usize * 7) % scene.blocks().len();
    let outline = scene.blocks()[block].body.polygon.outline();
    let at = match number % 3 {
        0 => scene.blocks()[block].centroid,
        _ => outline[number as usize % outline.len()],
    };
    let request = CapacityRequest::of_block(drystone::scene::BlockId(block)).at(ForceAt::Point(at));
    let own = groups.iter().find(|g| g.blocks.contains(&block)).expect("a group");
    let others = || groups.iter().filter(|g| !g.blocks.contains(&block));
    let is_borderline = others().any(Balance::is_borderline);
    if is_borderline {
        return Ok(Err(Skipped::InBand));
    }
    let stand = others().all(Balance::stands);
    let exact = if stand { own.farthest_forces(block, [at.x, at.y], directions) } else { None };
    let found = match of(&scene, request) {
        Ok(found) => found,
        Err(CapacityError::Undecided | CapacityError::Inexact(_) | CapacityError::GaveUp(_)) => {
            return Ok(Err(Skipped::Withheld(number)));
        }
        Err(why) => return Err(format!("{number}: {why}\n{file}")),
    };
    let Some(exact) = exact else {
        return match found.shape() {
            CapacityShape::Empty => Ok(Ok((0.0, 0.0, found.shape()))),
            // A force may be carried within the tolerance of a proof.
            _ if own.holds_within_band(block, [at.x, at.y]) => Ok(Err(Skipped::InBand)),
            shape => Err(format!("{number}: {shape:?} instead of empty\n{file}")),
        };
    };
    if found.shape() == CapacityShape::Empty {
        return Err(format!("{number}: empty\n{file}"));
    }
    let weight: f64 = scene.blocks().iter().map(|b| b.weight).fold(0.0, f64::max);
    let sizes = found.vertices.iter().map(|v| v.force.norm());
    let size = sizes.fold(weight.max(1e-3), f64::max);
    let (mut outside, mut short): (f64, f64) = (0.0, 0.0);
    for (direction, exact) in directions.iter().zip(exact) {
        match (found.most(*direction), exact) {
            (None, None) => {}
            (Some(most), Some(exact)) => {
                outside = outside.max((most - exact) / size);
                short = short.max((exact - most) / size);
            }
            other => {
                return Err(format!("{number}: {direction:?} {other:?} {:?}\n{file}", found.rays));
            }
        }
    }
    if outside > 1e-6 || short > 1e-6 {
        return Err(format!("{number}: outside {outside:e}, short {short:e}\n{file}"));
    }
    Ok(Ok((outside, short, found.shape())))
}
