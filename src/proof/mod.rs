//! The verdict's proof, from geometry and forces alone.
//!
//! Makes [`Proof`]. Nothing here knows of programs, columns or solvers: the balance is summed again from the scene's
//! polygons, weights and loads, the contact law is checked force by force, so a mistake in the program cannot hide here.
//!
//! *Stable* is proved by forces: every block balances, nothing pulls, nothing slips, no robot exceeds its limits.
//! *Unstable* is proved by a motion: the loads do work along it, and no admissible force can object, because every
//! contact only opens or slides apart. If forces of a sum Σ(N + |T|) = F did balance, then power ≤ violation · F; a
//! motion with violation δ therefore rules out every balance with less force than power/δ ([`Proof::rules_out`]). What the
//! sums below may be off by in f64 counts against the motion, so a violation of 0 is none at all.

use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::interface::{ContactKind, Interface};
use crate::scene::{BlockId, BodyId, Frame, Scene};

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

/// The forces at one interface, newtons.
#[derive(Clone, Copy, Debug)]
pub struct Pressed<'a> {
    /// Where.
    pub interface: &'a Interface,
    /// Normal forces at the application points.
    pub normal: [f64; 2],
    /// Friction along (−n_y, n_x).
    pub friction: f64,
}

/// What a robot gives, for one of the frame's holds.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    /// The hold's number in the frame.
    pub hold: usize,
    /// Force on the block, N.
    pub force: Vector,
    /// Torque on the block, N·m.
    pub torque: f64,
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
        self.velocity + quarter_turn(point - scene.blocks[self.block.0].centroid) * self.spin
    }

    /// The size of what a point's velocity is summed from, of which its rounding is a share.
    fn summed(&self, scene: &Scene, point: Point) -> f64 {
        let arm = point - scene.blocks[self.block.0].centroid;
        self.velocity.norm() + arm.norm() * self.spin.abs()
    }

    /// Speed of the block's fastest corner.
    pub fn fastest(&self, scene: &Scene) -> f64 {
        let corners = scene.blocks[self.block.0].body.polygon.outline();
        corners
            .iter()
            .map(|p| self.at(scene, *p).norm())
            .fold(0.0, f64::max)
    }
}

/// What is measured against: the heaviest load of the group in newtons, and L in metres.
#[derive(Clone, Copy, Debug)]
pub struct Yardstick {
    /// Heaviest load, N.
    pub force: f64,
    /// Median interface length, m.
    pub length: f64,
}

/// A limit of so many heaviest loads holds a grip as if it had none.
const LAVISH: f64 = 1e4;

/// Load on a block about its centroid: weight along gravity and the listed loads, (N, N·m).
fn load(scene: &Scene, block: BlockId) -> (Vector, f64) {
    let body = &scene.blocks[block.0];
    let own = (scene.down() * body.weight, 0.0);
    scene
        .loads
        .iter()
        .filter(|l| l.block == block)
        .fold(own, |(force, moment), l| {
            (
                force + l.force,
                moment + cross(l.at - body.centroid, l.force) + l.torque,
            )
        })
}

/// Checks forces on a group of blocks: balance, pull, slip, limits.
pub fn forces(
    scene: &Scene,
    frame: &Frame,
    blocks: &[BlockId],
    pressed: &[Pressed],
    held: &[Held],
    yardstick: Yardstick,
) -> Proof {
    let mut balance: Vec<(Vector, f64)> = vec![(Vector::zeros(), 0.0); scene.blocks.len()];
    for block in blocks {
        balance[block.0] = load(scene, *block);
    }
    let (mut worst_pull, mut worst_slip): (f64, f64) = (0.0, 0.0);
    for contact in pressed {
        let interface = contact.interface;
        let points = interface.application_points(scene.kernel);
        let pushes = [
            (points[0], interface.normal * contact.normal[0]),
            (points[1], interface.normal * contact.normal[1]),
            (
                interface.ends[0],
                quarter_turn(interface.normal) * contact.friction,
            ),
        ];
        for (body, sign) in interface.bodies.into_iter().zip([1.0, -1.0]) {
            if let BodyId::Block(id) = body {
                let centroid = scene.blocks[id.0].centroid;
                let (force, moment) = &mut balance[id.0];
                for (at, push) in pushes {
                    *force += push * sign;
                    *moment += cross(at - centroid, push * sign);
                }
            }
        }
        worst_pull = worst_pull.max(-contact.normal[0]).max(-contact.normal[1]);
        if interface.kind == ContactKind::Corner {
            worst_pull = worst_pull.max(contact.normal[1].abs());
        }
        worst_slip = worst_slip.max(
            contact.friction.abs() - interface.friction * (contact.normal[0] + contact.normal[1]),
        );
    }
    for grip in held {
        let hold = frame.holds[grip.hold];
        let limits = scene.robots[hold.robot.0].limits;
        let (force, moment) = &mut balance[hold.block.0];
        *force += grip.force;
        *moment += cross(hold.at - scene.blocks[hold.block.0].centroid, grip.force) + grip.torque;
        worst_slip = worst_slip
            .max(grip.force.x.abs() - limits.fx)
            .max(grip.force.y.abs() - limits.fy);
        worst_slip = worst_slip.max((grip.torque.abs() - limits.torque) / yardstick.length);
    }
    let (mut worst_imbalance, mut worst_share): (f64, f64) = (0.0, 0.0);
    for block in blocks {
        let size =
            |(force, moment): (Vector, f64)| force.norm().max(moment.abs() / yardstick.length);
        let (off, own) = (size(balance[block.0]), size(load(scene, *block)));
        worst_imbalance = worst_imbalance.max(off);
        // What weighs less than the rounding of the heaviest load cannot be told from nothing.
        if own > 1e-12 * yardstick.force {
            worst_share = worst_share.max(off / own);
        }
    }
    Proof::Forces {
        worst_imbalance: worst_imbalance / yardstick.force,
        worst_share,
        worst_pull: worst_pull / yardstick.force,
        worst_slip: worst_slip.max(0.0) / yardstick.force,
    }
}

/// Several times the rounding of one sum of a few products.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Checks a motion of a group of blocks: the loads' power, and whether any contact or grip objects.
pub fn mechanism(
    scene: &Scene,
    frame: &Frame,
    motions: &[Motion],
    interfaces: &[&Interface],
    yardstick: Yardstick,
) -> Proof {
    let mut moving: Vec<Option<Motion>> = vec![None; scene.blocks.len()];
    for motion in motions {
        moving[motion.block.0] = Some(*motion);
    }
    // A point's velocity, and what it is summed from.
    let velocity = |body: BodyId, at: Point| match body {
        BodyId::Ground(_) => (Vector::zeros(), 0.0),
        BodyId::Block(id) => moving[id.0].map_or((Vector::zeros(), 0.0), |m| {
            (m.at(scene, at), m.summed(scene, at))
        }),
    };
    let fastest = motions.iter().map(|m| m.fastest(scene)).fold(0.0, f64::max);
    if fastest == 0.0 {
        return Proof::Mechanism {
            power: 0.0,
            worst_violation: 0.0,
        };
    }
    let mut violation: f64 = 0.0;
    for interface in interfaces {
        for at in interface.application_points(scene.kernel) {
            let [(one, of_one), (other, of_other)] = interface.bodies.map(|b| velocity(b, at));
            if of_one + of_other == 0.0 {
                continue;
            }
            let apart = one - other;
            let (opens, slides) = (
                interface.normal.dot(&apart),
                quarter_turn(interface.normal).dot(&apart),
            );
            // A force of N + |T| = 1 can use most of this pressing alone, or with all the friction it has.
            let friction = interface.friction;
            let used = (friction * slides.abs() - opens) / (1.0 + friction);
            violation = violation.max(used.max(-opens) + ROUNDING * (of_one + of_other));
        }
    }
    let (mut power, mut summed) = (0.0, 0.0);
    for motion in motions {
        let (force, moment) = load(scene, motion.block);
        power += force.dot(&motion.velocity) + moment * motion.spin;
        summed += force.norm() * motion.velocity.norm() + (moment * motion.spin).abs();
    }
    for hold in &frame.holds {
        let Some(motion) = moving[hold.block.0] else {
            continue;
        };
        let limits = scene.robots[hold.robot.0].limits;
        let at_grip = motion.at(scene, hold.at);
        let spin = motion.spin * yardstick.length;
        let unsure = ROUNDING * motion.summed(scene, hold.at);
        for (speed, limit, unsure) in [
            (at_grip.x, limits.fx, unsure),
            (at_grip.y, limits.fy, unsure),
            (spin, limits.torque / yardstick.length, 0.0),
        ] {
            // A limit far beyond the loads would turn the rounding of a speed into power: such a grip must not give way.
            if limit > LAVISH * yardstick.force {
                violation = violation.max(speed.abs() + unsure);
            } else {
                power -= limit * (speed.abs() + unsure);
                summed += limit * speed.abs();
            }
        }
    }
    power -= (motions.len() + 8) as f64 * f64::EPSILON * summed;
    Proof::Mechanism {
        power: power / (yardstick.force * fastest),
        worst_violation: violation / fastest,
    }
}
