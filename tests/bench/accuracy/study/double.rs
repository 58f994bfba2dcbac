//! [`Double`]: double-double arithmetic with about 32 digits. Each number is stored as the sum of two f64.
//!
//! References: Dekker (1971), A floating-point technique for extending the available precision; Knuth's two-sum.
//! Products use the fused multiply-add, which is exact on every machine, in hardware or in software.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The number high + low, with |low| ≤ half a unit in the last place of high.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Double {
    high: f64,
    low: f64,
}

impl Double {
    /// 0.
    pub const ZERO: Double = Double { high: 0.0, low: 0.0 };

    /// Returns the `f64` that is nearest to this number.
    pub fn near(self) -> f64 {
        self.high
    }

    /// Returns the absolute value.
    pub fn abs(self) -> Double {
        if self.high < 0.0 { -self } else { self }
    }

    /// Adds two f64 by Knuth's two-sum. The result has the rounded sum and its rounding error, so it is exact.
    fn sum(a: f64, b: f64) -> Double {
        let high = a + b;
        let other = high - a;
        let low = (a - (high - other)) + (b - other);
        Double { high, low }
    }
}

impl From<f64> for Double {
    fn from(high: f64) -> Double {
        Double { high, low: 0.0 }
    }
}

impl Neg for Double {
    type Output = Double;
    fn neg(self) -> Double {
        Double { high: -self.high, low: -self.low }
    }
}

impl Add for Double {
    type Output = Double;
    fn add(self, other: Double) -> Double {
        let (s, t) = (Double::sum(self.high, other.high), Double::sum(self.low, other.low));
        let s = Double::sum(s.high, s.low + t.high);
        Double::sum(s.high, s.low + t.low)
    }
}

impl Sub for Double {
    type Output = Double;
    fn sub(self, other: Double) -> Double {
        self + -other
    }
}

impl Mul for Double {
    type Output = Double;
    fn mul(self, other: Double) -> Double {
        let high = self.high * other.high;
        let low = self.high.mul_add(other.high, -high);
        Double::sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Double {
    type Output = Double;
    fn div(self, other: Double) -> Double {
        let first = Double::from(self.high / other.high);
        let rest = self - first * other;
        let second = Double::from(rest.high / other.high);
        let rest = rest - second * other;
        first + second + Double::from(rest.high / other.high)
    }
}
