//! [`ResumeFile`]: a file next to the output of a batch, from which a later run can continue the output. It stores the
//! options of the run, and for each output line the hash of the scene and the hash of the line.
//!
//! The output contains only one line of JSON for each scene, so the options and hashes are in a separate file:
//! `answers.ndjson.resume` for `answers.ndjson`. It begins with the options, one `name: value` per line, and an empty
//! line. Each line after that has two hashes in hexadecimal: the hash of a scene as it was read, and the hash of the
//! line that answers it. `--resume` continues only if the options, the scenes and the output lines agree with this
//! file.

use std::fmt::Write as _;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufRead, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use super::input;
use crate::entry::cli::destination;
use crate::entry::cli::error::CliError;
use crate::mechanics::batch::{Record, Records};
use crate::pictures::output::file::Existing;
use crate::products::result::Origin;
use crate::read::file;
use crate::text;

/// The suffix that is added to the path of an output.
const FILE_SUFFIX: &str = ".resume";
/// Bytes of an entry: two hashes of 16 digits, a space and a line feed.
const ENTRY_BYTES: usize = 34;
/// The size of a read buffer in bytes.
const BUFFER_BYTES: usize = 1 << 16;

/// The name and the value of each option on which the answers of a run depend.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Settings(pub Vec<(&'static str, String)>);

impl Settings {
    /// Returns the header of a resume file: the settings, one `name: value` per line, and an empty line.
    fn header(&self) -> String {
        let mut header = String::new();
        for (name, value) in &self.0 {
            let _ = writeln!(header, "{name}: {}", text::line(value));
        }
        header.push('\n');
        header
    }

    /// Compares the settings with those of an earlier run; `earlier` is the header of its resume file. Returns a text
    /// for each setting that differs, with its name, its earlier value and its current value.
    fn differences(&self, earlier: &str) -> Vec<String> {
        let value_then = |name: &str| {
            let mut pairs = earlier.lines().filter_map(|line| line.split_once(": "));
            pairs.find(|(key, _)| *key == name).map(|(_, value)| value)
        };
        let mut found = Vec::new();
        for (name, now) in &self.0 {
            let (then, now) = (value_then(name).unwrap_or("unknown"), text::line(now));
            if then != now {
                found.push(format!("{name} was {} and is now {now}", text::line(then)));
            }
        }
        found
    }
}

/// Reads the header of a resume file. Returns `None` if the header is missing, incomplete or unreadable.
fn read_header(entries: &mut impl BufRead) -> Option<String> {
    let mut header = String::new();
    loop {
        let before = header.len();
        entries.read_line(&mut header).ok()?;
        match &header[before..] {
            "\n" if before > 0 => return Some(header),
            line if line.contains(": ") && line.ends_with('\n') => {}
            _ => return None,
        }
    }
}

/// Returns the hash of the bytes of a scene, or of the error message if the scene could not be read.
pub(super) fn record_hash(record: &Record) -> u64 {
    match &record.bytes {
        Ok(bytes) => text::hash(bytes),
        Err(why) => text::hash(why.as_bytes()),
    }
}

/// A resume file, open for more entries.
#[derive(Debug)]
pub(super) struct ResumeFile {
    file: File,
    path: PathBuf,
    /// Entries that are not written yet.
    waiting: String,
}

impl ResumeFile {
    /// Returns the path of the resume file of an output file: `answers.ndjson.resume` for `answers.ndjson`.
    pub fn path_for(output: &Path) -> PathBuf {
        let mut path = output.as_os_str().to_owned();
        path.push(FILE_SUFFIX);
        path.into()
    }

    /// Creates the resume file of an output file, and writes the settings to it.
    pub fn create(output: &Path, settings: &Settings) -> Result<ResumeFile, CliError> {
        let path = ResumeFile::path_for(output);
        let header = settings.header().into_bytes();
        let length = header.len() as u64;
        destination::write(&[(path.clone(), header)], Existing::Replace, &[])?;
        let file = cut(&path, length).map_err(|error| not_written(&path, &error))?;
        Ok(ResumeFile { file, path, waiting: String::new() })
    }

    /// Adds the entry of an output line; `scene` is the hash of its scene. The entry stays in memory until
    /// [`ResumeFile::flush`] writes it.
    pub fn push(&mut self, scene: u64, line: &[u8]) {
        // Writing to a `String` cannot fail.
        let _ = writeln!(self.waiting, "{}", entry(scene, line));
    }

    /// Writes the waiting entries to the file. Call this function before the output lines are written, so that a run
    /// that is killed leaves at least as many entries as output lines.
    pub fn flush(&mut self) -> Result<(), CliError> {
        let written = self.file.write_all(self.waiting.as_bytes());
        self.waiting.clear();
        written.map_err(|error| not_written(&self.path, &error))
    }
}

/// Returns the entry of an output line, without a line feed: the hash of the scene and the hash of the line, in
/// hexadecimal. `line` includes its line feed.
fn entry(scene: u64, line: &[u8]) -> String {
    format!("{scene:016x} {:016x}", text::hash(line))
}

fn not_written(path: &Path, error: &io::Error) -> CliError {
    CliError::not_written(path.display(), error)
}

fn not_read(path: &Path, error: &io::Error) -> CliError {
    CliError::not_read(path.display(), error)
}

/// The answers that an earlier run has written, checked against the scenes in the input.
#[derive(Debug)]
pub(super) struct Checked {
    /// The number of answers.
    pub answers: usize,
    /// The length of these answers in bytes. In the file, an incomplete line may follow them.
    pub bytes: u64,
    /// The length of the header and of the entries of these answers in the resume file, in bytes.
    resume_bytes: u64,
}

/// Compares each complete line of an existing output with its entry in the resume file and with the next scene of the
/// input. Changes no file.
///
/// # Errors
/// Returns an error for the first difference, or if a file cannot be read. The message for a difference also says what
/// to do.
pub(super) fn check(output: &Path, settings: &Settings, records: &mut Records) -> Result<Checked, CliError> {
    let name = output.display();
    let path = ResumeFile::path_for(output);
    let (mut entries, header_bytes) = open_entries(output, &path, settings)?;
    let file = file::open(output).map_err(|error| not_read(output, &error))?;
    let mut lines = BufReader::with_capacity(BUFFER_BYTES, file);
    let mut checked = Checked { answers: 0, bytes: 0, resume_bytes: header_bytes };
    let (mut line, mut entry_line) = (Vec::new(), Vec::new());
    loop {
        line.clear();
        entry_line.clear();
        lines.read_until(b'\n', &mut line).map_err(|error| not_read(output, &error))?;
        if !line.ends_with(b"\n") {
            return Ok(checked);
        }
        entries.read_until(b'\n', &mut entry_line).map_err(|error| not_read(&path, &error))?;
        let number = checked.answers + 1;
        if entry_line.len() != ENTRY_BYTES {
            return Err(refused(&format!(
                "{name} has more lines than drystone batch wrote: line {number} is the first extra line"
            )));
        }
        let Some(record) = records.next() else {
            return Err(refused(&format!(
                "{name} has more lines than the input has scenes ({}), so it was made from another input",
                checked.answers
            )));
        };
        check_line_matches(&line, &entry_line, &record)
            .map_err(|why| refused(&format!("line {number} of {name} {why}")))?;
        checked.answers += 1;
        checked.bytes += line.len() as u64;
        checked.resume_bytes += ENTRY_BYTES as u64;
    }
}

/// Opens the resume file of an output, reads its header, and checks that this run has the same options. Returns a
/// reader of the entries, and the length of the header in bytes.
fn open_entries(output: &Path, path: &Path, settings: &Settings) -> Result<(BufReader<File>, u64), CliError> {
    let name = output.display();
    if path.is_symlink() {
        return Err(refused(&format!("{} is a link, which may lead to another file", path.display())));
    }
    let file = match file::open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(refused(&format!(
                "{name} cannot be resumed: {}, which records its options and scenes, is missing",
                path.display()
            )));
        }
        Err(error) => return Err(not_read(path, &error)),
    };
    let mut entries = BufReader::with_capacity(BUFFER_BYTES, file);
    let Some(header) = read_header(&mut entries) else {
        return Err(refused(&format!("{} is not a file that drystone batch wrote", path.display())));
    };
    let differences = settings.differences(&header);
    if !differences.is_empty() {
        let differences = differences.join("; ");
        return Err(refused(&format!("{name} was made with other options: {differences}. Use the same options")));
    }
    Ok((entries, header.len() as u64))
}

/// Returns the error for an output that `--resume` cannot continue. `why` is the reason; the message also says what to
/// do.
fn refused(why: &str) -> CliError {
    CliError::CommandLine(format!("{why}. Give another output, or leave out --resume to answer every scene again"))
}

/// Checks that an output line is unchanged since it was written, and that it answers the scene in `record`.
/// `entry_line` is the entry of the output line in the resume file. The error states the difference.
fn check_line_matches(line: &[u8], entry_line: &[u8], record: &Record) -> Result<(), String> {
    let scene = record_hash(record);
    let expected = entry(scene, line);
    let (expected, found) = (expected.as_bytes(), &entry_line[..ENTRY_BYTES - 1]);
    if found[16..] != expected[16..] {
        return Err("was changed after drystone batch wrote it".into());
    }
    let now = input::origin(record);
    let then = Origin::of_line(line).unwrap_or_default();
    if now != then {
        return Err(format!("answers {then}, but the input has {now} at this place"));
    }
    if found[..16] != expected[..16] {
        return Err(format!("answers another scene than {now} now contains"));
    }
    Ok(())
}

/// Opens an output and its resume file, and deletes everything after the checked part of each file. New lines are then
/// written after the checked part.
pub(super) fn reopen(output: &Path, checked: &Checked) -> Result<(File, ResumeFile), CliError> {
    let path = ResumeFile::path_for(output);
    let file = cut(&path, checked.resume_bytes).map_err(|error| not_written(&path, &error))?;
    let answers = cut(output, checked.bytes).map_err(|error| not_written(output, &error))?;
    let resume = ResumeFile { file, path, waiting: String::new() };
    Ok((answers, resume))
}

fn cut(path: &Path, bytes: u64) -> io::Result<File> {
    let mut file = OpenOptions::new().write(true).open(path)?;
    file.set_len(bytes)?;
    file.seek(SeekFrom::Start(bytes))?;
    Ok(file)
}

/// True if the output file exists and is not empty. Returns an error if the path leads to something else than a regular
/// file, such as a folder or a pipe.
pub(super) fn has_content(output: &Path) -> Result<bool, CliError> {
    match fs::metadata(output) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(not_read(output, &error)),
        Ok(found) if !found.is_file() => Err(format!(
            "{} is not a file, so --resume cannot read the answers it has; leave out --resume",
            output.display()
        )
        .into()),
        Ok(found) => Ok(found.len() > 0),
    }
}
