//! Tests of the upper bounds of the gauge, and of the reduction of many generators to few.

use super::*;

fn reduced(list: Vec<Vec3>) -> Vec<Vec3> {
    reduce(list.into_iter())
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
    assert_eq!(zonotope_gauge_bound(&forces, point), Some(zonotope_gauge(&forces, point)));
    forces[4] = along(0, 1.0);
    forces.extend([along(1, 2.0), along(1, 2.0)]);
    for way in ways() {
        let turned: Vec<Vec3> = forces.iter().map(|v| way(*v)).collect();
        for (point, most) in
            [([1.0, 0.0, 0.0], 0.2), ([0.0, -4.0, 0.0], 0.5), ([0.0, 0.0, 2.0], 0.4), ([1.0, 4.0, -2.0], 0.5)]
        {
            let scale = zonotope_gauge_bound(&turned, way(point)).expect("generators that span space");
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
                g[k] = if k == axis { thick * 8e-9_f64.sqrt() } else { 1.0 };
                forces.extend([g; 20]);
            }
            assert_eq!(zonotope_gauge_bound(&forces, [1.0, 0.0, 0.0]).is_some(), some);
        }
    }
    assert_eq!(zonotope_gauge_bound(&[[0.0; 3]; 20], [1.0, 0.0, 0.0]), None);
    assert_eq!(zonotope_gauge_bound(&[[f64::NAN; 3]; 20], [1.0, 0.0, 0.0]), None);
}

#[test]
fn the_least_squares_bound_is_never_below_the_gauge() {
    let mut seed = 21;
    for _ in 0..100 {
        let g: Vec<Vec3> = (0..20).map(|_| triple(&mut seed)).collect();
        let amounts: Vec<f64> = g.iter().map(|_| chance(&mut seed)).collect();
        let point = combined(&g, &amounts);
        let (quick, least) =
            (zonotope_gauge_bound(&g, point).expect("generators that span space"), zonotope_gauge(&g, point));
        // The bound's coefficients are the shortest vector that gives the point. Their largest is therefore no larger
        // than the norm of the given coefficients.
        let length: f64 = amounts.iter().map(|a| a * a).sum::<f64>().sqrt();
        assert!(least <= quick && quick <= 1.1 * length, "{least} {quick} {length}");
        assert!(quick <= 4.0 * least, "{least} {quick}");
    }
}

#[test]
fn the_quick_bound_is_not_below_the_gauge_and_does_not_exist_for_flat_zonotopes() {
    let mut seed = 13;
    let mut bounded = 0;
    for turn in 0..3000 {
        let count = 3 + turn % 38;
        // Every second zonotope is thin along x, like the forces on a body without friction: only the small friction
        // that allows for rounding acts along x.
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

#[test]
fn reducing_hundreds_of_generators_never_makes_the_gauge_smaller() {
    let mut seed = 5;
    for count in [60, 200, 900] {
        let g: Vec<Vec3> = (0..count).map(|_| triple(&mut seed)).collect();
        let n = triple(&mut seed);
        let far: Vec<f64> = g.iter().map(|v| dot(n, *v).signum()).collect();
        let point = combined(&g, &far);
        let scale = zonotope_gauge(&g, point);
        assert!((1.0..1.2).contains(&scale), "{count}: {scale}");
        let quick = zonotope_gauge_bound(&g, point).expect("random generators span space");
        assert!((1.0..3.0).contains(&quick), "{count}: {quick}");
    }
}

#[test]
fn parallel_and_opposite_generators_are_added_up() {
    let found = reduced(vec![[1.0, 2.0, 2.0], [0.0; 3], [3.0, 0.0, 0.0], [-2.0, -4.0, -4.0], [0.5, 0.0, 0.0]]);
    assert_eq!(found, [[3.0, 6.0, 6.0], [3.5, 0.0, 0.0]]);
    // Directions that differ by a millionth of a degree are not parallel.
    assert_eq!(reduced(vec![[1.0, 0.0, 0.0], [1.0, 2e-8, 0.0]]).len(), 2);
    assert_eq!(reduced(vec![[1.0, 0.0, 0.0], [1e-3, 2e-11, 0.0]]).len(), 2);
}

#[test]
fn of_more_than_forty_generators_the_pairs_that_lose_least_are_added_up() {
    let mut seed = 13;
    let unit = |v: Vec3| v.map(|x| x / norm(v));
    let apart: Vec<Vec3> = (0..MAX_GENERATORS).map(|_| unit(triple(&mut seed))).collect();
    assert_eq!(reduced(apart.clone()), apart, "forty generators are not merged");
    // Only small generators that are perpendicular to others, and small differences between neighbours, are lost.
    // Generators of different directions are not merged.
    let few = &apart[..15];
    let mut all = few.to_vec();
    all.extend(few.iter().map(|g| cross(*g, triple(&mut seed)).map(|x| 1e-7 * x)));
    all.extend(few.iter().map(|g| [g[0], g[1] + 1e-7, g[2] - 1e-7].map(|x| -x)));
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
        // The width and the height of a cell are a third of the half-width of a cube face.
        let sine = norm(cross(g, other)) / (norm(g) * norm(other));
        assert!(sine < 2f64.sqrt() / 3.0, "{g:?} {other:?}");
    }
    assert!(first.iter().all(Option::is_some), "every cell contains a direction");
    // A direction along an edge of a face belongs to one of the outermost cells.
    assert_eq!([direction_cell([1.0, 1.0, 1.0]), direction_cell([-1.0, 1.0, 1.0])].iter().max(), Some(&107));
}
