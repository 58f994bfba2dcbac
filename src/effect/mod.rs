//! Effects: what a frame calls for, decided one by one before anything is posed.
//!
//! Makes a [`Plan`]: which effects are simulated and a [`EffectReport`] for each, with the reason in words and the force
//! unknowns it adds or saves. One file per effect, each with its rule and its source. Sticking and mechanism are called
//! for by the outcome, so their reports are written after the solve.

pub mod contact;
pub mod corner_contact;
pub mod friction;
pub mod kernel;
pub mod load;
pub mod margin;
pub mod mechanism;
pub mod robot;
pub mod robot_torque;
pub mod sticking;
pub mod wedging;
pub mod weight;

use crate::interface::Interface;
use crate::scene::{Frame, Scene};

/// One effect in one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EffectReport {
    /// Its name.
    pub effect: &'static str,
    /// Whether it was simulated.
    pub simulated: bool,
    /// Why, in words.
    pub why: String,
    /// Force unknowns it added, or saved where it was skipped.
    pub unknowns: usize,
}

impl EffectReport {
    fn simulated(effect: &'static str, why: String, unknowns: usize) -> EffectReport {
        EffectReport {
            effect,
            simulated: true,
            why,
            unknowns,
        }
    }

    fn skipped(effect: &'static str, why: impl Into<String>, unknowns: usize) -> EffectReport {
        EffectReport {
            effect,
            simulated: false,
            why: why.into(),
            unknowns,
        }
    }
}

/// What an effect looks at to decide.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The frame.
    pub frame: &'a Frame,
    /// The interfaces between bodies that stand in the frame.
    pub interfaces: &'a [&'a Interface],
}

/// Which effects the program of a frame contains.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Friction columns.
    pub friction: bool,
    /// Robot force columns.
    pub robots: bool,
    /// Robot torque columns.
    pub robot_torque: bool,
    /// Loads in the balance.
    pub loads: bool,
    /// The share of a stretch by which application points move inward, twice.
    pub kernel: f64,
    /// What was decided, effect by effect.
    pub reports: Vec<EffectReport>,
}

impl Plan {
    /// Every effect that a program can contain, without a word about why: for frames that are changed and judged again.
    pub fn everything(kernel: f64) -> Plan {
        Plan {
            friction: true,
            robots: true,
            robot_torque: true,
            loads: true,
            kernel,
            reports: Vec::new(),
        }
    }
}

/// Decides which effects a frame calls for.
pub fn plan(situation: &Situation) -> Plan {
    let reports = vec![
        weight::report(situation),
        contact::report(situation),
        friction::report(situation),
        kernel::report(situation),
        robot::report(situation),
        robot_torque::report(situation),
        load::report(situation),
        corner_contact::report(situation),
    ];
    let simulated = |name: &str| reports.iter().any(|r| r.effect == name && r.simulated);
    Plan {
        friction: simulated(friction::NAME),
        robots: simulated(robot::NAME),
        robot_torque: simulated(robot_torque::NAME),
        loads: simulated(load::NAME),
        kernel: if simulated(kernel::NAME) {
            situation.scene.kernel
        } else {
            0.0
        },
        reports,
    }
}

/// `1 thing`, `2 things`.
fn counted(n: usize, noun: &str) -> String {
    if n == 1 {
        format!("1 {noun}")
    } else {
        format!("{n} {noun}s")
    }
}
