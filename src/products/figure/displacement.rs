//! [`Course`]: the paths of blocks in a collapse mechanism. The blocks move as rigid bodies by visible distances and
//! keep their shapes.
//!
//! A mechanism determines only velocities, so the figure has to choose an amplitude. For each group of blocks in
//! contact:
//!
//! 1. The displacement of the fastest point is the larger of [`MIN_DISPLACEMENT`] and [`MIN_DISPLACEMENT_SHARE`], so
//!    that open hinges are visible.
//! 2. No block turns by more than [`MAX_ROTATION`], because the velocities are only valid for small rotations.
//! 3. [`linkage`] keeps hinges closed and sliding blocks on their joints along the whole path, if this is possible.
//! 4. The path is shortened until no block overlaps another body, whether they touched at the beginning or not.

mod linkage;

use super::fall::Fall;
use crate::geometry::{Bounds, ConvexPieces, Point, Polygon, Vector, overlap, quarter_turn};
use crate::mechanics::analysis::Motion;
use crate::mechanics::scene::{BlockId, Scene};
use linkage::Linkage;
use nalgebra::DVector;

/// Least displacement of the fastest point, unit lengths.
const MIN_DISPLACEMENT: f64 = 0.35;
/// Least displacement of the fastest point, as a fraction of the diagonal of the group. In an arch of many voussoirs,
/// a displacement of a unit length is too small to make an open hinge visible.
const MIN_DISPLACEMENT_SHARE: f64 = 0.045;
/// Largest rotation of a block, rad (20°).
const MAX_ROTATION: f64 = 0.35;
/// The largest displacement of a point in an animation, as a fraction of the diagonal of the group, and the largest
/// rotation of a block, rad (75°).
const FAR_SHARE: f64 = 0.6;
const FAR_ROTATION: f64 = 1.3;
/// Number of steps of the path in an animation.
const FAR_STEPS: usize = 60;
/// Number of positions along the path at which overlaps are measured.
const TESTED_POSITIONS: u32 = 8;
/// Largest number of reductions of the amplitude while blocks overlap, and the smallest factor of one reduction.
const MAX_REDUCTIONS: u32 = 24;
const MIN_REDUCTION_FACTOR: f64 = 0.6;
/// If more blocks than this move, overlaps are not measured, because this would take longer than the drawing.
const MAX_TESTED_BLOCKS: usize = 500;
/// Largest allowed overlap of two bodies, as a fraction of the area of the smaller body. An overlap of 1 % is already
/// visible.
const MAX_OVERLAP: f64 = 0.004;
/// The same for the ground, whose line is drawn on top of blocks: their corners may not show below it.
const MAX_GROUND_OVERLAP: f64 = 5e-4;

/// A rotation of a block about a point, followed by a translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Displacement {
    centre: Point,
    sin: f64,
    cos: f64,
    translation: Vector,
}

impl Displacement {
    /// Creates a rotation by an angle in radians about a point, followed by a translation in metres.
    pub fn new(centre: Point, angle: f64, translation: Vector) -> Displacement {
        Displacement { centre, sin: libm::sin(angle), cos: libm::cos(angle), translation }
    }

    /// Converts the velocity of a block to a displacement. If the block spins, the displacement is a rotation by
    /// `amplitude`·spin about the instantaneous centre; otherwise it is a translation by `amplitude`·velocity.
    ///
    /// Units: `amplitude` is the displacement in metres of a point of speed 1.
    pub fn along(motion: &Motion, centroid: Point, amplitude: f64) -> Displacement {
        let angle = amplitude * motion.spin;
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        // The rotation about the instantaneous centre equals a rotation about the centroid, followed by the translation
        // along the chord of the centroid's arc: amplitude·(sin θ/θ·v + (1 − cos θ)/θ·v⊥). Below 1e-6 rad, the first
        // terms of the Taylor series are used, with a relative error below 2e-13. They also hold for a pure
        // translation.
        let (along, aside) = if angle.abs() < 1e-6 { (1.0, 0.5 * angle) } else { (sin / angle, (1.0 - cos) / angle) };
        let translation = (motion.velocity * along + quarter_turn(motion.velocity) * aside) * amplitude;
        Displacement { centre: centroid, sin, cos, translation }
    }

    /// Returns the position of a point of the block after the displacement, metres. `point` is its original position.
    pub fn moved(&self, point: Point) -> Point {
        self.centre + self.turned(point - self.centre) + self.translation
    }

    /// Rotates a vector by the rotation of the block.
    pub fn turned(&self, direction: Vector) -> Vector {
        direction * self.cos + quarter_turn(direction) * self.sin
    }

    /// Returns the displaced polygon.
    pub fn polygon(&self, polygon: &Polygon) -> Polygon {
        let ring = |ring: &Vec<Point>| ring.iter().map(|p| self.moved(*p)).collect();
        Polygon::from_valid_rings(polygon.rings().iter().map(ring).collect())
    }
}

/// The path of every moving block of a frame from its original to its displaced position.
#[derive(Clone, Debug, Default)]
pub(crate) struct Course {
    parts: Vec<Part>,
    blocks: usize,
}

/// The path of a group of connected blocks.
#[derive(Clone, Debug)]
struct Part {
    linkage: Linkage,
    /// The displacement in metres of a point of speed 1 at the end of the path.
    amplitude: f64,
    /// The positions of the bodies at equal steps of a long path; empty for a path that is only as long as needed to see
    /// how the fall begins.
    way: Vec<DVector<f64>>,
}

impl Part {
    /// Returns the displacement of each block. `share` is the position on the path, from 0 to 1.
    fn displaced(&self, share: f64) -> Vec<(BlockId, Displacement)> {
        let Some(last) = self.way.len().checked_sub(1).filter(|last| *last > 0) else {
            return self.linkage.displaced(share * self.amplitude);
        };
        let place = share * last as f64;
        let before = (place.floor() as usize).min(last - 1);
        let between = place - before as f64;
        self.linkage.placed(&(&self.way[before] * (1.0 - between) + &self.way[before + 1] * between))
    }
}

impl Course {
    /// Computes the paths of the blocks that fall. `unit` is the unit length in metres.
    pub fn new(fall: &Fall<'_>, unit: f64) -> Course {
        let parts = fall.parts().into_iter().map(|motions| Part {
            amplitude: amplitude(fall.scene, &motions, unit),
            linkage: Linkage::new(fall, &motions),
            way: Vec::new(),
        });
        let mut course = Course { parts: parts.collect(), blocks: fall.scene.blocks.len() };
        course.stop_before_overlaps(fall);
        course
    }

    /// Returns the largest displacement at the end of the path of a point of speed 1, in metres.
    pub fn amplitude(&self) -> f64 {
        self.parts.iter().map(|part| part.amplitude).fold(0.0, f64::max)
    }

    /// Computes paths on which the blocks move until it is clear what falls, as far as no block enters another and no
    /// joint opens. A path that would be shorter than that of [`Course::new`] stays as it is there.
    pub fn far(fall: &Fall<'_>, unit: f64) -> Course {
        let near = Course::new(fall, unit);
        let moving = fall.moving().count();
        if moving > MAX_TESTED_BLOCKS {
            return near;
        }
        let parts = near.parts.iter().zip(fall.parts()).map(|(part, motions)| {
            let amplitude = far_amplitude(fall.scene, &motions).max(part.amplitude);
            Part { linkage: part.linkage.clone(), amplitude, way: part.linkage.way(amplitude, FAR_STEPS) }
        });
        let mut far = Course { parts: parts.collect(), blocks: near.blocks };
        let bodies = solid_bodies(fall);
        for step in 1..=FAR_STEPS {
            // The positions after this step; a part whose path has ended stays there.
            let mut displaced = vec![None; far.blocks];
            for part in &far.parts {
                let poses = &part.way[step.min(part.way.len() - 1)];
                for (block, displacement) in part.linkage.placed(poses) {
                    displaced[block.0] = Some(displacement);
                }
            }
            let blocks = overlapping(&bodies, &displaced);
            for part in &mut far.parts {
                if part.linkage.blocks().any(|block| blocks.contains(&block)) {
                    part.way.truncate(step);
                }
            }
        }
        for (part, near) in far.parts.iter_mut().zip(near.parts) {
            let reached = part.amplitude * (part.way.len() - 1) as f64 / FAR_STEPS as f64;
            if reached < near.amplitude {
                *part = near;
            }
        }
        far
    }

    /// Returns the displacement of each block, indexed by block; `None` for a block at rest. `share` is the position on
    /// the path, from 0 (original position) to 1 (end). The list is empty if no block moves.
    pub fn at(&self, share: f64) -> Vec<Option<Displacement>> {
        if self.parts.is_empty() {
            return Vec::new();
        }
        let mut displaced = vec![None; self.blocks];
        for part in &self.parts {
            for (block, displacement) in part.displaced(share) {
                displaced[block.0] = Some(displacement);
            }
        }
        displaced
    }

    /// Shortens the paths of groups of blocks, in at most [`MAX_REDUCTIONS`] steps, until no block overlaps another
    /// body at any tested position. Does nothing if more than [`MAX_TESTED_BLOCKS`] blocks move.
    fn stop_before_overlaps(&mut self, fall: &Fall<'_>) {
        let moving: usize = self.parts.iter().map(|part| part.linkage.blocks().count()).sum();
        if moving > MAX_TESTED_BLOCKS {
            return;
        }
        let bodies = solid_bodies(fall);
        for _ in 0..MAX_REDUCTIONS {
            let mut places = 1..=TESTED_POSITIONS;
            let first = places.find_map(|place| {
                let blocks = overlapping(&bodies, &self.at(f64::from(place) / f64::from(TESTED_POSITIONS)));
                (!blocks.is_empty()).then_some((place, blocks))
            });
            let Some((place, blocks)) = first else { return };
            let factor = ((f64::from(place) - 0.5) / f64::from(TESTED_POSITIONS)).max(MIN_REDUCTION_FACTOR);
            for part in &mut self.parts {
                if part.linkage.blocks().any(|block| blocks.contains(&block)) {
                    part.amplitude *= factor;
                }
            }
        }
    }
}

/// A body that no other body may overlap: a block, or the ground (`None`).
type Solid<'a> = (Option<BlockId>, &'a Polygon);

/// Returns the placed blocks and the ground of a frame, without blocks whose outlines are only schematic, because these
/// may already overlap at rest. Empty if the scene lists its contacts.
fn solid_bodies<'a>(fall: &Fall<'a>) -> Vec<Solid<'a>> {
    let scene = fall.scene;
    if scene.lists_contacts() {
        return Vec::new();
    }
    let blocks = scene.frames[fall.frame].placed.iter().map(|id| (*id, &scene.blocks[id.0].body));
    let blocks = blocks.filter(|(_, body)| !body.is_schematic).map(|(id, body)| (Some(id), &body.polygon));
    let ground = scene.ground.iter().filter(|ground| !ground.body.is_schematic);
    blocks.chain(ground.map(|ground| (None, &ground.body.polygon))).collect()
}

/// Returns the blocks that overlap another body by more than [`MAX_OVERLAP`] after the displacement. `displaced` is
/// indexed by block; blocks beyond the end of the list do not move.
fn overlapping(bodies: &[Solid<'_>], displaced: &[Option<Displacement>]) -> Vec<BlockId> {
    let motion = |id: Option<BlockId>| displaced.get(id?.0)?.as_ref();
    let mut placed: Vec<(Option<BlockId>, Polygon, Bounds)> = Vec::new();
    for (id, polygon) in bodies {
        let moved = motion(*id).map_or_else(|| (*polygon).clone(), |displacement| displacement.polygon(polygon));
        let bounds = moved.bounds();
        placed.push((*id, moved, bounds));
    }
    placed.sort_by(|a, b| a.2.min.x.total_cmp(&b.2.min.x));
    let share = |a: &Polygon, b: &Polygon| {
        let common = overlap(&ConvexPieces::new(a), &ConvexPieces::new(b), 0.0);
        common.map_or(0.0, |common| common.area / a.area().min(b.area()))
    };
    let mut blocks = Vec::new();
    for (number, (a, one, bounds)) in placed.iter().enumerate() {
        let near = placed[number + 1..].iter().take_while(|other| other.2.min.x <= bounds.max.x);
        for (b, other, others) in near {
            // Two bodies that move together, or that are both at rest, cannot begin to overlap.
            if motion(*a) != motion(*b) && bounds.intersects(*others) {
                let most = if a.is_some() && b.is_some() { MAX_OVERLAP } else { MAX_GROUND_OVERLAP };
                if share(one, other) <= most {
                    continue;
                }
                blocks.extend([a, b].into_iter().flatten());
            }
        }
    }
    blocks
}

/// Returns the amplitude of a group: the displacement, in metres, that a point of speed 1 has at the end of the path.
/// Overlaps with other blocks are not considered. `unit` is the unit length in metres.
fn amplitude(scene: &Scene, group: &[Motion], unit: f64) -> f64 {
    let way = |size: f64| f64::max(MIN_DISPLACEMENT * unit.min(size), MIN_DISPLACEMENT_SHARE * size);
    bounded_amplitude(scene, group, way, MAX_ROTATION)
}

/// Returns the amplitude at the end of the path of an animation.
fn far_amplitude(scene: &Scene, group: &[Motion]) -> f64 {
    bounded_amplitude(scene, group, |size| FAR_SHARE * size, FAR_ROTATION)
}

/// Returns the amplitude with which the fastest point of a group moves by `way` of the size of the group, unless a
/// block would then turn by more than `rotation`, rad.
fn bounded_amplitude(scene: &Scene, group: &[Motion], way: impl Fn(f64) -> f64, rotation: f64) -> f64 {
    let fastest = group.iter().map(|m| m.fastest(scene)).fold(0.0, f64::max);
    let spin = group.iter().map(|m| m.spin.abs()).fold(0.0, f64::max);
    let size = scene.bounds(group.iter().map(|m| &m.block)).map_or(0.0, Bounds::diagonal);
    if fastest <= 0.0 {
        return 0.0;
    }
    let amplitude = way(size) / fastest;
    if spin > 0.0 { amplitude.min(rotation / spin) } else { amplitude }
}

#[cfg(test)]
mod tests;
