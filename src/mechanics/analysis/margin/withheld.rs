//! Describes the margins that are withheld: the verdicts on both sides of an end are too far apart, or no verdict shows
//! where the frame stands.

use super::{End, Interval, Intervals};
use crate::mechanics::scene::RobotId;

impl Intervals {
    /// Returns a sentence for each withheld margin, with the reason. `robot` returns the name of a robot.
    pub(in crate::mechanics::analysis) fn withheld(&self, robot: impl Fn(RobotId) -> String) -> Vec<String> {
        let mut list = Vec::new();
        let mut add = |least: &str, largest: &str, interval: &Interval| match interval {
            Interval::Between { low, high } => {
                for (name, end) in [(least, low), (largest, high)] {
                    if let End::Unconfirmed { stands, beyond } = end {
                        list.push(format!(
                            "{name} is withheld, since no verdict confirms it: the frame stands at {stands:.6}, and \
                             at {beyond:.6} it was not shown to stand; between these values nothing was proved"
                        ));
                    }
                }
            }
            Interval::Undecided => {
                list.push(format!("{least} and {largest} are withheld: no verdict shows at which values it stands"))
            }
            Interval::Empty(_) => {}
        };
        for (least, largest, interval) in [
            ("the least friction", "the largest friction", &self.friction),
            ("the largest tilt in degrees to the left", "the largest tilt in degrees to the right", &self.tilt),
            (
                "the largest horizontal share to the left",
                "the largest horizontal share to the right",
                &self.horizontal_load,
            ),
            ("the least kernel", "the largest kernel", &self.kernel),
            ("the least factor on the loads", "the largest factor on the loads", &self.load_factor),
        ] {
            if let Some(interval) = interval {
                add(least, largest, interval);
            }
        }
        for found in &self.robots {
            let name = robot(found.robot);
            for (interval, component) in
                [(&found.fx, "fx in newtons"), (&found.fy, "fy in newtons"), (&found.torque, "torque in newton metres")]
            {
                add(
                    &format!("the least {component} of robot {name}"),
                    &format!("the largest {component} of robot {name}"),
                    interval,
                );
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::super::{MarginKinds, Margins, RobotIntervals};
    use super::*;
    use crate::mechanics::analysis::Margin;

    #[test]
    fn margins_without_a_confirmed_verdict_are_withheld_with_a_reason() {
        let open = End::Unconfirmed { stands: 0.25, beyond: 0.5 };
        let up_to = |high: End| Interval::Between { low: End::natural(0.0), high };
        let found = Intervals {
            friction: Some(Interval::excluded_by(Vec::new())),
            tilt: Some(Interval::Between {
                low: End::Unconfirmed { stands: -0.25, beyond: -0.5 },
                high: End::Unbounded,
            }),
            kernel: Some(up_to(open.clone())),
            robots: vec![RobotIntervals {
                robot: RobotId(0),
                fx: Interval::excluded_by(Vec::new()),
                fy: Interval::Between { low: open, high: End::Unbounded },
                torque: Interval::Undecided,
            }],
            ..Intervals::default()
        };
        let listed = found.withheld(|_| "r".to_string());
        let expected = [
            (
                "the largest tilt in degrees to the left is withheld",
                "the frame stands at -0.250000, and at -0.500000 it was not",
            ),
            ("the largest kernel is withheld", "the frame stands at 0.250000, and at 0.500000 it was not"),
            (
                "the least fy in newtons of robot r is withheld",
                "the frame stands at 0.250000, and at 0.500000 it was not",
            ),
            ("the least torque in newton metres of robot r and the largest", "no verdict shows at which values"),
        ];
        assert_eq!(listed.len(), expected.len());
        for (sentence, (start, reason)) in listed.iter().zip(expected) {
            assert!(sentence.starts_with(start) && sentence.contains(reason), "{sentence}");
        }
        let margins = Margins::new(found, MarginKinds::ALL);
        assert_eq!(margins.kernel.at(), None);
        assert!(matches!(margins.tilt.left, Margin::Unconfirmed { stands, .. } if stands == 0.25));
        assert_eq!(margins.load_factor, Margin::NotApplicable);
        // “Falls at every value” is a different statement from “undecided”.
        assert_eq!(margins.friction, Margin::None);
        assert_eq!(margins.robots[0].fx, Margin::None);
        assert_eq!(margins.robots[0].torque, Margin::Undecided);
    }

    #[test]
    fn a_margin_around_a_present_value_that_no_verdict_decides_is_undecided() {
        let read = |tilt: Interval| {
            let found = Intervals { tilt: Some(tilt), ..Intervals::default() };
            Margins::new(found, MarginKinds::ALL).tilt.left
        };
        let open = Interval::Between { low: End::Unconfirmed { stands: 1.0, beyond: -1.0 }, high: End::Unbounded };
        assert_eq!(read(Interval::Undecided), Margin::Undecided);
        assert_eq!(read(open), Margin::Undecided);
        let right = Interval::Between { low: End::natural(1.0), high: End::Unbounded };
        assert_eq!(read(right), Margin::None);
    }
}
