//! [`extreme_ray`]: from a motion in a cone of admissible motions to an extreme ray of the cone.
//!
//! The cone is {y : rᵢ·y ≥ 0 for all rows rᵢ}. A motion inside it is a sum of elementary ones. An extreme ray is not such a sum,
//! so it has as few hinges and slips as possible. Pure numbers: rows of length about 1, motions of size about 1.
//!
//! Purification (crossover of linear programming to a vertex, Megiddo 1991). All moves keep the power b·y and every row
//! that is tight, so they lie in the null space of these rows. Steps:
//!
//! 1. direction: the projection onto the null space along which Σ openings shrinks fastest;
//! 2. ratio test: move until the next row becomes tight;
//! 3. remove the new tight rows from the null space; repeat until it is empty.

/// A row or an objective, sparse: (index, value) entries.
pub(crate) type Row = Vec<(usize, f64)>;

/// A row is tight if its value is at most this fraction of the motion's size: a hundred times the solver's tolerance. Ten times
/// more would close hinges that are slightly open; a tenth would take a solver's error for an opening.
const TIGHT_TOL: f64 = 1e-7;

/// A projection shorter than this is 0: the row depends on those removed before, or the direction is used up.
const DEPENDENCE_TOL: f64 = 1e-8;

/// Returns a motion on an extreme ray of the cone, of the same power as the unit vector along `start`; `None` if `start` has
/// no power.
///
/// `start` does not have to lie in the cone exactly: rows that it violates by a solver's error count as tight.
pub(crate) fn extreme_ray(rows: &[Row], power: &[(usize, f64)], start: &[f64]) -> Option<Vec<f64>> {
    let (size, given) = (norm(start), dot(power, start));
    if size.is_nan() || size <= 0.0 || given.is_nan() || given <= 0.0 {
        return None;
    }
    let count = start.len();
    let mut y: Vec<f64> = start.iter().map(|v| v / size).collect();
    let mut null_space = NullSpace::whole(count);
    null_space.remove(power);
    let mut open: Vec<&Row> = Vec::new();
    for row in rows {
        if dot(row, &y) <= TIGHT_TOL {
            null_space.remove(row);
        } else {
            open.push(row);
        }
    }
    let mut openings = vec![0.0; count];
    for row in rows {
        for (k, value) in row {
            openings[*k] += value;
        }
    }
    while let Some(first) = null_space.basis.first() {
        let dimension = null_space.basis.len();
        // Step 1: steepest descent of Σ openings; any direction if they do not change.
        let shrinking = negated(&null_space.project(&openings));
        let along = if norm(&shrinking) > DEPENDENCE_TOL {
            unit(&shrinking)
        } else {
            unit(first)
        };
        // Step 2: forwards, or backwards if no row closes forwards.
        let back = negated(&along);
        let (step, direction) = match (max_step(&open, &y, &along), max_step(&open, &y, &back)) {
            (Some(step), _) => (step, along),
            (None, Some(step)) => (step, back),
            // No row closes either way: bodies that touch nothing. The motion does not need its part in this direction.
            (None, None) => {
                let share: f64 = along.iter().zip(&y).map(|(d, v)| d * v).sum();
                null_space.remove(&dense(&along));
                (-share, along)
            }
        };
        for (v, d) in y.iter_mut().zip(&direction) {
            *v += step * d;
        }
        // Step 3.
        let limit = TIGHT_TOL * norm(&y).max(1.0);
        let (tight, still_open): (Vec<&Row>, Vec<&Row>) =
            open.into_iter().partition(|row| dot(row, &y) <= limit);
        for row in tight {
            null_space.remove(row);
        }
        open = still_open;
        // A step that closes nothing new would be repeated for ever.
        if null_space.basis.len() == dimension {
            null_space.basis.pop();
        }
    }
    Some(y)
}

/// The ratio test: the longest step along a direction until a row becomes 0; `None` if none does.
fn max_step(open: &[&Row], y: &[f64], direction: &[f64]) -> Option<f64> {
    let step = |row: &&Row| {
        let (change, now) = (dot(row, direction), dot(row, y));
        (change < -DEPENDENCE_TOL).then(|| now.max(0.0) / -change)
    };
    open.iter().filter_map(step).reduce(f64::min)
}

/// The motion nearest to `y` for which all rows are zero.
pub(crate) fn project_onto_null_space(rows: &[Row], y: &[f64]) -> Vec<f64> {
    let mut null_space = NullSpace::whole(y.len());
    for row in rows {
        null_space.remove(row);
    }
    null_space.project(y)
}

/// The null space of some rows, by an orthonormal basis.
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
        NullSpace {
            basis: (0..count).map(axis).collect(),
        }
    }

    /// Keeps what is orthogonal to a row: a Householder reflection turns the basis until its last vector lies along the row's
    /// projection; that vector is removed.
    fn remove(&mut self, row: &[(usize, f64)]) {
        let mut components: Vec<f64> = self.basis.iter().map(|b| dot(row, b)).collect();
        let length = norm(&components);
        if length <= DEPENDENCE_TOL {
            return;
        }
        let Some(last) = self.basis.pop() else { return };
        // The reflection that maps the row's components to the last axis.
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

    /// The projection of a vector onto the space.
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

/// A dense vector as a row.
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
    fn inside_the_first_octant_a_ray_along_one_axis_is_found() {
        let rows = rows(&[&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]]);
        let power = dense(&[1.0, 2.0, -1.0]);
        let y = extreme_ray(&rows, &power, &[3.0, 1.0, 0.5]).expect("it has power");
        let tight = y.iter().filter(|v| v.abs() < 1e-9).count();
        assert_eq!(tight, 2, "{y:?}");
        assert!(dot(&power, &y) > 0.0 && y.iter().all(|v| *v > -1e-9));
    }

    #[test]
    fn a_motion_on_a_ray_stays_there_and_one_without_power_has_none() {
        let rows = rows(&[&[1.0, -1.0], &[0.0, 1.0]]);
        let y = extreme_ray(&rows, &dense(&[1.0, 0.0]), &[2.0, 2.0]).expect("it has power");
        assert!((y[0] - y[1]).abs() < 1e-9 && y[0] > 0.1);
        assert_eq!(extreme_ray(&rows, &dense(&[1.0, 0.0]), &[0.0, 0.0]), None);
        assert_eq!(extreme_ray(&rows, &dense(&[-1.0, 0.0]), &[2.0, 1.0]), None);
    }

    #[test]
    fn without_rows_the_motion_follows_the_load() {
        let y =
            extreme_ray(&[], &dense(&[0.0, -2.0, 0.0]), &[0.3, -1.0, 0.2]).expect("it has power");
        assert!(
            y[0].abs() < 1e-9 && y[2].abs() < 1e-9 && y[1] < 0.0,
            "{y:?}"
        );
    }

    #[test]
    fn the_nearest_motion_obeys_every_row() {
        let rows = rows(&[&[1.0, 1.0, 0.0], &[0.0, 1.0, 1.0], &[1.0, 0.0, -1.0]]);
        let y = project_onto_null_space(&rows, &[1.0, 0.0, 0.0]);
        assert!(rows.iter().all(|r| dot(r, &y).abs() < 1e-12));
        // (1, −1, 1)/√3 spans what is left.
        assert!((y[0] - 1.0 / 3.0).abs() < 1e-12 && (y[1] + 1.0 / 3.0).abs() < 1e-12);
    }
}
