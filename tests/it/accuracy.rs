//! The accuracy study of the reader's scenes, and what the accuracy levels promise.

use drystone::Analysis;
use drystone::analysis::{Accuracy, Options, Proof, Verdict};
use drystone::internals::study::{Case, Mark, Method, TOLERANCES, study, summary};
use drystone::report::accuracy::{csv, markdown, page, svg};
use drystone::result::accuracy_json;
use serde_json::{Value, json};

use crate::hard::{overhang, wedge};
use crate::structure::{arch, on_slope, scene, tower, wall};

fn measured(file: &Value, tolerances: &[f64]) -> Vec<Case> {
    study(&[scene(file)], tolerances, &mut |_| {})
}

/// Sums computed by hand.
#[test]
fn the_reference_of_a_study_agrees_with_sums_by_hand() {
    let reference = measured(&wedge(1e-3), &[]).remove(0).reference;
    assert_eq!(reference.verdict, Verdict::Stable);
    // The two sides press with W / (2 sin α) each. The corners of the wedge are rounded to f64, and so is α.
    let found = reference.total.expect("decided");
    let expected = 6.0 / libm::sin(1e-3);
    assert!((found / expected - 1.0).abs() < 1e-11, "{found:e} {expected:e}");
    // The weights of a tower: each joint carries all blocks above it.
    let reference = measured(&tower(3, 0.5), &[]).remove(0).reference;
    assert!(reference.total.is_some_and(|total| (total / 36.0 - 1.0).abs() < 1e-14));
    assert!(reference.largest.is_some_and(|largest| (largest / 18.0 - 1.0).abs() < 1e-14));
    // A block on a slope steeper than its friction angle: the least adhesion is W (sin θ − μ cos θ).
    let reference = measured(&on_slope(45.0, 2.0, 0.5, 0.25, 0.0), &[]).remove(0).reference;
    assert_eq!(reference.verdict, Verdict::Unstable);
    let expected = 5.0 * 0.75 * 0.5f64.sqrt();
    assert!(reference.total.is_some_and(|total| (total / expected - 1.0).abs() < 1e-14));
}

/// A tighter tolerance brings the total of the solver alone nearer to the reference, and the levels of drystone are
/// right at every tolerance at which they decide.
#[test]
fn errors_fall_with_the_tolerance_and_levels_are_never_wrong() {
    let cases = measured(&arch(11, 0.2, 0.7), &TOLERANCES);
    let lines = summary(&cases);
    assert_eq!(lines.len(), Method::ALL.len() * TOLERANCES.len());
    let clarabel: Vec<f64> =
        lines.iter().filter(|l| l.method == Method::Clarabel).map(|l| l.total_error.expect("solved")).collect();
    assert!(clarabel[0] > 1e-6 && clarabel[5] < 1e-9, "{clarabel:?}");
    for line in lines.iter().filter(|l| l.method != Method::Clarabel) {
        assert_eq!(line.wrong, 0, "{line:?}");
        assert!(line.tolerance > 1e-8 || line.total_error.is_some_and(|error| error < 1e-9), "{line:?}");
    }
}

#[test]
fn every_output_format_lists_all_runs_and_escapes_names() {
    let mut file = tower(2, 0.5);
    file["title"] = json!("<b> \"two\" & more");
    let mut study = measured(&file, &[1e-4, 1e-9]);
    let runs = 2 * Method::ALL.len();
    assert_eq!(study[0].runs.len(), runs);
    assert_eq!((csv(&study).lines().count(), markdown(&study).lines().count()), (1 + runs, 2 + runs));
    let parsed: Value = serde_json::from_str(&accuracy_json(&study)).expect("JSON");
    assert_eq!(parsed["frames"][0]["runs"].as_array().map(Vec::len), Some(runs));
    assert_eq!(parsed["frames"][0]["verdict"], "stable");
    let html = page(&study).expect("drawn");
    assert!(html.contains("&lt;b&gt;") && !html.contains("<b> ") && html.contains(env!("CARGO_PKG_VERSION")));
    assert!(!html.contains("wrong verdicts") || !html.contains("(wrong)"));
    // A wrong verdict is marked in every format.
    study[0].runs[0].mark = Mark::Wrong;
    assert!(csv(&study).contains("WRONG") && markdown(&study).contains("**1**"));
    assert!(accuracy_json(&study).contains("\"wrong\""));
    let (html, picture) = (page(&study).expect("drawn"), svg(&study).expect("drawn"));
    assert!(html.contains("(wrong)") && picture.contains("wrong verdicts") && picture.contains("#D7141E"));
}

#[test]
fn the_same_study_is_the_same_picture() {
    let mut study = measured(&tower(2, 0.5), &[1e-4, 1e-9]);
    // Times differ from run to run, so they are set here.
    for (k, run) in study[0].runs.iter_mut().enumerate() {
        run.outcome.seconds = 1e-4 * (1.0 + k as f64);
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
