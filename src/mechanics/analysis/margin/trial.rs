//! [`Trial`]: decides copies of a component with changed parameters, such as friction, tilt or loads.
//!
//! Forces and motions that proved the verdict on one changed component are cached. If they also prove the verdict on
//! the next one, no program is solved.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::geometry::{quarter_turn, sin_cos_degrees};
use crate::mechanics::analysis::Verdict;
use crate::mechanics::analysis::decide::{
    LimitDistance, LimitResults, ProofCache, add_limit_to_cache, decide_verdict, least_force_error, proved_motion,
    verdict_from_cache,
};
use crate::mechanics::program::{Program, Scale};
use crate::mechanics::proof::{ContactForces, Forces, GripForces, Motion, net_power};
use crate::mechanics::scene::{Limits, RobotId};
use crate::mechanics::solve::{ExtremeValue, Tangent};
use crate::mechanics::statics::assembly::{Assembly, AssemblyBody, AssemblyContact, LoadVector};

/// The number of evaluations of changed components in this process: verdicts and programs of least residual.
static TRIALS: AtomicUsize = AtomicUsize::new(0);

/// Returns how many changed components, such as tilted or more heavily loaded ones, this process has evaluated for
/// margins. The progress bar shows this number.
pub fn trials() -> usize {
    TRIALS.load(Ordering::Relaxed)
}

/// The changed parameters of a component; by default nothing is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::mechanics::analysis) struct Setting {
    /// One friction coefficient for every interface; `None` leaves the coefficients unchanged.
    pub friction: Option<f64>,
    /// Factor on every friction coefficient.
    pub friction_factor: f64,
    /// The safety kernel; `None` leaves it unchanged.
    pub kernel: Option<f64>,
    /// The fraction of each weight that acts along gravity.
    pub along: f64,
    /// The fraction of each weight that acts at right angles to gravity, positive to the right.
    pub across: f64,
    /// Factor on the listed loads.
    pub loads: f64,
    /// Whether the fixed loads act.
    pub has_fixed_loads: bool,
    /// The robots' limits.
    pub limits: LimitChange,
}

/// The changed limits of robots.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::mechanics::analysis) enum LimitChange {
    /// The limits of the scene.
    None,
    /// Every finite limit becomes 0. Unlimited forces and torques of robots remain, which resist loads of any size.
    FiniteToZero,
    /// Consecutive limits get a new value. They are counted over all grips: limits 3g, 3g + 1 and 3g + 2 are those of
    /// force x, force y and torque of grip g.
    Replace {
        /// The index of the first limit.
        first: usize,
        /// The index after the last limit.
        end: usize,
        /// The new value of these limits, N or N·m.
        value: f64,
    },
}

impl Default for Setting {
    fn default() -> Setting {
        Setting { along: 1.0, loads: 1.0, has_fixed_loads: true, ..Setting::UNLOADED }
    }
}

impl Setting {
    /// No weights and no loads act.
    pub const UNLOADED: Setting = Setting {
        friction: None,
        friction_factor: 1.0,
        kernel: None,
        along: 0.0,
        across: 0.0,
        loads: 0.0,
        has_fixed_loads: false,
        limits: LimitChange::None,
    };

    /// Returns the setting with gravity rotated by an angle in degrees, positive to the right, and multiplied by
    /// `stretch`.
    pub fn tilted(degrees: f64, stretch: f64) -> Setting {
        let (sin, cos) = sin_cos_degrees(degrees);
        Setting { along: stretch * cos, across: stretch * sin, ..Setting::default() }
    }

    /// Returns a component with these parameters.
    pub fn apply(&self, given: &Assembly) -> Assembly {
        let mut changed = given.clone();
        if let Some(kernel) = self.kernel {
            changed = changed.with_kernel(kernel);
        }
        if let Some(mu) = self.friction {
            changed = changed.with_friction(mu);
        }
        if self.friction_factor != 1.0 {
            changed = changed.with_friction_factor(self.friction_factor);
        }
        if !self.has_fixed_loads {
            changed.bodies.iter_mut().for_each(|body| body.fixed = LoadVector::ZERO);
        }
        // Weights along and across the original gravity together equal weights along a changed gravity vector.
        let down = given.pull;
        changed =
            changed.with_gravity(down * self.along + quarter_turn(down) * self.across).with_load_factor(self.loads);
        for (number, grip) in changed.grips.iter_mut().enumerate() {
            grip.limits = limits(grip.limits, number, self.limits);
        }
        changed
    }
}

/// One component of a frame, of which changed versions are decided.
pub(super) struct Trial<'a> {
    original: &'a Assembly,
    /// The forces that balance the unchanged component, if it stands.
    forces: Option<&'a Forces>,
    proofs: ProofCache,
    /// The number of evaluations so far: verdicts and programs of least residual.
    pub decided_count: usize,
}

impl<'a> Trial<'a> {
    /// Creates a trial, which decides changed copies of a component. `forces` balance the unchanged component; they are
    /// `None` if it does not stand.
    pub fn new(original: &'a Assembly, forces: Option<&'a Forces>) -> Trial<'a> {
        let mut proofs = ProofCache::default();
        if let Some(forces) = forces {
            proofs.add_forces(original, forces.clone());
        }
        Trial { original, forces, proofs, decided_count: 0 }
    }

    /// Returns the robots that hold a body of the component, in the order of the grips.
    pub fn holds(&self) -> Vec<RobotId> {
        self.original.grips.iter().map(|grip| grip.robot).collect()
    }

    /// True if the scene lists a load on the component.
    pub fn is_loaded(&self) -> bool {
        is_loaded(self.original)
    }

    /// Returns the largest friction coefficient of the component; 0 without contacts.
    pub fn largest_friction(&self) -> f64 {
        self.original.contacts.iter().map(|contact| contact.friction).fold(0.0, f64::max)
    }

    /// Returns the largest friction coefficient that a factor on the friction multiplies; 0 without one.
    pub fn largest_factored_friction(&self) -> f64 {
        largest_factored_friction(self.original)
    }

    /// Returns the unchanged component.
    pub fn component(&self) -> &'a Assembly {
        self.original
    }

    /// Returns the friction coefficient of the component if all its contacts have the same, and a factor multiplies all.
    pub fn only_friction(&self) -> Option<f64> {
        let largest = self.largest_friction();
        let is_same = |contact: &AssemblyContact| contact.is_factored && contact.friction == largest;
        self.original.contacts.iter().all(is_same).then_some(largest)
    }

    /// True if some robot has a limit other than 0 and infinity. The forces at the limit of stability are then not
    /// proportional to the loads.
    pub fn is_limited(&self) -> bool {
        is_limited(self.original)
    }

    /// Returns the ratio of the heaviest weight or fixed load to the largest listed load; 1 if there are no weights or no listed
    /// loads.
    pub fn weights_to_loads(&self) -> f64 {
        let bodies = || self.original.bodies.iter();
        let size = |body: &AssemblyBody| body.fixed.size(self.original.length);
        let weights = bodies().map(|body| size(body).max(body.weight * self.original.pull.norm()));
        let loads = bodies().map(|body| body.listed.size(self.original.length));
        let ratio = weights.fold(0.0, f64::max) / loads.fold(0.0, f64::max);
        if ratio.is_finite() && ratio > 0.0 { ratio } else { 1.0 }
    }

    /// True if the largest listed load and the heaviest weight differ by a factor of more than a thousand. The
    /// tolerance of a proof by forces then is more than 10⁻⁴ of the smaller of the two.
    pub fn has_slight_loads(&self) -> bool {
        !(1e-3..=1e3).contains(&self.weights_to_loads())
    }

    /// Returns the verdict on the component with the parameters `setting`, and its mechanism if it falls (otherwise an
    /// empty list).
    pub fn decide(&mut self, setting: &Setting) -> (Verdict, Vec<Motion>) {
        self.decide_at(setting, LimitDistance::Unknown)
    }

    /// Like [`Trial::decide`]. `limit_distance` says whether the changed component is known to be at its limit of
    /// stability.
    pub fn decide_at(&mut self, setting: &Setting, limit_distance: LimitDistance) -> (Verdict, Vec<Motion>) {
        self.count();
        decide_verdict(&self.changed(setting), limit_distance, &mut self.proofs)
    }

    /// Like [`Trial::decide`], but tries only cached proofs and solves no program. The verdict is undecided if no
    /// cached proof holds.
    pub fn cached_verdict(&self, setting: &Setting) -> (Verdict, Vec<Motion>) {
        verdict_from_cache(&self.changed(setting), &self.proofs)
    }

    /// Solves the program of least residual for the changed component. The result contains the least Σ |residual|, and
    /// can estimate how it changes with the friction coefficient and the kernel. `None` if there are no loads or the
    /// program could not be solved.
    pub fn tangent(&mut self, setting: &Setting) -> Option<Tangent> {
        self.count();
        Tangent::new(&self.program(setting))
    }

    /// Returns the motion of largest power, if this motion proves that the changed component falls; otherwise `None`. A
    /// mechanism has no tolerance, so it may prove a fall where the verdict is stable, because the forces balance within
    /// their tolerance. The tangent belongs to the same setting.
    pub fn proved_motion(&self, tangent: &Tangent, setting: &Setting) -> Option<Vec<Motion>> {
        let changed = self.changed(setting);
        let program = Program::new(&changed, Scale::from_assembly(&changed));
        let (motion, _) = proved_motion(&changed, &program, &tangent.motion())?;
        Some(motion)
    }

    /// Returns the error of the most accurate known forces that balance the changed component, relative to the forces
    /// on a body or at a joint. `None` if no such forces are known.
    pub fn least_force_error(&self, setting: &Setting) -> Option<f64> {
        least_force_error(&self.changed(setting), &self.proofs)
    }

    fn count(&mut self) {
        self.decided_count += 1;
        TRIALS.fetch_add(1, Ordering::Relaxed);
    }

    /// Returns the parameter value at which the least residual becomes 0 according to its tangent at `from`: one step
    /// of Newton's method. The tangent is evaluated at a second value, `to`.
    pub fn root(&self, tangent: &Tangent, setting: &dyn Fn(f64) -> Setting, [from, to]: [f64; 2]) -> f64 {
        let estimate = tangent.estimate_residual(&self.program(&setting(to)));
        from + (to - from) * tangent.residual_sum / (tangent.residual_sum - estimate)
    }

    /// Adds the results of a least-residual program to the cache: its forces if the verdict is stable, its motion if it
    /// is unstable.
    pub fn cache_tangent(&mut self, tangent: &Tangent, setting: &Setting, verdict: Verdict) {
        let changed = self.changed(setting);
        let program = Program::new(&changed, Scale::from_assembly(&changed));
        let (forces, motion) = (tangent.forces(&program), tangent.motion());
        let results = LimitResults {
            program: &program,
            forces: (verdict == Verdict::Stable).then_some((&forces, &changed)),
            motion: (verdict == Verdict::Unstable).then_some((&motion[..], &changed)),
        };
        add_limit_to_cache(&results, &mut self.proofs);
    }

    /// Adds the results of the program for an end of an interval to the cache: its forces, for the value `at`, and its
    /// motion, for the value `beyond`. If `base` (the current value) is given, also adds interpolated forces for the
    /// value `inside`.
    pub fn cache_extreme(
        &mut self,
        program: &Program,
        extreme: &ExtremeValue,
        [at, inside, beyond]: [f64; 3],
        setting: &dyn Fn(f64) -> Setting,
        base: Option<f64>,
    ) {
        let [at_limit, beyond_limit] = [at, beyond].map(|value| self.changed(&setting(value)));
        let results = LimitResults {
            program,
            forces: extreme.forces.as_ref().map(|forces| (forces, &at_limit)),
            motion: extreme.motion.as_ref().map(|y| (&y[..], &beyond_limit)),
        };
        let limit_forces = add_limit_to_cache(&results, &mut self.proofs);
        if let (Some(at_forces), Some(base_forces), Some(base)) = (limit_forces, self.forces, base)
            && at != base
        {
            let share = (inside - base) / (at - base);
            if (0.0..=1.0).contains(&share) {
                let changed = self.changed(&setting(inside));
                let interpolated = interpolate(base_forces, &at_forces, share);
                self.proofs.add_forces(&changed, interpolated);
            }
        }
    }

    /// Returns the power of the changed loads along a motion, in watts, minus the largest power that limited robots can
    /// absorb.
    pub fn power(&self, setting: &Setting, motion: &[Motion]) -> f64 {
        net_power(&self.changed(setting), motion)
    }

    /// Returns the linear program of the component with the parameters `setting`, in units chosen for it.
    pub fn program(&self, setting: &Setting) -> Program {
        let changed = self.changed(setting);
        Program::new(&changed, Scale::from_assembly(&changed))
    }

    /// Returns the linear program for the setting `from`, and the change of its load vector from the setting `from` to
    /// the setting `to`.
    pub fn direction(&self, from: &Setting, to: &Setting) -> (Program, Vec<f64>) {
        let [here, there] = [from, to].map(|setting| self.changed(setting));
        let heaviest = here.heaviest_load().max(there.heaviest_load());
        let scale = Scale::new(self.original.length, heaviest);
        // Use one scale for both programs, so that their load vectors can be subtracted.
        let [here, there] = [here, there].map(|assembly| Program::new(&assembly, scale));
        let toward = there.loads.iter().zip(&here.loads).map(|(a, b)| a - b);
        let toward = toward.collect();
        (here, toward)
    }

    fn changed(&self, setting: &Setting) -> Assembly {
        setting.apply(self.original)
    }
}

/// Returns the largest friction coefficient of a component that a factor on the friction multiplies; 0 without one.
pub(super) fn largest_factored_friction(component: &Assembly) -> f64 {
    let factored = component.contacts.iter().filter(|contact| contact.is_factored);
    factored.map(|contact| contact.friction).fold(0.0, f64::max)
}

/// True if the load factor multiplies some load of a component.
pub(super) fn has_factored_loads(component: &Assembly) -> bool {
    component.bodies.iter().any(|body| body.listed != LoadVector::ZERO)
}

/// True if the scene lists a load on some body of a component.
pub(super) fn is_loaded(component: &Assembly) -> bool {
    let mut bodies = component.bodies.iter();
    bodies.any(|body| body.listed != LoadVector::ZERO || body.fixed != LoadVector::ZERO)
}

/// True if a robot that holds a body of the component has a limit other than 0 and infinity.
pub(super) fn is_limited(component: &Assembly) -> bool {
    component.grips.iter().any(|grip| {
        [grip.limits.fx, grip.limits.fy, grip.limits.torque].into_iter().any(|limit| limit > 0.0 && limit.is_finite())
    })
}

/// Returns the limits of the grip with index `number` as `setting` changes them: unchanged, with some limits replaced,
/// or with all finite limits set to 0.
fn limits(given: Limits, number: usize, setting: LimitChange) -> Limits {
    let finite_to_zero = |limit: f64| if limit.is_finite() { 0.0 } else { limit };
    match setting {
        LimitChange::None => given,
        LimitChange::FiniteToZero => {
            Limits { fx: finite_to_zero(given.fx), fy: finite_to_zero(given.fy), torque: finite_to_zero(given.torque) }
        }
        LimitChange::Replace { first, end, value } => {
            let changed = |component: usize, given: f64| match 3 * number + component {
                k if (first..end).contains(&k) => value,
                _ => given,
            };
            Limits { fx: changed(0, given.fx), fy: changed(1, given.fy), torque: changed(2, given.torque) }
        }
    }
}

/// Interpolates linearly between two sets of forces, from `first` (share 0) to `last` (share 1). The result is
/// admissible, because admissible forces form a convex set.
fn interpolate(first: &Forces, last: &Forces, share: f64) -> Forces {
    let mix = |a: f64, b: f64| a + share * (b - a);
    let contacts = first.contacts.iter().zip(&last.contacts);
    let contacts = contacts.map(|(a, b)| ContactForces {
        normal: [0, 1].map(|k| mix(a.normal[k], b.normal[k])),
        friction: mix(a.friction, b.friction),
    });
    let grips = first.grips.iter().zip(&last.grips);
    let grips = grips
        .map(|(a, b)| GripForces { force: a.force + (b.force - a.force) * share, torque: mix(a.torque, b.torque) });
    Forces { contacts: contacts.collect(), grips: grips.collect() }
}
