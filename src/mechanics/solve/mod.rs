//! Solves the linear and quadratic programs of a structure: for the least forces with which it stands, for the least
//! adhesion with which it would stand, and for its load limits.
//!
//! The results, such as [`Balance`], are in program units. They are not verdicts: a verdict needs
//! forces or a motion that [`crate::mechanics::proof`] has checked. Of several optima, the optimum of least Σ force² is chosen by
//! default ([`Choice::Unique`]).
//!
//! | files | what they do |
//! |---|---|
//! | `solver`, `normal`, `settings`, `answer` | solve one quadratic program |
//! | `optimum`, `scaled`, `face`, `amounts` | the linear programs of forces, their one ladder of retries, and the set of their optima |
//! | `balance`, `least_residual`, `least_adhesion`, `limit`, `tangent` | the programs of limit analysis |
//! | `force_polygon`, `simplex`, `basis_factor` | compute all forces that one grip may exert, as a polygon |
//! | `level` | refine optima of these programs if loads differ by many powers of ten |
//! | `determinate`, `bounded_nnls`, `incremental_cholesky` | solve programs without an interior-point method |
//! | `iterative_refinement`, `rebalance_blocks`, `repair_motion`, `extreme_ray` | improve forces and motions of a solver |

mod amounts;
mod answer;
mod balance;
mod basis_factor;
mod bounded_nnls;
mod determinate;
pub(crate) mod extreme_ray;
mod face;
mod force_polygon;
mod incremental_cholesky;
mod iterative_refinement;
mod least_residual;
mod least_adhesion;
mod level;
mod limit;
mod normal;
mod optimum;
#[cfg(test)]
mod random_numbers;
mod rebalance_blocks;
mod repair_motion;
mod scaled;
mod settings;
mod simplex;
mod solver;
mod tangent;

pub use amounts::{Amounts, Balance, Effort};
pub use answer::{Answer, Status};
pub use balance::{balance, balance_at_first_look, balance_in};
pub use bounded_nnls::{BoundedNnls, generators};
pub use determinate::{collapse, determinate};
pub use force_polygon::{ForcePolygon, force_polygon};
pub use least_adhesion::least_adhesion_in;
pub use least_residual::{any_balance, least_residual};
pub use limit::{
    ExtremeValue, Limit, LimitState, largest_factor, largest_factor_fast, least_grip_limit, limit_state,
    nearest_factor, support,
};
pub(crate) use optimum::solve_in_turn;
pub use optimum::{Optimum, least_cost};
pub use rebalance_blocks::{rebalance_absolute, rebalance_relative};
pub use repair_motion::repair_motion;
pub use settings::{Choice, Conditioning, CrossoverTolerance, MAX_ITERATIONS, SolverSettings, TOLERANCE};
pub(crate) use settings::{DeadlineGuard, deadline, is_late};
pub use solver::{by_clarabel, solve, solve_forces, solve_with};
pub use tangent::Tangent;

use amounts::{largest, remainder};
use face::{Face, least_squares_amounts};
use iterative_refinement::{balance_by_least_change, refine_balance};
