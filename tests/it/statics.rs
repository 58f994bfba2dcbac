//! Results that were computed by hand. The structures are asymmetric, so that a wrong sign is noticed.

use drystone::analysis::{Failure, Verdict};
use serde_json::json;

use crate::structure::{arch, block, first, harmonic, on_floor, on_slope, rectangle, verdict, wall};

const STANDS: Verdict = Verdict::Stable;
const FALLS: Verdict = Verdict::Unstable;

#[test]
fn a_block_slides_if_the_slope_is_steeper_than_the_friction_angle() {
    for friction in [0.1, 0.35, 0.7, 1.2] {
        let limit = libm::atan(friction).to_degrees();
        for sign in [1.0, -1.0] {
            assert_eq!(verdict(&on_slope(sign * (limit - 0.001), 4.0, 1.0, friction, 0.0)), STANDS, "{friction}");
            assert_eq!(verdict(&on_slope(sign * (limit + 0.001), 4.0, 1.0, friction, 0.0)), FALLS, "{friction}");
        }
    }
}

#[test]
fn the_failure_of_a_sliding_block_is_the_missing_friction() {
    let (degrees, friction, weight): (f64, f64, f64) = (30.0, 0.2, 5.0);
    let frame = first(&on_slope(degrees, 4.0, 1.0, friction, 0.0));
    let [Failure::Friction { force, .. }] = frame.failures[..] else { panic!("{:?}", frame.failures) };
    let angle = degrees.to_radians();
    let missing = weight * (libm::sin(angle) - friction * libm::cos(angle));
    assert!((force.norm() - missing).abs() < 1e-9);
    // The missing force points up the slope, which rises to the right.
    assert!(force.x > 0.0 && force.y > 0.0);
    assert!((frame.total_sticking - missing).abs() < 1e-9);
    // In rigid plasticity a sliding contact opens by μ per unit of slip, so the block moves at the angle arctan μ to
    // the slope.
    let motion = frame.mechanism[0];
    let heading = angle - libm::atan(friction);
    assert!((motion.velocity.x + libm::cos(heading)).abs() < 1e-6 && motion.spin.abs() < 1e-6, "{motion:?}");
    assert!((motion.velocity.y + libm::sin(heading)).abs() < 1e-6, "{motion:?}");
}

#[test]
fn a_block_topples_if_its_weight_acts_outside_the_kernel() {
    let (width, height): (f64, f64) = (1.0, 3.0);
    for kernel in [0.0, 0.2, 0.6] {
        let limit = libm::atan(width * (1.0 - kernel) / height).to_degrees();
        for sign in [1.0, -1.0] {
            assert_eq!(verdict(&on_slope(sign * (limit - 0.001), width, height, 5.0, kernel)), STANDS, "{kernel}");
            assert_eq!(verdict(&on_slope(sign * (limit + 0.001), width, height, 5.0, kernel)), FALLS, "{kernel}");
        }
    }
}

#[test]
fn a_toppling_block_turns_about_its_lower_corner() {
    let frame = first(&on_slope(25.0, 1.0, 3.0, 5.0, 0.0));
    let motion = frame.mechanism[0];
    // The block turns anticlockwise, downhill to the left. Its lower left corner, (−0.3, 0) rotated by 25°, does not
    // move.
    assert!(motion.spin > 0.0);
    let corner = drystone::internals::geometry::Point::new(
        -0.3 * libm::cos(0.4363323129985824),
        -0.3 * libm::sin(0.4363323129985824),
    );
    let scene = crate::structure::scene(&on_slope(25.0, 1.0, 3.0, 5.0, 0.0));
    assert!(motion.at(&scene, corner).norm() < 1e-6);
}

#[test]
fn the_harmonic_stack_stands_up_to_its_limit() {
    for n in [1, 2, 5, 10, 30] {
        assert_eq!(verdict(&harmonic(n, 0.999)), STANDS, "{n} bricks");
        assert_eq!(verdict(&harmonic(n, 1.001)), FALLS, "{n} bricks");
    }
}

#[test]
fn a_semicircular_arch_needs_milankovitchs_thickness() {
    assert_eq!(verdict(&arch(181, 0.107, 0.7)), FALLS);
    assert_eq!(verdict(&arch(181, 0.108, 0.7)), STANDS);
}

#[test]
fn a_thick_arch_needs_the_known_least_friction() {
    // The smallest μ of a thick semicircular arch with radial joints is 0.3092.
    assert_eq!(verdict(&arch(181, 0.3, 0.305)), FALLS);
    assert_eq!(verdict(&arch(181, 0.3, 0.315)), STANDS);
}

#[test]
fn an_interlocking_wall_stands_without_thrust() {
    let frame = first(&wall(6, 5));
    assert_eq!(frame.verdict, STANDS);
    let floor: f64 = frame
        .contacts
        .iter()
        .filter(|c| matches!(c.interface.bodies[1], drystone::scene::BodyId::Ground(_)))
        .map(|c| c.normal_forces[0] + c.normal_forces[1])
        .sum();
    assert!((floor - frame.weight).abs() < 1e-9 * frame.weight);
    // Adjacent bricks of a course do not push each other.
    for contact in frame.contacts.iter().filter(|c| c.interface.normal.x.abs() > 0.5) {
        assert_eq!(contact.normal_forces, [0.0, 0.0]);
    }
}

#[test]
fn a_leg_hangs_from_a_bar_only_if_they_are_one_block() {
    let mut file = json!({ "drystone": 1, "friction": 0.4,
        "ground": [{ "polygon": rectangle(-3.0, 0.0, 1.5, 1.0) }, { "polygon": rectangle(1.5, 0.0, 1.5, 1.0) }],
        "blocks": [block("bar", rectangle(-2.0, 1.0, 4.0, 1.0), 3.0), block("leg", rectangle(-0.5, 0.0, 1.0, 1.0), 1.0)] });
    // Without adhesion the leg falls and the bar stays.
    let cut = first(&file);
    assert_eq!(cut.verdict, FALLS);
    assert!(cut.mechanism.iter().all(|m| m.block.0 == 1), "{:?}", cut.mechanism);
    let tee = json!([[-2, 1], [-0.5, 1], [-0.5, 0], [0.5, 0], [0.5, 1], [2, 1], [2, 2], [-2, 2]]);
    file["blocks"] = json!([block("tee", tee, 4.0)]);
    assert_eq!(verdict(&file), STANDS);
}

#[test]
fn two_supports_carry_an_eccentric_load_by_the_law_of_the_lever() {
    // A beam of 6 N from x = 0 to x = 6 on two posts, from 0 to 1 and from 5 to 6, with a load of 9 N at x = 2.
    let mut file = on_floor(
        0.5,
        vec![
            block("left", rectangle(0.0, 0.0, 1.0, 2.0), 1.0),
            block("right", rectangle(5.0, 0.0, 1.0, 2.0), 1.0),
            block("beam", rectangle(0.0, 2.0, 6.0, 0.5), 6.0),
        ],
    );
    file["loads"] = json!([{ "block": "beam", "force": [0, -9], "at": [2, 2.5] }]);
    file["kernel"] = json!(1.0);
    // With kernel 1 each post carries the beam in its middle, at x = 0.5 and x = 5.5, so the beam is statically
    // determinate.
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS);
    let right = (6.0 * (3.0 - 0.5) + 9.0 * (2.0 - 0.5)) / 5.0;
    let carried = |x: f64| {
        let contact = frame.contacts.iter().find(|c| c.resultant.at.y == 2.0 && (c.resultant.at.x - x).abs() < 1e-9);
        contact.map(|c| c.resultant.force.y).unwrap_or(f64::NAN)
    };
    assert!((carried(5.5) - right).abs() < 1e-9, "{} {right}", carried(5.5));
    assert!((carried(0.5) - (15.0 - right)).abs() < 1e-9);
}

#[test]
fn a_block_rests_on_the_edge_of_a_hole_and_in_the_middle_of_three() {
    // A frame, and a block on the lower edge of its hole.
    let frame_block = json!({ "id": "frame", "polygon": rectangle(0.0, 0.0, 6.0, 6.0),
        "holes": [rectangle(1.0, 1.0, 4.0, 4.0)], "weight": 10 });
    let file = on_floor(0.5, vec![frame_block, block("inside", rectangle(1.5, 1.0, 1.0, 2.0), 3.0)]);
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS);
    assert_eq!(frame.contacts.len(), 2);
    // Three blocks side by side on one edge have three interfaces with it.
    let three = on_floor(
        0.5,
        vec![
            block("base", rectangle(0.0, 0.0, 6.0, 1.0), 4.0),
            block("a", rectangle(0.0, 1.0, 2.0, 1.0), 1.0),
            block("b", rectangle(2.0, 1.0, 1.0, 1.0), 1.0),
            block("c", rectangle(3.0, 1.0, 3.0, 1.0), 1.0),
        ],
    );
    let frame = first(&three);
    let on_base = frame.contacts.iter().filter(|c| c.interface.ends[0].y == 1.0 && c.interface.ends[1].y == 1.0);
    assert_eq!(on_base.count(), 3);
    assert_eq!(frame.verdict, STANDS);
}

#[test]
fn a_block_without_contacts_falls_freely() {
    let file = on_floor(0.5, vec![block("up", rectangle(0.0, 3.0, 1.0, 1.0), 2.0)]);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    assert_eq!(frame.unsupported.len(), 1);
    assert_eq!(frame.mechanism[0].velocity.y, -1.0);
    assert_eq!(frame.total_sticking, 0.0);
}

#[test]
fn an_additional_corner_on_a_straight_edge_changes_nothing() {
    let mut plain = on_floor(0.5, vec![block("a", rectangle(0.0, 0.0, 2.0, 1.0), 6.0)]);
    plain["kernel"] = json!(0.3);
    let mut notched = plain.clone();
    notched["blocks"][0]["polygon"] = json!([[0, 0], [0.7, 0], [2, 0], [2, 1], [0, 1]]);
    let (a, b) = (first(&plain), first(&notched));
    assert_eq!(a.contacts.len(), 1);
    assert_eq!(b.contacts.len(), 1);
    let (p, q) = (&a.contacts[0], &b.contacts[0]);
    assert!((p.application_points[0] - q.application_points[0]).norm() < 1e-12);
    assert!((p.normal_forces[0] - q.normal_forces[0]).abs() < 1e-9);
}

#[test]
fn a_robot_carries_force_up_to_its_limit_and_the_rest_is_reported() {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 1.0, 1.0), 8.0)]);
    file["robots"] = json!([{ "id": "r", "holds": "a", "limits": { "fx": 10, "fy": 5, "torque": 0 } }]);
    let frame = first(&file);
    assert_eq!(frame.verdict, FALLS);
    let [Failure::RobotForce { force, .. }] = frame.failures[..] else { panic!("{:?}", frame.failures) };
    assert!((force.y - 3.0).abs() < 1e-9 && force.x.abs() < 1e-9);
    assert!((frame.robots[0].force.y - 5.0).abs() < 1e-9);
    file["robots"][0]["limits"]["fy"] = json!(8.001);
    let frame = first(&file);
    assert_eq!(frame.verdict, STANDS);
    assert!((frame.robots[0].limit_used - 8.0 / 8.001).abs() < 1e-9);
}

#[test]
fn a_robot_that_grips_off_centre_needs_a_torque() {
    let mut file = on_floor(0.5, vec![block("a", rectangle(0.0, 3.0, 2.0, 1.0), 8.0)]);
    file["robots"] = json!([{ "id": "r", "holds": "a", "at": [0.25, 3.5] }]);
    let frame = first(&file);
    // The weight acts 0.75 m to the right of the grip and turns the block clockwise. The missing torque acts
    // anticlockwise.
    let [Failure::RobotTorque { torque, .. }] = frame.failures[..] else { panic!("{:?}", frame.failures) };
    assert!((torque - 6.0).abs() < 1e-9);
    file["robots"][0]["limits"] = json!({ "torque": 6.001 });
    assert_eq!(verdict(&file), STANDS);
}

#[test]
fn the_normal_force_of_a_tip_on_a_slope_is_perpendicular_to_the_slope() {
    // A slope that rises by 3 in 4, and a triangle on its tip, with the centroid vertically above the tip.
    let balanced = |friction: f64| {
        json!({ "drystone": 1, "friction": friction, "corner_contacts": true,
            "ground": [{ "polygon": [[-4, -3], [-4, -5], [4, -5], [4, 3]] }],
            "blocks": [{ "id": "tip", "polygon": [[0, 0], [1, 2], [-1, 2]], "weight": 10 }] })
    };
    let frame = first(&balanced(0.76));
    assert_eq!(frame.verdict, STANDS);
    let [contact] = &frame.contacts[..] else { panic!("{:?}", frame.contacts) };
    let normal = contact.interface.normal;
    assert!((normal.x + 0.6).abs() < 1e-12 && (normal.y - 0.8).abs() < 1e-12);
    let normal_force: f64 = contact.normal_forces.iter().sum();
    assert!((normal_force - 8.0).abs() < 1e-7, "{normal_force}");
    assert!((contact.friction_force.abs() - 6.0).abs() < 1e-7);
    assert_eq!(verdict(&balanced(0.74)), FALLS);
}
