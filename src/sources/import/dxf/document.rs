//! [`Document`]: the unit, the hidden layers, the blocks and the entities of a DXF file.

use std::collections::{BTreeMap, BTreeSet};

use super::record::{Record, integer};

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
