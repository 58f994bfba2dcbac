//! A block on one stretch of ground, answered without a program.
//!
//! Three unknowns N1, N2, T and three rows: the forces are what they are, and either admissible or not.

use crate::geometry::{Vector, cross, quarter_turn};
use crate::program::Program;
use crate::solve::Amounts;

/// The forces of one block on one edge interface with the ground and nothing else, where they are admissible.
pub fn single(program: &Program) -> Option<Amounts> {
    let [contact] = &program.contacts[..] else {
        return None;
    };
    if program.blocks != 1
        || !program.grips.is_empty()
        || contact.points != 2
        || contact.from.is_some()
    {
        return None;
    }
    let loads = Vector::new(program.loads[0], program.loads[1]);
    let tangent = quarter_turn(contact.normal);
    let (sum, friction) = (contact.normal.dot(&loads), tangent.dot(&loads));
    let arms = contact.on.1;
    let moments = arms.map(|arm| cross(arm, contact.normal));
    let moment = program.loads[2] - cross(arms[0], tangent) * friction;
    let spread = moments[1] - moments[0];
    // With kernel 1 both points are one, and only the program can tell whether the moment fits.
    if spread.abs() < 1e-9 {
        return None;
    }
    let second = (moment - moments[0] * sum) / spread;
    let normal = [sum - second, second];
    let admissible =
        normal[0] >= 0.0 && normal[1] >= 0.0 && friction.abs() <= contact.friction * sum;
    admissible.then(|| Amounts {
        normal: vec![normal],
        friction: vec![friction],
        grip: Vec::new(),
    })
}
