//! [`Answer`]: the result that a solver returns for a [`QuadraticProgram`].

use crate::mechanics::program::QuadraticProgram;

/// How a solver ended: with an optimum, with a certificate that there is none, or without a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// x, s and z are an optimum.
    Solved,
    /// The rows contradict each other; z is a certificate (Aᵀz = 0, bᵀz < 0).
    Infeasible,
    /// The objective has no lower bound; x is a direction along which the objective decreases without limit.
    Unbounded,
    /// The solver ended without a result: too many iterations, the deadline, or numerical trouble.
    Unsolved,
}

/// The result of a solver.
#[derive(Clone, Debug)]
pub struct Answer {
    /// How the solver ended. The status says what `x`, `z` and `s` contain.
    pub status: Status,
    /// The unknowns; for an unbounded problem the direction of decrease.
    pub x: Vec<f64>,
    /// The multipliers of the rows; for an infeasible problem the certificate of infeasibility.
    pub z: Vec<f64>,
    /// The slacks of the rows, b − Ax.
    pub s: Vec<f64>,
    /// The number of interior-point iterations.
    pub iterations: usize,
}

impl Answer {
    /// Returns the answer of a solver that ended without a result: the status `Unsolved`, and zeros.
    pub(super) fn without_status(problem: &QuadraticProgram) -> Answer {
        Answer {
            status: Status::Unsolved,
            x: vec![0.0; problem.unknowns],
            z: vec![0.0; problem.bound.len()],
            s: vec![0.0; problem.bound.len()],
            iterations: 0,
        }
    }

    /// Returns this answer, with the status changed to `Unsolved` if it contains an infinite number or NaN.
    pub(super) fn if_finite(self) -> Answer {
        let is_sound = [&self.x, &self.z, &self.s].map(|list| is_finite(list));
        Answer {
            status: match is_sound {
                [true, true, true] => self.status,
                _ => Status::Unsolved,
            },
            ..self
        }
    }
}

/// True if all numbers are finite.
pub(super) fn is_finite(list: &[f64]) -> bool {
    list.iter().all(|v| v.is_finite())
}
