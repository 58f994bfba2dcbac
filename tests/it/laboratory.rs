//! The comparison of solution methods in `tests/bench/accuracy`: the reference is true, wrong verdicts are flagged, and
//! the picture in the documentation shows the table in the documentation.

#[allow(dead_code, reason = "the benchmark uses the other functions")]
#[path = "../bench/accuracy/study/mod.rs"]
pub mod study;

use std::fs;
use std::path::{Path, PathBuf};

use drystone::Scene;
use drystone::analysis::Verdict;
use drystone::drawing::Item;
use drystone::internals::interface::ContactKind;
use drystone::internals::program::{ContactTerm, GripTerm, Program, Scale};
use drystone::output::png;
use drystone::scene::Vector;
use serde_json::{Value, json};

use crate::hard::{overhang, wedge};
use crate::structure::{arch, block, harmonic, on_floor, on_slope, rectangle, scene, tower, wall};
use study::double::Double;
use study::picture::{WIDTH, drawing, picture};
use study::skyline::Skyline;
use study::vallat::vallat_program;
use study::{Case, Mark, Method, Study, Summary, summary, table};

fn case(file: &Value) -> Case {
    study::study(&[("scene".into(), scene(file))], &[1e-8], &mut |_| {}).cases.remove(0)
}

fn near(found: Option<f64>, expected: f64) {
    let found = found.expect("certified");
    assert!((found - expected).abs() <= 1e-14 * expected, "{found:e} instead of {expected:e}");
}

/// The scenes in `assets/study`, by name.
fn scenes() -> Vec<(&'static str, Value)> {
    let tilted = |gravity: Value| {
        let mut file = wall(10, 10);
        file["gravity"] = gravity;
        file
    };
    let mut robot = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 1.0, 1.0), 8.0)]);
    robot["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "force": 8.0 } }]);
    let mountain = |x: f64| {
        let big = block("mountain", rectangle(0.0, 0.0, 2.0, 1.0), 6e8);
        on_floor(0.5, vec![big, block("feather", rectangle(x, 1.0, 1.0, 0.1), 6.0)])
    };
    let slope = on_slope(30.0, 4.0, 0.5, libm::tan(30f64.to_radians()), 0.0);
    vec![
        ("arch-27", arch(27, 0.2, 0.7)),
        ("arch-27-thin", arch(27, 0.1, 0.7)),
        ("arch-181-falls", arch(181, 0.10743, 0.9)),
        ("arch-181-stands", arch(181, 0.1076, 0.9)),
        ("wall-400", wall(20, 20)),
        ("wall-tilted-falls", tilted(json!([6.0, -8.0]))),
        ("wall-tilted-stands", tilted(json!([3.0, -9.0]))),
        ("tower-200", tower(200, 0.5)),
        ("stack-harmonic-falls", harmonic(12, 1.001)),
        ("stack-harmonic-stands", harmonic(12, 0.999)),
        ("wedge-1e-2", wedge(1e-2)),
        ("wedge-1e-4", wedge(1e-4)),
        ("wedge-1e-6", wedge(1e-6)),
        ("wedge-1e-7", wedge(1e-7)),
        ("feather-falls", mountain(1.6)),
        ("feather-stands", mountain(1.4)),
        ("overhang-1e-5-falls", overhang(1e-5, true)),
        ("overhang-1e-6-falls", overhang(1e-6, true)),
        ("overhang-1e-6-stands", overhang(-1e-6, true)),
        ("overhang-none", overhang(0.0, true)),
        ("slope-exact", slope),
        ("robot-at-its-limit", robot),
    ]
}

/// The files in `assets/study` contain the scenes that are built here. `UPDATE_SNAPSHOTS=1` writes the files again.
#[test]
fn the_files_of_the_study_contain_the_scenes_built_here() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/study");
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none();
    for (name, mut file) in scenes() {
        file["title"] = json!(name);
        let path: PathBuf = folder.join(format!("{name}.json"));
        if update {
            fs::write(&path, format!("{file}\n")).expect("writable");
        }
        let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let (kept, made) = (Scene::from_json(&text).expect("sound"), scene(&file));
        assert_eq!(kept.blocks().len(), made.blocks().len(), "{name}");
        for (a, b) in kept.blocks().iter().zip(made.blocks()) {
            assert_eq!(a.body.polygon.outline(), b.body.polygon.outline(), "{name}");
            assert_eq!(a.weight, b.weight, "{name}");
        }
    }
    let files = fs::read_dir(&folder).expect("there").count();
    assert_eq!(files, scenes().len(), "no file without a scene");
}

/// Sums computed by hand. They reveal a mistake that the reference shares with the solver.
#[test]
fn the_reference_agrees_with_sums_by_hand() {
    let truth = case(&wedge(1e-3)).truth;
    assert_eq!(truth.verdict, Verdict::Stable);
    // The two sides press with W / (2 sin α) each. The corners of the wedge are rounded to f64, and so is α.
    let found = truth.total.expect("certified");
    let expected = 6.0 / libm::sin(1e-3);
    assert!((found / expected - 1.0).abs() < 1e-12, "{found:e}");

    let truth = case(&tower(3, 0.5)).truth;
    near(truth.total, 6.0 * (1.0 + 2.0 + 3.0));
    near(truth.largest, 18.0);
    assert!(truth.gap < 1e-12, "{}", truth.gap);

    // A beam of 45 N on two posts that weigh 2 N each.
    let lever = json!({ "drystone": 1, "friction": 0.5, "ground": [{ "polygon": rectangle(-9.0, -1.0, 30.0, 1.0) }],
        "blocks": [block("l", rectangle(0.0, 0.0, 1.0, 1.0), 2.0), block("r", rectangle(5.0, 0.0, 1.0, 1.0), 2.0),
                   block("beam", rectangle(0.0, 1.0, 6.0, 0.5), 45.0)] });
    near(case(&lever).truth.total, 45.0 + 45.0 + 4.0);

    // A block on a slope steeper than its friction angle: the least adhesion is W (sin θ − μ cos θ).
    let truth = case(&on_slope(45.0, 2.0, 0.5, 0.25, 0.0)).truth;
    assert_eq!(truth.verdict, Verdict::Unstable);
    let (found, expected) = (truth.total.expect("certified"), 5.0 * 0.75 * 0.5f64.sqrt());
    assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
}

#[test]
fn every_scene_of_the_study_has_a_certified_truth_as_its_name_says() {
    for (name, file) in scenes().into_iter().filter(|s| !s.0.contains("181") && !s.0.contains("00")) {
        let truth = study::study(&[(name.into(), scene(&file))], &[], &mut |_| {}).cases.remove(0).truth;
        // Friction exactly at tan θ: the last bit of a rounded tangent decides, and this cannot be certified.
        if name == "slope-exact" {
            continue;
        }
        assert_ne!(truth.verdict, Verdict::Undecided, "{name}");
        if name.ends_with("falls") {
            assert_eq!(truth.verdict, Verdict::Unstable, "{name}");
        }
        if name.ends_with("stands") {
            assert_eq!(truth.verdict, Verdict::Stable, "{name}");
        }
    }
}

/// The program of the thesis reports failures in a stable structure if the thrust exceeds β newtons per newton of
/// adhesion.
#[test]
fn a_penalty_smaller_than_the_thrust_is_flagged() {
    let case = case(&wedge(1e-7));
    assert_eq!(case.truth.verdict, Verdict::Stable);
    for run in &case.runs {
        match run.method {
            Method::Source(6) => {
                assert_eq!((run.mark, run.outcome.verdict), (Mark::Wrong, Verdict::Unstable));
            }
            Method::Level(_) | Method::Unique => assert_eq!(run.mark, Mark::Right, "{run:?}"),
            _ => {}
        }
    }
    let study = Study { cases: vec![case] };
    let mut lines = summary(&study);
    let wrong = lines.iter().find(|l| l.method == Method::Source(6));
    assert_eq!(wrong.map(|l| l.wrong), Some(1));
    // The picture describes the default tolerance only.
    lines.iter_mut().for_each(|line| line.tolerance = 1e-9);
    let picture = picture(&lines, 1).expect("drawn");
    assert!(picture.contains("1 of 1 verdicts wrong"));
    let png = png::render(&picture, png::Size::Width(900)).expect("our rasteriser understands it");
    let look = Path::new(env!("CARGO_TARGET_TMPDIR")).join("accuracy.png");
    fs::write(look, png).expect("writable");
    assert!(table(&study).contains("**1**"));
}

/// Reads the table of src/doc/accuracy.md back into a summary.
fn printed() -> Vec<Summary> {
    let text = include_str!("../../src/doc/accuracy.md");
    let number = |cell: &str| cell.trim_matches('*').parse::<f64>().ok();
    let line = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let method = Method::ALL.into_iter().find(|m| cells.first() == Some(&m.name()))?;
        let [_, tolerance, time, iterations, median, worst, largest, wrong, undecided] = cells[..] else {
            return None;
        };
        Some(Summary {
            method,
            tolerance: number(tolerance)?,
            time: number(time)?,
            total_error: number(worst),
            median_error: number(median),
            largest_error: number(largest),
            wrong: number(wrong)? as usize,
            undecided: number(undecided)? as usize,
            frames: 40,
            iterations: number(iterations)? as usize,
        })
    };
    text.lines().filter_map(line).collect()
}

/// With `UPDATE_SNAPSHOTS=1`, the test writes the picture anew.
#[test]
fn the_picture_in_the_documentation_shows_its_table() {
    let lines = printed();
    assert_eq!(lines.len(), 6 * Method::ALL.len());
    let drawn = picture(&lines, 41).expect("drawn");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/assets/accuracy.svg");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none() {
        fs::write(path, &drawn).expect("writable");
    }
    let kept = fs::read_to_string(path).expect("assets/accuracy.svg exists");
    assert!(drawn == kept, "assets/accuracy.svg is not the picture of the table");
}

/// The README makes this statement about the picture.
#[test]
fn proved_verdicts_are_never_wrong_and_others_sometimes_are() {
    let lines = printed();
    for method in Method::ALL {
        let wrong: usize = lines.iter().filter(|l| l.method == method).map(|l| l.wrong).sum();
        let proved = matches!(method, Method::Level(_));
        assert_eq!(wrong == 0, proved, "{}", method.name());
    }
}

#[test]
fn every_row_shows_wrong_and_undecided_verdicts_and_only_the_default_is_ringed() {
    let lines = printed();
    let drawing = drawing(&lines, 41);
    let texts = |wanted: &str| {
        let text = |item: &&Item| matches!(item, Item::Text(t) if t.words == wanted);
        drawing.items.iter().filter(text).count()
    };
    for method in Method::ALL {
        assert_eq!(texts(method.name()), 1, "{}", method.name());
    }
    let counts = lines.iter().flat_map(|l| [l.wrong, l.undecided]);
    assert_eq!(texts("0"), counts.filter(|count| *count == 0).count());
    let ring = |item: &&Item| matches!(item, Item::Path(p) if p.fill.is_none() && p.stroke.as_ref().is_some_and(|s| s.width == 1.6));
    assert_eq!(drawing.items.iter().filter(ring).count(), 3);
    for item in &drawing.items {
        if let Item::Text(t) = item {
            assert!(t.at.x > 0.0 && t.at.x < WIDTH && t.at.y < drawing.height, "{}", t.words);
        }
    }
}

/// A box of 4 m by 3 m on the ground, held by a robot, with L = 2 m and a unit of force of 2 N. The program has six unknowns for the joint, six for the robot, and the opposite of
/// each.
#[test]
fn the_program_of_the_reference_contains_the_opposite_of_every_unknown() {
    let beta = 1e6;
    let program = Program {
        blocks: 1,
        loads: vec![-0.5, 4.0, -0.75],
        contacts: vec![ContactTerm {
            kind: ContactKind::Edge,
            on: (0, [Vector::new(0.5, -0.75), Vector::new(-0.5, -0.75)]),
            from: None,
            normal: Vector::new(0.0, 1.0),
            friction: 0.5,
            points: 2,
        }],
        grips: vec![GripTerm { block: 0, arm: Vector::new(-1.0, 0.75), limits: [0.0, f64::INFINITY, 2.0] }],
        scale: Scale::new(2.0, 600.0),
    };
    let conic = vallat_program(&program, beta);
    assert_eq!((conic.unknowns, conic.equalities), (24, 3));
    assert_eq!(conic.linear[..12], [1.0; 12]);
    assert_eq!(conic.linear[12..], [beta; 12]);
    let unknowns: [[f64; 3]; 12] = [
        [0.0, 1.0, 0.5],
        [-1.0, 0.0, -0.75],
        [1.0, 0.0, 0.75],
        [0.0, 1.0, -0.5],
        [-1.0, 0.0, -0.75],
        [1.0, 0.0, 0.75],
        [1.0, 0.0, -0.75],
        [-1.0, 0.0, 0.75],
        [0.0, 1.0, -1.0],
        [0.0, -1.0, 1.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    for place in 0..3 {
        let found: Vec<f64> =
            (0..24).map(|k| conic.matrix.iter().filter(|e| (e.0, e.1) == (place, k)).map(|e| e.2).sum()).collect();
        for (k, unknown) in unknowns.iter().enumerate() {
            assert!((found[k] - unknown[place]).abs() < 1e-15, "{place} {k}");
            assert_eq!(found[12 + k], -found[k]);
        }
        assert_eq!(conic.bound[place], program.loads[place]);
    }
    // Friction: f⁺ + f⁻ ≤ μN at both points. Then come the limits of x and of the torque in both directions. In the
    // last rows all unknowns are at least 0.
    let entries = |number: usize| {
        let entries = conic.matrix.iter().filter(|e| e.0 == number);
        entries.map(|e| (e.1, e.2)).collect::<Vec<_>>()
    };
    assert_eq!(entries(3), [(0, -0.5), (1, 1.0), (2, 1.0)]);
    assert_eq!(entries(4), [(3, -0.5), (4, 1.0), (5, 1.0)]);
    for (number, k, limit) in [(5, 6, 0.0), (6, 7, 0.0), (7, 10, 2.0), (8, 11, 2.0)] {
        assert_eq!((entries(number), conic.bound[number]), (vec![(k, 1.0)], limit));
    }
    for k in 0..24 {
        assert_eq!((entries(9 + k), conic.bound[9 + k]), (vec![(k, -1.0)], 0.0));
    }
    assert_eq!(conic.bound.len(), 33);
}

#[test]
fn thirty_digits_are_kept() {
    let (one, three, tiny) =
        (Double::from(1.0), Double::from(3.0), Double::from(1.0 / 1024.0 / 1048576.0 / 1048576.0 / 1048576.0));
    assert_eq!((one + tiny - one).near(), tiny.near());
    let rest = one - one / three * three;
    assert!(rest.near().abs() < 1e-31, "{rest:?}");
    // (1 + t)(1 − t) = 1 − t², where t² is far below the last bit of 1.
    let t = Double::from(1e-10);
    let square = one - (one + t) * (one - t);
    assert!((square.near() / 1e-20 - 1.0).abs() < 1e-10);
}

#[test]
fn a_system_with_a_dependent_row_is_solved_to_thirty_digits() {
    let vectors: Vec<Vec<(usize, Double)>> = [[1.0, 2.0, 3.0], [2.0, 4.0, 1.0]]
        .iter()
        .map(|v| v.iter().map(|x| Double::from(*x)).enumerate().collect())
        .collect();
    let one = Double::from(1.0);
    let skyline = Skyline::new(3, vectors.iter().map(|v| (one, v.as_slice())));
    // The right-hand side, 3·first + 7·second, is in the range of the matrix.
    let right: Vec<Double> = [17.0, 34.0, 16.0].map(Double::from).to_vec();
    let w = skyline.solve(&right);
    let mut left = vec![Double::ZERO; 3];
    for v in &vectors {
        let along = v.iter().fold(Double::ZERO, |s, (i, x)| s + *x * w[*i]);
        v.iter().for_each(|(i, x)| left[*i] = left[*i] + *x * along);
    }
    for (l, r) in left.iter().zip(&right) {
        assert!((*l - *r).abs().near() < 1e-28, "{left:?}");
    }
}
