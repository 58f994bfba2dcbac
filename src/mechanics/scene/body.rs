//! The parts of a scene: blocks, parts of the ground, robots and loads.

use crate::geometry::{Cell, Point, Polygon, Vector};

/// A block's number in the file, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BlockId(pub usize);

/// A robot's number in the file, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RobotId(pub usize);

/// A block, or a part of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BodyId {
    /// The ground's part with this number.
    Ground(usize),
    /// A block.
    Block(BlockId),
}

/// A colour: red, green and blue, each from 0 to 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

/// The shape, position and surface of a block or of a part of the ground.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Body {
    /// Outline and holes in the coordinates of the scene, metres.
    pub polygon: Polygon,
    /// The lattice cells, if the body consists of cells.
    pub cells: Option<Vec<Cell>>,
    /// The number of its material; `None` if it has none.
    pub material: Option<usize>,
    /// Friction coefficient: the body's own, or else its material's, or else the scene's.
    pub friction: f64,
    /// The fill colour that the file gives for the body or for its material.
    pub fill: Option<Rgb>,
    /// The largest distance at which another body touches it, metres. It is smaller for a small stone, and 0 on a
    /// lattice.
    pub gap: f64,
    /// The largest error of its coordinates, metres; 0 on a lattice.
    pub rounding: f64,
    /// Whether the file gives no outline. The outline is then the hull of the centre and the contacts, for figures.
    pub is_schematic: bool,
}

/// A part of the ground. It carries any load and never moves.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Ground {
    /// Its shape, position and surface.
    pub body: Body,
}

/// A rigid block.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Block {
    /// The id given in the file. Without one, it is the number of the block in the file, from 1.
    pub id: String,
    /// Its shape, position and surface.
    pub body: Body,
    /// Centroid of the polygon, or the given centre, where the weight acts; metres.
    pub centroid: Point,
    /// Weight in newtons, along gravity, at least 0.
    pub weight: f64,
    /// Whether the weight is computed from the area, because the file gives neither weight nor mass.
    pub(crate) weighs_by_area: bool,
}

/// The largest force components and torque of a robot, in either direction; infinite if there is no limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Horizontal force, N.
    pub fx: f64,
    /// Vertical force, N.
    pub fy: f64,
    /// Torque, N·m.
    pub torque: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits {
            fx: f64::INFINITY,
            fy: f64::INFINITY,
            torque: 0.0,
        }
    }
}

/// A block and the point at which a robot grips it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Grip {
    /// The block held.
    pub block: BlockId,
    /// The grip point, metres.
    pub at: Point,
}

/// A robot that can hold a block.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Robot {
    /// The id given in the file. Without one, it is `r` and the number of the robot in the file, from 0.
    pub id: String,
    /// Its largest force and torque.
    pub limits: Limits,
    /// The block that it holds in a scene without steps.
    pub holds: Option<Grip>,
}

/// A load on a block, in addition to its weight.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Load {
    /// The loaded block.
    pub block: BlockId,
    /// Force in newtons.
    pub force: Vector,
    /// Where the force acts, metres.
    pub at: Point,
    /// Torque in N·m, anticlockwise positive.
    pub torque: f64,
    /// Whether the force acts at the centroid because the file gives no point.
    pub(crate) at_centroid: bool,
}

/// A contact that the file lists: a point at which two bodies touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ListedContact {
    /// The two bodies. The first is always a block; of two blocks it is the later one in the file.
    pub bodies: [BodyId; 2],
    /// The point, metres.
    pub at: Point,
    /// Unit normal into `bodies[0]`.
    pub normal: Vector,
    /// Friction coefficient.
    pub friction: f64,
}

/// A material by name.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Material {
    /// Its name in the file.
    pub name: String,
}
