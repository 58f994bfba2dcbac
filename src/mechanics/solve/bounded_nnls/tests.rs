//! Tests of the active-set method, with answers by hand.

use super::*;
use crate::geometry::Vector;
use crate::mechanics::program::{ContactTerm, GripTerm, Scale};
use crate::mechanics::statics::interface::ContactKind;

/// A block 2 wide and 1 high, pressed down by 10 at a distance `x` from its middle, and pushed by `push` at its
/// centre. The friction coefficient of the ground is 0.5.
fn block(x: f64, push: f64, grips: Vec<GripTerm>) -> Program {
    let arms = [Vector::new(1.0, -0.5), Vector::new(-1.0, -0.5)];
    Program {
        blocks: 1,
        loads: vec![-push, 10.0, 10.0 * x],
        contacts: vec![ContactTerm {
            kind: ContactKind::Edge,
            on: (0, arms),
            from: None,
            normal: Vector::new(0.0, 1.0),
            friction: 0.5,
            points: 2,
        }],
        grips,
        scale: Scale { length: 1.0, force: 1.0 },
    }
}

fn found(program: &Program) -> (Vec<f64>, Amounts) {
    let columns = generators(program);
    let mut active_set = BoundedNnls::default();
    let rest = active_set.find(&program.loads, &columns).expect("the search ends");
    (rest, active_set.to_forces(program, &columns))
}

#[test]
fn a_load_above_the_base_is_balanced_and_a_load_outside_it_is_not() {
    let (rest, amounts) = found(&block(0.25, 1.0, vec![]));
    assert!(rest.iter().all(|v| v.abs() < 1e-10), "{rest:?}");
    assert!((amounts.normal[0].iter().sum::<f64>() - 10.0).abs() < 1e-9);
    assert!((amounts.friction[0] + 1.0).abs() < 1e-9 || (amounts.friction[0] - 1.0).abs() < 1e-9);
    let program = block(1.5, 0.0, vec![]);
    let (rest, _) = found(&program);
    let columns = generators(&program);
    assert!(columns.iter().all(|c| c.dot(&rest) < 1e-9), "no force opposes the motion");
    let work: f64 = rest.iter().zip(&program.loads).map(|(r, b)| r * b).sum();
    assert!(work > 1.0, "the loads do work: {work}");
}

#[test]
fn a_limit_is_never_exceeded() {
    let grip = |limit: f64| GripTerm { block: 0, arm: Vector::new(0.0, 0.0), limits: [limit, 0.0, 0.0] };
    // Friction resists at most 5 of the push of 9, so the robot must exert at least 4.
    let (rest, amounts) = found(&block(0.0, 9.0, vec![grip(6.0)]));
    assert!(rest.iter().all(|v| v.abs() < 1e-10), "{rest:?}");
    assert!(amounts.grip[0][0].abs() <= 6.0 + 1e-12);
    let (rest, amounts) = found(&block(0.0, 9.0, vec![grip(3.0)]));
    assert!(rest.iter().any(|v| v.abs() > 0.1), "{rest:?}");
    assert!((amounts.grip[0][0].abs() - 3.0).abs() < 1e-12, "{amounts:?}");
}

#[test]
fn a_passive_set_that_lost_a_column_is_completed() {
    let program = block(0.25, 1.0, vec![]);
    let columns = generators(&program);
    let mut active_set = BoundedNnls::default();
    active_set.find(&program.loads, &columns).expect("the search ends");
    let first = active_set.used_columns().next().expect("a column is used");
    active_set.renumber(|k| (k != first).then_some(k));
    let rest = active_set.find(&program.loads, &columns).expect("the search ends");
    assert!(rest.iter().all(|v| v.abs() < 1e-10), "{rest:?}");
}
