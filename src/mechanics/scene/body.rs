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

/// A colour, 8 bits a channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

/// What a block and the ground have in common, in its place in the world.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Body {
    /// Outline and holes in metres.
    pub polygon: Polygon,
    /// The lattice cells, where the body is made of them.
    pub cells: Option<Vec<Cell>>,
    /// Number of its material.
    pub material: Option<usize>,
    /// Its own friction coefficient (the body's, else its material's, else the scene's).
    pub friction: f64,
    /// The author's fill, of the body or of its material.
    pub fill: Option<Rgb>,
    /// Another body within this touches it, metres; a small stone has a smaller one than the scene. 0 on a lattice.
    pub gap: f64,
    /// Its coordinates are off by no more than this, metres. 0 on a lattice.
    pub rounding: f64,
}

/// A part of the ground: carries anything, never moves.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Ground {
    /// Its body.
    pub body: Body,
}

/// A rigid block.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Block {
    /// The name given in the file.
    pub id: String,
    /// Its body.
    pub body: Body,
    /// Centroid of the polygon, where the weight acts; metres.
    pub centroid: Point,
    /// Weight in newtons, along gravity, at least 0.
    pub weight: f64,
}

/// Largest amounts a robot can give, per component, each way. Infinite: no limit.
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

/// Where a robot grips a block.
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
    /// The name given in the file.
    pub id: String,
    /// What it can give.
    pub limits: Limits,
    /// What it holds in a scene without steps.
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
}

/// A material by name.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Material {
    /// Its name in the file.
    pub name: String,
}
