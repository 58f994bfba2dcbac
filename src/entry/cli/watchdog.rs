//! [`Watchdog`]: ends a command that exceeds its time limit in spite of all loops that ask for the time.
//!
//! A command that computes asks for the time itself, and then prints what it has found so far. What asks nobody (reading
//! from a pipe, laying out a figure, importing a drawing) is ended here.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use crate::entry::cli::error::CliError;
use crate::entry::cli::terminal::{Terminal, is_late};
use crate::entry::value::TimeLimit;
use crate::pictures::output::file::abandon;

/// A command may exceed its time limit by this duration. A program with debug assertions is many times slower.
const GRACE: Duration = Duration::from_millis(if cfg!(debug_assertions) { 10_500 } else { 430 });

/// Watches a command until it is dropped.
pub(crate) struct Watchdog {
    /// The thread that watches ends when this is dropped.
    _ended: Option<Sender<()>>,
}

impl Watchdog {
    /// Starts to watch a command with this time limit, if it has one.
    pub(crate) fn start(limit: Option<TimeLimit>, terminal: &Terminal) -> Watchdog {
        let Some(limit) = limit else { return Watchdog { _ended: None } };
        let (ended, end) = channel();
        let terminal = *terminal;
        thread::spawn(move || {
            // Once a command prints or writes its results, only their reader or the disk can delay it.
            if end.recv_timeout(limit.left(GRACE)) == Err(RecvTimeoutError::Timeout) && is_late() {
                let words = "was reached before the result was ready; nothing was written";
                let complaint = CliError::from(format!("the time limit of {:?} {words}", limit.given));
                terminal.refuse(&complaint);
                // Keep the guard until the end, so that no thread creates another temporary file.
                let _nothing_new = abandon();
                std::process::exit(complaint.ending().number().into());
            }
        });
        Watchdog { _ended: Some(ended) }
    }
}
