//! Messages about outlines and cells that are not valid, and about bodies that overlap.

use std::fmt;

use super::{Code, Wording, digits, new_wording, pair, point};
use crate::geometry::Point;
use crate::mechanics::scene::format::UnitsEntry;

/// A side of an outline or of a hole, given by the indices of its two corners.
pub(in crate::mechanics::scene) struct Side {
    /// The index of the hole to which the side belongs; `None` if it belongs to the outline.
    pub(in crate::mechanics::scene) hole: Option<usize>,
    /// The indices of its two corners, from 0.
    pub(in crate::mechanics::scene) corners: [usize; 2],
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the side from corner {} to corner {}", self.corners[0], self.corners[1])?;
        self.hole.map_or(Ok(()), |hole| write!(f, " of hole {hole}"))
    }
}

pub(in crate::mechanics::scene) fn too_few_corners(found: usize) -> Wording {
    let corners = match found {
        0 => "no corners".into(),
        1 => "only 1 corner".into(),
        _ => format!("only {found} different corners"),
    };
    new_wording(Code::TooFewCorners, format!("the outline has {corners}"), "give at least three corners")
}

pub(in crate::mechanics::scene) fn zero_area() -> Wording {
    new_wording(Code::ZeroArea, "the outline encloses no area", "give corners that do not all lie on one line")
}

pub(in crate::mechanics::scene) fn crossing(a: &Side, b: &Side, at: Point) -> Wording {
    new_wording(
        Code::CrossingOutline,
        format!("{a} meets {b} at {}", point(at)),
        "list the corners in order around the outline, so that no sides cross or touch; corners are counted from 0",
    )
}

pub(in crate::mechanics::scene) fn hole_outside() -> Wording {
    new_wording(
        Code::HoleOutside,
        "the hole does not lie inside the outline, or lies inside another hole",
        "move the hole, or make it a separate block",
    )
}

pub(in crate::mechanics::scene) fn no_outline() -> Wording {
    new_wording(
        Code::NoOutline,
        "the body has no `polygon`, no `cells`, no `circle` and no `shape`",
        "give `polygon`, `cells`, `circle` or `shape`",
    )
}

pub(in crate::mechanics::scene) fn centre_without_mass() -> Wording {
    new_wording(
        Code::MissingKey,
        "the block has a `centre`, but no `mass` and no `weight`",
        "give `mass` or `weight`; a density is not enough without an outline",
    )
}

pub(in crate::mechanics::scene) fn no_shape_outline() -> Wording {
    new_wording(
        Code::NoOutline,
        "the shape has no `polygon`, no `cells` and no `circle`",
        "give `polygon`, `cells` or `circle`",
    )
}

pub(in crate::mechanics::scene) fn no_radius(radius: f64) -> Wording {
    new_wording(Code::ZeroArea, format!("the radius is {}", digits(radius)), "give a radius of more than 0")
}

pub(in crate::mechanics::scene) fn two_outlines(first: &str, second: &str) -> Wording {
    new_wording(
        Code::TwoOutlines,
        format!("the keys `{first}` and `{second}` are both given"),
        "give only one of the two keys",
    )
}

pub(in crate::mechanics::scene) fn crowded(count: usize, most: usize, at: Point) -> Wording {
    let pairs = count * (count - 1) / 2;
    new_wording(
        Code::TooManyTips,
        format!(
            "corners of {count} bodies meet at {}, which makes {pairs} corner contacts; corners of at most {most} \
             bodies may meet at one point, where each polygon of the ground counts as a body",
            point(at)
        ),
        "remove `corner_contacts`, or cut the tips off, so that the bodies touch along edges",
    )
}

pub(in crate::mechanics::scene) fn crowded_everywhere(pairs: usize, most: usize) -> Wording {
    new_wording(
        Code::TooManyTips,
        format!("{pairs} pairs of corners meet in one frame; at most {most} corner contacts are allowed"),
        "remove `corner_contacts`, or cut the tips off, so that the bodies touch along edges",
    )
}

pub(in crate::mechanics::scene) fn holes_alone() -> Wording {
    new_wording(
        Code::HolesWithoutPolygon,
        "`holes` need a `polygon`",
        "give the outline as `polygon`, or remove `holes`; in a body of cells, leave out cells to make a hole",
    )
}

pub(in crate::mechanics::scene) fn cells_without_grid() -> Wording {
    new_wording(
        Code::NeedsGrid,
        "cells need a grid",
        "add `\"grid\": { \"kind\": \"triangular\", \"side\": 1 }` to the scene, or give a polygon",
    )
}

pub(in crate::mechanics::scene) fn shape_without_grid(name: &str) -> Wording {
    new_wording(
        Code::NeedsGrid,
        format!("the built-in shape `{name}` needs a triangular grid"),
        "add `\"grid\": { \"kind\": \"triangular\", \"side\": 1 }` to the scene, or describe a shape of your own in `shapes`",
    )
}

pub(in crate::mechanics::scene) fn no_cells() -> Wording {
    new_wording(Code::NoOutline, "the list of cells is empty", "give at least one cell")
}

pub(in crate::mechanics::scene) fn square_cell() -> Wording {
    new_wording(
        Code::WrongCell,
        "a cell of the triangular grid needs \"up\" or \"down\"",
        "write [x, y, \"up\"] or [x, y, \"down\"]",
    )
}

pub(in crate::mechanics::scene) fn triangle_cell() -> Wording {
    new_wording(Code::WrongCell, "a cell of the square grid has no \"up\" or \"down\"", "write [x, y]")
}

pub(in crate::mechanics::scene) fn cell_twice(first: usize) -> Wording {
    new_wording(
        Code::DuplicateCell,
        format!("the cell is listed twice; first as number {first}, counting from 0"),
        "remove one of the two cells",
    )
}

pub(in crate::mechanics::scene) fn cells_apart() -> Wording {
    new_wording(
        Code::CellsApart,
        "the cells are not all connected by common edges",
        "make each connected part a separate block",
    )
}

pub(in crate::mechanics::scene) fn not_whole(p: [f64; 2]) -> Wording {
    new_wording(
        Code::OffLattice,
        format!("{} is not a lattice point", pair(p)),
        "cells need whole numbers as coordinates; a polygon may have any coordinates",
    )
}

pub(in crate::mechanics::scene) fn beyond_lattice(p: [f64; 2], reach: f64) -> Wording {
    new_wording(
        Code::TooLarge,
        format!("{} exceeds the limit of ±{} lattice steps", pair(p), digits(reach)),
        "move the scene towards the origin",
    )
}

pub(in crate::mechanics::scene) fn angle_off_lattice(angle: f64, turn: f64) -> Wording {
    new_wording(
        Code::OffLattice,
        format!("a rotation by {}° does not fit the lattice", digits(angle)),
        format!("give a multiple of {}°, or use a polygon", digits(turn)),
    )
}

/// The overlap of two bodies.
pub(in crate::mechanics::scene) struct Common {
    /// The depth of the overlap, in the units of the file: the distance by which one body must move to leave the other.
    pub(in crate::mechanics::scene) depth: f64,
    /// The common area, in the squared unit of length of the file.
    pub(in crate::mechanics::scene) area: f64,
    /// The centroid of the common area, in the units of the file.
    pub(in crate::mechanics::scene) at: Point,
    /// Whether the overlap is so small that the bodies were probably meant to touch.
    pub(in crate::mechanics::scene) may_be_meant: bool,
    /// Whether depth and area are only lower bounds.
    pub(in crate::mechanics::scene) at_least: bool,
}

pub(in crate::mechanics::scene) fn overlap(
    a: &str,
    b: &str,
    common: &Common,
    frame: Option<&str>,
    units: UnitsEntry,
) -> Wording {
    let unit = units.length().symbol();
    let when = frame.map_or(String::new(), |f| format!(" in {f}"));
    let Common { depth, area, at, .. } = common;
    let least = if common.at_least { "at least " } else { "" };
    let help = "move the bodies apart until they only touch".to_owned();
    // Round the depth up, so that the suggested tolerance is sufficient.
    let enough = format!("{:.1e}", 1.06 * depth);
    new_wording(
        Code::Overlap,
        format!(
            "{a} and {b} overlap by {least}{} {unit}, with a common area of {least}{} {unit}², around {}{when}",
            digits(*depth),
            digits(*area),
            point(*at)
        ),
        if common.may_be_meant {
            format!("{help}, or give \"contact_tolerance\": {enough} if the bodies are meant to touch")
        } else {
            help
        },
    )
}

pub(in crate::mechanics::scene) fn too_close(count: usize, most: usize, bodies: usize) -> Wording {
    new_wording(
        Code::TooManyPairs,
        format!(
            "{count} pairs of its {bodies} bodies lie so close together that they may touch; at most {most} are allowed"
        ),
        "join the parts of the ground that lie at one place, remove blocks that are listed several times, or divide \
         the scene",
    )
}

pub(in crate::mechanics::scene) fn more_overlaps(listed: usize) -> Wording {
    new_wording(
        Code::MoreProblems,
        format!("there are more overlaps than the {listed} in this list"),
        "correct the listed overlaps first",
    )
}
