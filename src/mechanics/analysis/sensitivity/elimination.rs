//! [`Elimination`]: solves small dense systems of linear equations. If a system has many solutions, the result contains
//! a basis of its null space. If a system has no solution, the remaining error of its rows shows this.
//!
//! Gauss-Jordan elimination with complete pivoting. Reference: Golub and Van Loan, Matrix Computations, 2013, §3.4.

/// Numbers below this fraction of the largest are rounding: pivots, errors of equations, and amounts of forces. The row of
/// a pivot that counts as 0 depends on the rows before it.
///
/// The entries are near 1, and rounding reaches about 1e-13. With a value a hundred times larger, the solution of an
/// arch with very flat hinges would not count as unique. With a value a hundred times smaller, rounding would count as
/// a pivot.
pub(super) const ROUNDING_TOL: f64 = 1e-8;

/// Forces, velocities, displacements and differences of slopes below this fraction of the largest count as 0.
pub(super) const ZERO_TOL: f64 = 1e-7;

/// The solutions of a system of equations with several right-hand sides.
pub(super) struct Elimination {
    /// For each right-hand side, the solution in which the free unknowns are 0, and the largest remaining error of a
    /// row. If this error is large, the system has no solution for this right-hand side.
    pub solutions: Vec<(Vec<f64>, f64)>,
    /// A basis of the solutions for the right-hand side 0.
    pub null_space: Vec<Vec<f64>>,
}

impl Elimination {
    /// Solves a linear system for several right-hand sides. Each row has `unknowns` coefficients. Each list in `sides`
    /// is a right-hand side, with one number for each row.
    pub fn new(rows: &[Vec<f64>], unknowns: usize, sides: &[Vec<f64>]) -> Elimination {
        let mut table: Vec<Vec<f64>> = rows.to_vec();
        for (k, row) in table.iter_mut().enumerate() {
            row.extend(sides.iter().map(|side| side[k]));
        }
        let entries = rows.iter().flatten();
        let largest = entries.fold(0.0, |most: f64, v| most.max(v.abs()));
        // For each row that is already eliminated, the column of its pivot.
        let mut pivots: Vec<usize> = Vec::new();
        let mut is_free = vec![true; unknowns];
        while pivots.len() < table.len() {
            let first = pivots.len();
            let Some((row, column, size)) = largest_entry(&table[first..], &is_free) else {
                break;
            };
            if size <= ROUNDING_TOL * largest {
                break;
            }
            table.swap(first, first + row);
            clear_column(&mut table, first, column);
            is_free[column] = false;
            pivots.push(column);
        }
        let rank = pivots.len();
        let solution = |side: usize| {
            let mut solution = vec![0.0; unknowns];
            for (row, column) in table.iter().zip(&pivots) {
                solution[*column] = row[unknowns + side];
            }
            let errors = table[rank..].iter().map(|row| row[unknowns + side].abs());
            (solution, errors.fold(0.0, f64::max))
        };
        let null_vector = |free: usize| {
            let mut vector = vec![0.0; unknowns];
            vector[free] = 1.0;
            for (row, column) in table.iter().zip(&pivots) {
                vector[*column] = -row[free];
            }
            vector
        };
        Elimination {
            solutions: (0..sides.len()).map(solution).collect(),
            null_space: (0..unknowns).filter(|k| is_free[*k]).map(null_vector).collect(),
        }
    }
}

/// Returns the row, the column and the magnitude of the largest entry in the free columns. `None` if no column is free.
fn largest_entry(rows: &[Vec<f64>], is_free: &[bool]) -> Option<(usize, usize, f64)> {
    let mut best: Option<(usize, usize, f64)> = None;
    for (number, row) in rows.iter().enumerate() {
        for (column, value) in row.iter().take(is_free.len()).enumerate() {
            let size = value.abs();
            if is_free[column] && best.is_none_or(|(.., most)| size > most) {
                best = Some((number, column, size));
            }
        }
    }
    best
}

/// Makes one column of the table a unit vector: divides the pivot row by its entry in this column, and subtracts
/// multiples of the pivot row from all other rows.
fn clear_column(table: &mut [Vec<f64>], pivot: usize, column: usize) {
    let pivot_value = table[pivot][column];
    for value in &mut table[pivot] {
        *value /= pivot_value;
    }
    let pivot_row = table[pivot].clone();
    for (number, row) in table.iter_mut().enumerate() {
        let factor = row[column];
        if number != pivot && factor != 0.0 {
            for (value, pivot_entry) in row.iter_mut().zip(&pivot_row) {
                *value -= factor * pivot_entry;
            }
            row[column] = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Elimination;

    #[test]
    fn a_regular_system_has_one_solution_and_a_singular_one_a_line_of_them() {
        let rows = [vec![2.0, 1.0], vec![1.0, 3.0]];
        let found = Elimination::new(&rows, 2, &[vec![3.0, 5.0]]);
        let (solution, error) = &found.solutions[0];
        assert!((solution[0] - 0.8).abs() < 1e-14 && (solution[1] - 1.4).abs() < 1e-14);
        assert!(*error == 0.0 && found.null_space.is_empty());
        let rows = [vec![1.0, 2.0], vec![2.0, 4.0]];
        let found = Elimination::new(&rows, 2, &[vec![1.0, 2.0], vec![1.0, 0.0]]);
        assert!(found.solutions[0].1 < 1e-14 && found.solutions[1].1 > 0.1);
        let null = &found.null_space[0];
        assert!((null[0] + 2.0 * null[1]).abs() < 1e-14);
    }
}
