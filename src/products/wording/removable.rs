//! Describes which blocks of a frame may leave.

use super::failure::shortened;
use super::number::{counted, listed, quantity};
use crate::mechanics::analysis::{Removable, Verdict};
use crate::mechanics::scene::Scene;

/// At most this many blocks are named.
const MAX_NAMED: usize = 8;

/// Says which blocks may leave, what helps the others, and which robots a falling frame needs: phrases without a full
/// stop.
pub fn phrases(scene: &Scene, rows: &[Removable]) -> Vec<String> {
    let name = |block: crate::mechanics::scene::BlockId| scene.blocks[block.0].id.as_str();
    let force = |newtons: f64| quantity(newtons, scene.units.force());
    let free = rows.iter().filter(|row| row.rest == Verdict::Stable);
    let free: Vec<String> = free.map(|row| name(row.block).to_owned()).collect();
    let mut phrases = vec![match free.len() {
        0 => "no block may leave".to_owned(),
        n => {
            let of = counted(rows.len(), "block");
            format!("{n} of {of} may leave alone: {}", listed(&shortened(free, MAX_NAMED)))
        }
    }];
    let helped = rows.iter().filter_map(|row| Some((row.block, row.help?)));
    if let Some((block, help)) = helped.clone().min_by(|a, b| a.1.force.total_cmp(&b.1.force)) {
        phrases.push(format!(
            "{} may leave while a robot holds another one: the least help is {} on {} for {}",
            counted(helped.count(), "block"),
            force(help.force),
            name(help.block),
            name(block)
        ));
    }
    let held = rows.iter().filter(|row| row.force.is_some_and(|f| f > 0.0));
    let held = held.map(|row| format!("{} on {}", row.force.map(force).unwrap_or_default(), name(row.block)));
    let held: Vec<String> = held.collect();
    if !held.is_empty() {
        phrases.push(format!("it stands with a robot's force of at least {}", shortened(held, MAX_NAMED).join(" or ")));
    }
    phrases
}
