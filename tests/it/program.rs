//! The command line as a user runs it: exit codes, streams, files and messages.

mod accuracy;
mod batch;
mod broken;
mod carried;
mod check;
mod contacts;
mod fault;
mod figures;
mod headlines;
mod import;
mod mistakes;
mod readme;
mod render;
mod safety;
mod silent;
mod units;
mod vary;
mod words;

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use tempfile::TempDir;

use crate::structure::{HALF_LINTEL as FALLS, LINTEL as STANDS};

const WRONG: &str = r#"{ "drystone": 1,
  "blocks": [
    { "id": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "frction": 0.5 },
    { "id": "b", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": -3 } ] }"#;

/// The exit code and the output of a run.
struct Ran {
    code: i32,
    out: String,
    err: String,
}

/// A temporary folder in which commands run. It is removed at the end of the test.
struct Bench {
    folder: TempDir,
}

impl Bench {
    fn empty() -> Bench {
        Bench { folder: tempfile::tempdir().expect("a folder") }
    }

    /// A folder with the scenes `stands.json`, `falls.json` and the invalid `wrong.json`.
    fn new() -> Bench {
        let bench = Bench::empty();
        for (name, text) in [("stands.json", STANDS), ("falls.json", FALLS), ("wrong.json", WRONG)] {
            fs::write(bench.path(name), text).expect("writable");
        }
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The command `drystone` with the words of a line as its arguments.
    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        command.args(line.split_whitespace()).current_dir(self.folder.path());
        command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE").env_remove("CLICOLOR").env("TERM", "xterm");
        command.stdin(Stdio::null());
        command
    }

    fn run(&self, line: &str) -> Ran {
        ran(self.command(line))
    }

    fn run_with(&self, line: &str, input: &[u8]) -> Ran {
        let mut command = self.command(line);
        let mut child =
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
        let mut pipe = child.stdin.take().expect("piped");
        // If the command line is refused, the program ends before it reads its input. Then writing fails, which is no
        // error.
        let _ = pipe.write_all(input);
        drop(pipe);
        of(child.wait_with_output().expect("ends"))
    }

    /// The sorted names of all files in the folder except the three scenes.
    fn made(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.folder.path())
            .expect("readable")
            .map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned())
            .filter(|name| !["stands.json", "falls.json", "wrong.json"].contains(&name.as_str()))
            .collect();
        names.sort();
        names
    }
}

fn ran(mut command: Command) -> Ran {
    of(command.output().expect("starts"))
}

fn of(output: std::process::Output) -> Ran {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let ran = Ran {
        code: output.status.code().expect("no signal ended it"),
        out: text(&output.stdout),
        err: text(&output.stderr),
    };
    assert!(!ran.err.contains("panicked"), "{}", ran.err);
    ran
}
