//! [`Trial`]: decides a component with changed parameters.
//!
//! What balanced one changed component, and by what motion another fell, is remembered: where it proves the verdict of the
//! next one no program is solved for that.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::analysis::Verdict;
use crate::analysis::decide::{
    Ends, Place, ProofCache, decide_verdict, remember_limit, verdict_from_cache,
};
use crate::assembly::{Assembly, LoadVector};
use crate::geometry::quarter_turn;
use crate::program::{Program, Scale};
use crate::proof::{ContactForces, Forces, GripForces, Motion};
use crate::scene::{Limits, RobotId};
use crate::solve::{Extreme, Tangent};

/// Changed components judged by this process, for who waits to see that it lives.
static TRIALS: AtomicUsize = AtomicUsize::new(0);

/// The number of changed components that this process has decided for margins, for a progress bar.
pub fn trials() -> usize {
    TRIALS.load(Ordering::Relaxed)
}

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
    /// The forces of the component as it is, where it stands.
    forces: Option<&'a Forces>,
    guesses: ProofCache,
    /// How many settings were judged.
    pub judged: usize,
}

impl<'a> Trial<'a> {
    /// A trial of a component, with the forces that balance it if it stands.
    pub fn new(given: &'a Assembly, forces: Option<&'a Forces>) -> Trial<'a> {
        let mut guesses = ProofCache::default();
        if let Some(forces) = forces {
            guesses.add_forces(given, forces.clone());
        }
        Trial {
            given,
            forces,
            guesses,
            judged: 0,
        }
    }

    /// The robots that hold a body of the component, in the order of the grips.
    pub fn holds(&self) -> Vec<RobotId> {
        self.given.grips.iter().map(|grip| grip.robot).collect()
    }

    /// Whether the scene lists a load on the component.
    pub fn is_loaded(&self) -> bool {
        is_loaded(self.given)
    }

    /// Whether a limit of some robot is neither 0 nor infinite, so that twice the loads does not give twice the forces.
    pub fn is_limited(&self) -> bool {
        is_limited(self.given)
    }

    /// The verdict on the changed component, and its mechanism if it falls.
    pub fn judge(&mut self, setting: &Setting) -> (Verdict, Vec<Motion>) {
        self.judge_at(setting, Place::Anywhere)
    }

    /// Like [`Trial::judge`], if it is known whether the component is near its limit.
    pub fn judge_at(&mut self, setting: &Setting, place: Place) -> (Verdict, Vec<Motion>) {
        self.count();
        decide_verdict(&self.changed(setting), place, &mut self.guesses)
    }

    /// Like [`Trial::judge`], with cached proofs only; undecided if none holds.
    pub fn guess(&self, setting: &Setting) -> (Verdict, Vec<Motion>) {
        verdict_from_cache(&self.changed(setting), &self.guesses)
    }

    /// The least residual of the changed component, and its derivative.
    pub fn tangent(&mut self, setting: &Setting) -> Option<Tangent> {
        self.count();
        Tangent::new(&self.program(setting))
    }

    fn count(&mut self) {
        self.judged += 1;
        TRIALS.fetch_add(1, Ordering::Relaxed);
    }

    /// The value at which the tangent of the least residual is zero (a step of Newton's method).
    pub fn root(
        &self,
        tangent: &Tangent,
        setting: &dyn Fn(f64) -> Setting,
        [from, to]: [f64; 2],
    ) -> f64 {
        let there = tangent.of_sibling(&self.program(&setting(to)));
        from + (to - from) * tangent.left / (tangent.left - there)
    }

    /// Caches the forces and the motion of a tangent: the forces if the component stands, the motion if it falls.
    pub fn learn_tangent(&mut self, tangent: &Tangent, setting: &Setting, verdict: Verdict) {
        let changed = self.changed(setting);
        let program = Program::new(&changed, Scale::from_assembly(&changed));
        let (forces, motion) = (tangent.forces(&program), tangent.motion());
        let ends = Ends {
            program: &program,
            forces: (verdict == Verdict::Stable).then_some((&forces, &changed)),
            motion: (verdict == Verdict::Unstable).then_some((&motion[..], &changed)),
        };
        remember_limit(&ends, &mut self.guesses);
    }

    /// Caches the results of one program at the end of an interval: the forces there, and the motion well beyond. If the
    /// loads are linear and `base` is the present value, also the forces just inside.
    pub fn learn_edge(
        &mut self,
        program: &Program,
        extreme: &Extreme,
        [at, inside, beyond]: [f64; 3],
        setting: &dyn Fn(f64) -> Setting,
        base: Option<f64>,
    ) {
        let [here, there] = [at, beyond].map(|value| self.changed(&setting(value)));
        let ends = Ends {
            program,
            forces: extreme.forces.as_ref().map(|forces| (forces, &here)),
            motion: extreme.motion.as_ref().map(|y| (&y[..], &there)),
        };
        let found = remember_limit(&ends, &mut self.guesses);
        if let (Some(last), Some(first), Some(base)) = (found, self.forces, base)
            && at != base
        {
            let share = (inside - base) / (at - base);
            if (0.0..=1.0).contains(&share) {
                let changed = self.changed(&setting(inside));
                let between = between(first, &last, share);
                self.guesses.add_forces(&changed, between);
            }
        }
    }

    /// The power of the changed loads along a motion, less the power that limited robots can absorb, in watts.
    pub fn power(&self, setting: &Setting, motion: &[Motion]) -> f64 {
        let changed = self.changed(setting);
        let mut power = 0.0;
        for (number, body) in changed.bodies.iter().enumerate() {
            let Some(m) = motion.iter().find(|m| m.block == body.block) else {
                continue;
            };
            // The work of weight and loads, less what limited robots absorb.
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
        Program::new(&changed, Scale::from_assembly(&changed))
    }

    /// The program with one setting, and the change of its load vector to another setting.
    pub fn direction(&self, from: &Setting, to: &Setting) -> (Program, Vec<f64>) {
        let [here, there] = [from, to].map(|setting| self.changed(setting));
        let heaviest = here.heaviest_load().max(there.heaviest_load());
        let scale = Scale::new(self.given.length, heaviest);
        // One scale for both, so that their load vectors can be subtracted.
        let [here, there] = [here, there].map(|assembly| Program::new(&assembly, scale));
        let toward = there.loads.iter().zip(&here.loads).map(|(a, b)| a - b);
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
        // A weight along gravity and a weight across it are one weight along turned gravity.
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

/// Whether the scene lists a load on a component.
pub(super) fn is_loaded(component: &Assembly) -> bool {
    let mut bodies = component.bodies.iter();
    bodies.any(|body| body.listed != LoadVector::NONE)
}

/// Whether a limit of a robot on the component is neither 0 nor infinite.
pub(super) fn is_limited(component: &Assembly) -> bool {
    component.grips.iter().any(|grip| {
        [grip.limits.fx, grip.limits.fy, grip.limits.torque]
            .into_iter()
            .any(|limit| limit > 0.0 && limit.is_finite())
    })
}

/// The limits of a grip with a setting.
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

/// The mixture of two sets of forces. Admissible forces form a convex set.
fn between(first: &Forces, last: &Forces, share: f64) -> Forces {
    let mix = |a: f64, b: f64| a + share * (b - a);
    let contacts = first.contacts.iter().zip(&last.contacts);
    let contacts = contacts.map(|(a, b)| ContactForces {
        normal: [0, 1].map(|k| mix(a.normal[k], b.normal[k])),
        friction: mix(a.friction, b.friction),
    });
    let grips = first.grips.iter().zip(&last.grips);
    let grips = grips.map(|(a, b)| GripForces {
        force: a.force + (b.force - a.force) * share,
        torque: mix(a.torque, b.torque),
    });
    Forces {
        contacts: contacts.collect(),
        grips: grips.collect(),
    }
}
