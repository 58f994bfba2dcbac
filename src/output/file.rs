//! [`write_whole`]: files appear whole or not at all.
//!
//! The only file that names tempfile. A file is written beside its place and then moved there in one step, so that nobody
//! ever sees half of it, and so that a disk that runs full leaves the old file as it was.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// What becomes of a file that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It is replaced.
    Replace,
    /// It stays, and nothing is written.
    Keep,
}

/// A file that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {why}", path.display())]
pub struct Unwritten {
    /// Which.
    pub path: PathBuf,
    /// The system's reason.
    pub why: io::Error,
}

/// Writes several files, or none of them: all lie beside their places before the first is moved to its own.
///
/// # Errors
/// The first file that could not be written. Everything is then as it was, unless the system refuses one of the moves at
/// the very end; files moved before that one stay.
///
/// # Example
/// ```
/// use drystone::output::file::{Existing, write_whole};
/// let folder = tempfile::tempdir()?;
/// let files = ["a.svg", "b.svg"].map(|name| (folder.path().join(name), b"<svg/>".to_vec()));
/// write_whole(&files, Existing::Keep)?;
/// let refused = write_whole(&files, Existing::Keep).expect_err("both are there");
/// assert!(refused.to_string().contains("a.svg"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_whole(files: &[(PathBuf, Vec<u8>)], existing: Existing) -> Result<(), Unwritten> {
    let mut beside = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        let ready = prepare(path, bytes, existing).map_err(|why| Unwritten {
            path: path.clone(),
            why,
        })?;
        beside.push(ready);
    }
    for (ready, (path, _)) in beside.into_iter().zip(files) {
        let moved = match existing {
            Existing::Replace => ready.persist(path),
            Existing::Keep => ready.persist_noclobber(path),
        };
        moved.map_err(|error| Unwritten {
            path: path.clone(),
            why: error.error,
        })?;
    }
    Ok(())
}

/// The file's bytes beside its place.
fn prepare(path: &Path, bytes: &[u8], existing: Existing) -> io::Result<NamedTempFile> {
    if path.is_dir() {
        return Err(io::Error::new(
            io::ErrorKind::IsADirectory,
            "it is a folder",
        ));
    }
    if existing == Existing::Keep && path.exists() {
        return Err(io::Error::new(
            io::ErrorKind::AlreadyExists,
            "it is there already",
        ));
    }
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let mut file = builder().tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    Ok(file)
}

fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".drystone-").suffix(".part");
    // A temporary file is its owner's alone; ours is to have the rights that any new file of this user gets.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("picture.svg");
        for bytes in [b"first, and longer".to_vec(), b"second".to_vec()] {
            write_whole(&[(path.clone(), bytes.clone())], Existing::Replace).expect("written");
            assert_eq!(fs::read(&path).expect("there"), bytes);
        }
        assert_eq!(fs::read_dir(folder.path()).expect("listed").count(), 1);
    }

    #[test]
    fn one_bad_place_leaves_all_places_as_they_were() {
        let folder = tempfile::tempdir().expect("a folder");
        let good = folder.path().join("good.svg");
        fs::write(&good, "before").expect("writable");
        for bad in [
            folder.path().join("missing").join("bad.svg"),
            folder.path().to_owned(),
        ] {
            let files = [
                (good.clone(), b"after".to_vec()),
                (bad.clone(), b"after".to_vec()),
            ];
            let refused = write_whole(&files, Existing::Replace).expect_err("no such place");
            assert_eq!(refused.path, bad);
            assert_eq!(fs::read(&good).expect("still there"), b"before");
            assert_eq!(
                fs::read_dir(folder.path()).expect("listed").count(),
                1,
                "nothing is left lying about"
            );
        }
    }
}
