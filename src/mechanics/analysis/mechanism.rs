//! [`Analysis::elementary`]: simplifies collapse mechanisms for drawing. Each falling part gets one elementary
//! mechanism, with only the hinges and sliding joints that it needs.
//!
//! The motion that proves a fall opens every contact that can open. This gives the strongest proof, but the motion is
//! a sum of many mechanisms. A thin arch then shows eight hinges on seven bodies, although four are enough. An
//! elementary mechanism is an extreme ray of the cone of motions that no admissible force can stop. It also proves
//! the fall, and it is the mechanism that textbooks draw.
//!
//! In an elementary mechanism, a block that slides also rises, by μ metres for every metre. The reason is the
//! associated flow rule, which makes equilibrium a linear program. A real block slides along its joint. For drawing, a
//! motion that slides along the joints and keeps hinges closed therefore replaces the rising motion, if there is one.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::{Analysis, FrameAnalysis, Verdict};
use crate::geometry::{Point, Vector, cross};
use crate::mechanics::proof::Motion;
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::mechanics::solve::extreme_ray::{self, Row};

/// A part with more blocks keeps the motion of its proof, because closing its contacts one by one would take too
/// long.
const MAX_BLOCKS: usize = 300;
/// A contact counts as closed, or as not sliding, up to this fraction of the largest velocity.
const CLOSED_TOL: f64 = 1e-5;
/// A motion along the joints is drawn if its norm is at least this fraction of the norm of the rising motion.
const MIN_KEPT_NORM: f64 = 0.5;

impl Analysis {
    /// Returns a copy of the analysis for drawing, in which each falling part moves by one elementary mechanism.
    /// Sliding blocks move along their joints if possible. Proofs and all other results stay unchanged.
    ///
    /// Units: the fastest point has speed 1, as in [`FrameAnalysis::mechanism`].
    pub fn elementary(&self) -> Analysis {
        let mut analysis = self.clone();
        analysis.change_each(|_, scene, frame| {
            if frame.verdict == Verdict::Unstable {
                Arc::make_mut(frame).mechanism = self.elementary_mechanisms(scene, frame, &frame.mechanism);
            }
        });
        analysis
    }

    /// Replaces `motions`, by which a frame falls under the loads of `scene`, by one elementary mechanism for each
    /// falling part. The fastest point has speed 1.
    pub(super) fn elementary_mechanisms(
        &self,
        scene: &Scene,
        analysis: &FrameAnalysis,
        motions: &[Motion],
    ) -> Vec<Motion> {
        let mut all = Vec::new();
        // Each connected part has a separate mechanism. A part that is too large keeps the motion of its proof.
        for part in connected_parts(analysis, motions) {
            let fall = FallingPart::new(scene, analysis, part, analysis.length);
            all.extend(fall.elementary().unwrap_or(fall.motions));
        }
        // Scale all parts by one factor, so that the fastest point has speed 1.
        let fastest = all.iter().map(|m| m.fastest(&self.given)).fold(0.0, f64::max);
        if fastest > 0.0 {
            for motion in &mut all {
                motion.velocity /= fastest;
                motion.spin /= fastest;
            }
        }
        all.sort_by_key(|m| m.block);
        all
    }
}

/// Splits the moving blocks into parts that are connected by contacts between moving blocks. A block at rest does not
/// connect two parts.
fn connected_parts(analysis: &FrameAnalysis, motions: &[Motion]) -> Vec<Vec<Motion>> {
    let motions: BTreeMap<BlockId, Motion> = motions.iter().map(|m| (m.block, *m)).collect();
    let mut neighbours: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
    for contact in &analysis.contacts {
        if let [BodyId::Block(a), BodyId::Block(b)] = contact.interface.bodies {
            neighbours.entry(a).or_default().push(b);
            neighbours.entry(b).or_default().push(a);
        }
    }
    // Find the parts by depth-first search along the contacts between moving blocks.
    let mut seen: BTreeSet<BlockId> = BTreeSet::new();
    let mut parts = Vec::new();
    for first in motions.keys() {
        let (mut part, mut stack) = (Vec::new(), vec![*first]);
        while let Some(block) = stack.pop() {
            let Some(motion) = motions.get(&block) else {
                continue;
            };
            if !seen.insert(block) {
                continue;
            }
            part.push(*motion);
            stack.extend(neighbours.get(&block).into_iter().flatten());
        }
        if !part.is_empty() {
            part.sort_by_key(|m| m.block);
            parts.push(part);
        }
    }
    parts
}

/// A connected part of a frame that falls.
struct FallingPart<'a> {
    scene: &'a Scene,
    analysis: &'a FrameAnalysis,
    motions: Vec<Motion>,
    /// The index of each block in `motions`.
    index_of_block: BTreeMap<BlockId, usize>,
    /// The length L in metres. A rotation enters as a speed at this distance.
    length: f64,
}

impl<'a> FallingPart<'a> {
    fn new(scene: &'a Scene, analysis: &'a FrameAnalysis, motions: Vec<Motion>, length: f64) -> FallingPart<'a> {
        let index_of_block = motions.iter().enumerate().map(|(k, m)| (m.block, k)).collect();
        FallingPart { scene, analysis, motions, index_of_block, length }
    }

    /// Returns an elementary mechanism of this part, in which blocks slide along their joints if possible. `None` if
    /// the part has too many blocks, or if no such mechanism was found.
    fn elementary(&self) -> Option<Vec<Motion>> {
        if self.motions.len() > MAX_BLOCKS {
            return None;
        }
        let start: Vec<f64> =
            self.motions.iter().flat_map(|m| [m.velocity.x, m.velocity.y, m.spin * self.length]).collect();
        // Go from the motion of the proof to an extreme ray of the cone of motions. Each step closes one contact.
        let y = extreme_ray::extreme_ray(&self.rows(&start), &self.power(&start), &start)?;
        // In the extreme ray, sliding joints also open. If a motion along the joints exists, use it instead.
        let sliding = self.along_joints(&y);
        let motions = self.to_motions(&sliding.unwrap_or(y));
        (!motions.is_empty()).then_some(motions)
    }

    /// Returns `sign` times the velocity of a point of a body in the direction `along`, as a row of coefficients of the
    /// block velocities. The row is empty for a body at rest.
    fn velocity_row(&self, body: BodyId, at: Point, along: Vector, sign: f64) -> Row {
        let BodyId::Block(block) = body else {
            return Row::new();
        };
        let Some(place) = self.index_of_block.get(&block) else {
            return Row::new();
        };
        let arm = at - self.scene.blocks[block.0].centroid;
        vec![
            (3 * place, sign * along.x),
            (3 * place + 1, sign * along.y),
            (3 * place + 2, sign * cross(arm, along) / self.length),
        ]
    }

    /// Returns the relative velocity of two bodies at a point in the direction `along`, positive if they separate, as a
    /// row of coefficients of the block velocities.
    fn separation_row(&self, bodies: [BodyId; 2], at: Point, along: Vector) -> Row {
        let mut row = self.velocity_row(bodies[0], at, along, 1.0);
        row.extend(self.velocity_row(bodies[1], at, along, -1.0));
        row
    }

    /// Returns the rows of the conditions row · y ≥ 0 on a motion y. No contact force may oppose the motion. If a
    /// robot's force x, force y or torque has a finite limit, the robot yields, but only in the direction in which
    /// `start` moves it. Without a limit, it does not yield.
    fn rows(&self, start: &[f64]) -> Vec<Row> {
        let mut rows = Vec::new();
        for contact in &self.analysis.contacts {
            let interface = &contact.interface;
            for at in contact.application_points {
                let opening = self.separation_row(interface.bodies, at, interface.normal);
                if opening.is_empty() {
                    continue;
                }
                // Without friction, the only condition is that the contact does not close.
                if interface.friction <= 0.0 {
                    rows.push(opening);
                    continue;
                }
                // With friction there are two conditions: neither of the two extreme forces of the friction cone
                // opposes the motion.
                for side in [1.0, -1.0] {
                    let sliding = interface.tangent() * (side * interface.friction);
                    let mut row = opening.clone();
                    row.extend(self.separation_row(interface.bodies, at, sliding));
                    rows.push(row);
                }
            }
        }
        for (row, limit) in self.grips() {
            let current: f64 = row.iter().map(|(k, v)| v * start[*k]).sum();
            let negated: Row = row.iter().map(|(k, v)| (*k, -v)).collect();
            // Without a limit, the robot prevents this motion. At a finite limit, the robot yields in the direction of
            // `start`.
            if limit.is_finite() {
                rows.push(if current < 0.0 { negated } else { row });
            } else {
                rows.push(row);
                rows.push(negated);
            }
        }
        rows
    }

    /// Returns, for force x, force y and torque of each robot, the corresponding velocity as a row of coefficients, and
    /// the limit of the force, N. The limit of the torque is divided by L.
    fn grips(&self) -> Vec<(Row, f64)> {
        let mut grips = Vec::new();
        for robot in &self.analysis.robots {
            let Some(place) = self.index_of_block.get(&robot.block) else {
                continue;
            };
            let limits = &self.scene.robots[robot.robot.0].limits;
            let body = BodyId::Block(robot.block);
            let axes = [(Vector::new(1.0, 0.0), limits.fx), (Vector::new(0.0, 1.0), limits.fy)];
            for (axis, limit) in axes {
                grips.push((self.velocity_row(body, robot.at, axis, 1.0), limit));
            }
            if limits.torque > 0.0 {
                grips.push((vec![(3 * place + 2, 1.0)], limits.torque / self.length));
            }
        }
        grips
    }

    /// Returns the power of the loads minus the power that yielding robots absorb, as a row of coefficients of the
    /// block velocities.
    fn power(&self, start: &[f64]) -> Row {
        let mut power = Row::new();
        let applied = self.scene.applied_forces();
        for motion in &self.motions {
            let body = BodyId::Block(motion.block);
            let place = self.index_of_block[&motion.block];
            for applied in &applied[motion.block.0] {
                power.extend(self.velocity_row(body, applied.at, applied.force, 1.0));
                power.push((3 * place + 2, applied.torque / self.length));
            }
        }
        for (row, limit) in self.grips() {
            if limit.is_finite() {
                let current: f64 = row.iter().map(|(k, v)| v * start[*k]).sum();
                let side = if current < 0.0 { limit } else { -limit };
                power.extend(row.iter().map(|(k, v)| (*k, side * v)));
            }
        }
        power
    }

    /// Returns the motion nearest to `y` in which sliding blocks move along their joints and closed contacts stay
    /// closed. `None` if nothing slides, or if this motion is too different, does not fall, or closes another contact.
    fn along_joints(&self, y: &[f64]) -> Option<Vec<f64>> {
        let value = |row: &Row, y: &[f64]| row.iter().map(|(k, v)| v * y[*k]).sum::<f64>();
        let largest = y.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let (mut closed_rows, mut normals, mut slides) = (Vec::new(), Vec::new(), false);
        for contact in &self.analysis.contacts {
            let interface = &contact.interface;
            for at in contact.application_points {
                let opening = self.separation_row(interface.bodies, at, interface.normal);
                if opening.is_empty() {
                    continue;
                }
                let sliding = self.separation_row(interface.bodies, at, interface.tangent());
                let slide = value(&sliding, y).abs();
                let free = value(&opening, y) - interface.friction * slide;
                if free <= CLOSED_TOL * largest {
                    closed_rows.push(opening.clone());
                    if slide <= CLOSED_TOL * largest {
                        closed_rows.push(sliding);
                    } else {
                        slides = true;
                    }
                }
                normals.push(opening);
            }
        }
        if !slides {
            return None;
        }
        for (row, limit) in self.grips() {
            if !limit.is_finite() || value(&row, y).abs() <= CLOSED_TOL * largest {
                closed_rows.push(row);
            }
        }
        let along_joints = extreme_ray::project_onto_null_space(&closed_rows, y);
        let square_norm = |y: &[f64]| y.iter().map(|v| v * v).sum::<f64>();
        let is_similar = square_norm(&along_joints) >= MIN_KEPT_NORM * MIN_KEPT_NORM * square_norm(y);
        let falls = value(&self.power(y), &along_joints) > 0.0;
        let closes_no_contact = normals.iter().all(|n| value(n, &along_joints) >= -CLOSED_TOL * largest);
        (is_similar && falls && closes_no_contact).then_some(along_joints)
    }

    /// Converts the velocities `y` to motions. Blocks at rest are left out.
    fn to_motions(&self, y: &[f64]) -> Vec<Motion> {
        let largest = y.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let motion = |(place, motion): (usize, &Motion)| {
            let at = |k: usize| y[3 * place + k];
            let moves = (0..3).any(|k| at(k).abs() > CLOSED_TOL * largest);
            moves.then(|| Motion {
                block: motion.block,
                velocity: Vector::new(at(0), at(1)),
                spin: at(2) / self.length,
            })
        };
        self.motions.iter().enumerate().filter_map(motion).collect()
    }
}
