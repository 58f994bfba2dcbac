//! Which blocks of a frame may leave, as written in JSON.

use serde::Serialize;

use super::Number;
use crate::mechanics::analysis::{self, Verdict};
use crate::mechanics::scene::{BlockId, Scene};

#[derive(Serialize)]
pub(super) struct Removable<'a> {
    block: &'a str,
    stands: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    force: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<Help<'a>>,
}

#[derive(Serialize)]
struct Help<'a> {
    block: &'a str,
    force: Number,
}

impl<'a> Removable<'a> {
    pub(super) fn list(scene: &'a Scene, rows: &[analysis::Removable]) -> Vec<Removable<'a>> {
        let name = |block: BlockId| scene.blocks[block.0].id.as_str();
        let rows = rows.iter().map(|row| Removable {
            block: name(row.block),
            stands: (row.rest != Verdict::Undecided).then_some(row.rest == Verdict::Stable),
            force: row.force.map(Number),
            help: row.help.map(|help| Help { block: name(help.block), force: Number(help.force) }),
        });
        rows.collect()
    }
}
