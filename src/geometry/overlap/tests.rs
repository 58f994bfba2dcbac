//! Tests of overlaps: areas, centroids and depths that follow from the coordinates.

use super::*;

fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Polygon {
    Polygon::new(vec![Point::new(x, y), Point::new(x + w, y), Point::new(x + w, y + h), Point::new(x, y + h)], vec![])
        .expect("a valid polygon")
}

#[test]
fn touching_is_not_overlapping_and_an_overlap_has_an_area_and_a_centroid() {
    let a = rectangle(0.0, 0.0, 2.0, 1.0);
    let a = ConvexPieces::new(&a);
    assert_eq!(overlap(&a, &ConvexPieces::new(&rectangle(2.0, 0.0, 1.0, 1.0)), 0.0), None);
    assert_eq!(overlap(&a, &ConvexPieces::new(&rectangle(2.0 - 1e-7, 0.0, 1.0, 1.0)), 1e-6), None);
    let found = overlap(&a, &ConvexPieces::new(&rectangle(1.5, 0.75, 3.0, 1.0)), 1e-6).expect("overlap");
    assert!((found.area - 0.125).abs() < 1e-12);
    assert!((found.at - Point::new(1.75, 0.875)).norm() < 1e-12);
    assert!((found.depth - 0.25).abs() < 1e-12);
}

#[test]
fn a_block_in_the_hole_of_another_does_not_overlap_it() {
    let corners =
        |x: f64, w: f64| vec![Point::new(x, x), Point::new(x + w, x), Point::new(x + w, x + w), Point::new(x, x + w)];
    let frame = Polygon::new(corners(0.0, 4.0), vec![corners(1.0, 2.0)]).expect("a valid polygon");
    let pieces = ConvexPieces::new(&frame);
    assert_eq!(overlap(&pieces, &ConvexPieces::new(&rectangle(1.0, 1.0, 2.0, 1.0)), 1e-9), None);
    let stuck = overlap(&pieces, &ConvexPieces::new(&rectangle(1.0, 1.0, 2.5, 1.0)), 1e-9).expect("overlap");
    assert!((stuck.area - 0.5).abs() < 1e-12);
}

fn polygon(corners: &[[f64; 2]]) -> Polygon {
    let corners = corners.iter().map(|p| Point::new(p[0], p[1])).collect();
    Polygon::new(corners, vec![]).expect("a valid polygon")
}

/// The overlap of two polygons. Checks that it is the same in either order.
fn both(a: &Polygon, b: &Polygon) -> Overlap {
    let (a, b) = (&ConvexPieces::new(a), &ConvexPieces::new(b));
    let found = overlap(a, b, 1e-9).expect("overlap");
    let other = overlap(b, a, 1e-9).expect("overlap");
    assert!((found.area - other.area).abs() < 1e-12);
    assert!((found.at - other.at).norm() < 1e-12);
    assert!((found.depth - other.depth).abs() < 1e-12);
    found
}

#[test]
fn the_area_and_the_centroid_of_an_overlap_include_all_pieces() {
    // An L and a square over its corner. They share a rectangle of 2 by ½ around (1½, ¾) and one of ½ by 1½ around
    // (¾, 1¾).
    for (x, y) in [(0.0, 0.0), (40.0, -70.0)] {
        let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let l = polygon(&corners.map(|p| [p[0] + x, p[1] + y]));
        let found = both(&l, &rectangle(0.5 + x, 0.5 + y, 2.0, 2.0));
        assert!((found.area - 1.75).abs() < 1e-12);
        let wanted = Point::new(x + (1.5 + 0.5625) / 1.75, y + (0.75 + 1.3125) / 1.75);
        assert!((found.at - wanted).norm() < 1e-12, "{}", found.at);
    }
    // A square whose four corners are cut off by a diamond.
    let diamond = polygon(&[[1.5, 0.0], [0.0, 1.5], [-1.5, 0.0], [0.0, -1.5]]);
    let found = both(&diamond, &rectangle(-1.0, -1.0, 2.0, 2.0));
    assert!((found.area - 3.5).abs() < 1e-12 && found.at.coords.norm() < 1e-12);
}

#[test]
fn the_depth_is_the_shortest_distance_that_separates_the_bodies() {
    let slab = rectangle(0.0, 0.0, 4.0, 4.0);
    for (x, y, depth) in [(1.0, 1.0, 2.0), (2.5, 1.0, 1.5), (-0.75, 2.0, 0.25), (3.5, 3.75, 0.25)] {
        let found = both(&slab, &rectangle(x, y, 1.0, 1.0));
        assert!((found.depth - depth).abs() < 1e-12, "{x} {y}: {}", found.depth);
    }
    // The tip of a triangle penetrates the top of the slab by ¼. A box penetrates the hypotenuse of a triangle with
    // legs of 3 and 4 by ¼.
    let tip = polygon(&[[2.0, 3.75], [3.0, 9.0], [1.0, 9.0]]);
    assert!((both(&slab, &tip).depth - 0.25).abs() < 1e-12);
    let slope = polygon(&[[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]);
    let box_at = |d: f64| rectangle(1.5 - 0.8 * d, 2.0 - 0.6 * d, 5.0, 5.0);
    assert!((both(&slope, &box_at(0.25)).depth - 0.25).abs() < 1e-12);
    let deep = |a: &Polygon, b: &Polygon, gap: f64| overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), gap);
    assert_eq!(deep(&slope, &box_at(-1e-6), 0.0), None);
    // An overlap that is exactly as deep as the gap is not reported.
    let stone = rectangle(1.0, 3.75, 1.0, 1.0);
    assert_eq!(deep(&slab, &stone, 0.25), None);
    assert!(deep(&slab, &stone, 0.2499).is_some());
}

/// 2⁵⁰ metres.
const FAR: f64 = 1_125_899_906_842_624.0;

#[test]
fn the_pieces_cover_the_polygon_exactly_once() {
    let ring = |x: f64, size: f64| rectangle(x, x, size, size).outline().to_vec();
    let frame = Polygon::new(ring(-3.0, 9.0), vec![ring(0.0, 1.0), ring(2.0, 3.0)]);
    let frame = frame.expect("a valid polygon");
    let mut area = 0.0;
    for piece in ConvexPieces::new(&frame).pieces() {
        let t = &piece.corners;
        let bounds = Bounds::from_points(t.iter().copied());
        assert_eq!((t.len(), bounds), (3, Some(piece.bounds)));
        let part = cross(t[1] - t[0], t[2] - t[0]) / 2.0;
        assert!(part > 0.0, "anticlockwise");
        let centre = t[0] + (t[1] - t[0] + (t[2] - t[0])) / 3.0;
        assert!(frame.contains(centre));
        area += part;
    }
    assert!((area - 71.0).abs() < 1e-12);
    // At this distance from the origin, only multiples of a quarter of a metre can be represented.
    let far = |p: [f64; 2]| p.map(|v| v / 4.0 + FAR);
    let corners = [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
    let l = polygon(&corners.map(far));
    let pieces = ConvexPieces::new(&l);
    let parts = pieces.pieces().iter().map(|piece| {
        let t = &piece.corners;
        cross(t[1] - t[0], t[2] - t[0]) / 2.0
    });
    assert_eq!(parts.sum::<f64>(), 5.0 / 16.0);
    let square = rectangle(0.0, 0.0, 1.0, 1.0);
    let pieces = ConvexPieces::new(&square);
    let sizes: Vec<usize> = pieces.pieces().iter().map(|piece| piece.corners.len()).collect();
    assert_eq!(sizes, [4], "a convex body is one piece");
}

#[test]
fn bodies_that_only_touch_are_not_cut_into_pieces() {
    // A block with a notch stands on the ground. The bounds of the two share only a line, so the depth is 0.
    let notched = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 1.0], [0.0, 2.0]];
    let (notched, ground) = (polygon(&notched), rectangle(-9.0, -1.0, 18.0, 1.0));
    let (a, b) = (ConvexPieces::new(&notched), ConvexPieces::new(&ground));
    assert_eq!(overlap(&a, &b, 0.0), None);
    assert!(a.pieces.get().is_none() && b.pieces.get().is_none());
    // The bounds of the block above the notch overlap by half a metre, so the pieces are needed.
    let above = rectangle(1.5, 1.5, 1.0, 1.0);
    assert_eq!(overlap(&a, &ConvexPieces::new(&above), 1e-9), None);
    assert_eq!(a.pieces.get().map(Vec::len), Some(3));
}

/// A round outline with many corners and many small waves.
fn wavy(corners: usize, x: f64) -> Polygon {
    let at = |k: usize| {
        let turn = std::f64::consts::TAU * k as f64 / corners as f64;
        let (sin, cos) = libm::sincos(turn);
        let radius = 10.0 + 0.001 * libm::sin(turn * corners as f64 / 7.0);
        Point::new(x + radius * cos, radius * sin)
    };
    Polygon::new((0..corners).map(at).collect(), vec![]).expect("a valid polygon")
}

/// The bounds of the two overlap, and ear clipping of the outline takes minutes.
#[test]
fn a_body_beside_an_outline_with_many_corners_needs_no_pieces() {
    let round = wavy(300_000, 0.0);
    let beside = polygon(&[[7.2, 7.2], [12.0, 7.2], [12.0, 9.0], [5.4, 9.0]]);
    let (a, b) = (ConvexPieces::new(&round), ConvexPieces::new(&beside));
    assert!(a.depth_bound(&b) > 1.0, "their bounds overlap");
    assert_eq!(overlap(&a, &b, 1e-4), None);
    assert_eq!(overlap(&b, &a, 1e-4), None);
    assert!(a.pieces.get().is_none() && b.pieces.get().is_none());
}

/// The hulls exclude an overlap only if there is none.
#[test]
fn an_outline_with_many_corners_overlaps_what_reaches_into_it() {
    let round = wavy(3_000, 0.0);
    let inside = rectangle(9.0, -1.0, 3.0, 2.0);
    let found = both(&round, &inside);
    assert!(found.depth > 1e-3 && found.area > 1.0, "{found:?}");
}

/// A comb whose teeth lean by twice their height, with a hole in its back.
fn comb(teeth: i32) -> Polygon {
    let mut corners = Vec::new();
    for x in (0..teeth).map(|k| f64::from(4 * k)) {
        corners.extend([[x, 0.0], [x + 20.0, 10.0], [x + 22.0, 10.0], [x + 2.0, 0.0]]);
    }
    let end = f64::from(4 * teeth);
    corners.extend([[end, 0.0], [end, -3.0], [0.0, -3.0]]);
    let [outline, hole] = [&corners[..], &[[1.0, -2.0], [2.0, -2.0], [2.0, -1.0], [1.0, -1.0]]]
        .map(|ring| ring.iter().map(|p| Point::new(p[0], p[1])).collect());
    Polygon::new(outline, vec![hole]).expect("a valid polygon")
}

/// Trapezoids cover a polygon once, and an overlap with them has the area that triangles give.
#[test]
fn a_polygon_of_very_many_corners_is_cut_into_trapezoids() {
    for teeth in [3, 600] {
        let comb = comb(teeth);
        let pieces = trapezoids(comb.rings()).expect("a simple polygon");
        let area = |corners: &[Point]| {
            corners.windows(2).map(|side| cross(side[0] - corners[0], side[1] - corners[0]) / 2.0).sum::<f64>()
        };
        let total: f64 = pieces.iter().map(|piece| area(piece)).sum();
        let wanted = 20.0 * f64::from(teeth) + 12.0 * f64::from(teeth) - 1.0;
        assert!((total - wanted).abs() < 1e-9 * wanted && pieces.len() < 3 * comb.edges().count(), "{total}");
        // Across one tooth at half its height, over the gap to the next, and in the back beside the hole.
        let cut = |x: f64, y: f64, w: f64| {
            overlap(&ConvexPieces::new(&comb), &ConvexPieces::new(&rectangle(x, y, w, 1.0)), 1e-9)
        };
        let found = cut(8.0, 4.0, 8.0).expect("overlap");
        assert!((found.area - 4.0).abs() < 1e-9, "{found:?}");
        assert_eq!(cut(1.0, -2.0, 1.0), None);
        let back = cut(0.0, -2.0, 3.0).expect("overlap");
        assert!((back.area - 2.0).abs() < 1e-9 && (back.depth - 1.0).abs() < 1e-9, "{back:?}");
    }
}
