//! How far a load or a limit can go: one linear program each, no search.
//!
//! The kinematic dual of `max λ  s.t.  Σ amount·column = loads + λ·toward` has one row more than the hard program,
//! towardᵀy ≥ 1, whose dual amount is λ; its velocities are the collapse mechanism at the limit. A robot's least
//! sufficient limit is the least amount of its own component while every other force is free of cost. Source: the
//! static and kinematic theorems of limit analysis, Livesley 1978.

use super::slanted::Slanted;
use super::{
    Amounts, Conditioning, Effort, Face, Status, TOLERANCE, dual, largest, settled, solve,
};
use crate::program::{Column, Force, Program, columns, load_factor_dual, nearest_factor_dual};

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
    Unsolved,
}

/// What a program found at its limit.
#[derive(Clone, Debug)]
pub struct Extreme {
    /// The limit.
    pub limit: Limit,
    /// Forces that balance just there.
    pub forces: Option<Amounts>,
    /// The motion by which it begins to fall beyond: three velocities per block.
    pub motion: Option<Vec<f64>>,
}

impl From<Limit> for Extreme {
    fn from(limit: Limit) -> Extreme {
        Extreme {
            limit,
            forces: None,
            motion: None,
        }
    }
}

/// From so many blocks on the finest tolerance is out of reach: at the first a wall of 410 bricks ends without a status.
const MANY_BLOCKS: usize = 200;

/// Along the velocities of many blocks the growing loads do so much work, in parts of the largest of them.
///
/// With 1 the velocities of a wall of 915 bricks are a thousandth, and its limit takes 97 iterations with full
/// conditioning and is known to 10⁻⁶; with 1 000 it takes 38 without, and is known to 10⁻⁷.
const WORK: f64 = 1e3;

/// Tolerances tried one after the other.
const TOLERANCES: [f64; 3] = [TOLERANCE, 10.0 * TOLERANCE, 100.0 * TOLERANCE];

/// The largest λ ≥ 0 for which admissible forces give `program.loads + λ·toward`.
///
/// Both are posed with a largest entry of 1: on a wall of 420 bricks loads of 300 end after a hundred iterations at
/// 0.48159 where loads of 1 are solved, at 0.48162.
pub fn most(program: &Program, toward: &[f64]) -> Extreme {
    along(program, toward, Extremum::Largest)
}

/// The λ nearest to 0, of either sign, for which admissible forces give `program.loads + λ·toward`.
///
/// It has an optimum exactly where any λ does, so [`Limit::Never`] says that none does.
pub fn nearest_factor(program: &Program, toward: &[f64]) -> Extreme {
    along(program, toward, Extremum::Nearest)
}

/// Which λ is sought.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Extremum {
    Largest,
    Nearest,
}

impl Extremum {
    /// How many rows at the end of a form are those of λ.
    fn rows(self) -> usize {
        match self {
            Extremum::Largest => 1,
            Extremum::Nearest => 2,
        }
    }

    /// λ from the multipliers of these rows.
    fn factor(self, multipliers: &[f64]) -> Option<f64> {
        match (self, multipliers) {
            (Extremum::Largest, [.., up]) => Some(up.max(0.0)),
            (Extremum::Nearest, [.., up, down]) => Some(up - down),
            _ => None,
        }
    }
}

fn along(program: &Program, toward: &[f64], extremum: Extremum) -> Extreme {
    let size = largest(toward);
    if size == 0.0 {
        return Limit::Unbounded.into();
    }
    let load = match largest(&program.loads) {
        0.0 => 1.0,
        load => load,
    };
    let scaled = |list: &[f64], by: f64| -> Vec<f64> { list.iter().map(|v| v / by).collect() };
    let (loads, along) = (scaled(&program.loads, load), scaled(toward, size));
    let columns = Slanted::new(&columns_in(program, load)).columns;
    let (mut conic, row_of) = match extremum {
        Extremum::Largest => load_factor_dual(&loads, &along, &columns),
        Extremum::Nearest => nearest_factor_dual(&loads, &along, &columns),
    };
    let many = program.blocks >= MANY_BLOCKS;
    let work = if many { WORK } else { 1.0 };
    // The last rows ask for the work.
    conic
        .bound
        .iter_mut()
        .rev()
        .take(extremum.rows())
        .for_each(|b| *b *= work);
    let full = |tolerance: &f64| (*tolerance, Conditioning::Full);
    let plain = [(TOLERANCES[1], Conditioning::Plain)];
    let tries = plain.into_iter().filter(|_| many);
    let finest = usize::from(many);
    for (tolerance, conditioning) in tries.chain(TOLERANCES[finest..].iter().map(full)) {
        let answer = solve(&conic, tolerance, conditioning);
        match (answer.status, extremum.factor(&answer.z)) {
            (Status::Solved, Some(amount)) => {
                let total = loads.iter().zip(&along).map(|(n, t)| n + amount * t);
                let total: Vec<f64> = total.collect();
                let given = row_of.iter().enumerate().map(|(k, row)| match *row {
                    usize::MAX => (-answer.z[row_of[k - 1]]).max(0.0),
                    row => answer.z[row].max(0.0),
                });
                let given: Vec<f64> = given.collect();
                let mut amounts = rebalanced(&total, &columns, given);
                amounts.iter_mut().for_each(|amount| *amount *= load);
                let face = Face::whole(&total, columns).with(amounts);
                return Extreme {
                    limit: Limit::At(amount * load / size),
                    forces: Some(face.gathered(program).0),
                    motion: Some(answer.x[..loads.len()].iter().map(|v| -v).collect()),
                };
            }
            (Status::Infeasible, _) => return Limit::Unbounded.into(),
            // Along this motion the loads do work whatever λ is.
            (Status::Unbounded, _) => {
                return Extreme {
                    motion: Some(answer.x[..loads.len()].iter().map(|v| -v).collect()),
                    ..Limit::Never.into()
                };
            }
            _ => {}
        }
    }
    Limit::Unsolved.into()
}

/// Amounts with the smallest change that undoes what a solver left unbalanced of them.
pub(super) fn rebalanced(loads: &[f64], columns: &[Column], amounts: Vec<f64>) -> Vec<f64> {
    let settings = Conditioning::Plain.into();
    settled(loads, columns, amounts, settings, &mut Effort::default())
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
pub fn least(program: &Program, grip: usize, component: usize) -> Extreme {
    let mut free = program.clone();
    free.grips[grip].limits[component] = f64::INFINITY;
    let own = |force: &Force| matches!(force, Force::Grip { grip: g, component: c, .. } if *g == grip && *c == component);
    let columns = columns(&free);
    let solved = dual(
        &free.loads,
        &columns,
        Conditioning::Full,
        &mut Effort::default(),
        |c| f64::from(u8::from(own(&c.force))),
    );
    match solved.status {
        // The objective counts what limited forces give at their limits, so the component's own amounts are summed instead.
        Status::Solved => {
            let amounts = rebalanced(&free.loads, &columns, solved.amounts.clone());
            let owned = columns.iter().zip(&solved.amounts);
            let owned = owned.filter(|(c, _)| own(&c.force));
            let at = owned.map(|(_, amount)| amount).sum();
            let face = Face::whole(&free.loads, columns.clone()).with(amounts);
            Extreme {
                limit: Limit::At(at),
                forces: Some(face.gathered(&free).0),
                motion: Some(solved.y.iter().map(|v| -v).collect()),
            }
        }
        Status::Unbounded => Limit::Never.into(),
        _ => Limit::Unsolved.into(),
    }
}
