//! Where the lines of a batch go: standard output, or a file that grows and can be gone on with.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Seek, SeekFrom, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use crate::cli::complaint::CliError;
use crate::cli::destination;

/// The lines' way out.
pub(super) struct Output {
    stream: BufWriter<Box<dyn Write>>,
    /// How complaints name it.
    name: String,
    is_stdout: bool,
    done: usize,
}

impl Output {
    /// Standard output, or a file: a new one, or where it is to be gone on with, behind its last whole line.
    pub fn open(path: Option<&Path>, resume: bool, inputs: &[PathBuf]) -> Result<Output, CliError> {
        let Some(path) = path else {
            return Ok(Output {
                stream: BufWriter::new(Box::new(io::stdout())),
                name: "standard output".into(),
                is_stdout: true,
                done: 0,
            });
        };
        let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
        destination::apart(&[path.to_owned()], &inputs)?;
        let not_written = |error: io::Error| CliError::NotWritten {
            what: path.display().to_string(),
            why: error.to_string(),
        };
        let (file, done) = if resume {
            behind_last_line(path).map_err(not_written)?
        } else {
            (File::create(path).map_err(not_written)?, 0)
        };
        Ok(Output {
            stream: BufWriter::with_capacity(1 << 16, Box::new(file)),
            name: path.display().to_string(),
            is_stdout: false,
            done,
        })
    }

    /// How many lines were there already.
    pub fn done(&self) -> usize {
        self.done
    }

    /// What is said where the output has more lines than the input has scenes.
    pub fn belongs_elsewhere(&self, scenes: usize) -> CliError {
        CliError::CommandLine(format!(
            "{} has {} lines already, but the input has only {scenes} scenes: it was made from another input. Give another \
             output, or leave out --resume",
            self.name, self.done
        ))
    }

    /// Writes a line, or says that nobody reads on.
    pub fn write(&mut self, line: &[u8]) -> Result<ControlFlow<()>, CliError> {
        let written = self.stream.write_all(line);
        self.reported(written)
    }

    /// Sees to it that what was written can be read.
    pub fn flush(&mut self) -> Result<ControlFlow<()>, CliError> {
        let flushed = self.stream.flush();
        self.reported(flushed)
    }

    fn reported(&self, written: io::Result<()>) -> Result<ControlFlow<()>, CliError> {
        match written {
            Ok(()) => Ok(ControlFlow::Continue(())),
            // A reader that closes the pipe has read enough: that is no failure of ours.
            Err(error) if self.is_stdout && error.kind() == io::ErrorKind::BrokenPipe => {
                Ok(ControlFlow::Break(()))
            }
            Err(error) => Err(CliError::NotWritten {
                what: self.name.clone(),
                why: error.to_string(),
            }),
        }
    }
}

/// A file, cut behind its last whole line and open for more, and how many lines it has.
fn behind_last_line(path: &Path) -> io::Result<(File, usize)> {
    let mut file = OpenOptions::new()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(path)?;
    let (mut lines, mut whole, mut size) = (0, 0, 0);
    let mut reader = BufReader::with_capacity(1 << 16, &mut file);
    loop {
        let found = reader.fill_buf()?;
        if found.is_empty() {
            break;
        }
        for (place, byte) in found.iter().enumerate() {
            if *byte == b'\n' {
                lines += 1;
                whole = size + place as u64 + 1;
            }
        }
        let used = found.len();
        size += used as u64;
        reader.consume(used);
    }
    file.set_len(whole)?;
    file.seek(SeekFrom::Start(whole))?;
    Ok((file, lines))
}
