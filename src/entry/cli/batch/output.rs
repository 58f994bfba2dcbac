//! The output of a batch: standard output or a file. With `--resume`, a later run can continue an output file, unless
//! it is a CSV file or a device. A CSV file has one row for each frame and one for each scene that is not valid; the
//! columns are the same in every run.

use std::fs::File;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Form;
use super::resume::{self, ResumeFile, Settings};
use crate::entry::cli::destination;
use crate::entry::cli::error::CliError;
use crate::mechanics::analysis::{Analysis, FrameAnalysis};
use crate::mechanics::batch::Records;
use crate::mechanics::scene::Problem;
use crate::products::result::Origin;
use crate::text;

/// Lines are collected in memory until they have this many bytes, and then written.
const BUFFER_BYTES: usize = 1 << 16;

/// The stream to which the lines are written.
pub(super) struct Output {
    stream: Box<dyn Write>,
    /// Lines that are not written yet.
    waiting: Vec<u8>,
    /// The resume file; `None` if the output cannot be resumed.
    resume: Option<ResumeFile>,
    /// The name of the output in error messages.
    name: String,
    is_stdout: bool,
    /// The number of complete lines that an earlier run has written.
    done: usize,
}

/// The output that the command line selects.
pub(super) struct Target<'a> {
    /// The file; `None` for standard output.
    pub path: Option<&'a Path>,
    /// Whether the existing answers in the file are kept.
    pub resume: bool,
    /// The settings on which the answers depend.
    pub settings: Settings,
    pub form: Form,
}

impl Output {
    /// Opens standard output or a file. With `--resume`, the answers that an earlier run has written to the file are
    /// checked against the first scenes in `records`. These scenes are removed from `records`, and new answers follow
    /// the old ones.
    pub fn open(target: &Target<'_>, inputs: &[PathBuf], records: &mut Records) -> Result<Output, CliError> {
        let Some(path) = target.path else {
            return Ok(Output::new(Box::new(io::stdout()), None));
        };
        let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
        let outputs = [path.to_owned(), ResumeFile::path_for(path)];
        destination::refuse_overwrites(&outputs, &inputs)?;
        if target.resume && resume::has_content(path)? {
            let checked = resume::check(path, &target.settings, records)?;
            let (file, log) = resume::reopen(path, &checked)?;
            return Ok(Output { resume: Some(log), done: checked.answers, ..Output::new(Box::new(file), Some(path)) });
        }
        let not_written = |error: io::Error| CliError::not_written(path.display(), error);
        let file = File::create(path).map_err(not_written)?;
        if target.form == Form::Csv {
            let mut output = Output::new(Box::new(file), Some(path));
            output.waiting.extend_from_slice(CSV_HEADER.as_bytes());
            return Ok(output);
        }
        // A device or a pipe does not store the answers, so a later run could not continue them.
        let is_kept = file.metadata().map_err(not_written)?.is_file();
        let log = if is_kept { Some(ResumeFile::create(path, &target.settings)?) } else { None };
        Ok(Output { resume: log, ..Output::new(Box::new(file), Some(path)) })
    }

    fn new(stream: Box<dyn Write>, path: Option<&Path>) -> Output {
        Output {
            stream,
            waiting: Vec::new(),
            resume: None,
            name: path.map_or("standard output".into(), |path| path.display().to_string()),
            is_stdout: path.is_none(),
            done: 0,
        }
    }

    /// Returns the number of complete lines that an earlier run has written; 0 without `--resume`.
    pub fn done(&self) -> usize {
        self.done
    }

    /// Adds the output line of one scene; `scene` is the hash of the scene. Writes all waiting lines if they fill the
    /// buffer. Returns `Break` if the reader of standard output has closed the pipe.
    pub fn write(&mut self, line: &[u8], scene: u64) -> Result<ControlFlow<()>, CliError> {
        self.waiting.extend_from_slice(line);
        if let Some(resume) = &mut self.resume {
            resume.push(scene, line);
        }
        if self.waiting.len() >= BUFFER_BYTES { self.flush() } else { Ok(ControlFlow::Continue(())) }
    }

    /// Writes all lines that are still in memory. Returns `Break` if the reader of standard output has closed the pipe.
    pub fn flush(&mut self) -> Result<ControlFlow<()>, CliError> {
        if let Some(resume) = &mut self.resume {
            resume.flush()?;
        }
        let written = self.stream.write_all(&self.waiting);
        self.waiting.clear();
        match written.and_then(|()| self.stream.flush()) {
            Ok(()) => Ok(ControlFlow::Continue(())),
            // A reader closes the pipe when it has read enough, so this is not an error.
            Err(error) if self.is_stdout && error.kind() == io::ErrorKind::BrokenPipe => Ok(ControlFlow::Break(())),
            Err(error) => Err(CliError::not_written(&self.name, error)),
        }
    }
}

/// The first row: the names of the columns. Forces are in newtons, and all numbers have at most twelve significant
/// digits. `friction_used` is the largest used fraction of the available friction at any contact, and `limit_used` the
/// largest used fraction of the limits of any robot.
const CSV_HEADER: &str = "file,line,scene,frame,title,verdict,weight_n,largest_force_n,total_force_n,total_sticking_n,friction_used,limit_used,problem\n";

/// Returns the rows of a scene, one for each frame.
pub(super) fn csv_rows(origin: &Origin, analysis: &Analysis) -> String {
    let scene = analysis.given();
    let frames = analysis.frames.iter().zip(&scene.frames).enumerate();
    let row = |(number, (answer, frame)): (usize, (&Arc<FrameAnalysis>, &crate::mechanics::scene::Frame))| {
        let [start, title] = [place(origin), cell(&frame.title)];
        let name = cell(&scene.title);
        let verdict = answer.verdict.word();
        let numbers = [
            answer.weight,
            answer.largest_at_contacts(),
            answer.total_force,
            answer.total_sticking,
            (answer.contacts.iter().map(|c| c.friction_used)).fold(0.0, f64::max),
            (answer.robots.iter().map(|r| r.limit_used)).fold(0.0, f64::max),
        ];
        let numbers = numbers.map(|number| rounded(number).to_string()).join(",");
        format!("{start},{name},{},{title},{verdict},{numbers},\n", number + 1)
    };
    frames.map(row).collect()
}

/// Returns the CSV row of a scene that is not valid. The row contains only the first problem of the scene.
pub(super) fn csv_problem_row(origin: &Origin, problems: &[Problem]) -> String {
    // If the scene is a line of the input, its own lines do not matter.
    let words = problems.first().map_or(String::new(), |problem| match origin.line.unwrap_or(problem.line) {
        0 => problem.message.clone(),
        line => format!("line {line}: {}", problem.message),
    });
    let between = ",".repeat(CSV_HEADER.matches(',').count() - 1);
    format!("{}{between}{}\n", place(origin), cell(&words))
}

/// Rounds a number to twelve significant digits. The digits after these are rounding errors of sums.
fn rounded(number: f64) -> f64 {
    format!("{number:.11e}").parse().unwrap_or(number)
}

fn place(origin: &Origin) -> String {
    let file = origin.file.as_deref().map_or(String::new(), text::csv);
    let line = origin.line.map_or(String::new(), |line| line.to_string());
    format!("{file},{line}")
}

fn cell(words: &str) -> String {
    if words.is_empty() { String::new() } else { text::csv(words) }
}
