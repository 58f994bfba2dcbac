//! `--watch`: repeats a command whenever one of its input files changes.
//!
//! The size and the modification time of the files are compared with their earlier values a few times a second. This
//! works on every system and on network drives.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, SystemTime};

use crate::entry::cli::error::Ended;
use crate::entry::cli::terminal::Terminal;

/// The time between two comparisons.
const POLL_INTERVAL: Duration = Duration::from_millis(200);

/// The modification time of a file, and its size in bytes; `None` if they cannot be read, for example while an editor
/// replaces the file.
type FileStamp = Option<(SystemTime, u64)>;

/// Runs a command, and runs it again whenever one of the files changes, is new or is gone, until the process is stopped.
/// `files` lists them.
///
/// Errors of a run are printed. The command still runs again when a file changes.
pub(crate) fn repeat(files: impl Fn() -> Vec<PathBuf>, terminal: &Terminal, mut run: impl FnMut() -> Ended) -> Ended {
    loop {
        let before = stamps(files());
        if let Err(complaints) = run() {
            for complaint in &complaints {
                terminal.refuse(complaint);
            }
        }
        // A change during the run counts too. If a file is still being written, wait until it stays unchanged.
        let mut last = stamps(files());
        loop {
            thread::sleep(POLL_INTERVAL);
            let now = stamps(files());
            let is_settled = now == last && now.iter().all(|(_, stamp)| stamp.is_some());
            if is_settled && now != before {
                break;
            }
            last = now;
        }
    }
}

fn stamps(files: Vec<PathBuf>) -> Vec<(PathBuf, FileStamp)> {
    files.into_iter().map(|file| (file.clone(), stamp(&file))).collect()
}

fn stamp(file: &Path) -> FileStamp {
    let known = fs::metadata(file).ok()?;
    Some((known.modified().ok()?, known.len()))
}
