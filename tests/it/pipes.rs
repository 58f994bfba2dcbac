//! A pipe in place of a file, which never has an end: it is refused, unless it is the one input that the user named. Then
//! the time limit ends it, and every other command too.

#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::json;
use tempfile::TempDir;

const SCENE: &str = r#"{ "drystone": 1, "ground": [{ "polygon": [[-1, -1], [2, -1], [2, 0], [-1, 0]] }],
        "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": 1 }] }"#;

/// A program with debug assertions is many times slower, and so is a busy machine.
const MOST: Duration = Duration::from_secs(if cfg!(debug_assertions) { 40 } else { 3 });

fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.json"), SCENE).expect("writable");
    fs::create_dir(folder.path().join("in")).expect("writable");
    fs::write(folder.path().join("in/a.json"), SCENE).expect("writable");
    for pipe in ["pipe", "pipe.json", "pipe.toml", "in/pipe.json", "in/pipe.txt"] {
        let made = Command::new("mkfifo").arg(folder.path().join(pipe)).status().expect("mkfifo");
        assert!(made.success());
    }
    folder
}

/// Runs the program until it ends or `MOST` is over. Returns the exit code, `None` if it had to be stopped, the messages,
/// and the time.
fn run(folder: &Path, arguments: &str) -> (Option<i32>, String, Duration) {
    let started = Instant::now();
    let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
    command.args(arguments.split(' ')).current_dir(folder).env_remove("CI");
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("starts");
    let stderr = child.stderr.take().expect("piped");
    let messages = thread::spawn(move || std::io::read_to_string(stderr).unwrap_or_default());
    while started.elapsed() < MOST && child.try_wait().expect("a child").is_none() {
        thread::sleep(Duration::from_millis(10));
    }
    let time = started.elapsed();
    let _ = child.kill();
    let status = child.wait().expect("ended");
    (status.code(), messages.join().expect("read"), time)
}

#[test]
fn pipes_that_are_not_the_one_input_are_refused() {
    let folder = folder();
    for arguments in [
        "check a.json pipe",
        "render a.json -o a.svg --style pipe.toml",
        "render a.json -o a.svg --font pipe",
        "render pipe -o a.svg --watch",
        "report a.json pipe -o r.html",
        "report a.json pipe --compare -o r.html",
        "report a.json -o r.html --interactive pipe",
        "batch a.json pipe",
        "verify pipe a.json",
        "snapshot pipe.json",
    ] {
        let (code, messages, _) = run(folder.path(), arguments);
        assert!(code == Some(2) && messages.contains("it is a pipe"), "{arguments}: {code:?} {messages}");
    }
    // In a folder, a pipe is no scene, and no reference.
    for arguments in ["check in", "render in -o out/", "report in -o r.html", "batch in"] {
        let (code, messages, _) = run(folder.path(), arguments);
        assert_eq!(code, Some(0), "{arguments}: {messages}");
    }
    let (code, messages, _) = run(folder.path(), "snapshot in");
    assert!(code == Some(2) && messages.contains("in/pipe.json"), "{code:?} {messages}");
}

#[test]
fn the_time_limit_ends_a_pipe_that_is_the_one_input() {
    let folder = folder();
    let commands = [
        "check pipe",
        "render pipe -o a.svg",
        "report pipe -o r.html",
        "plan pipe",
        "export pipe",
        "verify pipe",
        "import pipe --format svg",
    ];
    // All of them wait at the same time.
    std::thread::scope(|scope| {
        for arguments in commands {
            let folder = folder.path();
            scope.spawn(move || {
                let (code, messages, time) = run(folder, &format!("{arguments} --time-limit 0.3"));
                let is_late = code == Some(2) && messages.contains("the time limit of 300ms was reached");
                assert!(is_late, "{arguments}: {messages}");
                let grace = if cfg!(debug_assertions) { 20.0 } else { 0.8 };
                assert!(time.as_secs_f64() < grace, "{arguments}: {time:?}");
            });
        }
    });
}

/// What lays out a figure of very many panels does not ask for the time.
#[test]
fn the_time_limit_ends_a_command_that_does_not_ask_for_the_time() {
    let folder = folder();
    let mut scene: serde_json::Value = serde_json::from_str(SCENE).expect("JSON");
    scene["steps"] = json!(vec![json!({}); 20_000]);
    scene["steps"][0]["place"] = json!(["a"]);
    fs::write(folder.path().join("steps.json"), scene.to_string()).expect("writable");
    let (code, messages, time) = run(folder.path(), "report steps.json -o r.html --time-limit 0.2");
    let grace = if cfg!(debug_assertions) { 20.0 } else { 0.7 };
    assert!(time.as_secs_f64() < grace, "{code:?} {messages} {time:?}");
    let left: Vec<_> =
        fs::read_dir(folder.path()).expect("there").map(|entry| entry.expect("there").file_name()).collect();
    assert!(left.iter().all(|name| !name.to_string_lossy().contains(".part")), "{left:?}");
}
