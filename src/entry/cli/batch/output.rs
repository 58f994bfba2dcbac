//! The output of a batch: standard output or a file. With `--resume`, a later run can continue an output file, unless
//! it is a CSV file or a device.

use std::fs::File;
use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use super::resume::{self, ResumeFile, Settings};
use super::{Form, csv};
use crate::entry::cli::destination;
use crate::entry::cli::error::CliError;
use crate::mechanics::batch::Records;

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
            output.waiting.extend_from_slice(csv::HEADER.as_bytes());
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
