//! [`spline`]: converts a SPLINE entity, a B-spline with or without weights, to cubic Bézier curves.
//!
//! Between two knots, the curve is a polynomial or, with weights, a fraction of polynomials. The points and tangents at
//! both ends of such a piece determine a cubic curve. This cubic is the piece itself if its degree is at most 3 and all
//! weights are equal. Other pieces are divided into equal steps first.
//!
//! Points and tangents come from the algorithm of de Boor: Farin, Curves and Surfaces for CAGD, 2002, §8.3. A spline with
//! only fit points becomes the cubic spline through them with continuous curvature, whose parameter is the length of
//! the chords, and which is straight at ends without a tangent (§9.1 and §9.3 there).

use super::record::{Record, number};
use crate::geometry::{Point, Vector};
use crate::sources::import::subpath::{Segment, Subpath};

/// The number of cubic curves for a piece that is not itself a cubic curve.
const STEPS_PER_PIECE: usize = 8;
/// The largest degree; CAD programs write at most 11.
const MAX_DEGREE: usize = 25;

/// A control point in homogeneous coordinates: x and y times the weight, and the weight.
type Control = nalgebra::Vector3<f64>;

/// Returns the curve of a spline. `None` if its control points and knots are not complete.
pub(super) fn spline(entity: &Record<'_>) -> Option<Subpath> {
    let numbers = |wanted: i32| -> Vec<f64> {
        entity.groups.iter().filter(|(code, _)| *code == wanted).map(|(_, value)| number(value)).collect()
    };
    let degree = usize::try_from(entity.integer(71)).ok().filter(|d| (1..=MAX_DEGREE).contains(d))?;
    let (xs, ys, weights, knots) = (numbers(10), numbers(20), numbers(41), numbers(40));
    let count = xs.len();
    if count == 0 {
        let points: Vec<Point> = numbers(11).into_iter().zip(numbers(21)).map(|(x, y)| Point::new(x, y)).collect();
        let tangent = |code| Some(Vector::new(entity.number(code)?, entity.number(code + 10)?).normalize());
        let segments = through(&points, [tangent(12), tangent(13)])?;
        return Some(Subpath { start: *points.first()?, segments, closed: entity.has_flag(70, 1) });
    }
    let is_complete = count > degree && ys.len() == count && knots.len() == count + degree + 1;
    let rises = knots.windows(2).all(|pair| pair[0] <= pair[1]);
    let is_positive = weights.iter().all(|w| *w > 0.0);
    if !is_complete || !rises || !is_positive || !(weights.is_empty() || weights.len() == count) {
        return None;
    }
    let weight = |i: usize| weights.get(i).copied().unwrap_or(1.0);
    let controls: Vec<Control> =
        (0..count).map(|i| Control::new(xs[i] * weight(i), ys[i] * weight(i), weight(i))).collect();
    let is_cubic = degree <= 3 && (1..count).all(|i| weight(i) == weight(0));
    let steps = if is_cubic { 1 } else { STEPS_PER_PIECE };
    let mut segments = Vec::new();
    let mut start = None;
    for piece in (degree..count).filter(|k| knots[*k] < knots[*k + 1]) {
        let (from, to) = (knots[piece], knots[piece + 1]);
        let step = (to - from) / steps as f64;
        let at = |i: usize| de_boor(&controls, &knots, degree, piece, from + step * i as f64);
        for i in 0..steps {
            let ((a, leaving), (b, arriving)) = (at(i), at(i + 1));
            start.get_or_insert(a);
            segments.push(Segment::Cubic(a + leaving * (step / 3.0), b - arriving * (step / 3.0), b));
        }
    }
    Some(Subpath { start: start?, segments, closed: entity.has_flag(70, 1) })
}

/// Returns the point and the tangent of a spline at the parameter `t` in the piece that begins at the knot `piece`.
fn de_boor(controls: &[Control], knots: &[f64], degree: usize, piece: usize, t: f64) -> (Point, Vector) {
    let mut level: Vec<Control> = controls[piece - degree..=piece].to_vec();
    let mut slope = Control::zeros();
    for r in 1..=degree {
        if r == degree {
            slope = (level[degree] - level[degree - 1]) * (degree as f64 / (knots[piece + 1] - knots[piece]));
        }
        for j in (r..=degree).rev() {
            let i = piece - degree + j;
            let share = (t - knots[i]) / (knots[i + degree + 1 - r] - knots[i]);
            level[j] = level[j - 1] * (1.0 - share) + level[j] * share;
        }
    }
    let at = level[degree];
    let point = Point::new(at.x, at.y) / at.z;
    (point, (Vector::new(slope.x, slope.y) - point.coords * slope.z) / at.z)
}

/// Returns the cubic spline through `points` with the unit tangents `ends` at its ends; `None` stands for a straight
/// end. Returns `None` if there are fewer than two points, or if two neighbours are the same point.
fn through(points: &[Point], ends: [Option<Vector>; 2]) -> Option<Vec<Segment>> {
    let chords: Vec<Vector> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let lengths: Vec<f64> = chords.iter().map(Vector::norm).collect();
    if chords.is_empty() || !lengths.iter().all(|h| *h > 0.0) {
        return None;
    }
    // The curvature is continuous at each point: a·m₋ + b·m + c·m₊ = d for the tangents m. This tridiagonal system is
    // solved by elimination from the first point to the last, and back.
    let last = chords.len();
    let row = |i: usize| -> [(f64, Vector); 2] {
        let side = |k: usize| (1.0 / lengths[k], chords[k] * (3.0 / (lengths[k] * lengths[k])));
        let none = (0.0, Vector::zeros());
        [if i > 0 { side(i - 1) } else { none }, if i < last { side(i) } else { none }]
    };
    let mut solved: Vec<(f64, Vector)> = Vec::new();
    for i in 0..=last {
        let [(a, da), (c, dc)] = row(i);
        let given = if i == 0 { ends[0] } else { ends[1].filter(|_| i == last) };
        let (a, b, c, d) = match given {
            Some(tangent) => (0.0, 1.0, 0.0, tangent),
            None => (a, 2.0 * (a + c), c, da + dc),
        };
        let (before, known) = solved.last().copied().unwrap_or((0.0, Vector::zeros()));
        let pivot = b - a * before;
        solved.push((c / pivot, (d - known * a) / pivot));
    }
    let mut tangents: Vec<Vector> = vec![Vector::zeros(); last + 1];
    for i in (0..=last).rev() {
        let after = tangents.get(i + 1).copied().unwrap_or_default();
        tangents[i] = solved[i].1 - after * solved[i].0;
    }
    let segment = |k: usize| {
        let third = lengths[k] / 3.0;
        let (from, to) = (points[k], points[k + 1]);
        Segment::Cubic(from + tangents[k] * third, to - tangents[k + 1] * third, to)
    };
    Some((0..last).map(segment).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Subpath {
        let text: String = text.split_whitespace().map(|word| format!("{word}\n")).collect();
        let records = super::super::record::records(&text).expect("groups");
        spline(&records[0]).expect("a spline")
    }

    #[test]
    fn a_cubic_spline_without_inner_knots_is_a_bezier_curve() {
        let curve =
            read("0 SPLINE 71 3 40 0 40 0 40 0 40 0 40 2 40 2 40 2 40 2 10 0 20 0 10 1 20 3 10 4 20 3 10 6 20 -1");
        let [Segment::Cubic(a, b, to)] = curve.segments[..] else { panic!("one curve: {curve:?}") };
        for (found, expected) in [(a, (1.0, 3.0)), (b, (4.0, 3.0)), (to, (6.0, -1.0))] {
            assert!((found - Point::new(expected.0, expected.1)).norm() < 1e-14, "{found}");
        }
    }

    #[test]
    fn a_spline_through_fit_points_has_continuous_curvature() {
        let points = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0), (1.0, 5.0)].map(|p| Point::new(p.0, p.1));
        let segments = through(&points, [None, Some(Vector::new(-1.0, 0.0))]).expect("a curve");
        let mut from = points[0];
        let mut bends = Vec::new();
        for (i, segment) in segments.iter().enumerate() {
            let Segment::Cubic(a, b, to) = *segment else { panic!("a cubic curve") };
            let square = (points[i + 1] - points[i]).norm_squared();
            assert_eq!(to, points[i + 1]);
            let bend = |p: Point, q: Point, r: Point| (p.coords - q.coords * 2.0 + r.coords) * (6.0 / square);
            bends.push([bend(from, a, b), bend(a, b, to)]);
            from = to;
        }
        assert!(bends[0][0].norm() < 1e-12, "straight at the start");
        assert!((bends[0][1] - bends[1][0]).norm() < 1e-12 && (bends[1][1] - bends[2][0]).norm() < 1e-12);
        let Segment::Cubic(_, b, to) = segments[2] else { panic!("a cubic curve") };
        assert!((to - b).y.abs() < 1e-12 && (to - b).x < 0.0);
    }

    #[test]
    fn a_rational_spline_is_a_circular_arc() {
        // A quarter of a circle of radius 2: the middle control point has the weight cos 45°.
        let curve = read(
            "0 SPLINE 71 2 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0.7071067811865476 41 1 10 2 20 0 10 2 20 2 10 0 20 2",
        );
        let closed = Subpath { closed: true, ..curve };
        for corner in closed.flattened(1e-6, 0.0).expect("closed") {
            assert!((corner.at.coords.norm() - 2.0).abs() < 5e-5, "{}", corner.at);
        }
    }
}
