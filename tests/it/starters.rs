//! The starter scenes: each is valid, has a title and numbers with few decimals, and stands or falls as expected.

use drystone::analysis::{Analysis, Verdict};
use drystone::scene::format::SceneFile;
use drystone::scene::{NoteCode, Scene};
use drystone::starter::{Arch, Doorway, Incline, Ladder, LatticePile, Tower, Wall};

fn verdict(file: &SceneFile) -> Verdict {
    let text = file.to_json();
    let scene = Scene::from_json(&text).unwrap_or_else(|problems| panic!("{problems}\n{text}"));
    assert!(!scene.title().is_empty());
    let analysis = Analysis::new(&scene);
    // Some tests make blocks of 500 m.
    assert!(analysis.notes.iter().all(|note| note.code == NoteCode::ImplausibleSize), "{text}");
    analysis.verdict()
}

#[test]
fn starters_stand_or_fall_as_expected() {
    // With few voussoirs the least thickness of a semicircular arch is below Milankovitch's value, 0.1075 of the
    // radius of the centreline.
    let arch = |voussoirs, thickness| Arch { voussoirs, thickness, ..Arch::default() }.scene();
    for (file, expected) in [
        (Arch::default().scene(), Verdict::Stable),
        (arch(7, 0.4), Verdict::Stable),
        (arch(101, 0.24), Verdict::Stable),
        (arch(101, 0.22), Verdict::Unstable),
        (arch(13, 0.15), Verdict::Unstable),
        (Wall::default().scene(), Verdict::Stable),
        (Wall { courses: 1, bricks: 1, ..Wall::default() }.scene(), Verdict::Stable),
        (Tower::default().scene(), Verdict::Stable),
        (Tower { lean: 0.124, ..Tower::default() }.scene(), Verdict::Stable),
        (Tower { lean: 0.126, ..Tower::default() }.scene(), Verdict::Unstable),
        (Tower { blocks: 1, lean: 0.9, ..Tower::default() }.scene(), Verdict::Stable),
        (Doorway::default().scene(), Verdict::Stable),
        (LatticePile::default().scene(), Verdict::Stable),
        (Ladder::default().scene(), Verdict::Stable),
        // With its centroid 0.03 m above the line between its ends it needs 0.241 at a smooth wall.
        (Ladder { friction: 0.25, ..Ladder::default() }.scene(), Verdict::Stable),
        (Ladder { friction: 0.22, ..Ladder::default() }.scene(), Verdict::Unstable),
        (Ladder { friction: 0.22, wall_friction: 0.3, ..Ladder::default() }.scene(), Verdict::Stable),
        (Incline::default().scene(), Verdict::Stable),
        (Incline { friction: 0.36, ..Incline::default() }.scene(), Verdict::Unstable),
        (LatticePile { rows: 6, ..LatticePile::default() }.scene(), Verdict::Stable),
        (LatticePile { friction: 0.05, ..LatticePile::default() }.scene(), Verdict::Unstable),
    ] {
        assert_eq!(verdict(&file), expected, "{}", file.to_json());
    }
}

#[test]
fn starters_have_few_decimals_at_any_scale() {
    for scale in [1e-3, 1.0, 1e3] {
        let files = [
            Arch { span: 4.0 * scale, thickness: 0.4 * scale, ..Arch::default() }.scene(),
            Wall { length: 0.251 * scale, height: 0.0833 * scale, ..Wall::default() }.scene(),
            Tower { width: scale, height: 0.5 * scale, lean: scale / 30.0, ..Tower::default() }.scene(),
        ];
        for file in files {
            assert_eq!(verdict(&file), Verdict::Stable, "{}", file.to_json());
            for corner in file.blocks.iter().flat_map(|b| b.polygon.iter().flatten()).flatten() {
                let digits = format!("{corner:e}");
                let mantissa = digits.split('e').next().unwrap_or("").replace(['.', '-'], "");
                assert!(mantissa.len() <= 6, "{corner} in {}", file.to_json());
            }
        }
    }
}
