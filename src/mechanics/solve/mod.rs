//! Solves the linear and quadratic programs of a structure: for the least forces with which it stands, for the least
//! adhesion with which it would stand, and for its load limits.
//!
//! The results, such as [`Balance`] and [`LeastAdhesion`], are in program units. They are not verdicts: a verdict needs
//! forces or a motion that [`crate::mechanics::proof`] has checked. Of several optima, the optimum of least Σ force² is chosen by
//! default ([`Choice::Unique`]).
//!
//! | files | what they do |
//! |---|---|
//! | `solver`, `clarabel_solver`, `normal`, `settings`, `answer`, `deadline` | solve one quadratic program |
//! | `dual`, `face`, `amounts`, `reduced_columns` | the linear program of forces, its dual, and the set of its optima |
//! | `balance`, `least_residual`, `least_adhesion`, `limit`, `limit_state`, `support`, `tangent` | the programs of limit analysis |
//! | `force_polygon`, `simplex`, `basis_factor` | compute all forces that one grip may exert, as a polygon |
//! | `level`, `least_adhesion_levels` | refine optima of these programs if loads differ by many powers of ten |
//! | `determinate`, `exact`, `bounded_nnls`, `incremental_cholesky` | solve programs without an interior-point method |
//! | `iterative_refinement`, `rebalance_blocks`, `repair_motion`, `extreme_ray` | improve forces and motions of a solver |
//! | `wedge` | checks whether the loads alone produce the forces that balance them |

mod adhesion_result;
mod amounts;
mod answer;
mod balance;
mod basis_factor;
mod bounded_nnls;
mod clarabel_solver;
mod deadline;
mod determinate;
mod dual;
mod exact;
pub(crate) mod extreme_ray;
mod face;
mod force_polygon;
mod incremental_cholesky;
mod iterative_refinement;
mod least_residual;
mod least_adhesion;
mod level;
mod limit;
mod limit_state;
mod normal;
#[cfg(test)]
mod random_numbers;
mod rebalance_blocks;
mod repair_motion;
mod residual_norm;
mod settings;
mod simplex;
mod reduced_columns;
mod solver;
mod support;
mod least_adhesion_levels;
mod tangent;
mod wedge;

pub use adhesion_result::LeastAdhesion;
pub use amounts::{Amounts, Effort};
pub use answer::{Answer, Status};
pub use balance::{Balance, balance, balance_at_first_look, balance_in};
pub use bounded_nnls::{BoundedNnls, generators};
pub use clarabel_solver::by_clarabel;
pub(crate) use deadline::{DeadlineGuard, deadline, is_late};
pub use determinate::{collapse, determinate};
pub use dual::{Dual, dual};
pub use force_polygon::{ForcePolygon, force_polygon};
pub use least_adhesion::{least_adhesion, least_adhesion_in};
pub use least_residual::{Residual, any_balance, least_residual};
pub use limit::{ExtremeValue, Limit, largest_factor, least_grip_limit, nearest_factor};
pub use limit_state::{LimitState, limit_state};
pub use rebalance_blocks::{rebalance_absolute, rebalance_relative};
pub use repair_motion::repair_motion;
pub use settings::{Choice, Conditioning, CrossoverTolerance, MAX_ITERATIONS, SolverSettings, TOLERANCE};
pub use solver::{solve, solve_within};
pub use support::{Support, support};
pub use tangent::Tangent;
pub use wedge::{RuledOut, SelfStress, SelfStressCheck, Slide, check_self_stress};

use dual::{from_kinematic_answer, solve_once, solve_once_within, solve_static_form, solve_with_retry};
use face::{Face, least_squares_amounts};
use iterative_refinement::{balance_by_least_change, refine_balance};
use residual_norm::{largest, remainder};
