//! Messages about names, numbers, keys and steps of a scene, and the messages of notes, which point out input that is
//! allowed but probably not intended.

use super::{Code, Wording, digits, new_wording, pair, point};
use crate::geometry::Point;
use crate::mechanics::scene::format::{BlockSide, UnitsEntry};
use crate::text::{nearest, shortened};

pub(in crate::mechanics::scene) fn unknown_name(sort: &str, name: &str, known: &[&str]) -> Wording {
    let help = match nearest(name, known.iter().copied()) {
        Some(near) => format!("the nearest known {sort} is `{near}`"),
        None if known.is_empty() => format!("the scene has no {sort}s"),
        None if known.len() <= 12 => {
            format!("known {sort}s are {}", known.iter().map(|n| shortened(n)).collect::<Vec<_>>().join(", "))
        }
        None => format!("the scene has {} {sort}s, but none with a similar name", known.len()),
    };
    new_wording(Code::UnknownName, format!("unknown {sort} `{}`", shortened(name)), help)
}

pub(in crate::mechanics::scene) fn another_unknown_name(sort: &str, name: &str) -> Wording {
    new_wording(
        Code::UnknownName,
        format!("unknown {sort} `{}`", shortened(name)),
        format!("the first problem with an unknown {sort} lists the known names or the nearest one"),
    )
}

pub(in crate::mechanics::scene) fn id_twice(sort: &str, id: &str, first: &str) -> Wording {
    new_wording(
        Code::DuplicateId,
        format!("the {sort} id `{}` is used twice; first by {first}", shortened(id)),
        format!("give each {sort} a different id"),
    )
}

pub(in crate::mechanics::scene) fn reserved_id(sort: &str) -> Wording {
    new_wording(
        Code::ReservedName,
        "the id `ground` is reserved for the ground in results",
        format!("give the {sort} another id"),
    )
}

pub(in crate::mechanics::scene) fn empty_id(sort: &str) -> Wording {
    new_wording(Code::EmptyId, format!("the {sort}'s id is empty"), "write an id of at least one character")
}

pub(in crate::mechanics::scene) fn no_movement() -> Wording {
    new_wording(Code::OutOfRange, "the movement is zero", "give a `translation` [x, y] or a `rotation` in degrees")
}

pub(in crate::mechanics::scene) fn no_axles() -> Wording {
    new_wording(Code::OutOfRange, "the vehicle has no axle", "give each axle a `weight` and an `offset`")
}

pub(in crate::mechanics::scene) fn built_in_shape(name: &str) -> Wording {
    new_wording(Code::ReservedName, format!("`{name}` is the name of a built-in shape"), "give the shape another name")
}

pub(in crate::mechanics::scene) fn pair_twice(names: &[String; 2], first: usize) -> Wording {
    new_wording(
        Code::DuplicatePair,
        format!(
            "the pair {}, {} is listed twice; first in friction_pairs[{first}]",
            shortened(&names[0]),
            shortened(&names[1])
        ),
        "remove one of the two entries; the order of the names does not matter",
    )
}

pub(in crate::mechanics::scene) fn version(found: i64) -> Wording {
    new_wording(
        Code::UnknownVersion,
        format!("version {found} of the scene format is not known"),
        "write `\"drystone\": 1`",
    )
}

pub(in crate::mechanics::scene) fn not_finite(x: f64) -> Wording {
    new_wording(Code::NotFinite, format!("the number is {x}"), "give a finite number")
}

pub(in crate::mechanics::scene) fn absurd(x: f64, largest: f64, units: UnitsEntry) -> Wording {
    new_wording(
        Code::TooLarge,
        format!("the number {} exceeds the limit of ±{}", digits(x), digits(largest)),
        check_units(units),
    )
}

/// Returns the remedy for a number that is too large or too small: it asks the author to check the units.
fn check_units(units: UnitsEntry) -> String {
    format!(
        "check the units: {}, kilograms, {}",
        units.length.unwrap_or_default().name(),
        units.force.unwrap_or_default().name()
    )
}

pub(in crate::mechanics::scene) fn tiny(x: f64, smallest: f64, units: UnitsEntry) -> Wording {
    new_wording(
        Code::TooSmall,
        format!("the number {} is too close to 0: its size must be 0 or at least {}", digits(x), digits(smallest)),
        format!("write 0, or {}", check_units(units)),
    )
}

pub(in crate::mechanics::scene) fn tiny_extent(extent: f64, smallest: f64, units: UnitsEntry) -> Wording {
    let unit = units.length().symbol();
    new_wording(
        Code::TooSmall,
        format!("the extent is {} {unit}, which is less than the limit of {} {unit}", digits(extent), digits(smallest)),
        format!("check the units: lengths are in {}", units.length.unwrap_or_default().name()),
    )
}

pub(in crate::mechanics::scene) fn negative(what: &str, x: f64) -> Wording {
    new_wording(Code::Negative, format!("negative {what} {}", digits(x)), format!("`{what}` must be at least 0"))
}

pub(in crate::mechanics::scene) fn kernel(x: f64) -> Wording {
    new_wording(
        Code::OutOfRange,
        format!("the kernel {} is not between 0 and 1", digits(x)),
        "give the fraction of each contact that must stay free of force: 0 for none, 0.2 for a fifth",
    )
}

pub(in crate::mechanics::scene) fn side(x: f64) -> Wording {
    new_wording(
        Code::OutOfRange,
        format!("the edge length of the grid cells is {}, but it must be more than 0", digits(x)),
        "give the edge length of a cell, more than 0",
    )
}

pub(in crate::mechanics::scene) fn too_heavy(weight: f64, largest: f64) -> Wording {
    new_wording(
        Code::TooLarge,
        format!("the block's weight would be {} N, more than the limit of {} N", digits(weight), digits(largest)),
        "check the units of density, thickness, gravity and polygon",
    )
}

pub(in crate::mechanics::scene) fn colour(text: &str) -> Wording {
    new_wording(
        Code::NoColour,
        format!("\"{}\" is not a colour", shortened(text)),
        "write a colour as \"#8b6b3d\" or \"#863\"",
    )
}

/// Returns the message about a key that occurs twice in an object built in code.
pub(in crate::mechanics::scene) fn key_twice(key: &str) -> Wording {
    new_wording(Code::DuplicateKey, format!("the key `{}` occurs twice", shortened(key)), "remove one of the two keys")
}

pub(in crate::mechanics::scene) fn contact_of_one() -> Wording {
    new_wording(
        Code::UnknownChoice,
        "both bodies of the contact are the same body",
        "name two different bodies; `ground` is the ground",
    )
}

pub(in crate::mechanics::scene) fn too_many_steps(steps: usize, most: usize) -> Wording {
    new_wording(
        Code::TooManySteps,
        format!("there are {steps} steps, and at most {most} are allowed"),
        "use fewer steps, or split the scene into several scenes",
    )
}

pub(in crate::mechanics::scene) fn too_many_blocks(blocks: usize, most: usize) -> Wording {
    new_wording(
        Code::TooManySteps,
        format!("there are {blocks} blocks, and at most {most} are allowed"),
        "use fewer blocks, or split the scene into several scenes",
    )
}

pub(in crate::mechanics::scene) fn too_many_corners(corners: usize, most: usize) -> Wording {
    new_wording(
        Code::TooManyCorners,
        format!("the shapes of all bodies have {corners} corners in total, and at most {most} are allowed"),
        "use shapes with fewer corners, or split the scene into several scenes",
    )
}

pub(in crate::mechanics::scene) fn load_without_block() -> Wording {
    new_wording(Code::MissingKey, "the key `block` is missing", "give the name of the loaded block")
}

pub(in crate::mechanics::scene) fn no_pressure() -> Wording {
    new_wording(
        Code::MissingKey,
        "the key `pressure` is missing",
        "`side` and `between` say where a `pressure` acts; a `force` acts at a point, which `at` gives",
    )
}

pub(in crate::mechanics::scene) fn pressure_without_place(points: usize) -> Wording {
    let found = match points {
        0 => "the pressure has no place".to_owned(),
        points => format!("the list `between` needs 2 points, and its length is {points}"),
    };
    new_wording(
        Code::MissingKey,
        found,
        "give `block` and `side`, such as \"left\", or `between`, with two points [x, y] of the free outline",
    )
}

pub(in crate::mechanics::scene) fn friction_angle(degrees: f64) -> Wording {
    new_wording(
        Code::OutOfRange,
        format!("the angle of friction is {} degrees", digits(degrees)),
        "give an angle from -90 to 90 degrees; a positive angle drags the blocks down",
    )
}

pub(in crate::mechanics::scene) fn no_such_side(block: &str, side: BlockSide) -> Wording {
    let word = match side {
        BlockSide::Left => "left",
        BlockSide::Right => "right",
        BlockSide::Top => "top",
        BlockSide::Bottom => "bottom",
    };
    new_wording(
        Code::NoEdge,
        format!("block `{}` has no side `{word}`: no outward normal is within 45° of this direction", shortened(block)),
        "give another side, or two points of the outline as `between`",
    )
}

pub(in crate::mechanics::scene) fn not_on_free_edges(outside: Option<(usize, Option<Point>)>) -> Wording {
    let (message, help) = match outside {
        Some((number, nearest)) => {
            let which = if number == 0 { "first" } else { "second" };
            let near = nearest.map_or(String::new(), |at| format!("; the nearest such point is {}", point(at)));
            (
                format!("the {which} point of `between` does not lie on an edge of a block that touches no other body"),
                format!("give a point of the free outline of the blocks{near}"),
            )
        }
        None => (
            "no free outline connects the two points of `between`: other bodies interrupt it".to_owned(),
            "give two points of one free outline, or one pressure for each part of it".to_owned(),
        ),
    };
    new_wording(Code::NoEdge, message, help)
}

pub(in crate::mechanics::scene) fn too_many_pressed(most: usize) -> Wording {
    new_wording(
        Code::TooManyCorners,
        format!("the pressures act on more than {most} edges in total"),
        "use fewer pressures, or outlines with fewer corners",
    )
}

pub(in crate::mechanics::scene) fn too_many_placed(most: usize) -> Wording {
    new_wording(
        Code::TooManySteps,
        format!("the frames of all steps and load cases contain more than {most} blocks and grips in total"),
        "use fewer steps or cases, or split the scene into several scenes",
    )
}

pub(in crate::mechanics::scene) fn too_many_case_loads([loads, cases]: [usize; 2], most: usize) -> Wording {
    new_wording(
        Code::TooManySteps,
        format!(
            "{loads} loads in {cases} load cases are {} loads, and at most {most} are allowed",
            loads.saturating_mul(cases)
        ),
        "use fewer loads or cases, or split the scene into several scenes",
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

/// Creates the wording of a note. A wording needs a problem code, but this code is never shown, because notes have
/// codes of their own.
fn note(message: String, hint: impl Into<String>) -> Wording {
    new_wording(Code::OutOfRange, message, hint)
}

pub(in crate::mechanics::scene) fn friction_high(mu: f64) -> Wording {
    note(
        format!("a friction coefficient of {} is probably a mistake", digits(mu)),
        "dry stone has 0.5 to 0.8; a coefficient is the tangent of the angle of friction, not degrees or percent",
    )
}

pub(in crate::mechanics::scene) fn grip_outside(block: &str, at: [f64; 2], distance: f64, unit: &str) -> Wording {
    note(
        format!(
            "the grip point {} lies {} {unit} outside the block `{}`",
            pair(at),
            digits(distance),
            shortened(block)
        ),
        "give a point inside the block, or leave out `at` to use the centroid of the block",
    )
}

pub(in crate::mechanics::scene) fn load_outside(block: &str, at: [f64; 2], distance: f64, unit: &str) -> Wording {
    note(
        format!("the load acts at {}, {} {unit} outside the block `{}`", pair(at), digits(distance), shortened(block)),
        "give a point inside the block, or leave out `at` to use the centroid of the block",
    )
}

pub(in crate::mechanics::scene) fn unused_robot(robot: &str, no_steps: bool) -> Wording {
    let hint = if no_steps {
        "give the robot a block that it `holds`, or remove the robot"
    } else {
        "let the robot `hold` a block in a step, or remove the robot; in a scene with `steps`, `holds` is ignored"
    };
    note(format!("the robot `{}` never holds a block", shortened(robot)), hint)
}

pub(in crate::mechanics::scene) fn unused_block(block: &str) -> Wording {
    note(
        format!("no step places the block `{}`", shortened(block)),
        "add the block to `place` of a step, or remove the block",
    )
}

pub(in crate::mechanics::scene) fn default_density(blocks: usize, beside: Option<&str>, force: &str) -> Wording {
    let weight = match blocks {
        1 => "the weight of 1 block comes".to_owned(),
        _ => format!("the weights of {blocks} blocks come"),
    };
    let beside = beside.map_or(String::new(), |beside| format!(", but the {beside} are in {force}"));
    note(
        format!("{weight} from the default density of 1 kg/m³{beside}"),
        format!("give `density` in kg/m³ (stone has about 2500), or `weight` in {force}"),
    )
}

pub(in crate::mechanics::scene) fn no_ground() -> Wording {
    note(
        "the scene has no ground, so only robots can support the blocks".into(),
        "add at least one polygon to `ground`",
    )
}

pub(in crate::mechanics::scene) fn no_blocks() -> Wording {
    note("the scene has no blocks, so nothing can fall".into(), "add at least one block to `blocks`")
}

pub(in crate::mechanics::scene) fn no_weight() -> Wording {
    note(
        "all blocks weigh nothing, and there are no loads, so nothing can fall".into(),
        "give `density`, `mass` or `weight`, and a `gravity` that is not 0",
    )
}

pub(in crate::mechanics::scene) fn implausible_size(metres: f64) -> Wording {
    note(
        format!("a typical block is {} m large, which is probably a mistake", digits(metres)),
        "lengths are in metres; give `units` such as { \"length\": \"mm\" } if they are not",
    )
}

pub(in crate::mechanics::scene) fn implausible_density(density: f64) -> Wording {
    note(
        format!("the density {} kg/m³ is probably a mistake", digits(density)),
        "densities are in kg/m³, whatever the units of the scene: stone has 1800 to 3000, brick 1600 to 2000, wood 400 to 900",
    )
}

pub(in crate::mechanics::scene) fn implausible_unit_weight(given: f64, newtons: f64, unit: &str) -> Wording {
    let factor = newtons / given;
    note(
        format!("the unit weight {} {unit}/m³ is probably a mistake", digits(given)),
        format!(
            "give the weight of a cubic metre in {unit}: water has {} {unit}/m³ (9810 N/m³, 62.4 lbf/ft³), earth {} to {}",
            digits((9810.0 / factor * 1e4).round() / 1e4),
            digits((16_000.0 / factor * 1e4).round() / 1e4),
            digits((22_000.0 / factor * 1e4).round() / 1e4),
        ),
    )
}

pub(in crate::mechanics::scene) fn below_ground() -> Wording {
    note(
        "no block lies above the ground".into(),
        "y points up; if the coordinates come from a picture, in which y points down, change the signs of all y",
    )
}

pub(in crate::mechanics::scene) fn angle_radians(angle: f64, degrees: f64) -> Wording {
    note(
        format!("the angle {} looks like {}° written in radians", digits(angle), digits(degrees)),
        format!("angles are in degrees: give {}", digits(degrees)),
    )
}
