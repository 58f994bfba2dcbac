//! [`Analysis::elementary`]: replaces the collapse mechanism of each falling part by one elementary mechanism.
//!
//! The motion that proves a fall opens every contact where that is possible: it is the surest proof, but a sum of many
//! mechanisms. A thin arch then shows eight hinges on seven bodies where four are enough. An elementary mechanism is an
//! extreme ray of the cone of motions that no admissible force can object to; it proves the fall as well, if a little
//! less clearly, and is the one that a textbook draws.
//!
//! That motion lifts a block by μ for every metre that it slides: the price of a law of friction that makes equilibrium
//! a linear program (the associated flow). A real block slides along its joint. So for drawing, where a motion exists
//! that keeps hinges closed and goes along the joints that slip, it takes the place of the lifting one.

use std::collections::{BTreeMap, BTreeSet};

use super::{Analysis, FrameAnalysis, Margin, Sides, Verdict};
use crate::geometry::{Point, Vector, cross, quarter_turn, sin_cos_degrees};
use crate::proof::Motion;
use crate::scene::{BlockId, BodyId, Scene};
use crate::solve::extreme_ray::{self, Row};

/// A part of more blocks keeps the motion that proves its fall: one by one its contacts would take too long to close.
const MOST_BLOCKS: usize = 300;
/// How far beyond the edge gravity is turned to find the mechanism there, degrees.
const BEYOND: f64 = 0.05;
/// A contact is closed, and does not slide, up to this share of the fastest speed.
const CLOSED: f64 = 1e-5;
/// A motion along the joints is drawn where it keeps at least this share of the lifting one.
const KEPT: f64 = 0.5;

/// In which direction a frame is followed until it falls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Toward {
    /// Gravity turns: degrees, positive where its tip moves to the right; loads do not turn.
    #[default]
    Tilt,
    /// A share of each weight acts across gravity beside the weight itself, positive to the right.
    HorizontalLoad,
    /// The listed loads grow: the factor on them.
    LoadFactor,
}

impl Analysis {
    /// The same analysis with one elementary mechanism in place of each falling part's motion, as it is drawn: where a
    /// block slides it goes along its joint. The proofs and all else are those of the motions found.
    ///
    /// Units: velocities are per speed of the fastest point, as in [`FrameAnalysis::mechanism`].
    pub fn elementary(&self) -> Analysis {
        let mut analysis = self.clone();
        for (number, frame) in analysis.frames.iter_mut().enumerate() {
            if frame.verdict == Verdict::Unstable {
                frame.mechanism = self.mechanisms(number);
            }
        }
        analysis
    }

    /// The tilt of gravity at which a frame (from 0) falls, and its mechanism. See [`Analysis::edge`].
    ///
    /// Units: degrees. Signs: positive where gravity's tip moves to the right.
    pub fn tilted(&self, frame: usize) -> Option<(f64, Vec<Motion>)> {
        self.edge(frame, Toward::Tilt)
    }

    /// The distance of a frame (from 0) from collapse, in the direction in which it is smaller, and the elementary
    /// mechanism. `None` if margins were not computed or the frame does not fall in this direction.
    ///
    /// Units and signs: see [`Toward`].
    pub fn edge(&self, frame: usize, toward: Toward) -> Option<(f64, Vec<Motion>)> {
        let found = self.frames.get(frame)?;
        let margins = found.margins.as_ref()?;
        let side = |margin: &Margin, sign: f64| match margin {
            Margin::Value { at, mechanism } if !mechanism.is_empty() => {
                Some((sign * at, mechanism.clone()))
            }
            _ => None,
        };
        let sides = |sides: &Sides| [side(&sides.right, 1.0), side(&sides.left, -1.0)];
        let edges = match toward {
            Toward::Tilt => sides(&margins.tilt),
            Toward::HorizontalLoad => sides(&margins.horizontal_load),
            Toward::LoadFactor => [side(&margins.load_factor, 1.0), None],
        };
        // The nearer of the two sides.
        let (at, motions) = edges
            .into_iter()
            .flatten()
            .min_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        // Exactly at the limit the loads have no power along the mechanism. Slightly beyond they do.
        let (gravity, mut scene) = (self.scene.gravity, Scene::clone(&self.scene));
        match toward {
            Toward::Tilt => {
                let (sin, cos) = sin_cos_degrees(at + BEYOND * at.signum());
                scene.gravity = Vector::new(
                    cos * gravity.x - sin * gravity.y,
                    sin * gravity.x + cos * gravity.y,
                );
            }
            Toward::HorizontalLoad => {
                let share = at + BEYOND.to_radians() * at.signum();
                scene.gravity = gravity + quarter_turn(gravity) * share;
            }
            Toward::LoadFactor => {
                let factor = at * (1.0 + BEYOND.to_radians());
                for load in &mut scene.loads {
                    load.force *= factor;
                    load.torque *= factor;
                }
            }
        }
        Some((at, self.mechanisms_of(&scene, found, &motions)))
    }

    fn mechanisms(&self, number: usize) -> Vec<Motion> {
        let found = &self.frames[number];
        self.mechanisms_of(&self.scene, found, &found.mechanism)
    }

    /// One elementary mechanism for each part that falls by these motions under the loads of this scene.
    fn mechanisms_of(
        &self,
        scene: &Scene,
        found: &FrameAnalysis,
        motions: &[Motion],
    ) -> Vec<Motion> {
        let mut all = Vec::new();
        // Each part that falls by itself has its own mechanism. A part that is too large keeps the motion of the proof.
        for part in parts(found, motions) {
            let fall = Fall::new(scene, found, part, found.length);
            all.extend(fall.elementary().unwrap_or(fall.motions));
        }
        // All parts together: the fastest point has speed 1.
        let fastest = all
            .iter()
            .map(|m| m.fastest(&self.scene))
            .fold(0.0, f64::max);
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

/// The motions of each connected part of a frame. Blocks at rest connect nothing.
fn parts(found: &FrameAnalysis, motions: &[Motion]) -> Vec<Vec<Motion>> {
    let motions: BTreeMap<BlockId, Motion> = motions.iter().map(|m| (m.block, *m)).collect();
    let mut next: BTreeMap<BlockId, Vec<BlockId>> = BTreeMap::new();
    for contact in &found.contacts {
        if let [BodyId::Block(a), BodyId::Block(b)] = contact.interface.bodies {
            next.entry(a).or_default().push(b);
            next.entry(b).or_default().push(a);
        }
    }
    // Depth-first search over the blocks that move, along contacts between blocks.
    let mut seen: BTreeSet<BlockId> = BTreeSet::new();
    let mut parts = Vec::new();
    for first in motions.keys() {
        let (mut part, mut left) = (Vec::new(), vec![*first]);
        while let Some(block) = left.pop() {
            let Some(motion) = motions.get(&block) else {
                continue;
            };
            if !seen.insert(block) {
                continue;
            }
            part.push(*motion);
            left.extend(next.get(&block).into_iter().flatten());
        }
        if !part.is_empty() {
            part.sort_by_key(|m| m.block);
            parts.push(part);
        }
    }
    parts
}

/// A part that falls.
struct Fall<'a> {
    scene: &'a Scene,
    found: &'a FrameAnalysis,
    motions: Vec<Motion>,
    /// The place of each block among the motions.
    places: BTreeMap<BlockId, usize>,
    /// L, by which turning is weighed against going, metres.
    length: f64,
}

impl<'a> Fall<'a> {
    fn new(
        scene: &'a Scene,
        found: &'a FrameAnalysis,
        motions: Vec<Motion>,
        length: f64,
    ) -> Fall<'a> {
        let places = motions
            .iter()
            .enumerate()
            .map(|(k, m)| (m.block, k))
            .collect();
        Fall {
            scene,
            found,
            motions,
            places,
            length,
        }
    }

    /// One elementary mechanism, with sliding along the joints if possible; `None` if none is found.
    fn elementary(&self) -> Option<Vec<Motion>> {
        if self.motions.len() > MOST_BLOCKS {
            return None;
        }
        let start: Vec<f64> = self
            .motions
            .iter()
            .flat_map(|m| [m.velocity.x, m.velocity.y, m.spin * self.length])
            .collect();
        // From the proof's motion to an extreme ray of the cone: every step makes one more contact tight.
        let y = extreme_ray::extreme_ray(&self.rows(&start), &self.power(&start), &start)?;
        // If a motion along the slipping joints exists, it is drawn in place of the lifting one.
        let sliding = self.along_joints(&y);
        let motions = self.motions_of(&sliding.unwrap_or(y));
        (!motions.is_empty()).then_some(motions)
    }

    /// The velocity of a point of a body in a direction as a row of coefficients, multiplied by `sign`.
    fn speed(&self, body: BodyId, at: Point, along: Vector, sign: f64) -> Row {
        let BodyId::Block(block) = body else {
            return Row::new();
        };
        let Some(place) = self.places.get(&block) else {
            return Row::new();
        };
        let arm = at - self.scene.blocks[block.0].centroid;
        vec![
            (3 * place, sign * along.x),
            (3 * place + 1, sign * along.y),
            (3 * place + 2, sign * cross(arm, along) / self.length),
        ]
    }

    /// The velocity at which the two bodies of an interface separate in a direction at a point.
    fn parting(&self, bodies: [BodyId; 2], at: Point, along: Vector) -> Row {
        let mut row = self.speed(bodies[0], at, along, 1.0);
        row.extend(self.speed(bodies[1], at, along, -1.0));
        row
    }

    /// The rows that must not be negative, because an admissible force would act against the motion otherwise. Robots hold
    /// as in `start`.
    fn rows(&self, start: &[f64]) -> Vec<Row> {
        let mut rows = Vec::new();
        for contact in &self.found.contacts {
            let interface = &contact.interface;
            for at in contact.application_points {
                let opening = self.parting(interface.bodies, at, interface.normal);
                if opening.is_empty() {
                    continue;
                }
                // Without friction the contact only must not close.
                if interface.friction <= 0.0 {
                    rows.push(opening);
                    continue;
                }
                // With friction no edge of the friction cone may do work: two rows at each application point.
                for side in [1.0, -1.0] {
                    let rubbing = interface.tangent() * (side * interface.friction);
                    let mut row = opening.clone();
                    row.extend(self.parting(interface.bodies, at, rubbing));
                    rows.push(row);
                }
            }
        }
        for (row, limit) in self.grips() {
            let now: f64 = row.iter().map(|(k, v)| v * start[*k]).sum();
            let turned: Row = row.iter().map(|(k, v)| (*k, -v)).collect();
            // A robot without limits holds its block at rest. A robot at its limit yields in the direction of `start`.
            if limit.is_finite() {
                rows.push(if now < 0.0 { turned } else { row });
            } else {
                rows.push(row);
                rows.push(turned);
            }
        }
        rows
    }

    /// The velocities of grips that robots resist (x, y and rotation), each with the largest force, or torque divided by L.
    fn grips(&self) -> Vec<(Row, f64)> {
        let mut grips = Vec::new();
        for robot in &self.found.robots {
            let Some(place) = self.places.get(&robot.block) else {
                continue;
            };
            let limits = &self.scene.robots[robot.robot.0].limits;
            let body = BodyId::Block(robot.block);
            let axes = [
                (Vector::new(1.0, 0.0), limits.fx),
                (Vector::new(0.0, 1.0), limits.fy),
            ];
            for (axis, limit) in axes {
                grips.push((self.speed(body, robot.at, axis, 1.0), limit));
            }
            if limits.torque > 0.0 {
                grips.push((vec![(3 * place + 2, 1.0)], limits.torque / self.length));
            }
        }
        grips
    }

    /// The power of the loads along a motion, less the power that robots at their limits absorb.
    fn power(&self, start: &[f64]) -> Row {
        let mut power = Row::new();
        for motion in &self.motions {
            let block = &self.scene.blocks[motion.block.0];
            let body = BodyId::Block(motion.block);
            // Weight and listed loads.
            let weight = self.scene.down() * block.weight;
            power.extend(self.speed(body, block.centroid, weight, 1.0));
            let loads = self.scene.loads.iter().filter(|l| l.block == motion.block);
            for load in loads {
                power.extend(self.speed(body, load.at, load.force, 1.0));
                let place = self.places[&motion.block];
                power.push((3 * place + 2, load.torque / self.length));
            }
        }
        for (row, limit) in self.grips() {
            if limit.is_finite() {
                let now: f64 = row.iter().map(|(k, v)| v * start[*k]).sum();
                let side = if now < 0.0 { limit } else { -limit };
                power.extend(row.iter().map(|(k, v)| (*k, side * v)));
            }
        }
        power
    }

    /// The motion nearest to `y` that keeps every closed contact closed and slides along its joint; `None` if no such
    /// motion is similar to `y`.
    fn along_joints(&self, y: &[f64]) -> Option<Vec<f64>> {
        let value = |row: &Row, y: &[f64]| row.iter().map(|(k, v)| v * y[*k]).sum::<f64>();
        let largest = y.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let (mut kept, mut normals, mut slides) = (Vec::new(), Vec::new(), false);
        for contact in &self.found.contacts {
            let interface = &contact.interface;
            for at in contact.application_points {
                let opening = self.parting(interface.bodies, at, interface.normal);
                if opening.is_empty() {
                    continue;
                }
                let rubbing = self.parting(interface.bodies, at, interface.tangent());
                let slide = value(&rubbing, y).abs();
                let free = value(&opening, y) - interface.friction * slide;
                if free <= CLOSED * largest {
                    kept.push(opening.clone());
                    if slide <= CLOSED * largest {
                        kept.push(rubbing);
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
            if !limit.is_finite() || value(&row, y).abs() <= CLOSED * largest {
                kept.push(row);
            }
        }
        let flat = extreme_ray::project_onto_null_space(&kept, y);
        let size = |y: &[f64]| y.iter().map(|v| v * v).sum::<f64>();
        let like = size(&flat) >= KEPT * KEPT * size(y);
        let falls = value(&self.power(y), &flat) > 0.0;
        let clear = normals.iter().all(|n| value(n, &flat) >= -CLOSED * largest);
        (like && falls && clear).then_some(flat)
    }

    /// The motions of the blocks that are not at rest.
    fn motions_of(&self, y: &[f64]) -> Vec<Motion> {
        let largest = y.iter().map(|v| v.abs()).fold(0.0, f64::max);
        let motion = |(place, motion): (usize, &Motion)| {
            let at = |k: usize| y[3 * place + k];
            let moves = (0..3).any(|k| at(k).abs() > CLOSED * largest);
            moves.then(|| Motion {
                block: motion.block,
                velocity: Vector::new(at(0), at(1)),
                spin: at(2) / self.length,
            })
        };
        self.motions.iter().enumerate().filter_map(motion).collect()
    }
}
