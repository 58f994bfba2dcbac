//! How far a load or a limit can go: one linear program each, no search.
//!
//! The kinematic twin of `max λ  s.t.  Σ amount·column = need + λ·toward` has one row more than the hard program,
//! towardᵀy ≥ 1, whose dual amount is λ; its velocities are the collapse mechanism at the limit. A robot's least
//! sufficient limit is the least amount of its own component while every other force is free of cost. Source: the
//! static and kinematic theorems of limit analysis, Livesley 1978.

use super::slanted::Slanted;
use super::{Care, Effort, Status, TOLERANCE, largest, solve, twin};
use crate::program::{Column, Force, Program, columns, most_of};

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

/// From so many blocks on the finest tolerance is out of reach: a wall of 410 bricks takes 50 iterations at the second and
/// ends nowhere at the first, and the second is exact to 10⁻⁷.
const MANY_BLOCKS: usize = 200;

/// Tolerances tried one after the other.
const TOLERANCES: [f64; 3] = [TOLERANCE, 10.0 * TOLERANCE, 100.0 * TOLERANCE];

/// The largest λ ≥ 0 for which admissible forces give `program.need + λ·toward`.
///
/// Both are posed with a largest entry of 1: on a wall of 420 bricks loads of 300 end after a hundred iterations at
/// 0.48159 where loads of 1 are solved, at 0.48162.
pub fn most(program: &Program, toward: &[f64]) -> Limit {
    let size = largest(toward);
    if size == 0.0 {
        return Limit::Unbounded;
    }
    let load = match largest(&program.need) {
        0.0 => 1.0,
        load => load,
    };
    let scaled = |list: &[f64], by: f64| -> Vec<f64> { list.iter().map(|v| v / by).collect() };
    let conic = most_of(
        &scaled(&program.need, load),
        &scaled(toward, size),
        &Slanted::of(&columns_in(program, load)).columns,
    );
    let finest = usize::from(program.blocks >= MANY_BLOCKS);
    for tolerance in TOLERANCES.into_iter().skip(finest) {
        let answer = solve(&conic, tolerance, Care::Full);
        match (answer.status, answer.z.last()) {
            (Status::Solved, Some(amount)) => return Limit::At(amount.max(0.0) * load / size),
            (Status::Infeasible, _) => return Limit::Unbounded,
            (Status::Unbounded, _) => return Limit::Never,
            _ => {}
        }
    }
    Limit::Unclear
}

/// The columns of a program whose forces are counted in parts of `unit`.
pub(super) fn columns_in(program: &Program, unit: f64) -> Vec<Column> {
    let mut columns = columns(program);
    for column in &mut columns {
        column.limit /= unit;
    }
    columns
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
