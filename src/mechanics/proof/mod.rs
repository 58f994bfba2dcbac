//! [`Proof`]: the certificate of a verdict, computed from an assembly and from forces or a motion, without the linear
//! program.
//!
//! This module uses no programs, columns or solvers. It sums the balance again in metres and newtons, from the
//! assembly's bodies, contacts and grips. It also checks the contact law for each force. A mistake in the program is
//! therefore detected. A test that shares no code with the assembly compares the assembly with the outlines.
//!
//! *Stable* is proved by forces: every block balances, no contact pulls or slips, no robot exceeds its limits. Each
//! error is relative to the forces on the same block or at the same contact. The check of the smallest stone
//! therefore depends neither on the heaviest block nor on the typical length.
//!
//! *Unstable* is proved by a motion (a collapse mechanism): no admissible contact force acts against the motion, and
//! the loads do more work than the robots can absorb. The two proofs follow from the static and the kinematic theorem
//! of limit analysis (Livesley 1978), and from weak duality of linear programs. If forces with the sum Σ(N + |T|) = F
//! balanced the loads, then power ≤ violation · F. A motion with violation δ therefore rules out every balance with
//! less force than power/δ ([`Proof::excluded_force_sum`]). Power is relative to the loads of the moving bodies.
//! Rounding errors are added to the violation and subtracted from the power, so that the proof holds in spite of them.

mod balance;
mod least;
#[cfg(test)]
mod tests;

pub use balance::imbalances;
pub use least::force_sum_lower_bound;

use std::collections::HashMap;

use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::scene::{BlockId, Scene};
use crate::mechanics::statics::assembly::{Assembly, AssemblyBody, LoadVector};
use crate::mechanics::statics::interface::ContactKind;

/// The proof of a verdict: the largest errors of forces or of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof {
    /// Forces that balance the loads. All numbers are without unit; 0 means no error.
    Forces {
        /// The largest imbalance τ of all blocks. A block balances to τ if it balances exactly after each force on it
        /// is changed by at most τ of its amount and moved by at most τ of the block's radius ([`imbalances`]).
        worst_imbalance: f64,
        /// The largest residual of a block (force, or moment over radius) relative to its load: for information only.
        worst_share: f64,
        /// The largest tensile force at an application point, relative to the forces at its contact.
        worst_pull: f64,
        /// The largest excess of friction over μN, relative to the forces at its contact, or of a component of a
        /// robot's force over its limit, relative to this component.
        worst_slip: f64,
    },
    /// A collapse mechanism. Both numbers are without unit: velocities are divided by the speed of the fastest point.
    Mechanism {
        /// A lower bound, rounding included, of the power of the loads minus the power that robots with limits can
        /// absorb. It is relative to [`moving_load`], the loads of the moving bodies weighted by their speeds.
        power: f64,
        /// An upper bound, rounding included, of the power that an admissible force can absorb, per unit of N + |T|.
        /// Such a force acts at a contact that closes, or that slides without opening enough, or at an unlimited grip
        /// that moves.
        worst_violation: f64,
    },
}

impl Proof {
    /// The largest imbalance, pull and slip of forces that prove a verdict.
    ///
    /// A structure that misses its balance by less than this counts as stable. Examples are a block pushed by this
    /// fraction of the forces on it, and a centre of gravity outside the support by this fraction of the block's
    /// radius. A tenth of this value is close to the accuracy of the interior-point solver, so more verdicts would be
    /// undecided. Ten times this value, a millionth, could be seen in a six-digit margin.
    pub const IMBALANCE_TOL: f64 = 1e-7;

    /// A motion proves a verdict if it rules out every balance with a sum of forces below this multiple of the moving
    /// loads.
    ///
    /// The solver's error is removed from motions before they are checked. At contacts that neither open nor close,
    /// only the rounding of speeds remains, about 10⁻¹⁵. A motion without other errors therefore proves the verdict if
    /// its power exceeds [`Proof::IMBALANCE_TOL`].
    pub const MIN_POWER_RATIO: f64 = 1e7;

    /// True if the proof is strong enough for a verdict: it meets [`ProofThreshold::STANDARD`].
    pub fn holds(&self) -> bool {
        self.meets(ProofThreshold::STANDARD)
    }

    /// True if the errors of the proof are within the threshold. The power of a motion must also exceed 10⁻¹².
    pub fn meets(&self, threshold: ProofThreshold) -> bool {
        match *self {
            Proof::Forces { .. } => (self.force_error()).is_some_and(|error| error <= threshold.imbalance),
            Proof::Mechanism { power, worst_violation } => {
                power > 1e-12 && power >= threshold.power_ratio * worst_violation
            }
        }
    }

    /// Returns the largest error of forces: the imbalance of a body, the pull or the slip at a joint, or the excess of
    /// a robot over its limits. Each is relative to the forces there. `None` for a proof by a motion.
    pub fn force_error(&self) -> Option<f64> {
        match *self {
            Proof::Forces { worst_imbalance, worst_pull, worst_slip, .. } => {
                Some(worst_imbalance.max(worst_pull).max(worst_slip))
            }
            Proof::Mechanism { .. } => None,
        }
    }

    /// Returns the sum of forces, Σ(N + |T|) relative to the moving loads, below which the motion excludes any balance.
    ///
    /// This sum equals power / violation, and includes the forces of robots without limits. It is infinite if the
    /// violation is 0: then no forces balance the loads, however large they are. It is 0 for a proof by forces, and if
    /// the power is not positive.
    pub fn excluded_force_sum(&self) -> f64 {
        match *self {
            Proof::Mechanism { power, worst_violation } if power > 0.0 => power / worst_violation,
            _ => 0.0,
        }
    }
}

/// The accuracy that a proof must have for its verdict to be accepted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProofThreshold {
    /// The largest accepted imbalance, pull and slip of forces.
    pub imbalance: f64,
    /// The smallest accepted ratio of a motion's power to its worst violation.
    pub power_ratio: f64,
}

impl ProofThreshold {
    /// The threshold for every verdict.
    pub const STANDARD: ProofThreshold =
        ProofThreshold { imbalance: Proof::IMBALANCE_TOL, power_ratio: Proof::MIN_POWER_RATIO };

    /// The threshold of `--accuracy proved`: a hundred times stricter for forces, a thousand times for motions.
    pub const STRICT: ProofThreshold = ProofThreshold { imbalance: 1e-9, power_ratio: 1e10 };
}

/// The forces at all contacts and grips of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// The forces at each contact.
    pub contacts: Vec<ContactForces>,
    /// The forces at each grip.
    pub grips: Vec<GripForces>,
}

/// The forces at one contact, in newtons.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactForces {
    /// Normal forces at the two application points, pressure positive.
    pub normal: [f64; 2],
    /// Friction on the first body, positive along (−n_y, n_x).
    pub friction: f64,
}

/// The force and torque of a robot on the body that it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GripForces {
    /// Force on the body, N.
    pub force: Vector,
    /// Torque on the body, N·m.
    pub torque: f64,
}

impl Forces {
    /// Creates forces that are zero at all contacts and grips of an assembly.
    pub fn zero(assembly: &Assembly) -> Forces {
        let held = GripForces { force: Vector::zeros(), torque: 0.0 };
        Forces {
            contacts: vec![ContactForces::default(); assembly.contacts.len()],
            grips: vec![held; assembly.grips.len()],
        }
    }
}

/// The velocity of a block as a rigid body. In results, it is divided by the speed of the fastest point of the
/// mechanism.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Motion {
    /// The block.
    pub block: BlockId,
    /// Velocity of the block's centroid.
    pub velocity: Vector,
    /// Angular velocity, anticlockwise positive: radians per metre that the fastest point moves.
    pub spin: f64,
}

impl Motion {
    /// Returns the velocity of a point that moves with the block.
    pub fn at(&self, scene: &Scene, point: Point) -> Vector {
        self.about(scene.blocks[self.block.0].centroid, point)
    }

    /// Returns the speed of the block's fastest corner.
    pub fn fastest(&self, scene: &Scene) -> f64 {
        let block = &scene.blocks[self.block.0];
        self.fastest_of(block.centroid, block.body.polygon.outline())
    }

    /// Returns the velocity of a point that moves with a body; `centroid` is the centroid of the body.
    pub fn about(&self, centroid: Point, point: Point) -> Vector {
        self.velocity + quarter_turn(point - centroid) * self.spin
    }

    /// Returns the largest speed of some points that move with a body; `centroid` is the centroid of the body.
    pub fn fastest_of(&self, centroid: Point, points: &[Point]) -> f64 {
        let speeds = points.iter().map(|p| self.about(centroid, *p).norm());
        speeds.fold(0.0, f64::max)
    }

    /// Returns, for each component of a point's velocity, the sum of the magnitudes of its terms. The rounding error of
    /// the component is at most a small fraction of this sum.
    ///
    /// The components are summed separately, so that the rounding of a horizontal motion does not count as a vertical
    /// motion.
    fn summed(&self, centroid: Point, point: Point) -> Vector {
        self.velocity.abs() + (quarter_turn(point - centroid) * self.spin).abs()
    }
}

/// Returns the motions of the bodies of an assembly from three velocities for each: along x and y, and `length` times the
/// angular velocity.
pub fn motions_of(assembly: &Assembly, velocities: &[f64], length: f64) -> Vec<Motion> {
    let bodies = assembly.bodies.iter().zip(velocities.chunks_exact(3));
    let motion = |(body, v): (&AssemblyBody, &[f64])| Motion {
        block: body.block,
        velocity: Vector::new(v[0], v[1]),
        spin: v[2] / length,
    };
    bodies.map(motion).collect()
}

/// Returns the speed of the fastest corner of a body.
pub fn fastest(body: &AssemblyBody, motion: &Motion) -> f64 {
    motion.fastest_of(body.centroid, &body.corners)
}

/// A grip whose limit exceeds this multiple of the moving loads counts as unlimited: in a valid motion, its grip point
/// must not move in the direction of this limit. Motions of solvers are corrected in the same way.
///
/// A tenth of this value would reject motions in which a robot that can hold a thousand times the load gives way. With
/// ten times this value, the rounding of a speed (10⁻¹⁵) times the limit would be a noticeable power.
pub(in crate::mechanics) const NON_BINDING_RATIO: f64 = 1e4;

/// Checks forces on an assembly, and returns the largest errors: imbalance of a body, tension, slip, and excess over
/// the limits of a robot.
pub fn check_forces(assembly: &Assembly, forces: &Forces) -> Proof {
    let (mut worst_pull, mut worst_slip): (f64, f64) = (0.0, 0.0);
    // The relative violation `beyond` / `of`; 0 if nothing is violated, which avoids 0/0.
    let share = |beyond: f64, of: f64| if beyond > 0.0 { beyond / of } else { 0.0 };
    // Check the contact law: no tension, and friction within the cone. Errors are relative to the forces at the same
    // contact.
    for (contact, pressed) in assembly.contacts.iter().zip(&forces.contacts) {
        let [first, second] = pressed.normal;
        let own = first.abs() + second.abs() + pressed.friction.abs();
        // A corner contact has only one application point, so its second normal force must be 0.
        let pull = match contact.kind {
            ContactKind::Edge => (-first).max(-second),
            ContactKind::Corner => (-first).max(second.abs()),
        };
        let slip = pressed.friction.abs() - contact.friction * (first + second);
        worst_pull = worst_pull.max(share(pull, own));
        worst_slip = worst_slip.max(share(slip, own));
    }
    // Check the limits of robots: for each component of the force, and for the torque.
    for (grip, held) in assembly.grips.iter().zip(&forces.grips) {
        let limits = grip.limits;
        for (given, limit) in
            [(held.force.x.abs(), limits.fx), (held.force.y.abs(), limits.fy), (held.torque.abs(), limits.torque)]
        {
            worst_slip = worst_slip.max(share(given - limit, given));
        }
    }
    // Check the balance of each body.
    let (worst_imbalance, worst_share) = balance::worst_imbalance(assembly, forces);
    Proof::Forces { worst_imbalance, worst_share, worst_pull, worst_slip }
}

/// Returns the total load on the moving bodies, N. The [`gross_load`] of each body is weighted by its speed.
///
/// The speed of a body is that of its fastest point, relative to the fastest point of all bodies.
pub fn moving_load(assembly: &Assembly, motions: &[Motion]) -> f64 {
    let (mut sum, mut max_speed): (f64, f64) = (0.0, 0.0);
    for (body, motion) in assembly.bodies.iter().zip(motions) {
        let speed = fastest(body, motion);
        sum += gross_load(assembly, body) * speed;
        max_speed = max_speed.max(speed);
    }
    if max_speed > 0.0 { sum / max_speed } else { 0.0 }
}

/// Returns the size of all loads on a body, N: the magnitudes of its weight and its listed force, plus the magnitude of
/// its listed moment divided by its radius.
///
/// Loads in opposite directions do not cancel in this sum.
pub fn gross_load(assembly: &Assembly, body: &AssemblyBody) -> f64 {
    let listed = body.given(assembly.load_factor);
    let moment = listed.moment.abs() / body.radius();
    assembly.pull.norm() * body.weight + listed.force.norm() + moment
}

/// A bound of the relative rounding error of a sum of a few products.
const ROUNDING_TOL: f64 = 8.0 * f64::EPSILON;

/// Returns the largest violation of a contact by a motion: the speed against which a contact force with N + |T| = 1
/// would act, including rounding. It is 0 if no force at any contact would act against the motion.
fn worst_violation(assembly: &Assembly, motions: &[Motion]) -> f64 {
    // The velocity of a point, and the sum of the magnitudes of its terms, which bounds the rounding error.
    let velocity = |body: Option<usize>, at: Point| match body {
        None => (Vector::zeros(), Vector::zeros()),
        Some(number) => {
            let (centroid, m) = (assembly.bodies[number].centroid, &motions[number]);
            (m.about(centroid, at), m.summed(centroid, at))
        }
    };
    let mut violation: f64 = 0.0;
    for contact in &assembly.contacts {
        for at in contact.points {
            let (one, of_one) = velocity(Some(contact.on), at);
            let (other, of_other) = velocity(contact.from, at);
            let summed = of_one + of_other;
            if summed == Vector::zeros() {
                continue;
            }
            // Split the relative velocity at the point into its normal and tangential components.
            let apart = one - other;
            let (normal, tangent) = (contact.normal, contact.tangent());
            let (opens, slides) = (normal.dot(&apart), tangent.dot(&apart));
            // The worst force is an extreme force of the friction cone: either the normal force alone, or the normal
            // force with full friction against the sliding.
            let friction = contact.friction;
            let against = |slides: f64, closes: f64| ((friction * slides + closes) / (1.0 + friction)).max(closes);
            let rounding = ROUNDING_TOL * against(tangent.abs().dot(&summed), normal.abs().dot(&summed));
            violation = violation.max(against(slides.abs(), -opens) + rounding);
        }
    }
    violation
}

/// Returns the power of the loads along a motion, and the sum of the magnitudes of its terms, which bounds the rounding
/// error.
fn power_of_loads(assembly: &Assembly, motions: &[Motion]) -> (f64, f64) {
    let (mut power, mut summed) = (0.0, 0.0);
    for (body, motion) in assembly.bodies.iter().zip(motions) {
        let LoadVector { force, moment } = body.load;
        power += force.dot(&motion.velocity) + moment * motion.spin;
        summed += force.norm() * motion.velocity.norm() + (moment * motion.spin).abs();
    }
    (power, summed)
}

/// Returns the power of the loads along a motion, minus the largest power that robots with limits can absorb. The
/// result is in watts if the velocities are in m/s. Bodies without an entry in `motions` are at rest.
pub fn net_power(assembly: &Assembly, motions: &[Motion]) -> f64 {
    let motion_of: HashMap<BlockId, &Motion> = motions.iter().map(|m| (m.block, m)).collect();
    let mut power = 0.0;
    for body in &assembly.bodies {
        if let Some(m) = motion_of.get(&body.block) {
            power += body.load.force.dot(&m.velocity) + body.load.moment * m.spin;
        }
    }
    for grip in &assembly.grips {
        let body = &assembly.bodies[grip.body];
        let Some(m) = motion_of.get(&body.block) else {
            continue;
        };
        let speed = m.about(body.centroid, grip.at);
        for (speed, limit) in [(speed.x, grip.limits.fx), (speed.y, grip.limits.fy), (m.spin, grip.limits.torque)] {
            if limit.is_finite() {
                power -= speed.abs() * limit;
            }
        }
    }
    power
}

/// Checks a motion, which has one entry for each body. Returns two relative numbers: the power of the loads minus the
/// power that robots with limits can absorb, and the largest velocity against which contacts or unlimited grips could
/// act.
pub fn check_mechanism(assembly: &Assembly, motions: &[Motion]) -> Proof {
    let load = moving_load(assembly, motions);
    let speeds = assembly.bodies.iter().zip(motions).map(|(b, m)| fastest(b, m));
    let fastest = speeds.fold(0.0, f64::max);
    // Without motion or loads, nothing is proved: a power of 0 meets no threshold.
    if fastest == 0.0 || load == 0.0 {
        return Proof::Mechanism { power: 0.0, worst_violation: 0.0 };
    }
    // Compute the worst violation of a contact, and the power of the loads.
    let mut violation = worst_violation(assembly, motions);
    let (mut power, mut summed) = power_of_loads(assembly, motions);
    // A robot with a limit absorbs the power limit · speed. A robot without a limit does not let its grip point move.
    for grip in &assembly.grips {
        let (body, motion) = (&assembly.bodies[grip.body], &motions[grip.body]);
        let limits = grip.limits;
        let at_grip = motion.about(body.centroid, grip.at);
        let spin = motion.spin * assembly.length;
        let rounding = ROUNDING_TOL * motion.summed(body.centroid, grip.at);
        for (speed, limit, rounding) in [
            (at_grip.x, limits.fx, rounding.x),
            (at_grip.y, limits.fy, rounding.y),
            (spin, limits.torque / assembly.length, 0.0),
        ] {
            // If the limit is far above the loads, even the rounding error of a speed would cause a noticeable power.
            // Such a limit counts as infinite.
            if limit > NON_BINDING_RATIO * load {
                violation = violation.max(speed.abs() + rounding);
            } else {
                power -= limit * (speed.abs() + rounding);
                summed += limit * speed.abs();
            }
        }
    }
    // Subtract the rounding error of the sum, which grows with the number of terms.
    power -= (motions.len() + 8) as f64 * f64::EPSILON * summed;
    Proof::Mechanism { power: power / (load * fastest), worst_violation: violation / fastest }
}
