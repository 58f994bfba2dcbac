//! [`Trend`]: whether the columns of an optimum will stand out from all others, told before the method ends.
//!
//! Where they do, their slack falls about as the gap does, in the end at once. Where they do not, as in walls near their edge, it
//! falls as the root of the gap, for as long as there are digits.

/// The trend is taken from this gap on, in parts of the cost, where the columns in use are mostly found.
const FROM: f64 = 2e-6;

/// It shows once the gap has fallen by so much.
const FALL: f64 = 10.0;

/// How the slack of the columns in use falls with the gap, both in parts of the cost.
#[derive(Default)]
pub(super) struct Trend {
    first: Option<[f64; 2]>,
}

impl Trend {
    /// Takes in where the method stands, and says what the slack will be at a given gap, if that shows.
    pub fn expected(&mut self, [gap, slack]: [f64; 2], end: f64) -> Option<f64> {
        if gap > FROM {
            return None;
        }
        let [gap_first, slack_first] = *self.first.get_or_insert([gap, slack]);
        if gap_first < FALL * gap {
            return None;
        }
        let power = libm::log(slack_first / slack) / libm::log(gap_first / gap);
        Some(slack * libm::pow(end / gap, power))
    }
}

#[cfg(test)]
mod tests {
    use super::Trend;

    #[test]
    fn it_goes_on_as_before() {
        for power in [0.5, 1.0] {
            let slack = |gap: f64| 3.0 * libm::pow(gap, power);
            let mut trend = Trend::default();
            for gap in [1e-3, 1e-5, 1e-6, 4e-7] {
                assert_eq!(trend.expected([gap, slack(gap)], 1e-11), None, "{gap}");
            }
            for gap in [1e-7, 3e-9] {
                let expected = trend.expected([gap, slack(gap)], 1e-11).unwrap();
                assert!((expected / slack(1e-11) - 1.0).abs() < 1e-9, "{gap}");
            }
        }
    }
}
