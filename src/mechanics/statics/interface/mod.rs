//! [`Interface`]: a contact of two bodies along a common segment of their edges, or at a point. [`Interfaces`]: all
//! contacts of a scene, for all frames.
//!
//! Invariant: the first body of an interface is a block, and the normal points into this block. Edges that are slightly
//! too far apart for an interface, and common segments that are too short, are reported in [`Interfaces::notices`].

mod circle;
mod corner;
mod segment;
mod edge;
mod join;
mod pinned;
mod lattice;
#[cfg(test)]
mod tests;

pub(in crate::mechanics) use edge::MAX_GAP_PER_SIZE;
pub(in crate::mechanics) use join::JOIN_REACH;
pub(crate) use lattice::LatticeEdges;
pub(crate) use pinned::{ContactsByBody, pinning_stone};

use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::scene::{BlockId, BodyId, Frame, Scene};

/// What kind of contact an interface is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ContactKind {
    /// Two edges share a segment.
    Edge,
    /// A corner touches an edge or another corner, or a circle touches; the contact force acts at one point.
    Corner,
}

/// A contact of two bodies: a common segment of their edges, or a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// The two bodies. The first is always a block. If both are blocks, the first is the later block in the file.
    pub bodies: [BodyId; 2],
    /// Edge or corner.
    pub kind: ContactKind,
    /// Ends of the contact segment, metres. The tangent (−n_y, n_x) points from the first to the second. Equal for a
    /// corner.
    pub ends: [Point; 2],
    /// Unit normal of the contact, which points into `bodies[0]`.
    pub normal: Vector,
    /// Friction coefficient.
    pub friction: f64,
}

impl Interface {
    /// Returns the unit tangent (−n_y, n_x). Friction on the first body is positive in this direction.
    pub fn tangent(&self) -> Vector {
        quarter_turn(self.normal)
    }

    /// Returns the length of the contact segment in metres; 0 for a corner contact.
    pub fn length(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }

    /// Returns the middle of the contact segment.
    pub fn middle(&self) -> Point {
        nalgebra::center(&self.ends[0], &self.ends[1])
    }

    /// Returns the two points at which forces act. They are the ends, each moved inward by `kernel`/2 of the length
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

/// Returns the two ends of a contact segment, each moved inward by `kernel`/2 of the segment's length.
pub fn application_points(ends: [Point; 2], kernel: f64) -> [Point; 2] {
    let inward = (ends[1] - ends[0]) * (kernel / 2.0);
    [ends[0] + inward, ends[1] - inward]
}

/// Two edges that face each other without touching, with a gap of at most a hundredth of the smaller block's size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearMiss {
    /// The two bodies, in the order in which an interface would list them.
    pub bodies: [BodyId; 2],
    /// The middle of the segment along which the two edges face each other.
    pub at: Point,
    /// The widest gap along the segment, metres.
    pub distance: f64,
}

/// A gap within the tolerance that a stone of about the same height keeps open. While the stone is present, the two
/// bodies do not touch there.
#[derive(Clone, Debug)]
pub(crate) struct PinnedGap {
    /// The two bodies, the position and the width of the gap.
    gap: NearMiss,
    /// The stone that keeps the gap open.
    stone: BlockId,
}

impl PinnedGap {
    /// True if `interface` lies in this gap. Such an interface does not exist while the stone that keeps the gap open
    /// is present.
    fn contains(&self, interface: &Interface) -> bool {
        let offset = self.gap.at - interface.middle();
        interface.bodies == self.gap.bodies
            && offset.dot(&interface.normal).abs() <= self.gap.distance
            && offset.norm() <= interface.length()
    }
}

/// All contacts of a scene, and the edges that are nearly contacts.
#[derive(Clone, Debug)]
pub struct Interfaces {
    /// The contacts, in the order of the bodies' numbers and then of their ends.
    pub all: Vec<Interface>,
    /// Edges that nearly touch. The verdict may depend on whether they count as touching.
    pub near_misses: Vec<NearMiss>,
    /// Common segments that are too short for an interface, but longer than the rounding error of coordinates. The
    /// verdict may depend on whether they count as interfaces.
    pub slivers: Vec<Interface>,
    /// Gaps within the tolerance that stones keep open.
    pub(crate) pinned_gaps: Vec<PinnedGap>,
    /// Sentences for users about common segments that are too short, and edges that are too far apart, for an
    /// interface.
    pub notices: Vec<String>,
}

impl Interfaces {
    /// Returns the contacts that a scene lists. If it lists none, finds all contacts. The search is exact if all bodies
    /// consist of lattice cells; otherwise it uses the contact tolerance.
    ///
    /// Two edges form an interface if they are collinear, face each other and overlap. Corner contacts are searched
    /// only if the scene requests them.
    pub fn new(scene: &Scene) -> Interfaces {
        if !scene.contacts.is_empty() {
            return Interfaces::listed(scene);
        }
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
        circle::find(scene, &mut found);
        if scene.corner_contacts.on_edges() {
            let corners = corner::find(scene, &found.all);
            found.all.extend(corners);
        }
        found.sort();
        found
    }

    /// Returns the contacts that the scene lists. Each acts at one point, like a corner contact.
    fn listed(scene: &Scene) -> Interfaces {
        let contacts = scene.contacts.iter().map(|contact| Interface {
            bodies: contact.bodies,
            kind: ContactKind::Corner,
            ends: [contact.at; 2],
            normal: contact.normal,
            friction: contact.friction,
        });
        let mut found = Interfaces {
            all: contacts.collect(),
            near_misses: Vec::new(),
            slivers: Vec::new(),
            pinned_gaps: Vec::new(),
            notices: Vec::new(),
        };
        found.sort();
        found
    }

    /// Sorts the contacts by their bodies, then by the coordinates of their ends.
    fn sort(&mut self) {
        self.all.sort_by(|a, b| {
            let place = |i: &Interface| [i.ends[0].x, i.ends[0].y, i.ends[1].x, i.ends[1].y];
            a.bodies.cmp(&b.bodies).then_with(|| place(a).partial_cmp(&place(b)).unwrap_or(std::cmp::Ordering::Equal))
        });
    }

    /// Returns a copy in which the slivers (common segments that are too short) count as interfaces too.
    pub(crate) fn with_slivers(&self) -> Interfaces {
        let mut all = self.clone();
        all.all.append(&mut all.slivers);
        all.sort();
        all
    }

    /// Returns the interfaces of a frame: those whose bodies are both present and are not kept apart by a stone that is
    /// present.
    pub fn in_frame(&self, frame: &Frame) -> Vec<&Interface> {
        let is_present = frame.presence();
        let is_open = |i: &Interface| {
            let mut pinned_gaps = self.pinned_gaps.iter();
            pinned_gaps.any(|p| is_present(&BodyId::Block(p.stone)) && p.contains(i))
        };
        self.all.iter().filter(|i| i.bodies.iter().all(&is_present) && !is_open(i)).collect()
    }
}

/// Returns the bodies of a scene whose edges can touch: first the parts of the ground, then the blocks. Circles have no
/// edges. Bodies with a schematic outline are left out too, because they touch only at listed contacts.
fn bodies(scene: &Scene) -> impl Iterator<Item = BodyId> + '_ {
    let ground = (0..scene.ground.len()).map(BodyId::Ground);
    let bodies = ground.chain((0..scene.blocks.len()).map(|i| BodyId::Block(BlockId(i))));
    bodies.filter(|body| !scene.body(*body).is_schematic && scene.body(*body).circle.is_none())
}

/// Returns two bodies in the order in which an interface lists them: the later block first, the ground last.
///
/// `None` for two parts of the ground.
fn ordered(a: BodyId, b: BodyId) -> Option<[BodyId; 2]> {
    match (a, b) {
        (BodyId::Ground(_), BodyId::Ground(_)) => None,
        _ if a > b => Some([a, b]),
        _ => Some([b, a]),
    }
}

/// Returns the unit normal n that is exactly perpendicular to the segment between two ends. The tangent (−n_y, n_x)
/// points from the first end to the second.
///
/// Friction is one force per interface, which acts along the line through the two ends. If the normal is exactly
/// perpendicular to this line, the moment of the force is the same for every point of the line.
fn normal_across(ends: [Point; 2]) -> Vector {
    quarter_turn((ends[0] - ends[1]).normalize())
}
