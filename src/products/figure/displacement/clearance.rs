//! [`Clearance`]: finds displaced blocks that overlap other bodies.

use super::rigid::Displacement;
use crate::geometry::{Bounds, ConvexPieces, Point, Polygon, overlap};
use crate::mechanics::scene::{BlockId, Frame, Scene};

/// Largest allowed overlap of two bodies, as a fraction of the area of the smaller body. An overlap of 1 % is already
/// visible.
const MAX_OVERLAP: f64 = 0.004;

/// The two bodies of a pair that overlaps; `None` is the ground.
pub(super) type Pair = [Option<BlockId>; 2];

/// The placed blocks and the ground of a frame, without blocks whose outlines are only schematic. Empty if the scene
/// lists its contacts.
pub(super) struct Clearance<'a> {
    bodies: Vec<(Option<BlockId>, &'a Polygon)>,
}

impl<'a> Clearance<'a> {
    pub fn new(scene: &'a Scene, frame: &Frame) -> Clearance<'a> {
        let blocks = frame.placed.iter();
        let blocks = blocks.map(|id| (Some(*id), &scene.blocks[id.0].body.polygon));
        let ground = scene.ground.iter().map(|g| (None, &g.body.polygon));
        // Ignore blocks with schematic outlines: these outlines may already overlap at rest.
        let is_drawn = |id: Option<BlockId>| id.is_none_or(|id| !scene.blocks[id.0].body.is_schematic);
        let is_listed = scene.lists_contacts();
        Clearance { bodies: blocks.chain(ground).filter(|body| !is_listed && is_drawn(body.0)).collect() }
    }

    /// Returns the pairs of bodies that overlap by more than [`MAX_OVERLAP`] after the displacement. `displaced` is
    /// indexed by block; blocks beyond the end of the list do not move.
    pub fn overlapping(&self, displaced: &[Option<Displacement>]) -> Vec<Pair> {
        let motion = |id: Option<BlockId>| displaced.get(id?.0)?.as_ref();
        let mut placed: Vec<(Option<BlockId>, Polygon, Bounds)> = Vec::new();
        for (id, polygon) in &self.bodies {
            let moved = motion(*id).map_or_else(|| (*polygon).clone(), |d| moved(polygon, d));
            let bounds = moved.bounds();
            placed.push((*id, moved, bounds));
        }
        placed.sort_by(|a, b| a.2.min.x.total_cmp(&b.2.min.x));
        let mut pairs = Vec::new();
        for (number, (a, one, bounds)) in placed.iter().enumerate() {
            let near = placed[number + 1..].iter();
            let near = near.take_while(|other| other.2.min.x <= bounds.max.x);
            for (b, other, others) in near {
                // Two bodies that move together, or that are both at rest, cannot begin to overlap.
                if motion(*a) != motion(*b) && bounds.intersects(*others) && overlap_share(one, other) > MAX_OVERLAP {
                    pairs.push([*a, *b]);
                }
            }
        }
        pairs
    }
}

/// Returns the common area of two polygons, divided by the area of the smaller polygon.
fn overlap_share(a: &Polygon, b: &Polygon) -> f64 {
    let common = overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), 0.0);
    common.map_or(0.0, |o| o.area / a.area().min(b.area()))
}

fn moved(polygon: &Polygon, displacement: &Displacement) -> Polygon {
    let ring = |ring: &Vec<Point>| ring.iter().map(|p| displacement.moved(*p)).collect();
    Polygon::from_valid_rings(polygon.rings().iter().map(ring).collect())
}
