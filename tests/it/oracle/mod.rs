//! The verdicts against an exact cross-check of our own: whole-number simplex over the balance built from the corners.
//!
//! Every floating-point number is a fraction, so whether a scene as written stands has an exact answer. What is built
//! here shares nothing with `program` and `solve`: contacts, balance and simplex are this directory's own.
//! `DRYSTONE_ORACLE_SCENES=10000` looks at more scenes than the few hundred of an everyday run; `DRYSTONE_ORACLE_FIRST`
//! is the number of the first.

mod balance;
mod random;
mod shape;
mod simplex;
mod touch;

use dashu_ratio::RBig;
use drystone::analysis::Verdict;
use drystone::{Analysis, Scene};
use rayon::prelude::*;
use serde_json::Value;

use balance::Balance;
use simplex::{LinearProgram, Row};

/// How one scene's verdict compares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    Agrees(Verdict),
    /// It differs, or is undecided, and the scene lies within the band in which it may.
    WithinBand(Verdict),
    /// It is undecided outside the band.
    Undecided,
    /// It differs outside the band.
    Wrong,
    /// The file is no sound scene.
    Refused,
    /// It does not touch where it ought to.
    TouchesElsewhere,
}

/// What one scene gave.
struct Finding {
    number: u64,
    kind: usize,
    file: Value,
    standing: Standing,
    /// Worst relative error of the total force or sticking, where it was looked at.
    error: Option<f64>,
}

fn looked_at(number: u64) -> Finding {
    let (kind, file) = random::scene(number);
    let (standing, error) = compared(&file, random::KINDS[kind].1, number % 4 < 2);
    Finding {
        number,
        kind,
        file,
        standing,
        error,
    }
}

fn compared(file: &Value, exact: bool, with_forces: bool) -> (Standing, Option<f64>) {
    let Ok(scene) = Scene::from_json(&file.to_string()) else {
        return (Standing::Refused, None);
    };
    let touches = if exact {
        touch::touches(&scene)
    } else {
        touch::as_found(&scene)
    };
    let analysis = Analysis::of(&scene);
    let frame = &analysis.frames[0];
    if touches.len() != frame.contacts.len() {
        return (Standing::TouchesElsewhere, None);
    }
    let groups = Balance::groups(&scene, &touches);
    let fallen: Vec<bool> = groups.iter().map(|g| !g.stands()).collect();
    let falls = fallen.contains(&true);
    let agrees = match frame.verdict {
        Verdict::Stable => !falls,
        Verdict::Unstable => falls,
        Verdict::Undecided => false,
    };
    if !agrees {
        let blamed = || {
            groups
                .iter()
                .zip(&fallen)
                .filter(|(_, f)| **f == falls)
                .map(|(g, _)| g)
        };
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
        if falls {
            let sums: Vec<Option<f64>> = groups.iter().map(Balance::least_sticking).collect();
            let lost = groups.iter().zip(&sums).filter(|(_, s)| s.is_none());
            let lost: usize = lost.map(|(g, _)| g.blocks.len()).sum();
            if lost != frame.unsupported.len() {
                return f64::INFINITY;
            }
            off(
                frame.total_sticking,
                sums.iter().flatten().sum(),
                frame.weight,
            )
        } else {
            let least = groups.iter().filter_map(Balance::least_force).sum();
            off(frame.total_force, least, frame.weight)
        }
    });
    (Standing::Agrees(frame.verdict), error)
}

/// The difference of two sums of force, in parts of the exact one or, where that is less, of the weights.
fn off(told: f64, exact: f64, weight: f64) -> f64 {
    let size = exact.max(weight);
    if size > 0.0 {
        (told - exact).abs() / size
    } else {
        told.abs()
    }
}

fn number_of(variable: &str, otherwise: u64) -> u64 {
    std::env::var(variable)
        .ok()
        .and_then(|v| v.parse().ok())
        .unwrap_or(otherwise)
}

/// Thousands of small scenes, and not one wrong verdict.
#[test]
#[expect(
    clippy::print_stdout,
    reason = "the counts are the result of a long run"
)]
fn verdicts_are_those_of_an_exact_program() {
    let first = number_of("DRYSTONE_ORACLE_FIRST", 0);
    let wanted = number_of("DRYSTONE_ORACLE_SCENES", 300);
    let findings: Vec<Finding> = (first..first + wanted)
        .into_par_iter()
        .map(looked_at)
        .collect();
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
    println!(
        "{} sums of forces, the worst off by {worst:.1e}",
        errors.len()
    );
    let bad = findings.iter().filter(|f| {
        matches!(
            f.standing,
            Standing::Wrong | Standing::Undecided | Standing::TouchesElsewhere
        ) || f.error.is_some_and(|e| e > 1e-7)
    });
    let bad: Vec<String> = bad
        .map(|f| format!("{} {:?} {:?}\n{}", f.number, f.standing, f.error, f.file))
        .collect();
    assert!(bad.is_empty(), "{} scenes:\n{}", bad.len(), bad.join("\n"));
}

/// What the cross-check rests on: optima of random programs equal those of their duals, to the last bit.
#[test]
fn the_exact_simplex_meets_its_dual() {
    for seed in 0..200 {
        let mut chance = random::Chance::new(seed);
        let (n, m) = (chance.whole(1, 6) as usize, chance.whole(1, 5) as usize);
        let costs: Vec<i64> = (0..n).map(|_| chance.whole(0, 9)).collect();
        let bounds: Vec<i64> = (0..m).map(|_| chance.whole(-4, 9)).collect();
        let matrix: Vec<Vec<i64>> = bounds
            .iter()
            .map(|_| (0..n).map(|_| chance.whole(-3, 3)).collect())
            .collect();
        // min c·x, Ax = b, x ≥ 0 against max b·y, Aᵀy + s = c, s ≥ 0: at the optima both are the same, so one program
        // that asks for both balances and for c·x ≤ b·y has a solution exactly where the first has one.
        let mut primal = LinearProgram {
            costs: costs.iter().map(|c| RBig::from(*c)).collect(),
            rows: Vec::new(),
        };
        let row = |entries: Vec<(usize, i64)>, bound: i64, equality: bool| Row {
            entries: entries
                .into_iter()
                .map(|(k, v)| (k, RBig::from(v)))
                .collect(),
            bound: RBig::from(bound),
            equality,
        };
        for (line, bound) in matrix.iter().zip(&bounds) {
            primal.rows.push(row(
                line.iter().copied().enumerate().collect(),
                *bound,
                true,
            ));
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
        both.rows
            .push(row(spent.chain(up).chain(down).collect(), 0, false));
        let least = primal.least();
        assert_eq!(least.is_some(), both.is_feasible(), "program {seed}");
        if let Some(least) = least {
            // A hair below the optimum nothing fits any more.
            let mut better = primal.clone();
            let entries = primal.costs.iter().cloned().enumerate().collect();
            let below = &least - RBig::from_parts(1.into(), 1_000_000_007u64.into());
            if below >= RBig::ZERO {
                better.rows.push(Row {
                    entries,
                    bound: below,
                    equality: false,
                });
                assert!(!better.is_feasible(), "program {seed}");
            }
        }
    }
}
