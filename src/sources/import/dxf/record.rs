//! [`records`]: splits the text of a DXF file into records.
//!
//! A DXF file is a list of groups: a line with a code, and a line with a value. A group with code 0 begins a record;
//! the groups up to the next code 0 belong to it.

use super::super::limit::MAX_BODIES;

/// The largest number of records in a file.
const MAX_RECORDS: usize = 100 * MAX_BODIES;

/// A record: an entity, a row of a table, or the beginning or end of a section.
#[derive(Debug)]
pub(super) struct Record<'t> {
    /// The value of code 0, such as `LINE` or `SECTION`.
    pub(super) kind: &'t str,
    /// The line of the file in which `kind` is, counted from 1.
    pub(super) line: usize,
    /// The other groups in the order of the file.
    pub(super) groups: Vec<(i32, &'t str)>,
}

/// Splits the text of a file into records. Comments (code 999) are left out.
///
/// # Errors
/// Returns a message if the file is binary, is not complete, does not begin with a record, has too many records, or has
/// a line without a number where a group code must be.
pub(super) fn records(text: &str) -> Result<Vec<Record<'_>>, String> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.starts_with("AutoCAD Binary DXF") {
        return Err("it is a binary DXF file; save it as DXF in text form (ASCII)".into());
    }
    let mut records: Vec<Record<'_>> = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((number, code)) = lines.next() {
        let code = code.trim();
        if code.is_empty() {
            // Some programs end the file with an empty line.
            if text.lines().skip(number).all(|line| line.trim().is_empty()) {
                break;
            }
        }
        let Ok(code) = code.parse::<i32>() else {
            return Err(format!(
                "line {} is not a DXF group code but `{}`; save the drawing as DXF in text form",
                number + 1,
                crate::text::heading(code, 40)
            ));
        };
        let Some((line, value)) = lines.next() else {
            return Err(format!("the file ends after the group code in line {}; it is not complete", number + 1));
        };
        let value = value.trim();
        match (code, records.last_mut()) {
            (0, _) => records.push(Record { kind: value, line: line + 1, groups: Vec::new() }),
            (999, _) => {}
            (code, Some(record)) => record.groups.push((code, value)),
            (_, None) => {
                return Err("it does not begin with a section; it is not a DXF file".into());
            }
        }
        if records.len() > MAX_RECORDS {
            return Err(format!("it has more than {MAX_RECORDS} entities"));
        }
    }
    Ok(records)
}

impl<'t> Record<'t> {
    /// Returns the value of the first group with this code; `None` if there is none.
    pub(super) fn text(&self, code: i32) -> Option<&'t str> {
        let group = self.groups.iter().find(|(c, _)| *c == code)?;
        Some(group.1)
    }

    /// Returns the value of the first group with this code as a number; `None` if there is none. A value that is not a
    /// number becomes NaN, so that the entity is reported.
    pub(super) fn number(&self, code: i32) -> Option<f64> {
        self.text(code).map(number)
    }

    /// Returns the value of the first group with this code as a whole number; 0 if there is none, or if it is not a
    /// whole number.
    pub(super) fn integer(&self, code: i32) -> i64 {
        self.text(code).map_or(0, integer)
    }

    /// True if the value with this code has at least one of `bits` set.
    pub(super) fn has_flag(&self, code: i32, bits: i64) -> bool {
        self.integer(code) & bits != 0
    }
}

/// Parses a number; NaN if the text is not a number.
pub(super) fn number(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

/// Parses a whole number; 0 if the text is not a whole number.
pub(super) fn integer(text: &str) -> i64 {
    text.parse().unwrap_or(0)
}
