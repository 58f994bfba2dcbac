//! Creates the arrows of missing forces: forces that would be needed to hold a frame that falls.

use super::super::arrow::{ArrowKind, ForceArrow, Marks, TurnKind};
use super::super::option::Normalisation;
use super::super::parallel_arrows;
use super::maker::{ArrowMaker, FORCE_TOL};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::analysis::{Failure, FrameAnalysis};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::pictures::drawing::{Colour, Theme};

/// Least length of the arrow of the largest missing force, unit lengths. If this arrow is shorter at the scale of the
/// other forces, missing forces have a separate scale. The second number is the least length of the arrow of any
/// missing force.
const MISSING_LENGTHS: (f64, f64) = (0.8, 0.25);
/// Length, in unit lengths, of the arrow of a missing force that is as large as the largest force on its block. The
/// thesis uses this scale.
const SOURCE_FAILURE_SCALE: f64 = 0.4;

/// What determines the length of the arrow of a missing force.
enum MissingScale {
    /// The largest missing force of the frame, N.
    Largest(f64),
    /// The largest single unknown or weight on each block, N, indexed by block; see [`largest_forces_on_blocks`]. The
    /// thesis uses this scale.
    OfBlocks(Vec<f64>),
}

impl ArrowMaker<'_> {
    /// Adds the arrows of missing forces and torques to `marks`.
    pub(super) fn failures(&self, frame_analysis: &FrameAnalysis, marks: &mut Marks) {
        let look = (self.failure_colour(), self.options.theme.widths.failure);
        let scale = self.missing_scale(frame_analysis);
        for failure in &frame_analysis.failures {
            let at = failure.at();
            if let Failure::RobotTorque { robot, block, torque, .. } = *failure {
                let on = BodyId::Block(block);
                self.torque(marks, TurnKind::Missing(robot), on, at, torque, look);
                continue;
            }
            for (kind, on, force) in missing_forces(failure) {
                let BodyId::Block(block) = on else { continue };
                if force.norm() <= FORCE_TOL * marks.newtons_per_unit {
                    continue;
                }
                let vector = self.missing_vector(&scale, block, force);
                let width = self.width(look.1, vector);
                // In printed figures, as in the thesis, every arrow begins at the point where its force acts.
                let at = if self.options.printed() { at } else { self.start_on_block(kind, block, at, vector, width) };
                marks.arrows.push(ForceArrow { on, at, vector, force, colour: look.0, width, head: self.head(), kind });
            }
        }
    }

    /// Returns the colour of missing forces. Printed figures with the theme of the thesis use the red of the thesis.
    /// Other figures use the colour of their theme, so that red and green differ in a grey print.
    fn failure_colour(&self) -> Colour {
        let theme = &self.options.theme;
        if self.options.printed() && *theme == Theme::thesis() { Colour::hex(0xff0000) } else { theme.failure }
    }

    fn missing_scale(&self, frame_analysis: &FrameAnalysis) -> MissingScale {
        match self.options.normalisation {
            Normalisation::Source => MissingScale::OfBlocks(largest_forces_on_blocks(self.scene, frame_analysis)),
            Normalisation::Drawn => {
                let amounts = frame_analysis.failures.iter().map(|failure| failure.force().norm());
                MissingScale::Largest(amounts.fold(0.0, f64::max))
            }
        }
    }

    /// Converts a missing force (N) on a block to the vector of its arrow in metres. `scale` is the scale of missing
    /// forces.
    fn missing_vector(&self, scale: &MissingScale, block: BlockId, force: Vector) -> Vector {
        match scale {
            MissingScale::OfBlocks(largest) if largest[block.0] > 0.0 => {
                force * (SOURCE_FAILURE_SCALE * self.edge / largest[block.0])
            }
            MissingScale::OfBlocks(_) => force * self.metres_per_newton,
            MissingScale::Largest(largest) => {
                let (longest, least) = MISSING_LENGTHS;
                let own = longest * self.edge / largest.max(f64::MIN_POSITIVE);
                let vector = force * self.metres_per_newton.max(own);
                let length = vector.norm().max(f64::MIN_POSITIVE);
                vector * (least * self.edge / length).max(1.0)
            }
        }
    }

    /// Returns the point, in metres, at which the arrow of a missing force begins, so that the arrow lies on the block
    /// on which the force acts.
    ///
    /// A missing pull is moved along its line of action until its head is at the joint. If it began at the joint, it
    /// would lie on the other block and look like a push. Missing friction is moved perpendicular to its direction into
    /// the block, by half the distance between parallel arrows. Other arrows are not moved.
    fn start_on_block(&self, kind: ArrowKind, block: BlockId, at: Point, vector: Vector, width: f64) -> Point {
        match kind {
            ArrowKind::MissingPull(_) => {
                // The arrow ends a little before the joint, so that its head does not touch the opposite arrow.
                let length = vector.norm();
                at - vector * ((length + 0.6 * parallel_arrows::ARROW_GAP * width) / length)
            }
            ArrowKind::MissingFriction(_) => {
                let left = quarter_turn(vector) / vector.norm();
                let across = left * (0.5 * (1.0 + parallel_arrows::ARROW_GAP) * width);
                let polygon = &self.scene.blocks[block.0].body.polygon;
                if polygon.contains(at + across * 0.1) { at + across } else { at - across }
            }
            _ => at,
        }
    }
}

/// Returns the missing forces of a failure: for each, the kind of the arrow, the body on which the force would act, and
/// the force in N. The list is empty for a missing torque.
fn missing_forces(failure: &Failure) -> Vec<(ArrowKind, BodyId, Vector)> {
    match *failure {
        Failure::Tension { bodies: [a, b], force, .. } => {
            vec![(ArrowKind::MissingPull(b), a, force), (ArrowKind::MissingPull(a), b, -force)]
        }
        Failure::Friction { bodies: [a, b], force, .. } => {
            vec![(ArrowKind::MissingFriction(b), a, force), (ArrowKind::MissingFriction(a), b, -force)]
        }
        Failure::RobotForce { robot, block, force, .. } => {
            vec![(ArrowKind::MissingRobotForce(robot), BodyId::Block(block), force)]
        }
        Failure::RobotTorque { .. } => Vec::new(),
    }
}

/// Returns, for each block, the largest of these values in N: its weight, the normal forces and the friction forces on
/// it, and the force components of its robots. The list is indexed by block. The thesis scales missing forces by these
/// values.
fn largest_forces_on_blocks(scene: &Scene, frame_analysis: &FrameAnalysis) -> Vec<f64> {
    let mut most: Vec<f64> = scene.blocks.iter().map(|b| b.weight).collect();
    let mut note = |block: BlockId, amount: f64| most[block.0] = most[block.0].max(amount);
    for contact in &frame_analysis.contacts {
        for body in contact.interface.bodies {
            if let BodyId::Block(block) = body {
                for normal in contact.normal_forces {
                    note(block, normal);
                }
                note(block, contact.friction_force.abs());
            }
        }
    }
    for robot in &frame_analysis.robots {
        for component in [robot.force.x, robot.force.y] {
            note(robot.block, component.abs());
        }
    }
    most
}
