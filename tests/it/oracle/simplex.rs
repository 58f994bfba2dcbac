//! A linear program solved exactly, in integers.
//!
//! The method is Edmonds' integer pivoting. The entries of the tableau are minors of the data over one common
//! denominator, the last pivot, so every division has no remainder. The column with the most negative reduced cost
//! enters. After a number of pivots without progress Bland's rule is used, which cannot cycle. The code is small and
//! slow, and it shares nothing with the solver that it checks.

use dashu_int::ops::{Gcd, UnsignedAbs};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// Bland's rule is used after this many pivots without progress.
const PATIENCE: usize = 12;

/// One constraint: Σ entries · x = `bound`, or ≤ `bound`.
#[derive(Clone, Debug)]
pub struct Row {
    pub entries: Vec<(usize, RBig)>,
    /// Not negative if the row is an inequality.
    pub bound: RBig,
    pub equality: bool,
}

/// Minimise `costs`·x subject to x ≥ 0 and the rows.
#[derive(Clone, Debug, Default)]
pub struct LinearProgram {
    pub costs: Vec<RBig>,
    pub rows: Vec<Row>,
}

impl LinearProgram {
    /// Adds an unknown with this cost.
    pub fn unknown(&mut self, cost: RBig) -> usize {
        self.costs.push(cost);
        self.costs.len() - 1
    }

    /// Whether the program is feasible.
    pub fn is_feasible(&self) -> bool {
        Table::new(self).reach_feasible()
    }

    /// The least cost; `None` if the program is infeasible. Costs must not be negative, so that the cost is bounded.
    pub fn least(&self) -> Option<RBig> {
        assert!(self.costs.iter().all(|c| *c >= RBig::ZERO), "costs must not be negative");
        let mut table = Table::new(self);
        if !table.reach_feasible() {
            return None;
        }
        let x = self.optimum(&mut table, &self.costs);
        Some(x.iter().zip(&self.costs).fold(RBig::ZERO, |sum, (v, c)| sum + v * c))
    }

    /// The unknowns at the optimum of each objective; `None` if the program is infeasible. The rows must bound the
    /// objectives.
    pub fn optima(&self, objectives: &[Vec<RBig>]) -> Option<Vec<Vec<RBig>>> {
        let mut table = Table::new(self);
        if !table.reach_feasible() {
            return None;
        }
        // Each search starts from the last optimum.
        Some(objectives.iter().map(|costs| self.optimum(&mut table, costs)).collect())
    }

    /// The unknowns at the optimum of an objective, checked against the program, in case the tableau is wrong.
    fn optimum(&self, table: &mut Table, costs: &[RBig]) -> Vec<RBig> {
        let x = table.optimum(costs);
        for row in &self.rows {
            let sum = row.entries.iter().fold(RBig::ZERO, |sum, (k, v)| sum + v * &x[*k]);
            let kept = if row.equality { sum == row.bound } else { sum <= row.bound };
            assert!(kept, "the solution violates a row");
        }
        assert!(x.iter().all(|v| *v >= RBig::ZERO), "the solution has a negative unknown");
        x
    }
}

struct Table {
    /// One row per row of the program, with the bound as the last entry. All entries are divided by `denominator`.
    rows: Vec<Vec<IBig>>,
    /// The basic unknown of each row.
    basis: Vec<Basic>,
    /// The objective to minimise: reduced costs, and last its value with the sign changed, all divided by
    /// `denominator`.
    objective: Vec<IBig>,
    denominator: IBig,
    width: usize,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Basic {
    /// Leaves first if several unknowns could leave, and never enters again.
    Artificial,
    Unknown(usize),
}

impl Table {
    fn new(program: &LinearProgram) -> Table {
        let unknowns = program.costs.len();
        let slacks = program.rows.iter().filter(|r| !r.equality).count();
        let width = unknowns + slacks + 1;
        let (mut rows, mut basis) = (Vec::new(), Vec::new());
        let mut slack = unknowns;
        for row in &program.rows {
            let values = row.entries.iter().map(|e| &e.1).chain([&row.bound]);
            let common = values.fold(UBig::ONE, |c, v| lcm(c, v.denominator()));
            let whole = |v: &RBig| (v * &RBig::from(common.clone())).into_parts().0;
            let mut line = vec![IBig::ZERO; width];
            for (k, value) in &row.entries {
                line[*k] += whole(value);
            }
            line[width - 1] = whole(&row.bound);
            let content = line.iter().filter(|v| !v.is_zero()).fold(UBig::ZERO, |g, v| {
                if g.is_zero() { v.clone().unsigned_abs() } else { g.gcd(v.clone().unsigned_abs()) }
            });
            if !content.is_zero() {
                let content = IBig::from(content);
                line.iter_mut().for_each(|v| *v = &*v / &content);
            }
            if row.equality {
                if line[width - 1] < IBig::ZERO {
                    line.iter_mut().for_each(|v| *v = -&*v);
                }
                basis.push(Basic::Artificial);
            } else {
                assert!(row.bound >= RBig::ZERO, "the bound of an inequality is negative");
                line[slack] = IBig::ONE;
                basis.push(Basic::Unknown(slack));
                slack += 1;
            }
            rows.push(line);
        }
        Table { rows, basis, objective: Vec::new(), denominator: IBig::ONE, width }
    }

    /// Makes all artificial unknowns 0. False if this is impossible.
    fn reach_feasible(&mut self) -> bool {
        self.objective = vec![IBig::ZERO; self.width];
        for (row, basic) in self.rows.iter().zip(&self.basis) {
            if *basic == Basic::Artificial {
                for (sum, value) in self.objective.iter_mut().zip(row) {
                    *sum -= value;
                }
            }
        }
        while !self.objective[self.width - 1].is_zero() {
            if !self.step() {
                return false;
            }
        }
        true
    }

    /// The unknowns at the optimum, found from a feasible basis.
    fn optimum(&mut self, costs: &[RBig]) -> Vec<RBig> {
        self.drop_artificials();
        let common = costs.iter().fold(UBig::ONE, |c, v| lcm(c, v.denominator()));
        let whole = |v: &RBig| (v * &RBig::from(common.clone())).into_parts().0;
        let mut cost: Vec<IBig> = costs.iter().map(whole).collect();
        cost.resize(self.width, IBig::ZERO);
        self.objective = cost.iter().map(|c| c * &self.denominator).collect();
        for (row, basic) in self.rows.iter().zip(&self.basis) {
            if let Basic::Unknown(k) = basic {
                for (reduced, value) in self.objective.iter_mut().zip(row) {
                    *reduced -= &cost[*k] * value;
                }
            }
        }
        while self.step() {}
        let mut x = vec![RBig::ZERO; costs.len()];
        for (row, basic) in self.rows.iter().zip(&self.basis) {
            if let Basic::Unknown(k) = basic
                && *k < x.len()
            {
                let amount = row[self.width - 1].clone();
                x[*k] = RBig::from_parts_signed(amount, self.denominator.clone());
            }
        }
        x
    }

    /// Replaces the artificial unknowns in the basis, which are all 0, and removes redundant rows.
    fn drop_artificials(&mut self) {
        let mut r = 0;
        while r < self.rows.len() {
            if self.basis[r] != Basic::Artificial {
                r += 1;
                continue;
            }
            match (0..self.width - 1).find(|k| !self.rows[r][*k].is_zero()) {
                Some(k) => {
                    if self.rows[r][k] < IBig::ZERO {
                        self.rows[r].iter_mut().for_each(|v| *v = -&*v);
                    }
                    self.pivot(r, k);
                }
                None => {
                    self.rows.swap_remove(r);
                    self.basis.swap_remove(r);
                }
            }
        }
    }

    /// Pivots until the objective improves. False at the optimum.
    fn step(&mut self) -> bool {
        for idle in 0.. {
            let lowers = |k: &usize| self.objective[*k] < IBig::ZERO;
            let entering = if idle < PATIENCE {
                (0..self.width - 1).filter(lowers).min_by(|a, b| self.objective[*a].cmp(&self.objective[*b]))
            } else {
                (0..self.width - 1).find(lowers)
            };
            let Some(k) = entering else {
                return false;
            };
            let Some(r) = self.leaving(k) else {
                unreachable!("costs are not negative, so the objective is bounded");
            };
            let gains = !self.rows[r][self.width - 1].is_zero();
            self.pivot(r, k);
            if gains {
                break;
            }
        }
        true
    }

    /// The row whose basic unknown first reaches 0 as unknown `k` grows.
    fn leaving(&self, k: usize) -> Option<usize> {
        let bound = |r: usize| &self.rows[r][self.width - 1];
        (0..self.rows.len()).filter(|r| self.rows[*r][k] > IBig::ZERO).min_by(|a, b| {
            let (left, right) = (bound(*a) * &self.rows[*b][k], bound(*b) * &self.rows[*a][k]);
            left.cmp(&right).then(self.basis[*a].cmp(&self.basis[*b]))
        })
    }

    /// Solves row `r` for unknown `k`, whose entry is positive.
    fn pivot(&mut self, r: usize, k: usize) {
        let line = std::mem::take(&mut self.rows[r]);
        let pivot = line[k].clone();
        // The pivot row was taken out and is empty.
        let others = self.rows.iter_mut().chain([&mut self.objective]);
        for row in others.filter(|row| !row.is_empty()) {
            let factor = std::mem::take(&mut row[k]);
            for (j, value) in row.iter_mut().enumerate() {
                if j == k || (value.is_zero() && (factor.is_zero() || line[j].is_zero())) {
                    continue;
                }
                let mut next = &*value * &pivot;
                if !factor.is_zero() && !line[j].is_zero() {
                    next -= &factor * &line[j];
                }
                *value = next / &self.denominator;
            }
        }
        self.rows[r] = line;
        self.denominator = pivot;
        self.basis[r] = Basic::Unknown(k);
    }
}

fn lcm(a: UBig, b: &UBig) -> UBig {
    let common = (&a).gcd(b);
    a / common * b
}
