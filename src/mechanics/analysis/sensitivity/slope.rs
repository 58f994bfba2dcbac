//! [`Slope`]: the derivative of a margin. It has one value, or two values if the margin has a kink.

use super::rates::Rates;
use super::state::Freedom;

/// The derivative of a margin's end with respect to one number.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Slope {
    /// The same derivative if the number increases or decreases.
    Unique(f64),
    /// The derivative jumps here: one value if the number decreases, and another if it increases.
    OneSided {
        /// The derivative if the number decreases.
        backward: f64,
        /// The derivative if the number increases.
        forward: f64,
    },
    /// The derivative jumps here, and its two values were not computed.
    AtKink,
}

impl Slope {
    /// The slope of an end that does not change.
    pub(super) const ZERO: Slope = Slope::Unique(0.0);

    /// Returns the derivative if it is the same on both sides; otherwise `None`.
    pub fn unique(self) -> Option<f64> {
        match self {
            Slope::Unique(slope) => Some(slope),
            _ => None,
        }
    }

    /// Returns the two one-sided derivatives: if the number decreases, and if it increases. `None` if they were not
    /// computed.
    pub fn both(self) -> Option<[f64; 2]> {
        match self {
            Slope::Unique(slope) => Some([slope; 2]),
            Slope::OneSided { backward, forward } => Some([backward, forward]),
            Slope::AtKink => None,
        }
    }

    /// Returns the slope of the minimum of two functions, or of their maximum if `outward` is negative. `self` and
    /// `other` are the slopes of the two functions at a point where both have the same value.
    pub(super) fn with(self, other: Slope, outward: f64) -> Slope {
        let (Some([a, b]), Some([c, d])) = (self.both(), other.both()) else {
            return Slope::AtKink;
        };
        Slope::one_sided(outward * (outward * a).max(outward * c), outward * (outward * b).min(outward * d), 0.0)
    }

    /// Returns the mean as a unique slope if both derivatives differ by at most `tolerance`. Otherwise returns both.
    fn one_sided(backward: f64, forward: f64, tolerance: f64) -> Slope {
        match (backward - forward).abs() <= tolerance {
            true => Slope::Unique(0.5 * (backward + forward)),
            false => Slope::OneSided { backward, forward },
        }
    }
}

/// Derivatives count as equal if they differ by at most this fraction of the largest derivative of the same kind.
const EQUAL_SLOPE_TOL: f64 = 1e-7;

/// The derivatives of one component at one end, for each state that was computed there.
pub(super) struct Branch {
    pub rates: Vec<Rates>,
    pub freedom: Freedom,
    pub outward: f64,
}

impl Branch {
    /// Combines the derivatives at all states into one slope: unique, one-sided or at a kink. `read` takes the
    /// derivative from the [`Rates`] of a state. Derivatives that differ by at most `EQUAL_SLOPE_TOL · largest` count
    /// as equal; `largest` is the largest absolute derivative of the same kind.
    pub fn slope(&self, largest: f64, read: impl Fn(&Rates) -> f64) -> Slope {
        let Some(first) = self.rates.first() else {
            return Slope::AtKink;
        };
        let first = read(first);
        let others = || self.rates[1..].iter().map(&read);
        let is_same = |rate: f64| (rate - first).abs() <= EQUAL_SLOPE_TOL * largest;
        let is_unique = match self.freedom {
            Freedom::Unique => true,
            Freedom::Unknown => false,
            _ => others().all(is_same),
        };
        if is_unique {
            return Slope::Unique(first);
        }
        let least = others().fold(f64::INFINITY, f64::min);
        let most = others().fold(f64::NEG_INFINITY, f64::max);
        // Each mechanism gives a limit of the parameter, and the nearest limit decides. An upper end therefore changes
        // with the smallest derivative if the number increases, and with the largest if it decreases.
        if self.freedom != Freedom::Mechanisms {
            return Slope::AtKink;
        }
        let is_least = self.outward > 0.0;
        let [backward, forward] = if is_least { [most, least] } else { [least, most] };
        Slope::OneSided { backward, forward }
    }
}
