//! What is withheld: margins between whose sides no verdict was reached, in words.

use super::{Margin, Margins};
use crate::scene::RobotId;

impl Margins {
    /// What is withheld and why, a sentence each.
    pub(in crate::mechanics::analysis) fn withheld(
        &self,
        robot: impl Fn(RobotId) -> String,
    ) -> Vec<String> {
        let mut list = Vec::new();
        let mut tell = |name: String, margin: &Margin| {
            if let Margin::Unconfirmed { stands, beyond } = margin {
                list.push(format!(
                    "{name} is withheld, since no verdict confirms it: it stands at {stands:.6}, and at {beyond:.6} \
                     it was not shown to stand"
                ));
            }
        };
        tell("the least friction".into(), &self.friction);
        for (sides, name) in [
            (&self.tilt, "the largest tilt in degrees"),
            (&self.horizontal_load, "the largest horizontal share"),
        ] {
            tell(format!("{name} to the left"), &sides.left);
            tell(format!("{name} to the right"), &sides.right);
        }
        tell("the largest kernel".into(), &self.kernel);
        tell("the largest factor on the loads".into(), &self.load_factor);
        for found in &self.robots {
            let name = robot(found.robot);
            for (margin, component) in [
                (&found.fx, "fx in newtons"),
                (&found.fy, "fy in newtons"),
                (&found.torque, "torque in newton metres"),
            ] {
                tell(format!("the least {component} of robot {name}"), margin);
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::super::edge::{Way, worse};
    use super::super::{RobotMargins, Sides};
    use super::*;

    #[test]
    fn what_no_verdict_confirms_is_withheld_in_words() {
        let withheld = Margin::Unconfirmed {
            stands: 0.25,
            beyond: 0.5,
        };
        let sides = |left: Margin| Sides {
            left,
            right: Margin::Unbounded,
        };
        let found = Margins {
            friction: Margin::None,
            tilt: sides(withheld.clone()),
            horizontal_load: sides(Margin::NotAsked),
            kernel: withheld.clone(),
            load_factor: Margin::Unbounded,
            robots: vec![RobotMargins {
                robot: RobotId(0),
                fx: Margin::None,
                fy: withheld.clone(),
                torque: Margin::None,
            }],
        };
        let described = found.withheld(|_| "r".to_string());
        let expected = [
            "the largest tilt in degrees to the left is withheld",
            "the largest kernel is withheld",
            "the least fy in newtons of robot r is withheld",
        ];
        assert_eq!(described.len(), expected.len());
        for (described, expected) in described.iter().zip(expected) {
            assert!(described.starts_with(expected), "{described}");
            assert!(
                described.contains("stands at 0.250000, and at 0.500000 it was not"),
                "{described}"
            );
        }
        assert_eq!(withheld.at(), None);
        assert!(worse(&withheld, &Margin::Unbounded, Way::Most));
    }
}
