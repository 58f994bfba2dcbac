//! Texts of the command line: colour, quiet mode, help, starters, schemas and shapes; and the pictures of the README.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{Bench, Ran, STANDS, ran};

#[test]
fn output_is_coloured_only_in_terminals_or_on_request() {
    let bench = Bench::new();
    let plain = |ran: &Ran| !ran.out.contains('\u{1b}') && !ran.err.contains('\u{1b}');
    for line in
        ["check falls.json", "check wrong.json", "check --help", "render falls.json -o a.svg", "check --nothing"]
    {
        assert!(plain(&bench.run(line)), "{line} is piped");
        let mut command = bench.command(line);
        command.env("NO_COLOR", "1").env("CLICOLOR_FORCE", "0");
        assert!(plain(&ran(command)), "{line} with NO_COLOR");
    }
    assert!(bench.run("check falls.json --color always").out.contains("\u{1b}["));
    assert!(bench.run("check wrong.json --color always").err.contains("\u{1b}["));
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
    assert!(bench.run("-q check --json falls.json").out.starts_with('{'), "requested JSON is written");
    assert!(bench.run("-q check wrong.json").err.contains("wrong.json"), "errors are written");
}

#[test]
fn a_title_cannot_control_the_terminal() {
    let bench = Bench::new();
    let text = STANDS.replace("A lintel", "\\u001b[31mred\\u0007");
    fs::write(bench.path("red.json"), text).expect("writable");
    let ran = bench.run("check red.json --color always");
    assert_eq!(ran.code, 0);
    assert!(!ran.out.contains("\u{1b}[31mred") && !ran.out.contains('\u{7}'), "{:?}", ran.out);
    assert!(ran.out.contains("\u{fffd}[31mred\u{fffd}"), "{:?}", ran.out);
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
    let (printed, written) = (bench.run("new").out, fs::read_to_string(bench.path("mine.json")).expect("there"));
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
        assert!(schema["properties"][key]["description"].is_string(), "{key} has no description");
    }
}

#[test]
fn shapes_are_drawn_and_completions_are_written_for_every_shell() {
    let bench = Bench::new();
    assert_eq!(bench.run("shapes -o shapes.svg").code, 0);
    let sheet = fs::read_to_string(bench.path("shapes.svg")).expect("written");
    for name in ["up", "down", "hexagon", "linkh", "linkr", "linkl"] {
        assert!(sheet.contains(&format!(">{name}<")), "{name}");
    }
    assert_eq!(bench.run("shapes -o shapes.png").code, 0);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let ran = bench.run(&format!("completions {shell}"));
        assert!(ran.code == 0 && ran.out.contains("render") && ran.out.contains("no-timing"), "{shell}");
    }
}

#[test]
fn help_describes_commands_limits_and_exit_codes() {
    let bench = Bench::new();
    let help = bench.run("--help");
    assert_eq!(help.code, 0);
    for words in
        ["render", "check", "schema", "new", "shapes", "style", "completions", "balance of forces exists", "Exit codes"]
    {
        assert!(help.out.contains(words), "{words} is not in\n{}", help.out);
    }
    for command in [
        "render",
        "check",
        "schema",
        "new",
        "shapes",
        "style",
        "completions",
        "accuracy",
        "batch",
        "figures",
        "import",
        "man",
        "markdown",
        "mdbook",
        "new arch",
        "new ladder",
        "new incline",
        "plan",
        "report",
        "snapshot",
    ] {
        let ran = bench.run(&format!("{command} --help"));
        for line in ran.out.lines() {
            assert!(line.chars().count() <= 80, "{command}: {line}");
        }
        assert!(ran.code == 0 && ran.out.contains("Usage: drystone"), "{command}");
    }
}

#[test]
fn the_readmes_figure_is_what_the_program_draws() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let bench = Bench::new();
    let mut command = bench.command("render --width 1200 --no-source -o figure.png");
    command.arg(root.join("assets/thesis/figure-4.json"));
    assert_eq!(ran(command).code, 0);
    let drawn = fs::read(bench.path("figure.png")).expect("written");
    let shown = root.join("assets/figure-4.png");
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none() {
        fs::write(&shown, &drawn).expect("writable");
    }
    assert!(
        fs::read(&shown).expect("in the repository") == drawn,
        "the figure differs: inspect it, and run once with UPDATE_SNAPSHOTS=1"
    );
}

#[test]
fn the_readmes_gallery_is_what_the_program_draws() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/gallery");
    let bench = Bench::new();
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some() && std::env::var_os("CI").is_none();
    for name in ["aqueduct", "cathedral", "corbelled-vault", "flying-buttress", "gabled-wall"] {
        // The same options as in `examples/gallery.py`.
        let line = "render --kind flow --no-key --width-mm 100 --dpi 120 --strict --no-source -o picture.png";
        let mut command = bench.command(line);
        command.arg(folder.join(format!("{name}.json")));
        let ran = ran(command);
        assert_eq!(ran.code, 0, "{name} stands: {}", ran.err);
        let drawn = fs::read(bench.path("picture.png")).expect("written");
        assert!(drawn.len() < 70_000, "{name} has {} bytes", drawn.len());
        let shown = folder.join(format!("{name}.png"));
        if update {
            fs::write(&shown, &drawn).expect("writable");
        }
        assert!(
            fs::read(&shown).is_ok_and(|shown| shown == drawn),
            "{name} differs: inspect it, and run once with UPDATE_SNAPSHOTS=1"
        );
    }
}

#[test]
fn the_readmes_scene_stands() {
    let readme = include_str!("../../../README.md");
    let bench = Bench::new();
    let scene = readme.split("```json").nth(1).and_then(|rest| rest.split("```").next()).expect("a scene");
    fs::write(bench.path("readme.json"), scene).expect("writable");
    let ran = bench.run("check readme.json");
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
}

#[test]
fn themes_and_styles_change_the_picture() {
    let bench = Bench::new();
    let plain = bench.run("render stands.json -o -").out;
    assert_eq!(bench.run("render stands.json -o - --theme plain").out, plain);
    let dark = bench.run("render stands.json -o - --theme dark").out;
    assert!(dark.contains("fill=\"#15181d\"") && !plain.contains("#15181d"));
    let sheet = bench.run("shapes -o - --theme dark").out;
    assert!(sheet.contains("fill=\"#15181d\""));
    let ran = bench.run("render stands.json -o - --theme drak");
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("colourblind") && ran.err.contains("'dark'"), "{}", ran.err);

    // With the printed style as a style file, the picture is the same.
    let printed = bench.run("style --theme dark").out;
    fs::write(bench.path("dark.json"), printed).expect("writable");
    assert_eq!(bench.run("render stands.json -o - --style dark.json").out, dark);
    fs::write(bench.path("mine.toml"), "page = '#fed'\n[sizes]\ncaption = 30\nkey = 21").expect("writable");
    let mine = bench.run("render stands.json -o - --style mine.toml").out;
    assert!(mine.contains("fill=\"#ffeedd\"") && mine.contains("font-size=\"21\""));
    let both = bench.run("render stands.json -o - --style mine.toml --theme paper").out;
    assert!(both.contains("fill=\"#ffeedd\"") && both.contains("#f2f2f2"), "{both}");
}

#[test]
fn an_invalid_style_is_reported_with_all_other_errors_and_nothing_is_written() {
    let bench = Bench::new();
    fs::write(bench.path("bad.json"), r##"{ "failur": "#d00", "ink": "blak" }"##).expect("writable");
    let ran = bench.run("render wrong.json -o a.svg --style bad.json");
    assert_eq!(ran.code, 2);
    for words in [
        "error: bad.json: line 1, column 3, failur: unknown key",
        "the nearest known key is `failure`",
        "error: bad.json: line 1, column 28, ink: expected a colour such as \"#d55e00\" or \"#d50\", found the string \"blak\"",
        "negative weight -3",
    ] {
        assert!(ran.err.contains(words), "{words}\n{}", ran.err);
    }
    let ran = bench.run("shapes -o a.svg --style bad.json");
    assert!(ran.code == 2 && ran.err.contains("failur"), "{}", ran.err);
    let ran = bench.run("render stands.json -o a.svg --style gone.toml");
    assert!(ran.code == 2 && ran.err.contains("cannot read gone.toml"), "{}", ran.err);
    // `--style` had this value in earlier versions; the message names the option that replaced it.
    let ran = bench.run("render stands.json -o a.svg --style components");
    assert!(ran.code == 2 && ran.err.contains("--arrows"), "{}", ran.err);
    assert_eq!(bench.run("render stands.json -o a.svg --arrows components").code, 0);
    assert_eq!(bench.made(), ["a.svg", "bad.json"]);
}

#[test]
fn notes_are_written_below_the_table_and_in_json_and_can_be_left_out() {
    let bench = Bench::new();
    let text = STANDS.replace("0.6", "6");
    fs::write(bench.path("noted.json"), text).expect("writable");
    let ran = bench.run("check noted.json");
    assert_eq!(ran.code, 0);
    assert!(ran.out.contains("note: line 1, friction: a friction coefficient of 6"), "{}", ran.out);
    assert!(ran.out.contains("\"silence\": [\"friction_high\"]"), "{}", ran.out);
    let object: Value = serde_json::from_str(&bench.run("check --json noted.json").out).expect("JSON");
    assert_eq!(object["notes"][0]["code"], "friction_high");
    assert_eq!(object["notes"][0]["line"], 1);
    for line in ["check --no-notes noted.json", "check --no-notes --json noted.json", "check stands.json"] {
        let ran = bench.run(line);
        assert!(ran.code == 0 && !ran.out.contains("note:") && !ran.out.contains("\"notes\""), "{line}: {}", ran.out);
    }
    assert_eq!(bench.run("check -q noted.json").out, "");
}

#[test]
fn new_writes_structures_with_given_dimensions() {
    let bench = Bench::new();
    for (line, blocks, code) in [
        ("new arch --voussoirs 9 --span 3 -o a.json", 9, 0),
        ("new arch --thickness 0.15 -o a.json --force", 13, 1),
        ("new wall --courses 2 --bricks 3 -o a.json --force", 7, 0),
        ("new tower --lean 0.13 -o a.json --force", 8, 1),
        ("new doorway -o a.json --force", 9, 0),
        ("new lattice --rows 2 -o a.json --force", 4, 0),
    ] {
        let ran = bench.run(line);
        assert_eq!(ran.code, 0, "{line}: {}", ran.err);
        let text = fs::read_to_string(bench.path("a.json")).expect("written");
        let scene: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(scene["blocks"].as_array().map(Vec::len), Some(blocks), "{line}");
        assert_eq!(bench.run("check -q a.json").code, code, "{line}");
    }
    for line in ["new arch --voussoirs 1", "new arch --span -1", "new tower --lean x", "new wall --length nan"] {
        assert_eq!(bench.run(line).code, 2, "{line}");
    }
    assert!(bench.run("new arch").out.contains("\"A round arch of 13 voussoirs over 4 m, 0.4 m thick\""));
}

#[test]
fn the_schema_of_results_is_printed() {
    let ran = Bench::new().run("schema --result");
    let schema: Value = serde_json::from_str(&ran.out).expect("JSON");
    assert_eq!((ran.code, &schema["title"]), (0, &"drystone result".into()));
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let bench = Bench::new();
    let ran = bench.run("man pages");
    assert_eq!(ran.code, 0, "{}", ran.err);
    for (page, words) in [
        ("drystone.1", "drystone"),
        ("drystone-check.1", "no\\-notes"),
        ("drystone-new-arch.1", "voussoirs"),
        ("drystone-man.1", "manual pages"),
    ] {
        let text = fs::read_to_string(bench.path(&format!("pages/{page}"))).expect(page);
        assert!(text.starts_with(".ie") || text.contains(".TH"), "{page}");
        assert!(text.contains(words), "{page}: {text}");
    }
}

#[test]
fn the_style_shown_on_the_page_works() {
    let page = include_str!("../../../src/doc/cli.md");
    assert!(page.contains("\ndrystone style > mine.json "));
    assert!(page.contains("--theme dark --style mine.json\n"));
    let bench = Bench::new();
    fs::write(bench.path("mine.json"), bench.run("style").out).expect("writable");
    let ran = bench.run("render stands.json -o scene.svg --theme dark --style mine.json");
    assert_eq!(ran.code, 0, "{}", ran.err);
}
