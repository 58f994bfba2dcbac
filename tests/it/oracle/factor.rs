//! The exact interval of a parameter in which the loads are linear: two programs, no search.

use dashu_ratio::RBig;

use super::balance::Balance;
use super::simplex::{LinearProgram, Row};

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
