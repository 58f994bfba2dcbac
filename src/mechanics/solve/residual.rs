//! Whether any admissible forces balance, whatever they cost; and where none do, those that leave least unbalanced.
//!
//! Near the edge of standing the least force ends without a status: it has no optimum beyond the edge and one without
//! measure short of it. Two programs without that cost decide there. The first asks for any balance, with the forces as
//! unknowns: some 30 iterations on either side of the edge of a wall of 410 bricks, 10⁻⁵ of the load away, where the least
//! force takes 200 and fails. The second is the least Σ |what is left|. Where nothing is left, the forces balance; where
//! something is, the velocities are those of largest power within −1 ≤ y ≤ 1. It has an optimum on either side, and says
//! where an answer lies within the band of the proofs.

use super::limit::columns_in;
use super::slanted::Slanted;
use super::{
    Amounts, Conditioning, Effort, Face, Status, in_forces, largest, remainder, settled,
    solved_with_retry,
};
use crate::program::{Column, Program, least_residual_dual};

/// Forces and a motion, of which a proof takes one.
#[derive(Clone, Debug)]
pub struct Residual {
    /// The admissible forces.
    pub forces: Amounts,
    /// The motion against them: three velocities per block, 0 where the forces balance.
    pub motion: Vec<f64>,
    /// Whether the forces balance, or come as near to it as any do.
    pub nearest: bool,
    /// The work it took.
    pub effort: Effort,
}

/// A motion whose power is more than this share of the way its blocks go, in parts of the largest load, is beyond doubt
/// by ten times the band within which forces count as balanced.
const BEYOND_THE_BAND: f64 = 1e-6;

/// What any balance may leave, in parts of the largest load.
const BALANCED: f64 = 1e-9;

/// A program with a largest load of 1.
///
/// On a wall of 410 bricks pushed to its edge loads of 300 end without a status, loads of 1 after some 70 iterations.
struct Posed<'p> {
    program: &'p Program,
    load: f64,
    loads: Vec<f64>,
    columns: Vec<Column>,
    slanted: Slanted,
}

impl Posed<'_> {
    fn new(program: &Program) -> Posed<'_> {
        let load = match largest(&program.loads) {
            0.0 => 1.0,
            load => load,
        };
        let columns = columns_in(program, load);
        Posed {
            program,
            load,
            loads: program.loads.iter().map(|v| v / load).collect(),
            slanted: Slanted::new(&columns),
            columns,
        }
    }

    /// The forces of these amounts, in the program's own numbers.
    fn forces(&self, amounts: &[f64]) -> Amounts {
        let mut face = Face::whole(&self.program.loads, self.columns.clone());
        face.amounts = self.slanted.amounts_of_all(&self.columns, amounts);
        face.amounts
            .iter_mut()
            .for_each(|amount| *amount *= self.load);
        face.gathered(self.program).0
    }
}

/// Forces that balance, or a motion that shows that none do; neither forces nor motion where the solver tells neither.
pub fn any_balance(program: &Program) -> Residual {
    let posed = Posed::new(program);
    let (loads, columns) = (&posed.loads, &posed.slanted.columns);
    let mut effort = Effort::default();
    let any = in_forces(loads, columns, Conditioning::Plain, &mut effort, |_| 0.0);
    let mut found = Residual {
        forces: Amounts::none(program),
        motion: vec![0.0; loads.len()],
        nearest: false,
        effort,
    };
    match any.status {
        Status::Solved => {
            let settings = Conditioning::Plain.into();
            let amounts = settled(loads, columns, any.amounts, settings, &mut found.effort);
            found.nearest = largest(&remainder(loads, columns, &amounts)) <= BALANCED;
            found.forces = posed.forces(&amounts);
        }
        Status::Unbounded => {
            let power: f64 = loads.iter().zip(&any.y).map(|(n, v)| n * v).sum();
            let way: f64 = any.y.iter().map(|v| v.abs()).sum();
            found.nearest = power > BEYOND_THE_BAND * way;
            found.motion = any.y.iter().map(|v| -v).collect();
        }
        _ => {}
    }
    found
}

/// The forces that leave least unbalanced and the motion against which that is so; `None` where the solver ends without a
/// status.
pub fn least_residual(program: &Program) -> Option<Residual> {
    let posed = Posed::new(program);
    let mut effort = Effort::default();
    let (conic, row_of) = least_residual_dual(&posed.loads, &posed.slanted.columns);
    let answer = solved_with_retry(&conic, Conditioning::Plain, &mut effort);
    if answer.status != Status::Solved {
        return None;
    }
    let amounts: Vec<f64> = row_of
        .iter()
        .enumerate()
        .map(|(k, row)| match *row {
            // A pair posed as one equality carries the amount of its first, of either sign.
            usize::MAX => (-answer.z[row_of[k - 1]]).max(0.0),
            row => answer.z[row].max(0.0),
        })
        .collect();
    Some(Residual {
        forces: posed.forces(&amounts),
        motion: answer.x[..posed.loads.len()].iter().map(|v| -v).collect(),
        nearest: true,
        effort,
    })
}
