//! [`convex_hull`]: the smallest convex polygon around some points (monotone chain algorithm, Andrew 1979).

use super::{Point, cross};

/// Returns the corners of the convex hull of some points, anticlockwise. Points on the sides of the hull are left out.
pub(crate) fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let mut ring: Vec<Point> = Vec::with_capacity(points.len() + 1);
    for pass in 0..2 {
        let begin = ring.len();
        for p in &points {
            while ring.len() >= begin + 2 && {
                let [a, b] = [ring[ring.len() - 2], ring[ring.len() - 1]];
                cross(b - a, *p - b) <= 0.0
            } {
                ring.pop();
            }
            ring.push(*p);
        }
        ring.pop();
        if pass == 0 {
            points.reverse();
        }
    }
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_has_no_inner_corners_and_runs_anticlockwise() {
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]];
        let ring = convex_hull(points.map(|[x, y]| Point::new(x, y)).to_vec());
        let expected = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        assert_eq!(ring, expected.map(|[x, y]| Point::new(x, y)).to_vec());
    }
}
