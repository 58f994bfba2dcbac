//! Reads and writes reference files.
//!
//! All files of a snapshot are written together, completely or not at all. If a result differs from its reference, the
//! result is written next to the reference as `.new.*`, and an image of the difference as `.diff.png`. Both files are
//! deleted when the result is accepted or agrees with its reference again. Locks on the folders ensure that no run
//! replaces references while another run uses the same folder. The operating system releases the locks when a process
//! ends for any reason.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use crate::pictures::output::file::{Existing, WriteError, write_whole};
use crate::read::file;

/// True if the program runs in continuous integration, where nobody can review a new reference: the environment
/// variable `CI` has a value other than `false`, `no`, `0` or the empty text.
pub fn in_ci() -> bool {
    is_set("CI")
}

/// True if the user requests that references are replaced: the environment variable `UPDATE_SNAPSHOTS` has a value
/// other than `false`, `no`, `0` or the empty text.
pub fn update_requested() -> bool {
    is_set("UPDATE_SNAPSHOTS")
}

fn is_set(name: &str) -> bool {
    let value = std::env::var_os(name).unwrap_or_default();
    let value = value.to_string_lossy();
    !matches!(value.trim(), "" | "0" | "false" | "no")
}

/// Returns the path for a result that differs from its reference: `arch.new.png` for `arch.png`.
///
/// ```
/// use drystone::snapshot::store::{difference_file, new_file};
/// assert_eq!(new_file("a b/arch.dark.png".as_ref()), std::path::Path::new("a b/arch.dark.new.png"));
/// assert_eq!(difference_file("arch.png".as_ref()), std::path::Path::new("arch.diff.png"));
/// ```
pub fn new_file(reference: &Path) -> PathBuf {
    with_mark(reference, "new")
}

/// Returns the path for the image of a difference: `arch.diff.png` for `arch.png`.
pub fn difference_file(reference: &Path) -> PathBuf {
    with_mark(reference, "diff")
}

/// Returns the paths of all files that a check may write next to a reference.
pub(super) fn results(reference: &Path) -> [PathBuf; 3] {
    // A reference with a hash of the pixels has its new picture as PNG.
    [new_file(reference), difference_file(reference), new_file(&reference.with_extension("png"))]
}

fn with_mark(reference: &Path, mark: &str) -> PathBuf {
    let ending = reference.extension().unwrap_or_default().to_string_lossy();
    reference.with_extension(format!("{mark}.{ending}"))
}

/// True if this is the name of a `.new.*` or `.diff.png` file.
pub(super) fn is_result_file(name: &str) -> bool {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    stem.ends_with(".new") || name.ends_with(".diff.png")
}

/// A lock on folders, released when it is dropped.
#[derive(Debug)]
pub struct FolderLock {
    _folders: Vec<File>,
}

/// The access of a run to the files in a folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// The run reads references, and may write `.new.*` files. Other runs may do the same at the same time.
    Read,
    /// The run replaces references. No other run may use the folder at the same time.
    Write,
}

/// Locks folders for this run of the program. For read access, waits until no other run has write access. For write
/// access, waits until no other run uses the folders.
///
/// On a file system without locks, the run continues without a lock. Even then, each file is written completely or
/// not at all.
pub fn lock_folders(folders: impl IntoIterator<Item = PathBuf>, access: Access) -> FolderLock {
    let real = folders.into_iter().filter_map(|f| fs::canonicalize(f).ok());
    // Lock the folders in sorted order. Because all runs use this order, two runs cannot wait for each other forever
    // (no deadlock).
    let sorted: BTreeSet<PathBuf> = real.collect();
    let mut held = Vec::new();
    for folder in sorted {
        let Ok(file) = File::open(&folder) else {
            continue;
        };
        let locked = match access {
            Access::Read => file.lock_shared(),
            Access::Write => file.lock(),
        };
        if locked.is_ok() {
            held.push(file);
        }
    }
    FolderLock { _folders: held }
}

/// Writes all files, or no file if one of them cannot be written.
///
/// # Errors
/// The first file that could not be written.
pub fn write(files: &[(PathBuf, Vec<u8>)]) -> Result<(), WriteError> {
    write_whole(files, Existing::Replace, &[])
}

/// Deletes a file if it exists. An error is ignored: a file that stays in a read-only folder does no harm.
pub(super) fn remove(path: &Path) {
    let _ = fs::remove_file(path);
}

/// Returns the bytes of a reference; `None` if the file does not exist.
///
/// # Errors
/// The error of the operating system, if the file exists but cannot be read.
pub(super) fn read(path: &Path) -> io::Result<Option<Vec<u8>>> {
    match file::bytes(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}
