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
//! 4. The path is shortened until no block overlaps another body, whether they touched at the beginning or not
//!    ([`clearance`]).

mod clearance;
mod group;
mod linkage;
mod rigid;

use super::arrow::Marks;
use super::joint::joints;
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::{Analysis, Motion, Verdict};
use crate::mechanics::scene::{BodyId, Scene};
use clearance::Clearance;
use group::connected_groups;
pub(crate) use group::{moving, rigid_bodies};
use linkage::Linkage;
pub(crate) use rigid::Displacement;

/// Least displacement of the fastest point, unit lengths.
const MIN_DISPLACEMENT: f64 = 0.35;
/// Least displacement of the fastest point, as a fraction of the diagonal of the group. In an arch of many voussoirs,
/// a displacement of a unit length is too small to make an open hinge visible.
const MIN_DISPLACEMENT_SHARE: f64 = 0.045;
/// Largest rotation of a block, rad (20°).
const MAX_ROTATION: f64 = 0.35;
/// Number of positions along the path at which overlaps are measured.
const TESTED_POSITIONS: u32 = 8;
/// Largest number of reductions of the amplitude while blocks overlap, and the smallest factor of one reduction.
const MAX_REDUCTIONS: u32 = 24;
const MIN_REDUCTION_FACTOR: f64 = 0.6;
/// If more blocks than this move, overlaps are not measured, because this would take longer than the drawing.
const MAX_TESTED_BLOCKS: usize = 500;

/// The path of every moving block of a frame from its original to its displaced position.
#[derive(Clone, Debug, Default)]
pub(crate) struct Course {
    groups: Vec<GroupCourse>,
    blocks: usize,
}

/// The path of a group of connected blocks.
#[derive(Clone, Debug)]
struct GroupCourse {
    linkage: Linkage,
    /// The displacement in metres of a point of speed 1 at the end of the path.
    amplitude: f64,
}

impl Course {
    /// Computes the paths of the blocks of a frame that falls. For any other frame the course is empty. `unit` is the
    /// unit length in metres.
    pub fn new(analysis: &Analysis, frame: usize, unit: f64) -> Course {
        if analysis.frames[frame].verdict != Verdict::Unstable {
            return Course::default();
        }
        let joints = joints(analysis, frame);
        let groups = connected_groups(analysis, frame, |_| true);
        let groups = groups.into_iter().map(|motions| GroupCourse {
            amplitude: amplitude(analysis, &motions, unit),
            linkage: Linkage::new(analysis, frame, &joints, &motions),
        });
        let mut course = Course { groups: groups.collect(), blocks: analysis.scene.blocks.len() };
        course.stop_before_overlaps(analysis, frame);
        course
    }

    /// Returns the displacement of each block, indexed by block; `None` for a block at rest. `share` is the position on
    /// the path, from 0 (original position) to 1 (end). The list is empty if no block moves.
    pub fn at(&self, share: f64) -> Vec<Option<Displacement>> {
        if self.groups.is_empty() {
            return Vec::new();
        }
        let mut displaced = vec![None; self.blocks];
        for group in &self.groups {
            for (block, displacement) in group.linkage.displaced(share * group.amplitude) {
                displaced[block.0] = Some(displacement);
            }
        }
        displaced
    }

    /// Returns a box, in metres, around the moving blocks, the force arrows and the points where torques act. The box
    /// covers the start of the path and its [`TESTED_POSITIONS`] tested positions. Returns `None` if no block moves.
    /// `marks` are the arrows before the motion.
    pub fn reach(&self, scene: &Scene, marks: &Marks) -> Option<Bounds> {
        let places = (0..=TESTED_POSITIONS).map(|place| self.at(f64::from(place) / f64::from(TESTED_POSITIONS)));
        let each = places.filter_map(|displaced| {
            let blocks = displaced.iter().zip(&scene.blocks);
            let corners = blocks.filter_map(|(displacement, block)| {
                let outline = block.body.polygon.outline().iter();
                let moved = displacement.as_ref()?;
                Some(outline.map(|p| moved.moved(*p)))
            });
            let moved = moved_marks(marks, &displaced);
            let arrows = moved.arrows.iter();
            let ends = arrows.flat_map(|arrow| [arrow.at, arrow.at + arrow.reach()]);
            let ends = ends.chain(moved.turns.iter().map(|turn| turn.at));
            let points: Vec<Point> = corners.flatten().collect();
            (!points.is_empty()).then(|| Bounds::from_points(points.into_iter().chain(ends)))?
        });
        each.reduce(Bounds::union)
    }

    /// Shortens the paths of groups of blocks, in at most [`MAX_REDUCTIONS`] steps, until no block overlaps another
    /// body at any tested position. Does nothing if more than [`MAX_TESTED_BLOCKS`] blocks move.
    fn stop_before_overlaps(&mut self, analysis: &Analysis, frame: usize) {
        let moving: usize = self.groups.iter().map(|g| g.linkage.len()).sum();
        if moving > MAX_TESTED_BLOCKS {
            return;
        }
        let mut group_of = vec![None; self.blocks];
        for (number, group) in self.groups.iter().enumerate() {
            for block in group.linkage.blocks() {
                group_of[block.0] = Some(number);
            }
        }
        let clearance = Clearance::new(&analysis.scene, &analysis.scene.frames[frame]);
        for _ in 0..MAX_REDUCTIONS {
            let Some((place, pairs)) = self.first_overlap(&clearance) else {
                return;
            };
            let factor = ((f64::from(place) - 0.5) / f64::from(TESTED_POSITIONS)).max(MIN_REDUCTION_FACTOR);
            let mut reduced: Vec<usize> =
                pairs.into_iter().flatten().flatten().filter_map(|block| group_of[block.0]).collect();
            reduced.sort_unstable();
            reduced.dedup();
            for number in reduced {
                self.groups[number].amplitude *= factor;
            }
        }
    }

    /// Returns the first position along the path at which bodies overlap, and the pairs of bodies that overlap there.
    /// The [`TESTED_POSITIONS`] tested positions are numbered from 1. Returns `None` if no bodies overlap at any of
    /// them.
    fn first_overlap(&self, clearance: &Clearance<'_>) -> Option<(u32, Vec<clearance::Pair>)> {
        (1..=TESTED_POSITIONS).find_map(|place| {
            let displaced = self.at(f64::from(place) / f64::from(TESTED_POSITIONS));
            let pairs = clearance.overlapping(&displaced);
            (!pairs.is_empty()).then_some((place, pairs))
        })
    }
}

/// Returns the arrows after the displacement of the blocks. The tip of an arrow moves with the point of the block at
/// which the tip was before. The direction of an arrow does not change.
pub(crate) fn moved_marks(marks: &Marks, displaced: &[Option<Displacement>]) -> Marks {
    let way = |on: BodyId, tip: Point| match on {
        BodyId::Block(id) => {
            let moved = displaced.get(id.0).and_then(Option::as_ref);
            moved.map(|moved| moved.moved(tip) - tip)
        }
        BodyId::Ground(_) => None,
    };
    let mut marks = marks.clone();
    for arrow in &mut marks.arrows {
        if let Some(way) = way(arrow.on, arrow.at + arrow.vector) {
            arrow.at += way;
        }
    }
    for turn in &mut marks.turns {
        if let Some(way) = way(turn.on, turn.at) {
            turn.at += way;
        }
    }
    marks
}

/// Returns the amplitude of a group: the displacement, in metres, that a point of speed 1 has at the end of the path.
/// Overlaps with other blocks are not considered. `unit` is the unit length in metres.
fn amplitude(analysis: &Analysis, group: &[Motion], unit: f64) -> f64 {
    let scene = &analysis.scene;
    let fastest = group.iter().map(|m| m.fastest(scene)).fold(0.0, f64::max);
    let spin = group.iter().map(|m| m.spin.abs()).fold(0.0, f64::max);
    let size = group
        .iter()
        .map(|m| scene.blocks[m.block.0].body.polygon.bounds())
        .reduce(Bounds::union)
        .map_or(0.0, Bounds::diagonal);
    if fastest <= 0.0 {
        return 0.0;
    }
    let displacement = f64::max(MIN_DISPLACEMENT * unit.min(size), MIN_DISPLACEMENT_SHARE * size);
    let amplitude = displacement / fastest;
    if spin > 0.0 { amplitude.min(MAX_ROTATION / spin) } else { amplitude }
}

#[cfg(test)]
mod tests;
