//! Tests of gauges that are known by hand, from chosen coefficients, or from transformations that must not change
//! them.

use super::*;

fn reduced(list: Vec<Vec3>) -> Vec<Vec3> {
    super::reduce(list.into_iter())
}

/// SplitMix64, from −1 to 1.
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
            assert!(
                (other / scale - 1.0).abs() < 1e-9,
                "{other} against {scale}"
            );
        }
        let quick = zonotope_gauge_bound(&g, point).expect("seven are few");
        assert!(quick >= scale * (1.0 - 1e-9));
    }
}

/// A pebble of weight 1 between two frictionless vertical faces that press it with 10⁸: nothing holds it up.
#[test]
fn a_pebble_between_smooth_faces_is_not_balanced_by_their_thrust() {
    let forces = [
        [1e8, 0.0, 3e7],
        [-1e8, 0.0, -3e7],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 2e8],
    ];
    assert!((zonotope_gauge(&forces, [0.0, -1.0, 0.0]) - 1.0).abs() < 1e-5);
    // With friction of half its weight on either side, and a residual of a ten-millionth, it is balanced.
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

#[test]
fn hundreds_of_generators_give_a_larger_gauge_never_a_smaller_one() {
    let mut seed = 5;
    for count in [60, 200, 900] {
        let g: Vec<Vec3> = (0..count).map(|_| triple(&mut seed)).collect();
        let n = triple(&mut seed);
        let far: Vec<f64> = g.iter().map(|v| dot(n, *v).signum()).collect();
        let point = combined(&g, &far);
        let scale = zonotope_gauge(&g, point);
        assert!((1.0..1.2).contains(&scale), "{count}: {scale}");
        let quick = zonotope_gauge_bound(&g, point).expect("random ones span space");
        assert!((1.0..3.0).contains(&quick), "{count}: {quick}");
    }
}

/// Rotates a vector: by 36.9° about z, then by 67.4° about x.
fn tilted(v: Vec3) -> Vec3 {
    let [x, y, z] = [0.8 * v[0] - 0.6 * v[1], 0.6 * v[0] + 0.8 * v[1], v[2]];
    let (sin, cos) = (12.0 / 13.0, 5.0 / 13.0);
    [x, cos * y - sin * z, sin * y + cos * z]
}

/// Leaves a vector as it is, rotates it, or rotates it and scales it by 10⁻⁴⁰.
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
fn the_origin_has_gauge_zero_and_infinite_numbers_have_an_infinite_gauge() {
    let cube = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(zonotope_gauge(&cube, [0.0; 3]), 0.0);
    assert_eq!(zonotope_gauge(&[], [0.0; 3]), 0.0);
    assert_eq!(
        zonotope_gauge(&[[0.0; 3]; 2], [0.0, 1.0, 0.0]),
        f64::INFINITY
    );
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
    // The point is off the plane by a few units in the last place, or by some dozens.
    let scale = zonotope_gauge(&plane, [2.0, 3.0, 4e-15]);
    assert!((scale - 1.0).abs() < 1e-12, "{scale}");
    assert_eq!(zonotope_gauge(&plane, [2.0, 3.0, 4e-14]), f64::INFINITY);
    // A generator that is not longer than the rounding gives the zonotope no width.
    let thick = |by: f64| zonotope_gauge(&[plane[0], plane[1], [0.0, 0.0, by]], [0.0, 0.0, by]);
    assert_eq!(thick(4e-15), f64::INFINITY);
    assert!((thick(1e-13) - 1.0).abs() < 0.2, "{}", thick(1e-13));
    assert!(thick(1e-13) > 1.05, "the rounding counts against them");
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
        for (x, y, scale) in [
            (1.0, 1.0, 0.5),
            (-1.0, 2.4, 0.8),
            (0.0, -6.0, 2.0),
            (3.0, 0.0, 1.5),
        ] {
            let found = zonotope_gauge(&sides, way([x, y, 0.0]));
            assert!((found - scale).abs() < 1e-12, "{found} for {scale}");
            assert_eq!(zonotope_gauge(&sides, way([x, y, 1e-3])), f64::INFINITY);
        }
    }
}

#[test]
fn the_bound_is_exact_for_twelve_generators_and_from_least_squares_for_more() {
    // With 12 generators the bound is the gauge itself. With five of length 1 along x, four of length 2 along y and
    // five of length 1 along z, the combination with the least squares has equal coefficients: 1/5, 1/8 and 1/5 for a
    // unit.
    let along = |k: usize, size: f64| {
        let mut g = [0.0; 3];
        g[k] = size;
        g
    };
    let mut forces = [[along(0, 1.0); 5], [along(2, 1.0); 5]].concat();
    forces.extend([along(1, 2.0), along(1, -2.0)]);
    assert_eq!(forces.len(), MAX_GENERATORS_TESTED_AT_ONCE);
    // One generator is oblique, so that the least squares would give another result.
    forces[4] = [1.0, 1.0, 1.0];
    let point = [2.0, 1.0, 0.5];
    assert_eq!(
        zonotope_gauge_bound(&forces, point),
        Some(zonotope_gauge(&forces, point))
    );
    forces[4] = along(0, 1.0);
    forces.extend([along(1, 2.0), along(1, 2.0)]);
    for way in ways() {
        let turned: Vec<Vec3> = forces.iter().map(|v| way(*v)).collect();
        for (point, most) in [
            ([1.0, 0.0, 0.0], 0.2),
            ([0.0, -4.0, 0.0], 0.5),
            ([0.0, 0.0, 2.0], 0.4),
            ([1.0, 4.0, -2.0], 0.5),
        ] {
            let scale = zonotope_gauge_bound(&turned, way(point)).expect("they span space");
            assert!((scale / most - 1.0).abs() < 1.1e-5, "{scale} for {most}");
            assert!(scale >= zonotope_gauge(&turned, way(point)));
        }
    }
}

#[test]
fn least_squares_give_no_bound_for_nearly_flat_zonotopes() {
    let mut seed = 9;
    let flat = |thick: f64, seed: &mut u64| -> Vec<Vec3> {
        let any = (0..20).map(|_| triple(seed));
        any.map(|[x, y, z]| [x, y, thick * z]).collect()
    };
    for way in ways() {
        let mut spans = |thick: f64| {
            let forces: Vec<Vec3> = flat(thick, &mut seed).into_iter().map(way).collect();
            zonotope_gauge_bound(&forces, way([1.0, 0.0, 0.0])).is_some()
        };
        assert!(spans(1.0) && spans(1e-3));
        assert!(!spans(1e-6) && !spans(0.0));
    }
    // Twenty generators along each axis; those along one axis have length t. The determinant of the Gram matrix is
    // then t²/8 times the cube of its trace.
    for axis in 0..3 {
        for (thick, some) in [(0.98, false), (1.02, true)] {
            let mut forces = Vec::new();
            for k in 0..3 {
                let mut g = [0.0; 3];
                g[k] = if k == axis {
                    thick * 8e-9_f64.sqrt()
                } else {
                    1.0
                };
                forces.extend([g; 20]);
            }
            assert_eq!(
                zonotope_gauge_bound(&forces, [1.0, 0.0, 0.0]).is_some(),
                some
            );
        }
    }
    assert_eq!(zonotope_gauge_bound(&[[0.0; 3]; 20], [1.0, 0.0, 0.0]), None);
    assert_eq!(
        zonotope_gauge_bound(&[[f64::NAN; 3]; 20], [1.0, 0.0, 0.0]),
        None
    );
}

#[test]
fn the_least_squares_bound_is_never_below_the_gauge() {
    let mut seed = 21;
    for _ in 0..100 {
        let g: Vec<Vec3> = (0..20).map(|_| triple(&mut seed)).collect();
        let amounts: Vec<f64> = g.iter().map(|_| chance(&mut seed)).collect();
        let point = combined(&g, &amounts);
        let (quick, least) = (
            zonotope_gauge_bound(&g, point).expect("they span space"),
            zonotope_gauge(&g, point),
        );
        // The bound's coefficients are the shortest vector that gives the point. Their largest is therefore no larger
        // than the norm of the given coefficients.
        let length: f64 = amounts.iter().map(|a| a * a).sum::<f64>().sqrt();
        assert!(
            least <= quick && quick <= 1.1 * length,
            "{least} {quick} {length}"
        );
        assert!(quick <= 4.0 * least, "{least} {quick}");
    }
}

#[test]
fn parallel_and_opposite_generators_are_added_up() {
    let found = reduced(vec![
        [1.0, 2.0, 2.0],
        [0.0; 3],
        [3.0, 0.0, 0.0],
        [-2.0, -4.0, -4.0],
        [0.5, 0.0, 0.0],
    ]);
    assert_eq!(found, [[3.0, 6.0, 6.0], [3.5, 0.0, 0.0]]);
    // Directions that differ by a millionth of a degree are not parallel.
    assert_eq!(reduced(vec![[1.0, 0.0, 0.0], [1.0, 2e-8, 0.0]]).len(), 2);
    assert_eq!(reduced(vec![[1.0, 0.0, 0.0], [1e-3, 2e-11, 0.0]]).len(), 2);
}

#[test]
fn of_more_than_forty_generators_the_pairs_that_lose_least_are_added_up() {
    let mut seed = 13;
    let unit = |v: Vec3| v.map(|x| x / norm(v));
    let apart: Vec<Vec3> = (0..MAX_GENERATORS)
        .map(|_| unit(triple(&mut seed)))
        .collect();
    assert_eq!(reduced(apart.clone()), apart, "forty stay as they are");
    // Only small generators that are perpendicular to others, and small differences between neighbours, are lost.
    // Generators of different directions are not merged.
    let few = &apart[..15];
    let mut all = few.to_vec();
    all.extend(
        few.iter()
            .map(|g| cross(*g, triple(&mut seed)).map(|x| 1e-7 * x)),
    );
    all.extend(
        few.iter()
            .map(|g| [g[0], g[1] + 1e-7, g[2] - 1e-7].map(|x| -x)),
    );
    let kept = reduced(all);
    assert_eq!(kept.len(), MAX_GENERATORS);
    let total = few.iter().map(|g| g.map(|x| 2.0 * x)).collect::<Vec<_>>();
    for _ in 0..50 {
        let n = unit(triple(&mut seed));
        let width = |all: &[Vec3]| all.iter().map(|g| dot(n, *g).abs()).sum::<f64>();
        assert!((width(&kept) - width(&total)).abs() < 1e-5);
    }
}

#[test]
fn a_merge_loses_the_perpendicular_part_of_the_shorter_generator() {
    // Two long generators differ by a ten-thousandth of a radian. Merging them loses less than merging a short
    // generator with any other.
    let mut seed = 29;
    let mut any = |size: f64| {
        let v = triple(&mut seed);
        v.map(|x| size * x / norm(v))
    };
    let mut all: Vec<Vec3> = (0..MAX_GENERATORS - 2).map(|_| any(10.0)).collect();
    let small = [any(0.03), any(0.03)];
    let across = cross(all[0], small[0]);
    let close = across.map(|x| 1e-3 * x / norm(across));
    all.extend([aligned_sum(all[0], close), small[0], small[1]]);
    let kept = reduced(all.clone());
    assert_eq!(kept.len(), MAX_GENERATORS);
    assert!(small.iter().all(|g| kept.contains(g)));
    assert!(kept.contains(&aligned_sum(all[0], all[MAX_GENERATORS - 2])));
}

#[test]
fn more_than_120_generators_are_first_added_up_by_direction() {
    let alike = |count: usize| -> Vec<Vec3> {
        let at = |k: usize| 0.1 + 1e-3 * k as f64;
        (0..count).map(|k| [1.0, at(k), 0.05]).collect()
    };
    assert_eq!(reduced(alike(MAX_PAIRED_GENERATORS)).len(), MAX_GENERATORS);
    let found = reduced(alike(MAX_PAIRED_GENERATORS + 1));
    assert_eq!(found.len(), 1, "all of them are in one cell");
    assert!((found[0][0] - 121.0).abs() < 1e-9);
}

#[test]
fn a_cell_contains_similar_directions() {
    let mut seed = 17;
    let mut first: Vec<Option<Vec3>> = vec![None; 3 * CELLS_PER_SIDE * CELLS_PER_SIDE];
    for _ in 0..5000 {
        let g = triple(&mut seed);
        let own = direction_cell(g);
        assert_eq!(own, direction_cell(g.map(|x| -3.0 * x)));
        let other = *first[own].get_or_insert(g);
        // A cell is a third of the half-width of a face wide and high.
        let sine = norm(cross(g, other)) / (norm(g) * norm(other));
        assert!(sine < 2f64.sqrt() / 3.0, "{g:?} {other:?}");
    }
    assert!(
        first.iter().all(Option::is_some),
        "every cell has directions"
    );
    // A direction along an edge of a face belongs to one of the outermost cells.
    assert_eq!(
        [
            direction_cell([1.0, 1.0, 1.0]),
            direction_cell([-1.0, 1.0, 1.0])
        ]
        .iter()
        .max(),
        Some(&107)
    );
}

#[test]
fn the_quick_bound_is_not_below_the_gauge_and_does_not_exist_for_flat_zonotopes() {
    let mut seed = 13;
    let mut bounded = 0;
    for turn in 0..3000 {
        let count = 3 + turn % 38;
        // Every second zonotope is thin along one axis, as if only the friction that is allowed for rounding acted
        // there.
        let thin = if turn % 2 == 0 { 3e-6 } else { 1.0 };
        let squeezed = |[x, y, z]: Vec3| [thin * x, y, z];
        let g: Vec<Vec3> = (0..count).map(|_| squeezed(triple(&mut seed))).collect();
        let point = squeezed(triple(&mut seed));
        let scale = zonotope_gauge(&g, point);
        if let Some(bound) = quick_gauge_bound(&g, point) {
            assert!(scale <= bound, "{scale} above {bound}");
            bounded += 1;
        }
    }
    assert!(bounded > 2500, "{bounded}");
    let plane = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.0]];
    let box_of = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    assert_eq!(quick_gauge_bound(&plane, [0.0, 0.0, 1e-12]), None);
    assert_eq!(quick_gauge_bound(&box_of, [f64::NAN, 0.0, 0.0]), None);
    assert_eq!(quick_gauge_bound(&[box_of[0]; 60], [1.0, 0.0, 0.0]), None);
}
