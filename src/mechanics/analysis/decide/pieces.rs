//! Divides a mechanism into rigid pieces: sets of bodies that move as one rigid body.
//!
//! The solver's error makes a motion of many bodies violate every joint that does not open. Most of these joints lie
//! between bodies that move as one. If each rigid piece becomes one body, the correction of the motion is a small
//! program. Joints within a piece then have no relative motion, except for rounding.

use super::Component;
use super::motion::to_speed_one;
use crate::geometry::{Vector, quarter_turn};
use crate::mechanics::program::Program;
use crate::mechanics::proof::{Motion, Proof};
use crate::mechanics::solve::{Effort, repair_motion};
use crate::mechanics::statics::assembly::{Assembly, DisjointSets};

/// Bodies whose velocities differ by at most this much move as one; the fastest point has speed 1. The same difference
/// is solver error in one structure and motion in another, so the coarser value, which gives fewer pieces, is tried
/// first.
const SAME_PIECE_SPEED: [f64; 2] = [1e-5, 1e-7];

/// With fewer bodies per piece than this, correcting the pieces costs about as much as correcting all bodies. A wall
/// near its limit falls in pieces of two to four bricks, a stack in one piece.
const MIN_BODIES_PER_PIECE: usize = 8;

impl Component<'_> {
    /// Corrects a motion by treating bodies that move nearly together as one rigid piece, and returns it with its
    /// proof. The fastest point has speed 1. `None` if there are too many pieces or if the proof is too weak.
    pub(super) fn prove_motion_in_pieces(
        &self,
        motion: &[Motion],
        effort: &mut Effort,
    ) -> Option<(Vec<Motion>, Proof)> {
        SAME_PIECE_SPEED.into_iter().find_map(|tolerance| {
            // 1. Join bodies that move nearly as one rigid body.
            let piece = rigid_pieces(self.assembly, motion, tolerance);
            let merged = self.assembly.merged(&piece);
            if merged.bodies.is_empty() || MIN_BODIES_PER_PIECE * merged.bodies.len() > motion.len() {
                return None;
            }
            // 2. Correct the mean motion of each piece, in a smaller program.
            let program = Program::new(&merged, self.scale);
            let mean = mean_velocities(&piece, motion, merged.bodies.len(), self.scale.length);
            let y = repair_motion(&program, &mean, effort)?;
            // 3. Convert the result to a motion of every body, and prove it.
            let body_motions = self.body_motions(&merged, &piece, &y);
            let proof = self.check_mechanism(&body_motions);
            self.accepts_motion(&body_motions, &proof).then_some((body_motions, proof))
        })
    }

    /// Converts the velocities `y` of the pieces (program units) to the motion of every body in metres, with the
    /// fastest point at speed 1.
    fn body_motions(&self, merged: &Assembly, piece: &[Option<usize>], y: &[f64]) -> Vec<Motion> {
        let bodies = self.assembly.bodies.iter().zip(piece);
        let mut motion: Vec<Motion> = bodies
            .map(|(body, piece)| {
                let (mut velocity, mut spin) = (Vector::zeros(), 0.0);
                if let Some(k) = *piece {
                    spin = y[3 * k + 2] / self.scale.length;
                    let arm = body.centroid - merged.bodies[k].centroid;
                    velocity = Vector::new(y[3 * k], y[3 * k + 1]) + quarter_turn(arm) * spin;
                }
                Motion { block: body.block, velocity, spin }
            })
            .collect();
        to_speed_one(self.assembly, &mut motion);
        motion
    }
}

/// Returns the index of the rigid piece that each body belongs to; `None` for bodies at rest with the ground. Two bodies
/// in contact belong to one piece if their velocities differ by at most `tolerance`.
fn rigid_pieces(assembly: &Assembly, motion: &[Motion], tolerance: f64) -> Vec<Option<usize>> {
    let bodies = &assembly.bodies;
    let ground = bodies.len();
    let mut sets = DisjointSets::new(bodies.len() + 1);
    let radii: Vec<f64> = bodies.iter().map(|body| body.radius()).collect();
    for contact in &assembly.contacts {
        let (on, at) = (contact.on, contact.points[0]);
        // Compare the two bodies: their relative velocity at the contact, and their relative spin times the larger
        // radius.
        let mut relative_velocity = motion[on].about(bodies[on].centroid, at);
        let (mut relative_spin, mut radius) = (motion[on].spin, radii[on]);
        if let Some(from) = contact.from {
            relative_velocity -= motion[from].about(bodies[from].centroid, at);
            relative_spin -= motion[from].spin;
            radius = radius.max(radii[from]);
        }
        if relative_velocity.norm() + relative_spin.abs() * radius <= tolerance {
            sets.union(on, contact.from.unwrap_or(ground));
        }
    }
    // Number the pieces in the order of their first bodies. The piece of the ground gets no number.
    let resting = sets.find(ground);
    let mut number = vec![None; bodies.len() + 1];
    let mut count = 0;
    (0..bodies.len())
        .map(|body| {
            let first = sets.find(body);
            if first == resting {
                return None;
            }
            if number[first].is_none() {
                number[first] = Some(count);
                count += 1;
            }
            number[first]
        })
        .collect()
}

/// Returns the mean velocity and spin of the bodies of each piece: three numbers for each piece, in program units.
fn mean_velocities(piece: &[Option<usize>], motion: &[Motion], count: usize, length: f64) -> Vec<f64> {
    let (mut sum, mut members) = (vec![0.0; 3 * count], vec![0.0; count]);
    for (piece, motion) in piece.iter().zip(motion) {
        if let Some(k) = *piece {
            sum[3 * k] += motion.velocity.x;
            sum[3 * k + 1] += motion.velocity.y;
            sum[3 * k + 2] += motion.spin * length;
            members[k] += 1.0;
        }
    }
    let sums = sum.iter().enumerate();
    sums.map(|(row, v)| v / members[row / 3]).collect()
}
