//! [`Scene`]: a checked description of a structure: its blocks, ground, robots and loads.
//!
//! Invariant: a `Scene` is valid. Names are resolved, outlines are simple, numbers are finite and in range, and the
//! steps have been converted to [`Frame`]s. In no frame does a block overlap another body by more than the tolerance,
//! except for [`Scene::penetrations`]. Overlaps are not checked if contacts are listed or a block has no outline.

mod applied_force;
mod body;
mod collision;
mod finding;
pub mod format;
mod heal;
mod joint_set;
mod name;
mod note;
mod number;
mod outline;
mod steps;
mod problem;
mod reading;
#[cfg(any(feature = "cli", feature = "wasm"))]
mod changed;
mod resolution;
mod rounding;
pub mod shape;
mod sketch;
mod unit;

pub use applied_force::{AppliedForce, ForceCause};
pub use body::{
    Block, BlockId, Body, BodyId, Case, Frame, Grip, Ground, Hold, Limits, ListedContact, Load, Material, Plan, Rgb,
    Robot, RobotId, Spread,
};
pub use collision::Penetration;
pub(crate) use format::CornerContacts;
#[cfg(any(feature = "cli", feature = "wasm"))]
pub(crate) use format::Setting;
#[cfg(feature = "cli")]
pub(crate) use format::number_in;
#[cfg(feature = "schema")]
pub use format::schema;
pub(crate) use heal::size;
pub use heal::{Healed, ToleranceSource};
pub use joint_set::{JointBody, JointSet};
pub use note::{Note, NoteCode};
pub(in crate::mechanics) use problem::digits;
pub(crate) use problem::isolate;
pub use problem::{Code, Place, Problem, SceneError};
pub use reading::{falling_starter, starter};
pub use resolution::SketchedBody;
pub use sketch::{Sketch, Spot};
pub use unit::Unit;

use crate::geometry::quarter_turn;
#[doc(inline)]
pub use crate::geometry::{
    Bounds, Cell, CellShape, Lattice, LatticeKind, Point, Polygon, PolygonError, Tolerance, Vector,
};

/// A checked structure, ready for analysis. It cannot be changed. [`Scene::builder`] and [`Scene::from_json`] make
/// scenes.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Title, empty if the file gives none.
    pub(crate) title: String,
    /// Author of the calculation, empty if the file gives none.
    pub(crate) author: String,
    /// Project that the structure belongs to, empty if the file gives none.
    pub(crate) project: String,
    /// Date of the calculation as written in the file, empty if the file gives none.
    pub(crate) date: String,
    /// The units of the file, in which results are written for people. The scene itself is in metres and newtons.
    pub(crate) units: format::UnitsEntry,
    /// Gravity in m/s². Weights act along it; only its direction matters for blocks with a given weight.
    pub(crate) gravity: Vector,
    /// Thickness of the structure perpendicular to the plane, metres.
    pub(crate) thickness: f64,
    /// The safety kernel, 0 to 1: each application point is moved inward by half this fraction of the contact's length.
    pub(crate) kernel: f64,
    /// The lattice of the scene, if it has one.
    pub(crate) lattice: Option<Lattice>,
    /// Whether every body is a set of lattice cells, so that contacts are decided in whole numbers.
    pub(crate) exact: bool,
    /// The lengths below which differences count as rounding; all 0 on a lattice.
    pub(crate) tolerance: Tolerance,
    /// Where the tolerance comes from, how many corners healing moved before the analysis, and how far.
    pub(crate) healed: Healed,
    /// The largest distance by which rounded coordinates may separate a corner from the edge it touches, metres; 0 if
    /// no rounding was found, or if the contact tolerance is given.
    pub(crate) misfit: f64,
    /// Pairs of bodies with an overlap so small that they may have been meant to touch. Empty if the scene gives a
    /// tolerance.
    pub(crate) penetrations: Vec<Penetration>,
    /// The parts of the ground.
    pub(crate) ground: Vec<Ground>,
    /// The blocks, in the file's order.
    pub(crate) blocks: Vec<Block>,
    /// The robots, in the file's order.
    pub(crate) robots: Vec<Robot>,
    /// Loads on blocks.
    pub(crate) loads: Vec<Load>,
    /// The id that the file gives each load in its list.
    pub(crate) load_ids: Vec<Option<String>>,
    /// The load cases; empty if all loads act as listed.
    pub(crate) cases: Vec<Case>,
    /// Small movements of parts of the ground.
    pub(crate) movements: Vec<Movement>,
    /// A vehicle that travels over the structure.
    pub(crate) vehicle: Option<Vehicle>,
    /// Materials, in the file's order.
    pub(crate) materials: Vec<Material>,
    /// Friction coefficients between pairs of materials, given by their numbers in [`Scene::materials`], the smaller
    /// first, in the order of these numbers.
    pub(crate) friction_pairs: Vec<([usize; 2], f64)>,
    /// Sets of joints, in the file's order. A joint belongs to the first one that it meets.
    pub(crate) joint_sets: Vec<JointSet>,
    /// The contacts that the file lists. If the list is not empty, contacts are not computed from the outlines.
    pub(crate) contacts: Vec<ListedContact>,
    /// Which corners that touch carry force. All if the file lists its contacts.
    pub(crate) corner_contacts: CornerContacts,
    /// The frames, one for each step; at least one.
    pub(crate) frames: Vec<Frame>,
    /// Notes on input that is allowed but probably not intended, in the order in which they were found.
    pub(crate) notes: Vec<Note>,
    /// The codes of the notes that the author switched off.
    pub(crate) silenced: Vec<NoteCode>,
    /// The line of the file in which each body begins.
    pub(crate) lines: note::Lines,
    /// The values of the file that were replaced before it was read, such as `friction=0.5`.
    pub(crate) set: Vec<String>,
}

impl Scene {
    /// Returns the scene with only one of its frames. `number` is counted from 0. `None` if there is no such frame.
    pub(crate) fn alone(&self, number: usize) -> Option<Scene> {
        let frames = vec![self.frames.get(number)?.clone()];
        Some(Scene { frames, ..self.clone() })
    }

    /// True if a verdict must hold in several conditions: load cases, or positions of a vehicle.
    pub(crate) fn has_conditions(&self) -> bool {
        !self.cases.is_empty() || self.vehicle.is_some()
    }

    /// Returns the title of the scene; empty if the file gives no title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Returns the author of the calculation; empty if the file gives no author.
    pub fn author(&self) -> &str {
        &self.author
    }

    /// Returns the project that the structure belongs to; empty if the file gives no project.
    pub fn project(&self) -> &str {
        &self.project
    }

    /// Returns the date of the calculation as written in the file; empty if the file gives no date.
    pub fn date(&self) -> &str {
        &self.date
    }

    /// Returns the units of the scene file. Figures, tables and reports use these units. All numbers of the scene
    /// itself are in metres and newtons.
    pub fn units(&self) -> format::UnitsEntry {
        self.units
    }

    /// Returns the acceleration of gravity in m/s². Weights act in its direction. For blocks with a given weight, only
    /// the direction has an effect.
    pub fn gravity(&self) -> Vector {
        self.gravity
    }

    /// Returns the thickness of the structure perpendicular to the plane, in metres.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Returns the safety kernel, from 0 to 1. Each point at which a contact transmits force is moved inward by half
    /// this fraction of the contact's length.
    pub fn kernel(&self) -> f64 {
        self.kernel
    }

    /// Returns the lattice of the scene; `None` if the scene has no lattice.
    pub fn lattice(&self) -> Option<Lattice> {
        self.lattice
    }

    /// True if every body is a set of lattice cells. Contacts are then computed exactly, in whole numbers.
    pub fn exact(&self) -> bool {
        self.exact
    }

    /// Returns the contact tolerance: the lengths and the angle up to which differences between two bodies count as
    /// rounding. All are 0 if every body is a set of lattice cells.
    pub fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    /// Returns the result of healing: where the contact tolerance comes from, how many corners moved before the
    /// analysis, and how far.
    pub fn healed(&self) -> &Healed {
        &self.healed
    }

    /// Returns the pairs of bodies that overlap so little that they may have been meant to touch. The list is empty if
    /// the scene gives a contact tolerance.
    pub fn penetrations(&self) -> &[Penetration] {
        &self.penetrations
    }

    /// Returns the parts of the ground.
    pub fn ground(&self) -> &[Ground] {
        &self.ground
    }

    /// Returns the blocks, in the file's order.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Returns the robots, in the file's order.
    pub fn robots(&self) -> &[Robot] {
        &self.robots
    }

    /// Returns the loads on blocks, which act in addition to the weights.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// Returns the load cases; empty if all loads act as listed.
    pub fn cases(&self) -> &[Case] {
        &self.cases
    }

    /// Returns the small movements of parts of the ground.
    pub fn movements(&self) -> &[Movement] {
        &self.movements
    }

    /// Returns the vehicle that travels over the structure, if there is one.
    pub fn vehicle(&self) -> Option<&Vehicle> {
        self.vehicle.as_ref()
    }

    /// Returns the materials, in the file's order.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Returns the friction coefficients that the scene gives for pairs of materials. The materials are given by their
    /// indices in [`Scene::materials`], in the order of these indices.
    pub fn friction_pairs(&self) -> &[([usize; 2], f64)] {
        &self.friction_pairs
    }

    /// Returns the contacts that the scene lists. If the list is not empty, contacts are not computed from the
    /// outlines.
    pub fn contacts(&self) -> &[ListedContact] {
        &self.contacts
    }

    /// True if the scene lists its contacts. Contacts are then not computed from the outlines.
    pub(crate) fn lists_contacts(&self) -> bool {
        !self.contacts.is_empty()
    }

    /// Returns which corners that touch another body carry force: all if the scene lists its contacts.
    pub fn corner_contacts(&self) -> CornerContacts {
        self.corner_contacts
    }

    /// Returns the frames, which are the states of the structure to be analysed: one for each step, or one for a scene
    /// without steps.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Returns the notes on input that is allowed but probably not intended, in the order in which they were found.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Returns the body with this id.
    pub fn body(&self, id: BodyId) -> &Body {
        match id {
            BodyId::Ground(i) => &self.ground[i].body,
            BodyId::Block(id) => &self.blocks[id.0].body,
        }
    }

    /// Returns the name of a body in results: the id of a block or of a part of the ground, or `"ground"` for a
    /// part without an id.
    pub fn name(&self, id: BodyId) -> &str {
        match id {
            BodyId::Ground(i) => self.ground.get(i).and_then(|part| part.id.as_deref()).unwrap_or("ground"),
            BodyId::Block(id) => &self.blocks[id.0].id,
        }
    }

    /// Returns the set of joints to which the joint of two bodies with this normal belongs, if the scene has such a set.
    pub fn joint_set(&self, bodies: [BodyId; 2], normal: Vector) -> Option<&JointSet> {
        self.joint_sets.iter().find(|set| set.contains(self, bodies, normal))
    }

    /// True if the margin `friction_factor` multiplies the coefficient of this joint: all joints, or those of the sets that
    /// the scene names for it.
    pub(crate) fn has_factored_friction(&self, bodies: [BodyId; 2], normal: Vector) -> bool {
        self.factored_sets().next().is_none() || self.joint_set(bodies, normal).is_some_and(|set| set.is_factored)
    }

    /// Returns the names of the sets of joints whose friction the margin `friction_factor` multiplies; none if it multiplies
    /// that of all joints.
    pub(crate) fn factored_sets(&self) -> impl Iterator<Item = &str> {
        self.joint_sets.iter().filter(|set| set.is_factored).map(|set| set.id.as_str())
    }

    /// Returns the friction coefficient at the joint of two bodies with this normal: that of the set of joints to which it
    /// belongs, otherwise that of the pair of their materials, otherwise the smaller of the two bodies' own coefficients.
    pub fn friction_at(&self, bodies: [BodyId; 2], normal: Vector) -> f64 {
        if let Some(friction) = self.joint_set(bodies, normal).and_then(|set| set.friction) {
            return friction;
        }
        let [a, b] = bodies.map(|body| self.body(body));
        if let (Some(m), Some(n)) = (a.material, b.material) {
            let wanted = [m.min(n), m.max(n)];
            if let Ok(pair) = self.friction_pairs.binary_search_by_key(&wanted, |pair| pair.0) {
                return self.friction_pairs[pair].1;
            }
        }
        a.friction.min(b.friction)
    }

    /// Returns the box around some blocks, metres; `None` if there are none.
    pub(crate) fn bounds<'i>(&self, blocks: impl IntoIterator<Item = &'i BlockId>) -> Option<Bounds> {
        blocks.into_iter().map(|id| self.blocks[id.0].body.polygon.bounds()).reduce(Bounds::union)
    }

    /// Returns the direction of gravity as a unit vector; zero if there is no gravity.
    pub fn down(&self) -> Vector {
        let g = self.gravity.norm();
        if g > 0.0 { self.gravity / g } else { Vector::zeros() }
    }
}

/// A small movement of a part of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Movement {
    /// The index of the part of the ground, from 0.
    pub ground: usize,
    /// Translation in metres.
    pub translation: Vector,
    /// Rotation in radians, anticlockwise positive.
    pub rotation: f64,
    /// The point about which the part turns, metres.
    pub about: Point,
}

impl Movement {
    /// Returns the displacement of a point of the part, in metres, for a small rotation.
    pub fn at(&self, point: Point) -> Vector {
        self.translation + quarter_turn(point - self.about) * self.rotation
    }
}

/// A vehicle that travels over the structure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Vehicle {
    /// The axles, the first in front.
    pub axles: Vec<Axle>,
    /// The blocks that the vehicle travels over; empty for all blocks.
    pub over: Vec<BlockId>,
    /// The distance between the analysed positions, metres; 0 for the positions with an axle at an end of a block's top.
    pub step: f64,
    /// Whether the vehicle also travels to the left.
    pub both_ways: bool,
}

/// An axle of a vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Axle {
    /// The weight on the axle, N.
    pub weight: f64,
    /// The distance behind the first axle, metres.
    pub offset: f64,
}
