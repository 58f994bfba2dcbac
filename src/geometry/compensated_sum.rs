//! Sums of which little is left: large terms that cancel, kept with twice the digits.
//!
//! The rounding of every addition and product is itself a floating-point number; it is added up beside the sum
//! (Knuth's two-sum, and the fused product).

/// A sum kept with twice the digits of a number.
#[derive(Clone, Copy, Debug, Default)]
pub struct CompensatedSum {
    high: f64,
    low: f64,
}

impl CompensatedSum {
    /// Adds a number.
    pub fn add(&mut self, value: f64) {
        let sum = self.high + value;
        let part = sum - self.high;
        self.low += (self.high - (sum - part)) + (value - part);
        self.high = sum;
    }

    /// Adds the product of two numbers.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(product);
        self.low += a.mul_add(b, -product);
    }

    /// The sum, rounded once.
    pub fn value(self) -> f64 {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_keep_what_large_forces_hide() {
        let mut sum = CompensatedSum::default();
        for value in [1e16, 1.0, -1e16, 1e-16] {
            sum.add(value);
        }
        assert_eq!(sum.value(), 1.0 + 1e-16);
        let mut sum = CompensatedSum::default();
        sum.add_product(1.0 + f64::EPSILON, 1.0 - f64::EPSILON);
        sum.add(-1.0);
        assert_eq!(sum.value(), -f64::EPSILON * f64::EPSILON);
    }

    /// Whole numbers of 50 binary digits with products of 100: the exact sums fit into 128.
    #[test]
    fn sums_of_products_are_those_of_whole_numbers() {
        let mut seed = 3_u64;
        let mut any = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 14) as i64 - (1 << 49)
        };
        for count in [1, 2, 7, 100] {
            let (mut sum, mut exact, mut size) = (CompensatedSum::default(), 0_i128, 0.0);
            for _ in 0..count {
                let (a, b, c) = (any(), any(), any());
                sum.add_product(a as f64, b as f64);
                sum.add(c as f64);
                exact += i128::from(a) * i128::from(b) + i128::from(c);
                size += (a as f64 * b as f64).abs();
            }
            // What is left when almost all of it is taken away again.
            let near = exact as f64;
            sum.add(-near);
            let left = (exact - near as i128) as f64;
            let off = (sum.value() - left).abs();
            assert!(off <= 1e-30 * size, "{count}: off by {off} of {size}");
        }
    }
}
