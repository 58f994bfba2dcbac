//! Snapshots on disk: paths that cannot be written, simultaneous runs, and interrupted runs.

use std::fs;
use std::process::Stdio;
use std::thread;
use std::time::Duration;

use drystone::snapshot::fact::Facts;
use drystone::snapshot::picture::Picture;

use super::{Folder, accepted, lintel};

#[test]
fn a_file_that_cannot_be_written_is_reported_and_prevents_acceptance() {
    let folder = accepted();
    folder.write("a/arch.json", &lintel("A lintel", 1.3));
    // If a folder has the name of the file, not even the superuser can write the file.
    fs::create_dir(folder.path("a/arch.new.txt")).expect("made");
    let ran = folder.run(&["a"]);
    assert!(
        ran.code == 1 && ran.err.contains("could not write a/arch.new.txt: it is a folder"),
        "{}{}",
        ran.out,
        ran.err
    );
    fs::remove_dir(folder.path("a/arch.new.txt")).expect("there");
    let before = fs::read(folder.path("a/arch.txt")).expect("there");
    fs::remove_file(folder.path("a/arch.svg")).expect("there");
    fs::create_dir(folder.path("a/arch.svg")).expect("made");
    let ran = folder.run(&["a", "--accept"]);
    assert_eq!(ran.code, 4, "{}{}", ran.out, ran.err);
    assert_eq!(
        fs::read(folder.path("a/arch.txt")).expect("there"),
        before,
        "either all files of a snapshot are written or none"
    );
}

/// A folder with twelve scenes.
fn twelve() -> Folder {
    let names: Vec<String> = (0..12).map(|k| format!("s{k}.json")).collect();
    let scenes: Vec<(&str, String)> =
        names.iter().enumerate().map(|(k, n)| (n.as_str(), lintel("One of twelve", 1.0 + k as f64))).collect();
    Folder::with(&scenes)
}

#[test]
fn simultaneous_runs_wait_for_each_other() {
    let folder = twelve();
    let runs: Vec<_> = (0..4)
        .map(|k| {
            let mut command = folder.command(if k % 2 == 0 { &["--accept"] } else { &["."] });
            command.stdout(Stdio::null()).stderr(Stdio::null());
            command.spawn().expect("starts")
        })
        .collect();
    for mut run in runs {
        let code = run.wait().expect("ends").code();
        assert!(matches!(code, Some(0 | 1)), "{code:?}");
    }
    let ran = folder.run(&["."]);
    assert_eq!(ran.code, 0, "{}", ran.out);
    assert_eq!(folder.files().len(), 12 * 4 + 1, "{:?}", folder.files());
}

#[test]
fn an_interrupted_acceptance_leaves_complete_files() {
    let mut complete = 0;
    for wait in [0, 1, 3, 8, 20] {
        let folder = twelve();
        let mut command = folder.command(&["--accept"]);
        command.stdout(Stdio::null()).stderr(Stdio::null());
        let mut run = command.spawn().expect("starts");
        // Wait until the first reference is written, so that the program is still writing.
        let wrote = || folder.files().iter().any(|name| name.ends_with(".txt"));
        while !wrote() && run.try_wait().expect("known").is_none() {
            thread::sleep(Duration::from_millis(1));
        }
        thread::sleep(Duration::from_millis(wait));
        // The process is killed and cannot react.
        let _ = run.kill();
        run.wait().expect("ends");
        for name in folder.files() {
            let bytes = fs::read(folder.path(&name)).expect("there");
            let hidden = name.starts_with('.');
            match name.rsplit_once('.').map(|(_, e)| e) {
                _ if hidden => continue,
                Some("png") => assert!(Picture::decode(&bytes).is_ok(), "{name}"),
                Some("txt") => assert!(Facts::read(&String::from_utf8_lossy(&bytes)).is_ok(), "{name}"),
                Some("svg") => assert!(bytes.ends_with(b"</svg>\n"), "{name}"),
                _ => continue,
            }
            complete += 1;
        }
        assert_eq!(folder.run(&["--accept"]).code, 0, "the lock ended with the process");
    }
    assert!(complete > 0, "no run wrote anything");
}
