//! [`Vector`] and [`Wrench`]: points, forces and motions of rational numbers. No number is rounded.

pub(super) use dashu_ratio::Relaxed as Rational;

use super::Pair;

/// A vector or a point with rational coordinates.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Vector {
    pub x: Rational,
    pub y: Rational,
}

impl Vector {
    pub fn new([x, y]: Pair) -> Vector {
        Vector { x: exact(x), y: exact(y) }
    }

    pub fn minus(&self, other: &Vector) -> Vector {
        Vector { x: &self.x - &other.x, y: &self.y - &other.y }
    }

    pub fn dot(&self, other: &Vector) -> Rational {
        &self.x * &other.x + &self.y * &other.y
    }

    pub fn cross(&self, other: &Vector) -> Rational {
        &self.x * &other.y - &self.y * &other.x
    }

    /// This vector turned by 90° anticlockwise.
    pub fn turned(&self) -> Vector {
        Vector { x: -self.y.clone(), y: self.x.clone() }
    }
}

/// A force with its moment about the origin; or the velocity of the origin with the angular velocity.
#[derive(Clone, Debug)]
pub(super) struct Wrench {
    pub force: Vector,
    pub moment: Rational,
}

impl Wrench {
    pub fn zero() -> Wrench {
        Wrench { force: Vector { x: zero(), y: zero() }, moment: zero() }
    }

    pub fn of_force(force: &Vector, at: &Vector) -> Wrench {
        Wrench { force: force.clone(), moment: at.cross(force) }
    }

    pub fn plus(&self, other: &Wrench) -> Wrench {
        let force = Vector { x: &self.force.x + &other.force.x, y: &self.force.y + &other.force.y };
        Wrench { force, moment: &self.moment + &other.moment }
    }

    pub fn minus(&self, other: &Wrench) -> Wrench {
        Wrench { force: self.force.minus(&other.force), moment: &self.moment - &other.moment }
    }

    pub fn negative(&self) -> Wrench {
        Wrench::zero().minus(self)
    }

    pub fn times(&self, factor: &Rational) -> Wrench {
        let force = Vector { x: &self.force.x * factor, y: &self.force.y * factor };
        Wrench { force, moment: &self.moment * factor }
    }

    /// The power of this force along a motion.
    pub fn power(&self, motion: &Wrench) -> Rational {
        self.force.dot(&motion.force) + &self.moment * &motion.moment
    }

    pub fn largest(&self) -> Rational {
        [&self.force.x, &self.force.y, &self.moment].into_iter().map(magnitude).max().unwrap_or_else(zero)
    }

    /// The same numbers as fractions in lowest terms.
    pub fn reduced(&self) -> Wrench {
        let [x, y, moment] = self.entries().map(reduced);
        Wrench { force: Vector { x, y }, moment }
    }

    /// The wrench with these three numbers.
    pub fn of_entries(entries: &[Rational]) -> Wrench {
        let [x, y, moment] = [0, 1, 2].map(|i| entries[i].clone());
        Wrench { force: Vector { x, y }, moment }
    }

    pub fn into_entries(self) -> [Rational; 3] {
        [self.force.x, self.force.y, self.moment]
    }

    pub fn entries(&self) -> [&Rational; 3] {
        [&self.force.x, &self.force.y, &self.moment]
    }
}

/// The rational number that a double is. JSON has no infinite numbers, and the form has been checked.
pub(super) fn exact(value: f64) -> Rational {
    Rational::try_from(value).unwrap_or_else(|_| zero())
}

pub(super) fn zero() -> Rational {
    Rational::ZERO
}

pub(super) fn float(value: &Rational) -> f64 {
    value.to_f64().value()
}

pub(super) fn magnitude(value: &Rational) -> Rational {
    if *value < zero() { -value.clone() } else { value.clone() }
}

pub(super) fn square(value: &Rational) -> Rational {
    value * value
}

pub(super) fn square_length(vector: &Vector) -> Rational {
    vector.dot(vector)
}

/// Solves Σ amount · column = wanted by Cramer's rule; `None` if the columns depend on each other.
pub(super) fn solve(columns: &[Wrench], wanted: &Wrench) -> Option<[Rational; 3]> {
    let det = |a: &Wrench, b: &Wrench, c: &Wrench| -> Rational {
        let ([ax, ay, am], [bx, by, bm], [cx, cy, cm]) = (a.entries(), b.entries(), c.entries());
        ax * (by * cm - bm * cy) - ay * (bx * cm - bm * cx) + am * (bx * cy - by * cx)
    };
    let [a, b, c] = columns else { return None };
    let whole = det(a, b, c);
    (whole != zero()).then(|| [det(wanted, b, c) / &whole, det(a, wanted, c) / &whole, det(a, b, wanted) / &whole])
}

/// Solves equations, each a row of coefficients with its right side at the end, by elimination (Gauss and Jordan).
/// Unknowns that the others leave free are 0. `None` if the equations contradict each other.
pub(super) fn eliminate(mut rows: Vec<Vec<Rational>>, unknowns: usize) -> Option<Vec<Rational>> {
    let mut pivots = Vec::new();
    for j in 0..unknowns {
        let at = pivots.len();
        let Some(pivot) = (at..rows.len()).find(|row| rows[*row][j] != zero()) else { continue };
        rows.swap(at, pivot);
        let own: Vec<Rational> = rows[at].iter().map(|v| reduced(&(v / &rows[at][j]))).collect();
        for other in rows.iter_mut().filter(|row| row[j] != zero()) {
            let factor = other[j].clone();
            for (value, own) in other.iter_mut().zip(&own).filter(|(_, own)| **own != zero()) {
                *value = reduced(&(&*value - &factor * own));
            }
        }
        rows[at] = own;
        pivots.push(j);
    }
    let mut found = vec![zero(); unknowns];
    for (row, j) in rows.iter().zip(&pivots) {
        found[*j] = row[unknowns].clone();
    }
    rows[pivots.len()..].iter().all(|row| row[unknowns] == zero()).then_some(found)
}

/// The same number as a fraction in lowest terms.
fn reduced(value: &Rational) -> Rational {
    value.clone().canonicalize().relax()
}
