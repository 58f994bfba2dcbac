//! The forces that leave least unbalanced, and the motion against which that is so.
//!
//! The one program that has an answer on either side of the edge: admissible forces of least Σ |what is left|. Where
//! nothing is left, they balance; where something is, the velocities are those of largest power within −1 ≤ y ≤ 1. Its
//! optimum is small near the edge, but never without bound on either side, so it is solved where a program that must
//! decide between "balanced" and "no balance" ends nowhere.

use super::limit::columns_in;
use super::{Amounts, Care, Effort, Face, Status, careful, largest};
use crate::program::{Program, least_left};

/// What the program of the least leftover gave.
#[derive(Clone, Debug)]
pub struct Leftover {
    /// The admissible forces.
    pub forces: Amounts,
    /// The motion of largest power: three velocities per block.
    pub motion: Vec<f64>,
    /// The work it took.
    pub effort: Effort,
}

/// Solves the program of the least leftover; `None` where the solver ends nowhere.
///
/// It is posed with a largest load of 1: on a wall of 410 bricks pushed to its edge loads of 300 end nowhere, loads of 1 after
/// some 70 iterations.
pub fn leftover(program: &Program) -> Option<Leftover> {
    let load = match largest(&program.need) {
        0.0 => 1.0,
        load => load,
    };
    let columns = columns_in(program, load);
    let need: Vec<f64> = program.need.iter().map(|v| v / load).collect();
    let (conic, row_of) = least_left(&need, &columns);
    let mut effort = Effort::default();
    let answer = careful(&conic, Care::Quick, &mut effort);
    if answer.status != Status::Solved {
        return None;
    }
    let mut face = Face::whole(&program.need, columns);
    for (k, row) in row_of.iter().enumerate() {
        // A pair posed as one equality carries the amount of its first, of either sign.
        face.amounts[k] = load
            * match *row {
                usize::MAX => (-answer.z[row_of[k - 1]]).max(0.0),
                row => answer.z[row].max(0.0),
            };
    }
    let (forces, _) = face.gathered(program);
    let velocities = answer.x[..need.len()].iter();
    Some(Leftover {
        forces,
        motion: velocities.map(|v| -v).collect(),
        effort,
    })
}
