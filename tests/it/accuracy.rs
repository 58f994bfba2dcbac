//! The study of accuracy: the reference is true, wrong verdicts are flagged, accuracy levels mean what they promise,
//! and the same study gives the same picture.

use std::fs;
use std::path::{Path, PathBuf};

use drystone::analysis::{Accuracy, Options, Proof, Verdict};
use drystone::internals::study::{Case, Mark, Method, Study, study, summary};
use drystone::output::png;
use drystone::report::accuracy::{csv, markdown, page, svg};
use drystone::result::accuracy_json;
use drystone::{Analysis, Scene};
use serde_json::{Value, json};

use crate::hard::{overhang, wedge};
use crate::structure::{arch, block, harmonic, on_floor, on_slope, rectangle, scene, tower, wall};

fn measured(file: &Value, tolerances: &[f64]) -> Study {
    study(&[scene(file)], tolerances, &mut |_| {})
}

fn case(file: &Value) -> Case {
    measured(file, &[1e-8]).cases.remove(0)
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
        let truth = study(&[scene(&file)], &[], &mut |_| {}).cases.remove(0).truth;
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
    let wrong = summary(&study).into_iter().find(|l| l.method == Method::Source(6));
    assert_eq!(wrong.map(|l| l.wrong), Some(1));
    let picture = svg(&study).expect("drawn");
    assert!(picture.contains("wrong verdicts") && picture.to_uppercase().contains("#D7141E"));
    let png = png::render(&picture, png::Size::Width(900)).expect("our rasteriser understands it");
    let look = Path::new(env!("CARGO_TARGET_TMPDIR")).join("accuracy.png");
    fs::write(look, png).expect("writable");
    assert!(page(&study).expect("drawn").contains("(wrong)"));
    assert!(csv(&study).contains("WRONG") && markdown(&study).contains("**1**"));
}

#[test]
fn every_output_format_lists_all_runs_and_escapes_names() {
    let mut file = tower(2, 0.5);
    file["title"] = json!("<b> \"two\" & more");
    let study = measured(&file, &[1e-4, 1e-9]);
    let runs = 2 * Method::ALL.len();
    assert_eq!(study.cases[0].runs.len(), runs);
    assert_eq!(csv(&study).lines().count(), 1 + runs);
    let parsed: Value = serde_json::from_str(&accuracy_json(&study)).expect("JSON");
    assert_eq!(parsed["frames"][0]["runs"].as_array().map(Vec::len), Some(runs));
    assert_eq!(parsed["frames"][0]["verdict"], "stable");
    let page = page(&study).expect("drawn");
    assert!(page.contains("&lt;b&gt;") && !page.contains("<b> "));
    assert!(page.contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn the_same_study_is_the_same_picture() {
    let mut study = measured(&tower(2, 0.5), &[1e-4, 1e-9]);
    // Times differ from run to run, so they are set here.
    for (k, run) in study.cases[0].runs.iter_mut().enumerate() {
        run.seconds = 1e-4 * (1.0 + k as f64);
    }
    let first = svg(&study).expect("drawn");
    assert_eq!(first, svg(&study).expect("drawn"));
    assert!(first.contains("viewBox") && first.contains("10⁻") && first.contains("Inter"));
    assert_eq!(page(&study).expect("drawn"), page(&study.clone()).expect("drawn"));
}

fn at(file: &Value, accuracy: Accuracy) -> (Verdict, Proof, String) {
    let scene = scene(file);
    let options = Options::default().accuracy(accuracy);
    let frame = Analysis::with(&scene, &options).frames.remove(0);
    (frame.verdict, frame.proof, frame.doubt())
}

#[test]
fn proved_answers_only_with_a_better_proof() {
    for (file, expected) in [
        (wall(4, 4), Verdict::Stable),
        (arch(11, 0.2, 0.7), Verdict::Stable),
        (on_slope(45.0, 2.0, 0.5, 0.25, 0.0), Verdict::Unstable),
        (arch(11, 0.2, 0.0), Verdict::Unstable),
    ] {
        let (found, proof, doubt) = at(&file, Accuracy::Proved);
        assert_eq!(found, expected, "{proof:?} {doubt}");
        match proof {
            Proof::Forces { worst_imbalance, .. } => assert!(worst_imbalance <= 1e-9),
            Proof::Mechanism { power, worst_violation } => assert!(power >= 1e10 * worst_violation),
        }
    }
    // The tolerance lets the load and the forces that carry it be moved by a billionth of the block's radius, √5/4 m:
    // together by 1.1·10⁻⁹ m. Just beyond that the structure falls. The standard level still calls it stable; this
    // level must not.
    for beyond in [1.2e-9, 2e-9] {
        let barely = overhang(beyond, true);
        assert_eq!(at(&barely, Accuracy::Standard).0, Verdict::Stable);
        let (found, proof, doubt) = at(&barely, Accuracy::Proved);
        assert_ne!(found, Verdict::Stable, "{beyond:e}: {proof:?}");
        assert!(found == Verdict::Unstable || !doubt.is_empty());
    }
}
