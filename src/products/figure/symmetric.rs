//! [`symmetric`]: makes the drawn mechanism of a symmetric structure symmetric.
//!
//! A symmetric arch falls by a symmetric motion, but also by the motion of one half and by its mirror image. An elementary
//! mechanism is only one of them. If the motion of the proof is symmetric, the sum of an elementary mechanism and of its
//! mirror image is drawn: it is a mechanism too, and treats both halves alike.

use std::sync::Arc;

use super::fall::motions_by_block;
use crate::geometry::Vector;
use crate::mechanics::analysis::{Analysis, Motion, SolvedFrame, Verdict};
use crate::mechanics::scene::BlockId;

/// Largest distance of a block from the mirror image of its partner, as a fraction of the diagonal of the structure, and
/// the largest relative difference of areas and weights.
const MIRROR_TOL: f64 = 1e-3;
/// Largest difference of speeds between a motion and its mirror image that counts as none. The fastest point has speed 1.
const MOTION_TOL: f64 = 0.02;
/// The sum is not drawn if the two motions cancel so far that its fastest point has less than this speed.
const MIN_SPEED: f64 = 0.3;

/// Returns the analysis with elementary mechanisms, symmetric where the structure and the motion of its proof are.
/// `proved` is the analysis with the motions of the proofs.
pub(crate) fn symmetric(proved: &Analysis, mut elementary: Analysis) -> Analysis {
    elementary.change_each(|number, _, frame| {
        if frame.verdict == Verdict::Unstable
            && frame.robots.is_empty()
            && let Some(motions) = summed(proved.at(number), &frame.mechanism)
        {
            Arc::make_mut(frame).mechanism = motions;
        }
    });
    elementary
}

/// Returns the sum of motions and of their mirror images; `None` if the structure or the motion of the proof is not
/// symmetric, or if the sum is no motion worth drawing.
fn summed(solved: SolvedFrame<'_>, motions: &[Motion]) -> Option<Vec<Motion>> {
    let SolvedFrame { scene, found: proved, .. } = solved;
    let placed = &solved.frame().placed;
    let bounds = scene.bounds(placed)?;
    let axis = 0.5 * (bounds.min.x + bounds.max.x);
    let near = MIRROR_TOL * bounds.diagonal();
    let alike = |a: f64, b: f64| (a - b).abs() <= MIRROR_TOL * a.abs().max(b.abs());
    let mut partners = vec![None; scene.blocks.len()];
    for id in placed {
        let block = &scene.blocks[id.0];
        let image = Vector::new(2.0 * axis - block.centroid.x, block.centroid.y);
        let fits = |other: &&BlockId| {
            let other = &scene.blocks[other.0];
            (other.centroid.coords - image).norm() <= near
                && alike(other.body.polygon.area(), block.body.polygon.area())
                && alike(other.weight, block.weight)
        };
        partners[id.0] = Some(*placed.iter().find(fits)?);
    }
    let own = motions_by_block(scene, &proved.mechanism);
    let differs = |(block, motion): (usize, &Option<Motion>)| {
        let Some(partner) = partners[block] else { return false };
        let [a, b] =
            [*motion, own[partner.0]].map(|motion| motion.map_or((Vector::zeros(), 0.0), |m| (m.velocity, m.spin)));
        (a.0 - mirrored(b.0)).norm() > MOTION_TOL || (a.1 + b.1).abs() * proved.length > MOTION_TOL
    };
    if own.iter().enumerate().any(differs) {
        return None;
    }
    let elementary = motions_by_block(scene, motions);
    let mut sum: Vec<Motion> = Vec::new();
    for id in placed {
        let partner = partners[id.0]?;
        let (mut velocity, mut spin) = (Vector::zeros(), 0.0);
        if let Some(motion) = &elementary[id.0] {
            (velocity, spin) = (velocity + motion.velocity, spin + motion.spin);
        }
        if let Some(motion) = &elementary[partner.0] {
            (velocity, spin) = (velocity + mirrored(motion.velocity), spin - motion.spin);
        }
        if velocity != Vector::zeros() || spin != 0.0 {
            sum.push(Motion { block: *id, velocity, spin });
        }
    }
    let fastest = sum.iter().map(|motion| motion.fastest(scene)).fold(0.0, f64::max);
    if fastest < MIN_SPEED {
        return None;
    }
    for motion in &mut sum {
        (motion.velocity, motion.spin) = (motion.velocity / fastest, motion.spin / fastest);
    }
    Some(sum)
}

fn mirrored(velocity: Vector) -> Vector {
    Vector::new(-velocity.x, velocity.y)
}
