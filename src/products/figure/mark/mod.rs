//! [`marks`]: computes the positions, lengths and colours of all arrows of a frame.
//!
//! An arrow shows a force *on* a block; no arrows are drawn on the ground. Weights and forces of interfaces have the
//! colour of the block on which they act. Two blocks in contact have opposite arrows. Both begin at the point where the
//! resultant of the interface acts: Σ N_k p_k / Σ N_k for the normal forces N_k at the points p_k
//! ([Vallat23](crate::doc::references) §2.0.9). Arrows of robots are wider. Arrows of missing forces are widest and
//! red.

mod maker;
mod missing;
mod part;

use super::arrow::{ForceArrow, Marks};
use super::option::{Normalisation, Options};
use super::unit::unit;
use super::unit::{contains, zoomed_view};
use crate::geometry::Point;
use crate::mechanics::analysis::Analysis;
use maker::ArrowMaker;
use part::parts;

/// Returns the straight arrows of [`marks`] for frame `frame` (from 0). The scale is chosen for this frame; see
/// [`Normalisation`]. The list is empty if the frame does not exist.
pub fn arrows(analysis: &Analysis, frame: usize, options: &Options) -> Vec<ForceArrow> {
    if frame >= analysis.frames.len() {
        return Vec::new();
    }
    let reference = largest(analysis, frame, options);
    marks(analysis, frame, options, reference).arrows
}

/// Returns the force, in N, whose arrow is one unit length long if the scale is chosen for this frame.
///
/// With [`Normalisation::Drawn`], this is the largest drawn force; a torque counts as torque divided by the unit
/// length. With [`Normalisation::Source`], this is the largest single unknown of the linear program, weight or load. In
/// a zoomed figure, only forces in the zoomed view count.
pub(crate) fn largest(analysis: &Analysis, frame: usize, options: &Options) -> f64 {
    let scene = &analysis.scene;
    let (frame, frame_analysis) = (&scene.frames[frame], &analysis.frames[frame]);
    let edge = unit(scene, options.zoom);
    let near = options.zoom.map(|block| zoomed_view(scene, block));
    let shown = |at: Point| near.is_none_or(|near| contains(near, at));
    let blocks = frame.placed.iter().map(|b| &scene.blocks[b.0]);
    let blocks = blocks.filter(|b| shown(b.centroid));
    let weights = blocks.map(|b| b.weight);
    let mut most = weights.fold(0.0, f64::max);
    match options.normalisation {
        Normalisation::Source => {
            for contact in frame_analysis.contacts.iter().filter(|c| shown(c.resultant.at)) {
                most = contact.normal_forces.iter().copied().fold(most, f64::max).max(contact.friction_force.abs());
            }
            for robot in frame_analysis.robots.iter().filter(|r| shown(r.at)) {
                most = most.max(robot.force.x.abs()).max(robot.force.y.abs()).max(robot.torque.abs() / edge);
            }
        }
        Normalisation::Drawn => {
            for contact in frame_analysis.contacts.iter().filter(|c| shown(c.resultant.at)) {
                for part in parts(contact, options.style) {
                    most = most.max(part.force.norm());
                }
            }
            for robot in frame_analysis.robots.iter().filter(|r| shown(r.at)) {
                most = most.max(robot.force.norm()).max(robot.torque.abs() / edge);
            }
            for failure in frame_analysis.failures.iter().filter(|f| shown(f.at())) {
                most = most.max(failure.force().norm()).max(failure.torque().abs() / edge);
            }
        }
    }
    let loads = scene.loads.iter();
    for load in loads.filter(|l| frame.placed.contains(&l.block) && shown(l.at)) {
        most = most.max(load.force.norm()).max(load.torque.abs() / edge);
    }
    most
}

/// Returns all arrows of frame `frame` (from 0). The arrow of a force of `newtons_per_unit` newtons is one unit length
/// long.
///
/// The unit length is the side of a lattice cell, or a typical size of a block. There are no arrows if the frame does
/// not exist or `newtons_per_unit` is not above 0.
pub fn marks(analysis: &Analysis, frame: usize, options: &Options, newtons_per_unit: f64) -> Marks {
    let mut marks = Marks { newtons_per_unit, ..Marks::default() };
    let (Some(placed), Some(frame_analysis)) = (analysis.scene.frames.get(frame), analysis.frames.get(frame)) else {
        return marks;
    };
    if newtons_per_unit.is_nan() || newtons_per_unit <= 0.0 {
        return marks;
    }
    let scene = &analysis.scene;
    let options = &options.for_scene(scene);
    let edge = unit(scene, options.zoom);
    let maker = ArrowMaker { scene, options, edge, metres_per_newton: edge / newtons_per_unit };
    maker.blocks(placed, frame_analysis, &mut marks);
    maker.robots(frame_analysis, &mut marks);
    maker.failures(frame_analysis, &mut marks);
    marks
}
