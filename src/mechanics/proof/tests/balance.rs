//! Tests of the imbalance of one block: which forces count in it, and which rounding errors are allowed.

use super::*;

/// A stone of this weight, in newtons, between two parts of the ground: one below and one above.
fn squeezed(weight: f64, friction: f64, listed: LoadVector) -> Assembly {
    let mut above = joint(0, None, 3.0);
    above.normal = Vector::new(0.0, -1.0);
    above.ends.swap(0, 1);
    above.points.swap(0, 1);
    let mut assembly = assembly(vec![body(0, 0.0, 3.0, weight, listed)], vec![joint(0, None, 0.0), above]);
    assembly.contacts.iter_mut().for_each(|c| c.friction = friction);
    assembly
}

/// The force that is allowed for rounding, in newtons: 16 ε Σ |F| at τ = 10⁻⁹. `total` is Σ |F|.
fn granted(total: f64) -> f64 {
    16.0 * f64::EPSILON / 1e-9 * total
}

#[test]
fn the_torques_of_loads_and_robots_count_separately() {
    // 7 N·m of load and −8 N·m of a robot leave 1 N·m, which is 0.4 N at the radius of 2.5 m. Moving 20 N of forces
    // counts 20 N, the load 2.8 N, the robot 3.2 N, and the two points of the joint 4 N.
    let mut held = on_ground(listed(0.0, 0.0, 7.0));
    held.grips = vec![grip(0, 2.0, 4.0, 9.0)];
    let exerted = GripForces { force: Vector::zeros(), torque: -8.0 };
    let all = found(&held, vec![pressed(5.0, 5.0, 0.0)], vec![exerted]);
    assert_near(all[0], 0.4 / 30.0, 1e-6);
    assert_near(all[1], 0.4 / 12.8, 1e-15);
}

#[test]
fn the_load_may_change_by_the_rounding_error_of_all_forces() {
    // A push of 10⁻¹⁵ N to the side. The joint has no friction, so no other force acts in this direction.
    let pushed = on_ground(listed(1e-15, 0.0, 0.0)).with_friction(0.0);
    let found = found(&pushed, vec![pressed(5.0, 5.0, 0.0)], vec![])[0];
    let expected = 1e-15 / granted(20.0);
    assert!(found >= 0.99 * expected && found < 3.0 * expected, "{found} {expected}");
}

#[test]
fn friction_may_change_by_the_rounding_error_within_its_cone() {
    let side = 1e-8;
    let light = |friction: f64| squeezed(1e-9, friction, listed(side, 0.0, 0.0));
    let imbalance = |friction: f64, at: [ContactForces; 2]| found(&light(friction), at.into(), vec![])[0];
    let both = |f: f64| [pressed(1000.0, 1000.0, f), pressed(1000.0, 1000.0, f)];
    // The friction of each joint is allowed 16 ε · 4 000 N/10⁻⁹. The load's own 10⁻⁸ N are negligible.
    let cones = 2.0 * granted(4000.0);
    assert_near(imbalance(0.5, both(0.0)) / (side / cones), 1.0, 1e-3);
    // Friction that already acts changes nothing as long as it is less than the allowed rounding. The two friction
    // forces are equal and opposite. Their moment of 3 m · f is balanced by the joint below, whose points are 2 m
    // apart.
    let rubbing = |f: f64| {
        let below = pressed(1000.0 + 1.5 * f, 1000.0 - 1.5 * f, f);
        [below, pressed(1000.0, 1000.0, f)]
    };
    let given = rubbing(5e-3);
    assert_near(imbalance(0.5, given) / (side / cones), 1.0, 1e-3);
    // Friction that exceeds the allowed rounding counts with its full value.
    let more = rubbing(0.5);
    assert_near(imbalance(0.5, more) / side, 1.0, 1e-3);
    // The result is the same if each joint is pressed at one point only, with 2 000 N.
    let one = [pressed(2000.0, 0.0, 0.0), pressed(0.0, 2000.0, 0.0)];
    assert_near(imbalance(0.5, one) / (side / cones), 1.0, 1e-3);
    // With a friction coefficient of 2.5·10⁻⁷ the cone of each joint is 5·10⁻⁴ N, less than the allowed amount.
    let narrow = imbalance(2.5e-7, both(0.0));
    assert_near(narrow / (side / 1e-3), 1.0, 1e-3);
    // Without friction only the load is allowed to change: 2.1·10⁻⁸ N for a residual of 10⁻⁸ N.
    assert!(imbalance(0.0, both(0.0)) > 0.4);
}

/// A stone without weight has no load to which its residual could be relative. Only friction can balance it.
#[test]
fn a_stone_without_load_has_a_share_of_zero() {
    let idle = squeezed(0.0, 0.5, LoadVector::ZERO);
    let at = [pressed(10.0, 10.0, 1.0), pressed(10.0, 10.0, 2.0)];
    let all = found(&idle, at.into(), vec![]);
    assert_eq!(all[1], 0.0);
    // The residual is 1 N to the side. The friction forces sum to 3 N.
    assert_near(all[0], 1.0 / 3.0, 1e-3);
    let balanced = [pressed(10.0, 10.0, 0.0), pressed(10.0, 10.0, 0.0)];
    assert_eq!(found(&idle, balanced.into(), vec![]), [0.0; 4]);
}

/// The imbalance is relative to the block's own forces: it stays the same if all forces are a billion times smaller
/// or larger.
#[test]
fn imbalance_does_not_depend_on_the_unit_of_force() {
    let alone = |unit: f64| {
        let mut box_alone = on_ground(LoadVector::ZERO);
        box_alone.bodies[0].weight = 10.0 * unit;
        let box_alone = box_alone.with_summed_loads();
        let all = found(&box_alone, vec![pressed(5.5 * unit, 5.5 * unit, 0.0)], vec![]);
        (all[0], all[1])
    };
    let (imbalance, share) = alone(1.0);
    for unit in [1e-9, 1e9] {
        let (other, other_share) = alone(unit);
        assert_near(other / imbalance, 1.0, 1e-9);
        assert_near(other_share / share, 1.0, 1e-9);
    }
}

/// A box of 9 N on five narrow joints, pressed with 1 N at each of their ten points. Each of these forces and the
/// weight must change by the same fraction.
#[test]
fn many_small_forces_count_as_much_as_a_few_large_ones() {
    let joints = (0..5_u8).map(|k| {
        let mut narrow = joint(0, None, 0.0);
        let at = |x: f64| Point::new(2.0 + 0.5 * (f64::from(k) - 2.0) + x, 0.0);
        (narrow.ends, narrow.points) = ([at(0.2), at(-0.2)], [at(0.1), at(-0.1)]);
        narrow
    });
    let assembly = assembly(vec![body(0, 0.0, 3.0, 9.0, LoadVector::ZERO)], joints.collect());
    // The friction forces balance each other, so they change neither result.
    let rubbing = [0.4, -0.4, 0.4, -0.4, 0.0].map(|f| pressed(1.0, 1.0, f));
    let all = found(&assembly, rubbing.into(), vec![]);
    assert_near(all[0], 1.0 / 19.0, 1e-5);
    assert_near(all[1], 1.0 / 9.0, 1e-14);
}

/// Only the joint below the stone has friction. The allowance is the same whether the stone is 3 mm, 3 m or 3 km
/// high.
#[test]
fn imbalance_does_not_depend_on_the_unit_of_length() {
    let side = 1e-8;
    for scale in [1e-3, 1.0, 1e3] {
        let mut stone = squeezed(1e-9, 0.5, listed(side, 0.0, 0.0));
        stone.contacts[1].friction = 0.0;
        let longer = |p: Point| Point::from(p.coords * scale);
        for body in &mut stone.bodies {
            body.centroid = longer(body.centroid);
            body.corners = body.corners.iter().map(|p| longer(*p)).collect();
        }
        for contact in &mut stone.contacts {
            contact.ends = contact.ends.map(longer);
            contact.points = contact.points.map(longer);
        }
        let pressed = [pressed(1000.0, 1000.0, 0.0); 2];
        let all = found(&stone, pressed.into(), vec![]);
        assert_near(all[0] / (side / granted(4000.0)), 1.0, 1e-3);
    }
}
