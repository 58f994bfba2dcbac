//! [`UndecidedReason`]: why it could not be decided whether a frame stands.

use std::fmt;

use super::{FrameAnalysis, Verdict};
use crate::mechanics::proof::Proof;
use crate::text::power_of_ten;

/// How a notice begins that says what the exact proof of a verdict misses.
pub(in crate::mechanics) const INEXACT: &str = "the verdict is not proved in exact arithmetic: ";

/// One reason why a frame is undecided; its `Display` describes it in a sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum UndecidedReason {
    /// [`Options::deadline`](super::Options::deadline) passed before the frame was decided.
    Late,
    /// The accuracy [`Exact`](super::Accuracy::Exact) is asked for, and exact arithmetic does not prove the verdict.
    Inexact {
        /// The verdict that is proved within the tolerances.
        verdict: Verdict,
        /// In words: what is missing.
        fault: String,
    },
    /// The vehicle of the scene has more positions than are decided.
    TooManyPositions {
        /// The largest number of positions.
        most: usize,
    },
    /// For some blocks of the frame, neither forces nor a motion are proved.
    Unproved {
        /// The errors of the best forces that were found.
        forces: Proof,
        /// The errors of the best motion that was found; `None` if no motion was found.
        motion: Option<Proof>,
    },
    /// The verdict depends on narrow gaps or overlaps.
    Gaps {
        /// The verdict with the gaps open, as they are written.
        open: Verdict,
        /// The verdict with the gaps closed.
        closed: Verdict,
        /// The contact tolerance that closes the gaps and overlaps, metres.
        closing: f64,
        /// In words: where the places are, and how the user can decide.
        words: String,
    },
    /// The frame stands if very short contacts carry force, and falls if they do not.
    Slivers {
        /// The contact tolerance with which all of them count as contacts, metres.
        counting: f64,
        /// The contact tolerance with which none of them counts as a contact, metres.
        ignoring: f64,
        /// In words: where the places are, and how the user can decide.
        words: String,
    },
}

impl fmt::Display for UndecidedReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            UndecidedReason::Late => f.write_str("the time limit was reached before it was decided"),
            UndecidedReason::Inexact { verdict, fault } => write!(
                f,
                "it {} within the tolerances of --accuracy standard, but not in exact arithmetic: {fault}",
                verdict.plain()
            ),
            UndecidedReason::TooManyPositions { most } => write!(
                f,
                "the vehicle has more than {most} positions; give it fewer axles, or name the blocks that it passes \
                 in its key `over`"
            ),
            UndecidedReason::Unproved { forces, motion } => {
                if let Proof::Forces { worst_imbalance, .. } = forces {
                    write!(
                        f,
                        "the forces found miss the balance of a block by {} of the forces on it",
                        power_of_ten(*worst_imbalance, 1)
                    )?;
                }
                match motion {
                    Some(motion) if motion.holds() => write!(
                        f,
                        "; a motion violates no contact, but its power may be zero within the tolerance of the forces"
                    ),
                    Some(Proof::Mechanism { power, worst_violation }) => {
                        let [power, by] = [power, worst_violation].map(|x| power_of_ten(*x, 1));
                        write!(f, "; a motion has power {power} but violates a contact by {by}")
                    }
                    _ => f.write_str("; no motion was found"),
                }
            }
            UndecidedReason::Gaps { words, .. } | UndecidedReason::Slivers { words, .. } => f.write_str(words),
        }
    }
}

impl FrameAnalysis {
    /// Makes the frame undecided for this reason, beside its other reasons.
    pub(in crate::mechanics) fn leave_undecided(&mut self, reason: UndecidedReason) {
        self.verdict = Verdict::Undecided;
        self.doubts.push(reason);
    }

    /// Returns why the frame is undecided, in words, with the errors of the forces and motions that were found. Empty
    /// if the frame is decided.
    pub fn doubt(&self) -> String {
        let reasons: Vec<String> = self.doubts.iter().map(UndecidedReason::to_string).collect();
        match self.doubts.as_slice() {
            // After the time limit, also list the reasons that were found earlier.
            [UndecidedReason::Late, _, ..] => {
                format!("{}: {}", reasons[0], reasons[1..].join("; "))
            }
            _ => reasons.join("; "),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::analysis::Analysis;
    use crate::mechanics::scene::Scene;

    #[test]
    fn reasons_make_one_sentence() {
        let text = r#"{ "drystone": 1, "blocks": [{ "polygon": [[0, 0], [1, 0], [0, 1]] }] }"#;
        let scene = Scene::from_json(text).expect("sound");
        let mut frame = FrameAnalysis::clone(&Analysis::new(&scene).frames[0]);
        assert_eq!(frame.doubt(), "");
        let unproved = |power: Option<f64>| UndecidedReason::Unproved {
            forces: Proof::Forces { worst_imbalance: 1e-3, worst_share: 0.0, worst_pull: 0.0, worst_slip: 0.0 },
            motion: power.map(|power| Proof::Mechanism { power, worst_violation: 1e-4 }),
        };
        frame.doubts = vec![UndecidedReason::Late];
        let late = "the time limit was reached before it was decided";
        assert_eq!(frame.doubt(), late);
        frame.doubts.extend([unproved(None), unproved(Some(0.5))]);
        let off = "the forces found miss the balance of a block by 0.001 of the forces on it";
        assert_eq!(
            frame.doubt(),
            format!(
                "{late}: {off}; no motion was found; {off}; a motion has power 0.5 but violates a contact by 1×10⁻⁴"
            )
        );
    }
}
