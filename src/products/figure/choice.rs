//! Finds the block that the user names in an option of a figure, such as `--block`.

use crate::mechanics::scene::{BlockId, Scene};
use crate::text::{self, nearest};

/// Largest number of blocks that a message lists.
const MAX_LISTED_BLOCKS: usize = 12;

/// Finds the block for a free-body diagram by its name. The name may be left out if the scene has only one block. The
/// error is a message for the user.
pub(crate) fn free_block(scene: &Scene, name: Option<&str>) -> Result<BlockId, String> {
    let is_placed = |id: BlockId| scene.frames.iter().any(|frame| frame.placed.contains(&id));
    let Some(name) = name else {
        if scene.blocks.len() == 1 && is_placed(BlockId(0)) {
            return Ok(BlockId(0));
        }
        return Err(format!(
            "a free-body diagram shows one block; add --block with one of these names: {}",
            first_names(scene)
        ));
    };
    let block = named_block(scene, name)?;
    if is_placed(block) { Ok(block) } else { Err(format!("block {name} is not placed in any of the frames")) }
}

/// Finds the block with this name. If there is none, the error suggests a similar name or lists the blocks.
pub(crate) fn named_block(scene: &Scene, name: &str) -> Result<BlockId, String> {
    let number = scene.blocks.iter().position(|b| b.id == name);
    number.map(BlockId).ok_or_else(|| {
        let known = scene.blocks.iter().map(|b| b.id.as_str());
        let near = nearest(name, known).map_or_else(|| listed(scene), |near| format!("; did you mean {near}?"));
        format!("there is no block {name}{near}")
    })
}

/// Lists the blocks of a scene for an error message: `; the blocks are a, b, …`. At most [`MAX_LISTED_BLOCKS`] are
/// named.
fn listed(scene: &Scene) -> String {
    if scene.blocks.is_empty() {
        "; the scene has no blocks".into()
    } else {
        format!("; the blocks are {}", first_names(scene))
    }
}

fn first_names(scene: &Scene) -> String {
    let ids = scene.blocks.iter().map(|b| text::line(&b.id));
    let mut names: Vec<String> = ids.take(MAX_LISTED_BLOCKS).collect();
    if scene.blocks.len() > MAX_LISTED_BLOCKS {
        names.push("…".into());
    }
    names.join(", ")
}
