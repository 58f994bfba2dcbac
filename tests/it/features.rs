//! The number of crates that each feature needs agrees with `src/doc/library.md`. The library without features needs
//! few.

use std::fs;
use std::path::Path;
use std::process::Command;

/// The largest permitted number of other crates without features.
const MAX_ALONE: usize = 75;

/// The lines of `cargo tree` for some features, sorted, each once. Cargo downloads crates that were not
/// needed to build the tests.
fn tree(features: &[&str]) -> Vec<String> {
    let output = Command::new(env!("CARGO"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["tree", "--locked", "--edges", "normal"])
        .args(["--prefix", "none", "--no-default-features"])
        .args(features.iter().flat_map(|name| ["--features", name]))
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut lines: Vec<String> = String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect();
    lines.sort();
    lines.dedup();
    lines
}

/// The number of other crates that some features need, each version counted once.
fn crates(features: &[&str]) -> usize {
    let mut names: Vec<String> = tree(features)
        .iter()
        .map(|line| line.split(" (").next().unwrap_or_default().to_owned())
        .filter(|name| !name.starts_with("drystone "))
        .collect();
    names.dedup();
    names.len()
}

/// The rows of the table in `src/doc/library.md`: a feature, or `None` for no features, and the number of crates.
fn rows() -> Vec<(Option<String>, usize)> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/doc/library.md");
    let text = fs::read_to_string(page).expect("the page");
    let table =
        text.split_once("| feature | what it adds | crates |\n|---|---|---|\n").expect("the table of features").1;
    table
        .lines()
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let name = cells[0].strip_prefix('`').and_then(|c| c.strip_suffix('`'));
            let number = cells[2].parse().expect("a number");
            (name.map(str::to_owned), number)
        })
        .collect()
}

/// The features that Cargo.toml declares, except `default`.
fn declared() -> Vec<String> {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml");
    let text = fs::read_to_string(manifest).expect("the manifest");
    let section = text.split_once("\n[features]\n").expect("features").1;
    let section = section.split("\n[").next().unwrap_or_default();
    let mut names: Vec<String> = section
        .lines()
        .filter_map(|line| line.split_once(" = ["))
        .map(|(name, _)| name.to_owned())
        .filter(|name| name != "default")
        .collect();
    names.sort();
    names
}

#[test]
fn the_page_states_how_many_crates_every_feature_needs() {
    // The numbers hold for the platform on which the table was made.
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) {
        return;
    }
    let rows = rows();
    let mut named: Vec<String> = rows.iter().filter_map(|row| row.0.clone()).collect();
    named.sort();
    assert_eq!(named, declared());
    for (feature, stated) in rows {
        let features: Vec<&str> = feature.as_deref().into_iter().collect();
        assert_eq!(crates(&features), stated, "{features:?}");
    }
}

#[test]
fn mechanics_and_svg_alone_are_few_crates() {
    let alone = tree(&[]);
    let count = crates(&[]);
    assert!(count <= MAX_ALONE, "{count}:\n{}", alone.join("\n"));
    for name in ["clap ", "resvg ", "krilla ", "plotters ", "maud ", "toml "] {
        assert!(!alone.iter().any(|line| line.starts_with(name)), "{name}");
    }
}
