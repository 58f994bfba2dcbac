//! [`Force`]: a force on a block with its name in a free-body diagram. [`forces`] collects all forces on the block.

use super::super::option::{Corners, Options};
use super::surroundings::{Corner, corners, distinct, inward, other};
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::analysis::{Analysis, Contact, Failure, FrameAnalysis};
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{AppliedForce, BlockId, BodyId, ForceCause, Scene};
use crate::pictures::drawing::Colour;
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::products::wording::number::{force as amount, quantity};

/// For a block with at most this many interfaces, forces are drawn at both ends of each interface, unless the options
/// select another level of detail.
const MAX_INTERFACES_BY_CORNER: usize = 3;
/// Friction forces up to this fraction of the larger of the block's weight and its largest normal force count as
/// rounding errors of the solver.
const FORCE_TOL: f64 = 1e-9;

/// What exerts a force on a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    Weight,
    /// The force of a load.
    Load,
    /// The torque of a load.
    LoadTorque,
    /// The normal force at an end of an interface, the friction force there, or both.
    Normal,
    Friction,
    Contact,
    /// The force of a robot.
    Robot,
    /// The torque of a robot.
    RobotTorque,
    /// A missing force or torque; the word says which.
    Missing(&'static str),
}

impl Cause {
    /// The word for the force, such as `Weight`.
    fn word(self) -> &'static str {
        match self {
            Cause::Weight => "Weight",
            Cause::Load => "Load",
            Cause::LoadTorque => "Torque of a load",
            Cause::Normal => "Normal force",
            Cause::Friction => "Friction force",
            Cause::Contact | Cause::Robot => "Force",
            Cause::RobotTorque => "Torque",
            Cause::Missing(word) => word,
        }
    }

    /// True for a force of an interface.
    pub(super) fn is_interface(self) -> bool {
        matches!(self, Cause::Normal | Cause::Friction | Cause::Contact)
    }
}

/// A force on the block.
#[derive(Clone, Debug)]
pub(super) struct Force {
    /// The name of the force.
    pub symbol: Symbol,
    /// What exerts the force.
    pub cause: Cause,
    /// The origin of the force, such as the name of a block.
    pub from: String,
    /// The point where the force acts, metres.
    pub at: Point,
    /// The force, N.
    pub force: Vector,
    /// The torque, N·m, anticlockwise positive.
    pub torque: f64,
    /// The colour of the arrow.
    pub colour: Colour,
}

impl Force {
    /// Returns the moment of the force about a point, N·m.
    pub(super) fn moment(&self, about: Point) -> f64 {
        cross(self.at - about, self.force) + self.torque
    }

    /// True for a force or a torque of a load.
    pub(super) fn is_load(&self) -> bool {
        matches!(self.cause, Cause::Load | Cause::LoadTorque)
    }

    /// True for a missing force or torque.
    pub(super) fn is_missing(&self) -> bool {
        matches!(self.cause, Cause::Missing(_))
    }

    /// Describes the force and its magnitude, such as `Weight mg on block a: 6 N at 270°`. `on` is the name of the
    /// block.
    pub(super) fn title(&self, on: &str, units: UnitsEntry) -> String {
        let amount = if self.force.norm() > 0.0 || self.torque == 0.0 {
            amount(self.force, units)
        } else {
            quantity(self.torque, units.torque())
        };
        format!("{} {} on block {on}: {amount}", self.cause.word(), self.symbol.stated())
    }
}

/// The level of detail of the forces of interfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Detail {
    /// Normal and friction force at each end of an interface, each with a separate name. Used for a block with one
    /// interface.
    Parts,
    /// One force at each end of an interface. Used for a block with few interfaces, or if the options request all
    /// corners.
    Corners,
    /// One force for each interface.
    Resultants,
}

/// Returns the level of detail at which the forces of interfaces are drawn for a block with `count` interfaces.
pub(super) fn detail(count: usize, options: &Options) -> Detail {
    match (options.corners, count) {
        (_, 0..=1) => Detail::Parts,
        (Corners::All, _) => Detail::Corners,
        (Corners::Few, n) if n <= MAX_INTERFACES_BY_CORNER => Detail::Corners,
        (Corners::Few, _) => Detail::Resultants,
    }
}

/// Returns all forces on a block: weight, loads, forces of interfaces and robots, and missing forces.
pub(super) fn forces(
    analysis: &Analysis,
    frame: usize,
    block: BlockId,
    contacts: &[&Contact],
    options: &Options,
) -> Vec<Force> {
    let source = ForceSource {
        scene: analysis.scene_of(frame),
        frame_analysis: &analysis.frames[frame],
        block,
        contacts,
        options,
    };
    let mut forces = source.applied();
    for (number, contact) in contacts.iter().enumerate() {
        forces.extend(source.interface(number + 1, contact));
    }
    forces.extend(source.robots());
    forces.extend(source.missing());
    forces
}

/// Collects the forces on a block, one method for each kind of force.
struct ForceSource<'a> {
    scene: &'a Scene,
    frame_analysis: &'a FrameAnalysis,
    block: BlockId,
    /// The contacts of the block.
    contacts: &'a [&'a Contact],
    options: &'a Options,
}

impl ForceSource<'_> {
    /// Returns the weight of the block and the loads on it. A load with a force and a torque has two entries, one for
    /// each.
    fn applied(&self) -> Vec<Force> {
        let mut forces = Vec::new();
        let mut load_count = 0;
        for applied in &self.scene.applied_forces()[self.block.0] {
            forces.extend(match applied.cause {
                ForceCause::Weight => vec![self.weight(applied)],
                ForceCause::Load(_) => {
                    load_count += 1;
                    self.load(applied, load_count)
                }
            });
        }
        forces
    }

    /// Returns the weight as an entry of the diagram.
    fn weight(&self, applied: &AppliedForce) -> Force {
        Force {
            symbol: weight(),
            cause: Cause::Weight,
            from: "weight".to_owned(),
            at: applied.at,
            force: applied.force,
            torque: 0.0,
            colour: self.options.theme.ink,
        }
    }

    /// Returns the force and the torque of a load, without those that are 0. `number` is the number of the load on this
    /// block, from 1.
    fn load(&self, applied: &AppliedForce, number: usize) -> Vec<Force> {
        let below = number.to_string();
        let push = Force {
            symbol: Symbol::new("Q", Accent::Arrow, &below),
            cause: Cause::Load,
            from: "load".to_owned(),
            at: applied.at,
            force: applied.force,
            torque: 0.0,
            colour: self.options.theme.load,
        };
        let turn = Force {
            symbol: Symbol::new("M", Accent::None, &format!("Q{below}")),
            cause: Cause::LoadTorque,
            force: Vector::zeros(),
            torque: applied.torque,
            ..push.clone()
        };
        let push = (push.force.norm() > 0.0).then_some(push);
        let turn = (turn.torque != 0.0).then_some(turn);
        push.into_iter().chain(turn).collect()
    }

    /// Returns the forces of an interface on the block, at the level of detail of the figure. `number` is the number of
    /// the interface, from 1.
    fn interface(&self, number: usize, contact: &Contact) -> Vec<Force> {
        match detail(self.contacts.len(), self.options) {
            Detail::Parts => self.normal_and_friction(contact),
            Detail::Corners => self.corner_forces(number, contact),
            Detail::Resultants => vec![self.resultant(number, contact)],
        }
    }

    /// Returns the normal force and the friction force at each end of an interface. A friction force is named by its
    /// direction seen along the unit normal into the block: `fl` to the left, `fr` to the right. With [`Corners::All`]
    /// both names are listed, and the force that does not act is 0.
    fn normal_and_friction(&self, contact: &Contact) -> Vec<Force> {
        let normal = inward(contact, self.block);
        let left = quarter_turn(normal);
        let pushes = self.contacts.iter().flat_map(|c| c.normal_forces);
        let weight = self.scene.blocks[self.block.0].weight;
        let noise = FORCE_TOL * pushes.fold(weight, f64::max);
        let mut forces = Vec::new();
        for (number, corner) in self.ends(contact) {
            let named = |kind: &str| Symbol::new("F", Accent::Arrow, &format!("{kind}{number}"));
            let push = normal * corner.normal;
            forces.push(self.of_contact(contact, Cause::Normal, named("s"), (corner.at, push)));
            let side = if corner.friction >= 0.0 { "fl" } else { "fr" };
            for kind in ["fl", "fr"] {
                let acts = kind == side && corner.friction.abs() > noise;
                if self.options.corners == Corners::Few && !acts {
                    continue;
                }
                let amount = if acts { corner.friction } else { 0.0 };
                let rub = (corner.at, left * amount);
                forces.push(self.of_contact(contact, Cause::Friction, named(kind), rub));
            }
        }
        forces
    }

    /// Returns one force for each application point of an interface: the sum of the normal and the friction force
    /// there. If the two points coincide, returns only one force.
    fn corner_forces(&self, number: usize, contact: &Contact) -> Vec<Force> {
        let (letter, accent) = match self.options.corners {
            Corners::All => ("x", Accent::None),
            Corners::Few => ("F", Accent::Arrow),
        };
        let force = |(end, corner): (usize, Corner)| {
            let symbol = Symbol::new(letter, accent, &end.to_string());
            let symbol = symbol.raised(&format!("({number})"));
            let sum = corner.on_block(inward(contact, self.block));
            self.of_contact(contact, Cause::Contact, symbol, (corner.at, sum))
        };
        self.ends(contact).map(force).collect()
    }

    /// Returns the resultant of the forces that an interface exerts on the block.
    fn resultant(&self, number: usize, contact: &Contact) -> Force {
        let ends = corners(contact, self.block);
        let normal = inward(contact, self.block);
        let sum: Vector = ends.iter().map(|corner| corner.on_block(normal)).sum();
        let symbol = Symbol::new("F", Accent::Arrow, &number.to_string());
        self.of_contact(contact, Cause::Contact, symbol, (contact.resultant.at, sum))
    }

    /// Returns the application points of an interface with their forces on the block, numbered from 1. If the two
    /// points coincide, returns only one.
    fn ends(&self, contact: &Contact) -> impl Iterator<Item = (usize, Corner)> {
        let count = distinct(contact).len();
        (1..).zip(corners(contact, self.block)).take(count)
    }

    /// Creates the entry for a force (N) that the interface `contact` exerts on the block at the point `at`.
    fn of_contact(&self, contact: &Contact, cause: Cause, symbol: Symbol, (at, force): (Point, Vector)) -> Force {
        Force {
            symbol,
            cause,
            from: self.named(other(contact, self.block)),
            at,
            force,
            torque: 0.0,
            colour: self.options.theme.ink,
        }
    }

    /// Returns the force of each robot that holds the block, and its torque if the robot can exert torques.
    fn robots(&self) -> Vec<Force> {
        let (scene, theme) = (self.scene, &self.options.theme);
        let mut forces = Vec::new();
        for held in self.frame_analysis.robots.iter().filter(|r| r.block == self.block) {
            let robot = &scene.robots[held.robot.0];
            let push = Force {
                symbol: Symbol::new("F", Accent::Arrow, "").raised(&robot.id),
                cause: Cause::Robot,
                from: format!("robot {}", robot.id),
                at: held.at,
                force: held.force,
                torque: 0.0,
                colour: theme.robot(held.robot.0).mixed(theme.ink, 0.25),
            };
            let turn = Force {
                symbol: Symbol::new("M", Accent::None, "").raised(&robot.id),
                cause: Cause::RobotTorque,
                force: Vector::zeros(),
                torque: held.torque,
                ..push.clone()
            };
            forces.push(push);
            forces.extend((robot.limits.torque > 0.0).then_some(turn));
        }
        forces
    }

    /// Returns the missing forces and torques on the block, with the names X1, X2 and so on.
    fn missing(&self) -> Vec<Force> {
        let failures = self.frame_analysis.failures.iter();
        let missing = failures.filter_map(|failure| self.missing_force(failure));
        let numbered = missing.enumerate().map(|(number, force)| {
            let accent = if force.torque == 0.0 { Accent::Arrow } else { Accent::None };
            Force { symbol: Symbol::new("X", accent, &(number + 1).to_string()), ..force }
        });
        numbered.collect()
    }

    /// Returns the missing force or torque of a failure; its symbol has no number yet. Returns `None` if the force does
    /// not act on the block.
    fn missing_force(&self, failure: &Failure) -> Option<Force> {
        let own = BodyId::Block(self.block);
        let (force, torque) = failure.on(own)?;
        let what = match failure {
            Failure::Tension { .. } => "Missing pull",
            Failure::Friction { .. } => "Missing friction",
            Failure::RobotForce { .. } => "Missing force",
            Failure::RobotTorque { .. } => "Missing torque",
        };
        let from = match *failure {
            Failure::Tension { bodies, .. } | Failure::Friction { bodies, .. } => {
                self.named(bodies.into_iter().find(|body| *body != own)?)
            }
            _ => format!("robot {}", self.scene.robots[failure.robot()?.0].id),
        };
        Some(Force {
            symbol: Symbol::new("X", Accent::None, ""),
            cause: Cause::Missing(what),
            from: format!("missing, {from}"),
            at: failure.at(),
            force,
            torque,
            colour: self.options.theme.failure,
        })
    }

    /// Returns the name of a body for the list of forces: `ground`, or the name of the block.
    fn named(&self, body: BodyId) -> String {
        match body {
            BodyId::Ground(_) => "ground".to_owned(),
            BodyId::Block(_) => self.scene.name(body).to_owned(),
        }
    }
}

/// Returns the force that the longest arrow shows, N. A torque is divided by `edge`, the unit length in metres, and
/// counts as a force. Returns 0 if the lengths of arrows do not show magnitudes.
pub(super) fn largest(forces: &[Force], edge: f64, options: &Options) -> f64 {
    let size = |f: &Force| f.force.norm().max(f.torque.abs() / edge);
    if options.corners == Corners::All { 0.0 } else { forces.iter().map(size).fold(0.0, f64::max) }
}

/// Returns the symbol m·g of a weight.
pub(super) fn weight() -> Symbol {
    Symbol::new("m", Accent::None, "").then(Symbol::new("g", Accent::Arrow, ""))
}
