//! [`Terminal`]: standard output and standard error, with the options for quiet output and colours.
//!
//! No other file uses `anstream` and `terminal_size`. Pages may contain escape codes for colours. They are removed
//! here if the stream is not a terminal, or if `NO_COLOR` is set. The option `--color` takes precedence over both
//! conditions.

use std::borrow::Cow;
use std::io::{self, IsTerminal, Write};
use std::sync::OnceLock;
use std::thread;

use anstream::ColorChoice;
use clap::{Args, ValueEnum};
use terminal_size::{Height, Width};

use crate::entry::cli::error::CliError;
use crate::entry::cli::page::Page;

use crate::products::result::{Layout, quoted, refusal};

/// The options for messages and colours.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct OutputArgs {
    /// Print no tables, notes or progress; the result of check is then its exit code
    #[arg(long, short, global = true)]
    quiet: bool,
    /// Colour the text; auto depends on the terminal and on NO_COLOR
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto", env = "DRYSTONE_COLOR")]
    #[arg(hide_env_values = true)]
    color: Colour,
    /// Write errors and notes for people, or as lines of JSON: { "file", "problems" } as in check --json, { "note" }
    #[arg(long, global = true, value_name = "FORM", default_value = "text", env = "DRYSTONE_DIAGNOSTICS")]
    #[arg(hide_env_values = true)]
    diagnostics: Diagnostics,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum Diagnostics {
    Text,
    Json,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Colour {
    Auto,
    Always,
    Never,
}

/// Standard output and standard error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terminal {
    quiet: bool,
    diagnostics: Diagnostics,
}

impl Terminal {
    /// Returns the standard output and standard error of the process, with these options for messages and colours.
    pub(crate) fn new(output: OutputArgs) -> Terminal {
        let choice = match output.color {
            Colour::Auto => ColorChoice::Auto,
            Colour::Always => ColorChoice::Always,
            Colour::Never => ColorChoice::Never,
        };
        choice.write_global();
        Terminal { quiet: output.quiet, diagnostics: output.diagnostics }
    }

    /// True if `--quiet` is given: tables, notes and progress are not printed.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// True if progress may be shown: standard error is a terminal, and `--quiet` is not given.
    pub(crate) fn shows_progress(&self) -> bool {
        !self.quiet && io::stderr().is_terminal()
    }

    /// True if standard output is a terminal. Binary data such as a PNG must not be written to a terminal.
    pub(crate) fn is_watched(&self) -> bool {
        io::stdout().is_terminal()
    }

    /// Returns the number of columns of standard output; `None` if it is not a terminal.
    pub(crate) fn width(&self) -> Option<usize> {
        columns(terminal_size::terminal_size_of(io::stdout()))
    }

    /// Prints a page to standard output, in lines that are at most as wide as the terminal.
    pub(crate) fn print(&self, page: &Page) -> Result<(), CliError> {
        deliver();
        let page = fitted(page, self.width());
        let mut stream = anstream::stdout().lock();
        written(stream.write_all(page.text().as_bytes()).and_then(|()| stream.flush()))
    }

    /// Prints bytes to standard output unchanged: a picture, or JSON that is already escaped.
    pub(crate) fn print_bytes(&self, bytes: &[u8]) -> Result<(), CliError> {
        self.print_with(|stream| stream.write_all(bytes))
    }

    /// Prints what `write` writes to standard output, like [`Self::print_bytes`].
    pub(crate) fn print_with(&self, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), CliError> {
        deliver();
        let mut stream = io::BufWriter::new(io::stdout().lock());
        written(write(&mut stream).and_then(|()| stream.flush()))
    }

    /// Prints a line of information to standard error, unless `--quiet` is given.
    pub(crate) fn note(&self, words: &str) {
        self.notes(&Page::new(words));
    }

    /// Prints several lines of information to standard error, unless `--quiet` is given.
    pub(crate) fn notes(&self, page: &Page) {
        match self.diagnostics {
            _ if self.quiet => {}
            Diagnostics::Text => self.complain(page),
            Diagnostics::Json => {
                let line = format!("{{\"note\":{}}}\n", quoted(page.text().trim_end()));
                self.complain_bytes(&line);
            }
        }
    }

    /// Prints the message of an error to standard error.
    pub(crate) fn refuse(&self, complaint: &CliError) {
        match self.diagnostics {
            Diagnostics::Text => self.complain(&complaint.page(error_width())),
            Diagnostics::Json => {
                self.complain_bytes(&refusal(complaint.file(), &complaint.problems(), Layout::OneLine));
            }
        }
    }

    /// Prints a line of JSON to standard error.
    fn complain_bytes(&self, line: &str) {
        let mut stream = io::stderr().lock();
        let _ = stream.write_all(line.as_bytes()).and_then(|()| stream.flush());
    }

    /// Prints a page to standard error, also with `--quiet`.
    pub(crate) fn complain(&self, page: &Page) {
        let page = fitted(page, error_width());
        let mut stream = anstream::stderr().lock();
        // If standard error is closed, only the exit code reports the error.
        let _ = writeln!(stream, "{}", page.text().trim_end()).and_then(|()| stream.flush());
    }
}

/// Whether the time limit ended the command; decided once, by what comes first.
static IS_LATE: OnceLock<bool> = OnceLock::new();

/// Says that the command begins to deliver its results. From now on no time limit ends it. If the limit has just ended the
/// command, this function does not return.
pub(crate) fn deliver() {
    while *IS_LATE.get_or_init(|| false) {
        thread::park();
    }
}

/// Returns true if the time limit may end the command, because nothing was delivered.
pub(crate) fn is_late() -> bool {
    *IS_LATE.get_or_init(|| true)
}

/// Returns the text of a page without escape codes.
pub(crate) fn uncoloured(page: &Page) -> String {
    anstream::adapter::strip_str(page.text()).to_string()
}

/// Returns the number of columns of standard error; `None` if it is not a terminal.
pub(crate) fn error_width() -> Option<usize> {
    columns(terminal_size::terminal_size_of(io::stderr()))
}

fn columns(size: Option<(Width, Height)>) -> Option<usize> {
    size.map(|(width, _)| usize::from(width.0)).filter(|width| *width > 0)
}

fn fitted(page: &Page, width: Option<usize>) -> Cow<'_, Page> {
    match width {
        Some(width) => Cow::Owned(page.fitted(width)),
        None => Cow::Borrowed(page),
    }
}

/// Converts the result of writing to standard output. A closed pipe counts as success, because its reader needs no more
/// output.
pub(crate) fn written(written: io::Result<()>) -> Result<(), CliError> {
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(CliError::not_written("standard output", error)),
        _ => Ok(()),
    }
}
