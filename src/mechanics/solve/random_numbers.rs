//! Pseudo-random numbers for tests.

/// A linear congruential generator of numbers between −1 and 1. The sequence is the same in every run (constants of
/// Knuth's MMIX).
pub(super) struct RandomNumbers(pub u64);

impl RandomNumbers {
    /// Returns the next pseudo-random number: at least −1 and below 1.
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Returns a pseudo-random integer: at least 0 and below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        ((0.5 + 0.5 * self.next()) * end as f64) as usize
    }
}
