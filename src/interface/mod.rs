//! [`Interface`]: a stretch of edge that two bodies share, found for every pair of bodies of a frame.

use crate::geometry::{Point, Vector};
use crate::scene::BodyId;

/// What kind of contact an interface is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
