//! [`Records`]: reads the scene files of a batch, one scene at a time, without parsing them.

use std::fmt;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::ByteSize;
use crate::read::file;

/// The longest record in bytes. Without a limit, a line that never ends would fill the memory.
const MAX_RECORD_BYTES: usize = file::MAX_BYTES as usize;

/// The text of one scene, not parsed yet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    /// The file of the scene, as given by the user; `None` for a stream without a file, such as standard input.
    pub file: Option<PathBuf>,
    /// The line of the scene, counted from 1; `None` if the file contains only this scene or could not be opened.
    pub line: Option<usize>,
    /// The bytes of the scene without the line ending, or the reason why they could not be read.
    pub bytes: Result<Vec<u8>, String>,
}

impl ByteSize for Record {
    fn byte_size(&self) -> usize {
        self.bytes.as_ref().map_or(0, Vec::len)
    }
}

/// A source of records.
pub enum Input {
    /// A file or stream with one scene on each line.
    Lines {
        /// The path of the file; `None` for a stream without a file, such as standard input.
        file: Option<PathBuf>,
        /// The open stream. If `None`, the file is opened when the earlier inputs have been read.
        reader: Option<Box<dyn Read + Send>>,
    },
    /// A file that contains one scene.
    Whole(PathBuf),
}

impl fmt::Debug for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Input::Lines { file, .. } => f.debug_tuple("Lines").field(file).finish(),
            Input::Whole(path) => f.debug_tuple("Whole").field(path).finish(),
        }
    }
}

impl Input {
    /// Creates an input from an open stream that contains one scene on each line.
    pub fn lines(file: Option<PathBuf>, reader: Box<dyn Read + Send>) -> Input {
        Input::Lines { file, reader: Some(reader) }
    }
}

/// An iterator over the records of several inputs. Every line is a record, except for blank lines, which are skipped but
/// counted. The last line needs no line ending.
#[derive(Debug)]
pub struct Records {
    inputs: std::vec::IntoIter<Input>,
    open: Option<Open>,
    read: Arc<AtomicU64>,
}

struct Open {
    file: Option<PathBuf>,
    reader: BufReader<Box<dyn Read + Send>>,
    line: usize,
}

impl fmt::Debug for Open {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Open").field("file", &self.file).finish()
    }
}

impl Records {
    /// Creates an iterator over the scenes of the inputs, in order.
    pub fn new(inputs: Vec<Input>) -> Records {
        Records { inputs: inputs.into_iter(), open: None, read: Arc::new(AtomicU64::new(0)) }
    }

    /// Returns a shared counter of the bytes that were read so far, for showing progress.
    pub fn read(&self) -> Arc<AtomicU64> {
        Arc::clone(&self.read)
    }

    fn add(&self, bytes: usize) {
        self.read.fetch_add(bytes as u64, Ordering::Relaxed);
    }

    fn whole(&self, path: PathBuf) -> Record {
        let bytes = file::bytes(&path).map_err(|error| unreadable(&error));
        self.add(bytes.as_ref().map_or(0, Vec::len));
        Record { file: Some(path), line: None, bytes }
    }
}

impl Iterator for Records {
    type Item = Record;

    fn next(&mut self) -> Option<Record> {
        loop {
            if let Some(open) = &mut self.open {
                let number = open.line + 1;
                let (size, bytes) = next_line(&mut open.reader);
                if size > 0 || bytes.is_err() {
                    open.line = number;
                    if bytes.as_ref().is_ok_and(|bytes| bytes.iter().all(u8::is_ascii_whitespace)) {
                        self.read.fetch_add(size as u64, Ordering::Relaxed);
                        continue;
                    }
                    let record = Record { file: open.file.clone(), line: Some(number), bytes };
                    // Stop reading this stream if it cannot be read: it could return the same error forever.
                    if size == 0 {
                        self.open = None;
                    }
                    self.add(size);
                    return Some(record);
                }
                self.open = None;
            }
            match self.inputs.next()? {
                Input::Whole(path) => return Some(self.whole(path)),
                Input::Lines { file, reader } => {
                    let opened = match (reader, &file) {
                        (Some(reader), _) => Ok(reader),
                        (None, Some(path)) => File::open(path).map(|f| Box::new(f) as Box<dyn Read + Send>),
                        (None, None) => continue,
                    };
                    match opened {
                        Ok(reader) => {
                            self.open = Some(Open { file, reader: BufReader::with_capacity(1 << 16, reader), line: 0 });
                        }
                        Err(error) => {
                            return Some(Record { file, line: None, bytes: Err(unreadable(&error)) });
                        }
                    }
                }
            }
        }
    }
}

/// Reads a line. Returns its size in bytes, including the line ending, and its text without the line ending. The size
/// is 0 at the end of the stream and if the stream cannot be read. The text is an error if the stream cannot be read or
/// the line is too long.
fn next_line(reader: &mut impl BufRead) -> (usize, Result<Vec<u8>, String>) {
    let mut line = Vec::new();
    let (mut size, mut has_end) = (0, false);
    loop {
        let found = match reader.fill_buf() {
            Ok(found) => found,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(error) => return (0, Err(unreadable(&error))),
        };
        if found.is_empty() {
            break;
        }
        let end = found.iter().position(|b| *b == b'\n');
        let piece = &found[..end.unwrap_or(found.len())];
        // If a line is too long, read up to its end, but do not store the rest.
        if size + piece.len() <= MAX_RECORD_BYTES {
            line.extend_from_slice(piece);
        }
        let used = piece.len() + usize::from(end.is_some());
        size += used;
        reader.consume(used);
        if end.is_some() {
            has_end = true;
            break;
        }
    }
    if size - usize::from(has_end) > MAX_RECORD_BYTES {
        return (size, Err(unreadable(&file::too_large(size as u64))));
    }
    if line.last() == Some(&b'\r') {
        line.pop();
    }
    (size, Ok(line))
}

fn unreadable(error: &io::Error) -> String {
    format!("it cannot be read: {error}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `size` times `x`, a line ending, and one more line.
    fn endless(size: usize) -> impl Read {
        io::repeat(b'x').take(size as u64).chain(&b"\nafter\n"[..])
    }

    #[test]
    fn a_line_that_is_too_long_is_reported_and_the_next_is_read() {
        let input = Input::lines(None, Box::new(endless(MAX_RECORD_BYTES + 5)));
        let records: Vec<Record> = Records::new(vec![input]).collect();
        assert_eq!(records.len(), 2);
        assert!(records[0].bytes.as_ref().is_err_and(|why| why.contains("64000006 bytes or more are too many")));
        assert_eq!(records[1].bytes, Ok(b"after".to_vec()));
    }

    #[test]
    fn records_do_not_contain_line_endings() {
        let input = Input::lines(None, Box::new(&b"a\r\n\nb"[..]));
        let bytes: Vec<_> = Records::new(vec![input]).map(|r| r.bytes).collect();
        assert_eq!(bytes, [Ok(b"a".to_vec()), Ok(b"b".to_vec())], "blank lines are skipped");
    }

    #[test]
    fn a_missing_file_becomes_a_record_with_an_error() {
        let missing = PathBuf::from("no/such/file.json");
        let inputs = vec![
            Input::Whole(missing.clone()),
            Input::Lines { file: Some(missing.clone()), reader: None },
            Input::lines(None, Box::new(&b"a"[..])),
        ];
        let records: Vec<Record> = Records::new(inputs).collect();
        assert_eq!(records.len(), 3);
        assert!(records[0].bytes.is_err() && records[1].bytes.is_err());
        assert_eq!(records[1].file, Some(missing));
        assert_eq!(records[2].line, Some(1));
    }
}
