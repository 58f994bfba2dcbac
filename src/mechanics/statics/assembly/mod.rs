//! [`Assembly`]: one frame of a scene, resolved: what is balanced, by which forces, in metres and newtons.
//!
//! An assembly knows bodies with their load vectors, contacts with their application points, and grips with their limits,
//! and nothing of files, steps or materials. The effects of [`crate::effect`] put it together; [`Assembly::components`] parts it
//! into components that cannot influence each other; the `with_…` functions make the changed assemblies that margins are
//! found from, without touching the scene. Invariant: body, contact and grip numbers are indices into its own lists, every
//! contact's first body is in it, and each load vector is the sum that [`Assembly::with_summed_loads`] makes of the weight and the
//! listed loads.

mod component;
mod merge;
mod substructure;
mod variation;

pub(crate) use component::DisjointSets;
pub use substructure::Substructure;

use std::sync::Arc;

use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::interface::{ContactKind, Interface};
use crate::scene::{BlockId, BodyId, Frame, Limits, RobotId, Scene};

/// One frame of a scene, or a component of it, resolved.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// The free bodies, in the order of their blocks.
    pub bodies: Vec<AssemblyBody>,
    /// Where they touch each other or the ground, in the order of the frame's interfaces.
    pub contacts: Vec<AssemblyContact>,
    /// Where robots hold them, in the order of the frame's holds.
    pub grips: Vec<AssemblyGrip>,
    /// The pull of gravity in newtons per newton of weight: a unit vector along gravity unless changed.
    pub pull: Vector,
    /// The factor on the listed loads: 1 unless changed.
    pub load_factor: f64,
    /// L in metres, by which torques are weighed against forces: the median length of the frame's interfaces.
    pub length: f64,
}

/// Force and moment about the body's centroid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadVector {
    /// Force, N.
    pub force: Vector,
    /// Moment, N·m, anticlockwise positive.
    pub moment: f64,
}

impl LoadVector {
    /// No load.
    pub const NONE: LoadVector = LoadVector {
        force: Vector::new(0.0, 0.0),
        moment: 0.0,
    };

    /// The sum of two load vectors about one centroid.
    pub fn and(self, other: LoadVector) -> LoadVector {
        LoadVector {
            force: self.force + other.force,
            moment: self.moment + other.moment,
        }
    }

    /// The load vector times a factor.
    pub fn times(self, factor: f64) -> LoadVector {
        LoadVector {
            force: self.force * factor,
            moment: self.moment * factor,
        }
    }

    /// Its size in newtons, a moment divided by `length` (m).
    pub fn size(&self, length: f64) -> f64 {
        self.force.norm().max(self.moment.abs() / length)
    }
}

/// A free rigid body.
#[derive(Clone, Debug)]
pub struct AssemblyBody {
    /// The block of the scene.
    pub block: BlockId,
    /// Centroid, metres; moments of the body are taken about it.
    pub centroid: Point,
    /// Corners of the outline, metres.
    pub corners: Arc<[Point]>,
    /// Weight, N; 0 where no gravity acts on it.
    pub weight: f64,
    /// The sum of the loads that the scene lists for it, as listed.
    pub listed: LoadVector,
    /// All that acts on it beside contacts and robots: pull · weight + factor · listed.
    pub load: LoadVector,
}

impl AssemblyBody {
    /// Distance of the farthest corner from the centroid, metres.
    pub fn radius(&self) -> f64 {
        let reach = self.corners.iter().map(|p| (p - self.centroid).norm());
        reach.fold(0.0, f64::max)
    }
}

/// A contact between two bodies, or between a body and the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssemblyContact {
    /// Its number among the frame's interfaces.
    pub interface: usize,
    /// The two bodies of the scene, `on` first.
    pub bodies: [BodyId; 2],
    /// The body whose forces are counted positive.
    pub on: usize,
    /// Its partner, `None` for the ground.
    pub from: Option<usize>,
    /// Edge or corner.
    pub kind: ContactKind,
    /// Ends of the stretch, metres, from the first to the second along (−n_y, n_x).
    pub ends: [Point; 2],
    /// The application points, metres: the ends moved inward by the kernel.
    pub points: [Point; 2],
    /// Unit normal into `on`.
    pub normal: Vector,
    /// Friction coefficient; 0 where friction is not simulated.
    pub friction: f64,
}

impl AssemblyContact {
    /// The unit tangent (−n_y, n_x) along which friction is counted positive.
    pub fn tangent(&self) -> Vector {
        quarter_turn(self.normal)
    }

    /// How many application points carry force: 2, or 1 of a corner.
    pub fn points_in_use(&self) -> usize {
        match self.kind {
            ContactKind::Edge => 2,
            ContactKind::Corner => 1,
        }
    }
}

/// A robot's hold on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AssemblyGrip {
    /// Its number among the frame's holds.
    pub hold: usize,
    /// The robot.
    pub robot: RobotId,
    /// The held body.
    pub body: usize,
    /// The grip point, metres.
    pub at: Point,
    /// Largest amounts it can give; 0 of a component that is not simulated.
    pub limits: Limits,
}

impl Assembly {
    /// The placed bodies of a frame with nothing that acts on them: what effects contribute to.
    pub fn without_effects(scene: &Scene, frame: &Frame, interfaces: &[&Interface]) -> Assembly {
        let mut placed = frame.placed.clone();
        placed.sort();
        let bodies = placed.into_iter().map(|block| {
            let given = &scene.blocks[block.0];
            AssemblyBody {
                block,
                centroid: given.centroid,
                corners: given.body.polygon.outline().into(),
                weight: 0.0,
                listed: LoadVector::NONE,
                load: LoadVector::NONE,
            }
        });
        Assembly {
            bodies: bodies.collect(),
            contacts: Vec::new(),
            grips: Vec::new(),
            pull: Vector::zeros(),
            load_factor: 1.0,
            length: length(scene, frame, interfaces),
        }
    }

    /// The number of each placed block among the bodies, by the block's number in the scene.
    pub fn numbers(&self, blocks: usize) -> Vec<Option<usize>> {
        let mut numbers = vec![None; blocks];
        for (number, body) in self.bodies.iter().enumerate() {
            numbers[body.block.0] = Some(number);
        }
        numbers
    }

    /// The assembly with every load vector summed anew from weight, pull and listed loads.
    pub fn with_summed_loads(mut self) -> Assembly {
        for body in &mut self.bodies {
            let weight = LoadVector {
                force: self.pull * body.weight,
                moment: 0.0,
            };
            body.load = weight.and(body.listed.times(self.load_factor));
        }
        self
    }

    /// The heaviest load: the largest force, moment over L, or weight as gravity pulls it, N.
    pub fn heaviest(&self) -> f64 {
        let pull = self.pull.norm();
        self.bodies
            .iter()
            .map(|body| body.load.size(self.length).max(body.weight * pull))
            .fold(0.0, f64::max)
    }
}

/// The load vector of a force with its point and a torque, about a centroid.
pub fn about(centroid: Point, at: Point, force: Vector, torque: f64) -> LoadVector {
    LoadVector {
        force,
        moment: cross(at - centroid, force) + torque,
    }
}

/// L: the median length of the frame's edge interfaces, or the median placed block's square root of area where none
/// touches; metres. It depends on nothing that is placed later.
fn length(scene: &Scene, frame: &Frame, interfaces: &[&Interface]) -> f64 {
    let edges = interfaces.iter().filter(|i| i.kind == ContactKind::Edge);
    let area = |b: &BlockId| scene.blocks[b.0].body.polygon.area();
    median(edges.map(|i| i.length()).collect())
        .or_else(|| median(frame.placed.iter().map(|b| area(b).sqrt()).collect()))
        .unwrap_or(1.0)
}

/// The lower median of a list, `None` of an empty one.
fn median(mut list: Vec<f64>) -> Option<f64> {
    list.sort_by(f64::total_cmp);
    list.get(list.len().saturating_sub(1) / 2).copied()
}
