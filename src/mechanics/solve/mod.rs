//! Solves the programs of an assembly: least force where it stands, least sticking where it falls.
//!
//! The results, such as [`Balance`] and [`LeastAdhesion`], are in the program's pure numbers. They are not verdicts: the forces and
//! the motion go to [`crate::proof`], which decides. Among several optima the one of least Σ force² is drawn.
//!
//! | files | what they do |
//! |---|---|
//! | `solver`, `clarabel`, `normal`, `settings`, `answer`, `deadline` | solve one quadratic program |
//! | `dual`, `face`, `amounts` | a linear program in terms of columns, and the face of its optima |
//! | `balance`, `residual`, `stick`, `limit`, `tangent` | the programs of limit analysis |
//! | `level`, `stick_levels` | their optima where loads span many sizes |
//! | `determinate`, `exact`, `bounded_nnls`, `incremental_cholesky` | what needs no interior-point method |
//! | `correction`, `refine`, `polish`, `extreme_ray` | improve forces and motions that a solver found |
//! | `wedge` | whether forces build up from rest |

mod amounts;
mod answer;
mod balance;
mod bounded_nnls;
mod clarabel;
mod correction;
mod deadline;
mod determinate;
mod dual;
mod exact;
pub(crate) mod extreme_ray;
mod face;
mod incremental_cholesky;
mod level;
mod limit;
mod normal;
#[cfg(test)]
mod numbers;
mod polish;
mod refine;
mod residual;
mod residual_norm;
mod settings;
mod slanted;
mod solver;
mod stick;
mod stick_levels;
mod least_adhesion;
mod tangent;
mod wedge;

pub use amounts::{Amounts, Effort};
pub use answer::{Answer, Status};
pub use balance::{Balance, balance, balance_at_first_look, balance_in};
pub use bounded_nnls::{BoundedNnls, generators};
pub use clarabel::by_clarabel;
pub(crate) use deadline::{DeadlineGuard, deadline, is_late};
pub use determinate::{collapse, determinate};
pub use dual::{Dual, dual};
pub use least_adhesion::LeastAdhesion;
pub use limit::{Extreme, Limit, largest_factor, least_grip_limit, nearest_factor};
pub use polish::polished;
pub use refine::{corrected, relative};
pub use residual::{Residual, any_balance, least_residual};
pub use settings::{
    Choice, Conditioning, CrossoverTolerance, MAX_ITERATIONS, SolverSettings, TOLERANCE,
};
pub use solver::{solve, solve_within};
pub use stick::{stick, stick_in};
pub use tangent::Tangent;
pub use wedge::{RuledOut, SelfStress, SelfStressCheck, Slide, check_self_stress};

use correction::{refined, settled};
use dual::{in_forces, of_velocities, once, once_within, solved_with_retry};
use face::{Face, least_squares_amounts};
use residual_norm::{largest, remainder};
