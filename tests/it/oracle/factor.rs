//! The exact interval of a parameter in which the loads are linear: two programs, no search.

use dashu_ratio::RBig;

use super::balance::Balance;
use super::simplex::{LinearProgram, Row};
use super::touch::{exact, pair};

/// What grows with the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growing {
    /// The listed loads; the parameter is at least 0.
    ListedLoads,
    /// A force across gravity on each block, positive to the right.
    AcrossGravity,
}

/// Values beyond this count as no end.
pub const ENDLESS: i64 = 10_000_000_000_000;

impl Balance<'_> {
    /// The least and the largest value at which the group stands, each within ±[`ENDLESS`]; `None` where it stands at none.
    pub fn interval(&self, growing: Growing) -> Option<[RBig; 2]> {
        let least = match growing {
            Growing::ListedLoads => RBig::ZERO,
            Growing::AcrossGravity => RBig::from(-ENDLESS),
        };
        let most = RBig::from(ENDLESS);
        let low = &least + self.along(growing, &least, RBig::ONE).least()?;
        let high = &most - self.along(growing, &most, -RBig::ONE).least()?;
        // Beyond the other bound there is nothing to find.
        Some([low.min(most), high.max(least)])
    }

    /// The largest component of a force at a point of a block along each direction, such that the group stands; the inner
    /// `None` where it has no end, the outer one where no force is carried.
    pub fn farthest_forces(
        &self,
        block: usize,
        at: [f64; 2],
        directions: &[[f64; 2]],
    ) -> Option<Vec<Option<f64>>> {
        let (program, force) = self.with_force(block, at);
        let objectives = directions.iter().map(|direction| {
            let mut costs = vec![RBig::ZERO; program.costs.len()];
            for (k, unknown) in force.iter().enumerate() {
                let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
                costs[*unknown] = exact(sign * direction[k / 2]);
            }
            costs
        });
        let optima = program.optima(&objectives.collect::<Vec<_>>())?;
        let along = optima.iter().zip(directions).map(|(x, direction)| {
            let [x, y] = [0, 2].map(|k| (&x[force[k]] - &x[force[k + 1]]).to_f64_fast());
            let reaches = x.abs() + y.abs() >= 0.5 * ENDLESS as f64;
            (!reaches).then_some(x * direction[0] + y * direction[1])
        });
        Some(along.collect())
    }

    /// Whether the group stands with some force at a point of a block, if its other forces may be off by the band.
    pub fn holds_within_band(&self, block: usize, at: [f64; 2]) -> bool {
        self.off(self.with_force(block, at).0) <= 1e-6
    }

    /// The balance with one more force at a point of a block, of at most [`ENDLESS`]: its unknowns are x, −x, y and −y.
    fn with_force(&self, block: usize, at: [f64; 2]) -> (LinearProgram, [usize; 4]) {
        let mut program = self.admissible();
        program.costs.iter_mut().for_each(|c| *c = RBig::ZERO);
        let at = pair(at[0], at[1]);
        let force = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(|[x, y]| {
            let unknown = program.unknown(RBig::ZERO);
            self.push(&mut program, block, unknown, &at, &pair(x, y));
            unknown
        });
        program.rows.push(Row {
            entries: force.iter().map(|k| (*k, RBig::ONE)).collect(),
            bound: RBig::from(ENDLESS),
            equality: false,
        });
        (program, force)
    }

    /// Balance at a value of `from` plus `sign` times an unknown of cost 1.
    fn along(&self, growing: Growing, from: &RBig, sign: RBig) -> LinearProgram {
        let mut program = self.admissible();
        // Forces cost nothing here.
        program.costs.iter_mut().for_each(|c| *c = RBig::ZERO);
        let step = program.unknown(RBig::ONE);
        for (place, block) in self.blocks.iter().enumerate() {
            let (fixed, grows) = self.parts(growing, *block);
            for row in 0..3 {
                let Row { entries, bound, .. } = &mut program.rows[3 * place + row];
                // Σ forces = −(fixed + (from + sign · step) · grows).
                *bound = -(&fixed[row] + from * &grows[row]);
                entries.push((step, &sign * &grows[row]));
            }
        }
        program
    }

    /// A block's load at a value of 0, and what it gains per unit of the value.
    fn parts(&self, growing: Growing, block: usize) -> ([RBig; 3], [RBig; 3]) {
        let all = self.load(block);
        match growing {
            Growing::ListedLoads => {
                let weight = self.weight(block);
                let listed = [0, 1, 2].map(|k| &all[k] - &weight[k]);
                (weight, listed)
            }
            Growing::AcrossGravity => {
                let [x, y, _] = self.weight(block);
                // Right of gravity, seen with gravity pointing down the page.
                (all, [-y, x, RBig::ZERO])
            }
        }
    }
}
