//! [`SlackTrend`]: predicts, before the interior-point method ends, whether the optimum will be strictly complementary.
//!
//! If it will be, the sum of the slacks of the basic columns falls in proportion to the duality gap, and faster at the
//! end. Otherwise, as in walls near their limit, this sum falls like the square root of the gap, and more iterations do
//! not separate basic columns from the others. The exponent of slack ∝ gap^exponent is computed from two iterations.

/// The trend is measured once the gap, relative to the cost, is at most this. Before that, the basic columns are not
/// known.
const FIRST_GAP: f64 = 2e-6;

/// The gap must have fallen by this factor before the exponent is computed. Two points closer together would not
/// determine the exponent accurately.
const MIN_GAP_RATIO: f64 = 10.0;

/// The trend of the slack of the basic columns against the duality gap, both relative to the cost.
#[derive(Default)]
pub(super) struct SlackTrend {
    /// The gap and the slack of the first iteration whose gap is at most [`FIRST_GAP`].
    first: Option<[f64; 2]>,
}

impl SlackTrend {
    /// Takes the gap and the sum of slacks of an iteration, both relative to the cost. Returns the sum of slacks that
    /// the trend predicts at `final_gap`, or `None` if the trend is not yet known.
    pub fn extrapolate(&mut self, [gap, slack]: [f64; 2], final_gap: f64) -> Option<f64> {
        if gap > FIRST_GAP {
            return None;
        }
        let [first_gap, first_slack] = *self.first.get_or_insert([gap, slack]);
        if first_gap < MIN_GAP_RATIO * gap {
            return None;
        }
        let exponent = libm::log(first_slack / slack) / libm::log(first_gap / gap);
        Some(slack * libm::pow(final_gap / gap, exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::SlackTrend;

    #[test]
    fn a_power_law_is_extrapolated() {
        for power in [0.5, 1.0] {
            let slack = |gap: f64| 3.0 * libm::pow(gap, power);
            let mut trend = SlackTrend::default();
            for gap in [1e-3, 1e-5, 1e-6, 4e-7] {
                assert_eq!(trend.extrapolate([gap, slack(gap)], 1e-11), None, "{gap}");
            }
            for gap in [1e-7, 3e-9] {
                let expected = trend.extrapolate([gap, slack(gap)], 1e-11).unwrap();
                assert!((expected / slack(1e-11) - 1.0).abs() < 1e-9, "{gap}");
            }
        }
    }
}
