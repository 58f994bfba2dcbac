//! Compares nine methods of solution: their times, their errors, and their wrong and undecided verdicts.
//!
//! `cargo bench --bench accuracy` measures the scenes in `assets/thesis` and `assets/study` and prints the table of
//! `src/doc/accuracy.md`, followed by the frames with wrong verdicts. With files after `--`, only these scenes are
//! measured. From the table in the page, the test `laboratory` draws `assets/accuracy.svg`.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::unwrap_used,
    reason = "the table is the output; a scene that cannot be read is a bug in this benchmark"
)]

#[allow(dead_code, reason = "the tests use the other functions")]
mod study;

use std::fs;
use std::path::{Path, PathBuf};

use drystone::Scene;
use drystone::internals::solve::TOLERANCE;

use study::{Mark, Method, TOLERANCES, study, table};

fn main() {
    let named: Vec<PathBuf> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).map(PathBuf::from).collect();
    let paths =
        if named.is_empty() { ["assets/thesis", "assets/study"].into_iter().flat_map(files).collect() } else { named };
    let scenes: Vec<(String, Scene)> = paths.iter().map(|path| read(path)).collect();
    let study = study(&scenes, &TOLERANCES, &mut |name| eprintln!("{name}"));
    println!("drystone {}, {} frames\n\n{}", env!("CARGO_PKG_VERSION"), study.cases.len(), table(&study));
    println!("Wrong verdicts at the tolerance {TOLERANCE:e}:");
    for method in Method::ALL {
        let is_wrong = |run: &study::Run| run.method == method && run.tolerance == TOLERANCE && run.mark == Mark::Wrong;
        let wrong = study.cases.iter().filter(|case| case.runs.iter().any(is_wrong));
        println!("- {}: {}", method.name(), wrong.map(|case| case.name.as_str()).collect::<Vec<_>>().join(", "));
    }
}

/// The scene files of a folder of this repository, in the order of their names.
fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "json"));
    paths.sort();
    paths
}

/// Reads a scene. Its name is the name of the file without the extension.
fn read(path: &Path) -> (String, Scene) {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    (name, Scene::from_json(&fs::read_to_string(path).unwrap()).unwrap())
}
