//! Describes the single changes with which a margin reaches a target.

use super::failure::shortened;
use super::number::{digits, listed, quantity, three_up};
use crate::mechanics::analysis::{Change, ChangeKind, MarginKind, Reached, Verdict};
use crate::mechanics::scene::{BlockId, Scene};

/// At most this many blocks of a motion are named.
const MAX_NAMED: usize = 4;

/// Says with which changes the target is reached: one line for each, without a full stop.
pub fn lines(scene: &Scene, found: &Reached) -> Vec<String> {
    let value = digits(found.target.value);
    let target = match found.target.kind {
        MarginKind::Tilt => format!("a tilt of {value}° to both sides"),
        MarginKind::HorizontalLoad => format!("a horizontal load of {value} of the weights to both sides"),
        _ => format!("{value} times its loads"),
    };
    let (enough, not): (Vec<&Change>, _) = found.changes.iter().partition(|change| change.least.is_some());
    let head = match found.verdict {
        Verdict::Stable => format!("it stands with {target} without a change"),
        Verdict::Undecided => format!("it is undecided whether it stands with {target}"),
        Verdict::Unstable if enough.is_empty() => format!("no single change suffices for {target}"),
        Verdict::Unstable => format!("for {target}, each of these changes suffices alone:"),
    };
    let rows = enough.into_iter().chain(not).map(|change| row(scene, change));
    [format!("reach: {head}")].into_iter().chain(rows.map(|row| format!("  {row}"))).collect()
}

fn row(scene: &Scene, change: &Change) -> String {
    let name = |block: &BlockId| scene.blocks[block.0].id.clone();
    let blocks = listed(&change.blocks.iter().map(name).collect::<Vec<_>>());
    let Some(least) = change.least else {
        let what = match change.what {
            ChangeKind::Friction => "friction",
            ChangeKind::Thickness => "thickness",
            ChangeKind::Weight => "weight on one block",
            ChangeKind::Hold => "force on one block",
            ChangeKind::Tie => "tie between two blocks",
            ChangeKind::Prop => "prop between two blocks",
        };
        let moving = shortened(change.mechanism.iter().map(|motion| name(&motion.block)).collect(), MAX_NAMED);
        let verb = if change.mechanism.len() == 1 { "moves" } else { "move" };
        let why = if moving.is_empty() { String::new() } else { format!(": {} {verb} all the same", listed(&moving)) };
        return format!("no {what} suffices{why}");
    };
    let unit = scene.units.force();
    let force = match unit.is_chosen {
        true => format!("{} {}", three_up(unit.value_from_si(least)), unit.symbol()),
        false => quantity(least, unit),
    };
    match change.what {
        ChangeKind::Friction => format!("friction {} at all joints", three_up(least)),
        ChangeKind::Thickness => format!("{} times the thickness", three_up(least)),
        ChangeKind::Weight => format!("{force} more weight on {blocks}"),
        ChangeKind::Hold => format!("a force of {force} from outside that holds {blocks}"),
        ChangeKind::Tie => format!("a tie of {force} between {blocks}"),
        ChangeKind::Prop => format!("a prop of {force} between {blocks}"),
    }
}
