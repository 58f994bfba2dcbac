//! Tests of cells, rotations and outlines on both lattices. Expected results come from calculation by hand or from
//! rotations of the plane.

use super::*;

const SHAPES: [CellShape; 3] = [CellShape::Square, CellShape::Up, CellShape::Down];

fn cell(x: i64, y: i64, shape: CellShape) -> Cell {
    Cell { x, y, shape }
}

fn lattice(shape: CellShape, side: f64) -> Lattice {
    let kind = match shape {
        CellShape::Square => LatticeKind::Square,
        _ => LatticeKind::Triangular,
    };
    Lattice { kind, side }
}

/// The square cells of a rectangle with `columns` columns and `rows` rows, except the cells at the nodes `without`.
fn squares(columns: i64, rows: i64, without: &[Node]) -> Vec<Cell> {
    let all = (0..columns).flat_map(|x| (0..rows).map(move |y| (x, y)));
    let kept = all.filter(|place| !without.contains(place));
    kept.map(|(x, y)| cell(x, y, CellShape::Square)).collect()
}

fn outline_of(cells: &[Cell], side: f64) -> Polygon {
    let lattice = lattice(cells[0].shape, side);
    lattice.polygon(cells).expect("connected cells")
}

/// The corners of a ring in their order, starting with the corner that has the smallest x. If several corners have
/// this x, the first is the lowest of them.
fn nodes(ring: &[Node]) -> Vec<Node> {
    let mut ring = ring.to_vec();
    let first = (0..ring.len()).min_by_key(|i| ring[*i]).unwrap_or(0);
    ring.rotate_left(first);
    ring
}

#[test]
fn corners_run_anticlockwise_around_the_area_of_a_cell() {
    assert_eq!(lattice(CellShape::Square, 3.0).cell_area(), 9.0);
    assert!((lattice(CellShape::Up, 2.0).cell_area() - 3f64.sqrt()).abs() < 1e-15);
    for shape in SHAPES {
        let (cell, lattice) = (cell(-4, 3, shape), lattice(shape, 0.7));
        let ring: Vec<Point> = cell.corners().iter().map(|c| lattice.node(*c)).collect();
        let polygon = Polygon::new(ring.clone(), vec![]).expect("a valid polygon");
        assert_eq!(polygon.outline(), ring, "a clockwise ring would be reversed");
        assert!((polygon.area() - lattice.cell_area()).abs() < 1e-15);
        assert!((polygon.centroid() - lattice.cell_centre(cell)).norm() < 1e-14);
        for side in polygon.edges() {
            assert!((side.length() - 0.7).abs() < 1e-14);
        }
        // A cell is identified by the left end of its horizontal edge. Only a cell that points down lies below this
        // edge.
        let above = lattice.cell_centre(cell).y > lattice.node((-4, 3)).y;
        assert!(cell.corners().contains(&(-4, 3)) && cell.corners().contains(&(-3, 3)));
        assert_eq!(above, shape != CellShape::Down);
    }
}

#[test]
fn centres_and_nodes_have_the_expected_coordinates() {
    // Triangles with a side of 2 m: the next row starts half a side farther to the right and √3 m higher.
    let triangles = lattice(CellShape::Up, 2.0);
    let third = 3f64.sqrt() / 3.0;
    let near = |found: Point, x: f64, y: f64| (found - Point::new(x, y)).norm() < 1e-14;
    assert!(near(triangles.cell_centre(cell(0, 0, CellShape::Up)), 1.0, third));
    assert!(near(triangles.cell_centre(cell(0, 0, CellShape::Down)), 1.0, -third));
    assert!(near(triangles.cell_centre(cell(2, 1, CellShape::Down)), 6.0, 2.0 * third));
    assert!(near(triangles.node((1, -2)), 0.0, -6.0 * third));
    assert!(near(triangles.point(0.5, 1.0), 2.0, 3.0 * third));
    let square = lattice(CellShape::Square, 2.0);
    assert!(near(square.cell_centre(cell(3, -1, CellShape::Square)), 7.0, -1.0));
}

#[test]
fn a_moved_cell_keeps_its_shape() {
    for shape in SHAPES {
        assert_eq!(cell(3, -2, shape).moved((4, -5)), cell(7, -7, shape));
    }
}

#[test]
fn rotations_on_the_lattice_are_rotations_of_the_plane() {
    for shape in SHAPES {
        let lattice = lattice(shape, 1.3);
        let angle = if shape == CellShape::Square { 90.0 } else { 60.0 };
        for steps in -7..=7 {
            let (sin, cos) = libm::sincos((angle * steps as f64).to_radians());
            let in_plane = |p: Point| Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y);
            for (x, y) in [(0, 0), (2, -1), (-3, 5), (0, 4)] {
                let node = lattice.node(turned(lattice.kind, (x, y), steps));
                assert!((node - in_plane(lattice.node((x, y)))).norm() < 1e-13);
                let own = cell(x, y, shape);
                let centre = lattice.cell_centre(own.turned(steps));
                assert!((centre - in_plane(lattice.cell_centre(own))).norm() < 1e-13);
            }
        }
    }
}

#[test]
fn each_boundary_edge_belongs_to_only_one_cell() {
    let one = cell(1, 2, CellShape::Up);
    let own = [((1, 2), (2, 2)), ((2, 2), (1, 3)), ((1, 3), (1, 2))];
    let sorted = |steps: &[LatticeEdge]| steps.iter().copied().collect::<BTreeSet<LatticeEdge>>().into_iter();
    assert!(boundary(&[one]).into_iter().eq(sorted(&own)));
    // The triangle below shares the lower edge.
    let below = [((1, 2), (2, 1)), ((2, 1), (2, 2)), ((2, 2), (1, 3)), ((1, 3), (1, 2))];
    let both = boundary(&[one, cell(1, 2, CellShape::Down)]);
    assert!(both.into_iter().eq(sorted(&below)));
}

#[test]
fn outlines_have_corners_only_where_they_turn() {
    // An L of five squares.
    let mut cells = squares(3, 1, &[]);
    cells.extend([cell(0, 1, CellShape::Square), cell(0, 2, CellShape::Square)]);
    let corners = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)];
    let traced = trace(&cells).expect("connected cells");
    assert_eq!(traced.len(), 1);
    assert_eq!(nodes(&traced[0]), corners);
    assert_eq!(outline_of(&cells, 0.5).area(), 1.25);
    // A triangle of two rows: three cells point up and one points down.
    let up = [(0, 0), (1, 0), (0, 1)].map(|(x, y)| cell(x, y, CellShape::Up));
    let mut cells = up.to_vec();
    cells.push(cell(0, 1, CellShape::Down));
    let traced = trace(&cells).expect("connected cells");
    assert_eq!(nodes(&traced[0]), [(0, 0), (2, 0), (0, 2)]);
    assert!((outline_of(&cells, 1.0).area() - 3f64.sqrt()).abs() < 1e-15);
}

#[test]
fn a_ring_of_squares_has_a_hole() {
    let polygon = outline_of(&squares(3, 3, &[(1, 1)]), 0.5);
    assert_eq!(polygon.holes().len(), 1);
    assert_eq!(polygon.outline().len(), 4);
    assert_eq!(polygon.area(), 2.0);
    // The hole runs clockwise, so that the squares are on its left.
    let clockwise = [(0.5, 0.5), (0.5, 1.0), (1.0, 1.0), (1.0, 0.5)];
    let mut hole = polygon.holes()[0].clone();
    let first = hole.iter().position(|p| *p == Point::new(0.5, 0.5));
    hole.rotate_left(first.expect("a corner of the hole"));
    assert_eq!(hole, clockwise.map(|(x, y)| Point::new(x, y)));
}

#[test]
fn the_outline_comes_before_the_holes_and_small_holes_before_large_ones() {
    let large = [(1, 1), (2, 1), (1, 2), (2, 2)];
    let holes = [&large[..], &[(4, 2)], &[(6, 1), (6, 2)]].concat();
    let traced = trace(&squares(8, 4, &holes)).expect("connected cells");
    let traced: Vec<Vec<Node>> = traced.iter().map(|ring| nodes(ring)).collect();
    let wanted = [
        [(0, 0), (8, 0), (8, 4), (0, 4)],
        [(4, 2), (4, 3), (5, 3), (5, 2)],
        [(6, 1), (6, 3), (7, 3), (7, 1)],
        [(1, 1), (1, 3), (3, 3), (3, 1)],
    ];
    assert_eq!(traced, wanted);
}

#[test]
fn a_hole_that_touches_the_outside_forms_one_ring_with_the_outline() {
    // The corner square is missing, so the hole touches the outside at (1, 2). The ring passes this node twice, each
    // time along the two edges of one of the squares there.
    let traced = trace(&squares(3, 3, &[(1, 1), (0, 2)])).expect("connected cells");
    let wanted = [(0, 0), (3, 0), (3, 3), (1, 3), (1, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)];
    assert_eq!(traced.len(), 1);
    assert_eq!(nodes(&traced[0]), wanted);
    // The mirror image.
    let traced = trace(&squares(3, 3, &[(1, 1), (2, 2)])).expect("connected cells");
    let wanted = [(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (2, 2), (2, 3), (0, 3)];
    assert_eq!(traced.len(), 1);
    assert_eq!(nodes(&traced[0]), wanted);
}

/// The six triangles around the origin, anticlockwise from the triangle between 0° and 60°.
fn wheel() -> Vec<Cell> {
    (0..6).map(|k| cell(0, 0, CellShape::Up).turned(k)).collect()
}

/// A hexagon whose sides are two triangles long. Of the six triangles around its centre, those with the numbers
/// `without` are missing.
fn hexagon(without: &[usize]) -> Vec<Cell> {
    let inner = wheel();
    let place = |n: Node| lattice(CellShape::Up, 1.0).node(n).coords.norm();
    let all = (-3..=3).flat_map(|x| (-3..=3).map(move |y| (x, y)));
    let both = all.flat_map(|(x, y)| [cell(x, y, CellShape::Up), cell(x, y, CellShape::Down)]);
    let within = both.filter(|c| c.corners().iter().all(|n| place(*n) < 2.01));
    let gone: Vec<Cell> = without.iter().map(|k| inner[*k]).collect();
    within.filter(|c| !gone.contains(c)).collect()
}

#[test]
fn the_ring_passes_separately_around_triangles_that_meet_only_in_a_node() {
    assert_eq!(hexagon(&[]).len(), 24);
    // Every pattern of missing triangles around the centre.
    for pattern in 1_usize..63 {
        let missing = |k: usize| pattern >> (k % 6) & 1 == 1;
        let without: Vec<usize> = (0..6).filter(|k| missing(*k)).collect();
        let traced = trace(&hexagon(&without)).expect("connected cells");
        assert_eq!((traced.len(), traced[0].len()), (2, 6), "{pattern:b}");
        let area: i64 = traced.iter().map(|ring| doubled_area(ring)).sum();
        assert_eq!(area as usize, 24 - without.len(), "{pattern:b}");
        // Each run of adjacent triangles around the centre is identified by the two spokes that bound it. The
        // boundary of three adjacent triangles is straight at the centre, so it has no corner there.
        let mut wanted = BTreeSet::new();
        for begin in (0..6).filter(|k| !missing(*k) && missing(k + 5)) {
            let count = (1..6).find(|k| missing(begin + k)).unwrap_or(6);
            if count != 3 {
                wanted.insert((begin, (begin + count) % 6));
            }
        }
        let spoke = |n: Node| (0..6).find(|k| turned(LatticeKind::Triangular, (1, 0), *k as i64) == n);
        let ring = &traced[1];
        let passes = (0..ring.len()).filter(|i| ring[*i] == (0, 0)).map(|i| {
            let (back, on) = (ring[(i + ring.len() - 1) % ring.len()], ring[(i + 1) % ring.len()]);
            spoke(on).zip(spoke(back)).expect("ends of spokes")
        });
        assert_eq!(passes.collect::<BTreeSet<_>>(), wanted, "{pattern:b}");
    }
}

#[test]
fn cells_that_meet_only_in_a_corner_are_not_one_body() {
    let apart = [cell(0, 0, CellShape::Square), cell(1, 1, CellShape::Square)];
    assert_eq!(lattice(CellShape::Square, 1.0).polygon(&apart), None);
    assert_eq!(lattice(CellShape::Square, 1.0).polygon(&[]), None);
    // A cell that is listed twice counts once.
    let twice = [cell(0, 0, CellShape::Up), cell(0, 0, CellShape::Up)];
    assert_eq!(outline_of(&twice, 2.0), outline_of(&twice[..1], 2.0));
}
