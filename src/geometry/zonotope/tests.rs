//! Tests of gauges. The expected values are calculated by hand, follow from chosen coefficients, or come from
//! transformations that do not change a gauge. The tests of upper bounds are in `bound`.

use super::*;

mod bound;

/// A pseudo-random number between −1 and 1 (SplitMix64).
fn chance(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*seed ^ (*seed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

fn triple(seed: &mut u64) -> Vec3 {
    [chance(seed), chance(seed), chance(seed)]
}

fn combined(generators: &[Vec3], amounts: &[f64]) -> Vec3 {
    let mut point = [0.0; 3];
    for (g, a) in generators.iter().zip(amounts) {
        for k in 0..3 {
            point[k] += a * g[k];
        }
    }
    point
}

#[test]
fn the_gauge_is_at_most_the_largest_coefficient_and_reaches_it_on_the_surface() {
    let mut seed = 7;
    for count in [1, 2, 3, 4, 8, 20, 39] {
        for _ in 0..50 {
            let g: Vec<Vec3> = (0..count).map(|_| triple(&mut seed)).collect();
            let amounts: Vec<f64> = g.iter().map(|_| 0.3 * chance(&mut seed)).collect();
            let scale = zonotope_gauge(&g, combined(&g, &amounts));
            assert!(scale <= 0.3 * (1.0 + 1e-9), "{count}: {scale}");
            // The point farthest along any direction lies on the surface.
            let n = triple(&mut seed);
            let far: Vec<f64> = g.iter().map(|v| 0.3 * dot(n, *v).signum()).collect();
            let scale = zonotope_gauge(&g, combined(&g, &far));
            assert!((scale / 0.3 - 1.0).abs() < 1e-9, "{count}: {scale}");
        }
    }
}

#[test]
fn scaling_rotation_and_reflection_do_not_change_the_gauge() {
    let mut seed = 11;
    for _ in 0..100 {
        let g: Vec<Vec3> = (0..7).map(|_| triple(&mut seed)).collect();
        let point = triple(&mut seed);
        let scale = zonotope_gauge(&g, point);
        let angle = 3.0 * chance(&mut seed);
        let (sin, cos) = libm::sincos(angle);
        let turned = |v: Vec3| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
        let mirrored = |v: Vec3| [-v[0], v[1], -v[2]];
        let larger = |v: Vec3| v.map(|x| 1e150 * x);
        let smaller = |v: Vec3| v.map(|x| 1e-120 * x);
        let ways: [&dyn Fn(Vec3) -> Vec3; 4] = [&turned, &mirrored, &larger, &smaller];
        for way in ways {
            let changed: Vec<Vec3> = g.iter().map(|v| way(*v)).collect();
            let other = zonotope_gauge(&changed, way(point));
            assert!((other / scale - 1.0).abs() < 1e-9, "{other} against {scale}");
        }
        let quick = zonotope_gauge_bound(&g, point).expect("up to twelve generators have a bound");
        assert!(quick >= scale * (1.0 - 1e-9));
    }
}

/// A pebble of weight 1 between two frictionless vertical faces that press it with 10⁸: nothing holds it up.
#[test]
fn a_pebble_between_smooth_faces_is_not_balanced_by_their_thrust() {
    let forces = [[1e8, 0.0, 3e7], [-1e8, 0.0, -3e7], [0.0, -1.0, 0.0], [0.0, 0.0, 2e8]];
    assert!((zonotope_gauge(&forces, [0.0, -1.0, 0.0]) - 1.0).abs() < 1e-5);
    // Friction of up to half the weight on either side balances a residual force of 10⁻⁷.
    let mut held = forces.to_vec();
    held.extend([[0.0, 0.5, 0.5], [0.0, 0.5, -0.5]]);
    let scale = zonotope_gauge(&held, [0.0, -1e-7, 0.0]);
    assert!((scale / 0.5e-7 - 1.0).abs() < 1e-5, "{scale}");
}

#[test]
fn zonotopes_in_a_plane_or_on_a_line_have_a_gauge() {
    let line = [[3.0, 4.0, 0.0], [-6.0, -8.0, 0.0]];
    assert!((zonotope_gauge(&line, [0.9, 1.2, 0.0]) - 0.1).abs() < 1e-12);
    assert_eq!(zonotope_gauge(&line, [0.9, 1.2, 1e-9]), f64::INFINITY);
    let plane = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.0]];
    assert!((zonotope_gauge(&plane, [2.0, 3.0, 0.0]) - 1.0).abs() < 1e-12);
    assert!((zonotope_gauge(&plane, [2.0, -2.0, 0.0]) - 4.0 / 3.0).abs() < 1e-12);
    assert_eq!(zonotope_gauge(&plane, [0.0, 0.0, 1e-12]), f64::INFINITY);
    assert_eq!(zonotope_gauge(&[], [1.0, 0.0, 0.0]), f64::INFINITY);
    assert_eq!(zonotope_gauge(&[[0.0; 3]], [0.0; 3]), 0.0);
    assert_eq!(zonotope_gauge(&[[f64::NAN; 3]], [1.0; 3]), f64::INFINITY);
}

/// Rotates a vector: by 36.9° about z, then by 67.4° about x.
fn tilted(v: Vec3) -> Vec3 {
    let [x, y, z] = [0.8 * v[0] - 0.6 * v[1], 0.6 * v[0] + 0.8 * v[1], v[2]];
    let (sin, cos) = (12.0 / 13.0, 5.0 / 13.0);
    [x, cos * y - sin * z, sin * y + cos * z]
}

/// Three maps of vectors: the identity, a rotation, and the rotation with a scaling by 10⁻⁴⁰.
fn ways() -> [fn(Vec3) -> Vec3; 3] {
    [|v| v, tilted, |v| tilted(v).map(|x| 1e-40 * x)]
}

#[test]
fn the_gauge_of_three_generators_is_the_largest_coefficient_of_the_solution() {
    let mut seed = 3;
    for _ in 0..100 {
        let g: Vec<Vec3> = (0..3).map(|_| triple(&mut seed)).collect();
        let amounts = triple(&mut seed);
        let most = amounts.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
        let point = combined(&g, &amounts);
        for way in ways() {
            let turned: Vec<Vec3> = g.iter().map(|v| way(*v)).collect();
            let scale = zonotope_gauge(&turned, way(point));
            assert!((scale / most - 1.0).abs() < 1e-6, "{scale} for {most}");
        }
    }
}

#[test]
fn the_origin_has_gauge_zero_and_numbers_that_are_not_finite_have_an_infinite_gauge() {
    let cube = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(zonotope_gauge(&cube, [0.0; 3]), 0.0);
    assert_eq!(zonotope_gauge(&[], [0.0; 3]), 0.0);
    assert_eq!(zonotope_gauge(&[[0.0; 3]; 2], [0.0, 1.0, 0.0]), f64::INFINITY);
    for odd in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert_eq!(zonotope_gauge(&cube, [0.0, odd, 0.0]), f64::INFINITY);
        let mut forces = cube.to_vec();
        forces[1][1] = odd;
        assert_eq!(zonotope_gauge(&forces, [0.0, 1.0, 0.0]), f64::INFINITY);
    }
}

#[test]
fn rounding_errors_count_neither_as_distance_nor_as_width() {
    let plane = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.0]];
    // The point is off the plane by a few units in the last place, or by dozens of them.
    let scale = zonotope_gauge(&plane, [2.0, 3.0, 4e-15]);
    assert!((scale - 1.0).abs() < 1e-12, "{scale}");
    assert_eq!(zonotope_gauge(&plane, [2.0, 3.0, 4e-14]), f64::INFINITY);
    // A generator that is shorter than the rounding error gives the zonotope no width.
    let thick = |by: f64| zonotope_gauge(&[plane[0], plane[1], [0.0, 0.0, by]], [0.0, 0.0, by]);
    assert_eq!(thick(4e-15), f64::INFINITY);
    assert!((thick(1e-13) - 1.0).abs() < 0.2, "{}", thick(1e-13));
    assert!(thick(1e-13) > 1.05, "rounding is subtracted from the width");
}

#[test]
fn parallel_generators_form_a_segment_of_their_total_length() {
    // Lengths of 0.3, 1.2 and 0.5 along one direction or its opposite: 2 in total.
    for way in ways() {
        let direction = |by: f64| way([by, 2.0 * by, -2.0 * by]);
        let line = [0.3, -1.2, 0.5].map(direction);
        let scale = zonotope_gauge(&line, direction(-0.5));
        assert!((scale - 0.25).abs() < 1e-12, "{scale}");
        let beside = way([0.5, 1.0, -0.9]);
        assert_eq!(zonotope_gauge(&line, beside), f64::INFINITY);
    }
    for k in 0..3 {
        let mut axis = [0.0; 3];
        axis[k] = 3.0;
        assert!((zonotope_gauge(&[axis], axis) - 1.0).abs() < 1e-12);
        axis[(k + 1) % 3] = 1e-3;
        let mut along = [0.0; 3];
        along[k] = -1.0;
        assert_eq!(zonotope_gauge(&[axis], along), f64::INFINITY);
    }
}

#[test]
fn a_rectangle_in_space_is_flat_and_bounded_by_its_sides() {
    // The sides of 2 and 3 are perpendicular. The gauge of a point in their plane is the larger of its two
    // coordinates, each relative to its side.
    for way in ways() {
        let sides = [way([2.0, 0.0, 0.0]), way([0.0, 3.0, 0.0])];
        for (x, y, scale) in [(1.0, 1.0, 0.5), (-1.0, 2.4, 0.8), (0.0, -6.0, 2.0), (3.0, 0.0, 1.5)] {
            let found = zonotope_gauge(&sides, way([x, y, 0.0]));
            assert!((found - scale).abs() < 1e-12, "{found} for {scale}");
            assert_eq!(zonotope_gauge(&sides, way([x, y, 1e-3])), f64::INFINITY);
        }
    }
}
