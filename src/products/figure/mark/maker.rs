//! [`ArrowMaker`]: creates the arrows of weights, loads, and forces of interfaces and robots.

use super::super::arrow::{ArrowKind, ForceArrow, Head, Marks, TurnArrow, TurnKind};
use super::super::option::{Normalisation, Options};
use super::part::parts;
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Contact, FrameAnalysis};
use crate::mechanics::scene::{BodyId, ForceCause, Frame, Scene};
use crate::pictures::drawing::Colour;

/// Forces below this fraction of the largest force are not drawn, because they may be errors of the solver. Forces
/// have a relative accuracy of about 1e-9.
pub(super) const FORCE_TOL: f64 = 1e-6;
/// With [`Normalisation::Drawn`], arrows shorter than this (in unit lengths) have a thinner shaft and a smaller head.
const FULL_WIDTH_LENGTH: f64 = 0.35;
/// Least width of a shaft, as a fraction of the full width. With the full width, arrows of small forces would only be
/// heads.
const MIN_WIDTH_SHARE: f64 = 0.65;

/// Creates the arrows of one frame.
pub(super) struct ArrowMaker<'a> {
    pub scene: &'a Scene,
    pub options: &'a Options,
    /// The unit length, metres.
    pub edge: f64,
    /// The length of the arrow of a force of 1 N, metres.
    pub metres_per_newton: f64,
}

impl ArrowMaker<'_> {
    /// Adds the arrow of a force on the body `on`, unless the force is so small that it may be an error of the solver.
    /// `force` is in newtons. `look` is the colour of the arrow, and the width of its shaft in unit lengths.
    pub(super) fn straight(
        &self,
        marks: &mut Marks,
        kind: ArrowKind,
        on: BodyId,
        at: Point,
        force: Vector,
        look: (Colour, f64),
    ) {
        // Loads are part of the scene. Even a very small load is not an error of the solver.
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

    /// Returns the position of the heads of arrows: beyond the end of the vector in printed figures, otherwise within
    /// the vector.
    pub(super) fn head(&self) -> Head {
        if self.options.printed() { Head::Beyond } else { Head::Within }
    }

    /// Returns the width of an arrow's shaft in metres. `full` is the width of a long arrow, in unit lengths. With
    /// [`Normalisation::Drawn`], short arrows are thinner. `vector` is the arrow in metres.
    pub(super) fn width(&self, full: f64, vector: Vector) -> f64 {
        let share = match self.options.normalisation {
            Normalisation::Source => 1.0,
            Normalisation::Drawn => {
                let length = vector.norm() / self.edge;
                libm::sqrt(length / FULL_WIDTH_LENGTH).clamp(MIN_WIDTH_SHARE, 1.0)
            }
        };
        full * share * self.edge
    }

    /// Adds the arrow of a torque (N·m) on the body `on`, unless the torque is so small that it may be an error of the
    /// solver. In the style of the thesis ([`Options::printed`]), the torque of a robot, or a missing torque, is drawn
    /// as two opposite vertical arrows, half a unit length to the left and to the right of the point `at`.
    pub(super) fn torque(
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
                self.straight(marks, kind, on, at + Vector::new(side * self.edge / 2.0, 0.0), force, look);
            }
        } else {
            marks.turns.push(TurnArrow { on, at, torque, colour: look.0, width: look.1 * self.edge, kind });
        }
    }

    /// Adds the arrows of weights, loads and forces of interfaces to `marks`, block by block in placing order.
    pub(super) fn blocks(&self, frame: &Frame, frame_analysis: &FrameAnalysis, marks: &mut Marks) {
        let (scene, theme) = (self.scene, &self.options.theme);
        let touching = self.contacts_of_blocks(frame_analysis);
        let applied = scene.applied_forces();
        for (place, id) in frame.placed.iter().enumerate() {
            let on = BodyId::Block(*id);
            let look = (theme.arrow(place + 1), theme.widths.force);
            let load_look = (theme.load, theme.widths.robot);
            for applied in &applied[id.0] {
                let (kind, look) = match applied.cause {
                    ForceCause::Weight => (ArrowKind::Weight, look),
                    ForceCause::Load(_) => (ArrowKind::Load, load_look),
                };
                self.straight(marks, kind, on, applied.at, applied.force, look);
                self.torque(marks, TurnKind::Load, on, applied.at, applied.torque, look);
            }
            for contact in &touching[id.0] {
                let [first, second] = contact.interface.bodies;
                let (from, sign) = if first == on { (second, 1.0) } else { (first, -1.0) };
                for part in parts(contact, self.options.style) {
                    let force = part.force * sign;
                    self.straight(marks, (part.kind)(from), on, part.at, force, look);
                }
            }
        }
    }

    /// Returns the contacts of each block, indexed by block.
    fn contacts_of_blocks<'c>(&self, frame_analysis: &'c FrameAnalysis) -> Vec<Vec<&'c Contact>> {
        let mut touching: Vec<Vec<&Contact>> = vec![Vec::new(); self.scene.blocks.len()];
        for contact in &frame_analysis.contacts {
            for body in contact.interface.bodies {
                if let BodyId::Block(block) = body {
                    touching[block.0].push(contact);
                }
            }
        }
        touching
    }

    /// Adds the arrows of the forces and torques of robots to `marks`.
    pub(super) fn robots(&self, frame_analysis: &FrameAnalysis, marks: &mut Marks) {
        let theme = &self.options.theme;
        for robot in &frame_analysis.robots {
            let on = BodyId::Block(robot.block);
            let look = (theme.robot(robot.robot.0), theme.widths.robot);
            self.straight(marks, ArrowKind::Robot(robot.robot), on, robot.at, robot.force, look);
            self.torque(marks, TurnKind::Robot(robot.robot), on, robot.at, robot.torque, look);
        }
    }
}
