//! The verdict's proof, from geometry and forces alone.
//!
//! Makes [`Proof`]. Nothing here knows of programs, columns or solvers: the balance is summed again in metres and newtons
//! from the assembly's bodies, contacts and grips, the contact law is checked force by force, so a mistake in the program
//! cannot hide here. What the assembly itself says is held against the outlines by a test that shares no code with it.
//!
//! *Stable* is proved by forces: every block balances, nothing pulls, nothing slips, no robot exceeds its limits. Each is
//! judged where it acts: a block's balance by its own forces, a contact's law by the forces at that contact, so that
//! neither the heaviest block nor the typical length decides about the smallest stone.
//! *Unstable* is proved by a motion: the loads do work along it, and no admissible force can object, because every
//! contact only opens or slides apart. If forces of a sum Σ(N + |T|) = F did balance, then power ≤ violation · F; a
//! motion with violation δ therefore rules out every balance with less force than power/δ ([`Proof::excluded_force_sum`]). Power
//! counts in parts of the loads of what moves. What the sums below may be off by in f64 counts against the motion, so a
//! violation of 0 is none at all.

mod balance;
mod least;
#[cfg(test)]
mod tests;

pub use balance::imbalances;
pub use least::force_sum_lower_bound;

use crate::assembly::{Assembly, AssemblyBody, LoadVector};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::interface::ContactKind;
use crate::scene::{BlockId, Scene};

/// How well a verdict is proved, from geometry and forces alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof {
    /// Forces that balance, each number without unit.
    Forces {
        /// The smallest τ for which each force on a block, changed by at most τ of its own amount and moved by at most τ of
        /// the block's own radius, balances it exactly; the worst of all blocks ([`imbalances`]).
        worst_imbalance: f64,
        /// Worst imbalance of a block in parts of its own load, force or moment over its radius: for information.
        worst_share: f64,
        /// Worst pull at an application point, in parts of the forces at its contact.
        worst_pull: f64,
        /// Worst friction beyond μN, in parts of the forces at its contact, or robot component beyond its limit, in parts of
        /// the component.
        worst_slip: f64,
    },
    /// A mechanism; velocities relative to its fastest point.
    Mechanism {
        /// Power of the loads along it less what robots can hold, in parts of the loads of what moves, each by how far it moves
        /// ([`moving_load`]); above 0. At least so much, whatever the rounding.
        power: f64,
        /// Worst velocity against which an admissible force could act, so many watts per newton of N + |T|: of a contact
        /// that closes or slides within its friction, or of a grip that is torn. At most so much, whatever the rounding.
        worst_violation: f64,
    },
}

impl Proof {
    /// Forces balance when changing each by no more than this share of its own amount, and moving it by no more than this
    /// share of its block's own radius, balances every block.
    ///
    /// It is also the band within which a structure that just falls is called standing: by a push on a block of this share
    /// of the forces that act on it, or a centre of gravity this share of the block's radius outside its support.
    pub const IMBALANCE_TOL: f64 = 1e-7;

    /// A motion convinces when it rules out every balance of less than so many times the loads of what moves.
    ///
    /// Motions are freed of what a solver left undone before they are judged. What remains where a contact can neither open
    /// nor close is the rounding of speeds, some 10⁻¹⁵, so that a motion is believed as soon as it does work beyond
    /// [`Proof::IMBALANCE_TOL`].
    pub const MIN_POWER_RATIO: f64 = 1e7;

    /// Whether the proof convinces as [`ProofThreshold::STANDARD`] wants it.
    pub fn holds(&self) -> bool {
        self.meets(ProofThreshold::STANDARD)
    }

    /// Whether the proof comes to what is demanded.
    pub fn meets(&self, demand: ProofThreshold) -> bool {
        match *self {
            Proof::Forces {
                worst_imbalance,
                worst_pull,
                worst_slip,
                ..
            } => worst_imbalance.max(worst_pull).max(worst_slip) <= demand.imbalance,
            Proof::Mechanism {
                power,
                worst_violation,
            } => power > 1e-12 && power >= demand.power_ratio * worst_violation,
        }
    }

    /// Below which sum of forces Σ(N + |T|), in loads of what moves, a motion rules out every balance: power / violation.
    ///
    /// What unlimited robots give counts among these forces. Infinite where nothing is violated: then no forces balance,
    /// however large. 0 for a proof by forces, which rules nothing out.
    pub fn excluded_force_sum(&self) -> f64 {
        match *self {
            Proof::Mechanism {
                power,
                worst_violation,
            } if power > 0.0 => power / worst_violation,
            _ => 0.0,
        }
    }
}

/// What a proof must come to before its verdict is believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProofThreshold {
    /// Worst imbalance, pull or slip of forces that balance, each in parts of the forces it acts among.
    pub imbalance: f64,
    /// Power of a motion in parts of its worst violation.
    pub power_ratio: f64,
}

impl ProofThreshold {
    /// For every verdict.
    pub const STANDARD: ProofThreshold = ProofThreshold {
        imbalance: Proof::IMBALANCE_TOL,
        power_ratio: Proof::MIN_POWER_RATIO,
    };

    /// A hundred times narrower in forces, a thousand times in motions.
    pub const STRICT: ProofThreshold = ProofThreshold {
        imbalance: 1e-9,
        power_ratio: 1e10,
    };
}

/// Forces on an assembly, in the order of its contacts and grips.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// What each contact carries.
    pub contacts: Vec<ContactForces>,
    /// What each grip gives.
    pub grips: Vec<GripForces>,
}

/// The forces at one contact, newtons.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactForces {
    /// Normal forces at the application points.
    pub normal: [f64; 2],
    /// Friction along (−n_y, n_x).
    pub friction: f64,
}

/// What a robot gives to the body it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GripForces {
    /// Force on the body, N.
    pub force: Vector,
    /// Torque on the body, N·m.
    pub torque: f64,
}

impl Forces {
    /// No force anywhere.
    pub fn none(assembly: &Assembly) -> Forces {
        let held = GripForces {
            force: Vector::zeros(),
            torque: 0.0,
        };
        Forces {
            contacts: vec![ContactForces::default(); assembly.contacts.len()],
            grips: vec![held; assembly.grips.len()],
        }
    }
}

/// A block's velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Motion {
    /// The block.
    pub block: BlockId,
    /// Velocity of its centroid.
    pub velocity: Vector,
    /// Turning, anticlockwise positive, per metre of the fastest point's way.
    pub spin: f64,
}

impl Motion {
    /// Velocity of a point that moves with the block.
    pub fn at(&self, scene: &Scene, point: Point) -> Vector {
        self.about(scene.blocks[self.block.0].centroid, point)
    }

    /// Speed of the block's fastest corner.
    pub fn fastest(&self, scene: &Scene) -> f64 {
        let block = &scene.blocks[self.block.0];
        self.fastest_of(block.centroid, block.body.polygon.outline())
    }

    /// Velocity of a point of a body with this centroid.
    pub fn about(&self, centroid: Point, point: Point) -> Vector {
        self.velocity + quarter_turn(point - centroid) * self.spin
    }

    /// Speed of the fastest of some points of a body with this centroid.
    pub fn fastest_of(&self, centroid: Point, points: &[Point]) -> f64 {
        let speeds = points.iter().map(|p| self.about(centroid, *p).norm());
        speeds.fold(0.0, f64::max)
    }

    /// The size of what each component of a point's velocity is summed from, of which its rounding is a share: a block that
    /// slides along a level joint does not rise by the rounding of its sliding.
    fn summed(&self, centroid: Point, point: Point) -> Vector {
        self.velocity.abs() + (quarter_turn(point - centroid) * self.spin).abs()
    }
}

/// Speed of the fastest corner of a body.
pub fn fastest(body: &AssemblyBody, motion: &Motion) -> f64 {
    motion.fastest_of(body.centroid, &body.corners)
}

/// A limit of so many loads of what moves holds a grip as if it had none.
const NON_BINDING: f64 = 1e4;

/// Checks forces on an assembly: balance, pull, slip, limits.
pub fn check_forces(assembly: &Assembly, forces: &Forces) -> Proof {
    let (mut worst_pull, mut worst_slip): (f64, f64) = (0.0, 0.0);
    // In parts of what acts there; where nothing does, nothing can be broken.
    let share = |beyond: f64, of: f64| if beyond > 0.0 { beyond / of } else { 0.0 };
    for (contact, pressed) in assembly.contacts.iter().zip(&forces.contacts) {
        let [first, second] = pressed.normal;
        let own = first.abs() + second.abs() + pressed.friction.abs();
        let pull = match contact.kind {
            ContactKind::Edge => (-first).max(-second),
            ContactKind::Corner => (-first).max(second.abs()),
        };
        let slip = pressed.friction.abs() - contact.friction * (first + second);
        worst_pull = worst_pull.max(share(pull, own));
        worst_slip = worst_slip.max(share(slip, own));
    }
    for (grip, held) in assembly.grips.iter().zip(&forces.grips) {
        let limits = grip.limits;
        for (given, limit) in [
            (held.force.x.abs(), limits.fx),
            (held.force.y.abs(), limits.fy),
            (held.torque.abs(), limits.torque),
        ] {
            worst_slip = worst_slip.max(share(given - limit, given));
        }
    }
    let (worst_imbalance, worst_share) = balance::worst(assembly, forces);
    Proof::Forces {
        worst_imbalance,
        worst_share,
        worst_pull,
        worst_slip,
    }
}

/// The loads of what moves, N: of every body its weight and listed loads, each by its fastest point's speed in parts of
/// the fastest of all.
pub fn moving_load(assembly: &Assembly, motions: &[Motion]) -> f64 {
    let (mut sum, mut most): (f64, f64) = (0.0, 0.0);
    for (body, motion) in assembly.bodies.iter().zip(motions) {
        let speed = fastest(body, motion);
        sum += gross_load(assembly, body) * speed;
        most = most.max(speed);
    }
    if most > 0.0 { sum / most } else { 0.0 }
}

/// Weight and listed loads of a body, N, a moment over its radius; not less where they act against each other.
pub fn gross_load(assembly: &Assembly, body: &AssemblyBody) -> f64 {
    let listed = body.listed.times(assembly.load_factor);
    let moment = listed.moment.abs() / body.radius();
    assembly.pull.norm() * body.weight + listed.force.norm() + moment
}

/// Several times the rounding of one sum of a few products.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The worst velocity against which a contact's force could act, per unit of N + |T|, with its rounding; 0 where every
/// contact opens.
fn worst_violation(assembly: &Assembly, motions: &[Motion]) -> f64 {
    // A point's velocity, and what it is summed from.
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
            let apart = one - other;
            let (normal, tangent) = (contact.normal, contact.tangent());
            let (opens, slides) = (normal.dot(&apart), tangent.dot(&apart));
            // A force of N + |T| = 1 can use most of this pressing alone, or with all the friction it has.
            let friction = contact.friction;
            let used = (friction * slides.abs() - opens) / (1.0 + friction);
            let unsure = normal.abs().dot(&summed) + friction * tangent.abs().dot(&summed);
            violation = violation.max(used.max(-opens) + ROUNDING * unsure);
        }
    }
    violation
}

/// The power of the loads along a motion, and the sum of the amounts it is summed from.
fn power_of_loads(assembly: &Assembly, motions: &[Motion]) -> (f64, f64) {
    let (mut power, mut summed) = (0.0, 0.0);
    for (body, motion) in assembly.bodies.iter().zip(motions) {
        let LoadVector { force, moment } = body.load;
        power += force.dot(&motion.velocity) + moment * motion.spin;
        summed += force.norm() * motion.velocity.norm() + (moment * motion.spin).abs();
    }
    (power, summed)
}

/// Checks a motion of an assembly, one entry for each of its bodies: the loads' power, and whether any contact or grip
/// objects.
pub fn check_mechanism(assembly: &Assembly, motions: &[Motion]) -> Proof {
    let load = moving_load(assembly, motions);
    let speeds = assembly
        .bodies
        .iter()
        .zip(motions)
        .map(|(b, m)| fastest(b, m));
    let fastest = speeds.fold(0.0, f64::max);
    if fastest == 0.0 || load == 0.0 {
        return Proof::Mechanism {
            power: 0.0,
            worst_violation: 0.0,
        };
    }
    let mut violation = worst_violation(assembly, motions);
    let (mut power, mut summed) = power_of_loads(assembly, motions);
    for grip in &assembly.grips {
        let (body, motion) = (&assembly.bodies[grip.body], &motions[grip.body]);
        let limits = grip.limits;
        let at_grip = motion.about(body.centroid, grip.at);
        let spin = motion.spin * assembly.length;
        let unsure = ROUNDING * motion.summed(body.centroid, grip.at);
        for (speed, limit, unsure) in [
            (at_grip.x, limits.fx, unsure.x),
            (at_grip.y, limits.fy, unsure.y),
            (spin, limits.torque / assembly.length, 0.0),
        ] {
            // A limit far beyond the loads would turn the rounding of a speed into power: such a grip must not give way.
            if limit > NON_BINDING * load {
                violation = violation.max(speed.abs() + unsure);
            } else {
                power -= limit * (speed.abs() + unsure);
                summed += limit * speed.abs();
            }
        }
    }
    power -= (motions.len() + 8) as f64 * f64::EPSILON * summed;
    Proof::Mechanism {
        power: power / (load * fastest),
        worst_violation: violation / fastest,
    }
}
