//! [`CompensatedSum`]: adds numbers with about 32 significant digits, for large terms that nearly cancel.
//!
//! The rounding error of a floating-point addition or product is itself a floating-point number. Each of these errors
//! is computed exactly, and the errors are added up separately. References: Knuth, The Art of Computer Programming 2,
//! §4.2.2 (two-sum); Ogita, Rump and Oishi, Accurate Sum and Dot Product, 2005 (products).

/// A sum that is kept as a rounded value and the sum of all rounding errors.
#[derive(Clone, Copy, Debug, Default)]
pub struct CompensatedSum {
    rounded: f64,
    error: f64,
}

impl CompensatedSum {
    /// Adds `value` to the sum. The rounding error of this addition is kept separately.
    pub fn add(&mut self, value: f64) {
        // Two-sum: this formula gives the exact rounding error, whichever of the two numbers is larger.
        let sum = self.rounded + value;
        let added = sum - self.rounded;
        self.error += (self.rounded - (sum - added)) + (value - added);
        self.rounded = sum;
    }

    /// Adds the product `a * b` to the sum. The rounding errors of the product and of the addition are kept separately.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        self.add(product);
        // A fused multiply-add rounds only once, so this call returns the exact rounding error of the product.
        self.error += a.mul_add(b, -product);
    }

    /// Returns the sum, rounded to an `f64`.
    pub fn value(self) -> f64 {
        self.rounded + self.error
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_terms_are_not_lost_in_large_ones() {
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

    /// Integers of 50 bits have products of 100 bits. Their exact sum fits into 128 bits.
    #[test]
    fn sums_of_products_agree_with_integer_arithmetic() {
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
            // Subtract almost the entire sum, and compare what remains.
            let near = exact as f64;
            sum.add(-near);
            let left = (exact - near as i128) as f64;
            let off = (sum.value() - left).abs();
            assert!(off <= 1e-30 * size, "{count}: off by {off} of {size}");
        }
    }
}
