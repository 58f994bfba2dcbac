//! `drystone batch --resume`: a run that was interrupted or killed continues, and output of other scenes is refused.

use std::fs;
use std::io::Write;
use std::process::Stdio;

use serde_json::json;

use super::{Bench, lines, tower};

#[test]
fn an_interrupted_run_continues_where_it_ended() {
    let bench = Bench::new();
    let input: String = (0..20).map(|k| tower(&format!("tower {k}"), 4, 0.02 * f64::from(k))).collect();
    fs::write(bench.path("in.ndjson"), &input).expect("writable");
    let whole = bench.run("batch in.ndjson -o whole.ndjson");
    assert_eq!((whole.code, &*whole.out), (1, ""));
    let whole = fs::read(bench.path("whole.ndjson")).expect("there");
    let record = fs::read(bench.path("whole.ndjson.resume")).expect("there");
    // The output is cut at several positions, within a line and between lines, from empty to complete.
    for cut in [0, 1, 30, whole.len() / 2, whole.len() - 1, whole.len()] {
        fs::write(bench.path("part.ndjson"), &whole[..cut]).expect("writable");
        fs::write(bench.path("part.ndjson.resume"), &record).expect("writable");
        let ran = bench.run("batch in.ndjson -o part.ndjson --resume --quiet");
        assert_ne!(ran.code, 2, "{}", ran.err);
        let resumed = fs::read(bench.path("part.ndjson")).expect("there");
        assert!(resumed == whole, "cut at {cut}");
        let kept = fs::read(bench.path("part.ndjson.resume")).expect("there");
        assert!(kept == record, "cut at {cut}");
    }
    // The existing lines stay as they are, and the answers to the remaining scenes follow.
    let ran = bench.run("batch in.ndjson -o part.ndjson --resume");
    assert_eq!((ran.code, &*ran.out), (0, ""), "{}", ran.err);
    assert!(ran.err.contains("20 scenes are answered already"), "{}", ran.err);
    assert!(fs::read(bench.path("part.ndjson")).expect("there") == whole);
    let more = format!("{input}{}", tower("last", 3, 0.1));
    fs::write(bench.path("in.ndjson"), more).expect("writable");
    bench.run("batch in.ndjson -o part.ndjson --resume");
    let longer = fs::read_to_string(bench.path("part.ndjson")).expect("there");
    assert!(longer.as_bytes().starts_with(&whole));
    assert_eq!(lines(&longer)[20]["scene"], "last");
    assert_eq!(bench.run("batch --resume").code, 2, "without an output");
}

/// Lines for other scenes, with other options or from another program are not accepted as answers, and are not
/// changed.
#[test]
fn output_of_other_scenes_or_options_is_not_resumed() {
    let bench = Bench::new();
    let towers: Vec<String> = (0..9).map(|k| tower(&format!("tower {k}"), 4, 0.02)).collect();
    let write = |name: &str, text: &str| fs::write(bench.path(name), text).expect("writable");
    write("in.ndjson", &towers.concat());
    assert_eq!(bench.run("batch in.ndjson -o out.ndjson").code, 0);
    let read = |name: &str| fs::read_to_string(bench.path(name)).expect("there");
    let (whole, record) = (read("out.ndjson"), read("out.ndjson.resume"));

    let mut other = towers.clone();
    other[4] = tower("another", 4, 0.02);
    write("other.ndjson", &other.concat());
    write("short.ndjson", &towers[..7].concat());
    write("style.json", "{}");
    let first = whole.split_inclusive('\n').next().expect("a line");
    let swapped = whole.replacen("tower 2", "tower 3", 1);
    let cut = &whole[..whole.len() / 2];
    let run = "batch in.ndjson -o out.ndjson --resume";
    // The content of the output file, the command, and the expected texts of the refusal.
    let cases: [(&str, &str, &[&str]); 13] = [
        // Other scenes at the positions of those that were answered.
        (&whole, "batch < other.ndjson", &["line 1 ", "answers in.ndjson, line 1", "standard input, line 1"]),
        (&whole, "batch other.ndjson", &["line 1 ", "answers in.ndjson, line 1", "other.ndjson, line 1"]),
        (&whole, "batch stands.json", &["line 1 ", "stands.json at this place"]),
        (&whole, "batch short.ndjson", &["answers in.ndjson"]),
        // Other options.
        (&whole, "batch in.ndjson --fields verdict", &["--fields was scene,verdict and is now verdict"]),
        (cut, "batch in.ndjson --fields all", &["--fields was scene,verdict and is now all"]),
        (&whole, "batch in.ndjson --accuracy proved", &["--accuracy was standard and is now proved"]),
        (&whole, "batch in.ndjson --contact-tolerance 1e-3", &["--contact-tolerance was not given and is now 0.001 m"]),
        (&whole, "batch in.ndjson --margins", &["--margins was none and is now all", "frames.margins"]),
        (&whole, "batch in.ndjson --render drawn", &["pictures was none and is now png"]),
        // Foreign text, and lines that were changed.
        ("mine\n", "batch in.ndjson", &["line 1 ", "was changed"]),
        (&swapped, "batch in.ndjson", &["line 3 ", "was changed"]),
        (&format!("{whole}{first}"), "batch in.ndjson", &["line 10 ", "more lines"]),
    ];
    for (output, line, expected) in cases {
        write("out.ndjson", output);
        let line = format!("{line} -o out.ndjson --resume");
        let ran = if line.contains('<') {
            bench.run_with("batch -o out.ndjson --resume", other.concat().as_bytes())
        } else {
            bench.run(&line)
        };
        assert_eq!((ran.code, &*ran.out), (2, ""), "{line}: {}", ran.err);
        let words = ran.err.split_whitespace().collect::<Vec<_>>().join(" ");
        for part in expected {
            assert!(words.contains(part), "{line}: {words}");
        }
        assert!(words.contains("leave out --resume"), "{words}");
        assert_eq!(read("out.ndjson"), output, "{line}");
        assert_eq!(read("out.ndjson.resume"), record, "{line}");
    }
    assert!(!bench.path("drawn").exists(), "a refused run creates no folder");

    // An input file with the same name, but with other or fewer scenes.
    write("out.ndjson", &whole);
    for (input, expected) in [
        (other.concat(), "line 5 of out.ndjson answers another scene than in.ndjson, line 5 now contains"),
        (towers[..7].concat(), "more lines than the input has scenes (7)"),
    ] {
        write("in.ndjson", &input);
        let ran = bench.run(run);
        let words = ran.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(ran.code == 2 && words.contains(expected), "{words}");
        assert_eq!(read("out.ndjson"), whole);
    }
    write("in.ndjson", &towers.concat());

    // Without a valid record, it is unknown which scenes the lines answer.
    for (record, expected) in
        [(None, "is missing"), (Some("{"), "drystone batch wrote"), (Some(""), "drystone batch wrote")]
    {
        match record {
            None => fs::remove_file(bench.path("out.ndjson.resume")).expect("there"),
            Some(text) => write("out.ndjson.resume", text),
        }
        let ran = bench.run(run);
        assert!(ran.code == 2 && ran.err.contains(expected), "{}", ran.err);
        assert_eq!(read("out.ndjson"), whole);
    }
    // The number of threads and the display of progress do not change the answers.
    write("out.ndjson.resume", &record);
    write("out.ndjson", cut);
    let ran = bench.run(&format!("{run} --jobs 1 --progress 10"));
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert_eq!(read("out.ndjson"), whole);
    // Output to a device cannot be resumed.
    #[cfg(unix)]
    assert_eq!(bench.run("batch in.ndjson -o /dev/null --resume").code, 2);
}

#[test]
fn a_killed_run_leaves_complete_lines_and_can_be_resumed() {
    let bench = Bench::new();
    let mut command = bench.command("batch -o out.ndjson");
    let mut child = command.stdin(Stdio::piped()).spawn().expect("starts");
    let mut pipe = child.stdin.take().expect("piped");
    let input: String = (0..6).map(|k| tower(&format!("{k}"), 3, 0.1)).collect();
    pipe.write_all(input.as_bytes()).expect("read");
    // The answers are written while the input is still open.
    let whole = || fs::read_to_string(bench.path("out.ndjson")).unwrap_or_default();
    for _ in 0..2000 {
        if whole().lines().count() == 6 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    child.kill().expect("killed");
    child.wait().expect("ended");
    assert_eq!(lines(&whole()).len(), 6);
    let more = format!("{input}{}", tower("last", 3, 0.1));
    let ran = bench.run_with("batch -o out.ndjson --resume", more.as_bytes());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let answers = lines(&whole());
    assert_eq!((answers.len(), &answers[6]["scene"]), (7, &json!("last")));
}
