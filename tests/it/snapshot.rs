//! Snapshots: which changes are found by which layer, which are accepted, and how files change.

mod assertion;
mod disk;
mod file;
mod line;
mod mutation;
mod summary;
mod theme;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

/// Two posts and a lintel with a load that pushes to the right.
pub(crate) fn lintel(title: &str, load: f64) -> String {
    serde_json::json!({
        "drystone": 1, "title": title, "friction": 0.6,
        "ground": [{ "polygon": [[-1, -1], [7, -1], [7, 0], [-1, 0]] }],
        "blocks": [
            { "id": "left", "polygon": [[0, 0], [1, 0], [1, 3], [0, 3]], "weight": 60 },
            { "id": "right", "polygon": [[5, 0], [6, 0], [6, 3], [5, 3]], "weight": 60 },
            { "id": "lintel", "polygon": [[0, 3], [6, 3], [6, 4], [0, 4]], "weight": 110 } ],
        "loads": [{ "block": "lintel", "force": [4.0 * load, -20.0 * load], "at": [2, 4] }]
    })
    .to_string()
}

/// The exit code and the output of a run.
struct Ran {
    code: i32,
    out: String,
    err: String,
}

/// A folder of scenes that is removed at the end of the test.
struct Folder {
    folder: TempDir,
}

impl Folder {
    /// A folder with these scenes and very small reference pictures.
    fn with(scenes: &[(&str, String)]) -> Folder {
        let folder = Folder { folder: tempfile::tempdir().expect("a folder") };
        folder.write("drystone-snapshots.toml", "widths = [160]\n");
        for (name, text) in scenes {
            folder.write(name, text);
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        fs::write(path, text).expect("writable");
    }

    /// The paths of all files, relative to the folder.
    fn files(&self) -> Vec<String> {
        let mut files = Vec::new();
        collect(self.folder.path(), self.folder.path(), &mut files);
        files.sort();
        files
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_drystone"));
        command.arg("snapshot").args(arguments);
        command.current_dir(self.folder.path());
        for name in ["CI", "UPDATE_SNAPSHOTS", "TERM_PROGRAM", "KITTY_WINDOW_ID"] {
            command.env_remove(name);
        }
        command
    }

    fn run(&self, arguments: &[&str]) -> Ran {
        ran(self.command(arguments))
    }
}

fn ran(mut command: Command) -> Ran {
    let output = command.output().expect("starts");
    Ran {
        code: output.status.code().expect("not ended by a signal"),
        out: String::from_utf8(output.stdout).expect("UTF-8"),
        err: String::from_utf8(output.stderr).expect("UTF-8"),
    }
}

fn collect(root: &Path, folder: &Path, files: &mut Vec<String>) {
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            collect(root, &path, files);
        } else {
            let below = path.strip_prefix(root).expect("below");
            files.push(below.to_string_lossy().replace('\\', "/"));
        }
    }
}

/// Every scene in `tests/scenes`, including those of the thesis's figures, with facts, drawing and picture in its first
/// theme. For the other themes see `theme.rs`.
#[test]
fn the_gallery_equals_its_references() {
    drystone::snapshot::assert_scenes!("tests/scenes");
}

/// The figures of `drystone figures`. Some of them have no scene file: the ring of colours and the sheet of shapes.
#[test]
fn the_figures_of_the_program_equal_their_references() {
    let plates = drystone::figure::gallery(&drystone::drawing::Theme::thesis());
    for plate in &plates {
        drystone::snapshot::assert_figure!(plate.name, &plate.drawing);
    }
    // Every reference belongs to an existing plate.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshots");
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        let stem = path.file_stem().expect("named").to_string_lossy().into_owned();
        let known = plates.iter().any(|p| p.name == stem);
        assert!(known || stem == "drystone-snapshots", "{} has no plate", path.display());
    }
}

/// A folder with one scene and its accepted references.
fn accepted() -> Folder {
    let folder = Folder::with(&[("a/arch.json", lintel("A lintel", 1.0))]);
    let ran = folder.run(&["a", "--accept"]);
    assert_eq!(ran.code, 0, "{}{}", ran.out, ran.err);
    folder
}
