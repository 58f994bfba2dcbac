//! [`SlackTrend`]: predicts whether an optimum will be strictly complementary, before the method ends.
//!
//! If it is, the slack of the basic columns falls in proportion to the duality gap, in the end much quicker. If it is
//! not, as in walls near their limit, the slack falls like the square root of the gap, and more iterations do not
//! separate basic columns from others. The exponent is fitted to two points: slack ∝ gap^exponent.

/// The trend is measured from this gap on, relative to the cost. Earlier the basic columns are not yet known.
const FIRST_GAP: f64 = 2e-6;

/// The gap must have fallen by this factor before the exponent is computed: two points closer together give a random one.
const MIN_GAP_RATIO: f64 = 10.0;

/// How the slack of the basic columns falls with the gap; both relative to the cost.
#[derive(Default)]
pub(super) struct SlackTrend {
    /// The gap and the slack of the first iteration that counts.
    first: Option<[f64; 2]>,
}

impl SlackTrend {
    /// Records the gap and slack of an iteration. Returns the slack expected at `final_gap`, or `None` as long as the
    /// trend is unknown.
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
