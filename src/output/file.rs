//! [`write_whole`]: a file appears whole or not at all.

use std::io::{self, Write};
use std::path::Path;

/// Writes bytes to a file: beside it first, then renamed, so that nobody ever sees half of it.
///
/// # Errors
/// Those of the file system; the file is then as it was before.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path
        .parent()
        .filter(|p| !p.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let mut beside = tempfile::Builder::new()
        .prefix(".drystone-")
        .tempfile_in(folder)?;
    beside.write_all(bytes)?;
    beside.as_file().sync_all()?;
    readable(beside.as_file())?;
    beside.persist(path).map_err(|e| e.error)?;
    Ok(())
}

/// A temporary file is its owner's alone; what we write is for everybody whom the folder lets in.
#[cfg(unix)]
fn readable(file: &std::fs::File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn readable(_: &std::fs::File) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_whole_and_nothing_is_left_beside_it() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("picture.svg");
        write_whole(&path, b"first, and longer").expect("written");
        write_whole(&path, b"second").expect("written again");
        assert_eq!(std::fs::read(&path).expect("there"), b"second");
        assert_eq!(std::fs::read_dir(folder.path()).expect("listed").count(), 1);
        assert!(write_whole(&folder.path().join("no/such/folder.svg"), b"x").is_err());
    }
}
