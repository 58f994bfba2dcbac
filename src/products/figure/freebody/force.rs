//! [`Force`]: a force on a block with its name in a free-body diagram. [`forces`] collects all forces on the block.

use super::super::description::{exerted_by, word};
use super::super::option::{Corners, Options};
use super::surroundings::{Corner, corners, distinct, inward};
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::analysis::{ActingForce, Analysis, Contact, Failure, ForceKind, FrameAnalysis};
use crate::mechanics::scene::format::UnitsEntry;
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::pictures::drawing::Colour;
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::products::wording::number::{force as amount, quantity};

/// For a block with at most this many interfaces, forces are drawn at both ends of each interface, unless the options
/// select another level of detail.
const MAX_INTERFACES_BY_CORNER: usize = 3;
/// Friction forces up to this fraction of the larger of the block's weight and its largest normal force count as
/// rounding errors of the solver.
const FORCE_TOL: f64 = 1e-9;

/// A force on the block.
#[derive(Clone, Debug)]
pub(super) struct Force {
    /// The name of the force.
    pub symbol: Symbol,
    /// The kind of the force, and what exerts it.
    pub kind: ForceKind,
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
        self.kind == ForceKind::Load
    }

    /// Describes the force and its magnitude, such as `Weight mg on block a: 6 N at 270°`. `on` is the name of the
    /// block.
    pub(super) fn title(&self, on: &str, units: UnitsEntry) -> String {
        let amount = if self.force.norm() > 0.0 || self.torque == 0.0 {
            amount(self.force, units)
        } else {
            quantity(self.torque, units.torque())
        };
        let word = if self.is_load() && self.torque != 0.0 { "Torque of a load" } else { word(self.kind) };
        format!("{word} {} on block {on}: {amount}", self.symbol.stated())
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
        scene: analysis.at(frame).scene,
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
    /// each. The number in the name of a load is its number on this block, from 1.
    fn applied(&self) -> Vec<Force> {
        let mut forces = Vec::new();
        let mut number = 0;
        for applied in &self.scene.applied_forces()[self.block.0] {
            let acting = applied.acting();
            if acting.kind == ForceKind::Weight {
                forces.push(self.entry(acting, weight()));
                continue;
            }
            number += 1;
            if acting.force.norm() > 0.0 {
                let push = ActingForce { torque: 0.0, ..acting };
                forces.push(self.entry(push, Symbol::new("Q", Accent::Arrow, &number.to_string())));
            }
            if acting.torque != 0.0 {
                let turn = ActingForce { force: Vector::zeros(), ..acting };
                forces.push(self.entry(turn, Symbol::new("M", Accent::None, &format!("Q{number}"))));
            }
        }
        forces
    }

    /// Creates the entry of a force or a torque.
    fn entry(&self, acting: ActingForce, symbol: Symbol) -> Force {
        let ActingForce { kind, at, force, torque, .. } = acting;
        let (scene, theme) = (self.scene, &self.options.theme);
        let from = match kind.partner() {
            Some(BodyId::Ground(_)) => "ground".to_owned(),
            Some(body) => scene.name(body).to_owned(),
            None => exerted_by(scene, kind).unwrap_or(word(kind).to_lowercase()),
        };
        let from = if kind.is_failure() { format!("missing, {from}") } else { from };
        let colour = match kind {
            ForceKind::Load => theme.load,
            ForceKind::Robot(robot) | ForceKind::RobotTorque(robot) => theme.robot(robot.0).mixed(theme.ink, 0.25),
            kind if kind.is_failure() => theme.failure,
            _ => theme.ink,
        };
        Force { symbol, kind, from, at, force, torque, colour }
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
            forces.push(self.of_contact(contact, ForceKind::Normal, named("s"), (corner.at, push)));
            let side = if corner.friction >= 0.0 { "fl" } else { "fr" };
            for kind in ["fl", "fr"] {
                let acts = kind == side && corner.friction.abs() > noise;
                if self.options.corners == Corners::Few && !acts {
                    continue;
                }
                let amount = if acts { corner.friction } else { 0.0 };
                let rub = (corner.at, left * amount);
                forces.push(self.of_contact(contact, ForceKind::Friction, named(kind), rub));
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
            self.of_contact(contact, ForceKind::Contact, symbol, (corner.at, sum))
        };
        self.ends(contact).map(force).collect()
    }

    /// Returns the resultant of the forces that an interface exerts on the block.
    fn resultant(&self, number: usize, contact: &Contact) -> Force {
        let ends = corners(contact, self.block);
        let normal = inward(contact, self.block);
        let sum: Vector = ends.iter().map(|corner| corner.on_block(normal)).sum();
        let symbol = Symbol::new("F", Accent::Arrow, &number.to_string());
        self.of_contact(contact, ForceKind::Contact, symbol, (contact.resultant.at, sum))
    }

    /// Returns the application points of an interface with their forces on the block, numbered from 1. If the two
    /// points coincide, returns only one.
    fn ends(&self, contact: &Contact) -> impl Iterator<Item = (usize, Corner)> {
        let count = distinct(contact).len();
        (1..).zip(corners(contact, self.block)).take(count)
    }

    /// Creates the entry for a force (N) that the interface `contact` exerts on the block at the point `at`.
    fn of_contact(
        &self,
        contact: &Contact,
        kind: fn(BodyId) -> ForceKind,
        symbol: Symbol,
        (at, force): (Point, Vector),
    ) -> Force {
        let kind = kind(contact.other(BodyId::Block(self.block)));
        self.entry(ActingForce { on: self.block, kind, at, force, torque: 0.0 }, symbol)
    }

    /// Returns the force of each robot that holds the block, and its torque if the robot can exert torques.
    fn robots(&self) -> Vec<Force> {
        let mut forces = Vec::new();
        for held in self.frame_analysis.robots.iter().filter(|r| r.block == self.block) {
            let robot = &self.scene.robots[held.robot.0];
            let push = ActingForce { torque: 0.0, ..held.acting() };
            forces.push(self.entry(push, Symbol::new("F", Accent::Arrow, "").raised(&robot.id)));
            if robot.limits.torque > 0.0 {
                let kind = ForceKind::RobotTorque(held.robot);
                let turn = ActingForce { kind, force: Vector::zeros(), ..held.acting() };
                forces.push(self.entry(turn, Symbol::new("M", Accent::None, "").raised(&robot.id)));
            }
        }
        forces
    }

    /// Returns the missing forces and torques on the block, with the names X1, X2 and so on.
    fn missing(&self) -> Vec<Force> {
        let missing = self.frame_analysis.failures.iter().flat_map(Failure::acting);
        let numbered = (1..).zip(missing.filter(|acting| acting.on == self.block));
        let entry = |(number, acting): (usize, ActingForce)| {
            let accent = if acting.torque == 0.0 { Accent::Arrow } else { Accent::None };
            self.entry(acting, Symbol::new("X", accent, &number.to_string()))
        };
        numbered.map(entry).collect()
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
