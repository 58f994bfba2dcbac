//! [`Simplex`]: a basis of a linear program of forces, and the moves of the primal simplex method.
//!
//! The constraints of the program are Σ amount·column = loads, with a lower and an upper bound for each amount. A
//! *basis* has one column for each row. The amounts of all other columns are fixed, usually at a bound, and the rows
//! determine the amounts of the basic columns. A move changes the amount of one other column until a basic amount
//! reaches a bound; the two columns then change places. The ratio test is that of [Harris73](crate::doc::references).

use super::basis_factor::{BasisFactor, Pivot, SparseColumn};

/// An amount of a program, with bounds.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    /// The coefficients in the rows.
    pub column: SparseColumn,
    /// The least amount; −∞ without a bound.
    pub lower: f64,
    /// The largest amount; ∞ without a bound.
    pub upper: f64,
    /// The present amount.
    pub amount: f64,
}

/// How a move ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Move {
    /// The column reached its other bound, or became basic in place of a column that reached a bound.
    Done,
    /// No amount reaches a bound: the move has no end.
    Endless,
}

/// A basic column whose amount changes by less than this, per unit of the entering column, cannot leave the basis. A
/// smaller change of the force of a polygon is rounding, too. The coefficients are near 1 and their rounding is about
/// 1e-13. With 1e-11, the new basis could be close to singular; with 1e-7, small forces of long chains would be missed.
pub(super) const MIN_PIVOT: f64 = 1e-9;

/// An amount may be beyond its bound by this. The largest load is 1. The proof accepts errors of 1e-7 of the forces on
/// each block. With 1e-9, the forces on light blocks would have no proof; with 1e-12, rounding would count as a
/// violation.
const BOUND_TOL: f64 = 1e-11;

/// The basis is factored again after this many moves. With more moves, solutions take longer and rounding errors
/// accumulate; with fewer, factorizations take most of the time.
const MAX_REPLACEMENTS: usize = 16;

/// The basis is also factored again if the pivot of a move is small: the change of the leaving amount, per unit of the
/// entering column, is below this fraction of the largest change. Otherwise, the division by this pivot would amplify
/// rounding errors.
const SMALL_PIVOT: f64 = 1e-3;

/// A basis of a program, its factor, and the amounts of all columns.
#[derive(Clone, Debug)]
pub(super) struct Simplex {
    /// The columns of the program, followed by a unit column for each row, whose amount is 0.
    pub variables: Vec<Variable>,
    loads: Vec<f64>,
    /// The basic variable at each position of the factor.
    basis: Vec<usize>,
    /// The position of each variable in the basis; `None` for variables outside the basis.
    position: Vec<Option<usize>>,
    factor: BasisFactor,
}

impl Simplex {
    /// Chooses a basis among the given columns; columns with a smaller `rank` are preferred. Unit columns complete the
    /// basis if necessary. All columns outside the basis keep their amounts.
    pub fn new(mut variables: Vec<Variable>, loads: Vec<f64>, rank: impl Fn(usize) -> usize) -> Simplex {
        let (given, rows) = (variables.len(), loads.len());
        let columns = variables.iter().map(|v| v.column.clone()).collect();
        let factor = BasisFactor::new(columns, rows, rank);
        variables.extend((0..rows).map(|row| Variable {
            column: vec![(row, 1.0)],
            lower: 0.0,
            upper: 0.0,
            amount: 0.0,
        }));
        let basic = |(row, pivot): (usize, &Pivot)| match pivot {
            Pivot::Column(k) => *k,
            Pivot::Unit => given + row,
        };
        let mut simplex = Simplex {
            position: vec![None; variables.len()],
            basis: factor.pivots.iter().enumerate().map(basic).collect(),
            variables,
            loads,
            factor,
        };
        simplex.set_basic_amounts();
        simplex
    }

    /// True if a variable belongs to the basis.
    pub fn is_basic(&self, variable: usize) -> bool {
        self.position[variable].is_some()
    }

    /// Returns, for each row, by how much the amount of a basic variable changes per unit of load in this row. These
    /// are the multipliers y of the rows, with columnᵀy = 1 for this variable and 0 for the other basic columns. All
    /// are 0 for a variable outside the basis.
    pub fn multipliers(&self, variable: usize) -> Vec<f64> {
        let mut y = vec![0.0; self.loads.len()];
        if let Some(position) = self.position[variable] {
            y[position] = 1.0;
            self.factor.solve_transposed(&mut y);
        }
        y
    }

    /// Increases (`sign` = 1) or decreases (`sign` = −1) the amount of a variable outside the basis until this amount
    /// or a basic amount reaches a bound. If no amount reaches a bound, changes nothing and returns [`Move::Endless`].
    /// `None` if the new basis is singular.
    pub fn move_amount(&mut self, variable: usize, sign: f64) -> Option<Move> {
        let mut change = vec![0.0; self.loads.len()];
        for (row, value) in &self.variables[variable].column {
            change[*row] = *value;
        }
        self.factor.solve(&mut change);
        let own = &self.variables[variable];
        let own_range = if sign > 0.0 { own.upper - own.amount } else { own.amount - own.lower };
        match self.ratio_test(&change, -sign) {
            Some((step, position)) if step < own_range => {
                let leaving = self.basis[position];
                let bounded = &mut self.variables[leaving];
                bounded.amount = if sign * change[position] > 0.0 { bounded.lower } else { bounded.upper };
                self.variables[variable].amount += sign * step;
                self.replace(position, variable, &change)?;
            }
            _ if own_range.is_finite() => {
                self.variables[variable].amount += sign * own_range;
                self.set_basic_amounts();
            }
            _ => return Some(Move::Endless),
        }
        Some(Move::Done)
    }

    /// Changes the amount of a variable outside the basis by `change`, and the basic amounts with it. Bounds are not
    /// checked.
    pub fn step(&mut self, variable: usize, change: f64) {
        self.variables[variable].amount += change;
        self.set_basic_amounts();
    }

    /// Ratio test in two passes: returns the longest step that keeps all bounds of the basic amounts up to a small
    /// tolerance, and the position of the amount that reaches its bound. The amounts change by `sign` · `change` per
    /// unit of the step. If several amounts reach a bound, the one with the largest change is taken, because the new
    /// basis is then farthest from singular. `None` if no amount reaches a bound.
    fn ratio_test(&self, change: &[f64], sign: f64) -> Option<(f64, usize)> {
        // The distance of a basic amount to the bound that it approaches, and its change per unit of the step.
        let approaching = change.iter().enumerate().filter_map(|(position, change)| {
            let rate = sign * change;
            let basic = &self.variables[self.basis[position]];
            let distance = if rate < 0.0 { basic.amount - basic.lower } else { basic.upper - basic.amount };
            (rate.abs() > MIN_PIVOT && distance < f64::INFINITY).then_some((distance.max(0.0), rate.abs(), position))
        });
        let steps = approaching.clone().map(|(distance, rate, _)| (distance + BOUND_TOL) / rate);
        let longest = steps.reduce(f64::min)?;
        let first = approaching.filter(|(distance, rate, _)| *distance <= longest * rate);
        let (distance, rate, position) = first.max_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((distance / rate, position))
    }

    /// Replaces the basic variable at a position by `variable`. `change` contains the coefficients of the new column as
    /// a combination of the basic columns. `None` if the new basis is singular.
    fn replace(&mut self, position: usize, variable: usize, change: &[f64]) -> Option<()> {
        self.position[self.basis[position]] = None;
        self.basis[position] = variable;
        let largest = change.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let is_small = change[position].abs() < SMALL_PIVOT * largest;
        if self.factor.replace(position, change) >= MAX_REPLACEMENTS || is_small {
            return self.factor_again();
        }
        self.set_basic_amounts();
        Some(())
    }

    /// Factors the basis again. `None` if it is singular.
    fn factor_again(&mut self) -> Option<()> {
        let columns = self.basis.iter().map(|k| self.variables[*k].column.clone());
        self.factor = BasisFactor::new(columns.collect(), self.loads.len(), |_| 0);
        let order = self.factor.pivots.iter().map(|pivot| match pivot {
            Pivot::Column(k) => Some(self.basis[*k]),
            Pivot::Unit => None,
        });
        self.basis = order.collect::<Option<_>>()?;
        self.position.fill(None);
        self.set_basic_amounts();
        Some(())
    }

    /// Computes the amounts of the basic variables from the loads and the amounts of the others.
    fn set_basic_amounts(&mut self) {
        for (position, variable) in self.basis.iter().enumerate() {
            self.position[*variable] = Some(position);
        }
        let mut amounts = self.loads.clone();
        for (variable, position) in self.variables.iter().zip(&self.position) {
            if position.is_none() && variable.amount != 0.0 {
                let column = variable.column.iter();
                column.for_each(|(row, value)| amounts[*row] -= value * variable.amount);
            }
        }
        self.factor.solve(&mut amounts);
        for (variable, amount) in self.basis.iter().zip(amounts) {
            self.variables[*variable].amount = amount;
        }
    }
}
