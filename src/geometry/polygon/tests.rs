//! Tests of edges, bounds, areas, centroids, inner points and positions of polygons, with results that follow from
//! the coordinates. The tests of errors are in `error`.

use super::*;

mod error;

fn points(corners: &[[f64; 2]]) -> Vec<Point> {
    corners.iter().map(|p| Point::new(p[0], p[1])).collect()
}

fn square(x: f64, y: f64, size: f64) -> [[f64; 2]; 4] {
    [[x, y], [x + size, y], [x + size, y + size], [x, y + size]]
}

fn made(rings: &[&[[f64; 2]]]) -> Result<Polygon, Vec<PolygonError>> {
    let mut rings = rings.iter().map(|ring| points(ring));
    let outline = rings.next().unwrap_or_default();
    Polygon::new(outline, rings.collect())
}

fn sound(rings: &[&[[f64; 2]]]) -> Polygon {
    made(rings).expect("a valid polygon")
}

#[test]
fn an_edge_has_its_material_on_the_left() {
    let edge = Edge { from: Point::new(1.0, 1.0), to: Point::new(4.0, 5.0) };
    assert_eq!((edge.vector(), edge.length()), (Vector::new(3.0, 4.0), 5.0));
    assert!((edge.outward() - Vector::new(0.8, -0.6)).norm() < 1e-15);
    let polygon = sound(&[&square(0.0, 0.0, 4.0), &square(1.0, 1.0, 2.0)]);
    assert_eq!(polygon.edges().count(), 8);
    for edge in polygon.edges() {
        let middle = edge.from + edge.vector() / 2.0;
        assert!(polygon.contains(middle - edge.outward() * 0.1));
        assert!(!polygon.contains(middle + edge.outward() * 0.1));
    }
}

#[test]
fn bounds_fit_the_points_exactly() {
    assert_eq!(Bounds::from_points([]), None);
    let found = Bounds::from_points(points(&[[4.0, -1.0], [1.0, 2.0], [3.0, 3.0]])).expect("bounds of three points");
    let wanted = Bounds { min: Point::new(1.0, -1.0), max: Point::new(4.0, 3.0) };
    assert_eq!(found, wanted);
    assert_eq!((found.width(), found.height(), found.diagonal()), (3.0, 4.0, 5.0));
    assert_eq!(sound(&[&[[4.0, -1.0], [1.0, 2.0], [3.0, 3.0]]]).bounds(), wanted);
    let grown = found.grown(0.5);
    assert_eq!((grown.min, grown.max), (Point::new(0.5, -1.5), Point::new(4.5, 3.5)));
    let other = Bounds { min: Point::new(2.0, -4.0), max: Point::new(7.0, 0.0) };
    let both = Bounds { min: Point::new(1.0, -4.0), max: Point::new(7.0, 3.0) };
    assert_eq!((found.union(other), other.union(found)), (both, both));
}

#[test]
fn bounds_intersect_if_they_share_a_point() {
    let own = Bounds { min: Point::new(0.0, 0.0), max: Point::new(2.0, 1.0) };
    let moved = |x: f64, y: f64| Bounds { min: own.min + Vector::new(x, y), max: own.max + Vector::new(x, y) };
    for (x, y) in [(0.0, 0.0), (2.0, 0.0), (-2.0, 0.0), (0.0, 1.0), (0.0, -1.0), (2.0, -1.0), (1.0, 0.5)] {
        assert!(own.intersects(moved(x, y)), "{x} {y}");
    }
    for (x, y) in [(2.1, 0.0), (-2.1, 0.0), (0.0, 1.1), (0.0, -1.1), (2.1, 1.1), (-2.1, 0.5)] {
        assert!(!own.intersects(moved(x, y)), "{x} {y}");
    }
}

#[test]
fn rings_are_reversed_so_that_the_material_is_on_their_left() {
    let (mut outline, mut hole) = (square(0.0, 0.0, 4.0), square(1.0, 1.0, 2.0));
    let wanted = sound(&[&outline, &hole]);
    assert_eq!(wanted.outline(), points(&outline));
    hole.reverse();
    assert_eq!(wanted.holes(), [points(&hole)]);
    outline.reverse();
    let found = sound(&[&outline, &hole]);
    assert_eq!((found.area(), found.holes()), (12.0, wanted.holes()));
    assert!(signed_area(found.outline()) > 0.0);
}

#[test]
fn areas_and_centroids_do_not_include_the_holes() {
    for (x, y) in [(0.0, 0.0), (-30.0, 50.0)] {
        // An area of 16 around (2, 2), minus a square of 0.25 around (3.25, 0.5), minus a triangle of 1.875 around
        // (1, 2).
        let moved = |ring: &[[f64; 2]]| ring.iter().map(|p| [p[0] + x, p[1] + y]).collect::<Vec<_>>();
        let triangle = [[0.5, 1.0], [2.0, 1.5], [0.5, 3.5]];
        let rings = [&square(0.0, 0.0, 4.0)[..], &square(3.0, 0.25, 0.5), &triangle].map(moved);
        let found = sound(&[&rings[0], &rings[1], &rings[2]]);
        let area = 16.0 - 0.25 - 1.875;
        assert!((found.area() - area).abs() < 1e-12);
        let moment = Vector::new(32.0, 32.0) - Vector::new(3.25, 0.5) * 0.25 - Vector::new(1.0, 2.0) * 1.875;
        let wanted = Point::from(moment / area) + Vector::new(x, y);
        assert!((found.centroid() - wanted).norm() < 1e-12, "{}", found.centroid());
    }
}

#[test]
fn only_points_in_the_material_are_inside() {
    // A comb with teeth at its top, and a hole. Some of the points are at the height of a corner.
    let comb =
        [[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [5.0, 2.0], [4.0, 4.0], [3.0, 2.0], [2.0, 4.0], [1.0, 2.0], [0.0, 4.0]];
    let found = sound(&[&comb, &square(2.5, 0.5, 1.0)]);
    for (x, y) in
        [(0.5, 2.0), (2.0, 2.0), (4.0, 2.0), (4.0, 3.9), (2.0, 3.0), (0.1, 3.0), (5.9, 3.0), (1.0, 1.0), (3.0, 1.6)]
    {
        assert!(found.contains(Point::new(x, y)), "{x} {y}");
    }
    for (x, y) in [
        (1.0, 3.0),
        (3.0, 3.0),
        (5.0, 2.1),
        (-1.0, 2.0),
        (7.0, 2.0),
        (-1.0, 4.0),
        (3.0, 1.0),
        (3.0, -1.0),
        (3.0, 4.0),
        (-1.0, 0.0),
    ] {
        assert!(!found.contains(Point::new(x, y)), "{x} {y}");
    }
}

#[test]
fn a_convex_outline_never_turns_right() {
    assert!(sound(&[&square(0.0, 0.0, 1.0)]).is_convex());
    let straight = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]];
    assert!(sound(&[&straight]).is_convex());
    assert!(!sound(&[&square(0.0, 0.0, 4.0), &square(1.0, 1.0, 1.0)]).is_convex());
    // A square with a dent. The list begins with each of the corners in turn.
    let mut dented = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]];
    for _ in 0..dented.len() {
        assert!(!sound(&[&dented]).is_convex());
        dented.rotate_left(1);
    }
}

#[test]
fn placing_rotates_about_the_origin_and_then_moves() {
    let polygon = sound(&[&[[1.0, 0.0], [3.0, 0.0], [1.0, 4.0]]]);
    let placed = polygon.clone().placed(90.0, Vector::new(10.0, 20.0));
    assert_eq!(placed.outline(), points(&[[10.0, 21.0], [10.0, 23.0], [6.0, 21.0]]));
    let third = polygon.clone().placed(30.0, Vector::zeros());
    let (sin, cos) = (0.5, 0.75_f64.sqrt());
    let wanted = points(&[[cos, sin], [3.0 * cos, 3.0 * sin], [cos - 4.0 * sin, sin + 4.0 * cos]]);
    for (found, wanted) in third.outline().iter().zip(wanted) {
        assert!((found - wanted).norm() < 1e-15);
    }
    for turns in [-2.0, 0.0, 1.0] {
        let exact = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
        for (k, wanted) in exact.into_iter().enumerate() {
            assert_eq!(sin_cos_degrees(90.0 * k as f64 + 360.0 * turns), wanted);
        }
    }
}

#[test]
fn a_hull_has_no_inner_corners_and_runs_anticlockwise() {
    let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]];
    let ring = convex_hull(points.map(|[x, y]| Point::new(x, y)).to_vec());
    let expected = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    assert_eq!(ring, expected.map(|[x, y]| Point::new(x, y)).to_vec());
}
