//! Computes the largest force that a grip without limits can exert in a direction while all blocks stay balanced, by
//! one linear program.
//!
//! The program is max d·F s.t. Σ amount·column = loads, where F is the force of the grip and d the direction. The dual
//! is kinematic: max loadsᵀy s.t. columnᵀy ≤ 0, and in the motion −y the grip point has the velocity d. The multipliers
//! of the condition on the grip point are F. The motion −y is the mechanism by which the structure fails under a larger
//! force.

use super::dual::amounts_of_rows;
use super::limit::{columns_in, rebalanced};
use super::reduced_columns::ReducedColumns;
use super::{Amounts, Conditioning, Face, Status, TOLERANCE, largest, solve};
use crate::geometry::Vector;
use crate::mechanics::program::{Column, Force, Program, kinematic_dual};

/// The largest force of a grip in a direction.
#[derive(Clone, Debug)]
pub enum Support {
    /// The largest force is finite.
    At {
        /// Forces that balance the loads, in program units. The force of the grip is the largest one in the direction.
        forces: Amounts,
        /// The mechanism: three velocities for each block, in units of the program.
        motion: Vec<f64>,
    },
    /// Forces of any size are possible.
    Unbounded,
    /// No force of the grip balances the loads.
    Infeasible,
    /// The solver ended without a result.
    Unsolved,
}

/// The tolerances and conditionings that are tried in this order. Plain conditioning is faster. A proof checks each
/// result.
const ATTEMPTS: [(f64, Conditioning); 4] = [
    (TOLERANCE, Conditioning::Plain),
    (TOLERANCE, Conditioning::Full),
    (10.0 * TOLERANCE, Conditioning::Full),
    (100.0 * TOLERANCE, Conditioning::Full),
];

/// Finds the force of `grip` with the largest component along `direction`, a unit vector. `is_retry` is true if the
/// result of an earlier call could not be proved; only full conditioning is then tried.
pub fn support(program: &Program, grip: usize, direction: Vector, is_retry: bool) -> Support {
    let load = match largest(&program.loads) {
        0.0 => 1.0,
        load => load,
    };
    let loads: Vec<f64> = program.loads.iter().map(|v| v / load).collect();
    let columns = ReducedColumns::new(&columns_in(program, load)).columns;
    let (problem, row_of) = kinematic_dual(&loads, &columns, farthest_cost(grip, direction));
    for (tolerance, conditioning) in ATTEMPTS.into_iter().skip(usize::from(is_retry)) {
        let answer = solve(&problem, tolerance, conditioning);
        match answer.status {
            Status::Solved => {
                let amounts = amounts_of_rows(&answer, &row_of);
                let mut amounts = rebalanced(&loads, &columns, amounts);
                amounts.iter_mut().for_each(|amount| *amount *= load);
                let face = Face::whole(&loads, columns).with_amounts(amounts);
                return Support::At {
                    forces: face.to_forces(program).0,
                    motion: answer.x[..loads.len()].iter().map(|v| -v).collect(),
                };
            }
            // No mechanism moves the grip point with the velocity `direction`, so nothing limits the force.
            Status::Infeasible => return Support::Unbounded,
            Status::Unbounded => return Support::Infeasible,
            Status::Unsolved => {}
        }
    }
    Support::Unsolved
}

/// Returns the cost function of the program that finds the force of a grip with the largest component along a
/// direction. For the force components of this grip, the cost is minus the component along the direction; for all other
/// columns it is 0.
pub(super) fn farthest_cost(grip: usize, direction: Vector) -> impl Fn(&Column) -> f64 {
    move |column| match column.force {
        Force::Grip { grip: column_grip, component, sign } if column_grip == grip && component < 2 => {
            -sign * direction[component]
        }
        _ => 0.0,
    }
}
