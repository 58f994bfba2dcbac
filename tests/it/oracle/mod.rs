//! Compares verdicts with an exact linear program: a simplex in integers over the equilibrium equations of the scene.
//!
//! Every floating-point number is a fraction, so it has an exact answer whether a scene as written stands. This
//! directory has separate code that finds contacts, builds the equilibrium equations and solves them. It shares no
//! code with `program` and `solve`.
//!
//! `DRYSTONE_ORACLE_SCENES=10000` sets the number of scenes (300 by default), `DRYSTONE_ORACLE_FIRST` the number of
//! the first scene.

pub mod balance;
mod coarse;
pub mod factor;
mod question;
pub mod random;
mod shape;
mod simplex;
pub mod small;
mod sums;
pub mod touch;
mod wedge;

use dashu_ratio::RBig;
use drystone::analysis::{Accuracy, FrameAnalysis, Options, Verdict};
use drystone::{Analysis, Scene};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::structure::{block, rectangle, scene};
use balance::Balance;
use simplex::{LinearProgram, Row};

/// How the verdict of a scene compares with the exact verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    Agrees(Verdict),
    /// The verdict differs or is undecided, but the scene is within the tolerance of the limit, where this is
    /// allowed.
    WithinBand(Verdict),
    /// The verdict is undecided although the scene is not within the tolerance of the limit.
    Undecided,
    /// The verdict differs although the scene is not within the tolerance of the limit.
    Wrong,
    /// The scene file is invalid, or bodies overlap.
    Refused,
    /// The analysis found another number of contacts than the exact program.
    TouchesElsewhere,
}

/// The result of one scene.
struct Finding {
    number: u64,
    kind: usize,
    file: Value,
    standing: Standing,
    /// The largest relative error of the total force, of its lower bound or of the total adhesion. `None` if they
    /// were not compared.
    error: Option<f64>,
    /// For an unstable scene: its motion rules out every equilibrium whose sum of forces is below this multiple of
    /// the heaviest load.
    ruled_out: Option<f64>,
}

fn examined(number: u64) -> Finding {
    let (kind, file) = random::scene(number);
    let exact = random::KINDS[kind].1;
    let (standing, error, ruled_out) = match Scene::from_json(&file.to_string()) {
        // Overlapping bodies are judged with and without the overlap. Other tests cover this.
        Ok(scene) if !scene.penetrations().is_empty() => (Standing::Refused, None, None),
        Ok(scene) => compared(&scene, exact, number % 4 < 2),
        Err(_) => (Standing::Refused, None, None),
    };
    Finding { number, kind, file, standing, error, ruled_out }
}

/// The standing, the error and the excluded sum of forces of a scene, as in [`Finding`].
fn compared(scene: &Scene, exact: bool, with_forces: bool) -> (Standing, Option<f64>, Option<f64>) {
    let touches = if exact { touch::touches(scene) } else { touch::as_found(scene) };
    let analysis = Analysis::new(scene);
    let frame = &analysis.frames[0];
    if touches.len() != frame.contacts.len() {
        return (Standing::TouchesElsewhere, None, None);
    }
    let ruled_out = (frame.verdict == Verdict::Unstable).then(|| frame.proof.excluded_force_sum());
    let (standing, error) = judged(scene, &touches, frame, with_forces);
    if let (Standing::WithinBand(verdict), true) = (standing, exact) {
        // At the accuracy `exact`, a verdict may not be wrong within the tolerance either.
        let found = Analysis::exact(scene, &Options::default().accuracy(Accuracy::Exact)).frames[0].verdict;
        if verdict != Verdict::Undecided && found == verdict {
            return (Standing::Wrong, error, ruled_out);
        }
    }
    (standing, error, ruled_out)
}

/// The standing of a frame and, `with_forces`, the error of its sums.
fn judged(
    scene: &Scene,
    touches: &[touch::Touch],
    frame: &FrameAnalysis,
    with_forces: bool,
) -> (Standing, Option<f64>) {
    let groups = Balance::groups(scene, touches);
    let fallen: Vec<bool> = groups.iter().map(|g| !g.stands()).collect();
    let falls = fallen.contains(&true);
    let agrees = match frame.verdict {
        Verdict::Stable => !falls,
        Verdict::Unstable => falls,
        Verdict::Undecided => false,
    };
    if !agrees {
        let blamed = || groups.iter().zip(&fallen).filter(|(_, f)| **f == falls).map(|(g, _)| g);
        let borderline = match (falls, frame.verdict) {
            (true, Verdict::Stable) => blamed().all(Balance::is_borderline),
            _ => groups.iter().any(Balance::is_borderline),
        };
        let standing = match (borderline, frame.verdict) {
            (true, verdict) => Standing::WithinBand(verdict),
            (false, Verdict::Undecided) => Standing::Undecided,
            (false, _) => Standing::Wrong,
        };
        return (standing, None);
    }
    let error = with_forces.then(|| {
        if !falls {
            let least = groups.iter().filter_map(Balance::least_force).sum();
            // The lower bound must not exceed the exact least sum. If the forces are reported as the least, the bound
            // must equal that sum, to a tolerance ten times as large.
            let bound = frame.force_bound.unwrap_or(0.0);
            let above = off(bound.max(least), least, frame.weight);
            let short = if frame.least_force { off(bound.min(least), least, frame.weight) / 10.0 } else { 0.0 };
            let total = off(frame.total_force, least, frame.weight);
            return Some(total.max(above).max(short));
        }
        let (mut sum, mut lost) = (0.0, Vec::new());
        for group in &groups {
            match group.least_sticking() {
                Some(least) => sum += least,
                None if group.cannot_be_held() => lost.extend(group.blocks.iter().copied()),
                // No adhesion gives an exact equilibrium, but because of rounded corners, one exists within the
                // tolerance. There is no exact sum to compare with.
                None => return None,
            }
        }
        lost.sort();
        let mut reported: Vec<usize> = frame.unsupported.iter().map(|b| b.0).collect();
        reported.sort();
        let sticking = off(frame.total_sticking, sum, frame.weight);
        Some(if reported == lost { sticking } else { f64::INFINITY })
    });
    (Standing::Agrees(frame.verdict), error.flatten())
}

/// The difference of two sums of force, relative to the exact sum or to the total weight, whichever is larger.
fn off(found: f64, exact: f64, weight: f64) -> f64 {
    let size = exact.max(weight);
    if size > 0.0 { (found - exact).abs() / size } else { found.abs() }
}

/// Without one route of the solver, the verdict, the sum of forces or the sum of missing forces of each scene was once
/// wrong. The exact program found the values of the file, except those of the static form, which the lower bound of the
/// sum proves; `DRYSTONE_ORACLE_ROUTES=1` compares all with it again, which takes more than ten minutes.
#[test]
fn scenes_that_once_needed_a_route_of_their_own_keep_their_values() {
    let again = number_of("DRYSTONE_ORACLE_ROUTES", 0) > 0;
    let check = |line: &&str| {
        let known: Value = serde_json::from_str(line).expect("JSON");
        let scene = scene(&known["scene"]);
        let frame = Analysis::new(&scene).frames.remove(0);
        let sums = [("total_force", frame.total_force), ("total_sticking", frame.total_sticking)];
        let is_near =
            |(key, found): (&str, f64)| known[key].as_f64().is_none_or(|value| off(found, value, frame.weight) < 1e-6);
        let mut agrees = known["verdict"] == frame.verdict.to_string() && sums.into_iter().all(is_near);
        if again {
            let (standing, error, _) = compared(&scene, true, true);
            agrees &= standing == Standing::Agrees(frame.verdict) && error.is_none_or(|error| error < 1e-6);
        }
        (!agrees).then(|| format!("{}: {} with {sums:?}", known["route"], frame.verdict))
    };
    let scenes: Vec<&str> = include_str!("routes.ndjson").lines().collect();
    let wrong: Vec<String> = scenes.par_iter().filter_map(check).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The number in an environment variable, or `otherwise`.
pub fn number_of(variable: &str, otherwise: u64) -> u64 {
    std::env::var(variable).ok().and_then(|v| v.parse().ok()).unwrap_or(otherwise)
}

/// Three sums that were once 27, 158 and 647 % too large. A push of 10⁻⁸ of the weight needs a force of a robot or of
/// a contact that plays no other part in the equilibrium.
#[test]
fn the_total_force_is_the_least_under_a_very_small_push() {
    for number in [18849, 21741, 19792] {
        let found = examined(number);
        assert_eq!(found.standing, Standing::Agrees(Verdict::Stable));
        assert!(found.error.is_some_and(|e| e < 1e-8), "{:?}", found.error);
        let scene = Scene::from_json(&found.file.to_string()).expect("a sound scene");
        let analysis = Analysis::new(&scene);
        assert!(analysis.frames[0].least_force, "{number}");
    }
}

/// With friction 1000, the first face of optima has a sum of forces 4·10⁻⁷ above the least; another margin of it has the
/// least.
#[test]
fn the_total_force_is_the_least_with_very_high_friction() {
    let found = examined(900_496);
    assert_eq!(found.standing, Standing::Agrees(Verdict::Stable));
    assert!(found.error.is_some_and(|e| e < 1e-7), "{:?}", found.error);
}

/// Gravity is exactly normal to a slope without friction. The unit vector of its direction is rounded, but not in the exact
/// program.
#[test]
fn blocks_rest_on_a_slope_without_friction_if_gravity_is_normal_to_it() {
    assert_eq!(examined(701_043).standing, Standing::Agrees(Verdict::Stable));
}

/// A block without weight, held by a robot that carries nearly everything. The sum that was found is 39 % above the
/// least sum, and no better bound was found.
#[test]
fn a_total_force_above_the_least_is_not_reported_as_the_least() {
    let found = examined(800_676);
    assert_eq!(found.standing, Standing::Agrees(Verdict::Stable));
    let scene = Scene::from_json(&found.file.to_string()).expect("a sound scene");
    let frame = Analysis::new(&scene).frames.remove(0);
    let is_least = found.error.is_some_and(|error| error < 1e-6);
    assert_eq!(frame.least_force, is_least, "{:?}", found.error);
    let is_stated = frame.notices.iter().any(|notice| notice.contains("was not proved"));
    assert_eq!(is_stated, !is_least, "{:?}", frame.notices);
}

/// A push of 8·10⁻⁹ N on a frictionless block whose robot may not push back, and a brick at the foot of a wall with
/// an exact corner that healing once moved.
#[test]
fn scenes_with_a_very_small_push_and_with_an_exact_corner_fall() {
    for number in [51974, 51566] {
        let found = examined(number);
        assert_eq!(found.standing, Standing::Agrees(Verdict::Unstable), "{number}");
        assert!(found.error.is_none_or(|e| e < 1e-8), "{:?}", found.error);
    }
}

/// Weights from 1 N to 9 kN. Among all forces with the least adhesion, those with the least sum are reported. Their
/// adhesion was once 0.2 % above the least.
#[test]
fn the_adhesion_of_the_least_forces_is_the_least() {
    let found = examined(2812);
    assert_eq!(found.standing, Standing::Agrees(Verdict::Unstable));
    // The error is relative to the weight, which is 800 times the sticking.
    assert!(found.error.is_some_and(|e| e < 1e-9), "{:?}", found.error);
}

/// A wall of eight bricks of 2 to 9 N, which four robots hold, with a load of 2·10⁻⁷ N. Its sum of forces was once 68 %
/// too large, because the program of least force ends without a result.
#[test]
fn the_total_force_of_a_held_wall_is_the_least_with_a_slight_load() {
    let scene = Scene::from_json(include_str!("slight-load-9819.json")).expect("a sound scene");
    let (standing, error, _) = compared(&scene, true, true);
    assert_eq!(standing, Standing::Agrees(Verdict::Stable));
    assert!(error.is_some_and(|error| error < 1e-6), "{error:?}");
}

/// The verdicts of random small scenes, outside the tolerance, equal those of the exact program.
#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn verdicts_are_those_of_an_exact_program() {
    let first = number_of("DRYSTONE_ORACLE_FIRST", 0);
    let wanted = number_of("DRYSTONE_ORACLE_SCENES", 300);
    let findings: Vec<Finding> = (first..first + wanted).into_par_iter().map(examined).collect();
    let count = |f: &dyn Fn(&Finding) -> bool| findings.iter().filter(|x| f(x)).count();
    for (kind, (name, _)) in random::KINDS.iter().enumerate() {
        let of = |s: Standing| count(&|f: &Finding| f.kind == kind && f.standing == s);
        println!(
            "{name}: {} stand, {} fall, {} within the band called standing, {} called falling, {} not decided; outside it {} undecided, {} wrong; {} refused, {} touch elsewhere",
            of(Standing::Agrees(Verdict::Stable)),
            of(Standing::Agrees(Verdict::Unstable)),
            of(Standing::WithinBand(Verdict::Stable)),
            of(Standing::WithinBand(Verdict::Unstable)),
            of(Standing::WithinBand(Verdict::Undecided)),
            of(Standing::Undecided),
            of(Standing::Wrong),
            of(Standing::Refused),
            of(Standing::TouchesElsewhere),
        );
    }
    let errors: Vec<f64> = findings.iter().filter_map(|f| f.error).collect();
    let worst = errors.iter().fold(0.0, |m: f64, e| m.max(*e));
    println!("{} sums of forces, the worst off by {worst:.1e}", errors.len());
    let ruled_out: Vec<f64> = findings.iter().filter_map(|f| f.ruled_out).collect();
    println!(
        "{} motions: {} rule out every balance, {} of at least 1e12 loads, the weakest one of {:.1e}",
        ruled_out.len(),
        ruled_out.iter().filter(|x| x.is_infinite()).count(),
        ruled_out.iter().filter(|x| **x >= 1e12).count(),
        ruled_out.iter().copied().fold(f64::INFINITY, f64::min)
    );
    let bad = findings.iter().filter(|f| {
        matches!(f.standing, Standing::Wrong | Standing::Undecided | Standing::TouchesElsewhere)
            || f.error.is_some_and(|e| e > 1e-7)
    });
    let bad: Vec<String> = bad.map(|f| format!("{} {:?} {:?}\n{}", f.number, f.standing, f.error, f.file)).collect();
    assert!(bad.is_empty(), "{} scenes:\n{}", bad.len(), bad.join("\n"));
}

/// Towers and walls with stones of very different sizes and weights on them, next to them and in them.
/// `DRYSTONE_ORACLE_SMALL=5000` sets the number of scenes.
#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result of a long run")]
fn verdicts_of_scenes_with_small_stones_are_those_of_an_exact_program() {
    let wanted = number_of("DRYSTONE_ORACLE_SMALL", 300);
    let first = number_of("DRYSTONE_ORACLE_FIRST", 0);
    let found: Vec<(u64, Value, Standing, String)> = (first..first + wanted)
        .into_par_iter()
        .map(|number| {
            let file = small::scene(number);
            let (standing, doubt) = match Scene::from_json(&file.to_string()) {
                Ok(scene) if !scene.penetrations().is_empty() => (Standing::Refused, String::new()),
                Ok(scene) => {
                    let touches = touch::touches(&scene);
                    let analysis = Analysis::new(&scene);
                    let frame = &analysis.frames[0];
                    let standing = if touches.len() == frame.contacts.len() {
                        judged(&scene, &touches, frame, false).0
                    } else {
                        Standing::TouchesElsewhere
                    };
                    (standing, format!("{:?} {}", frame.proof, frame.doubt()))
                }
                Err(_) => (Standing::Refused, String::new()),
            };
            (number, file, standing, doubt)
        })
        .collect();
    let of = |s: Standing| found.iter().filter(|f| f.2 == s).count();
    println!(
        "{} stand, {} fall, {} within the band called standing, {} called falling, {} not decided; outside it {} undecided, {} wrong; {} refused, {} touch elsewhere",
        of(Standing::Agrees(Verdict::Stable)),
        of(Standing::Agrees(Verdict::Unstable)),
        of(Standing::WithinBand(Verdict::Stable)),
        of(Standing::WithinBand(Verdict::Unstable)),
        of(Standing::WithinBand(Verdict::Undecided)),
        of(Standing::Undecided),
        of(Standing::Wrong),
        of(Standing::Refused),
        of(Standing::TouchesElsewhere),
    );
    let bad =
        found.iter().filter(|f| matches!(f.2, Standing::Wrong | Standing::Undecided | Standing::TouchesElsewhere));
    let bad: Vec<String> =
        bad.map(|(number, file, standing, doubt)| format!("{number} {standing:?} {doubt}\n{file}")).collect();
    assert!(bad.is_empty(), "{} scenes:\n{}", bad.len(), bad.join("\n"));
}

/// The optimum of the exact simplex equals that of the dual program, for random programs.
#[test]
fn the_optimum_of_the_exact_simplex_equals_that_of_the_dual() {
    for seed in 0..200 {
        let mut chance = crate::random::Random::new(seed);
        let (n, m) = (chance.whole(1, 6) as usize, chance.whole(1, 5) as usize);
        let costs: Vec<i64> = (0..n).map(|_| chance.whole(0, 9)).collect();
        let bounds: Vec<i64> = (0..m).map(|_| chance.whole(-4, 9)).collect();
        let matrix: Vec<Vec<i64>> = bounds.iter().map(|_| (0..n).map(|_| chance.whole(-3, 3)).collect()).collect();
        // The primal is min c·x with Ax = b, x ≥ 0; the dual is max b·y with Aᵀy + s = c, s ≥ 0. Their optima are
        // equal. So a program with both sets of constraints and c·x ≤ b·y is feasible exactly if the primal is
        // feasible.
        let mut primal = LinearProgram { costs: costs.iter().map(|c| RBig::from(*c)).collect(), rows: Vec::new() };
        let row = |entries: Vec<(usize, i64)>, bound: i64, equality: bool| Row {
            entries: entries.into_iter().map(|(k, v)| (k, RBig::from(v))).collect(),
            bound: RBig::from(bound),
            equality,
        };
        for (line, bound) in matrix.iter().zip(&bounds) {
            primal.rows.push(row(line.iter().copied().enumerate().collect(), *bound, true));
        }
        let mut both = primal.clone();
        let free: Vec<usize> = (0..2 * m).map(|_| both.unknown(RBig::ZERO)).collect();
        for (j, cost) in costs.iter().enumerate() {
            let up = (0..m).map(|i| (free[i], matrix[i][j]));
            let down = (0..m).map(|i| (free[m + i], -matrix[i][j]));
            both.rows.push(row(up.chain(down).collect(), *cost, false));
        }
        let up = (0..m).map(|i| (free[i], -bounds[i]));
        let down = (0..m).map(|i| (free[m + i], bounds[i]));
        let spent = costs.iter().copied().enumerate();
        both.rows.push(row(spent.chain(up).chain(down).collect(), 0, false));
        let least = primal.least();
        assert_eq!(least.is_some(), both.is_feasible(), "program {seed}");
        if let Some(least) = least {
            // A cost slightly below the optimum is not feasible.
            let mut better = primal.clone();
            let entries = primal.costs.iter().cloned().enumerate().collect();
            let below = &least - RBig::from_parts(1.into(), 1_000_000_007u64.into());
            if below >= RBig::ZERO {
                better.rows.push(Row { entries, bound: below, equality: false });
                assert!(!better.is_feasible(), "program {seed}");
            }
        }
    }
}

/// The distance from equilibrium is exact. The centre of gravity of a block lies d beyond the edge of a floor.
///
/// Let the force be in error by t·W and the moment by t·WL. Then N = (1 − t)W with arm d, friction tW with arm ½ and
/// the moment tWL balance: (1 − t)d = t/2 + tL. L, the length of the interface, is ½ − d, so t = d.
#[test]
fn the_distance_from_equilibrium_is_exact() {
    let two_to = |power: i32| libm::exp2(f64::from(power));
    for (beyond, borderline) in
        [(two_to(-20), false), (two_to(-25), true), (0.0, true), (-two_to(-25), true), (-two_to(-20), false)]
    {
        let file = json!({ "drystone": 1, "ground": [{ "polygon": rectangle(0.0, -1.0, 1.0, 1.0) }],
            "blocks": [block("a", rectangle(0.5 + beyond, 0.0, 1.0, 1.0), 6.0)] });
        let scene = scene(&file);
        let touches = touch::touches(&scene);
        let groups = Balance::groups(&scene, &touches);
        assert_eq!(groups[0].distance(), f64::max(0.0, beyond), "{beyond:e}");
        assert_eq!(groups[0].stands(), beyond <= 0.0, "{beyond:e}");
        assert_eq!(groups[0].is_borderline(), borderline, "{beyond:e}");
    }
}
