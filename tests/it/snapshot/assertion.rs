//! The macros for tests. They read the environment, so each runs in a separate process.

use std::path::Path;
use std::process::Command;

use drystone::snapshot::assertion;
use drystone::{Analysis, Scene, figure};

use super::{Folder, lintel};

/// The environment variable with the folder of the crate for the test below.
const FOLDER: &str = "DRYSTONE_TEST_FOLDER";

/// The other tests run this test in a separate process.
#[test]
#[ignore = "called by the other tests, with a folder"]
fn a_scene_a_folder_and_a_figure() {
    let folder = std::env::var_os(FOLDER).expect("a folder");
    let folder = Path::new(&folder);
    assertion::scene(folder, "scenes/arch.json".as_ref());
    assertion::scenes(folder, "scenes".as_ref());
    let text = std::fs::read_to_string(folder.join("scenes/arch.json")).expect("there");
    let scene = Scene::from_json(&text).expect("sound");
    let drawing = figure::draw(&Analysis::new(&scene), figure::Kind::Thrust, &figure::Options::default());
    assertion::figure(folder, "deep/a thrust line".as_ref(), &drawing);
}

fn run(folder: &Folder, environment: &[(&str, &str)]) -> (bool, String) {
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    command.args(["--ignored", "--exact", "snapshot::assertion::a_scene_a_folder_and_a_figure", "--nocapture"]);
    command.env_remove("CI").env_remove("UPDATE_SNAPSHOTS");
    command.env(FOLDER, folder.path("")).envs(environment.iter().copied());
    let output = command.output().expect("starts");
    let output_text = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output_text.contains("running 1 test"), "{output_text}");
    (output.status.success(), output_text)
}

#[test]
fn a_test_fails_with_a_message_until_it_is_updated_and_never_writes_in_ci() {
    let folder = Folder::with(&[("scenes/arch.json", lintel("A lintel", 1.0))]);
    let before = folder.files();
    for environment in [&[("CI", "true")][..], &[("CI", "true"), ("UPDATE_SNAPSHOTS", "1")]] {
        let (passed, output_text) = run(&folder, environment);
        assert!(!passed && output_text.contains("CI is set, so nothing was written"), "{output_text}");
        assert_eq!(folder.files(), before);
    }
    let (passed, output_text) = run(&folder, &[]);
    assert!(!passed && output_text.contains("scenes/arch.json differs from its references"), "{output_text}");
    assert!(output_text.contains("arch.new.txt") && output_text.contains("UPDATE_SNAPSHOTS=1"), "{output_text}");
    assert!(folder.path("scenes/arch.new.png").exists() && !folder.path("scenes/arch.png").exists());
    let (passed, output_text) = run(&folder, &[("UPDATE_SNAPSHOTS", "1")]);
    assert!(passed, "{output_text}");
    assert!(folder.path("tests/snapshots/deep/a thrust line.svg").exists());
    assert!(!folder.path("scenes/arch.new.png").exists());
    for environment in [&[][..], &[("CI", "true")], &[("UPDATE_SNAPSHOTS", "0")]] {
        let (passed, output_text) = run(&folder, environment);
        assert!(passed, "{output_text}");
    }
    folder.write("scenes/arch.json", &lintel("A lintel", 1.2));
    let (passed, output_text) = run(&folder, &[]);
    assert!(!passed && output_text.contains("interface left–ground: N "), "{output_text}");
    assert!(output_text.contains("arch.diff.png"), "{output_text}");
}

#[test]
#[should_panic(expected = "leads out of tests/snapshots")]
fn a_figures_name_stays_in_its_folder() {
    let drawing = figure::shapes(&drystone::drawing::Theme::thesis());
    assertion::figure(Path::new("."), "../elsewhere".as_ref(), &drawing);
}

#[test]
#[should_panic(expected = "there is no scene file at src/text")]
fn a_folder_without_scenes_is_a_failure() {
    assertion::scenes(Path::new(env!("CARGO_MANIFEST_DIR")), "src/text".as_ref());
}
