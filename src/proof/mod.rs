//! The verdict's proof, from geometry and forces alone.
//!
//! Makes [`Proof`]. Nothing here knows of programs, columns or solvers: the balance is summed again in metres and newtons
//! from the assembly's bodies, contacts and grips, the contact law is checked force by force, so a mistake in the program
//! cannot hide here. What the assembly itself says is held against the outlines by a test that shares no code with it.
//!
//! *Stable* is proved by forces: every block balances, nothing pulls, nothing slips, no robot exceeds its limits.
//! *Unstable* is proved by a motion: the loads do work along it, and no admissible force can object, because every
//! contact only opens or slides apart. If forces of a sum Σ(N + |T|) = F did balance, then power ≤ violation · F; a
//! motion with violation δ therefore rules out every balance with less force than power/δ ([`Proof::rules_out`]). What the
//! sums below may be off by in f64 counts against the motion, so a violation of 0 is none at all.

use crate::assembly::{Assembly, Body, LoadVector, about};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::interface::ContactKind;
use crate::scene::{BlockId, Scene};

/// How well a verdict is proved, from geometry and forces alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Proof {
    /// Forces that balance; each number relative to the largest weight.
    Forces {
        /// Worst imbalance of a block, force or moment/L.
        worst_imbalance: f64,
        /// Worst imbalance of a block in parts of its own load, where that is more than rounding of the heaviest.
        worst_share: f64,
        /// Worst pull at an application point.
        worst_pull: f64,
        /// Worst friction beyond μN, or robot component beyond its limit.
        worst_slip: f64,
    },
    /// A mechanism; velocities relative to its fastest point.
    Mechanism {
        /// Power of the loads along it less what robots can hold, relative to the largest weight; above 0. At least so much,
        /// whatever the rounding.
        power: f64,
        /// Worst velocity against which an admissible force could act, so many watts per newton of N + |T|: of a contact
        /// that closes or slides within its friction, or of a grip that is torn. At most so much, whatever the rounding.
        worst_violation: f64,
    },
}

impl Proof {
    /// Forces balance when they are off by no more than this share of the heaviest load.
    ///
    /// It is also the band within which a structure that just falls is called standing: by a push of this share of the
    /// heaviest weight, or a centre of gravity this share of L outside its support.
    pub const BAND: f64 = 1e-7;

    /// Nor may any block be off by more than this share of its own load: a feather under a mountain must balance too.
    pub const SHARE: f64 = 1e-2;

    /// A motion convinces when it rules out every balance of less than so many heaviest loads.
    ///
    /// Motions are freed of what a solver left undone before they are judged. What remains where a contact can neither open
    /// nor close is the rounding of speeds, some 10⁻¹⁵, so that a motion is believed as soon as it does work beyond
    /// [`Proof::BAND`].
    pub const CONVINCING: f64 = 1e7;

    /// Whether the proof convinces as [`Demand::STANDARD`] wants it.
    pub fn holds(&self) -> bool {
        self.meets(Demand::STANDARD)
    }

    /// Whether the proof comes to what is demanded.
    pub fn meets(&self, demand: Demand) -> bool {
        match *self {
            Proof::Forces {
                worst_imbalance,
                worst_share,
                worst_pull,
                worst_slip,
            } => {
                worst_imbalance.max(worst_pull).max(worst_slip) <= demand.imbalance
                    && worst_share <= Self::SHARE
            }
            Proof::Mechanism {
                power,
                worst_violation,
            } => power > 1e-12 && power >= demand.conviction * worst_violation,
        }
    }

    /// Below which sum of forces Σ(N + |T|), in heaviest loads, a motion rules out every balance: power / violation.
    ///
    /// What unlimited robots give counts among these forces. Infinite where nothing is violated: then no forces balance,
    /// however large. 0 for a proof by forces, which rules nothing out.
    pub fn rules_out(&self) -> f64 {
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
pub struct Demand {
    /// Worst imbalance, pull or slip of forces that balance, relative to the heaviest load.
    pub imbalance: f64,
    /// Power of a motion in parts of its worst violation.
    pub conviction: f64,
}

impl Demand {
    /// For every verdict.
    pub const STANDARD: Demand = Demand {
        imbalance: Proof::BAND,
        conviction: Proof::CONVINCING,
    };

    /// A hundred times narrower in forces, a thousand times in motions.
    pub const STRICT: Demand = Demand {
        imbalance: 1e-9,
        conviction: 1e10,
    };
}

/// Forces on an assembly, in the order of its contacts and grips.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// What each contact carries.
    pub contacts: Vec<Pressed>,
    /// What each grip gives.
    pub grips: Vec<Held>,
}

/// The forces at one contact, newtons.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pressed {
    /// Normal forces at the application points.
    pub normal: [f64; 2],
    /// Friction along (−n_y, n_x).
    pub friction: f64,
}

/// What a robot gives to the body it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// Force on the body, N.
    pub force: Vector,
    /// Torque on the body, N·m.
    pub torque: f64,
}

impl Forces {
    /// No force anywhere.
    pub fn none(assembly: &Assembly) -> Forces {
        let held = Held {
            force: Vector::zeros(),
            torque: 0.0,
        };
        Forces {
            contacts: vec![Pressed::default(); assembly.contacts.len()],
            grips: vec![held; assembly.grips.len()],
        }
    }
}

/// A block's velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
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

    /// The size of what a point's velocity is summed from, of which its rounding is a share.
    fn summed(&self, centroid: Point, point: Point) -> f64 {
        self.velocity.norm() + (point - centroid).norm() * self.spin.abs()
    }
}

/// Speed of the fastest corner of a body.
pub fn fastest(body: &Body, motion: &Motion) -> f64 {
    motion.fastest_of(body.centroid, &body.corners)
}

/// A limit of so many heaviest loads holds a grip as if it had none.
const NON_BINDING: f64 = 1e4;

/// Checks forces on an assembly: balance, pull, slip, limits.
pub fn forces(assembly: &Assembly, forces: &Forces) -> Proof {
    let heaviest = reference(assembly);
    let mut balance: Vec<LoadVector> = assembly.bodies.iter().map(|b| b.load).collect();
    let mut act = |number: usize, at: Point, force: Vector, torque: f64| {
        let more = about(assembly.bodies[number].centroid, at, force, torque);
        balance[number] = balance[number].and(more);
    };
    let (mut worst_pull, mut worst_slip): (f64, f64) = (0.0, 0.0);
    for (contact, pressed) in assembly.contacts.iter().zip(&forces.contacts) {
        let [first, second] = pressed.normal;
        let pushes = [
            (contact.points[0], contact.normal * first),
            (contact.points[1], contact.normal * second),
            (contact.ends[0], contact.tangent() * pressed.friction),
        ];
        for (at, push) in pushes {
            act(contact.on, at, push, 0.0);
            if let Some(from) = contact.from {
                act(from, at, -push, 0.0);
            }
        }
        worst_pull = worst_pull.max(-first).max(-second);
        if contact.kind == ContactKind::Corner {
            worst_pull = worst_pull.max(second.abs());
        }
        worst_slip = worst_slip.max(pressed.friction.abs() - contact.friction * (first + second));
    }
    for (grip, held) in assembly.grips.iter().zip(&forces.grips) {
        let limits = grip.limits;
        act(grip.body, grip.at, held.force, held.torque);
        worst_slip = worst_slip
            .max(held.force.x.abs() - limits.fx)
            .max(held.force.y.abs() - limits.fy);
        worst_slip = worst_slip.max((held.torque.abs() - limits.torque) / assembly.length);
    }
    let (mut worst_imbalance, mut worst_share): (f64, f64) = (0.0, 0.0);
    for (body, left) in assembly.bodies.iter().zip(&balance) {
        let size = |load: LoadVector| load.size(assembly.length);
        let (off, own) = (size(*left), size(body.load));
        worst_imbalance = worst_imbalance.max(off);
        // What weighs less than the rounding of the heaviest load cannot be told from nothing.
        if own > 1e-12 * heaviest {
            worst_share = worst_share.max(off / own);
        }
    }
    Proof::Forces {
        worst_imbalance: worst_imbalance / heaviest,
        worst_share,
        worst_pull: worst_pull / heaviest,
        worst_slip: worst_slip.max(0.0) / heaviest,
    }
}

/// The heaviest load, or 1 N where there is none.
fn reference(assembly: &Assembly) -> f64 {
    match assembly.heaviest() {
        0.0 => 1.0,
        heaviest => heaviest,
    }
}

/// Several times the rounding of one sum of a few products.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Checks a motion of an assembly, one entry for each of its bodies: the loads' power, and whether any contact or grip
/// objects.
pub fn mechanism(assembly: &Assembly, motions: &[Motion]) -> Proof {
    let heaviest = reference(assembly);
    let moving = |number: usize| (&assembly.bodies[number], &motions[number]);
    // A point's velocity, and what it is summed from.
    let velocity = |body: Option<usize>, at: Point| match body.map(moving) {
        None => (Vector::zeros(), 0.0),
        Some((body, m)) => (m.about(body.centroid, at), m.summed(body.centroid, at)),
    };
    let speeds = assembly
        .bodies
        .iter()
        .zip(motions)
        .map(|(b, m)| fastest(b, m));
    let fastest = speeds.fold(0.0, f64::max);
    if fastest == 0.0 {
        return Proof::Mechanism {
            power: 0.0,
            worst_violation: 0.0,
        };
    }
    let mut violation: f64 = 0.0;
    for contact in &assembly.contacts {
        for at in contact.points {
            let (one, of_one) = velocity(Some(contact.on), at);
            let (other, of_other) = velocity(contact.from, at);
            if of_one + of_other == 0.0 {
                continue;
            }
            let apart = one - other;
            let (opens, slides) = (contact.normal.dot(&apart), contact.tangent().dot(&apart));
            // A force of N + |T| = 1 can use most of this pressing alone, or with all the friction it has.
            let friction = contact.friction;
            let used = (friction * slides.abs() - opens) / (1.0 + friction);
            violation = violation.max(used.max(-opens) + ROUNDING * (of_one + of_other));
        }
    }
    let (mut power, mut summed) = (0.0, 0.0);
    for (body, motion) in assembly.bodies.iter().zip(motions) {
        let LoadVector { force, moment } = body.load;
        power += force.dot(&motion.velocity) + moment * motion.spin;
        summed += force.norm() * motion.velocity.norm() + (moment * motion.spin).abs();
    }
    for grip in &assembly.grips {
        let (body, motion) = moving(grip.body);
        let limits = grip.limits;
        let at_grip = motion.about(body.centroid, grip.at);
        let spin = motion.spin * assembly.length;
        let unsure = ROUNDING * motion.summed(body.centroid, grip.at);
        for (speed, limit, unsure) in [
            (at_grip.x, limits.fx, unsure),
            (at_grip.y, limits.fy, unsure),
            (spin, limits.torque / assembly.length, 0.0),
        ] {
            // A limit far beyond the loads would turn the rounding of a speed into power: such a grip must not give way.
            if limit > NON_BINDING * heaviest {
                violation = violation.max(speed.abs() + unsure);
            } else {
                power -= limit * (speed.abs() + unsure);
                summed += limit * speed.abs();
            }
        }
    }
    power -= (motions.len() + 8) as f64 * f64::EPSILON * summed;
    Proof::Mechanism {
        power: power / (heaviest * fastest),
        worst_violation: violation / fastest,
    }
}
