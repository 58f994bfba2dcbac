//! The conic solver clarabel.
//!
//! A primal-dual interior-point method on the homogeneous embedding, [Goulart24](crate::doc::references). Settings that are not its
//! defaults, and why:
//!
//! - `direct_solve_method` is `qdldl`: the automatic choice takes faer for large programs, 13.1 s against 4.6 s at 10⁴ blocks;
//! - presolve is off: nothing here has infinite bounds;
//! - equilibration and iterative refinement are off with [`Conditioning::Plain`].

use std::time::Instant;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

use super::answer::{Answer, Status};
use super::deadline::deadline;
use super::settings::{Conditioning, SolverSettings};
use crate::program::QuadraticProgram;

/// Solves a conic problem of finite numbers with clarabel, whatever its size.
pub fn by_clarabel(
    problem: &QuadraticProgram,
    settings: SolverSettings,
    iterations: usize,
) -> Answer {
    let SolverSettings {
        tolerance,
        conditioning,
        ..
    } = settings;
    let rows = problem.bound.len();
    let quadratic = compressed_columns(problem.unknowns, problem.unknowns, &problem.quadratic);
    let matrix = compressed_columns(rows, problem.unknowns, &problem.matrix);
    let mut cones = Vec::with_capacity(2);
    if problem.equalities > 0 {
        cones.push(SupportedConeT::ZeroConeT(problem.equalities));
    }
    if rows > problem.equalities {
        cones.push(SupportedConeT::NonnegativeConeT(rows - problem.equalities));
    }
    let time_left = deadline().map(|end| end.saturating_duration_since(Instant::now()));
    if time_left.is_some_and(|time| time.is_zero()) {
        return Answer::without_status(problem);
    }
    let is_full = conditioning == Conditioning::Full;
    let settings = DefaultSettings {
        verbose: false,
        time_limit: time_left.map_or(f64::INFINITY, |time| time.as_secs_f64()),
        direct_solve_method: "qdldl".to_string(),
        presolve_enable: false,
        max_iter: u32::try_from(iterations).unwrap_or(u32::MAX),
        equilibrate_enable: is_full,
        iterative_refinement_enable: is_full,
        tol_gap_abs: tolerance,
        tol_gap_rel: tolerance,
        tol_feas: tolerance,
        ..DefaultSettings::default()
    };
    let solver = DefaultSolver::new(
        &quadratic,
        &problem.linear,
        &matrix,
        &problem.bound,
        &cones,
        settings,
    );
    let Ok(mut solver) = solver else {
        return Answer::without_status(problem);
    };
    solver.solve();
    let solution = solver.solution;
    let status = match solution.status {
        SolverStatus::Solved => Status::Solved,
        SolverStatus::PrimalInfeasible => Status::Infeasible,
        SolverStatus::DualInfeasible => Status::Unbounded,
        _ => Status::Unsolved,
    };
    let answer = Answer {
        status,
        x: solution.x,
        z: solution.z,
        s: solution.s,
        iterations: solution.iterations as usize,
    };
    answer.if_finite()
}

/// A compressed sparse column matrix from (row, column, value) entries; entries at one place are added.
fn compressed_columns(
    rows: usize,
    columns: usize,
    entries: &[(usize, usize, f64)],
) -> CscMatrix<f64> {
    let mut starts = vec![0; columns + 1];
    for (_, column, _) in entries {
        starts[column + 1] += 1;
    }
    for k in 0..columns {
        starts[k + 1] += starts[k];
    }
    let mut next = starts.clone();
    let mut list = vec![(0, 0.0); entries.len()];
    for (row, column, value) in entries {
        list[next[*column]] = (*row, *value);
        next[*column] += 1;
    }
    let (mut colptr, mut rowval, mut nzval) = (
        vec![0],
        Vec::with_capacity(list.len()),
        Vec::with_capacity(list.len()),
    );
    for k in 0..columns {
        let column = &mut list[starts[k]..starts[k + 1]];
        column.sort_by_key(|e| e.0);
        for (row, value) in column.iter() {
            if rowval.len() > colptr[k] && rowval.last() == Some(row) {
                if let Some(last) = nzval.last_mut() {
                    *last += value;
                }
            } else {
                rowval.push(*row);
                nzval.push(*value);
            }
        }
        colptr.push(rowval.len());
    }
    CscMatrix::new(rows, columns, colptr, rowval, nzval)
}
