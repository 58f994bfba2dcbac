//! [`Scene`]: a checked description of blocks, ground, robots and loads.
//!
//! Invariant: a `Scene` in hand is sound. Names are resolved, outlines are simple, numbers finite and in range, the
//! steps have been played into [`Frame`]s, and no block lies in another body in any frame.

mod body;
mod collision;
mod fault;
mod finding;
pub mod format;
mod frame;
mod heal;
mod name;
mod note;
mod number;
mod outline;
mod path;
mod play;
mod problem;
mod reading;
mod resolution;
mod rounding;
pub mod shape;
mod sketch;
mod source;
mod starter;
mod syntax;
mod tree;

pub use body::{
    Block, BlockId, Body, BodyId, Grip, Ground, Limits, Load, Material, Rgb, Robot, RobotId,
};
pub use collision::Penetration;
pub(crate) use fault::isolate;
#[cfg(feature = "schema")]
pub use format::schema;
pub use frame::{Frame, Hold, Plan};
pub(crate) use heal::size;
pub use heal::{Healed, ToleranceSource};
pub use note::{Note, NoteCode};
pub use problem::{Code, Place, Problem, SceneError};
pub use resolution::SketchedBody;
pub use sketch::{Sketch, Spot};
pub use starter::{falling_starter, starter};

#[doc(inline)]
pub use crate::geometry::{
    Bounds, Cell, CellShape, Lattice, LatticeKind, Point, Polygon, PolygonError, Tolerance, Vector,
};

/// A structure to be examined, checked. It cannot be changed: [`Scene::builder`] and the readers of files are the ways in.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Title, empty where the file gives none.
    pub(crate) title: String,
    /// Author of the calculation, empty where the file gives none.
    pub(crate) author: String,
    /// Project that the structure belongs to, empty where the file gives none.
    pub(crate) project: String,
    /// Date of the calculation as written in the file, empty where the file gives none.
    pub(crate) date: String,
    /// Gravity in m/s². Weights act along it; only its direction matters for blocks with a given weight.
    pub(crate) gravity: Vector,
    /// How thick the structure is, metres, across the plane.
    pub(crate) thickness: f64,
    /// The safety kernel in 0 … 1: application points move inward by half this share of the stretch, each.
    pub(crate) kernel: f64,
    /// The lattice, where the scene has one.
    pub(crate) lattice: Option<Lattice>,
    /// Whether every body is a set of lattice cells, so that contacts are decided in whole numbers.
    pub(crate) exact: bool,
    /// How close is close in this scene; exact on a lattice.
    pub(crate) tolerance: Tolerance,
    /// Where the tolerance comes from, and what was moved within it before anything was judged.
    pub(crate) healed: Healed,
    /// How far corners may lie off what they touch by the rounding of the coordinates as they are written, metres; 0 where
    /// they are written in full.
    pub(crate) misfit: f64,
    /// Bodies that lie in each other by so little that they may have been meant to touch; empty where the tolerance is given.
    pub(crate) penetrations: Vec<Penetration>,
    /// The ground's parts.
    pub(crate) ground: Vec<Ground>,
    /// The blocks, in the file's order.
    pub(crate) blocks: Vec<Block>,
    /// The robots, in the file's order.
    pub(crate) robots: Vec<Robot>,
    /// Loads on blocks.
    pub(crate) loads: Vec<Load>,
    /// Materials, in the file's order.
    pub(crate) materials: Vec<Material>,
    /// Friction coefficients of pairs of materials, by their numbers.
    pub(crate) friction_pairs: Vec<([usize; 2], f64)>,
    /// Whether tips that touch edges or tips carry force.
    pub(crate) corner_contacts: bool,
    /// The frames, at least one.
    pub(crate) frames: Vec<Frame>,
    /// What is allowed and seldom meant, in the order of looking.
    pub(crate) notes: Vec<Note>,
    /// Sorts of notes that the author does not want.
    pub(crate) silenced: Vec<NoteCode>,
    /// In which lines of the file the bodies stand.
    pub(crate) lines: note::Lines,
}

impl Scene {
    /// Title, empty where the file gives none.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Author of the calculation, empty where the file gives none.
    pub fn author(&self) -> &str {
        &self.author
    }

    /// Project that the structure belongs to, empty where the file gives none.
    pub fn project(&self) -> &str {
        &self.project
    }

    /// Date of the calculation as written in the file, empty where the file gives none.
    pub fn date(&self) -> &str {
        &self.date
    }

    /// Gravity in m/s². Weights act along it; only its direction matters for blocks with a given weight.
    pub fn gravity(&self) -> Vector {
        self.gravity
    }

    /// How thick the structure is, metres, across the plane.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// The safety kernel in 0 … 1: application points move inward by half this share of the stretch, each.
    pub fn kernel(&self) -> f64 {
        self.kernel
    }

    /// The lattice, where the scene has one.
    pub fn lattice(&self) -> Option<Lattice> {
        self.lattice
    }

    /// Whether every body is a set of lattice cells, so that contacts are decided in whole numbers.
    pub fn exact(&self) -> bool {
        self.exact
    }

    /// How close is close in this scene; exact on a lattice.
    pub fn tolerance(&self) -> Tolerance {
        self.tolerance
    }

    /// Where the tolerance comes from, and what was moved within it before anything was judged.
    pub fn healed(&self) -> &Healed {
        &self.healed
    }

    /// Bodies that lie in each other by so little that they may have been meant to touch; empty where the tolerance is given.
    pub fn penetrations(&self) -> &[Penetration] {
        &self.penetrations
    }

    /// The ground's parts.
    pub fn ground(&self) -> &[Ground] {
        &self.ground
    }

    /// The blocks, in the file's order.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// The robots, in the file's order.
    pub fn robots(&self) -> &[Robot] {
        &self.robots
    }

    /// Loads on blocks.
    pub fn loads(&self) -> &[Load] {
        &self.loads
    }

    /// Materials, in the file's order.
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Friction coefficients of pairs of materials, by their numbers.
    pub fn friction_pairs(&self) -> &[([usize; 2], f64)] {
        &self.friction_pairs
    }

    /// Whether tips that touch edges or tips carry force.
    pub fn corner_contacts(&self) -> bool {
        self.corner_contacts
    }

    /// The frames, at least one.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// What is allowed and seldom meant, in the order of looking.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// The body behind an id.
    pub fn body(&self, id: BodyId) -> &Body {
        match id {
            BodyId::Ground(i) => &self.ground[i].body,
            BodyId::Block(id) => &self.blocks[id.0].body,
        }
    }

    /// How results name a body: the block's id, `"ground"` for every part of the ground.
    pub fn name(&self, id: BodyId) -> &str {
        match id {
            BodyId::Ground(_) => "ground",
            BodyId::Block(id) => &self.blocks[id.0].id,
        }
    }

    /// Friction coefficient between two bodies: their materials' pair, else the smaller of their own.
    pub fn friction_between(&self, a: BodyId, b: BodyId) -> f64 {
        let (a, b) = (self.body(a), self.body(b));
        if let (Some(m), Some(n)) = (a.material, b.material) {
            let wanted = [m.min(n), m.max(n)];
            if let Some(pair) = self.friction_pairs.iter().find(|p| p.0 == wanted) {
                return pair.1;
            }
        }
        a.friction.min(b.friction)
    }

    /// The direction of gravity as a unit vector, zero where there is no gravity.
    pub fn down(&self) -> Vector {
        let g = self.gravity.norm();
        if g > 0.0 {
            self.gravity / g
        } else {
            Vector::zeros()
        }
    }
}
