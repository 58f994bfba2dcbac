//! Messages about steps of the assembly that cannot be executed.

use super::{Code, Wording, new_wording};
use crate::text::shortened;

pub(in crate::mechanics::scene) fn too_many(steps: usize, most: usize) -> Wording {
    new_wording(
        Code::TooManySteps,
        format!("the frames of {steps} steps contain more than {most} blocks in total"),
        "use fewer steps, or split the scene into several scenes",
    )
}

pub(in crate::mechanics::scene) fn placed_twice(block: &str, since: usize, now: usize) -> Wording {
    let when = if since == now { "earlier in this step".into() } else { format!("by steps[{since}]") };
    new_wording(
        Code::PlacedTwice,
        format!("the block `{}` is already placed, {when}", shortened(block)),
        "place each block only once; to place a block again, `remove` it first",
    )
}

pub(in crate::mechanics::scene) fn removed_unplaced(block: &str) -> Wording {
    new_wording(
        Code::NotPlaced,
        format!("the block `{}` is removed, but it is not placed", shortened(block)),
        "remove only blocks that an earlier step placed",
    )
}

pub(in crate::mechanics::scene) fn removed_held(block: &str, robot: &str) -> Wording {
    new_wording(
        Code::RemovedWhileHeld,
        format!("the block `{}` is removed while the robot `{}` holds it", shortened(block), shortened(robot)),
        format!("add \"{}\" to `release` of this step or of an earlier step", shortened(robot)),
    )
}

pub(in crate::mechanics::scene) fn held_unplaced(robot: &str, block: &str) -> Wording {
    new_wording(
        Code::NotPlaced,
        format!("the robot `{}` holds the block `{}`, which is not placed", shortened(robot), shortened(block)),
        format!("add \"{}\" to `place` of this step or of an earlier step", shortened(block)),
    )
}

pub(in crate::mechanics::scene) fn holds_two(robot: &str, held: &str, block: &str) -> Wording {
    let (robot, held, block) = (shortened(robot), shortened(held), shortened(block));
    new_wording(
        Code::HoldsTwo,
        format!("the robot `{robot}` takes hold of the block `{block}` while it still holds `{held}`"),
        format!("a robot can hold only one block; add \"{robot}\" to `release` of this step first"),
    )
}

pub(in crate::mechanics::scene) fn planned_placed(robot: &str, block: &str) -> Wording {
    new_wording(
        Code::PlacedTwice,
        format!(
            "`plan` says that the robot `{}` will place the block `{}`, which is already placed",
            shortened(robot),
            shortened(block)
        ),
        "plan only blocks that are not placed",
    )
}
