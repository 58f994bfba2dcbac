//! [`write_whole`] writes files. Each file is written completely or not at all.
//!
//! Only this file uses tempfile. A file is written under a temporary name in the same folder and then renamed in one
//! step. Therefore no program ever reads an incomplete file, and a full disk leaves the old file unchanged. The new
//! file gets the permissions of the old file.
//!
//! Only a path that the user typed may be a link, whose target is then replaced, or a device or a pipe, which is written
//! to directly. At every other path the new file replaces what has this name. So a stranger's folder with links in it leads
//! to no file outside.
//!
//! Temporary files are in a list as long as they exist. `abandon` deletes them before a signal ends the process.

use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

/// What to do if a file already exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// Replace it.
    Replace,
    /// Keep it, and return an error.
    Keep,
}

/// The error for a file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {why}", path.display())]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// The reason, mostly an error of the operating system.
    pub why: io::Error,
}

/// Largest number of links that are followed. Longer chains of links count as circular.
const MAX_LINKS: usize = 40;

/// The temporary files that exist.
static TEMPORARY_FILES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Writes all files, or none of them if one cannot be written. All files are first written under temporary names, and
/// then renamed. Only paths in `typed`, which the user wrote, may lead through a link or to a device or a pipe; any other
/// link is replaced.
///
/// # Errors
/// Returns the error of the first file that could not be written. In this case nothing has changed, unless the system
/// refuses to rename a file at the end. Files that were already renamed then remain.
///
/// # Example
/// ```
/// use drystone::output::file::{Existing, write_whole};
/// let folder = tempfile::tempdir()?;
/// let files = ["a.svg", "b.svg"].map(|name| (folder.path().join(name), b"<svg/>".to_vec()));
/// write_whole(&files, Existing::Keep, &[])?;
/// let refused = write_whole(&files, Existing::Keep, &[]).expect_err("both are there");
/// assert!(refused.to_string().contains("a.svg"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_whole(files: &[(PathBuf, Vec<u8>)], existing: Existing, typed: &[PathBuf]) -> Result<(), WriteError> {
    let mut ready = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        let prepared = prepare(path, bytes, existing, typed.contains(path))
            .map_err(|why| WriteError { path: path.clone(), why })?;
        ready.push(prepared);
    }
    for (prepared, (path, bytes)) in ready.into_iter().zip(files) {
        prepared.put(bytes, existing).map_err(|why| WriteError { path: path.clone(), why })?;
    }
    Ok(())
}

/// Deletes all temporary files, and prevents new ones until the returned value is dropped. The command line calls this
/// function before a signal ends the process.
pub(crate) fn abandon() -> impl Drop {
    let mut beside = temporary_files();
    for path in beside.drain(..) {
        // The file may already be deleted. No caller can handle an error here, so the error is ignored.
        let _ = fs::remove_file(path);
    }
    beside
}

/// True if two paths lead to the same regular file, also through links. False if one of them leads to no file.
pub(crate) fn same(a: &Path, b: &Path) -> bool {
    let (Ok(a_is), Ok(b_is)) = (fs::metadata(a), fs::metadata(b)) else {
        return false;
    };
    a_is.is_file() && b_is.is_file() && same_file((a, &a_is), (b, &b_is))
}

#[cfg(unix)]
fn same_file((_, a): (&Path, &Metadata), (_, b): (&Path, &Metadata)) -> bool {
    use std::os::unix::fs::MetadataExt;
    (a.dev(), a.ino()) == (b.dev(), b.ino())
}

#[cfg(not(unix))]
fn same_file((a, _): (&Path, &Metadata), (b, _): (&Path, &Metadata)) -> bool {
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

fn temporary_files() -> MutexGuard<'static, Vec<PathBuf>> {
    // A poisoned lock is no problem: the list is valid even if a thread panicked while it held the lock.
    TEMPORARY_FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file that is prepared for writing.
enum PreparedFile {
    /// Its bytes are in a temporary file.
    TemporaryFile(TemporaryFile),
    /// A device or a pipe, open for writing.
    Stream(File),
}

impl PreparedFile {
    fn put(self, bytes: &[u8], existing: Existing) -> io::Result<()> {
        match self {
            PreparedFile::TemporaryFile(file) => file.put(existing),
            PreparedFile::Stream(mut stream) => stream.write_all(bytes),
        }
    }
}

/// A temporary file that is in the list of temporary files, and the path to which it will be renamed.
struct TemporaryFile {
    /// The file; `None` after it was renamed.
    file: Option<NamedTempFile>,
    target: PathBuf,
}

impl TemporaryFile {
    fn make(target: PathBuf) -> io::Result<TemporaryFile> {
        let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        // Lock the list before the file is created, so that no file exists without an entry in the list.
        let mut list = temporary_files();
        let file = builder().tempfile_in(folder).map_err(|error| nameless(&error))?;
        list.push(file.path().to_owned());
        drop(list);
        Ok(TemporaryFile { file: Some(file), target })
    }

    fn fill(&mut self, bytes: &[u8], old: Option<&Metadata>) -> io::Result<()> {
        // Write to the standard file handle, because the errors of tempfile contain the temporary name.
        let Some(file) = self.file.as_mut().map(NamedTempFile::as_file_mut) else {
            return Ok(());
        };
        file.write_all(bytes)?;
        if let Some(old) = old {
            keep_rights(file, old)?;
        }
        file.sync_all()
    }

    fn put(mut self, existing: Existing) -> io::Result<()> {
        let mut list = temporary_files();
        let Some(file) = self.file.take() else {
            return Ok(());
        };
        let path = file.path().to_owned();
        let moved = match existing {
            Existing::Replace => file.persist(&self.target),
            Existing::Keep => file.persist_noclobber(&self.target),
        };
        list.retain(|p| *p != path);
        drop(list);
        moved.map(drop).map_err(|error| nameless(&error.error))
    }
}

impl Drop for TemporaryFile {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            let mut list = temporary_files();
            list.retain(|p| p != file.path());
            drop(file);
        }
    }
}

/// Returns the same error without the name of the temporary file, which the tempfile library adds to the text.
fn nameless(error: &io::Error) -> io::Error {
    let text = error.to_string();
    let reason = text.split(" at path ").next().unwrap_or_default();
    io::Error::new(error.kind(), reason.to_owned())
}

/// Gives the new file the permissions of the file that it replaces and, if the system allows it, the same owner.
fn keep_rights(file: &File, old: &Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        // Usually only the superuser may change the owner, so an error is ignored. Set the permissions last, because a
        // change of owner resets some of them.
        let _ = fchown(file, Some(old.uid()), Some(old.gid()));
    }
    file.set_permissions(old.permissions())
}

/// Prepares a file for writing. Writes `bytes` to a temporary file, or opens the path if the user typed it and it leads to
/// a device or pipe.
fn prepare(path: &Path, bytes: &[u8], existing: Existing, is_typed: bool) -> io::Result<PreparedFile> {
    let target = if is_typed { followed(path)? } else { path.to_owned() };
    let old = fs::symlink_metadata(&target).ok().filter(|old| is_typed || old.is_file() || old.is_dir());
    if let Some(old) = &old {
        if old.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        if existing == Existing::Keep {
            return Err(io::Error::new(io::ErrorKind::AlreadyExists, "it already exists"));
        }
        // Open the existing file without changing it: a file that this user may not write must not be replaced either.
        let open = OpenOptions::new().write(true).open(&target)?;
        if !old.is_file() {
            return Ok(PreparedFile::Stream(open));
        }
    }
    let mut file = TemporaryFile::make(target)?;
    file.fill(bytes, old.as_ref())?;
    Ok(PreparedFile::TemporaryFile(file))
}

/// Follows symbolic links and returns the path to which they lead. A file need not exist at this path.
fn followed(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        let link = fs::symlink_metadata(&path).is_ok_and(|m| m.is_symlink());
        if !link {
            return Ok(path);
        }
        let target = fs::read_link(&path)?;
        path = path.parent().unwrap_or(Path::new("")).join(target);
    }
    Err(io::Error::other("its links are circular"))
}

fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".drystone-").suffix(".part");
    // By default only the owner may read a temporary file. Give it the permissions of an ordinary new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_completely_and_no_other_file_is_left() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("picture.svg");
        for bytes in [b"first, and longer".to_vec(), b"second".to_vec()] {
            write_whole(&[(path.clone(), bytes.clone())], Existing::Replace, &[]).expect("written");
            assert_eq!(fs::read(&path).expect("there"), bytes);
        }
        assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 1);
    }

    #[test]
    fn if_one_file_cannot_be_written_no_file_changes() {
        let folder = tempfile::tempdir().expect("a folder");
        let good = folder.path().join("good.svg");
        fs::write(&good, "before").expect("writable");
        for bad in [folder.path().join("missing").join("bad.svg"), folder.path().to_owned()] {
            let files = [(good.clone(), b"after".to_vec()), (bad.clone(), b"after".to_vec())];
            let refused = write_whole(&files, Existing::Replace, &[]).expect_err("no such place");
            assert_eq!(refused.path, bad);
            assert!(!refused.to_string().contains(".part"), "{refused}");
            assert_eq!(fs::read(&good).expect("still there"), b"before");
            assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 1, "no temporary file is left");
        }
    }

    #[cfg(unix)]
    #[test]
    fn only_a_typed_link_is_followed_and_permissions_stay() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("deep")).expect("made");
        fs::write(at("deep/real.svg"), "old").expect("writable");
        fs::set_permissions(at("deep/real.svg"), fs::Permissions::from_mode(0o640)).expect("ours");
        symlink("deep/real.svg", at("one.svg")).expect("linked");
        symlink("one.svg", at("two.svg")).expect("linked");
        symlink("deep/new.svg", at("dangling.svg")).expect("linked");
        symlink("circle.svg", at("circle.svg")).expect("linked");
        let write = |name: &str| write_whole(&[(at(name), b"new".to_vec())], Existing::Replace, &[at(name)]);
        write("two.svg").expect("written");
        write("dangling.svg").expect("written");
        assert_eq!(fs::read(at("deep/real.svg")).expect("there"), b"new");
        assert_eq!(fs::read(at("deep/new.svg")).expect("there"), b"new");
        let mode = fs::metadata(at("deep/real.svg")).expect("there").permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
        for link in ["one.svg", "two.svg", "dangling.svg"] {
            assert!(at(link).is_symlink(), "{link} is still a link");
        }
        assert!(write("circle.svg").is_err());
        // Links that nobody typed are replaced, also a circular one and one to a folder.
        symlink("deep", at("folder.svg")).expect("linked");
        let derived = ["one.svg", "circle.svg", "folder.svg"].map(|name| (at(name), b"own".to_vec()));
        write_whole(&derived, Existing::Replace, &[]).expect("written");
        for (path, own) in &derived {
            assert!(!path.is_symlink() && fs::read(path).expect("there") == *own, "{path:?}");
        }
        assert_eq!(fs::read(at("deep/real.svg")).expect("there"), b"new");
    }

    #[cfg(unix)]
    #[test]
    fn all_names_of_one_file_are_recognised() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a"), "").expect("writable");
        fs::write(at("b"), "").expect("writable");
        fs::hard_link(at("a"), at("hard")).expect("linked");
        std::os::unix::fs::symlink("hard", at("soft")).expect("linked");
        for name in ["a", "./a", "hard", "soft"] {
            assert!(same(&at("a"), &at(name)), "{name}");
        }
        for name in ["b", "none", "."] {
            assert!(!same(&at("a"), &at(name)), "{name}");
        }
        let null = Path::new("/dev/null");
        assert!(!same(null, null), "a device may be input and output");
        write_whole(&[(null.to_owned(), b"x".to_vec())], Existing::Replace, &[null.to_owned()]).expect("written");
        assert!(!fs::metadata(null).expect("there").is_file(), "no file replaces the device");
    }
}
