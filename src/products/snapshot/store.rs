//! References on disk: who may write them, and what lies beside them while they are in question.
//!
//! A reference is written whole or not at all, and all files of one snapshot together. What was found where it differs lies
//! beside it as `.new.*`, a picture of the difference as `.diff.png`; both are taken away once they agree. Two runs at once take
//! turns by a lock on the folder itself, which the system takes back when a run ends, however it ends.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use crate::output::file::{Existing, WriteError, write_whole};

/// Whether this run is one of continuous integration, where nobody looks before a reference is accepted: `CI` is set, and not to
/// `false` or 0.
pub fn in_ci() -> bool {
    asked("CI")
}

/// Whether references are to be written: `UPDATE_SNAPSHOTS` is set, and not to `false` or 0.
pub fn asked_to_update() -> bool {
    asked("UPDATE_SNAPSHOTS")
}

fn asked(name: &str) -> bool {
    let value = std::env::var_os(name).unwrap_or_default();
    let value = value.to_string_lossy();
    !matches!(value.trim(), "" | "0" | "false" | "no")
}

/// The place of what was found, beside a reference: `arch.new.png` of `arch.png`.
///
/// ```
/// use drystone::snapshot::store::{difference, found};
/// assert_eq!(found("a b/arch.dark.png".as_ref()), std::path::Path::new("a b/arch.dark.new.png"));
/// assert_eq!(difference("arch.png".as_ref()), std::path::Path::new("arch.diff.png"));
/// ```
pub fn found(reference: &Path) -> PathBuf {
    with(reference, "new")
}

/// The place of the picture of a difference, beside a reference.
pub fn difference(reference: &Path) -> PathBuf {
    with(reference, "diff")
}

fn with(reference: &Path, mark: &str) -> PathBuf {
    let ending = reference.extension().unwrap_or_default().to_string_lossy();
    reference.with_extension(format!("{mark}.{ending}"))
}

/// Whether a name is that of what was found or of a difference, and no reference.
pub(super) fn is_beside(name: &str) -> bool {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    stem.ends_with(".new") || name.ends_with(".diff.png")
}

/// The turn of one run in some folders; it ends when this is dropped.
#[derive(Debug)]
pub struct Turn {
    _folders: Vec<File>,
}

/// How a run uses the folders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Use {
    /// References are read.
    Check,
    /// References are written.
    Accept,
}

/// Waits until no other run writes to these folders, or, to accept, until none uses them at all. Where the system has no such
/// locks everything goes on without: files are whole either way.
pub fn turn(folders: impl IntoIterator<Item = PathBuf>, usage: Use) -> Turn {
    let real = folders.into_iter().filter_map(|f| fs::canonicalize(f).ok());
    // Everybody asks in the same order: two runs never wait for each other.
    let sorted: BTreeSet<PathBuf> = real.collect();
    let mut held = Vec::new();
    for folder in sorted {
        let Ok(file) = File::open(&folder) else {
            continue;
        };
        let locked = match usage {
            Use::Check => file.lock_shared(),
            Use::Accept => file.lock(),
        };
        if locked.is_ok() {
            held.push(file);
        }
    }
    Turn { _folders: held }
}

/// Writes files, all or none.
///
/// # Errors
/// The first that could not be written.
pub fn write(files: &[(PathBuf, Vec<u8>)]) -> Result<(), WriteError> {
    write_whole(files, Existing::Replace)
}

/// Takes a file away if it is there. What cannot be taken away from a read-only folder stays; it says nothing that is not so.
pub(super) fn remove(path: &Path) {
    let _ = fs::remove_file(path);
}

/// The bytes of a reference, `None` where there is none.
///
/// # Errors
/// The system's reason.
pub(super) fn read(path: &Path) -> io::Result<Option<Vec<u8>>> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}
