//! [`Interface`]: a stretch of edge that two bodies share, found for every pair of bodies of a scene.
//!
//! Makes [`Interfaces`], everything that touches in a scene, once for all its frames. Invariant: the first body of an
//! interface is a block, the normal points into it, and no contact is dropped in silence: what is too short or too far
//! apart to count is reported in [`Interfaces::notices`].

mod corner;
mod edge;
mod pinned;
mod lattice;
#[cfg(test)]
mod tests;

pub(crate) use lattice::LatticeEdges;
pub(crate) use pinned::{ContactsByBody, pinning_stone};

use crate::geometry::{Point, Vector, quarter_turn};
use crate::scene::{BlockId, BodyId, Frame, Scene};

/// What kind of contact an interface is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ContactKind {
    /// Two edges share a stretch.
    Edge,
    /// A tip touches an edge or another tip: one point that carries force.
    Corner,
}

/// A stretch of edge shared by two bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// The two bodies; the first is always a block, the later one in the file.
    pub bodies: [BodyId; 2],
    /// Edge or corner.
    pub kind: ContactKind,
    /// Ends of the stretch, from the first to the second along (−n_y, n_x); equal for a corner.
    pub ends: [Point; 2],
    /// Unit normal into `bodies[0]`.
    pub normal: Vector,
    /// Friction coefficient.
    pub friction: f64,
}

impl Interface {
    /// The tangent (−n_y, n_x) along which friction is counted positive.
    pub fn tangent(&self) -> Vector {
        quarter_turn(self.normal)
    }

    /// Length of the stretch in metres, 0 for a corner.
    pub fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    /// The middle of the stretch.
    pub fn middle(&self) -> Point {
        nalgebra::center(&self.ends[0], &self.ends[1])
    }

    /// The two points at which forces act: the ends, each moved inward by `kernel`/2 of the length
    /// ([Vallat23](crate::doc::references) §2.0.10).
    ///
    /// ```
    /// # use drystone::{internals::interface::*, scene::*};
    /// let seam = Interface {
    ///     bodies: [BodyId::Block(BlockId(0)), BodyId::Ground(0)],
    ///     kind: ContactKind::Edge,
    ///     ends: [Point::new(4.0, 1.0), Point::new(0.0, 1.0)],
    ///     normal: Vector::new(0.0, 1.0),
    ///     friction: 0.7,
    /// };
    /// assert_eq!(seam.application_points(0.5), [Point::new(3.0, 1.0), Point::new(1.0, 1.0)]);
    /// ```
    pub fn application_points(&self, kernel: f64) -> [Point; 2] {
        application_points(self.ends, kernel)
    }
}

/// The ends of a stretch, each moved inward by `kernel`/2 of its length.
pub fn application_points(ends: [Point; 2], kernel: f64) -> [Point; 2] {
    let inward = (ends[1] - ends[0]) * (kernel / 2.0);
    [ends[0] + inward, ends[1] - inward]
}

/// Two edges that face each other with less than a hundredth of the smaller block's size between them, and do not touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearMiss {
    /// The two bodies, as an interface would name them.
    pub bodies: [BodyId; 2],
    /// Around where.
    pub at: Point,
    /// The widest gap along the stretch, metres.
    pub distance: f64,
}

/// Where a stone keeps two bodies apart that would touch within the tolerance: it is as high as the gap is wide.
#[derive(Clone, Debug)]
pub(crate) struct PinnedGap {
    /// The two bodies and the gap.
    gap: NearMiss,
    /// The stone.
    stone: BlockId,
}

impl PinnedGap {
    /// Whether an interface lies in the gap.
    fn parts(&self, interface: &Interface) -> bool {
        let off = self.gap.at - interface.middle();
        interface.bodies == self.gap.bodies
            && off.dot(&interface.normal).abs() <= self.gap.distance
            && off.norm() <= interface.length()
    }
}

/// Everything that touches in a scene.
#[derive(Clone, Debug)]
pub struct Interfaces {
    /// In the order of the bodies' numbers, then of the place along them.
    pub all: Vec<Interface>,
    /// What nearly touches; a verdict may hinge on it.
    pub near_misses: Vec<NearMiss>,
    /// Stretches of long edges that are too short to count, and longer than rounding; a verdict may hinge on them.
    pub slivers: Vec<Interface>,
    /// Two bodies, a place where they touch within the tolerance and no nearer, and a stone that keeps them apart there.
    pub(crate) pinned_gaps: Vec<PinnedGap>,
    /// What was too short or too far apart to count, in words.
    pub notices: Vec<String>,
}

impl Interfaces {
    /// Finds what touches, in whole numbers where the scene is made of lattice cells, else within its tolerance.
    ///
    /// Edges make an interface where they are collinear, face each other and overlap. Corner contacts are looked for
    /// only where the scene asks for them.
    pub fn new(scene: &Scene) -> Interfaces {
        let mut found = match (&scene.lattice, scene.exact) {
            (Some(lattice), true) => Interfaces {
                all: lattice::find(scene, lattice),
                near_misses: Vec::new(),
                slivers: Vec::new(),
                pinned_gaps: Vec::new(),
                notices: Vec::new(),
            },
            _ => edge::find(scene),
        };
        if scene.corner_contacts {
            let corners = corner::find(scene, &found.all);
            found.all.extend(corners);
        }
        found.sort();
        found
    }

    fn sort(&mut self) {
        self.all.sort_by(|a, b| {
            let place = |i: &Interface| [i.ends[0].x, i.ends[0].y, i.ends[1].x, i.ends[1].y];
            a.bodies.cmp(&b.bodies).then_with(|| {
                place(a)
                    .partial_cmp(&place(b))
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
        });
    }

    /// The same with its slivers counted as interfaces.
    pub(crate) fn with_slivers(&self) -> Interfaces {
        let mut all = self.clone();
        all.all.append(&mut all.slivers);
        all.sort();
        all
    }

    /// The interfaces whose two bodies both stand in a frame, and are not kept apart by a stone in it.
    pub fn in_frame<'a>(&'a self, scene: &Scene, frame: &Frame) -> Vec<&'a Interface> {
        let mut placed = vec![false; scene.blocks.len()];
        for block in &frame.placed {
            placed[block.0] = true;
        }
        let stands = |body: BodyId| match body {
            BodyId::Ground(_) => true,
            BodyId::Block(id) => placed[id.0],
        };
        let is_open = |i: &Interface| {
            let mut pinned_gaps = self.pinned_gaps.iter();
            pinned_gaps.any(|p| stands(BodyId::Block(p.stone)) && p.parts(i))
        };
        self.all
            .iter()
            .filter(|i| stands(i.bodies[0]) && stands(i.bodies[1]))
            .filter(|i| !is_open(i))
            .collect()
    }
}

/// The bodies of a scene, the ground's parts first.
fn bodies(scene: &Scene) -> impl Iterator<Item = BodyId> + '_ {
    let ground = (0..scene.ground.len()).map(BodyId::Ground);
    ground.chain((0..scene.blocks.len()).map(|i| BodyId::Block(BlockId(i))))
}

/// The order in which an interface names two bodies: the later block first, ground last. `None` for two ground parts.
fn ordered(a: BodyId, b: BodyId) -> Option<[BodyId; 2]> {
    match (a, b) {
        (BodyId::Ground(_), BodyId::Ground(_)) => None,
        _ if a > b => Some([a, b]),
        _ => Some([b, a]),
    }
}
