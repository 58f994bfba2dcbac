//! No data are lost: inputs are not overwritten, links and permissions are kept, and no incomplete file is left.

use std::fs;
#[cfg(unix)]
use std::{os::unix::fs::symlink, process::Stdio};

use super::{Bench, STANDS};

const SQUARE: &str =
    r#"<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><rect width="4" height="4"/></svg>"#;

#[test]
fn an_input_is_not_overwritten_under_any_name() {
    let bench = Bench::new();
    let write = |name: &str, text: &str| fs::write(bench.path(name), text).expect("writable");
    write("scene.svg", STANDS);
    write("drawing.svg", SQUARE);
    write("style.json", "{}");
    write("folder.json", STANDS);
    fs::create_dir(bench.path("pictures")).expect("made");
    fs::hard_link(bench.path("style.json"), bench.path("captions.svg")).expect("linked");
    fs::hard_link(bench.path("scene.svg"), bench.path("hard.svg")).expect("linked");
    fs::hard_link(bench.path("folder.json"), bench.path("pictures/folder.svg")).expect("linked");
    #[cfg(unix)]
    symlink("hard.svg", bench.path("soft.svg")).expect("linked");
    #[cfg(not(unix))]
    fs::hard_link(bench.path("scene.svg"), bench.path("soft.svg")).expect("linked");
    for line in [
        "render scene.svg -o scene.svg",
        "render scene.svg -o ./scene.svg",
        "render scene.svg -o hard.svg",
        "render scene.svg -o soft.svg",
        "render soft.svg -o hard.svg",
        "render folder.json -o pictures",
        "render stands.json --style style.json -o captions.svg",
        "shapes --style style.json -o captions.svg",
        "import drawing.svg -o drawing.svg",
        "accuracy stands.json -o stands.json",
        "accuracy stands.json -o twice.csv -o twice.csv",
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, 2, "{line}: {}", ran.err);
        assert!(ran.err.contains("are the same file"), "{line}: {}", ran.err);
    }
    let read = |name: &str| fs::read_to_string(bench.path(name)).expect("there");
    assert_eq!(read("scene.svg"), STANDS);
    assert_eq!(read("drawing.svg"), SQUARE);
    assert_eq!(read("stands.json"), STANDS);
    assert_eq!(read("folder.json"), STANDS);
    assert!(!bench.path("twice.csv").exists());
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link_and_a_file_keeps_its_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    fs::write(bench.path("real.svg"), "old").expect("writable");
    fs::set_permissions(bench.path("real.svg"), fs::Permissions::from_mode(0o604)).expect("ours");
    symlink("real.svg", bench.path("link.svg")).expect("linked");
    assert_eq!(bench.run("render stands.json -o link.svg").code, 0);
    assert!(bench.path("link.svg").is_symlink());
    let text = fs::read_to_string(bench.path("real.svg")).expect("there");
    assert!(text.starts_with("<svg"));
    let mode = fs::metadata(bench.path("real.svg")).expect("there").permissions().mode();
    assert_eq!(mode & 0o777, 0o604);
}

/// Sends signals at different times to runs that write many files. Some of them are writing a file at that time.
#[cfg(unix)]
#[test]
fn a_signal_leaves_no_incomplete_file() {
    let bench = Bench::new();
    fs::create_dir(bench.path("out")).expect("made");
    for (number, signal) in ["-INT", "-TERM"].into_iter().cycle().take(8).enumerate() {
        let mut command = bench.command("figures -q --format svg -o out");
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("starts");
        std::thread::sleep(std::time::Duration::from_millis(50 * number as u64));
        let _ =
            std::process::Command::new("kill").args([signal, &child.id().to_string()]).stderr(Stdio::null()).status();
        child.wait().expect("ends");
        for entry in fs::read_dir(bench.path("out")).expect("readable") {
            let name = entry.expect("readable").file_name();
            assert!(!name.to_string_lossy().ends_with(".part"), "{name:?}");
        }
    }
}

/// A file that exceeds the size limit is reported, no part of it is left, and the message does not show the temporary
/// name.
#[cfg(unix)]
#[test]
fn a_file_size_limit_is_a_failure_to_write() {
    let bench = Bench::new();
    let program = env!("CARGO_BIN_EXE_drystone");
    let ran = std::process::Command::new("sh")
        .args(["-c", &format!("ulimit -f 8; '{program}' render stands.json -o a.png --scale 9")])
        .current_dir(bench.folder.path())
        .output()
        .expect("starts");
    let errors = String::from_utf8_lossy(&ran.stderr);
    assert_eq!(ran.status.code(), Some(4), "{errors}");
    assert!(errors.contains("cannot write a.png") && !errors.contains(".part"), "{errors}");
    assert!(bench.made().is_empty(), "{:?}", bench.made());
}

#[cfg(target_os = "linux")]
#[test]
fn help_that_cannot_be_printed_is_a_failure() {
    let bench = Bench::new();
    for line in ["--help", "--version", "check --help", "schema", "check stands.json"] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has one");
        let mut command = bench.command(line);
        let status = command.stdout(full).stderr(Stdio::null()).status().expect("starts");
        assert_eq!(status.code(), Some(4), "{line}");
    }
    assert_eq!(bench.run("--nothing").code, 2);
    assert_eq!(bench.run("--help").code, 0);
}
