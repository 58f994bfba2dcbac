//! [`ResultFile`]: a file with the results of `drystone vary`. A later run with the same question reads the file, and adds
//! its new results at the end.
//!
//! The first line describes the question. Each further line is the result at one value, or at one pair of values. If a run
//! was stopped while it wrote a line, the next run removes this incomplete line.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;
use std::sync::Mutex;

use serde_json::{Value, json};

use crate::entry::cli::error::CliError;
use crate::mechanics::vary::{Found, State};
use crate::read::file;

/// What identifies a result: the bits of the values, whether the way of falling was asked for, and whether the number of the
/// result was asked for.
pub(super) type Key = (Vec<u64>, bool, bool);

/// Returns the key of the result at the values `at`.
pub(super) fn key(at: &[f64], has_words: bool, has_number: bool) -> Key {
    (at.iter().map(|value| value.to_bits()).collect(), has_words, has_number)
}

/// A file with results.
#[derive(Debug)]
pub(crate) struct ResultFile {
    known: BTreeMap<Key, Found>,
    file: Mutex<File>,
}

impl ResultFile {
    /// Opens the file, or creates it. `asked` describes the question: all that the results depend on.
    ///
    /// # Errors
    /// If the file belongs to another question, or cannot be read or written.
    pub(crate) fn open(path: &Path, asked: &str) -> Result<ResultFile, CliError> {
        let shown = path.display();
        let text = match path.exists() {
            true => file::text(path).map_err(|error| CliError::not_read(&shown, error))?,
            false => String::new(),
        };
        let mut lines = text.split_inclusive('\n');
        let head = json!({ "drystone_vary": env!("CARGO_PKG_VERSION"), "asked": asked }).to_string() + "\n";
        let mut kept = 0;
        match lines.next() {
            None => {}
            Some(first) if first == head => kept = first.len(),
            Some(_) => {
                return Err(CliError::CommandLine(format!(
                    "{shown} has results of another question, scene or version, or is another file; give a new file, or \
                     the same scene and numbers"
                )));
            }
        }
        let mut known = BTreeMap::new();
        for line in lines {
            let Some(entry) = line.strip_suffix('\n').and_then(read) else { break };
            kept += line.len();
            known.insert(entry.0, entry.1);
        }
        let unwritten = |error: std::io::Error| CliError::not_written(shown.to_string(), error);
        let options = OpenOptions::new().create(true).append(true).open(path);
        let mut file = options.map_err(unwritten)?;
        file.set_len(kept as u64).map_err(unwritten)?;
        if kept == 0 {
            file.write_all(head.as_bytes()).map_err(unwritten)?;
        }
        Ok(ResultFile { known, file: Mutex::new(file) })
    }

    pub(super) fn get(&self, key: &Key) -> Option<Found> {
        self.known.get(key).cloned()
    }

    /// Adds a result. If it cannot be written, the run goes on; a later run then computes the result again.
    pub(super) fn add(&self, at: &[f64], (_, has_words, has_number): &Key, found: &Found) {
        let value = match found.value {
            Some(value) if value.is_infinite() => json!("unbounded"),
            value => json!(value),
        };
        let state = found.state.word();
        let line = json!([at, has_words, has_number, state, value, found.words]).to_string() + "\n";
        if let Ok(mut file) = self.file.lock() {
            let _ = file.write_all(line.as_bytes());
        }
    }
}

/// Reads a line. `None` if it is no result.
fn read(line: &str) -> Option<(Key, Found)> {
    let entry: Value = serde_json::from_str(line).ok()?;
    let at: Option<Vec<f64>> = entry[0].as_array()?.iter().map(Value::as_f64).collect();
    let state = State::ALL.into_iter().find(|state| Some(state.word()) == entry[3].as_str())?;
    let value = if entry[4] == "unbounded" { Some(f64::INFINITY) } else { entry[4].as_f64() };
    let words = entry[5].as_str()?.to_owned();
    Some((key(&at?, entry[1].as_bool()?, entry[2].as_bool()?), Found { state, value, words }))
}
