//! The exact interval of a parameter on which the loads depend linearly. Each end is the optimum of a linear program.

use dashu_ratio::RBig;

use super::balance::Balance;
use super::simplex::{LinearProgram, Row};
use super::touch::{exact, pair};

/// The loads that grow with the parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growing {
    /// The loads that the scene lists; the parameter is not negative.
    ListedLoads,
    /// A force perpendicular to gravity on each block, positive to the right.
    AcrossGravity,
}

/// An interval that reaches this value counts as unbounded.
pub const ENDLESS: i64 = 10_000_000_000_000;

impl Balance<'_> {
    /// The least and the largest value at which the group stands, within ±[`ENDLESS`]; `None` if it stands at no
    /// value.
    pub fn interval(&self, growing: Growing) -> Option<[RBig; 2]> {
        let least = match growing {
            Growing::ListedLoads => RBig::ZERO,
            Growing::AcrossGravity => RBig::from(-ENDLESS),
        };
        let most = RBig::from(ENDLESS);
        let low = &least + self.along(growing, &least, RBig::ONE).least()?;
        let high = &most - self.along(growing, &most, -RBig::ONE).least()?;
        // The values must stay within the bounds.
        Some([low.min(most), high.max(least)])
    }

    /// For each direction, the largest component of the forces at a point of a block with which the group stands,
    /// newtons. The inner `None` means that the component is unbounded, the outer `None` that no such force exists.
    pub fn farthest_forces(&self, block: usize, at: [f64; 2], directions: &[[f64; 2]]) -> Option<Vec<Option<f64>>> {
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

    /// Whether the group stands with some force at a point of a block, with an imbalance of up to 10⁻⁶ allowed.
    pub fn holds_within_band(&self, block: usize, at: [f64; 2]) -> bool {
        self.least_imbalance(self.with_force(block, at).0) <= 1e-6
    }

    /// The program with one more force at a point of a block. Its unknowns are x, −x, y and −y; their sum is at most
    /// [`ENDLESS`].
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

    /// The program at the value `from` + `sign` · step, where the unknown step has cost 1 and forces cost nothing.
    fn along(&self, growing: Growing, from: &RBig, sign: RBig) -> LinearProgram {
        let mut program = self.admissible();
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

    /// A block's load at the value 0, and its increase per unit of the value.
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
                // The force points to the right if gravity points downwards.
                (all, [-y, x, RBig::ZERO])
            }
        }
    }
}
