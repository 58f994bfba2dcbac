//! [`marks`]: computes the data of all arrows of a frame, before they are drawn.
//!
//! An arrow shows a force *on* a block and has the colour of this block; no arrows are drawn on the ground. Two blocks
//! in contact have opposite arrows. Both begin at the moment-equivalent point Σ N_k p_k / Σ N_k of their interface
//! ([Vallat23](crate::doc::references) §2.0.9). Arrows of robots are wider. Arrows of missing forces are widest and
//! red.

use super::apart;
use super::arrow::{ArrowKind, ForceArrow, Head, Marks, TurnArrow, TurnKind};
use super::option::{ForceStyle, Normalisation, Options};
use super::unit::unit;
use super::view;
use crate::analysis::{Analysis, Contact, Failure, FrameAnalysis};
use crate::drawing::{Colour, Theme};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::scene::{BlockId, BodyId, Frame, Scene};

/// Forces below this share of the largest are not drawn, because they may be solver errors. Forces are accurate to
/// about 1e-9.
const FORCE_TOL: f64 = 1e-6;
/// In [`Normalisation::Drawn`] arrows shorter than this, unit edges, have a thinner shaft and head.
const FULL_WIDTH_LENGTH: f64 = 0.35;
/// Least width of a shaft, as a share of the full width. With the full width, arrows of small forces would only be
/// heads.
const MIN_WIDTH_SHARE: f64 = 0.65;
/// Least length of the arrow of the largest missing force, unit edges. If it is shorter at the scale of the other
/// forces, missing forces have a scale of their own. The second number is the least length of any of them.
const MISSING_LENGTHS: (f64, f64) = (0.8, 0.25);
/// The thesis draws the missing forces on a block at this share of the scale of that block.
const SOURCE_FAILURE_SCALE: f64 = 0.4;

/// Returns the straight arrows of frame `frame` (from 0) at the frame's own scale, as in [`marks`]. Returns no arrows
/// if the frame does not exist.
pub fn arrows(analysis: &Analysis, frame: usize, options: &Options) -> Vec<ForceArrow> {
    if frame >= analysis.frames.len() {
        return Vec::new();
    }
    let reference = largest(analysis, frame, options);
    marks(analysis, frame, options, reference).arrows
}

/// Returns the force, in N, whose arrow is one unit edge long at the frame's own scale.
///
/// With [`Normalisation::Drawn`] it is the largest drawn force; a torque counts as torque divided by the unit edge.
/// With [`Normalisation::Source`] it is the largest single unknown, weight or load.
pub(crate) fn largest(analysis: &Analysis, frame: usize, options: &Options) -> f64 {
    let scene = &analysis.scene;
    let (frame, found) = (&scene.frames[frame], &analysis.frames[frame]);
    let edge = unit(scene, options.zoom);
    let near = options.zoom.map(|block| view::around(scene, block));
    let shown = |at: Point| near.is_none_or(|near| view::holds(near, at));
    let blocks = frame.placed.iter().map(|b| &scene.blocks[b.0]);
    let blocks = blocks.filter(|b| shown(b.centroid));
    let weights = blocks.map(|b| b.weight);
    let mut most = weights.fold(0.0, f64::max);
    match options.normalisation {
        Normalisation::Source => {
            for contact in found.contacts.iter().filter(|c| shown(c.resultant.at)) {
                most = contact
                    .normal_forces
                    .iter()
                    .copied()
                    .fold(most, f64::max)
                    .max(contact.friction_force.abs());
            }
            for robot in found.robots.iter().filter(|r| shown(r.at)) {
                most = most
                    .max(robot.force.x.abs())
                    .max(robot.force.y.abs())
                    .max(robot.torque.abs() / edge);
            }
        }
        Normalisation::Drawn => {
            for contact in found.contacts.iter().filter(|c| shown(c.resultant.at)) {
                for part in parts(contact, options.style) {
                    most = most.max(part.force.norm());
                }
            }
            for robot in found.robots.iter().filter(|r| shown(r.at)) {
                most = most.max(robot.force.norm()).max(robot.torque.abs() / edge);
            }
            for failure in found.failures.iter().filter(|f| shown(f.at())) {
                most = most
                    .max(failure.force().norm())
                    .max(failure.torque().abs() / edge);
            }
        }
    }
    let loads = scene.loads.iter();
    for load in loads.filter(|l| frame.placed.contains(&l.block) && shown(l.at)) {
        most = most.max(load.force.norm()).max(load.torque.abs() / edge);
    }
    most
}

/// Returns all arrows of frame `frame` (from 0). A force of `newtons_per_unit` N has an arrow
/// as long as the unit edge.
///
/// The unit edge is the side of a lattice cell, or a typical size of a block. There are no arrows if the frame does not
/// exist or `newtons_per_unit` is not above 0.
pub fn marks(analysis: &Analysis, frame: usize, options: &Options, newtons_per_unit: f64) -> Marks {
    let mut marks = Marks {
        newtons_per_unit,
        ..Marks::default()
    };
    let (Some(placed), Some(found)) =
        (analysis.scene.frames.get(frame), analysis.frames.get(frame))
    else {
        return marks;
    };
    if newtons_per_unit.is_nan() || newtons_per_unit <= 0.0 {
        return marks;
    }
    let scene = &analysis.scene;
    let edge = unit(scene, options.zoom);
    let pen = ArrowMaker {
        scene,
        options,
        edge,
        metres_per_newton: edge / newtons_per_unit,
    };
    pen.blocks(placed, found, &mut marks);
    pen.robots(found, &mut marks);
    pen.failures(found, &mut marks);
    marks
}

/// A force of an interface on its first body.
struct Part {
    /// The kind of its arrow, given the other body.
    kind: fn(BodyId) -> ArrowKind,
    force: Vector,
    at: Point,
}

/// Returns the forces of an interface on its first body: one or two, by style.
fn parts(contact: &Contact, style: ForceStyle) -> Vec<Part> {
    let at = contact.resultant.at;
    let part = |kind, force| Part { kind, force, at };
    match style {
        ForceStyle::Resultant => {
            let on_first = contact.resultant.on == contact.interface.bodies[0];
            let force = contact.resultant.force;
            vec![part(
                ArrowKind::Contact,
                if on_first { force } else { -force },
            )]
        }
        ForceStyle::Components => {
            let normal = contact.interface.normal;
            let pressed: f64 = contact.normal_forces.iter().sum();
            vec![
                part(ArrowKind::Normal, normal * pressed),
                part(
                    ArrowKind::Friction,
                    quarter_turn(normal) * contact.friction_force,
                ),
            ]
        }
    }
}

struct ArrowMaker<'a> {
    scene: &'a Scene,
    options: &'a Options,
    edge: f64,
    metres_per_newton: f64,
}

impl ArrowMaker<'_> {
    fn straight(
        &self,
        marks: &mut Marks,
        kind: ArrowKind,
        on: BodyId,
        at: Point,
        force: Vector,
        look: (Colour, f64),
    ) {
        // Loads are input, so even a very small load is not noise.
        let least = match kind {
            ArrowKind::Load => 0.0,
            _ => FORCE_TOL * marks.newtons_per_unit,
        };
        if force.norm() > least {
            let vector = force * self.metres_per_newton;
            marks.arrows.push(ForceArrow {
                on,
                at,
                vector,
                force,
                colour: look.0,
                width: self.width(look.1, vector),
                head: self.head(),
                kind,
            });
        }
    }

    fn head(&self) -> Head {
        if self.options.printed() {
            Head::Beyond
        } else {
            Head::Within
        }
    }

    /// Returns the width of an arrow's shaft in metres: `full` unit edges, or less for a short arrow.
    fn width(&self, full: f64, vector: Vector) -> f64 {
        let share = match self.options.normalisation {
            Normalisation::Source => 1.0,
            Normalisation::Drawn => {
                let length = vector.norm() / self.edge;
                libm::sqrt(length / FULL_WIDTH_LENGTH).clamp(MIN_WIDTH_SHARE, 1.0)
            }
        };
        full * share * self.edge
    }

    /// Adds the arrow of a torque, or the two vertical arrows of the thesis at half a unit edge to both sides.
    fn torque(
        &self,
        marks: &mut Marks,
        kind: TurnKind,
        on: BodyId,
        at: Point,
        torque: f64,
        look: (Colour, f64),
    ) {
        if torque.abs() <= FORCE_TOL * marks.newtons_per_unit * self.edge {
            return;
        }
        let source = self.options.printed();
        let half = match kind {
            TurnKind::Robot(robot) => Some(ArrowKind::RobotTorque(robot)),
            TurnKind::Missing(robot) => Some(ArrowKind::MissingTorque(robot)),
            TurnKind::Load => None,
        };
        if let (true, Some(kind)) = (source, half) {
            for side in [1.0, -1.0] {
                let force = Vector::new(0.0, side * torque / self.edge);
                self.straight(
                    marks,
                    kind,
                    on,
                    at + Vector::new(side * self.edge / 2.0, 0.0),
                    force,
                    look,
                );
            }
        } else {
            let arc = torque / self.edge * self.metres_per_newton;
            marks.turns.push(TurnArrow {
                on,
                at,
                torque,
                arc,
                colour: look.0,
                width: look.1 * self.edge,
                kind,
            });
        }
    }

    fn blocks(&self, frame: &Frame, found: &FrameAnalysis, marks: &mut Marks) {
        let (scene, theme) = (self.scene, &self.options.theme);
        let mut touching: Vec<Vec<usize>> = vec![Vec::new(); scene.blocks.len()];
        for (number, contact) in found.contacts.iter().enumerate() {
            for body in contact.interface.bodies {
                if let BodyId::Block(block) = body {
                    touching[block.0].push(number);
                }
            }
        }
        for (place, id) in frame.placed.iter().enumerate() {
            let block = &scene.blocks[id.0];
            let on = BodyId::Block(*id);
            let look = (theme.arrow(place + 1), theme.widths.force);
            self.straight(
                marks,
                ArrowKind::Weight,
                on,
                block.centroid,
                scene.down() * block.weight,
                look,
            );
            let load_look = (theme.load, theme.widths.robot);
            for load in scene.loads.iter().filter(|l| l.block == *id) {
                self.straight(marks, ArrowKind::Load, on, load.at, load.force, load_look);
                self.torque(marks, TurnKind::Load, on, load.at, load.torque, load_look);
            }
            for number in &touching[id.0] {
                let contact = &found.contacts[*number];
                let [first, second] = contact.interface.bodies;
                let (from, sign) = if first == on {
                    (second, 1.0)
                } else {
                    (first, -1.0)
                };
                for part in parts(contact, self.options.style) {
                    self.straight(
                        marks,
                        (part.kind)(from),
                        on,
                        part.at,
                        part.force * sign,
                        look,
                    );
                }
            }
        }
    }

    fn robots(&self, found: &FrameAnalysis, marks: &mut Marks) {
        let theme = &self.options.theme;
        for robot in &found.robots {
            let on = BodyId::Block(robot.block);
            let look = (theme.robot(robot.robot.0), theme.widths.robot);
            self.straight(
                marks,
                ArrowKind::Robot(robot.robot),
                on,
                robot.at,
                robot.force,
                look,
            );
            self.torque(
                marks,
                TurnKind::Robot(robot.robot),
                on,
                robot.at,
                robot.torque,
                look,
            );
        }
    }

    /// Returns the vector in metres of the arrow of a missing force, if the largest missing force of the frame is
    /// `largest` N.
    fn missing(&self, force: Vector, largest: f64) -> Vector {
        let (longest, least) = MISSING_LENGTHS;
        let own = longest * self.edge / largest.max(f64::MIN_POSITIVE);
        let vector = force * self.metres_per_newton.max(own);
        let length = vector.norm().max(f64::MIN_POSITIVE);
        vector * (least * self.edge / length).max(1.0)
    }

    fn failures(&self, found: &FrameAnalysis, marks: &mut Marks) {
        let theme = &self.options.theme;
        // Figures in the style of the thesis have its red. The red of other figures is darker, so that a grey print
        // shows the difference from green.
        let failure = if self.options.printed() && *theme == Theme::thesis() {
            Colour::hex(0xff0000)
        } else {
            theme.failure
        };
        let look = (failure, theme.widths.failure);
        let source = match self.options.normalisation {
            Normalisation::Source => Some(acting(self.scene, found)),
            Normalisation::Drawn => None,
        };
        let amounts = found.failures.iter().map(|failure| failure.force().norm());
        let largest = amounts.fold(0.0, f64::max);
        for failure in &found.failures {
            let halves = match *failure {
                Failure::Tension {
                    bodies: [a, b],
                    at,
                    force,
                } => {
                    vec![
                        (ArrowKind::MissingPull(b), a, at, force),
                        (ArrowKind::MissingPull(a), b, at, -force),
                    ]
                }
                Failure::Friction {
                    bodies: [a, b],
                    at,
                    force,
                } => {
                    vec![
                        (ArrowKind::MissingFriction(b), a, at, force),
                        (ArrowKind::MissingFriction(a), b, at, -force),
                    ]
                }
                Failure::RobotForce {
                    robot,
                    block,
                    at,
                    force,
                } => {
                    vec![(
                        ArrowKind::MissingRobotForce(robot),
                        BodyId::Block(block),
                        at,
                        force,
                    )]
                }
                Failure::RobotTorque {
                    robot,
                    block,
                    at,
                    torque,
                } => {
                    self.torque(
                        marks,
                        TurnKind::Missing(robot),
                        BodyId::Block(block),
                        at,
                        torque,
                        look,
                    );
                    continue;
                }
            };
            for (kind, on, at, force) in halves {
                let BodyId::Block(block) = on else { continue };
                if force.norm() <= FORCE_TOL * marks.newtons_per_unit {
                    continue;
                }
                let vector = match &source {
                    Some(acting) if acting[block.0] > 0.0 => {
                        force * (SOURCE_FAILURE_SCALE * self.edge / acting[block.0])
                    }
                    Some(_) => force * self.metres_per_newton,
                    None => self.missing(force, largest),
                };
                let width = self.width(look.1, vector);
                // The figures of the source begin every arrow at its point.
                let at = match self.options.printed() {
                    true => at,
                    false => self.on_own_side(kind, block, at, vector, width),
                };
                marks.arrows.push(ForceArrow {
                    on,
                    at,
                    vector,
                    force,
                    colour: look.0,
                    width,
                    head: self.head(),
                    kind,
                });
            }
        }
    }
}

impl ArrowMaker<'_> {
    /// Returns the beginning, in metres, at which the arrow of a missing force lies on its own block.
    ///
    /// A missing pull moves along its line of action until its head is at the joint: begun there, it would lie on the other
    /// block and look like a push. Missing friction moves across by half the distance of parallel arrows.
    fn on_own_side(
        &self,
        kind: ArrowKind,
        block: BlockId,
        at: Point,
        vector: Vector,
        width: f64,
    ) -> Point {
        match kind {
            ArrowKind::MissingPull(_) => {
                // The heads of the pair stay apart by a little more than the gap between arrows.
                let length = vector.norm();
                at - vector * ((length + 0.6 * apart::GAP * width) / length)
            }
            ArrowKind::MissingFriction(_) => {
                let left = quarter_turn(vector) / vector.norm();
                let across = left * (0.5 * (1.0 + apart::GAP) * width);
                let polygon = &self.scene.blocks[block.0].body.polygon;
                match polygon.contains(at + across * 0.1) {
                    true => at + across,
                    false => at - across,
                }
            }
            _ => at,
        }
    }
}

/// Returns the largest single unknown or weight on each block, by its index, in N. The thesis scales missing forces
/// with it.
fn acting(scene: &Scene, found: &FrameAnalysis) -> Vec<f64> {
    let mut most: Vec<f64> = scene.blocks.iter().map(|b| b.weight).collect();
    let mut note = |block: BlockId, amount: f64| most[block.0] = most[block.0].max(amount);
    for contact in &found.contacts {
        for body in contact.interface.bodies {
            if let BodyId::Block(block) = body {
                for normal in contact.normal_forces {
                    note(block, normal);
                }
                note(block, contact.friction_force.abs());
            }
        }
    }
    for robot in &found.robots {
        for component in [robot.force.x, robot.force.y] {
            note(robot.block, component.abs());
        }
    }
    most
}
