//! Wedging: which structures stand only by a self-stress that nobody built up.

use drystone::Analysis;
use drystone::analysis::{Ask, FrameAnalysis, Options, Verdict};
use serde_json::{Value, json};

use crate::structure::{arch, block, harmonic, on_floor, on_slope, rectangle, scene, wall};

fn asked(file: &Value) -> FrameAnalysis {
    let options = Options {
        wedging: Ask::Yes,
        ..Options::default()
    };
    Analysis::with(&scene(file), &options).frames.remove(0)
}

#[track_caller]
fn wedged(file: &Value) -> bool {
    let frame = asked(file);
    assert_eq!(frame.verdict, Verdict::Stable);
    frame
        .only_by_wedging
        .unwrap_or_else(|| panic!("no answer for {file}"))
}

/// A bar between two walls whose faces lean towards each other at the top by `lean` over the bar's height.
fn bar_between_walls(lean: f64, friction: f64) -> Value {
    json!({ "drystone": 1, "friction": friction,
        "ground": [{ "polygon": [[-2, -2], [-2.0 * lean, -2], [lean * 2.0, 2], [-2, 2]] },
                   { "polygon": [[3.0 + 2.0 * lean, -2], [5, -2], [5, 2], [3.0 - 2.0 * lean, 2]] }],
        "blocks": [{ "id": "bar", "polygon": [[0, 0], [3, 0], [3.0 - lean * 0.5, 0.5], [lean * 0.5, 0.5]], "weight": 6 }] })
}

/// Two columns on the floor with a bar between them, at half height.
fn h_model(friction: f64) -> Value {
    on_floor(
        friction,
        vec![
            block("left", rectangle(0.0, 0.0, 1.0, 3.0), 60.0),
            block("right", rectangle(4.0, 0.0, 1.0, 3.0), 60.0),
            block("bar", rectangle(1.0, 1.25, 3.0, 0.5), 6.0),
        ],
    )
}

#[test]
fn the_h_model_stands_only_by_wedging() {
    for friction in [0.1, 0.7, 2.0] {
        assert!(wedged(&bar_between_walls(0.0, friction)), "{friction}");
    }
    assert!(wedged(&h_model(0.7)));
}

#[test]
fn the_a_model_stands_only_by_wedging() {
    assert!(wedged(&bar_between_walls(0.2, 0.7)));
    assert!(wedged(&bar_between_walls(0.05, 0.3)));
}

#[test]
fn a_bar_that_wedges_itself_in_does_not() {
    // Walls that lean apart at the top: the bar's own weight presses it in.
    assert!(!wedged(&bar_between_walls(-0.2, 0.7)));
    assert!(!wedged(&bar_between_walls(-0.5, 0.1)));
    assert!(!wedged(&bar_between_walls(-0.02, 0.7)));
}

#[test]
fn ordinary_structures_do_not() {
    assert!(!wedged(&arch(11, 0.3, 0.7)));
    assert!(!wedged(&arch(31, 0.2, 0.5)));
    assert!(!wedged(&wall(4, 5)));
    assert!(!wedged(&harmonic(6, 0.9)));
    assert!(!wedged(&on_slope(30.0, 4.0, 0.5, 0.6, 0.0)));
}

#[test]
fn a_feather_squeezed_in_a_mountain_is_found() {
    let mut file = h_model(0.7);
    file["blocks"][2]["weight"] = json!(0.006);
    assert!(wedged(&file));
}

/// The springs divide out, and so do the units.
#[test]
fn the_answer_does_not_depend_on_size() {
    for size in [1e-3, 1e3] {
        for (mut file, expected) in [(h_model(0.7), true), (wall(3, 3), false)] {
            for list in ["ground", "blocks"] {
                for body in file[list].as_array_mut().expect("a list") {
                    for point in body["polygon"].as_array_mut().expect("points") {
                        for at in point.as_array_mut().expect("numbers") {
                            *at = json!(at.as_f64().expect("number") * size);
                        }
                    }
                    if let Some(weight) = body.get("weight").and_then(Value::as_f64) {
                        body["weight"] = json!(weight * size * size);
                    }
                }
            }
            assert_eq!(wedged(&file), expected, "{size}");
        }
    }
}

#[test]
fn it_is_an_effect_on_request() {
    let told = |frame: &FrameAnalysis| {
        let effect = frame.effects.iter().find(|e| e.effect == "wedging");
        let effect = effect.expect("every effect is told");
        (effect.simulated, effect.why.clone())
    };
    let file = h_model(0.7);
    let scene = scene(&file);
    let plain = Analysis::of(&scene).frames.remove(0);
    assert_eq!(told(&plain), (false, "not asked for".to_string()));
    assert_eq!(plain.only_by_wedging, None);
    assert_eq!(told(&asked(&file)), (true, "asked for".to_string()));
    let falls = asked(&arch(11, 0.05, 0.7));
    assert_eq!(
        told(&falls),
        (false, "the frame does not stand".to_string())
    );
    assert_eq!(falls.only_by_wedging, None);
}

#[test]
fn the_figure_says_so() {
    let scene = scene(&bar_between_walls(0.0, 0.7));
    let options = Options {
        wedging: Ask::Yes,
        ..Options::default()
    };
    let drawn = |options: &Options| {
        let analysis = Analysis::with(&scene, options);
        let drawing = drystone::figure::forces(&analysis, &drystone::figure::Options::default());
        drystone::output::svg::write(&drawing)
    };
    assert!(drawn(&options).contains("only by wedging"));
    assert!(!drawn(&Options::default()).contains("only by wedging"));
}
