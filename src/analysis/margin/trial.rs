//! [`Trial`]: one component with something about it changed, judged as any other.

use crate::analysis::Verdict;
use crate::analysis::component::judged;
use crate::assembly::{Assembly, LoadVector};
use crate::geometry::quarter_turn;
use crate::program::{Program, Scale};
use crate::proof::Motion;
use crate::scene::{Limits, RobotId};

/// What is changed about a component; by default nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Setting {
    /// One friction coefficient for every interface.
    pub friction: Option<f64>,
    /// The safety kernel.
    pub kernel: Option<f64>,
    /// Share of each weight that acts along gravity.
    pub along: f64,
    /// Share of each weight that acts across gravity, to the right of it.
    pub across: f64,
    /// Factor on the listed loads.
    pub loads: f64,
    /// The robots' limits.
    pub limits: Limited,
}

/// What is changed about the robots' limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Limited {
    /// Nothing.
    AsGiven,
    /// Only what has no limit can give anything: what is left of the robots at loads without end.
    Unlimited,
    /// One limit of one grip.
    One {
        /// The grip.
        grip: usize,
        /// 0: force x, 1: force y, 2: torque.
        component: usize,
        /// The limit, N or N·m.
        most: f64,
    },
}

impl Default for Setting {
    fn default() -> Setting {
        Setting {
            friction: None,
            kernel: None,
            along: 1.0,
            across: 0.0,
            loads: 1.0,
            limits: Limited::AsGiven,
        }
    }
}

/// One component of a frame, to be changed and judged as often as wanted.
pub(super) struct Trial<'a> {
    given: &'a Assembly,
    /// How many settings were judged.
    pub judged: usize,
}

impl<'a> Trial<'a> {
    pub fn of(given: &'a Assembly) -> Trial<'a> {
        Trial { given, judged: 0 }
    }

    /// The robots that hold a body of the component, grip by grip.
    pub fn holds(&self) -> Vec<RobotId> {
        self.given.grips.iter().map(|grip| grip.robot).collect()
    }

    /// Whether the scene lists a load on the component.
    pub fn is_loaded(&self) -> bool {
        self.given
            .bodies
            .iter()
            .any(|b| b.listed != LoadVector::NONE)
    }

    /// Whether some robot's limit is neither none nor infinite, so that twice the loads is not twice the forces.
    pub fn is_limited(&self) -> bool {
        self.given.grips.iter().any(|grip| {
            [grip.limits.fx, grip.limits.fy, grip.limits.torque]
                .into_iter()
                .any(|l| l > 0.0 && l.is_finite())
        })
    }

    /// Whether the changed component stands, and how it begins to move where it falls.
    pub fn judge(&mut self, setting: &Setting) -> (Verdict, Vec<Motion>) {
        self.judged += 1;
        judged(&self.changed(setting))
    }

    /// The value up to which a motion is a mechanism, where the loads are linear in the value: there they do no work.
    pub fn reach(&self, setting: &dyn Fn(f64) -> Setting, motion: &[Motion]) -> Option<f64> {
        let [without, with] = [0.0, 1.0].map(|value| self.power(&setting(value), motion));
        let at = without / (without - with);
        at.is_finite().then_some(at)
    }

    /// The power of the changed loads along a motion, less what limited robots can hold, in W.
    fn power(&self, setting: &Setting, motion: &[Motion]) -> f64 {
        let changed = self.changed(setting);
        let mut power = 0.0;
        for (number, body) in changed.bodies.iter().enumerate() {
            let Some(m) = motion.iter().find(|m| m.block == body.block) else {
                continue;
            };
            power += body.load.force.dot(&m.velocity) + body.load.moment * m.spin;
            for grip in changed.grips.iter().filter(|grip| grip.body == number) {
                let speed = m.about(body.centroid, grip.at);
                for (speed, limit) in [
                    (speed.x, grip.limits.fx),
                    (speed.y, grip.limits.fy),
                    (m.spin, grip.limits.torque),
                ] {
                    if limit.is_finite() {
                        power -= speed.abs() * limit;
                    }
                }
            }
        }
        power
    }

    /// The changed component's program.
    pub fn program(&self, setting: &Setting) -> Program {
        let changed = self.changed(setting);
        Program::of(&changed, Scale::of_assembly(&changed))
    }

    /// The program at one setting, and what must be added to its load vector for another.
    pub fn direction(&self, from: &Setting, to: &Setting) -> (Program, Vec<f64>) {
        let [here, there] = [from, to].map(|setting| self.changed(setting));
        let heaviest = here.heaviest().max(there.heaviest());
        let scale = Scale::of(self.given.length, heaviest);
        let [here, there] = [here, there].map(|assembly| Program::of(&assembly, scale));
        let toward = there.need.iter().zip(&here.need).map(|(a, b)| a - b);
        let toward = toward.collect();
        (here, toward)
    }

    fn changed(&self, setting: &Setting) -> Assembly {
        let mut changed = self.given.clone();
        if let Some(kernel) = setting.kernel {
            changed = changed.with_kernel(kernel);
        }
        if let Some(mu) = setting.friction {
            changed = changed.with_friction(mu);
        }
        // A weight along gravity and one across it are one weight along a turned gravity.
        let down = self.given.pull;
        changed = changed
            .with_gravity(down * setting.along + quarter_turn(down) * setting.across)
            .with_load_factor(setting.loads);
        for grip in 0..changed.grips.len() {
            let limits = limits(changed.grips[grip].limits, grip, setting.limits);
            changed = changed.with_limits(grip, limits);
        }
        changed
    }
}

/// The limits of a grip as a setting has them.
fn limits(given: Limits, number: usize, setting: Limited) -> Limits {
    let or_none = |limit: f64| if limit.is_finite() { 0.0 } else { limit };
    match setting {
        Limited::Unlimited => Limits {
            fx: or_none(given.fx),
            fy: or_none(given.fy),
            torque: or_none(given.torque),
        },
        Limited::One {
            grip,
            component,
            most,
        } if grip == number => match component {
            0 => Limits { fx: most, ..given },
            1 => Limits { fy: most, ..given },
            _ => Limits {
                torque: most,
                ..given
            },
        },
        _ => given,
    }
}
