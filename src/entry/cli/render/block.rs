//! Finds the blocks that the command line names.

use super::Render;
use crate::scene::{BlockId, Scene};
use crate::text::nearest;

impl Render {
    /// Returns the last frame in which the block of the free-body diagram is placed, and the block.
    pub(super) fn cut_free(&self, scene: &Scene) -> Result<(usize, BlockId), String> {
        let placed = |id: BlockId| scene.frames.iter().rposition(|f| f.placed.contains(&id));
        let Some(name) = &self.block else {
            return match (scene.blocks.as_slice(), placed(BlockId(0))) {
                ([_], Some(frame)) => Ok((frame, BlockId(0))),
                _ => {
                    let ids: Vec<&str> = scene.blocks.iter().map(|b| b.id.as_str()).collect();
                    let more = if ids.len() > 12 { ", …" } else { "" };
                    Err(format!(
                        "a free-body diagram is of one block; choose with --block one of {}{more}",
                        ids[..ids.len().min(12)].join(", ")
                    ))
                }
            };
        };
        let block = self.found(scene, name)?;
        match placed(block) {
            Some(frame) => Ok((frame, block)),
            None => Err(format!("block {name} is not placed in these frames")),
        }
    }

    /// Finds the block with a name.
    pub(super) fn found(&self, scene: &Scene, name: &str) -> Result<BlockId, String> {
        let number = scene.blocks.iter().position(|b| b.id == name);
        number.map(BlockId).ok_or_else(|| {
            let known = scene.blocks.iter().map(|b| b.id.as_str());
            let near = nearest(name, known)
                .map_or_else(String::new, |near| format!("; did you mean {near}?"));
            format!("it has no block {name}{near}")
        })
    }
}
