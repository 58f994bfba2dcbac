//! The command line as a person runs it: exit codes, streams, files, and what is said.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;

const STANDS: &str = r#"{ "drystone": 1, "title": "A lintel", "friction": 0.6,
  "ground": [{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }],
  "blocks": [
    { "id": "left",   "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]], "weight": 6 },
    { "id": "right",  "polygon": [[5, 0], [6, 0], [6, 3], [5, 3]], "weight": 7 },
    { "id": "lintel", "polygon": [[0, 3], [6, 3], [6, 4], [0, 4]], "weight": 11 } ] }"#;

/// The lintel rests on one post; in the second frame a robot holds its free end.
const FALLS: &str = r#"{ "drystone": 1, "title": "Half a lintel", "friction": 0.6,
  "ground": [{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }],
  "blocks": [
    { "id": "left",   "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]], "weight": 6 },
    { "id": "lintel", "polygon": [[0, 3], [6, 3], [6, 4], [0, 4]], "weight": 11 } ],
  "robots": [{ "id": "crane" }],
  "steps": [ { "title": "Alone", "place": ["left", "lintel"] },
             { "title": "Held", "hold": { "crane": { "block": "lintel", "at": [5, 3.5] } } } ] }"#;

const WRONG: &str = r#"{ "drystone": 1,
  "blocks": [
    { "id": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "frction": 0.5 },
    { "id": "b", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": -3 } ] }"#;

/// How a run ended, and what it said.
struct Ran {
    code: i32,
    out: String,
    err: String,
}

/// A folder of scenes, gone with the test.
struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new() -> Bench {
        let bench = Bench {
            folder: tempfile::tempdir().expect("a folder"),
        };
        for (name, text) in [
            ("stands.json", STANDS),
            ("falls.json", FALLS),
            ("wrong.json", WRONG),
        ] {
            fs::write(bench.path(name), text).expect("writable");
        }
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        command
            .args(line.split_whitespace())
            .current_dir(self.folder.path());
        command
            .env_remove("NO_COLOR")
            .env_remove("CLICOLOR_FORCE")
            .env_remove("CLICOLOR")
            .env("TERM", "xterm");
        command.stdin(Stdio::null());
        command
    }

    fn run(&self, line: &str) -> Ran {
        ran(self.command(line))
    }

    fn run_with(&self, line: &str, input: &[u8]) -> Ran {
        let mut command = self.command(line);
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("starts");
        let mut pipe = child.stdin.take().expect("piped");
        pipe.write_all(input).expect("reads its input");
        drop(pipe);
        of(child.wait_with_output().expect("ends"))
    }

    /// Everything in the folder beside the three scenes.
    fn made(&self) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.folder.path())
            .expect("readable")
            .map(|entry| {
                entry
                    .expect("readable")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
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

#[test]
fn check_ends_with_the_worst_verdict() {
    let bench = Bench::new();
    for (line, code) in [
        ("check stands.json", 0),
        ("check falls.json", 1),
        ("check stands.json falls.json", 1),
        ("check falls.json stands.json", 1),
        ("check falls.json --frame 2", 0),
        ("check falls.json --frame b", 0),
        ("check falls.json --frame a", 1),
        ("check wrong.json", 2),
        ("check falls.json wrong.json", 2),
        ("check missing.json", 2),
        ("check .", 2),
        ("check falls.json --frame 3", 2),
        ("check falls.json --frame 0", 2),
        ("check", 2),
        ("check stands.json --jsn", 2),
        ("", 2),
        ("--version", 0),
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, code, "{line}: {}{}", ran.out, ran.err);
        assert_eq!(ran.err.is_empty(), code != 2, "{line}: {}", ran.err);
        if code == 2 {
            assert_eq!(ran.out, "", "{line}");
        }
    }
}

#[test]
fn a_person_reads_verdict_numbers_and_what_fails() {
    let bench = Bench::new();
    let ran = bench.run("check falls.json");
    let lines: Vec<&str> = ran.out.lines().collect();
    assert!(
        lines[0].contains("falls.json") && lines[0].contains("Half a lintel"),
        "{}",
        ran.out
    );
    assert!(
        lines[2].contains("(a) Alone") && lines[2].contains("unstable"),
        "{}",
        ran.out
    );
    assert!(ran.out.contains("(b) Held"), "{}", ran.out);
    assert!(
        ran.out.contains("Rigid blocks, laid dry"),
        "the limits are told: {}",
        ran.out
    );
    // The lintel's 11 N lie 2 m beyond the post's edge; the pull at the far corner has an arm of 1 m.
    let words = "lintel comes off left at (0, 3) m: holding on would take a pull of 22 N";
    assert!(ran.out.contains(words), "{}", ran.out);
    // The post's own 6 N, half a metre inside, do a share of that at its foot.
    assert!(
        ran.out
            .contains("left comes off ground at (0, 0) m: holding on would take a pull of 19 N"),
        "{}",
        ran.out
    );
}

#[test]
fn programs_read_one_object_a_scene() {
    let bench = Bench::new();
    let ran = bench.run("check --json falls.json");
    let result: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!(result["scene"], "Half a lintel");
    let frames = result["frames"].as_array().expect("frames");
    assert_eq!(frames.len(), 2);
    assert_eq!(
        (&frames[0]["verdict"], &frames[1]["verdict"]),
        (&"unstable".into(), &"stable".into())
    );
    assert_eq!(frames[0]["failures"][0]["kind"], "tension");
    assert!(frames[0]["proof"]["power"].as_f64().expect("number") > 0.0);
    assert!(
        frames[1]["proof"]["worst_imbalance"]
            .as_f64()
            .expect("number")
            < 1e-7
    );
    assert!(frames[1]["solve"]["seconds"].as_f64().expect("number") >= 0.0);
    assert_eq!(frames[1]["robots"][0]["id"], "crane");
    assert!((frames[0]["weight"].as_f64().expect("number") - 17.0).abs() < 1e-12);

    let ran = bench.run("check --json --no-timing stands.json falls.json");
    let lines: Vec<Value> = ran
        .out
        .lines()
        .map(|line| serde_json::from_str(line).expect("JSON"))
        .collect();
    assert_eq!(lines.len(), 2);
    assert_eq!(
        (&lines[0]["scene"], &lines[1]["scene"]),
        (&"A lintel".into(), &"Half a lintel".into())
    );
    assert!(lines[1]["frames"][0]["solve"]["seconds"].is_null());
}

#[test]
fn without_timing_the_same_scene_gives_the_same_bytes() {
    let bench = Bench::new();
    for line in [
        "check --json --no-timing falls.json",
        "check --no-timing falls.json",
        "render falls.json -o -",
    ] {
        let (once, again) = (bench.run(line), bench.run(line));
        assert_eq!(once.out, again.out, "{line}");
        assert!(once.out.len() > 100, "{line}");
    }
}

#[test]
fn render_ends_well_once_the_picture_is_written_unless_strict() {
    let bench = Bench::new();
    let ran = bench.run("render falls.json -o falls.svg");
    assert_eq!((ran.code, ran.out.as_str()), (0, ""), "{}", ran.err);
    assert!(
        ran.err
            .contains("falls.svg: 2 frames: 1 stable, 1 unstable"),
        "{}",
        ran.err
    );
    assert!(
        fs::read_to_string(bench.path("falls.svg"))
            .expect("written")
            .starts_with("<svg")
    );
    assert_eq!(
        bench.run("render falls.json -o strict.svg --strict").code,
        1
    );
    assert!(
        bench.path("strict.svg").exists(),
        "strict tells, and still draws"
    );
    assert_eq!(
        bench.run("render stands.json -o strict.svg --strict").code,
        0
    );
    assert_eq!(
        bench.made(),
        ["falls.svg", "strict.svg"],
        "nothing else is left lying about"
    );
}

#[test]
fn scenes_come_from_standard_input_and_pictures_go_to_standard_output() {
    let bench = Bench::new();
    let ran = bench.run_with("render - -o -", STANDS.as_bytes());
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.starts_with("<svg") && ran.out.trim_end().ends_with("</svg>"));
    let mut png = bench.command("render stands.json -o - --format png --width 321");
    let bytes = png.output().expect("starts").stdout;
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
    assert_eq!(bytes[16..20], 321u32.to_be_bytes());
    assert_eq!(bench.run_with("check -", FALLS.as_bytes()).code, 1);
    assert_eq!(bench.run_with("check - -", FALLS.as_bytes()).code, 2);
    let ran = bench.run_with("check -", b"\xff\xfe");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("standard input"), "{}", ran.err);
    assert_eq!(bench.made(), Vec::<String>::new());
}

#[test]
fn several_scenes_fill_a_folder() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json falls.json -o new/deep/ --format png --scale 0.5");
    assert_eq!(ran.code, 0, "{}", ran.err);
    for name in ["new/deep/stands.png", "new/deep/falls.png"] {
        assert_eq!(fs::read(bench.path(name)).expect(name)[1..4], *b"PNG");
    }
    // An existing folder needs no slash, and SVG is what comes unasked.
    assert_eq!(bench.run("render stands.json -o new").code, 0);
    assert!(bench.path("new/stands.svg").exists());
    fs::create_dir(bench.path("other")).expect("made");
    fs::copy(bench.path("falls.json"), bench.path("other/stands.json")).expect("copied");
    let ran = bench.run("render stands.json other/stands.json -o twice/");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("would both become"), "{}", ran.err);
    assert!(!bench.path("twice").exists());
}

#[test]
fn one_wrong_scene_leaves_everything_unwritten() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json wrong.json falls.json -o out/");
    assert_eq!(ran.code, 2);
    fs::write(bench.path("old.svg"), "old").expect("writable");
    assert_eq!(bench.run("render wrong.json -o old.svg").code, 2);
    assert_eq!(fs::read(bench.path("old.svg")).expect("there"), b"old");
    assert_eq!(bench.made(), ["old.svg"]);
}

#[test]
fn what_cannot_be_written_ends_with_four() {
    let bench = Bench::new();
    for line in [
        "render stands.json -o no/such/folder.svg",
        "render stands.json -o stands.json/",
        "shapes -o no/such/folder.svg",
        "new -o no/such/folder.json",
        "new -o stands.json",
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, 4, "{line}: {}", ran.err);
        assert!(
            ran.err.starts_with("error: cannot write"),
            "{line}: {}",
            ran.err
        );
    }
    assert_eq!(
        fs::read_to_string(bench.path("stands.json")).expect("there"),
        STANDS
    );
    assert_eq!(bench.made(), Vec::<String>::new());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_standard_output_ends_with_four_and_a_closed_pipe_does_not() {
    let bench = Bench::new();
    for line in [
        "check --json stands.json",
        "schema",
        "render stands.json -o -",
        "completions bash",
    ] {
        let mut command = bench.command(line);
        command.stdout(
            fs::OpenOptions::new()
                .write(true)
                .open("/dev/full")
                .expect("Linux has one"),
        );
        assert_eq!(ran(command).code, 4, "{line}");

        let mut command = bench.command(line);
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("starts");
        drop(child.stdout.take());
        let ran = of(child.wait_with_output().expect("ends"));
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{line}");
    }
}

#[cfg(unix)]
#[test]
fn a_picture_has_the_rights_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    assert_eq!(bench.run("render stands.json -o a.svg").code, 0);
    fs::write(bench.path("plain"), "").expect("writable");
    let mode = |name: &str| {
        fs::metadata(bench.path(name))
            .expect("there")
            .permissions()
            .mode()
    };
    assert_eq!(mode("a.svg"), mode("plain"));
}

#[test]
fn command_lines_that_make_no_sense_are_refused_with_a_way_out() {
    let bench = Bench::new();
    for (line, words) in [
        ("render stands.json -o a.jpeg", ".svg or .png"),
        ("render stands.json -o a", "slash"),
        ("render stands.json falls.json -o a.svg", "folder"),
        ("render stands.json falls.json -o -", "folder"),
        ("render stands.json -o a.svg --width 300", "pixels"),
        (
            "render stands.json -o a.png --width 300 --scale 2",
            "--scale",
        ),
        ("render stands.json -o a.png --width 1000000", "pixels"),
        ("render stands.json -o a.png --scale nan", "pixels"),
        ("render stands.json -o a.svg --format png", "--format png"),
        ("render stands.json -o a.svg --columns 0", "--columns"),
        ("render stands.json", "--output"),
        ("new --force", "--output"),
        ("completions fsh", "fish"),
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, 2, "{line}: {}", ran.err);
        assert!(ran.err.contains(words), "{line}: {}", ran.err);
    }
    assert_eq!(bench.made(), Vec::<String>::new());
}

#[test]
fn all_problems_of_a_scene_are_shown_where_they_are() {
    let bench = Bench::new();
    let ran = bench.run("check wrong.json");
    assert_eq!(ran.code, 2);
    for words in [
        "wrong.json:3:",
        "frction",
        "friction",
        "wrong.json:4:",
        "-3",
    ] {
        assert!(ran.err.contains(words), "{words} is not in\n{}", ran.err);
    }
    let both = bench.run("check wrong.json missing.json stands.json");
    assert!(
        both.err.contains("wrong.json:3:") && both.err.contains("missing.json"),
        "{}",
        both.err
    );
}

#[test]
fn colour_is_for_terminals_and_for_those_who_ask() {
    let bench = Bench::new();
    let plain = |ran: &Ran| !ran.out.contains('\u{1b}') && !ran.err.contains('\u{1b}');
    for line in [
        "check falls.json",
        "check wrong.json",
        "check --help",
        "render falls.json -o a.svg",
        "check --nothing",
    ] {
        assert!(plain(&bench.run(line)), "{line} is piped");
        let mut command = bench.command(line);
        command.env("NO_COLOR", "1").env("CLICOLOR_FORCE", "0");
        assert!(plain(&ran(command)), "{line} with NO_COLOR");
    }
    assert!(
        bench
            .run("check falls.json --color always")
            .out
            .contains("\u{1b}[")
    );
    assert!(
        bench
            .run("check wrong.json --color always")
            .err
            .contains("\u{1b}[")
    );
    let mut command = bench.command("check falls.json --color never");
    command.env("CLICOLOR_FORCE", "1");
    assert!(plain(&ran(command)));
}

#[test]
fn quiet_leaves_the_exit_code_and_errors() {
    let bench = Bench::new();
    let ran = bench.run("check --quiet falls.json");
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (1, "", ""));
    let ran = bench.run("--quiet render falls.json -o a.svg");
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
    assert!(
        bench.run("-q check --json falls.json").out.starts_with('{'),
        "JSON was asked for"
    );
    assert!(
        bench.run("-q check wrong.json").err.contains("wrong.json"),
        "errors are told"
    );
}

#[test]
fn a_title_cannot_play_with_the_terminal() {
    let bench = Bench::new();
    let text = STANDS.replace("A lintel", "\\u001b[31mred\\u0007");
    fs::write(bench.path("red.json"), text).expect("writable");
    let ran = bench.run("check red.json --color always");
    assert_eq!(ran.code, 0);
    assert!(
        !ran.out.contains("\u{1b}[31mred") && !ran.out.contains('\u{7}'),
        "{:?}",
        ran.out
    );
    assert!(ran.out.contains("?[31mred?"), "{:?}", ran.out);
}

#[test]
fn a_new_scene_can_be_checked_and_is_not_overwritten() {
    let bench = Bench::new();
    assert_eq!(bench.run("new -o mine.json").code, 0);
    let ran = bench.run("check mine.json");
    assert!(ran.code < 2, "{}", ran.err);
    fs::write(bench.path("mine.json"), "mine").expect("writable");
    assert_eq!(bench.run("new -o mine.json").code, 4);
    assert_eq!(fs::read(bench.path("mine.json")).expect("there"), b"mine");
    assert_eq!(bench.run("new -o mine.json --force").code, 0);
    let (printed, written) = (
        bench.run("new").out,
        fs::read_to_string(bench.path("mine.json")).expect("there"),
    );
    assert_eq!(printed, written);
}

#[test]
fn the_schema_names_every_key_of_the_starter() {
    let bench = Bench::new();
    let ran = bench.run("schema");
    assert_eq!(ran.code, 0);
    let schema: Value = serde_json::from_str(&ran.out).expect("JSON");
    let starter: Value = serde_json::from_str(&bench.run("new").out).expect("JSON");
    for key in starter.as_object().expect("an object").keys() {
        assert!(
            schema["properties"][key]["description"].is_string(),
            "{key} is described"
        );
    }
}

#[test]
fn shapes_are_drawn_and_shells_are_helped() {
    let bench = Bench::new();
    assert_eq!(bench.run("shapes -o shapes.svg").code, 0);
    let sheet = fs::read_to_string(bench.path("shapes.svg")).expect("written");
    for name in ["up", "down", "hexagon", "linkh", "linkr", "linkl"] {
        assert!(sheet.contains(&format!(">{name}<")), "{name}");
    }
    assert_eq!(bench.run("shapes -o shapes.png").code, 0);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let ran = bench.run(&format!("completions {shell}"));
        assert!(
            ran.code == 0 && ran.out.contains("render") && ran.out.contains("no-timing"),
            "{shell}"
        );
    }
}

#[test]
fn help_tells_commands_limits_and_exit_codes() {
    let bench = Bench::new();
    let help = bench.run("--help");
    assert_eq!(help.code, 0);
    for words in [
        "render",
        "check",
        "schema",
        "new",
        "shapes",
        "completions",
        "balance of forces exists",
        "Exit codes",
    ] {
        assert!(help.out.contains(words), "{words} is not in\n{}", help.out);
    }
    for command in ["render", "check", "schema", "new", "shapes", "completions"] {
        let ran = bench.run(&format!("{command} --help"));
        assert!(
            ran.code == 0 && ran.out.contains("Usage: drystone"),
            "{command}"
        );
    }
}

#[test]
fn the_readmes_figure_is_what_the_program_draws() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let bench = Bench::new();
    let mut command = bench.command("render --width 1200 -o figure.png");
    command.arg(root.join("assets/thesis/figure-4.json"));
    assert_eq!(ran(command).code, 0);
    let drawn = fs::read(bench.path("figure.png")).expect("written");
    let shown = root.join("assets/figure-4.png");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none() {
        fs::write(&shown, &drawn).expect("writable");
    }
    assert!(
        fs::read(&shown).expect("in the repository") == drawn,
        "look at it, and run once with UPDATE_SNAPSHOTS=1"
    );
}

#[test]
fn the_readmes_scene_stands_as_it_says() {
    let readme = include_str!("../../README.md");
    let bench = Bench::new();
    let scene = readme
        .split("```json")
        .nth(1)
        .and_then(|rest| rest.split("```").next())
        .expect("a scene");
    fs::write(bench.path("readme.json"), scene).expect("writable");
    let ran = bench.run("check readme.json");
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
}
