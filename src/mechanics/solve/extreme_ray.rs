//! [`extreme_ray`]: moves from any motion in the cone of admissible motions to an extreme ray of the cone.
//!
//! The cone is {y : rᵢ·y ≥ 0 for all rows rᵢ}. A motion inside it is a sum of elementary motions. An extreme ray is not
//! such a sum, so it has as few hinges and slips as possible. A row is tight if rᵢ·y = 0; otherwise it is open, and
//! rᵢ·y is its opening. All numbers are dimensionless. Rows and motions have a length of about 1.
//!
//! The method is purification, the crossover of linear programming to a vertex (Megiddo 1991). No move changes the
//! power b·y or the value of a tight row, so all moves lie in the null space of b and the tight rows. Steps:
//!
//! 1. choose the direction in the null space along which Σ openings decreases fastest;
//! 2. move in this direction until the next row becomes tight (ratio test);
//! 3. restrict the null space to the directions that also keep the new tight rows; repeat until no direction is left.

/// A sparse row or objective: (index, value) entries.
pub(crate) type Row = Vec<(usize, f64)>;

/// A row is tight if its value is at most this fraction of the motion's size: a hundred times the solver's tolerance.
///
/// If this value were ten times larger, hinges that open slightly would be closed; if it were ten times smaller, a
/// solver's error would count as an opening.
const TIGHT_TOL: f64 = 1e-7;

/// The projection of a row onto the null space counts as 0 if it is shorter than this: the row then depends linearly on
/// rows that were removed before.
///
/// Rows have a length of about 1. The limit is far above the rounding of the basis, about 1e-14. Two rows that differ
/// by an angle above it count as independent.
const DEPENDENCE_TOL: f64 = 1e-8;

/// Returns a motion on an extreme ray of the cone {y : row·y ≥ 0 for all rows}. `power` contains the coefficients b of
/// the power b·y. The returned motion has the same power as `start` after `start` is scaled to length 1.
///
/// `None` if the power of `start` is not positive. `start` may lie slightly outside the cone: rows that it violates by
/// a solver's error count as tight.
pub(crate) fn extreme_ray(rows: &[Row], power: &[(usize, f64)], start: &[f64]) -> Option<Vec<f64>> {
    let (size, given) = (norm(start), dot(power, start));
    if size.is_nan() || size <= 0.0 || given.is_nan() || given <= 0.0 {
        return None;
    }
    let mut y: Vec<f64> = start.iter().map(|v| v / size).collect();
    let (mut null_space, mut open) = tight_rows_removed(rows, power, &y);
    let openings = sum_of_openings(rows, start.len());
    while let Some(first) = null_space.basis.first() {
        let dimension = null_space.basis.len();
        // Step 1: choose the direction of steepest descent of Σ openings. If no direction changes this sum, choose any
        // direction.
        let shrinking = negated(&null_space.project(&openings));
        let along = if norm(&shrinking) > DEPENDENCE_TOL { unit(&shrinking) } else { unit(first) };
        // Step 2: find the step forwards to the next tight row, or backwards if no row becomes tight forwards.
        let back = negated(&along);
        let (step, direction) = match (max_step(&open, &y, &along), max_step(&open, &y, &back)) {
            (Some(step), _) => (step, along),
            (None, Some(step)) => (step, back),
            // No row becomes tight in either direction: the bodies that move in this direction touch nothing. Remove
            // the direction from the motion.
            (None, None) => {
                let share: f64 = along.iter().zip(&y).map(|(d, v)| d * v).sum();
                null_space.remove(&dense(&along));
                (-share, along)
            }
        };
        for (v, d) in y.iter_mut().zip(&direction) {
            *v += step * d;
        }
        // Step 3: restrict the null space to directions that keep the rows that became tight.
        let limit = TIGHT_TOL * norm(&y).max(1.0);
        let (tight, still_open): (Vec<&Row>, Vec<&Row>) = open.into_iter().partition(|row| dot(row, &y) <= limit);
        for row in tight {
            null_space.remove(row);
        }
        open = still_open;
        // If no new row became tight, drop one direction. Otherwise the same step would be repeated forever.
        if null_space.basis.len() == dimension {
            null_space.basis.pop();
        }
    }
    Some(y)
}

/// Returns the null space of the vector `power` and of all rows that are tight at `y`, and a list of the rows that are
/// open (not tight).
fn tight_rows_removed<'r>(rows: &'r [Row], power: &[(usize, f64)], y: &[f64]) -> (NullSpace, Vec<&'r Row>) {
    let mut null_space = NullSpace::whole(y.len());
    null_space.remove(power);
    let mut open: Vec<&Row> = Vec::new();
    for row in rows {
        if dot(row, y) <= TIGHT_TOL {
            null_space.remove(row);
        } else {
            open.push(row);
        }
    }
    (null_space, open)
}

/// Returns the gradient of Σ openings with respect to the motion: the sum of all rows.
fn sum_of_openings(rows: &[Row], count: usize) -> Vec<f64> {
    let mut openings = vec![0.0; count];
    for (k, value) in rows.iter().flatten() {
        openings[*k] += value;
    }
    openings
}

/// Ratio test: returns the step from `y` along `direction` at which the first open row becomes tight. `None` if no open
/// row becomes tight.
fn max_step(open: &[&Row], y: &[f64], direction: &[f64]) -> Option<f64> {
    let step = |row: &&Row| {
        let (change, now) = (dot(row, direction), dot(row, y));
        (change < -DEPENDENCE_TOL).then(|| now.max(0.0) / -change)
    };
    open.iter().filter_map(step).reduce(f64::min)
}

/// Returns the motion m nearest to `y` with row·m = 0 for all rows: the projection of `y` onto the null space of the
/// rows.
pub(crate) fn project_onto_null_space(rows: &[Row], y: &[f64]) -> Vec<f64> {
    let mut null_space = NullSpace::whole(y.len());
    for row in rows {
        null_space.remove(row);
    }
    null_space.project(y)
}

/// An orthonormal basis of the null space of some rows.
struct NullSpace {
    basis: Vec<Vec<f64>>,
}

impl NullSpace {
    fn whole(count: usize) -> NullSpace {
        let axis = |k: usize| {
            let mut axis = vec![0.0; count];
            axis[k] = 1.0;
            axis
        };
        NullSpace { basis: (0..count).map(axis).collect() }
    }

    /// Restricts the space to the vectors orthogonal to a row.
    ///
    /// A Householder reflection rotates the basis until its last vector lies along the row's projection; then that
    /// vector is removed (Golub and Van Loan, Matrix Computations, 2013, §5.1).
    fn remove(&mut self, row: &[(usize, f64)]) {
        // Compute the components of the row in the basis.
        let mut components: Vec<f64> = self.basis.iter().map(|b| dot(row, b)).collect();
        let length = norm(&components);
        if length <= DEPENDENCE_TOL {
            return;
        }
        let Some(last) = self.basis.pop() else { return };
        // Apply the Householder reflection that maps the row's components to the last axis.
        for v in &mut components {
            *v /= length;
        }
        let end = components.len() - 1;
        let sign = if components[end] < 0.0 { -1.0 } else { 1.0 };
        components[end] += sign;
        let squared: f64 = components.iter().map(|v| v * v).sum();
        let mut mixed: Vec<f64> = last.iter().map(|v| v * components[end]).collect();
        for (basis, share) in self.basis.iter().zip(&components) {
            for (m, b) in mixed.iter_mut().zip(basis) {
                *m += share * b;
            }
        }
        for (basis, share) in self.basis.iter_mut().zip(&components) {
            let factor = 2.0 * share / squared;
            for (b, m) in basis.iter_mut().zip(&mixed) {
                *b -= factor * m;
            }
        }
    }

    /// Returns the projection of a vector onto the space.
    fn project(&self, vector: &[f64]) -> Vec<f64> {
        let mut sum = vec![0.0; vector.len()];
        for basis in &self.basis {
            let share: f64 = basis.iter().zip(vector).map(|(b, v)| b * v).sum();
            for (s, b) in sum.iter_mut().zip(basis) {
                *s += share * b;
            }
        }
        sum
    }
}

fn dot(row: &[(usize, f64)], y: &[f64]) -> f64 {
    row.iter().map(|(k, value)| value * y[*k]).sum()
}

fn norm(y: &[f64]) -> f64 {
    libm::sqrt(y.iter().map(|v| v * v).sum())
}

fn negated(y: &[f64]) -> Vec<f64> {
    y.iter().map(|v| -v).collect()
}

fn unit(y: &[f64]) -> Vec<f64> {
    let size = norm(y);
    y.iter().map(|v| v / size).collect()
}

/// Converts a dense vector to a sparse row.
fn dense(y: &[f64]) -> Row {
    y.iter().copied().enumerate().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(dense_rows: &[&[f64]]) -> Vec<Row> {
        dense_rows.iter().map(|r| dense(r)).collect()
    }

    #[test]
    fn in_the_first_octant_the_extreme_ray_is_an_axis() {
        let rows = rows(&[&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]]);
        let power = dense(&[1.0, 2.0, -1.0]);
        let y = extreme_ray(&rows, &power, &[3.0, 1.0, 0.5]).expect("it has power");
        let tight = y.iter().filter(|v| v.abs() < 1e-9).count();
        assert_eq!(tight, 2, "{y:?}");
        assert!(dot(&power, &y) > 0.0 && y.iter().all(|v| *v > -1e-9));
    }

    #[test]
    fn a_motion_on_an_extreme_ray_stays_there_and_a_motion_without_power_has_no_ray() {
        let rows = rows(&[&[1.0, -1.0], &[0.0, 1.0]]);
        let y = extreme_ray(&rows, &dense(&[1.0, 0.0]), &[2.0, 2.0]).expect("it has power");
        assert!((y[0] - y[1]).abs() < 1e-9 && y[0] > 0.1);
        assert_eq!(extreme_ray(&rows, &dense(&[1.0, 0.0]), &[0.0, 0.0]), None);
        assert_eq!(extreme_ray(&rows, &dense(&[-1.0, 0.0]), &[2.0, 1.0]), None);
    }

    #[test]
    fn without_rows_the_extreme_ray_is_along_the_load() {
        let y = extreme_ray(&[], &dense(&[0.0, -2.0, 0.0]), &[0.3, -1.0, 0.2]).expect("it has power");
        assert!(y[0].abs() < 1e-9 && y[2].abs() < 1e-9 && y[1] < 0.0, "{y:?}");
    }

    #[test]
    fn the_projection_is_orthogonal_to_every_row() {
        let rows = rows(&[&[1.0, 1.0, 0.0], &[0.0, 1.0, 1.0], &[1.0, 0.0, -1.0]]);
        let y = project_onto_null_space(&rows, &[1.0, 0.0, 0.0]);
        assert!(rows.iter().all(|r| dot(r, &y).abs() < 1e-12));
        // The null space is spanned by (1, −1, 1)/√3.
        assert!((y[0] - 1.0 / 3.0).abs() < 1e-12 && (y[1] + 1.0 / 3.0).abs() < 1e-12);
    }
}
