//! Bounding boxes of outlines, for finding outlines that are drawn twice.

use crate::geometry::{Bounds, Point};
use crate::sources::import::draft::{Part, PartGeometry};
use crate::sources::import::subpath::Subpath;

/// Two outlines coincide if their boxes differ by at most this share of their size.
const COINCIDENCE_TOL: f64 = 1e-6;

/// Returns the bounding box of a curve, in which an arc counts as its whole ellipse. Returns `None` if a coordinate is
/// not finite.
pub(super) fn around(curve: &Subpath) -> Option<Bounds> {
    let hull = curve.hull();
    let is_finite = hull.iter().all(|p: &Point| p.x.is_finite() && p.y.is_finite());
    if is_finite { Bounds::from_points(hull) } else { None }
}

/// Returns the bounding box of a part; `None` for a point, or if no curve has finite coordinates.
pub(super) fn part_box(part: &Part) -> Option<Bounds> {
    match &part.form {
        PartGeometry::Subpaths(curves, _) => curves.iter().filter_map(around).reduce(Bounds::union),
        PartGeometry::Point(_) => None,
    }
}

/// True if the box `own` coincides with one of `boxes`, within a millionth of the diagonal of `own`. `boxes` must be
/// sorted by `min.x`.
pub(super) fn coincides(own: Bounds, boxes: &[Bounds]) -> bool {
    let tolerance = COINCIDENCE_TOL * own.diagonal();
    let first = boxes.partition_point(|b| b.min.x < own.min.x - tolerance);
    boxes[first..]
        .iter()
        .take_while(|b| b.min.x <= own.min.x + tolerance)
        .any(|b| (b.min - own.min).norm() <= tolerance && (b.max - own.max).norm() <= tolerance)
}
