//! Tests of the lines through a few nodes, and of moving nodes onto these lines.

use super::*;
use crate::geometry::snap::{Corner, Gaps};

/// One node for each corner of one body. Corners of the same body are never merged, however close they are.
fn nodes(places: &[[f64; 2]], gap: f64) -> Nodes {
    let corner = |p: &[f64; 2]| Corner { at: Point::new(p[0], p[1]), curved: false };
    let ring = places.iter().map(corner).collect();
    Nodes::new(&[vec![ring]], Gaps::new(&[gap]), &[false])
}

fn transposed(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    places.iter().map(|[x, y]| [*y, *x]).collect()
}

/// The points, rotated by 36.9° about the origin and then moved.
fn tilted(places: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let turn = |[x, y]: &[f64; 2]| [0.8 * x - 0.6 * y + 3.0, 0.6 * x + 0.8 * y - 7.0];
    places.iter().map(turn).collect()
}

/// The kind of the line that is fitted to all points, as text. Each side is given by the numbers of its two ends.
fn kind(places: &[[f64; 2]], gap: f64, sides: &[[usize; 2]]) -> Option<String> {
    let nodes = nodes(places, gap);
    let line = Line::new(&nodes, (0..places.len()).collect(), sides)?;
    assert_eq!(line.nodes.len(), places.len());
    Some(match line.kind {
        LineKind::Side(ends) => format!("{ends:?}"),
        LineKind::Horizontal => "horizontal".to_owned(),
        LineKind::Vertical => "vertical".to_owned(),
        LineKind::Closest => "closest".to_owned(),
    })
}

fn assert_kind(places: &[[f64; 2]], gap: f64, sides: &[[usize; 2]], wanted: &str) {
    assert_eq!(kind(places, gap, sides).as_deref(), Some(wanted), "{places:?}");
}

#[test]
fn the_line_runs_along_the_longest_side_if_all_nodes_lie_along_it() {
    // A side of length 4 that begins at x = 1, a shorter side near it, and a corner that is a quarter beyond either
    // end, or a quarter above or below.
    let at = |end: f64, off: f64| [[1.0, 2.0], [5.0, 2.0], [1.5, 2.0], [4.0, 2.125], [end, 2.0 + off]];
    let sides = [[2, 3], [0, 1]];
    for (end, off) in [(0.75, 0.0), (5.25, 0.0), (3.0, 0.25), (3.0, -0.25)] {
        let places = at(end, off);
        assert_kind(&places, 0.25, &sides, "[0, 1]");
        assert_kind(&transposed(&places), 0.25, &sides, "[0, 1]");
        assert_kind(&tilted(&places), 0.2500001, &sides, "[0, 1]");
    }
    for end in [0.5, 5.5] {
        let places = at(end, 0.0);
        assert_kind(&places, 0.25, &sides, "horizontal");
        assert_kind(&transposed(&places), 0.25, &sides, "vertical");
        assert_kind(&tilted(&places), 0.25, &sides, "closest");
    }
    // If two sides have the same length, the line runs along the first, whatever its direction.
    assert_kind(&[[0.0, 0.0], [4.0, 0.0], [0.0, 0.5], [4.0, 0.5]], 0.5, &[[1, 0], [2, 3]], "[1, 0]");
}

#[test]
fn there_is_no_line_if_a_node_would_be_farther_away_than_its_gap() {
    // The corners of a triangle of height 1: the closest line is 1/3 away from two of them, and 2/3 from the third.
    let places = [[0.0, 0.0], [9.0, 0.0], [4.5, 1.0]];
    let sides = [[0, 2]];
    assert_eq!(kind(&places, 0.66, &sides), None);
    assert_kind(&places, 0.67, &sides, "horizontal");
    let off = [[0.0, 0.0], [9.0, 0.0], [4.5, 1.0], [f64::NAN, 0.0]];
    assert_eq!(kind(&off, 0.67, &[[0, 1]]), None);
}

#[test]
fn a_fitted_line_is_made_horizontal_or_vertical_within_the_scatter_of_its_corners() {
    // Four corners in a row of length 6 are off by ±1/64. With this scatter, one end of the row may be up to 1/32
    // higher than the other.
    let row = |rise: f64, off: f64| {
        let at = |k: usize, s: f64| [2.0 * k as f64, rise * (k as f64 / 3.0 - 0.5) + s * off];
        [at(0, 1.0), at(1, -1.0), at(2, -1.0), at(3, 1.0)]
    };
    let sides = [[1, 2]];
    for (rise, off, horizontal) in [
        (0.0, 1.0 / 64.0, true),
        (0.03, 1.0 / 64.0, true),
        (-0.03, 1.0 / 64.0, true),
        (0.033, 1.0 / 64.0, false),
        (-0.033, 1.0 / 64.0, false),
        // Without scatter only rounding is allowed: a billionth of the gap.
        (0.9e-9, 0.0, true),
        (1.2e-9, 0.0, false),
        (1e-3, 0.0, false),
    ] {
        let places = row(rise, off);
        let far = places.map(|[x, y]| [x + 100.0, y - 0.5]);
        for places in [places, far] {
            assert_kind(&places, 1.0, &sides, if horizontal { "horizontal" } else { "closest" });
            let across = transposed(&places);
            assert_kind(&across, 1.0, &sides, if horizontal { "vertical" } else { "closest" });
        }
    }
}

#[test]
fn the_closest_line_has_the_least_sum_of_squared_distances() {
    let mut seed = 5_u64;
    let mut any = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 33) as f64 / (1_u64 << 30) as f64 - 1.0
    };
    for k in 0..24 {
        let angle = 0.27 * k as f64;
        let places: Vec<[f64; 2]> = (0..5)
            .map(|i| {
                let (s, t) = (i as f64 - 2.0, 0.2 * any());
                let (sin, cos) = libm::sincos(angle);
                [cos * s - sin * t + 4.0, sin * s + cos * t - 9.0]
            })
            .collect();
        let nodes = nodes(&places, 0.01);
        let line = Line { nodes: (0..5).collect(), kind: LineKind::Closest };
        let fit = line.fit(&nodes);
        let squares = |fit: &Fit| nodes.all.iter().map(|n| fit.distance(n.at) * fit.distance(n.at)).sum::<f64>();
        let least = squares(&fit);
        assert!((fit.normal.norm() - 1.0).abs() < 1e-14);
        for by in [-1.0, -1e-3, 1e-3, 1.0] {
            let (sin, cos) = libm::sincos(by);
            let n = fit.normal;
            let normal = Vector::new(cos * n.x - sin * n.y, sin * n.x + cos * n.y);
            assert!(squares(&Fit { normal, ..fit }) > least);
            let through = fit.through + fit.normal * by;
            assert!(squares(&Fit { through, ..fit }) > least);
        }
    }
}

/// A line through a point, with a normal that has the direction of `normal`.
fn line(through: [f64; 2], normal: [f64; 2]) -> Fit {
    Fit { through: Point::new(through[0], through[1]), normal: Vector::new(normal[0], normal[1]).normalize() }
}

fn steps_to(at: [f64; 2], lines: &[Fit], wanted: [f64; 2]) {
    let at = Point::new(at[0], at[1]);
    let found = at + least_squares_step(at, lines.iter());
    assert!((found - Point::new(wanted[0], wanted[1])).norm() < 1e-12, "{found} for {wanted:?}");
}

#[test]
fn a_step_leads_to_the_nearest_point_of_one_line_or_to_the_crossing_of_two() {
    steps_to([3.0, 5.0], &[line([9.0, 1.0], [0.0, 1.0])], [3.0, 1.0]);
    steps_to([3.0, 5.0], &[line([9.0, 1.0], [-1.0, 0.0])], [9.0, 5.0]);
    // The lines y = x, and 3x + 4y = 25 from (8, 9).
    steps_to([3.0, 5.0], &[line([1.0, 1.0], [1.0, -1.0])], [4.0, 4.0]);
    steps_to([8.0, 9.0], &[line([3.0, 4.0], [3.0, 4.0])], [8.0 - 3.0 * 1.4, 9.0 - 4.0 * 1.4]);
    // x + y = 4 and x − 3y = −8 cross at (1, 3); x = 2 and x + 2y = 12 cross at (2, 5).
    steps_to([9.0, -2.0], &[line([4.0, 0.0], [1.0, 1.0]), line([-8.0, 0.0], [1.0, -3.0])], [1.0, 3.0]);
    steps_to([0.0, 1.0], &[line([2.0, 7.0], [1.0, 0.0]), line([12.0, 0.0], [1.0, 2.0])], [2.0, 5.0]);
}

#[test]
fn a_step_towards_lines_without_a_common_point_leads_to_their_middle() {
    // Two horizontal lines and a vertical line; then pairs of parallel lines.
    let horizontal = |y: f64| line([0.0, y], [0.0, 1.0]);
    let vertical = |x: f64| line([x, 0.0], [1.0, 0.0]);
    steps_to([5.0, 9.0], &[horizontal(1.0), horizontal(3.0), vertical(-4.0)], [-4.0, 2.0]);
    steps_to([5.0, 9.0], &[horizontal(1.0), horizontal(3.0)], [5.0, 2.0]);
    steps_to([5.0, 9.0], &[vertical(1.0), vertical(3.0)], [2.0, 9.0]);
    // x + y = 0 and x + y = 4 are equally far from x + y = 2.
    steps_to([5.0, 1.0], &[line([0.0, 0.0], [1.0, 1.0]), line([4.0, 0.0], [1.0, 1.0])], [3.0, -1.0]);
    steps_to([5.0, 1.0], &[line([0.0, 0.0], [1.0, -1.0]), line([2.0, 0.0], [1.0, -1.0])], [3.5, 2.5]);
    // If the angle of two lines is slightly more than 0.01 rad, the step leads to their crossing, 98 m away. If it is
    // slightly less, the lines count as parallel.
    let crossing = |sine: f64| {
        let lines = [horizontal(0.0), line([0.0, 1.0], [-sine, 1.0])];
        least_squares_step(Point::new(0.0, 0.0), lines.iter()).norm()
    };
    assert!((crossing(0.0102) * 0.0102 - 1.0).abs() < 1e-9);
    assert!(crossing(0.0098) < 1.0);
}

/// The numbers of the nodes on each line, sorted. A side is given by its ends and the other nodes on it.
fn lines_of(nodes: &Nodes, sides: &[([usize; 2], &[usize])]) -> Vec<Vec<usize>> {
    let on = sides.iter().map(|(ends, on)| (*ends, on.iter().copied().collect()));
    let Lines(lines) = Lines::new(nodes, &on.collect());
    lines.into_iter().map(|line| line.nodes).collect()
}

#[test]
fn sides_that_share_two_nodes_have_one_line() {
    let row = nodes(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|x| [x, 0.0]), 0.25);
    // Each side shares two nodes with the next. In the second list the first two sides share only one node.
    let all = [([0, 2], &[1][..]), ([1, 4], &[2, 3]), ([3, 5], &[4])];
    assert_eq!(lines_of(&row, &all), [[0, 1, 2, 3, 4, 5]]);
    let two = [([0, 2], &[1][..]), ([2, 4], &[3]), ([3, 5], &[4])];
    assert_eq!(lines_of(&row, &two), [vec![0, 1, 2], vec![2, 3, 4, 5]]);
    // The third side shares two nodes with each of the other two, which share none.
    let later = [([0, 1], &[2][..]), ([3, 4], &[5]), ([3, 5], &[1, 2, 4])];
    assert_eq!(lines_of(&row, &later), [[0, 1, 2, 3, 4, 5]]);
    // The sides form a bend of more than the gap, so each side keeps its own line. In the first case the second side
    // has no line.
    let bent = nodes(&[[0.0, 0.0], [4.0, 0.0], [8.0, 0.5], [6.0, 0.0], [2.0, 0.0]], 0.0625);
    let sides = [([0, 3], &[4, 1][..]), ([1, 2], &[3])];
    assert_eq!(lines_of(&bent, &sides), [[0, 1, 3, 4]]);
    let wide = nodes(&[[0.0, 0.0], [4.0, 0.0], [8.0, 1.0], [6.0, 0.25], [2.0, 0.0]], 0.25);
    assert_eq!(lines_of(&wide, &sides), [vec![0, 1, 3, 4], vec![1, 2, 3]]);
}

/// The positions of the nodes after they have been moved onto the lines of the sides.
fn settled(mut nodes: Nodes, sides: &[([usize; 2], &[usize])]) -> Vec<Point> {
    let on = sides.iter().map(|(ends, on)| (*ends, on.iter().copied().collect()));
    Lines::new(&nodes, &on.collect()).settle(&mut nodes);
    nodes.all.iter().map(|node| node.at).collect()
}

fn lie_at(found: &[Point], wanted: &[[f64; 2]]) {
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        let off = (found - Point::new(wanted[0], wanted[1])).norm();
        assert!(off < 1e-9, "{found} for {wanted:?}");
    }
}

#[test]
fn corners_move_to_their_line_or_to_the_crossing_of_two_lines() {
    // A horizontal joint and a vertical joint, each along one side. The corner that belongs to both joints lies off
    // both lines.
    let drawn = [[0.0, 0.0], [8.0, 0.0], [3.0, -3.0], [3.0, 3.0], [3.01, 0.02], [5.0, -0.01], [2.98, 1.0]];
    let sides = [([0, 1], &[4, 5][..]), ([2, 3], &[4, 6])];
    let found = settled(nodes(&drawn, 0.04), &sides);
    lie_at(&found, &[[0.0, 0.0], [8.0, 0.0], [3.0, -3.0], [3.0, 3.0], [3.0, 0.0], [5.0, 0.0], [3.0, 1.0]]);
    let found = settled(nodes(&tilted(&drawn), 0.04), &sides);
    let straight = [[0.0, 0.0], [8.0, 0.0], [3.0, -3.0], [3.0, 3.0], [3.0, 0.0], [5.0, 0.0], [3.0, 1.0]];
    lie_at(&found, &tilted(&straight));
}

#[test]
fn fixed_nodes_stay_and_the_others_move_to_them() {
    // Two sides overlap, so that one end of each lies on the other. In the second case one of these four nodes is
    // fixed.
    let drawn = [[0.0, 0.0], [4.0, 0.0], [2.0, 0.01], [6.0, 0.01]];
    let sides = [([0, 1], &[2][..]), ([2, 3], &[1])];
    lie_at(&settled(nodes(&drawn, 0.04), &sides), &drawn.map(|[x, _]| [x, 0.005]));
    let mut fixed = nodes(&drawn, 0.04);
    fixed.all[2].fixed = true;
    lie_at(&settled(fixed, &sides), &drawn.map(|[x, _]| [x, 0.01]));
}

#[test]
fn no_corner_moves_farther_than_two_gaps() {
    // A corner is one gap away from each of two lines. If the lines are perpendicular it has to move 1.41 gaps; if
    // their angle is 0.4 rad, five gaps.
    let at = |angle: f64| {
        let ray = |side: f64, reach: f64| {
            let (sin, cos) = libm::sincos(angle / 2.0);
            [reach * cos, side * reach * sin]
        };
        let apart = 0.01 / libm::sin(angle / 2.0);
        let places = [ray(1.0, -5.0), ray(1.0, 5.0), ray(-1.0, -5.0), ray(-1.0, 5.0), [apart, 0.0]];
        settled(nodes(&places, 0.0101), &[([0, 1], &[4][..]), ([2, 3], &[4])])[4]
    };
    assert!(at(core::f64::consts::FRAC_PI_2).coords.norm() < 1e-12);
    assert!((at(0.4).x - 0.01 / libm::sin(0.2)).abs() < 1e-15);
}
