//! The command `render`: its files and streams, also after errors.

use std::fs;
use std::process::Stdio;

use super::{Bench, FALLS, STANDS, of, ran};

#[test]
fn render_ends_with_0_if_the_picture_is_written_unless_strict() {
    let bench = Bench::new();
    let ran = bench.run("render falls.json -o falls.svg");
    assert_eq!((ran.code, ran.out.as_str()), (0, ""), "{}", ran.err);
    assert!(ran.err.contains("falls.svg: 2 frames: 1 stands, 1 falls"), "{}", ran.err);
    assert!(fs::read_to_string(bench.path("falls.svg")).expect("written").starts_with("<svg"));
    assert_eq!(bench.run("render falls.json -o strict.svg --strict").code, 1);
    assert!(bench.path("strict.svg").exists(), "with --strict the picture is still written");
    assert_eq!(bench.run("render stands.json -o strict.svg --strict").code, 0);
    assert_eq!(bench.made(), ["falls.svg", "strict.svg"], "no other file is left");
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
fn pictures_for_print_have_their_width_in_millimetres() {
    let bench = Bench::new();
    let text = |name: &str| {
        let bytes = fs::read(bench.path(name)).expect(name);
        String::from_utf8_lossy(&bytes).into_owned()
    };
    let ran = bench.run("render stands.json -o a.pdf --width-mm 84");
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(text("a.pdf").starts_with("%PDF-") && text("a.pdf").contains("0 0 238.11"));
    assert_eq!(bench.run("render stands.json -o out/ --format pdf").code, 0);
    assert!(text("out/stands.pdf").starts_with("%PDF-"));
    assert_eq!(bench.run("render stands.json -o a.svg --width-mm 174 --text embed").code, 0);
    assert!(text("a.svg").contains("width=\"174mm\"") && text("a.svg").contains("@font-face"));
    assert_eq!(bench.run("render stands.json -o b.svg --text paths --background none").code, 0);
    assert!(!text("b.svg").contains("<text") && !text("b.svg").contains("<rect width"));
    assert_eq!(bench.run("shapes -o c.png --width-mm 84 --dpi 150 --background #f4f1ea").code, 0);
    let png = fs::read(bench.path("c.png")).expect("there");
    assert_eq!(png[16..20], 496_u32.to_be_bytes());
    assert_eq!(bench.run("shapes -o c.pdf").code, 0);
}

#[test]
fn several_scenes_fill_a_folder() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json falls.json -o new/deep/ --format png --scale 0.5");
    assert_eq!(ran.code, 0, "{}", ran.err);
    for name in ["new/deep/stands.png", "new/deep/falls.png"] {
        assert_eq!(fs::read(bench.path(name)).expect(name)[1..4], *b"PNG");
    }
    // An existing folder needs no slash, and SVG is the default format.
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
fn if_one_scene_is_invalid_nothing_is_written() {
    let bench = Bench::new();
    let ran = bench.run("render stands.json wrong.json falls.json -o out/");
    assert_eq!(ran.code, 2);
    fs::write(bench.path("old.svg"), "old").expect("writable");
    assert_eq!(bench.run("render wrong.json -o old.svg").code, 2);
    assert_eq!(fs::read(bench.path("old.svg")).expect("there"), b"old");
    assert_eq!(bench.made(), ["old.svg"]);
}

#[test]
fn a_file_that_cannot_be_written_ends_with_four() {
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
        assert!(ran.err.starts_with("error: cannot write"), "{line}: {}", ran.err);
    }
    assert_eq!(fs::read_to_string(bench.path("stands.json")).expect("there"), STANDS);
    assert_eq!(bench.made(), Vec::<String>::new());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_standard_output_ends_with_four_and_a_closed_pipe_does_not() {
    let bench = Bench::new();
    for line in ["check --json stands.json", "schema", "render stands.json -o -", "completions bash"] {
        let mut command = bench.command(line);
        command.stdout(fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has one"));
        assert_eq!(ran(command).code, 4, "{line}");

        let mut command = bench.command(line);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("starts");
        drop(child.stdout.take());
        let ran = of(child.wait_with_output().expect("ends"));
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{line}");
    }
}

#[cfg(unix)]
#[test]
fn a_picture_has_the_permissions_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new();
    assert_eq!(bench.run("render stands.json -o a.svg").code, 0);
    fs::write(bench.path("plain"), "").expect("writable");
    let mode = |name: &str| fs::metadata(bench.path(name)).expect("there").permissions().mode();
    assert_eq!(mode("a.svg"), mode("plain"));
}

#[test]
fn invalid_command_lines_are_refused_with_a_remedy() {
    let bench = Bench::new();
    for (line, words) in [
        ("render stands.json -o a.jpeg", ".svg, .png, .gif, .pdf or .tikz"),
        ("render stands.json -o a", "slash"),
        ("render stands.json falls.json -o a.svg", "folder"),
        ("render stands.json falls.json -o -", "folder"),
        ("render stands.json -o a.svg --width 300", "pixels"),
        ("render stands.json -o a.png --width 300 --scale 2", "--scale"),
        ("render stands.json -o a.png --width 1000000", "pixels"),
        ("render stands.json -o a.png --scale nan", "pixels"),
        ("render stands.json -o a.svg --format png", "--format png"),
        ("render stands.json -o a.svg --columns 0", "--columns"),
        ("render stands.json -o a.pdf --scale 2", "--width-mm"),
        ("render stands.json -o a.pdf --text paths", "--text"),
        ("render stands.json -o a.pdf --format png", "--format png"),
        ("render stands.json -o a.svg --width-mm 84 --dpi 300", "--dpi"),
        ("render stands.json -o a.png --dpi 300", "--width-mm"),
        ("render stands.json -o a.png --width 300 --width-mm 84", "--width-mm"),
        ("render stands.json -o a.svg --width-mm 0", "from 2 to 5080"),
        ("render stands.json -o a.png --width-mm 84 --dpi 0", "from 1 to 10000"),
        ("render stands.json -o a.png --width-mm 5000 --dpi 9000", "pixels"),
        ("render stands.json -o a.svg --background red", "#rrggbb"),
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
fn every_kind_of_figure_states_what_it_shows() {
    let bench = Bench::new();
    for (kind, falls, stands) in [
        ("mechanism", "block lintel turns about a corner on block left", "there is no mechanism"),
        ("thrust", "outside the stone", "at this width"),
        ("joints", "lacks a force", "of the friction is used"),
    ] {
        let ran = bench.run(&format!("render falls.json -o - --kind {kind}"));
        assert_eq!(ran.code, 0, "{kind}: {}", ran.err);
        let svg = ran.out.replace('\u{a0}', " ");
        assert!(svg.contains(&falls.replace('\u{a0}', " ")), "{kind}: {svg}");
        let ran = bench.run(&format!("render stands.json -o - --kind {kind}"));
        assert!(ran.out.contains(stands), "{kind}: {}", ran.out);
    }
    // Names of the last version are understood, and a note has the new ones.
    for (old, now) in [
        ("--kind kernel", "--kind joints"),
        ("--kind utilisation", "--kind joints"),
        ("--fill stress", "--kind joints"),
        ("--kind margin", "--kind mechanism --at tilt"),
        ("--kind movement", "--kind mechanism --at movement"),
        ("--kind placement", "--kind mechanism --at placement"),
        ("--kind influence", "--kind mechanism --at vehicle"),
        ("--kind polygon", "--kind thrust --with-polygon"),
        ("--kind removable", "--kind structure --removable"),
    ] {
        let [before, after] = [old, now].map(|words| bench.run(&format!("render stands.json -o - {words}")));
        assert_eq!((before.code, before.out), (0, after.out), "{old}");
        assert!(before.err.contains(&format!("{old} is now {now}")) && after.err.is_empty(), "{}", before.err);
    }
    let ran = bench.run("render stands.json -o out.svg --kind stress");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("mechanism") && ran.err.contains("joints"), "{}", ran.err);
    assert_eq!(bench.made(), Vec::<String>::new());
}

#[test]
fn watching_draws_again_on_every_save() {
    use std::time::{Duration, Instant};

    let bench = Bench::new();
    let mut command = bench.command("render stands.json -o seen.svg --watch");
    let mut child = (command.stdout(Stdio::null()).stderr(Stdio::null()).spawn()).expect("starts");
    let shown = |wanted: &str| {
        let start = Instant::now();
        while start.elapsed() < Duration::from_secs(60) {
            let text = fs::read_to_string(bench.path("seen.svg")).unwrap_or_default();
            if text.contains(wanted) {
                return true;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        false
    };
    let first = shown("A lintel");
    // If the saved scene is invalid, the picture stays as it is. The next valid scene is drawn.
    fs::write(bench.path("stands.json"), "{ \"drystone\": 1,").expect("writable");
    std::thread::sleep(Duration::from_millis(600));
    let kept = shown("A lintel");
    fs::write(bench.path("stands.json"), STANDS.replace("A lintel", "Another lintel")).expect("writable");
    let second = shown("Another lintel");
    child.kill().expect("it runs until it is stopped");
    child.wait().expect("ends");
    assert!(first && kept && second, "{first} {kept} {second}");
    assert_eq!(bench.run("render - -o a.svg --watch").code, 2);
}
