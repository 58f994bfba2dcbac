//! Describes in words which forces can act on a block without a collapse.

use super::margin;
use super::number::{place_beyond, quantity};
use crate::mechanics::analysis::{CapacityShape, Cases, FALLS, LoadCapacity, MarginKind, STANDS, Verdict};
use crate::mechanics::scene::Scene;
use crate::text;

/// Describes a load capacity in one clause or two, which a semicolon may join: where the force acts, and how large it may be in each direction. `verdict` is
/// the verdict of the frame.
///
/// The capacity is computed with the contacts as the scene gives them. If the verdict is undecided, it may depend on
/// whether bodies with a narrow gap touch. The true capacity may then differ, so the text begins with `with the
/// contacts as drawn`.
pub fn clauses(scene: &Scene, verdict: Verdict, capacity: &LoadCapacity) -> Vec<String> {
    let mut clauses = forces(scene, capacity);
    if verdict == Verdict::Undecided {
        clauses[0].insert_str(0, "with the contacts as drawn, ");
    }
    clauses
}

/// Describes where the force acts, and how large it may be in each direction.
fn forces(scene: &Scene, capacity: &LoadCapacity) -> Vec<String> {
    let place = place(scene, capacity);
    let for_all = for_all(&capacity.ranges);
    let clause = match (capacity.shape(), sides(scene, capacity)) {
        (CapacityShape::Empty, _) if capacity.cases == 1 => {
            format!("it {FALLS} under any force {place}")
        }
        (CapacityShape::Empty, _) => format!("no force {place} keeps it standing{for_all}"),
        (CapacityShape::Everything, _) => format!("every force {place} is carried{for_all}"),
        (_, Some(sides)) => format!("{place} it carries {sides}{for_all}"),
        (shape, None) => {
            let some = match shape {
                CapacityShape::Point => "",
                _ => " in some combinations",
            };
            let ranges = ranges(scene, capacity);
            let [without, with] = match capacity.cases {
                1 => [format!("without a force {place} it {FALLS}"), format!("it {STANDS} with")],
                _ => [format!("without a force {place} it does not stand{for_all}"), "it does with".to_owned()],
            };
            return vec![without, format!("{with} {ranges}{some}")];
        }
    };
    vec![clause]
}

/// Describes where the force acts: at a point of a block, between two points, or as the force of a robot. Example:
/// `at (1, 2) m on block a`.
pub fn place(scene: &Scene, capacity: &LoadCapacity) -> String {
    // A coordinate that is only a rounding error relative to the block's size is written as 0.
    let bounds = scene.blocks[capacity.block.0].body.polygon.bounds();
    let point = |k: usize| place_beyond(capacity.at[k], scene.units, 1e-9 * bounds.diagonal());
    let block = text::line(&scene.blocks[capacity.block.0].id);
    match (capacity.robot, capacity.at.len()) {
        (Some(robot), _) => {
            let robot = text::line(&scene.robots[robot.0].id);
            format!("of robot {robot} on block {block}")
        }
        (None, 1) => format!("at {} on block {block}", point(0)),
        _ => format!("between {} and {} on block {block}", point(0), point(1)),
    }
}

/// Writes the ranges in which the forces are carried: ` for every tilt from 2° left to 2° right`. The text is empty
/// without ranges.
fn for_all(ranges: &Cases) -> String {
    let parts = [
        (MarginKind::Tilt, "tilt", ranges.tilt),
        (MarginKind::HorizontalLoad, "horizontal load", ranges.horizontal_load),
        (MarginKind::Friction, "friction coefficient", ranges.friction),
    ];
    let range = |(kind, name, range): (MarginKind, &str, Option<[f64; 2]>)| {
        let [low, high] = range?.map(|value| margin::value(kind, value));
        Some(if low == high { format!("{name} of {low}") } else { format!("{name} from {low} to {high}") })
    };
    let parts: Vec<String> = parts.into_iter().filter_map(range).collect();
    if parts.is_empty() { String::new() } else { format!(" for every {}", parts.join(" and ")) }
}

/// The four directions that a sentence names, as unit vectors.
const NAMED_DIRECTIONS: [([f64; 2], &str); 4] =
    [([-1.0, 0.0], "to the left"), ([1.0, 0.0], "to the right"), ([0.0, 1.0], "up"), ([0.0, -1.0], "down")];

/// Lists the largest force to the left, to the right, up and down: `at most 2 N to the left, …, and any force down`.
/// Returns `None` if the frame falls without this force.
pub fn sides(scene: &Scene, capacity: &LoadCapacity) -> Option<String> {
    let (mut limited, mut unlimited) = (Vec::new(), Vec::new());
    for (direction, word) in NAMED_DIRECTIONS {
        let most = capacity.reach(direction)?;
        if most.is_finite() {
            let most = quantity(rounded(most, capacity), scene.units.force());
            limited.push(format!("{most} {word}"));
        } else {
            unlimited.push(word);
        }
    }
    let limited = (!limited.is_empty()).then(|| format!("at most {}", limited.join(", ")));
    let unlimited = match &unlimited[..] {
        [] => None,
        [only] => Some(format!("any force {only}")),
        [most @ .., last] => Some(format!("any force {} or {last}", most.join(", "))),
    };
    let parts: Vec<String> = limited.into_iter().chain(unlimited).collect();
    Some(parts.join(", and "))
}

/// Writes the ranges of the horizontal and the vertical component of the force: `Fx from −3 N to 2 N and Fy of at
/// least 4 N`.
pub fn ranges(scene: &Scene, capacity: &LoadCapacity) -> String {
    let range = |name: &str, direction: [f64; 2]| {
        let most = capacity.most(direction).map(|v| rounded(v, capacity));
        let least = capacity.most(direction.map(|v| -v)).map(|v| rounded(-v, capacity));
        let newtons = |v: f64| quantity(v, scene.units.force());
        match (least, most) {
            (None, None) => format!("any {name}"),
            (Some(least), None) => format!("{name} of at least {}", newtons(least)),
            (None, Some(most)) => format!("{name} of at most {}", newtons(most)),
            (Some(least), Some(most)) if newtons(least) == newtons(most) => {
                format!("{name} of {}", newtons(most))
            }
            (Some(least), Some(most)) => {
                format!("{name} from {} to {}", newtons(least), newtons(most))
            }
        }
    };
    format!("{} and {}", range("Fx", [1.0, 0.0]), range("Fy", [0.0, 1.0]))
}

/// Returns `force`, or 0 if it is so small relative to the largest force of the capacity that it may be a rounding
/// error.
fn rounded(force: f64, capacity: &LoadCapacity) -> f64 {
    let sizes = capacity.vertices.iter().map(|v| v.force.norm());
    let largest = sizes.chain(capacity.edges.iter().map(|e| e.limit.abs()));
    if force.abs() <= 1e-7 * largest.fold(0.0, f64::max) { 0.0 } else { force }
}
