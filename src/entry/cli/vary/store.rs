//! [`Store`]: the results of `drystone vary`, one JSON line each, from which a later run goes on.
//!
//! The first line says what was asked. Each other line has the values, what was found there, the number of the result, and
//! words. A line that a stopped run left incomplete is ignored.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::Path;
use std::sync::Mutex;

use serde_json::{Value, json};

use crate::entry::cli::error::CliError;
use crate::mechanics::vary::{Found, State};
use crate::read::file;

/// The values as bits, whether words are wanted, and whether the number of the result is.
pub(super) type Key = (Vec<u64>, bool, bool);

/// Returns the key of a result.
pub(super) fn key(at: &[f64], has_words: bool, has_number: bool) -> Key {
    (at.iter().map(|value| value.to_bits()).collect(), has_words, has_number)
}

/// Results that are kept in a file.
#[derive(Debug)]
pub(crate) struct Store {
    known: BTreeMap<Key, Found>,
    file: Mutex<File>,
}

impl Store {
    /// Opens a file, or begins it. `asked` has all on which the results depend.
    ///
    /// # Errors
    /// If the file has the results of another question, or cannot be read or written.
    pub(crate) fn open(path: &Path, asked: &str) -> Result<Store, CliError> {
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
        Ok(Store { known, file: Mutex::new(file) })
    }

    pub(super) fn get(&self, key: &Key) -> Option<Found> {
        self.known.get(key).cloned()
    }

    /// Adds a result. If it cannot be written, a later run finds it again.
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

/// Reads a line.
fn read(line: &str) -> Option<(Key, Found)> {
    let entry: Value = serde_json::from_str(line).ok()?;
    let at: Option<Vec<f64>> = entry[0].as_array()?.iter().map(Value::as_f64).collect();
    let state = State::ALL.into_iter().find(|state| Some(state.word()) == entry[3].as_str())?;
    let value = if entry[4] == "unbounded" { Some(f64::INFINITY) } else { entry[4].as_f64() };
    let words = entry[5].as_str()?.to_owned();
    Some((key(&at?, entry[1].as_bool()?, entry[2].as_bool()?), Found { state, value, words }))
}
