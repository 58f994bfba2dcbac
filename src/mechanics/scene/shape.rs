//! The built-in shapes of the triangular lattice, as sets of lattice cells.
//!
//! The origin of each shape is a lattice point, so that the shape can be rotated by 60° and moved by lattice steps
//! without leaving the lattice. The centroids of the three links (`linkh`, `linkr` and `linkl`) are not lattice points,
//! so the origin of a link is one of its two reentrant corners.
//!
//! | name | cells | origin |
//! |---|---|---|
//! | `up` | 1 | left end of its horizontal edge, the triangle above it |
//! | `down` | 1 | left end of its horizontal edge, the triangle below it |
//! | `hexagon` | 6 | its centre |
//! | `linkh` | 6 | its left reentrant corner, (−½, 0) from the centroid |
//! | `linkr` | 6 | its lower reentrant corner, (−¼, −√3/4) from the centroid |
//! | `linkl` | 6 | its lower reentrant corner, (¼, −√3/4) from the centroid; mirror image of `linkr` |

use crate::geometry::{Cell, CellShape};

const UP: CellShape = CellShape::Up;
const DOWN: CellShape = CellShape::Down;

/// The names of the built-in shapes.
pub const BUILT_IN: [&str; 6] = ["up", "down", "hexagon", "linkh", "linkr", "linkl"];

/// Returns the lattice cells of the built-in shape with this name, relative to its origin.
///
/// `None` if no built-in shape has this name.
///
/// ```
/// use drystone::scene::shape;
/// assert_eq!(shape::cells("hexagon").map(|cells| cells.len()), Some(6));
/// assert_eq!(shape::cells("octagon"), None);
/// ```
pub fn cells(name: &str) -> Option<Vec<Cell>> {
    let cells: &[(i64, i64, CellShape)] = match name {
        "up" => &[(0, 0, UP)],
        "down" => &[(0, 0, DOWN)],
        "hexagon" => &[(0, 0, UP), (-1, 1, DOWN), (-1, 0, UP), (-1, 0, DOWN), (0, -1, UP), (0, 0, DOWN)],
        "linkh" => &[(-1, 1, DOWN), (0, 0, UP), (0, 1, DOWN), (0, -1, UP), (0, 0, DOWN), (1, -1, UP)],
        "linkr" => &[(-1, 0, UP), (-1, 1, DOWN), (-1, 1, UP), (0, 0, DOWN), (0, 0, UP), (0, 1, DOWN)],
        "linkl" => &[(0, 0, UP), (-1, 1, DOWN), (-1, 1, UP), (-1, 0, DOWN), (-1, 0, UP), (-2, 1, DOWN)],
        _ => return None,
    };
    Some(cells.iter().map(|&(x, y, half)| Cell { x, y, shape: half }).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Lattice, LatticeKind, Point, Vector};

    const TRIANGLE_HEIGHT: f64 = 0.866_025_403_784_438_6;

    fn check(name: &str, origin: (f64, f64), outline: &[(f64, f64)]) {
        let lattice = Lattice { kind: LatticeKind::Triangular, side: 1.0 };
        let polygon = lattice.polygon(&cells(name).expect("a built-in shape")).expect("connected cells");
        let centroid = polygon.centroid();
        assert!((centroid + Vector::new(origin.0, origin.1) - Point::origin().coords).coords.norm() < 1e-12, "{name}");
        assert_eq!(polygon.outline().len(), outline.len(), "{name}");
        for (x, y) in outline {
            let near = polygon.outline().iter().any(|p| ((p - centroid) - Vector::new(*x, *y)).norm() < 1e-12);
            assert!(near, "{name} lacks the corner ({x}, {y})");
        }
    }

    #[test]
    fn shapes_have_the_expected_corners_and_origins() {
        check(
            "hexagon",
            (0.0, 0.0),
            &[
                (1.0, 0.0),
                (0.5, TRIANGLE_HEIGHT),
                (-0.5, TRIANGLE_HEIGHT),
                (-1.0, 0.0),
                (-0.5, -TRIANGLE_HEIGHT),
                (0.5, -TRIANGLE_HEIGHT),
            ],
        );
        check(
            "linkh",
            (-0.5, 0.0),
            &[
                (-1.0, -TRIANGLE_HEIGHT),
                (1.0, -TRIANGLE_HEIGHT),
                (0.5, 0.0),
                (1.0, TRIANGLE_HEIGHT),
                (-1.0, TRIANGLE_HEIGHT),
                (-0.5, 0.0),
            ],
        );
        let linkr = [
            (-1.25, -TRIANGLE_HEIGHT / 2.0),
            (-0.25, -TRIANGLE_HEIGHT / 2.0),
            (0.25, -1.5 * TRIANGLE_HEIGHT),
            (1.25, TRIANGLE_HEIGHT / 2.0),
            (0.25, TRIANGLE_HEIGHT / 2.0),
            (-0.25, 1.5 * TRIANGLE_HEIGHT),
        ];
        check("linkr", (-0.25, -TRIANGLE_HEIGHT / 2.0), &linkr);
        check("linkl", (0.25, -TRIANGLE_HEIGHT / 2.0), &linkr.map(|(x, y)| (-x, y)));
        check(
            "up",
            (-0.5, -TRIANGLE_HEIGHT / 3.0),
            &[(-0.5, -TRIANGLE_HEIGHT / 3.0), (0.5, -TRIANGLE_HEIGHT / 3.0), (0.0, 2.0 * TRIANGLE_HEIGHT / 3.0)],
        );
        check(
            "down",
            (-0.5, TRIANGLE_HEIGHT / 3.0),
            &[(-0.5, TRIANGLE_HEIGHT / 3.0), (0.5, TRIANGLE_HEIGHT / 3.0), (0.0, -2.0 * TRIANGLE_HEIGHT / 3.0)],
        );
    }
}
