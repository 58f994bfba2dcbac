//! Tests of snapping: walls and arches whose corners are slightly off.

use super::*;

mod part;

fn ring(corners: &[(f64, f64)]) -> Rings {
    let corner = |p: &(f64, f64)| Corner { at: Point::new(p.0, p.1), curved: false };
    vec![corners.iter().map(corner).collect()]
}

/// Snaps all bodies with the same gap, in metres. Overlaps of up to 10⁻⁶ m are ignored.
fn snap_all(bodies: &[Rings], gap: f64) -> Outcome<'static> {
    let count = bodies.len();
    let outcome = snapped(bodies, Gaps::new(&vec![gap; count]), &vec![false; count], 1e-6 / gap);
    Outcome { bodies: Cow::Owned(outcome.bodies.into_owned()), moved: outcome.moved, kept: outcome.kept }
}

fn rectangle(x: f64, y: f64, w: f64, h: f64) -> Rings {
    ring(&[(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
}

/// Pseudo-random numbers between −1 and 1.
fn noise(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    ((*seed >> 33) as f64) / f64::from(1_u32 << 30) - 1.0
}

fn shaken(bodies: Vec<Rings>, by: f64) -> Vec<Rings> {
    let mut seed = 7;
    let shake = |mut rings: Rings| {
        for corner in rings.iter_mut().flatten() {
            corner.at += crate::geometry::Vector::new(by * noise(&mut seed), by * noise(&mut seed));
        }
        rings
    };
    bodies.into_iter().map(shake).collect()
}

/// The largest distance, in metres, of a corner from a side of another body that is less than `gap` away.
fn misfit(bodies: &[Rings], gap: f64) -> f64 {
    let mut worst = 0.0_f64;
    for (i, a) in bodies.iter().enumerate() {
        for (j, b) in bodies.iter().enumerate() {
            for p in a.iter().flatten().filter(|_| i != j) {
                for ring in b {
                    for (from, to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                        let along = (to.at - from.at).normalize();
                        let d = p.at - from.at;
                        let (s, off) = (d.dot(&along), d - along * d.dot(&along));
                        if s > 0.0 && s < (to.at - from.at).norm() && off.norm() < gap {
                            worst = worst.max(off.norm());
                        }
                    }
                }
            }
        }
    }
    worst
}

fn wall(columns: usize, rows: usize) -> Vec<Rings> {
    let mut bodies = vec![rectangle(-5.0, -1.0, columns as f64 + 10.0, 1.0)];
    for row in 0..rows {
        for column in 0..columns {
            let shift = 0.5 * (row % 2) as f64;
            bodies.push(rectangle(column as f64 + shift, 0.5 * row as f64, 1.0, 0.5));
        }
    }
    bodies
}

#[test]
fn the_joints_of_a_wall_with_slightly_wrong_corners_are_closed() {
    let drawn = shaken(wall(12, 7), 0.004);
    let outcome = snap_all(&drawn, 0.02);
    assert!(outcome.kept.is_empty(), "{:?}", outcome.kept);
    assert!(misfit(&drawn, 0.02) > 1e-3);
    assert!(misfit(&outcome.bodies, 0.02) < 1e-9, "{}", misfit(&outcome.bodies, 0.02));
    assert_eq!(damaged_bodies(&drawn, &outcome.bodies, &vec![1.0; drawn.len()], 1e-6), BTreeSet::new());
    for moved in &outcome.moved {
        assert!(moved.distance < 0.02 && !moved.to.is_empty(), "{moved:?}");
    }
}

#[test]
fn exact_bodies_stay_the_same_to_the_last_bit() {
    let drawn = wall(5, 4);
    let outcome = snap_all(&drawn, 0.02);
    assert!(outcome.moved.is_empty() && outcome.kept.is_empty());
    assert_eq!(outcome.bodies, drawn);
}

/// The bodies with x and y exchanged.
fn transposed(bodies: &[Rings]) -> Vec<Rings> {
    let mut bodies = bodies.to_vec();
    for corner in bodies.iter_mut().flatten().flatten() {
        corner.at = Point::new(corner.at.y, corner.at.x);
    }
    bodies
}

#[test]
fn vertical_joints_are_closed_like_horizontal_joints() {
    let gap = 0.02;
    for drawn in [wall(5, 4), wall(12, 7), steps()] {
        let drawn = shaken(drawn, 0.004);
        let (one, two) = (snap_all(&drawn, gap), snap_all(&transposed(&drawn), gap));
        assert!(misfit(&one.bodies, gap) < 1e-9 && !one.moved.is_empty());
        let two = transposed(&two.bodies);
        let corners = one.bodies.iter().flatten().flatten();
        for (a, b) in corners.zip(two.iter().flatten().flatten()) {
            assert!((a.at - b.at).norm() < 1e-9, "{a:?} {b:?}");
        }
    }
}

/// Ground, a wall on it at x = 2, and stones of several sizes that lean against it.
fn steps() -> Vec<Rings> {
    vec![
        rectangle(-3.0, -1.0, 6.0, 1.0),
        rectangle(2.0, 0.0, 1.0, 1.625),
        rectangle(0.0, 0.0, 2.0, 1.0),
        rectangle(1.125, 1.0, 0.5, 0.5),
        rectangle(1.375, 1.5, 0.625, 0.5),
        rectangle(1.625, 2.0, 0.375, 0.5),
    ]
}

#[test]
fn the_corners_of_an_exact_vertical_joint_do_not_move() {
    let drawn = steps();
    assert!(snap_all(&drawn, 0.0015).moved.is_empty());
    // If a corner of one stone is off, only this stone moves.
    let mut off = drawn.clone();
    off[5][0][0].at.y += 0.0004;
    let outcome = snap_all(&off, 0.0015);
    assert_eq!(outcome.moved.len(), 1);
    for (healed, meant) in outcome.bodies.iter().flatten().flatten().zip(drawn.iter().flatten().flatten()) {
        assert!((healed.at - meant.at).norm() < 1e-9, "{healed:?} {meant:?}");
    }
}

#[test]
fn a_body_thinner_than_the_gap_is_not_flattened() {
    let drawn = vec![rectangle(0.0, 0.0, 4.0, 1.0), rectangle(1.0, 1.0, 2.0, 0.01), rectangle(0.0, 1.01, 4.0, 1.0)];
    let outcome = snap_all(&drawn, 0.05);
    for (old, new) in drawn.iter().zip(outcome.bodies.iter()) {
        assert!(area(&new[0]) > 0.5 * area(&old[0]));
    }
    assert_eq!(damaged_bodies(&drawn, &outcome.bodies, &vec![1.0; drawn.len()], 1e-6), BTreeSet::new());
}

#[test]
fn the_earlier_body_stays_and_the_later_body_moves_to_it() {
    let drawn = vec![rectangle(-1.0, -1.0, 9.0, 1.0), rectangle(2.0, 0.003, 1.0, 2.0)];
    let outcome = snap_all(&drawn, 0.01);
    assert_eq!(outcome.bodies[0], drawn[0]);
    assert_eq!(outcome.bodies[1][0][0].at, Point::new(2.0, 0.0));
    assert_eq!(outcome.bodies[1][0][1].at, Point::new(3.0, 0.0));
    assert_eq!(outcome.moved.len(), 1);
    assert_eq!((outcome.moved[0].body, outcome.moved[0].corners), (1, 2));
    assert!((outcome.moved[0].distance - 0.003).abs() < 1e-12);
    // A joint that is wider than the gap stays open.
    assert!(snap_all(&drawn, 0.002).moved.is_empty());
}

#[test]
fn bodies_that_may_move_meet_half_way() {
    let drawn = [rectangle(0.0, -1.0, 9.0, 1.0), rectangle(1.0, 0.001, 2.0, 1.0), rectangle(2.998, 0.001, 2.0, 1.0)];
    let gaps = Gaps { moved_from: 1, ..Gaps::new(&[0.01; 3]) };
    let bodies = snapped(&drawn, gaps, &[false; 3], 1e-4).bodies;
    let right = |body: usize| bodies[body][0].iter().map(|corner| corner.at.x).fold(f64::MIN, f64::max);
    let left = |body: usize| bodies[body][0].iter().map(|corner| corner.at.x).fold(f64::MAX, f64::min);
    assert!((right(1) - 2.999).abs() < 1e-12 && (left(2) - 2.999).abs() < 1e-12, "{bodies:?}");
    assert_eq!(bodies[0], drawn[0], "the ground stays");
    assert_eq!(bodies[1][0][0].at.y, 0.0);
}

#[test]
fn an_overlap_of_less_than_the_gap_is_closed_and_a_deep_overlap_stays() {
    let shallow = vec![rectangle(0.0, 0.0, 4.0, 1.0), rectangle(1.0, 0.996, 2.0, 1.0)];
    let healed = snap_all(&shallow, 0.01);
    assert!(misfit(&healed.bodies, 0.01) < 1e-12);
    let deep = vec![rectangle(0.0, 0.0, 4.0, 1.0), rectangle(1.0, 0.7, 2.0, 1.0)];
    assert_eq!(snap_all(&deep, 0.01).bodies, deep);
}

#[test]
fn touching_curves_share_corners() {
    let arc = |steps: usize, radius: f64, back: bool| {
        let mut points: Vec<Corner> = (0..=steps)
            .map(|k| {
                let (sin, cos) = libm::sincos(core::f64::consts::PI * (0.25 + 0.5 * k as f64 / steps as f64));
                Corner { at: Point::new(radius * cos, radius * sin), curved: true }
            })
            .collect();
        if back {
            points.reverse();
        }
        if let Some(last) = points.last_mut() {
            last.curved = false;
        }
        points
    };
    let band = |inner: f64, outer: f64, steps: [usize; 2]| {
        let mut ring = arc(steps[1], outer, false);
        ring.extend(arc(steps[0], inner, true));
        vec![ring]
    };
    let drawn = vec![band(1.0, 2.0, [9, 14]), band(2.0, 3.0, [11, 14])];
    let gap = 2.0 * (1.0 - libm::cos(core::f64::consts::PI / 44.0)) + 1e-3;
    let outcome = snap_all(&drawn, gap);
    assert!(outcome.kept.is_empty());
    assert!(misfit(&outcome.bodies, gap) < 1e-12, "{}", misfit(&outcome.bodies, gap));
    assert_eq!(outcome.bodies[0][0].len(), drawn[0][0].len() + 10);
}

#[test]
fn each_move_lists_its_corners_its_distance_and_its_targets() {
    // Two stones side by side on a slab, the second 4 mm too far to the right. A third stone stands farther away. A
    // triangle has a corner close to the upper right corner of the second stone.
    let bodies = [
        rectangle(-5.0, -1.0, 20.0, 1.0),
        rectangle(0.0, 0.0, 1.0, 1.0),
        rectangle(1.004, 0.0, 1.0, 1.0),
        rectangle(8.0, 0.0, 1.0, 1.0),
        ring(&[(2.003, 1.004), (3.0, 3.0), (2.0, 3.0)]),
    ];
    let outcome = snap_all(&bodies, 0.01);
    let moved = |body: usize| outcome.moved.iter().find(|m| m.body == body);
    assert_eq!(outcome.moved.len(), 2);
    let second = moved(2).expect("the second stone moves");
    assert_eq!((second.corners, &second.to), (2, &BTreeSet::from([0, 1, 4])));
    assert!((second.distance - 0.004).abs() < 1e-12);
    let last = moved(4).expect("the triangle moves");
    assert_eq!((last.corners, &last.to), (1, &BTreeSet::from([2])));
    assert!((last.distance - libm::hypot(0.001, 0.004)).abs() < 1e-12);
    // An earlier body moves to a side of a later body.
    let tip = ring(&[(2.0, 1.004), (3.0, 5.0), (1.0, 5.0)]);
    let outcome = snap_all(&[tip, rectangle(0.0, 0.0, 4.0, 1.0)], 0.01);
    let wanted = Moved { body: 0, corners: 1, distance: outcome.moved[0].distance, to: BTreeSet::from([1]) };
    assert_eq!(outcome.moved, [wanted]);
    assert!((outcome.moved[0].distance - 0.004).abs() < 1e-12);
    assert_eq!(outcome.bodies[0][0][0].at, Point::new(2.0, 1.0));
}

#[test]
fn a_body_without_a_gap_does_not_take_part() {
    let drawn = vec![rectangle(0.0, 0.0, 4.0, 1.0), rectangle(0.003, 1.003, 1.0, 1.0), rectangle(2.0, 1.003, 1.0, 1.0)];
    let outcome = snapped(&drawn, Gaps::new(&[0.01, 0.0, 0.01]), &[false; 3], 1e-4);
    assert_eq!(outcome.moved.len(), 1);
    assert_eq!(outcome.moved[0].body, 2);
    assert_eq!(outcome.bodies[..2], drawn[..2]);
}

#[test]
fn a_fixed_body_stays_and_is_not_listed_as_kept() {
    let drawn = vec![rectangle(0.0, 0.003, 4.0, 1.0), rectangle(-1.0, -1.0, 9.0, 1.0)];
    // The later body is fixed, so the earlier body moves to it.
    let outcome = snapped(&drawn, Gaps::new(&[0.01; 2]), &[false, true], 1e-4);
    assert_eq!((outcome.moved.len(), outcome.kept.len()), (1, 0));
    assert_eq!(outcome.moved[0].body, 0);
    assert_eq!(outcome.bodies[1], drawn[1]);
    assert!(outcome.bodies[0][0][0].at.coords.norm() < 1e-12);
    // A sliver 1 mm away from the stone would be flattened. It stays, and is listed as kept.
    let mut sliver = drawn.clone();
    sliver.push(ring(&[(4.001, 0.5), (4.003, 0.5), (4.003, 0.9), (4.001, 0.9)]));
    let outcome = snapped(&sliver, Gaps::new(&[0.01; 3]), &[false, true, false], 1e-4);
    assert_eq!(outcome.kept, [2]);
    assert_eq!(outcome.bodies[2], sliver[2]);
    assert_eq!(outcome.bodies[1], sliver[1]);
}

#[test]
fn a_corner_that_lies_on_a_curve_is_inserted_into_it() {
    // The tip touches a side. A straight side needs no corner at the tip, but a side that approximates a curve does.
    let tip = ring(&[(1.5, 1.0), (2.5, 5.0), (0.5, 5.0)]);
    let mut drawn = vec![rectangle(0.0, 0.0, 4.0, 1.0), tip];
    assert_eq!(snap_all(&drawn, 0.01).bodies, drawn);
    drawn[0][0][2].curved = true;
    let outcome = snap_all(&drawn, 0.01);
    let (tip, from) = (drawn[1][0][0].at, drawn[0][0][2]);
    let mut wanted = drawn.clone();
    wanted[0][0].insert(3, Corner { at: tip, ..from });
    assert_eq!(outcome.bodies, wanted);
    assert_eq!((outcome.moved.len(), outcome.moved[0].body), (1, 0));
    assert_eq!((outcome.moved[0].corners, outcome.moved[0].distance), (1, 0.0));
}

#[test]
fn several_corners_are_inserted_into_a_curve_in_order() {
    let tip = |x: f64| ring(&[(x, 1.004), (x + 0.5, 5.0), (x - 0.5, 5.0)]);
    let mut drawn = vec![rectangle(0.0, 0.0, 4.0, 1.0), tip(1.0), tip(3.0), tip(2.0)];
    drawn[0][0][2].curved = true;
    let outcome = snap_all(&drawn, 0.01);
    let upper: Vec<f64> = outcome.bodies[0][0][2..].iter().map(|c| c.at.x).collect();
    assert_eq!(upper, [4.0, 3.0, 2.0, 1.0, 0.0]);
    assert_eq!(outcome.moved.len(), 1);
    assert_eq!((outcome.moved[0].corners, outcome.moved[0].distance), (3, 0.0));
    assert_eq!(outcome.moved[0].to, BTreeSet::from([1, 2, 3]));
}
