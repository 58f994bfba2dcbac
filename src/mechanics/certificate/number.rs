//! [`Number`]: what the checks compute with. Intervals decide most proofs, sooner than [`Rational`] numbers, which decide
//! the others.

use std::cell::Cell;

pub(super) use dashu_ratio::Relaxed as Rational;

use crate::mechanics::solve::is_late;

/// The work that the check of a certificate may need, and further work for each of its bytes; the unit is a product of two
/// words of 64 bits. A thousand million of them take about a second. Certificates of this program need at most 500 for
/// each byte.
pub(super) const WORK: [u64; 2] = [2_000_000_000, 1_500];

thread_local! {
    /// The work that is left for the check of a certificate on this thread.
    static LEFT: Cell<u64> = const { Cell::new(u64::MAX) };
}

/// Allows this amount of work from now on.
pub(super) fn allow(work: u64) {
    LEFT.set(work);
}

/// Counts work.
pub(super) fn spend(work: usize) {
    LEFT.set(LEFT.get().saturating_sub(work as u64));
}

/// True if no work is left, or the deadline has passed. Loops then end, and the proof is given up.
pub(super) fn is_spent() -> bool {
    LEFT.get() == 0 || is_late()
}

/// Counts an operation on numbers with as many words together as these.
fn operate(numbers: [&Rational; 2]) {
    let words = numbers.map(|n| 1 + n.numerator().as_sign_words().1.len().max(n.denominator().as_words().len()));
    spend(30 + words[0] * words[1]);
}

/// An exact number, or an interval that contains it. A test such as [`Number::is_positive`] is true only if every number
/// of the interval passes it.
pub(super) trait Number: Clone {
    /// Returns the exact value of a double.
    fn exact(value: f64) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    /// Returns the quotient; `None` if the divisor is 0, or if its interval contains 0.
    fn over(&self, other: &Self) -> Option<Self>;
    fn magnitude(&self) -> Self;
    fn is_zero(&self) -> bool;
    fn is_at_most_zero(&self) -> bool;
    fn is_positive(&self) -> bool;
    /// Returns the number rounded to a double; the upper end of an interval.
    fn float(&self) -> f64;
    /// Returns the same number as a fraction in lowest terms; an interval stays as it is.
    fn reduced(&self) -> Self;
    /// Whether a test that is false proves the opposite. An interval may be too wide for that.
    const DECIDES: bool;

    fn zero() -> Self {
        Self::exact(0.0)
    }

    fn negative(&self) -> Self {
        Self::zero().minus(self)
    }
}

impl Number for Rational {
    const DECIDES: bool = true;

    /// Only finite numbers come here: JSON contains no others.
    fn exact(value: f64) -> Rational {
        Rational::try_from(value).unwrap_or(Rational::ZERO)
    }

    fn plus(&self, other: &Rational) -> Rational {
        operate([self, other]);
        self + other
    }

    fn minus(&self, other: &Rational) -> Rational {
        operate([self, other]);
        self - other
    }

    fn times(&self, other: &Rational) -> Rational {
        operate([self, other]);
        self * other
    }

    fn over(&self, other: &Rational) -> Option<Rational> {
        operate([self, other]);
        (*other != Rational::ZERO).then(|| self / other)
    }

    fn magnitude(&self) -> Rational {
        if *self < Rational::ZERO { -self.clone() } else { self.clone() }
    }

    fn is_zero(&self) -> bool {
        *self == Rational::ZERO
    }

    fn is_at_most_zero(&self) -> bool {
        *self <= Rational::ZERO
    }

    fn is_positive(&self) -> bool {
        *self > Rational::ZERO
    }

    fn float(&self) -> f64 {
        self.to_f64().value()
    }

    fn reduced(&self) -> Rational {
        // A common divisor takes about four times as long as a product.
        (0..4).for_each(|_| operate([self, self]));
        self.clone().canonicalize().relax()
    }
}

/// All numbers between two doubles. Each operation makes the interval wide enough for its rounding errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    const ALL: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY };
    const ZERO: Interval = Interval { low: 0.0, high: 0.0 };

    /// Returns an interval that contains the exact values of which these are the rounded ones.
    fn around<const N: usize>(results: [f64; N]) -> Interval {
        spend(2);
        if !results.iter().all(|result| result.is_finite()) {
            return Interval::ALL;
        }
        let [low, high] = [f64::min, f64::max].map(|choose| results.into_iter().fold(results[0], choose));
        Interval { low: low.next_down(), high: high.next_up() }
    }

    fn bounds(self) -> [f64; 2] {
        [self.low, self.high]
    }
}

impl Number for Interval {
    const DECIDES: bool = false;

    fn exact(value: f64) -> Interval {
        if value.is_finite() { Interval { low: value, high: value } } else { Interval::ALL }
    }

    fn plus(&self, other: &Interval) -> Interval {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { *other } else { *self };
        }
        Interval::around([self.low + other.low, self.high + other.high])
    }

    fn minus(&self, other: &Interval) -> Interval {
        // Two equal doubles differ by nothing.
        if self == other && self.low == self.high {
            return Interval::ZERO;
        }
        self.plus(&Interval { low: -other.high, high: -other.low })
    }

    fn times(&self, other: &Interval) -> Interval {
        if self.is_zero() || other.is_zero() {
            return Interval::ZERO;
        }
        let ([a, b], [c, d]) = (self.bounds(), other.bounds());
        Interval::around([a * c, a * d, b * c, b * d])
    }

    fn over(&self, other: &Interval) -> Option<Interval> {
        let ([a, b], [c, d]) = (self.bounds(), other.bounds());
        let is_certain = c > 0.0 || d < 0.0;
        is_certain.then(|| if self.is_zero() { *self } else { Interval::around([a / c, a / d, b / c, b / d]) })
    }

    fn magnitude(&self) -> Interval {
        let least = self.low.max(-self.high).max(0.0);
        Interval { low: least, high: self.high.max(-self.low) }
    }

    fn is_zero(&self) -> bool {
        *self == Interval::ZERO
    }

    fn is_at_most_zero(&self) -> bool {
        self.high <= 0.0
    }

    fn is_positive(&self) -> bool {
        self.low > 0.0
    }

    fn float(&self) -> f64 {
        self.high
    }

    fn reduced(&self) -> Interval {
        *self
    }
}
