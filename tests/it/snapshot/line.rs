//! The command `drystone snapshot`: exit codes, files, messages and errors.

use std::fs;
use std::io::Write;
use std::process::Stdio;

use drystone::snapshot::picture::Picture;

use super::{Folder, accepted, lintel, ran};

#[test]
fn a_new_snapshot_is_written_next_to_the_reference_until_it_is_accepted() {
    let folder = Folder::with(&[("a/arch.json", lintel("A lintel", 1.0))]);
    let ran = folder.run(&["a"]);
    assert_eq!(ran.code, 1);
    assert!(ran.out.contains("new: a/arch.txt"), "{}", ran.out);
    assert!(ran.err.contains("1 snapshot: 0 match, 0 changed, 1 new"), "{}", ran.err);
    let new_files = ["a/arch.json", "a/arch.new.png", "a/arch.new.svg", "a/arch.new.txt", "drystone-snapshots.toml"];
    assert_eq!(folder.files(), new_files);
    assert_eq!(folder.run(&["a", "--accept"]).code, 0);
    let accepted_files = ["a/arch.json", "a/arch.png", "a/arch.svg", "a/arch.txt", "drystone-snapshots.toml"];
    assert_eq!(folder.files(), accepted_files, "no new files are left next to the references");
    let before = fs::metadata(folder.path("a/arch.png")).and_then(|m| m.modified()).expect("there");
    let ran = folder.run(&["a", "--accept"]);
    assert_eq!((ran.code, ran.out.as_str()), (0, ""));
    let after = fs::metadata(folder.path("a/arch.png")).and_then(|m| m.modified()).expect("there");
    assert_eq!(before, after, "a reference that agrees is not written again");
}

#[test]
fn a_change_is_reported_with_a_picture_that_is_removed_with_the_change() {
    let folder = accepted();
    folder.write("a/arch.json", &lintel("A lintel", 1.2));
    let ran = folder.run(&["a"]);
    assert_eq!(ran.code, 1);
    for words in [
        "a/arch\n",
        "facts changed, a/arch.txt:\n",
        "interface left–ground: N ",
        "svg changed",
        "pixels changed, a/arch.png: ",
    ] {
        assert!(ran.out.contains(words), "{words}: {}", ran.out);
    }
    assert!(ran.err.contains("to review: drystone snapshot a --review review.html"), "{}", ran.err);
    assert!(Picture::decode(&fs::read(folder.path("a/arch.diff.png")).expect("there")).is_ok());
    folder.write("a/arch.json", &lintel("A lintel", 1.0));
    assert_eq!(folder.run(&["a"]).code, 0);
    assert_eq!(folder.files().len(), 5, "{:?}", folder.files());
}

#[test]
fn references_without_scenes_and_missing_references_fail() {
    let folder = accepted();
    fs::remove_file(folder.path("a/arch.svg")).expect("there");
    let ran = folder.run(&["a"]);
    assert!(ran.code == 1 && ran.out.contains("new: a/arch.svg"), "{}", ran.out);
    assert_eq!(folder.run(&["a", "--accept"]).code, 0);
    folder.write("a/notes.txt", "The words of a person.\n");
    folder.write("a/logo.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    assert_eq!(folder.run(&["a"]).code, 0, "other files are ignored");
    folder.write("a/arch.dark.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
    let ran = folder.run(&["a"]);
    assert!(
        ran.code == 1
            && ran.out.contains("a/arch.dark.svg: an orphaned reference: the settings of its scene do not include"),
        "{}",
        ran.out
    );
    fs::remove_file(folder.path("a/arch.dark.svg")).expect("there");
    fs::rename(folder.path("a/arch.json"), folder.path("a/bow.json")).expect("renamed");
    let ran = folder.run(&["a"]);
    for name in ["arch.txt", "arch.svg", "arch.png"] {
        let words = format!("a/{name}: an orphaned reference: its scene does not exist");
        assert!(ran.code == 1 && ran.out.contains(&words), "{}", ran.out);
    }
}

#[test]
fn a_filter_selects_scenes_by_a_part_of_their_name() {
    let folder = Folder::with(&[("one.json", lintel("One", 1.0)), ("two.json", lintel("Two", 1.0))]);
    assert_eq!(folder.run(&[".", "--accept", "--only", "one"]).code, 0);
    assert!(folder.path("one.txt").exists() && !folder.path("two.txt").exists());
    assert_eq!(folder.run(&["--only", "o*e"]).code, 0);
    assert_eq!(folder.run(&["--only", "two"]).code, 1);
    let ran = folder.run(&["--only", "three"]);
    assert!(ran.code == 2 && ran.err.contains("no scene under . whose path contains \"three\""), "{}", ran.err);
}

#[test]
fn a_complete_name_selects_only_that_scene() {
    let folder = Folder::with(&[("arch.json", lintel("One", 1.0)), ("arch2.json", lintel("Two", 1.0))]);
    assert_eq!(folder.run(&[".", "--accept", "--only", "arch"]).code, 0);
    assert!(folder.path("arch.txt").exists() && !folder.path("arch2.txt").exists());
    assert_eq!(folder.run(&[".", "--only", "arch"]).code, 0);
    fs::write(folder.path("arch2.svg"), "<svg/>").expect("writable");
    assert_eq!(folder.run(&[".", "--accept", "--only", "arc"]).code, 0);
    assert!(folder.path("arch2.txt").exists(), "a part of a name selects both scenes");
}

#[test]
fn invalid_scenes_do_not_hide_the_changes_of_the_others() {
    let folder = accepted();
    folder.write("a/arch.json", &lintel("A lintel", 1.2));
    folder.write("a/bad.json", r#"{ "drystone": 1, "blocks": 3 }"#);
    folder.write("a/worse.json", "{ \"drystone\": 1,");
    folder.write("a/package.json", "{ \"name\": \"no scene\" }");
    let ran = folder.run(&["a", "--junit", "out.xml"]);
    assert_eq!(ran.code, 2, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("load on lintel: force"), "{}", ran.out);
    for words in ["bad.json", "worse.json", "1 snapshot: 0 match, 1 changed, 0 new, 2 scenes that are not valid"] {
        assert!(ran.err.contains(words) && !ran.err.contains("package.json"), "{}", ran.err);
    }
    let xml = fs::read_to_string(folder.path("out.xml")).expect("there");
    assert!(xml.contains("failures=\"3\""), "{xml}");
    let ran = folder.run(&["a", "--accept"]);
    assert!(ran.code == 2 && ran.err.contains("1 accepted"), "{}", ran.err);
    assert_eq!(folder.run(&["a", "--only", "arch"]).code, 0, "the valid scene is accepted");
}

/// A link to a missing file is one failed entry, and so is a file that is too large. The comparison goes on.
#[cfg(unix)]
#[test]
fn unreadable_scenes_do_not_hide_the_changes_of_the_others() {
    let folder = accepted();
    folder.write("a/arch.json", &lintel("A lintel", 1.2));
    std::os::unix::fs::symlink("nothing", folder.path("a/gone.json")).expect("linked");
    let large = fs::File::create(folder.path("a/large.json")).expect("writable");
    large.set_len(64_000_001).expect("sparse");
    let ran = folder.run(&["a"]);
    assert_eq!(ran.code, 2, "{}{}", ran.out, ran.err);
    assert!(ran.out.contains("load on lintel: force"), "{}", ran.out);
    for words in ["a/gone.json", "a/large.json", "1 snapshot: 0 match, 1 changed, 0 new, 2 scenes that are not valid"] {
        assert!(ran.err.contains(words), "{words}: {}", ran.err);
    }
}

#[test]
fn invalid_settings_and_options_are_reported_completely_and_nothing_is_written() {
    let folder = Folder::with(&[("good.json", lintel("Good", 1.0))]);
    folder.write("drystone-snapshots.toml", "widths = [1]\nkind = 3\npixels = \"none\"\n");
    let before = folder.files();
    let ran = folder.run(&["--accept", "--only", "good"]);
    assert_eq!((ran.code, folder.files()), (2, before));
    for words in ["drystone-snapshots.toml:1:11: ", "toml:2:1: kind: unknown key `kind`", "toml:3:10: pixels: expected"]
    {
        assert!(ran.err.contains(words), "{}", ran.err);
    }
    for wrong in [&["nowhere"][..], &["--review", "page.txt"], &["--accept", "--accept-new"], &["--json", "--github"]] {
        assert_eq!(folder.run(wrong).code, 2, "{wrong:?}");
    }
}

#[test]
fn orphaned_references_are_deleted_on_request_and_other_files_never() {
    let folder = accepted();
    folder.write("a/bow.json", &lintel("A bow", 1.0));
    folder.write("a/arch.photo.png", "A photo.");
    folder.write("a/arch.notes.txt", "Notes.");
    folder.write("a/bow.txt.svg", "<svg/>");
    assert_eq!(folder.run(&["a", "--accept"]).code, 0);
    let kept = folder.files();
    for name in ["a/arch.dark.png", "a/arch.thrust.svg", "a/gone.png", "a/gone.w320.png"] {
        folder.write(name, "<svg/>");
    }
    fs::copy(folder.path("a/arch.txt"), folder.path("a/gone.txt")).expect("copied");
    let ran = folder.run(&["a"]);
    assert!(ran.code == 1 && ran.err.contains("2 match, 5 orphaned references"), "{}{}", ran.out, ran.err);
    let mut command = folder.command(&["a", "--prune"]);
    command.env("CI", "true");
    assert_eq!(super::ran(command).code, 2, "CI is set");
    // The references of a scene that is not valid are no orphans.
    let text = fs::read_to_string(folder.path("a/arch.json")).expect("there");
    folder.write("a/arch.json", "{ \"drystone\": 1,");
    let ran = folder.run(&["a", "--prune"]);
    assert_eq!(ran.code, 2, "{}", ran.err);
    for name in ["a/gone.txt: deleted", "a/gone.png: deleted", "a/gone.w320.png: deleted", "a/arch.dark.png: deleted"] {
        assert!(ran.out.contains(name), "{}", ran.out);
    }
    assert_eq!(folder.files(), kept);
    folder.write("a/arch.json", &text);
    assert_eq!(folder.run(&["a", "--prune"]).code, 0);
}

#[test]
fn only_new_results_are_accepted_on_request() {
    let folder = accepted();
    folder.write("a/arch.json", &lintel("A lintel", 1.2));
    folder.write("a/bow.json", &lintel("A bow", 1.0));
    let before = fs::read(folder.path("a/arch.txt")).expect("there");
    let ran = folder.run(&["a", "--accept-new"]);
    assert!(ran.code == 1 && ran.err.contains("1 accepted; 2 snapshots: 1 match, 1 changed"), "{}", ran.err);
    assert!(folder.path("a/bow.txt").exists() && folder.path("a/arch.new.txt").exists());
    assert_eq!(fs::read(folder.path("a/arch.txt")).expect("there"), before);
}

#[test]
fn the_outcome_is_printed_as_json() {
    let folder = accepted();
    let outcome = |arguments: &[&str]| -> serde_json::Value {
        let ran = folder.run(arguments);
        serde_json::from_str(&ran.out).unwrap_or_else(|error| panic!("{error}: {}", ran.out))
    };
    assert_eq!(outcome(&["a", "--json"])["matches"], true);
    folder.write("a/arch.json", &lintel("A lintel", 1.2));
    folder.write("a/bad.json", "{ \"drystone\": 1,");
    folder.write("a/arch.dark.png", "");
    let found = outcome(&["a", "--json"]);
    let facts = &found["snapshots"][0]["findings"][0];
    assert_eq!(
        (&facts["layer"], &facts["file"], &facts["state"]),
        (&"facts".into(), &"a/arch.txt".into(), &"changed".into())
    );
    assert_eq!(facts["changes"][0], "load on lintel: force 4, −20 → 4.8, −24 N");
    assert_eq!(found["orphans"][0]["file"], "a/arch.dark.png");
    assert_eq!(
        (&found["refused"][0]["file"], &found["refused"][0]["problems"][0]["line"]),
        (&"a/bad.json".into(), &1.into())
    );
    let found = outcome(&["a", "--json", "--accept", "--prune"]);
    assert_eq!(found["accepted"], serde_json::json!(["a/arch.txt", "a/arch.svg", "a/arch.png"]));
    assert_eq!(
        (&found["pruned"], &found["snapshots"][0]["matches"]),
        (&serde_json::json!(["a/arch.dark.png"]), &true.into())
    );
}

#[test]
fn a_hash_takes_the_place_of_a_picture_on_request() {
    let folder = accepted();
    folder.write("drystone-snapshots.toml", "widths = [160]\npixels = \"hash\"\n");
    let ran = folder.run(&["a", "--accept", "--prune"]);
    assert!(ran.code == 0 && ran.out.contains("a/arch.png: deleted"), "{}{}", ran.out, ran.err);
    let files = ["a/arch.hash", "a/arch.json", "a/arch.svg", "a/arch.txt", "drystone-snapshots.toml"];
    assert_eq!(folder.files(), files);
    assert!(fs::read_to_string(folder.path("a/arch.hash")).expect("there").starts_with("drystone pixels 160 × "));
    assert_eq!(folder.run(&["a"]).code, 0);
    folder.write("a/arch.json", &lintel("A lintel", 1.2));
    let ran = folder.run(&["a", "--review", "page.html"]);
    assert!(ran.out.contains("pixels changed, a/arch.hash: the pixels have another hash"), "{}", ran.out);
    assert!(Picture::decode(&fs::read(folder.path("a/arch.new.png")).expect("there")).is_ok());
    let page = fs::read_to_string(folder.path("page.html")).expect("there");
    assert_eq!(page.matches("data:image/png;base64,").count(), 1, "the new picture");
    assert_eq!(folder.run(&["a", "--accept"]).code, 0);
    fs::remove_file(folder.path("page.html")).expect("there");
    assert_eq!(folder.files(), files, "no new files are left next to the references");
}

#[test]
fn nothing_is_accepted_in_ci_without_the_option_for_ci() {
    let folder = Folder::with(&[("arch.json", lintel("A lintel", 1.0))]);
    let in_ci = |arguments: &[&str]| {
        let mut command = folder.command(arguments);
        command.env("CI", "true");
        ran(command)
    };
    for arguments in [&["--accept"][..], &["--review"]] {
        let ran = in_ci(arguments);
        assert!(ran.code == 2 && ran.err.contains("CI is set"), "{}", ran.err);
    }
    assert!(!folder.path("arch.txt").exists());
    assert_eq!(in_ci(&[".", "--accept-in-ci"]).code, 0);
    assert_eq!(in_ci(&["."]).code, 0);
}

#[test]
fn names_may_have_spaces_and_any_script() {
    let names = ["a b/ein Bogen & 'mehr'.json", "арка.json", "石 橋.json", "naïve.v2.json"];
    let scenes: Vec<(&str, String)> = names.iter().map(|n| (*n, lintel(n, 1.0))).collect();
    let folder = Folder::with(&scenes);
    assert_eq!(folder.run(&["--accept"]).code, 0);
    assert!(folder.path("石 橋.png").exists() && folder.path("naïve.v2.svg").exists());
    assert_eq!(folder.run(&["."]).code, 0);
    folder.write("a b/ein Bogen & 'mehr'.json", &lintel("changed", 1.0));
    let ran = folder.run(&["--only", "Bogen"]);
    assert!(
        ran.code == 1 && ran.out.contains("facts changed, a b/ein Bogen & 'mehr'.txt: the scene: the title was"),
        "{}",
        ran.out
    );
}

#[test]
fn names_that_are_equal_on_some_disks_are_refused() {
    let folder = Folder::with(&[("Arch.json", lintel("One", 1.0)), ("arch.json", lintel("Two", 1.0))]);
    if folder.files().len() < 3 {
        // This file system ignores case, so both names are one file.
        return;
    }
    let ran = folder.run(&["--accept"]);
    assert!(ran.code == 2 && ran.err.contains("on file systems that ignore case"), "{}", ran.err);
    let folder = Folder::with(&[("a.json", lintel("One", 1.0)), ("a.dark.json", lintel("Two", 1.0))]);
    folder.write("drystone-snapshots.toml", "themes = [\"thesis\", \"dark\"]\nwidths = [160]\n");
    let ran = folder.run(&["--accept"]);
    assert!(ran.code == 2 && ran.err.contains("a.dark.png"), "{}", ran.err);
}

#[test]
fn references_that_cannot_be_read_have_specific_messages() {
    let folder = accepted();
    let pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:9f8e\nsize 18231\n";
    for (name, text, words) in [
        ("arch.png", pointer, "pixels unreadable, a/arch.png: it is a Git LFS pointer"),
        ("arch.svg", pointer, "svg unreadable, a/arch.svg: it is a Git LFS pointer"),
        ("arch.txt", pointer, "facts unreadable, a/arch.txt: it is a Git LFS pointer"),
        ("arch.png", "", "pixels unreadable, a/arch.png: it is empty (0 bytes)"),
        ("arch.txt", "<<<<<<< HEAD\n", "line 1 is a mark of a merge conflict"),
        ("arch.svg", "<svg", "svg unreadable, a/arch.svg: it is not SVG"),
    ] {
        let kept = fs::read(folder.path(&format!("a/{name}"))).expect("there");
        folder.write(&format!("a/{name}"), text);
        let ran = folder.run(&["a"]);
        assert!(ran.code == 1 && ran.out.contains(words), "{words}: {}", ran.out);
        fs::write(folder.path(&format!("a/{name}")), kept).expect("writable");
    }
    assert_eq!(folder.run(&["a"]).code, 0);
}

#[test]
fn a_page_a_report_and_annotations_are_written() {
    let folder = accepted();
    folder.write("b.json", &lintel("New", 1.0));
    folder.write("a/arch.json", &lintel("A <b>lintel</b>", 1.2));
    let ran = folder.run(&[".", "--review", "out.html", "--junit", "out.xml", "--github"]);
    assert_eq!(ran.code, 1, "{}", ran.err);
    let page = fs::read_to_string(folder.path("out.html")).expect("there");
    assert_eq!(
        page.matches("data:image/png;base64,").count(),
        3 + 2 + 1,
        "the changed scene: three, and two on top of each other; the new scene: one"
    );
    assert!(page.contains("drystone snapshot . --accept --only a/arch") && page.contains("type=\"range\""));
    assert!(page.contains("A &lt;b&gt;lintel") && !page.contains("<b>lintel"));
    assert!(!page.contains("http://") && !page.contains("https://"), "the page loads nothing from other addresses");
    let xml = fs::read_to_string(folder.path("out.xml")).expect("there");
    let document = roxmltree::Document::parse(&xml).expect("XML");
    let suite = document.root_element().first_element_child().expect("a suite");
    assert_eq!((suite.attribute("tests"), suite.attribute("failures")), (Some("2"), Some("2")));
    let lines: Vec<&str> = ran.out.lines().collect();
    assert_eq!(lines.len(), 2, "{}", ran.out);
    assert!(
        lines[0].starts_with("::error file=a/arch.json,title=drystone snapshot a/arch::  facts changed"),
        "{}",
        lines[0]
    );
    assert!(lines[0].contains("%0A"));
    assert_eq!(folder.run(&["--accept", "--junit", "out.xml"]).code, 0);
    let xml = fs::read_to_string(folder.path("out.xml")).expect("there");
    assert!(xml.contains("failures=\"0\""), "{xml}");
}

#[test]
fn review_asks_about_each_change() {
    let scenes =
        [("one.json", lintel("One", 1.0)), ("three.json", lintel("Three", 1.0)), ("two.json", lintel("Two", 1.0))];
    let folder = Folder::with(&scenes);
    let mut command = folder.command(&[".", "--review"]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut run = command.spawn().expect("starts");
    let mut typed = run.stdin.take().expect("a pipe");
    // After an invalid answer the question is repeated. At the end of the input the remaining references stay as they
    // are.
    typed.write_all(b"perhaps\ny\nn\n").expect("read");
    drop(typed);
    let output = run.wait_with_output().expect("ends");
    let out = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(out.matches("1 of 3, one: accept?").count(), 2, "{out}");
    assert!(out.contains("3 of 3, two: accept?"), "{out}");
    assert!(folder.path("one.txt").exists() && !folder.path("three.txt").exists() && !folder.path("two.txt").exists());
    assert!(!folder.path("one.new.txt").exists() && folder.path("three.new.txt").exists());
}

#[test]
fn kinds_themes_and_widths_have_their_own_files() {
    let folder = Folder::with(&[("a.json", lintel("A lintel", 1.0))]);
    folder.write(
        "drystone-snapshots.toml",
        "kinds = [\"forces\", \"thrust\"]\nthemes = [\"paper\", \"dark\"]\nwidths = [200, 100]\nlayers = [\"svg\", \"pixels\"]\n",
    );
    assert_eq!(folder.run(&["--accept"]).code, 0);
    let expected = [
        "a.dark.png",
        "a.dark.w100.png",
        "a.json",
        "a.png",
        "a.svg",
        "a.thrust.dark.png",
        "a.thrust.dark.w100.png",
        "a.thrust.png",
        "a.thrust.svg",
        "a.thrust.w100.png",
        "a.w100.png",
        "drystone-snapshots.toml",
    ];
    assert_eq!(folder.files(), expected);
    let size = |name: &str| Picture::decode(&fs::read(folder.path(name)).expect("there")).expect("read").width;
    assert_eq!((size("a.png"), size("a.thrust.dark.w100.png")), (200, 100));
    folder.write("drystone-snapshots.toml", "widths = [200]\nthemes = [\"paper\"]\n");
    let ran = folder.run(&["."]);
    assert!(
        ran.out.contains("a.thrust.svg: an orphaned reference: the settings of its scene do not include"),
        "{}",
        ran.out
    );
}

#[test]
fn a_pixel_that_nobody_can_see_is_a_note_unless_the_facts_change() {
    let folder = accepted();
    // Changes `count` pixels of the reference by `by` of 255.
    let change = |count: usize, by: u8| {
        let picture = Picture::decode(&fs::read(folder.path("a/arch.png")).expect("there")).expect("a PNG");
        let mut pixels = picture.pixels().to_vec();
        let white = pixels.iter_mut().filter(|pixel| **pixel == [255; 4]).take(count);
        white.for_each(|pixel| pixel[1] -= by);
        let changed = Picture::new(picture.width, picture.height, pixels).encode().expect("a PNG");
        (picture.encode().expect("a PNG"), changed, picture.pixels().len())
    };
    let (reference, slight, size) = change(1, 16);
    assert!(size >= 10_000, "one pixel of {size}");
    fs::write(folder.path("a/arch.png"), &slight).expect("writable");
    let ran = folder.run(&["a"]);
    assert_eq!((ran.code, ran.out.as_str()), (0, ""));
    assert!(ran.err.contains("a/arch.png: 1 of ") && ran.err.contains("which nobody can see"), "{}", ran.err);
    let json: serde_json::Value = serde_json::from_str(&folder.run(&["a", "--json"]).out).expect("JSON");
    let one = &json["snapshots"][0];
    assert_eq!((&one["matches"], one["notes"].as_array().map(Vec::len)), (&true.into(), Some(1)));
    // The facts decide.
    folder.write("a/arch.json", &lintel("A lintel", 1.2));
    assert_eq!(folder.run(&["a"]).code, 1);
    folder.write("a/arch.json", &lintel("A lintel", 1.0));
    for (count, by) in [(1, 17), (size / 10_000 + 1, 16)] {
        fs::write(folder.path("a/arch.png"), &reference).expect("writable");
        let (_, visible, _) = change(count, by);
        fs::write(folder.path("a/arch.png"), &visible).expect("writable");
        let ran = folder.run(&["a"]);
        assert!(ran.code == 1 && ran.out.contains("pixels changed"), "{count} by {by}: {}{}", ran.out, ran.err);
    }
}
