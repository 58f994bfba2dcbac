//! [`extreme`]: from a motion in a cone of admissible motions to one on an extreme ray of it.
//!
//! The cone is {y : rᵢ·y ≥ 0 for all rows rᵢ}. A motion in its interior is a sum of several elementary ones; an extreme
//! ray is one that is no such sum, so it has as few hinges and slips as any. The way there keeps the power b·y and every
//! row that is tight: in the space that these leave, y goes along the direction in which the sum of all openings shrinks
//! fastest, until the next row becomes tight, and so on until there is no direction left. Pure numbers: rows of length
//! about 1, motions of size about 1.

/// A row or an objective: places of its entries and the entries.
pub(crate) type Row = Vec<(usize, f64)>;

/// A row is tight where its value is at most this share of the motion's size.
const TIGHT: f64 = 1e-7;
/// A direction shorter than this has been used up by the directions before it.
const DEPENDENT: f64 = 1e-8;

/// The motion on an extreme ray of the cone, of the same power as the first; `None` where the first has no power.
///
/// `start` does not have to lie in the cone exactly: rows that it violates by a solver's error count as tight.
pub(crate) fn extreme(rows: &[Row], power: &[(usize, f64)], start: &[f64]) -> Option<Vec<f64>> {
    let size = norm(start);
    let given = dot(power, start);
    if size.is_nan() || size <= 0.0 || given.is_nan() || given <= 0.0 {
        return None;
    }
    let count = start.len();
    let mut y: Vec<f64> = start.iter().map(|v| v / size).collect();
    let mut left = Space::all(count);
    left.cut(power);
    let mut open: Vec<&Row> = Vec::new();
    for row in rows {
        if dot(row, &y) <= TIGHT {
            left.cut(row);
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
    while let Some(first) = left.basis.first() {
        let before = left.basis.len();
        let shrinking: Vec<f64> = left.projected(&openings).iter().map(|v| -v).collect();
        let along = if norm(&shrinking) > DEPENDENT {
            unit(&shrinking)
        } else {
            unit(first)
        };
        let back: Vec<f64> = along.iter().map(|v| -v).collect();
        let step = |d: &[f64]| {
            let reach = |row: &&Row| {
                let (closing, now) = (dot(row, d), dot(row, &y));
                (closing < -DEPENDENT).then(|| now.max(0.0) / -closing)
            };
            open.iter().filter_map(reach).reduce(f64::min)
        };
        let way = match (step(&along), step(&back)) {
            (Some(far), _) => Some((far, along)),
            (None, Some(far)) => Some((far, back)),
            // Nothing is in the way: bodies that touch nothing. What of the motion lies along it is not needed.
            (None, None) => {
                let share: f64 = along.iter().zip(&y).map(|(d, v)| d * v).sum();
                left.cut(&dense(&along));
                Some((-share, along))
            }
        };
        if let Some((far, direction)) = way {
            for (v, d) in y.iter_mut().zip(&direction) {
                *v += far * d;
            }
        }
        let limit = TIGHT * norm(&y).max(1.0);
        let (tight, still): (Vec<&Row>, Vec<&Row>) =
            open.into_iter().partition(|row| dot(row, &y) <= limit);
        for row in tight {
            left.cut(row);
        }
        open = still;
        // A step that closes nothing new would be repeated for ever.
        if left.basis.len() == before {
            left.basis.pop();
        }
    }
    Some(y)
}

/// The motion nearest to `y` for which all rows are zero.
pub(crate) fn nearest(rows: &[Row], y: &[f64]) -> Vec<f64> {
    let mut left = Space::all(y.len());
    for row in rows {
        left.cut(row);
    }
    left.projected(y)
}

/// What of the space of motions is left, by an orthonormal basis.
struct Space {
    basis: Vec<Vec<f64>>,
}

impl Space {
    fn all(count: usize) -> Space {
        let axis = |k: usize| {
            let mut axis = vec![0.0; count];
            axis[k] = 1.0;
            axis
        };
        Space {
            basis: (0..count).map(axis).collect(),
        }
    }

    /// Keeps what is square to a row: the basis turned so that one of its vectors lies along the row, and that one left
    /// out.
    fn cut(&mut self, row: &[(usize, f64)]) {
        let mut seen: Vec<f64> = self.basis.iter().map(|b| dot(row, b)).collect();
        let length = norm(&seen);
        if length <= DEPENDENT {
            return;
        }
        let Some(last) = self.basis.pop() else { return };
        // Householder: the reflection that takes what the row sees to the last axis.
        for v in &mut seen {
            *v /= length;
        }
        let end = seen.len() - 1;
        let sign = if seen[end] < 0.0 { -1.0 } else { 1.0 };
        seen[end] += sign;
        let squared: f64 = seen.iter().map(|v| v * v).sum();
        let mut mixed: Vec<f64> = last.iter().map(|v| v * seen[end]).collect();
        for (basis, share) in self.basis.iter().zip(&seen) {
            for (m, b) in mixed.iter_mut().zip(basis) {
                *m += share * b;
            }
        }
        for (basis, share) in self.basis.iter_mut().zip(&seen) {
            let factor = 2.0 * share / squared;
            for (b, m) in basis.iter_mut().zip(&mixed) {
                *b -= factor * m;
            }
        }
    }

    /// What of a vector lies in the space.
    fn projected(&self, vector: &[f64]) -> Vec<f64> {
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

fn unit(y: &[f64]) -> Vec<f64> {
    let size = norm(y);
    y.iter().map(|v| v / size).collect()
}

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
        let y = extreme(&rows, &power, &[3.0, 1.0, 0.5]).expect("it has power");
        let tight = y.iter().filter(|v| v.abs() < 1e-9).count();
        assert_eq!(tight, 2, "{y:?}");
        assert!(dot(&power, &y) > 0.0 && y.iter().all(|v| *v > -1e-9));
    }

    #[test]
    fn a_motion_on_a_ray_stays_there_and_one_without_power_has_none() {
        let rows = rows(&[&[1.0, -1.0], &[0.0, 1.0]]);
        let y = extreme(&rows, &dense(&[1.0, 0.0]), &[2.0, 2.0]).expect("it has power");
        assert!((y[0] - y[1]).abs() < 1e-9 && y[0] > 0.1);
        assert_eq!(extreme(&rows, &dense(&[1.0, 0.0]), &[0.0, 0.0]), None);
        assert_eq!(extreme(&rows, &dense(&[-1.0, 0.0]), &[2.0, 1.0]), None);
    }

    #[test]
    fn without_rows_the_motion_follows_the_load() {
        let y = extreme(&[], &dense(&[0.0, -2.0, 0.0]), &[0.3, -1.0, 0.2]).expect("it has power");
        assert!(
            y[0].abs() < 1e-9 && y[2].abs() < 1e-9 && y[1] < 0.0,
            "{y:?}"
        );
    }

    #[test]
    fn the_nearest_motion_obeys_every_row() {
        let rows = rows(&[&[1.0, 1.0, 0.0], &[0.0, 1.0, 1.0], &[1.0, 0.0, -1.0]]);
        let y = nearest(&rows, &[1.0, 0.0, 0.0]);
        assert!(rows.iter().all(|r| dot(r, &y).abs() < 1e-12));
        // (1, −1, 1)/√3 spans what is left.
        assert!((y[0] - 1.0 / 3.0).abs() < 1e-12 && (y[1] + 1.0 / 3.0).abs() < 1e-12);
    }
}
