//! [`bytes`] and [`text`]: read a whole file that may come from a stranger, up to a limit. [`open`] refuses what is no
//! file. [`ending`]: the extension of its name.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The largest size of a file in bytes. Reading lists of very short numbers takes about 70 times the size in memory.
pub const MAX_BYTES: u64 = 64_000_000;

/// What is wrong with a pipe or a device in place of a file.
pub const NO_FILE: &str =
    "it is a pipe, a device or a folder; write it to a file first, or name it - on standard input";

/// Opens a file. A pipe is not opened: it may never have an end, or not even a beginning.
pub fn open(path: &Path) -> io::Result<File> {
    if std::fs::metadata(path)?.is_file() {
        File::open(path)
    } else {
        Err(io::Error::new(io::ErrorKind::InvalidInput, NO_FILE))
    }
}

/// Reads a file. If it is too large, it is not read, and the error says its size, the limit and what to do.
pub fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let file = open(path)?;
    match file.metadata()?.len() {
        size if size > MAX_BYTES => Err(too_large(size)),
        _ => all(file),
    }
}

/// Reads a text file in UTF-8, as [`bytes`] does.
pub fn text(path: &Path) -> io::Result<String> {
    let not_utf8 = |_| io::Error::new(io::ErrorKind::InvalidData, "it is not valid UTF-8; save it as UTF-8");
    String::from_utf8(bytes(path)?).map_err(not_utf8)
}

/// Returns the extension of a file name in lower case; empty if there is none.
pub fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Reads a stream to its end, but no more than the limit.
pub fn all(stream: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    match stream.take(MAX_BYTES + 1).read_to_end(&mut bytes)? as u64 {
        size if size > MAX_BYTES => Err(too_large(size)),
        _ => Ok(bytes),
    }
}

/// The error for a file, or for a line with one scene, of at least this number of bytes.
pub fn too_large(size: u64) -> io::Error {
    let words = format!("{size} bytes or more are too many, at most {MAX_BYTES} are read; split it into smaller files");
    io::Error::new(io::ErrorKind::FileTooLarge, words)
}
