//! Certificates with a factor on the friction, and with corners that carry force on edges.

use drystone::Scene;
use drystone::analysis::{MarginKinds, Options};
use drystone::certificate::Certificate;
use drystone::starter::Ladder;
use serde_json::{Value, json};

use super::{by_python, certificate, proved, proved_by_python};

#[test]
fn factors_on_friction_and_corners_on_edges_are_exact_for_both_checkers() {
    let ladders = [(0.7, 0.0), (0.3, 0.2), (0.31, 0.17)].map(|(friction, wall_friction)| {
        let file = Ladder { friction, wall_friction, angle: 57.0, ..Ladder::default() }.scene();
        certificate(&Scene::new(file).expect("sound"), &Options::default().margins(MarginKinds::ALL))
    });
    for own in &ladders {
        let text = own.to_json();
        assert!(text.contains("\"friction_factor\":") && text.contains("\"corners_carry\":\"on_edges\""), "{text}");
        let checked = own.check().expect("sound");
        assert!(proved(&checked).into_iter().all(|proved| proved), "{text}");
    }
    // A larger factor beyond the end is no proof, nor is a contact that was left out.
    let mutants = ladders.each_ref().map(|own| {
        let mut file: Value = serde_json::from_str(&own.to_json()).expect("JSON");
        for limit in file["limits"].as_array_mut().expect("limits") {
            if let Some(factor) = limit["change"]["friction_factor"].as_f64() {
                let inside = limit["verdict"] == "stable";
                limit["change"]["friction_factor"] = json!(factor * if inside { 0.9 } else { 1.1 });
            }
        }
        file.to_string()
    });
    for text in &mutants {
        let checked = Certificate::from_json(text.as_bytes()).expect("a certificate").check().expect("sound");
        assert!(!proved(&checked).into_iter().all(|proved| proved), "{text}");
    }
    let all: Vec<String> = ladders.iter().map(Certificate::to_json).chain(mutants).collect();
    let Some(pages) = by_python(&all) else { return };
    for (number, page) in pages.iter().enumerate() {
        assert_eq!(proved_by_python(page).into_iter().all(|proved| proved), number < 3, "{page:?}");
    }
}
