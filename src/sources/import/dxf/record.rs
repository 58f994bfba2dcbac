//! [`records`] splits the text of a DXF file into records, and [`Document`] finds the unit, the hidden layers, the blocks
//! and the entities in them.
//!
//! A DXF file is a list of groups: a line with a code, and a line with a value. A group with code 0 begins a record;
//! the groups up to the next code 0 belong to it.

use std::collections::{BTreeMap, BTreeSet};

use crate::sources::import::limit::MAX_BODIES;

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
    /// Returns a record with some of the groups.
    pub(super) fn part(&self, groups: &[(i32, &'t str)]) -> Record<'t> {
        Record { groups: groups.to_vec(), ..*self }
    }

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

/// The sections of a DXF file.
#[derive(Debug, Default)]
pub(super) struct Document<'r> {
    /// The header variable `$INSUNITS`; 0 if it is absent.
    pub(super) unit: i64,
    /// The layers that are off or frozen.
    pub(super) hidden_layers: BTreeSet<&'r str>,
    /// The blocks by name.
    pub(super) blocks: BTreeMap<&'r str, Block<'r>>,
    /// The entities outside of blocks.
    pub(super) entities: &'r [Record<'r>],
}

/// The definition of a block, to which INSERT entities refer.
#[derive(Debug)]
pub(super) struct Block<'r> {
    /// The record `BLOCK` with the base point.
    pub(super) head: &'r Record<'r>,
    pub(super) entities: &'r [Record<'r>],
}

impl<'r> Document<'r> {
    /// Finds the header, the layers, the blocks and the entities in the records of a file.
    ///
    /// # Errors
    /// Returns a message if the file has no section `ENTITIES`.
    pub(super) fn new(records: &'r [Record<'r>]) -> Result<Document<'r>, String> {
        let mut document = Document::default();
        let mut has_entities = false;
        let mut i = 0;
        while i < records.len() {
            let end = end_of(records, i, "ENDSEC");
            let inner = &records[(i + 1).min(end)..end];
            match (records[i].kind, records[i].text(2)) {
                ("SECTION", Some("HEADER")) => document.unit = unit(&records[i]),
                ("SECTION", Some("TABLES")) => {
                    document.hidden_layers =
                        inner.iter().filter(|r| r.kind == "LAYER" && is_hidden(r)).filter_map(|r| r.text(2)).collect();
                }
                ("SECTION", Some("BLOCKS")) => document.blocks = blocks(inner),
                ("SECTION", Some("ENTITIES")) => {
                    document.entities = inner;
                    has_entities = true;
                }
                _ => {}
            }
            i = match records[i].kind {
                "SECTION" => end + 1,
                _ => i + 1,
            };
        }
        if has_entities { Ok(document) } else { Err("it has no section ENTITIES, so it is not a DXF drawing".into()) }
    }
}

/// Returns the index of the first record of this kind at or after `start`, or the number of records if there is none.
fn end_of(records: &[Record<'_>], start: usize, kind: &str) -> usize {
    let rest = records[start..].iter().position(|r| r.kind == kind);
    rest.map_or(records.len(), |offset| start + offset)
}

/// Reads the variable `$INSUNITS` of a header: its name has code 9, and its value, with code 70, follows. 0 if it is
/// absent.
fn unit(header: &Record<'_>) -> i64 {
    let mut groups = header.groups.iter();
    groups
        .find(|(code, value)| *code == 9 && *value == "$INSUNITS")
        .and_then(|_| groups.next())
        .map_or(0, |(_, value)| integer(value))
}

/// True if a layer is off (it has a negative colour) or frozen.
fn is_hidden(layer: &Record<'_>) -> bool {
    layer.integer(62) < 0 || layer.has_flag(70, 1)
}

fn blocks<'r>(records: &'r [Record<'r>]) -> BTreeMap<&'r str, Block<'r>> {
    let mut blocks = BTreeMap::new();
    for (i, head) in records.iter().enumerate() {
        let (true, Some(name)) = (head.kind == "BLOCK", head.text(2)) else {
            continue;
        };
        let end = end_of(records, i, "ENDBLK");
        let entities = &records[i + 1..end];
        blocks.insert(name, Block { head, entities });
    }
    blocks
}
