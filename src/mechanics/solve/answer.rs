//! [`Answer`]: what a solver returns for a [`QuadraticProgram`] problem.

use crate::program::QuadraticProgram;

/// How a conic problem ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// x, s and z are an optimum.
    Solved,
    /// The rows contradict each other; z is a certificate (Aᵀz = 0, bᵀz < 0).
    Infeasible,
    /// The objective has no bound; x is a direction along which it falls for ever.
    Unbounded,
    /// The solver gave up.
    Unsolved,
}

/// The result of a solver.
#[derive(Clone, Debug)]
pub struct Answer {
    /// How it ended.
    pub status: Status,
    /// The unknowns, or the direction of a certificate.
    pub x: Vec<f64>,
    /// The multipliers of the rows.
    pub z: Vec<f64>,
    /// The slacks of the rows, b − Ax.
    pub s: Vec<f64>,
    /// The number of interior-point iterations.
    pub iterations: usize,
}

impl Answer {
    /// The answer of a solver that gave up: zeros.
    pub(super) fn without_status(problem: &QuadraticProgram) -> Answer {
        Answer {
            status: Status::Unsolved,
            x: vec![0.0; problem.unknowns],
            z: vec![0.0; problem.bound.len()],
            s: vec![0.0; problem.bound.len()],
            iterations: 0,
        }
    }

    /// The same answer, as unsolved if a number in it is infinite or NaN.
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

/// Whether all numbers are finite.
pub(super) fn is_finite(list: &[f64]) -> bool {
    list.iter().all(|v| v.is_finite())
}
