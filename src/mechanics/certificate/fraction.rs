//! [`Vector`] and [`Wrench`]: points, forces and motions of exact numbers, and the equations of a correction.

pub(super) use super::number::{Number, Rational};

use super::Pair;
use super::number::{is_spent, spend};

/// A vector or a point.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Vector<N = Rational> {
    pub x: N,
    pub y: N,
}

impl<N: Number> Vector<N> {
    pub fn new([x, y]: Pair) -> Vector<N> {
        Vector { x: N::exact(x), y: N::exact(y) }
    }

    pub fn minus(&self, other: &Vector<N>) -> Vector<N> {
        Vector { x: self.x.minus(&other.x), y: self.y.minus(&other.y) }
    }

    pub fn times(&self, factor: &N) -> Vector<N> {
        Vector { x: self.x.times(factor), y: self.y.times(factor) }
    }

    /// Returns the point that lies the fraction `share` of the way from this point to `other`.
    pub fn toward(&self, other: &Vector<N>, share: &N) -> Vector<N> {
        let along = other.minus(self).times(share);
        Vector { x: self.x.plus(&along.x), y: self.y.plus(&along.y) }
    }

    pub fn dot(&self, other: &Vector<N>) -> N {
        self.x.times(&other.x).plus(&self.y.times(&other.y))
    }

    pub fn cross(&self, other: &Vector<N>) -> N {
        self.x.times(&other.y).minus(&self.y.times(&other.x))
    }

    /// This vector turned by 90° anticlockwise.
    pub fn turned(&self) -> Vector<N> {
        Vector { x: self.y.negative(), y: self.x.clone() }
    }
}

/// A force with its moment about the origin; or the velocity of the origin with the angular velocity.
#[derive(Clone, Debug)]
pub(super) struct Wrench<N = Rational> {
    pub force: Vector<N>,
    pub moment: N,
}

impl<N: Number> Wrench<N> {
    pub fn zero() -> Wrench<N> {
        Wrench { force: Vector::new([0.0; 2]), moment: N::zero() }
    }

    pub fn of_force(force: &Vector<N>, at: &Vector<N>) -> Wrench<N> {
        Wrench { force: force.clone(), moment: at.cross(force) }
    }

    pub fn plus(&self, other: &Wrench<N>) -> Wrench<N> {
        let force = Vector { x: self.force.x.plus(&other.force.x), y: self.force.y.plus(&other.force.y) };
        Wrench { force, moment: self.moment.plus(&other.moment) }
    }

    pub fn minus(&self, other: &Wrench<N>) -> Wrench<N> {
        Wrench { force: self.force.minus(&other.force), moment: self.moment.minus(&other.moment) }
    }

    pub fn negative(&self) -> Wrench<N> {
        Wrench::zero().minus(self)
    }

    pub fn times(&self, factor: &N) -> Wrench<N> {
        Wrench { force: self.force.times(factor), moment: self.moment.times(factor) }
    }

    /// The power of this force along a motion.
    pub fn power(&self, motion: &Wrench<N>) -> N {
        self.force.dot(&motion.force).plus(&self.moment.times(&motion.moment))
    }

    /// The same numbers as fractions in lowest terms.
    pub fn reduced(&self) -> Wrench<N> {
        Wrench::of_entries(&self.entries().map(Number::reduced))
    }

    /// The wrench with these three numbers.
    pub fn of_entries(entries: &[N]) -> Wrench<N> {
        let [x, y, moment] = [0, 1, 2].map(|i| entries[i].clone());
        Wrench { force: Vector { x, y }, moment }
    }

    pub fn into_entries(self) -> [N; 3] {
        [self.force.x, self.force.y, self.moment]
    }

    pub fn entries(&self) -> [&N; 3] {
        [&self.force.x, &self.force.y, &self.moment]
    }
}

pub(super) fn square(value: &Rational) -> Rational {
    value * value
}

pub(super) fn square_length(vector: &Vector) -> Rational {
    vector.dot(vector)
}

/// Solves Σ amount · column = wanted by Cramer's rule; `None` if the columns depend on each other.
pub(super) fn solve<N: Number>(columns: &[Wrench<N>], wanted: &Wrench<N>) -> Option<[N; 3]> {
    let det = |a: &Wrench<N>, b: &Wrench<N>, c: &Wrench<N>| -> N {
        let minor = |p: &Wrench<N>, q: &Wrench<N>| p.force.cross(&q.force);
        a.moment.times(&minor(b, c)).plus(&b.moment.times(&minor(c, a))).plus(&c.moment.times(&minor(a, b)))
    };
    let [a, b, c] = columns else { return None };
    let whole = det(a, b, c);
    Some([det(wanted, b, c).over(&whole)?, det(a, wanted, c).over(&whole)?, det(a, b, wanted).over(&whole)?])
}

/// Solves equations, each a row of coefficients with its right side at the end, by elimination (Gauss and Jordan).
/// Unknowns that the others leave free are 0. `None` if the equations contradict each other.
pub(super) fn eliminate<N: Number>(mut rows: Vec<Vec<N>>, unknowns: usize) -> Option<Vec<N>> {
    if !N::DECIDES {
        return None;
    }
    spend(20 * rows.len() * unknowns);
    let mut pivots = Vec::new();
    for j in 0..unknowns {
        if is_spent() {
            return None;
        }
        let at = pivots.len();
        let Some(pivot) = (at..rows.len()).find(|row| !rows[*row][j].is_zero()) else { continue };
        rows.swap(at, pivot);
        let own: Option<Vec<N>> = rows[at].iter().map(|v| Some(v.over(&rows[at][j])?.reduced())).collect();
        let own = own?;
        for other in rows.iter_mut().filter(|row| !row[j].is_zero()) {
            if is_spent() {
                return None;
            }
            let factor = other[j].clone();
            for (value, own) in other.iter_mut().zip(&own).filter(|(_, own)| !own.is_zero()) {
                *value = value.minus(&factor.times(own)).reduced();
            }
        }
        rows[at] = own;
        pivots.push(j);
    }
    let mut found = vec![N::zero(); unknowns];
    for (row, j) in rows.iter().zip(&pivots) {
        found[*j] = row[unknowns].clone();
    }
    rows[pivots.len()..].iter().all(|row| row[unknowns].is_zero()).then_some(found)
}
