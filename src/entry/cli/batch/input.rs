//! The input of a batch: standard input, files and folders, in the order of the command line.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::entry::cli::error::CliError;
use crate::entry::cli::source;
use crate::mechanics::batch::{Input, Record};
use crate::products::result::Origin;
use crate::read::file::ending;

/// The inputs of a batch.
#[derive(Debug)]
pub(super) struct Inputs {
    pub list: Vec<Input>,
    /// The paths of the inputs; `-` for standard input.
    pub files: Vec<PathBuf>,
    /// The total size of the inputs in bytes; `None` if it is not known.
    pub bytes: Option<u64>,
}

/// Lists the input files for the paths of the command line. A folder is replaced by the scene files in it. `drawn` is
/// true with `--render`: files whose pictures would have the same name are then an error.
pub(super) fn of(paths: &[PathBuf], drawn: bool) -> Result<Inputs, Vec<CliError>> {
    let stdin = Path::new("-");
    let mut complaints = Vec::new();
    if paths.iter().filter(|p| *p == stdin).count() > 1 {
        complaints.push(CliError::CommandLine("standard input (-) can be read only once".into()));
    }
    let mut files = Vec::new();
    for path in &source::expanded(paths)? {
        match scenes_of(path) {
            Ok(found) => files.extend(found),
            Err(complaint) => complaints.push(complaint),
        }
    }
    if drawn {
        complaints.extend(name_clashes(&files));
    }
    if !complaints.is_empty() {
        return Err(complaints);
    }
    // If a shell redirects a file to standard input, `/dev/stdin` has the size of this file. On systems without
    // `/dev/stdin`, the size is unknown.
    let sizes = files.iter().map(|path| size(if path == stdin { Path::new("/dev/stdin") } else { path }));
    let bytes = sizes.sum();
    let list = files.iter().map(|path| {
        if path == stdin {
            Input::lines(None, Box::new(io::stdin()))
        } else if is_whole(path) {
            Input::Whole(path.clone())
        } else {
            Input::Lines { file: Some(path.clone()), reader: None }
        }
    });
    Ok(Inputs { list: list.collect(), bytes, files })
}

/// Returns the file and the line from which one scene of the input was read.
pub(super) fn origin(record: &Record) -> Origin {
    Origin { file: record.file.as_ref().map(|f| f.display().to_string()), line: record.line }
}

/// Returns the file and the line of one scene of the input as text for messages, such as `scenes.ndjson, line 3`.
pub(super) fn shown(record: &Record) -> String {
    let file = match &record.file {
        Some(file) => file.display().to_string(),
        None => "standard input".to_owned(),
    };
    match record.line {
        Some(line) => format!("{file}, line {line}"),
        None => file,
    }
}

/// The least number of digits of a line number in the name of a picture.
const LINE_DIGITS: usize = 7;

/// Returns the file name of the picture of one scene, without the extension: `scenes-0000003` for line 3 of
/// `scenes.ndjson`.
pub(super) fn picture_name(record: &Record) -> String {
    let stem = record.file.as_deref().map(stem);
    match (stem, record.line) {
        (None, line) => format!("{:0LINE_DIGITS$}", line.unwrap_or(0)),
        (Some(stem), None) => stem,
        (Some(stem), Some(line)) => format!("{stem}-{line:0LINE_DIGITS$}"),
    }
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

fn size(path: &Path) -> Option<u64> {
    fs::metadata(path).ok().filter(fs::Metadata::is_file).map(|found| found.len())
}

/// True if the name of a file ends in `.json`: the file then contains a single scene, and not one scene per line.
fn is_whole(path: &Path) -> bool {
    ending(path) == "json"
}

/// Returns the scene files in the folder `path`, sorted by name. If `path` is not a folder, returns only `path`.
/// Returns an error if nothing is at `path`, or if the folder has no scene files.
fn scenes_of(path: &Path) -> Result<Vec<PathBuf>, CliError> {
    let not_read = |why: String| CliError::not_read(path.display(), why);
    if path == Path::new("-") {
        return Ok(vec![path.to_owned()]);
    }
    let found = fs::metadata(path).map_err(|error| not_read(error.to_string()))?;
    if !found.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let files = source::files_in(path, &["json", "ndjson", "jsonl"], false)?;
    if files.is_empty() {
        return Err(not_read("the folder has no .json, .ndjson or .jsonl file".into()));
    }
    Ok(files)
}

/// Returns errors for input files whose pictures would have the same name. Each error names two of these files.
fn name_clashes(files: &[PathBuf]) -> Vec<CliError> {
    let mut first: BTreeMap<(String, bool), &Path> = BTreeMap::new();
    let mut clashes = Vec::new();
    for file in files {
        let earlier = first.insert((stem(file), is_whole(file)), file);
        clashes.extend(earlier.map(|earlier| (earlier, file.as_path())));
    }
    // The pictures of `a-0000001.json` and of line 1 of `a.ndjson` would have the same name, and so would the pictures
    // of `0000001.json` and of line 1 of standard input.
    for file in files.iter().filter(|file| is_whole(file)) {
        let stem = stem(file);
        let lines = stem.trim_end_matches(|c: char| c.is_ascii_digit());
        if stem.len() - lines.len() < LINE_DIGITS {
            continue;
        }
        let lines = match lines {
            "" => Some("-"),
            lines => lines.strip_suffix('-'),
        };
        let other = lines.and_then(|lines| first.get(&(lines.to_owned(), false)));
        clashes.extend(other.map(|other| (*other, file.as_path())));
    }
    let complaint = |(one, other): (&Path, &Path)| {
        CliError::CommandLine(format!(
            "the pictures of {} and {} would have the same names; rename one, or draw them into folders of their own",
            one.display(),
            other.display()
        ))
    };
    clashes.into_iter().map(complaint).collect()
}
