//! What reaches the target of a margin, as written in JSON.

use serde::Serialize;

use super::{Motion, Number};
use crate::mechanics::analysis::{Change, Reached, Verdict};
use crate::mechanics::scene::Scene;
use crate::text::Word;

#[derive(Serialize)]
pub(super) struct Reach<'a> {
    margin: &'static str,
    target: Number,
    stands: Option<bool>,
    changes: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Row<'a> {
    change: &'static str,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    blocks: Vec<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    amount: Option<Number>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    mechanism: Vec<Motion<'a>>,
}

impl<'a> Reach<'a> {
    pub(super) fn new(scene: &'a Scene, found: &Reached) -> Reach<'a> {
        let row = |change: &Change| Row {
            change: change.what.word(),
            blocks: change.blocks.iter().map(|block| scene.blocks[block.0].id.as_str()).collect(),
            amount: change.least.map(Number),
            mechanism: change.mechanism.iter().map(|m| Motion::new(scene, m)).collect(),
        };
        Reach {
            margin: found.target.kind.word(),
            target: Number(found.target.value),
            stands: (found.verdict != Verdict::Undecided).then_some(found.verdict == Verdict::Stable),
            changes: found.changes.iter().map(row).collect(),
        }
    }
}
