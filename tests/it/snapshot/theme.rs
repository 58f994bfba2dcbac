//! The drawings of the gallery in the themes of which it has no pictures, to the last byte.
//!
//! `tests/reference/themes.txt` has a line for each drawing: scene, theme, and the SHA-256 of the SVG file, shortened to
//! 64 bits. `UPDATE_SNAPSHOTS=1` writes it again. `drystone render SCENE --theme THEME` shows a drawing.

use std::path::Path;

use drystone::Analysis;
use drystone::drawing::Theme;
use drystone::figure::{self, Kind, Options};

const REFERENCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/themes.txt");

/// The themes without pictures.
const THEMES: [&str; 3] = ["paper", "colourblind", "dark"];

fn digest(text: &str) -> String {
    hmac_sha256::Hash::hash(text.as_bytes())[..8].iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn the_gallery_in_other_themes_equals_its_references() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for folder in ["tests/scenes", "assets/thesis"] {
        super::collect(root, &root.join(folder), &mut files);
    }
    files.retain(|file| file.ends_with(".json"));
    files.sort();
    let mut lines = Vec::new();
    for file in &files {
        let analysis = Analysis::new(crate::pictures::scene(file));
        for name in THEMES {
            let options = Options::default().theme(Theme::named(name).expect("a theme"));
            let svg = drystone::output::svg::write(&figure::draw(&analysis, Kind::Forces, &options));
            lines.push(format!("{file} {name} {}", digest(&svg)));
        }
    }
    assert!(lines.len() >= 3 * 45, "{} drawings", lines.len());
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none() {
        std::fs::write(REFERENCE, lines.join("\n") + "\n").expect("the reference can be written");
    }
    let known = std::fs::read_to_string(REFERENCE).expect("the reference is there");
    let known: Vec<&str> = known.lines().collect();
    let changed: Vec<&String> = lines.iter().filter(|line| !known.contains(&line.as_str())).collect();
    assert!(
        changed.is_empty() && known.len() == lines.len(),
        "{} references for {} drawings; these differ: inspect them with drystone render SCENE --theme THEME, and run once \
         with UPDATE_SNAPSHOTS=1: {changed:#?}",
        known.len(),
        lines.len()
    );
}
