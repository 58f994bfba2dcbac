//! The placement tolerance of a frame, as written in JSON.

use serde::Serialize;

use super::{Motion, Number, Pair, arrow};
use crate::mechanics::analysis;
use crate::mechanics::scene::Scene;
use crate::text::Word;

#[derive(Serialize)]
pub(super) struct Placement<'a> {
    proved: Number,
    #[serde(skip_serializing_if = "Option::is_none")]
    falls_at: Option<Number>,
    limited_by: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    block: Option<&'a str>,
    pattern: Vec<Error<'a>>,
    mechanism: Vec<Motion<'a>>,
    blocks: Vec<Own<'a>>,
}

#[derive(Serialize)]
struct Error<'a> {
    block: &'a str,
    offset: Pair,
}

#[derive(Serialize)]
struct Own<'a> {
    block: &'a str,
    proved: Number,
}

impl<'a> Placement<'a> {
    pub(super) fn new(scene: &'a Scene, placement: &analysis::Placement) -> Placement<'a> {
        let name = |block: crate::mechanics::scene::BlockId| scene.blocks[block.0].id.as_str();
        let pattern = placement.pattern.iter();
        let blocks = placement.blocks.iter();
        Placement {
            proved: Number(placement.proved),
            falls_at: placement.falls_at.map(Number),
            limited_by: placement.limited_by.word(),
            joint: placement.joint,
            block: placement.block.map(name),
            pattern: pattern.map(|error| Error { block: name(error.block), offset: arrow(error.offset) }).collect(),
            mechanism: placement.mechanism.iter().map(|motion| Motion::new(scene, motion)).collect(),
            blocks: blocks.map(|own| Own { block: name(own.block), proved: Number(own.proved) }).collect(),
        }
    }
}
