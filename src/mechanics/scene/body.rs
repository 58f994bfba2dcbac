//! The parts of a scene: blocks, parts of the ground, robots, loads, listed contacts and materials.

use super::format::Expectation;
use crate::geometry::{Cell, Circle, Point, Polygon, Vector};

/// The index of a block in the list of blocks of the scene, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BlockId(pub usize);

/// The index of a robot in the list of robots of the scene, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RobotId(pub usize);

/// A block, or a part of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BodyId {
    /// The part of the ground with this index, counted from 0.
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
    /// Outline and holes in the coordinates of the scene, metres. For a circle, a fine polygon with the same area.
    pub polygon: Polygon,
    /// The circle, if the body is round: its weight, contacts and overlaps come from the circle, not from the polygon.
    pub circle: Option<Circle>,
    /// The lattice cells, if the body consists of cells.
    pub cells: Option<Vec<Cell>>,
    /// The index of its material in the list of materials of the scene; `None` if it has no material.
    pub material: Option<usize>,
    /// Friction coefficient: the body's own, or else its material's, or else the scene's.
    pub friction: f64,
    /// The fill colour that the file gives for the body or for its material.
    pub fill: Option<Rgb>,
    /// The largest distance at which this body counts as touching another body, metres. For a pair of bodies, the
    /// smaller of their gaps applies. The gap is 0 if contacts are computed exactly, on a lattice.
    pub gap: f64,
    /// The largest error that is assumed for its coordinates, metres; 0 if contacts are computed exactly, on a lattice.
    pub rounding: f64,
    /// Whether the file gives no outline. The outline is then only a symbol for figures: for a block, the convex hull
    /// of its contacts and of a small disc around its centre.
    pub is_schematic: bool,
}

impl Body {
    /// Returns the area in square metres.
    pub fn area(&self) -> f64 {
        self.circle.map_or_else(|| self.polygon.area(), Circle::area)
    }

    /// Returns the centroid of the area.
    pub fn centroid(&self) -> Point {
        self.circle.map_or_else(|| self.polygon.centroid(), |circle| circle.centre)
    }

    /// Returns the distance of a point from the body in metres; at most 0 for a point inside.
    pub(crate) fn distance(&self, point: Point) -> f64 {
        self.circle.map_or_else(|| self.polygon.distance(point), |circle| circle.distance(point))
    }
}

/// A part of the ground. It supports any load and never moves.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Ground {
    /// The id given in the file, if any.
    pub id: Option<String>,
    /// Its shape, position and surface.
    pub body: Body,
}

/// A rigid block.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Block {
    /// The id given in the file. If the file gives none, the id is the position of the block in the list, from 1.
    pub id: String,
    /// Its shape, position and surface.
    pub body: Body,
    /// The point at which the weight acts, metres: the centroid of the body, or the centre that the file gives.
    pub centroid: Point,
    /// Whether the file gives the centre of mass, so that it need not be the centroid of the polygon.
    pub(crate) has_own_centre: bool,
    /// Weight in newtons, along gravity, at least 0.
    pub weight: f64,
    /// By how much the errors of this block are multiplied when the placement tolerance is computed, at least 0.
    pub placement: f64,
    /// Whether the weight is computed from area, thickness and density, because the file gives neither weight nor mass.
    pub(crate) weighs_by_area: bool,
    /// The mass in kg that the file gives; `None` if the weight is given or computed.
    pub mass: Option<f64>,
}

/// The largest absolute values of the force components and of the torque that a robot can exert. A value is infinite
/// if there is no limit.
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
        Limits { fx: f64::INFINITY, fy: f64::INFINITY, torque: 0.0 }
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
    /// Whether the grip point is the centroid because the file gives no point.
    pub(crate) at_centroid: bool,
}

impl Grip {
    /// Creates the grip at a point of a block; at its centroid if no point is given.
    pub(crate) fn new(block: BlockId, given: Option<Point>, centroid: Point) -> Grip {
        Grip { block, at: given.unwrap_or(centroid), at_centroid: given.is_none() }
    }

    /// Returns this grip as the hold of a robot.
    pub(crate) fn by(self, robot: RobotId) -> Hold {
        Hold { robot, block: self.block, at: self.at, at_centroid: self.at_centroid }
    }
}

/// A robot that can hold a block.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Robot {
    /// The id given in the file. If the file gives none, the id is `r` and the index of the robot, from 0.
    pub id: String,
    /// Its largest force and torque.
    pub limits: Limits,
    /// The block that it holds in a scene without steps, and the grip point. In a scene with steps, the grip point
    /// applies when a step lets the robot hold this block and gives no other point.
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
    /// Whether the load keeps its amount when the load factor changes.
    pub is_fixed: bool,
    /// A unit vector if only the part of the force along it is fixed: the load factor multiplies the rest of the force, and
    /// the torque. `None` if all of the load is fixed, or nothing of it.
    pub fixed_along: Option<Vector>,
    /// The index of the load in the list of the file. The pressure of one entry acts on several edges, as one load on
    /// each.
    pub entry: usize,
    /// Where the load is spread, if it is a pressure.
    pub spread: Option<Spread>,
    /// Whether the force acts at the centroid because the file gives no point.
    pub(crate) at_centroid: bool,
}

impl Load {
    /// Returns the part of the force that the load factor does not multiply, N.
    pub fn fixed_force(&self) -> Vector {
        match self.fixed_along {
            Some(along) => along * along.dot(&self.force),
            None => self.force * if self.is_fixed { 1.0 } else { 0.0 },
        }
    }

    /// Multiplies all parts of the load that are not fixed by a factor.
    pub fn times_factor(mut self, factor: f64) -> Load {
        if !self.is_fixed {
            let fixed = self.fixed_force();
            self.force = fixed + (self.force - fixed) * factor;
            self.torque *= factor;
        }
        self
    }

    /// Returns the fixed part of the load, and the part that the load factor multiplies. `None` for a part that the load does
    /// not have.
    pub(crate) fn parts(&self) -> [Option<Load>; 2] {
        if self.fixed_along.is_none() {
            return if self.is_fixed { [Some(*self), None] } else { [None, Some(*self)] };
        }
        let force = self.fixed_force();
        let fixed = Load { force, torque: 0.0, is_fixed: true, fixed_along: None, ..*self };
        [Some(fixed), Some(Load { force: self.force - force, fixed_along: None, ..*self })]
    }
}

/// A load that is spread along an edge of a block and varies linearly between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Spread {
    /// The ends, metres.
    pub ends: [Point; 2],
    /// The force per length of the edge at each end, N/m.
    pub force: [Vector; 2],
}

/// A load case: a factor on the weights, and the factors on the loads that act in it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Case {
    /// The id given in the file.
    pub id: String,
    /// Factor on the weights of all blocks.
    pub weights: f64,
    /// Factor on each load, by the index of the load in the list of the file; 0 for a load that does not act.
    pub loads: Vec<f64>,
}

/// A contact that the file lists: a point at which two bodies touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ListedContact {
    /// The two bodies. The first is always a block. If both are blocks, the first is the later block in the file.
    pub bodies: [BodyId; 2],
    /// The point, metres.
    pub at: Point,
    /// Unit normal of the contact, which points into `bodies[0]`.
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

/// A robot that holds a block in a frame, and the grip point.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hold {
    /// The robot.
    pub robot: RobotId,
    /// The block held.
    pub block: BlockId,
    /// The grip point, metres.
    pub at: Point,
    /// Whether the grip point is the centroid because the file gives no point.
    pub(crate) at_centroid: bool,
}

/// A block that a robot is about to place. It is drawn as an outline and carries no force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Plan {
    /// The robot.
    pub robot: RobotId,
    /// The block, not yet placed.
    pub block: BlockId,
}

/// The state of the structure after one step.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Frame {
    /// The step's title; empty if it has none.
    pub title: String,
    /// The placed blocks, in the order of placing. The k-th block is drawn in colour k of the sequence.
    pub placed: Vec<BlockId>,
    /// The blocks that robots hold, in the order of the robots' numbers.
    pub holds: Vec<Hold>,
    /// The planned blocks, in the order of the robots' numbers.
    pub plans: Vec<Plan>,
    /// The verdict that the author of the scene expects for this frame; `None` if the file gives none.
    pub expected: Option<Expectation>,
}

impl Frame {
    /// Returns a function that says whether a body is present: a placed block, or a part of the ground.
    pub(in crate::mechanics) fn presence(&self) -> impl Fn(&BodyId) -> bool {
        let mut placed = vec![false; self.placed.iter().map(|block| block.0 + 1).max().unwrap_or(0)];
        self.placed.iter().for_each(|block| placed[block.0] = true);
        move |body| match body {
            BodyId::Ground(_) => true,
            BodyId::Block(block) => placed.get(block.0).copied().unwrap_or(false),
        }
    }
}
