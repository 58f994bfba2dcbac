//! How far a load or a limit can go: one linear program each, no search.
//!
//! The kinematic twin of `max λ  s.t.  Σ amount·column = need + λ·toward` has one row more than the hard program,
//! towardᵀy ≥ 1, whose dual amount is λ; its velocities are the collapse mechanism at the limit. A robot's least
//! sufficient limit is the least amount of its own component while every other force is free of cost. Source: the
//! static and kinematic theorems of limit analysis, Livesley 1978.

use super::{Care, Effort, Status, careful, largest, twin};
use crate::program::{Force, Program, columns, most_of};

/// The end of what a program allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// It ends here, in parts of what was asked about; of a robot's component in pure numbers.
    At(f64),
    /// No value allows a balance.
    Never,
    /// Every value from some on does.
    Unbounded,
    /// The solver gave up.
    Unclear,
}

/// The largest λ ≥ 0 for which admissible forces give `program.need + λ·toward`.
pub fn most(program: &Program, toward: &[f64]) -> Limit {
    let size = largest(toward);
    if size == 0.0 {
        return Limit::Unbounded;
    }
    let unit: Vec<f64> = toward.iter().map(|v| v / size).collect();
    let conic = most_of(&program.need, &unit, &columns(program));
    let answer = careful(&conic, Care::Full, &mut Effort::default());
    match (answer.status, answer.z.last()) {
        (Status::Solved, Some(amount)) => Limit::At(amount.max(0.0) / size),
        (Status::Infeasible, _) => Limit::Unbounded,
        (Status::Unbounded, _) => Limit::Never,
        _ => Limit::Unclear,
    }
}

/// The least limit of one component of one grip that lets admissible forces balance, the other limits as they are.
pub fn least(program: &Program, grip: usize, component: usize) -> Limit {
    let mut free = program.clone();
    free.grips[grip].limits[component] = f64::INFINITY;
    let own = |force: &Force| matches!(force, Force::Grip { grip: g, component: c, .. } if *g == grip && *c == component);
    let solved = twin(
        &free.need,
        &columns(&free),
        Care::Full,
        &mut Effort::default(),
        |c| f64::from(u8::from(own(&c.force))),
    );
    match solved.status {
        // The aim counts what limited forces give at their limits, so the component's own amounts are summed instead.
        Status::Solved => Limit::At(
            columns(&free)
                .iter()
                .zip(&solved.amounts)
                .filter(|(c, _)| own(&c.force))
                .map(|(_, amount)| amount)
                .sum(),
        ),
        Status::Unbounded => Limit::Never,
        _ => Limit::Unclear,
    }
}
