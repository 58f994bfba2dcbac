use std::fs;
use std::path::Path;

use super::*;
use crate::mechanics::analysis::{MarginKinds, Options};
use crate::mechanics::scene::format::{BlockEntry, LimitsEntry, RobotEntry, StepEntry};

fn assert_fits(name: &str, analysis: &Analysis) {
    for width in [40, 50, 60, 70, 79, 80, 100] {
        let page = of(name, analysis, &Detail { margins: true, ..Detail::default() }, Some(width)).fitted(width);
        for line in page.text().lines() {
            assert!(seen(line) <= width, "{width}: {line}");
        }
    }
    // Rows for a file or for another program are not shortened.
    let page = of(name, analysis, &Detail { margins: true, ..Detail::default() }, None);
    assert!(page.text().contains("margin"));
}

#[test]
fn the_explanation_fits_every_width() {
    for (width, most) in [(None, 45), (Some(100), 45), (Some(60), 60), (Some(40), 90)] {
        let page = explained(width);
        let found: Vec<&str> = page.text().lines().collect();
        let widest = found.iter().map(|line| seen(line)).max();
        assert!(widest <= Some(width.unwrap_or(78).min(78)), "{}", page.text());
        assert!(found.iter().all(|line| line.is_char_boundary(10) && !line[9..].starts_with("  ")));
        assert!(found.len() <= most, "{}", page.text());
    }
}

#[test]
fn every_scene_of_the_assets_fits_a_terminal() {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    let mut seen = 0;
    for folder in ["thesis", "study"] {
        for entry in fs::read_dir(assets.join(folder)).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.to_string_lossy();
            let scene = Scene::from_json(&fs::read_to_string(&path).expect("text"));
            let scene = scene.expect("a valid scene");
            let options = match folder {
                "thesis" => Options::default().margins(MarginKinds::ALL),
                _ => Options::default().verdict_only(true),
            };
            assert_fits(&name, &Analysis::with(scene, &options));
            seen += 1;
        }
    }
    assert!(seen > 30, "{seen}");
}

/// Long words and wide letters in titles and names, blocks in tension, robots that are too weak, and forces of many
/// digits.
#[test]
fn strange_names_and_many_robots_fit_a_terminal() {
    let names = [
        "n".repeat(300),
        "石".repeat(120),
        "a stone of many words ".repeat(12),
        "e\u{301}".repeat(90),
        "  all   stands   5 N   none".into(),
    ];
    let square = |x: f64, y: f64| [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]];
    for name in names {
        let ids: Vec<String> = (0..9).map(|k| format!("{name}{k}")).collect();
        let mut scene =
            Scene::builder().title(&name).friction(0.5).ground(square(-1.0, -1.0)).ground(square(0.0, -1.0));
        for (k, id) in (0_u8..).zip(&ids) {
            let polygon = square(0.75 * f64::from(k), f64::from(k));
            scene = scene.block(BlockEntry::new(id).polygon(polygon).weight(1.234_567_8e7));
        }
        let mut held = StepEntry::new(&name).place(&ids[5..]);
        for id in &ids[5..] {
            let limits = LimitsEntry::default().force(1.0).torque(1.0);
            scene = scene.robot(RobotEntry::new(id).limits(limits));
            held = held.hold(id, id);
        }
        let scene = scene.step(StepEntry::new(&name).place(&ids[..5])).step(held);
        let scene = scene.build().expect("a valid scene");
        let options = Options::default().margins(MarginKinds::ALL);
        assert_fits(&format!("{name}.json"), &Analysis::with(scene, &options));
    }
}
