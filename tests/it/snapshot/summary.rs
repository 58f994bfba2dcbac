//! The summary in Markdown, and the script of the action of GitHub.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::{Folder, lintel, ran};

/// Two scenes with references. Then one has another title, and the other falls.
fn changed() -> Folder {
    let folder =
        Folder::with(&[("scenes/a.json", lintel("One: a lintel", 1.0)), ("scenes/b.json", lintel("Two", 1.0))]);
    folder.run(&["scenes", "--accept"]);
    folder.write("scenes/a.json", &lintel("One: the <lintel>", 1.0));
    folder.write("scenes/b.json", &lintel("Two", 1.0).replace("0.6", "0.001"));
    folder
}

#[test]
fn the_summary_begins_with_the_changed_verdict_and_has_old_and_new_pictures() {
    let folder = changed();
    assert_eq!(folder.run(&["scenes", "--summary", "sum mary.md", "--accept"]).code, 0);
    let text = fs::read_to_string(folder.path("sum mary.md")).expect("written");
    let place = |words: &str| text.find(words).unwrap_or_else(|| panic!("{words} is not in {text}"));
    assert!(place("#### scenes/b") < place("#### scenes/a"), "the changed verdict comes first");
    place("| frame 1 | stands → falls |");
    place("| the scene | the title was \"One: a lintel\", and is now \"One: the \\<lintel\\>\" |");
    for number in 1..=6 {
        place(&format!("(<sum mary-pictures/{number}.png>)"));
        let png = fs::read(folder.path(&format!("sum mary-pictures/{number}.png"))).expect("written");
        assert!(png.starts_with(b"\x89PNG"));
    }
    assert_eq!(text.matches("| ![Expected: scenes/").count(), 2);
    assert_eq!(folder.run(&["scenes", "--summary", "again.md"]).code, 0);
    assert_eq!(
        fs::read_to_string(folder.path("again.md")).expect("written"),
        "### Snapshots\n\n2 snapshots: 2 match.\n"
    );
}

/// The script needs bash and git, as on the machines of GitHub.
#[cfg(unix)]
#[test]
fn the_script_of_the_action_compares_with_the_commit_before_and_fails_if_something_changed() {
    let folder = changed();
    let git = |words: &[&str]| {
        let mut command = Command::new("git");
        command.args(["-c", "user.name=a", "-c", "user.email=a@b"]).args(words).current_dir(folder.path(""));
        let done = ran(command);
        assert_eq!(done.code, 0, "{}{}", done.out, done.err);
        done.out.trim().to_owned()
    };
    let now = fs::read_to_string(folder.path("scenes/b.json")).expect("readable");
    folder.write("scenes/b.json", &lintel("Two", 1.0));
    git(&["init", "--quiet"]);
    git(&["add", "scenes"]);
    git(&["commit", "--quiet", "--message", "before"]);
    let before = git(&["rev-parse", "HEAD"]);
    folder.write("scenes/b.json", &now);
    let program = Path::new(env!("CARGO_BIN_EXE_drystone")).parent().expect("a folder");
    let act = |base: &str| {
        let mut command = Command::new("bash");
        command.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join(".github/action.sh")).current_dir(folder.path(""));
        let path = std::env::var("PATH").unwrap_or_default();
        command.env("PATH", format!("{}:{path}", program.display())).env("CI", "true");
        command.env("BASE", base).env("OUT", "pages").env("GITHUB_STEP_SUMMARY", folder.path("job.md"));
        ran(command)
    };
    let ended = act(&before);
    assert_eq!(ended.code, 1, "{}{}", ended.out, ended.err);
    assert!(ended.out.contains("::error file=scenes/b.json"), "{}", ended.out);
    let changes = fs::read_to_string(folder.path("pages/changes.html")).expect("written");
    assert!(changes.contains("scenes/b.json") && !changes.contains("scenes/a.json"), "only the changed scene");
    assert!(folder.path("pages/snapshots.html").exists() && folder.path("pages/summary-pictures/1.png").exists());
    let job = fs::read_to_string(folder.path("job.md")).expect("written");
    assert!(job.contains("| frame 1 | stands → falls |") && !job.contains("!["), "{job}");
    // A commit that nobody has is no error: the first push to a branch has none before it.
    folder.command(&["scenes", "--accept"]).status().expect("runs");
    assert_eq!(act("0000000000000000000000000000000000000000").code, 0);
}
