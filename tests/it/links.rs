//! A folder of a stranger may contain links. No command writes through a link at a name that it derives itself: the new
//! file replaces the link, and a folder that is a link is refused. Only a path that the user typed is followed.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::path::PathBuf;
use std::process::Command;

use tempfile::TempDir;

const SCENE: &str = r#"{ "drystone": 1, "ground": [{ "polygon": [[-1, -1], [2, -1], [2, 0], [-1, 0]] }],
    "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [1, 1], [0, 1]], "weight": 1 }] }"#;
const SECRET: &[u8] = b"a file of the user\n";

/// A folder of a stranger beside a file and a folder of the user.
struct Stranger {
    root: TempDir,
}

impl Stranger {
    fn new() -> Stranger {
        let root = tempfile::tempdir().expect("a folder");
        let stranger = Stranger { root };
        for folder in ["own", "stranger/out"] {
            fs::create_dir_all(stranger.root.path().join(folder)).expect("writable");
        }
        fs::write(stranger.root.path().join("own/file"), SECRET).expect("writable");
        fs::write(stranger.at("a.json"), SCENE).expect("writable");
        stranger
    }

    fn at(&self, name: &str) -> PathBuf {
        self.root.path().join("stranger").join(name)
    }

    /// Makes a link to the user's file or, without it, to the user's folder.
    fn link(&self, name: &str, to_file: bool) {
        let _ = fs::remove_file(self.at(name));
        let own = self.root.path().join("own");
        symlink(if to_file { own.join("file") } else { own }, self.at(name)).expect("linked");
    }

    fn run(&self, arguments: &str) -> (Option<i32>, String) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        let ran = command.args(arguments.split(' ')).current_dir(self.at("")).env_remove("CI").output();
        let ran = ran.expect("starts");
        (ran.status.code(), String::from_utf8_lossy(&ran.stderr).into_owned())
    }

    /// The file of the user is as before, and nothing is beside it.
    #[track_caller]
    fn assert_untouched(&self, what: &str) {
        assert_eq!(fs::read(self.root.path().join("own/file")).expect("there"), SECRET, "{what}");
        assert_eq!(fs::read_dir(self.root.path().join("own")).expect("there").count(), 1, "{what}");
    }
}

#[test]
fn no_command_writes_through_a_link_at_a_derived_name() {
    let commands = [
        ("snapshot .", &["a.new.txt", "a.new.svg", "a.new.png"][..], 1),
        ("snapshot --accept .", &["a.txt", "a.svg", "a.png"], 0),
        ("render a.json -o out/", &["out/a.svg"], 0),
        ("render a.json --pages -o out/b.svg", &["out/b-1.svg"], 0),
        ("shapes -o out/", &["out/shapes.svg"], 0),
        ("batch a.json -o lines.ndjson", &["lines.ndjson.resume"], 0),
        ("batch a.json -o lines.ndjson --render out", &["out/a.png"], 0),
        ("report a.json --split -o out", &["out/index.html"], 0),
        ("markdown in.md -o out.md", &["out-1.svg"], 0),
    ];
    for (arguments, links, code) in commands {
        let stranger = Stranger::new();
        fs::write(stranger.at("in.md"), "```drystone file=a.json\n```\n").expect("writable");
        for link in links {
            stranger.link(link, true);
        }
        let (found, messages) = stranger.run(arguments);
        assert_eq!(found, Some(code), "{arguments}: {messages}");
        stranger.assert_untouched(arguments);
        for link in links {
            let own = fs::symlink_metadata(stranger.at(link)).expect("there");
            assert!(own.is_file() && own.len() > 0, "{arguments}: {link} is no file");
        }
    }
}

#[test]
fn the_picture_of_a_difference_replaces_a_link() {
    let stranger = Stranger::new();
    assert_eq!(stranger.run("snapshot --accept .").0, Some(0));
    fs::write(stranger.at("a.json"), SCENE.replace("[1, 1], [0, 1]", "[1, 2], [0, 2]")).expect("writable");
    for link in ["a.diff.png", "a.new.txt", "a.new.svg", "a.new.png"] {
        stranger.link(link, true);
    }
    let (code, messages) = stranger.run("snapshot .");
    assert_eq!(code, Some(1), "{messages}");
    stranger.assert_untouched("snapshot");
    assert!(fs::symlink_metadata(stranger.at("a.diff.png")).expect("there").is_file());
}

#[test]
fn a_derived_folder_that_is_a_link_is_refused() {
    for (arguments, link) in [("report a.json -o r.md", "r-figures"), ("snapshot . --summary s.md", "s-pictures")] {
        let stranger = Stranger::new();
        assert_eq!(stranger.run("snapshot --accept .").0, Some(0));
        fs::write(stranger.at("a.json"), SCENE.replace("[1, 1], [0, 1]", "[1, 2], [0, 2]")).expect("writable");
        stranger.link(link, false);
        let (code, messages) = stranger.run(arguments);
        assert!(code == Some(4) && messages.contains("it is a link"), "{arguments}: {code:?} {messages}");
        stranger.assert_untouched(arguments);
    }
}

/// The resume file of a stranger is not continued through a link.
#[test]
fn a_linked_resume_file_is_not_continued() {
    let stranger = Stranger::new();
    assert_eq!(stranger.run("batch a.json -o lines.ndjson").0, Some(0));
    let own = stranger.root.path().join("own/file");
    fs::copy(stranger.at("lines.ndjson.resume"), &own).expect("copied");
    let before = fs::read(&own).expect("there");
    stranger.link("lines.ndjson.resume", true);
    let (code, messages) = stranger.run("batch a.json a.json -o lines.ndjson --resume");
    assert!(code == Some(2) && messages.contains("is a link"), "{code:?} {messages}");
    assert_eq!(fs::read(&own).expect("there"), before);
}

#[test]
fn a_typed_link_is_followed() {
    let stranger = Stranger::new();
    stranger.link("typed.svg", true);
    assert_eq!(stranger.run("render a.json -o typed.svg").0, Some(0));
    assert!(stranger.at("typed.svg").is_symlink());
    assert!(fs::read(stranger.root.path().join("own/file")).expect("there").starts_with(b"<svg"));
    stranger.link("folder", false);
    assert_eq!(stranger.run("render a.json -o folder/").0, Some(0));
    assert!(stranger.root.path().join("own/a.svg").is_file());
}
