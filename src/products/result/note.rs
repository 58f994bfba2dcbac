//! Notes of an analysis, as written in JSON.

use serde::Serialize;

use crate::mechanics::scene::Note;

#[derive(Serialize)]
pub(super) struct Entry<'a> {
    code: &'static str,
    path: &'a str,
    line: Option<usize>,
    message: &'a str,
    hint: &'a str,
}

impl<'a> Entry<'a> {
    pub(super) fn new(note: &'a Note) -> Entry<'a> {
        Entry {
            code: note.code.word(),
            path: &note.path,
            line: (note.line > 0).then_some(note.line),
            message: &note.message,
            hint: &note.hint,
        }
    }
}
