//! [`marks`]: computes the positions, lengths and colours of all arrows of a frame in the look of the thesis, in metres
//! and newtons, before they are drawn.
//!
//! An arrow shows a force *on* a block; no arrows are drawn on the ground. Weights and forces of interfaces have the
//! colour of the block on which they act. Two blocks in contact have opposite arrows. Both begin at the point where the
//! resultant of the interface acts: Σ N_k p_k / Σ N_k for the normal forces N_k at the points p_k
//! ([Vallat23](crate::doc::references) §2.0.9). Arrows of robots are wider. Arrows of missing forces are widest and
//! red. The length of an arrow is proportional to its force; [`Head`] states whether the head counts towards this length.

use super::design::{unit, zoomed_view};
use super::fill;
use super::option::{ForceStyle, Normalisation, Options};
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{ActingForce, Analysis, Contact, ForceKind, SolvedFrame, acting_forces};
use crate::mechanics::scene::{BodyId, RobotId};
use crate::pictures::drawing::Colour;
use crate::pictures::drawing::arrow::HEAD_LENGTH;

/// Least length from tail to tip of an arrow that is visible, pixels. Shorter arrows are not drawn.
pub(crate) const MIN_VISIBLE_ARROW: f64 = 2.0;

/// The position of an arrow's head.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Head {
    /// Within the vector: the length from tail to tip shows the force.
    Within,
    /// Beyond the vector, as in the figures of the thesis: the length of the shaft shows the force.
    Beyond,
}

/// A straight arrow in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceArrow {
    /// The body on which the force acts.
    pub on: BodyId,
    /// The tail of the arrow, metres.
    pub at: Point,
    /// The vector of the arrow at the scale of the frame, metres: from tail to tip, or only the shaft for
    /// [`Head::Beyond`].
    pub vector: Vector,
    /// The force that the arrow shows, N. For each of the two arrows of a torque, the torque in N·m, divided by the
    /// distance of the two arrows in metres.
    pub force: Vector,
    /// The colour of the arrow.
    pub colour: Colour,
    /// The width of the shaft, metres.
    pub width: f64,
    /// The position of the head.
    pub head: Head,
    /// The kind of force that the arrow shows.
    pub kind: ForceKind,
}

impl ForceArrow {
    /// Returns the vector from the tail of the arrow to the tip of its head, metres.
    pub fn reach(&self) -> Vector {
        let length = self.vector.norm();
        match self.head {
            Head::Beyond if length > 0.0 => self.vector * (1.0 + HEAD_LENGTH * self.width / length),
            _ => self.vector,
        }
    }
}

/// What a torque arrow shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurnKind {
    /// The torque of a load.
    Load,
    /// A robot's torque.
    Robot(RobotId),
    /// A torque beyond a robot's limit.
    Missing(RobotId),
}

/// An arrow along a circle that shows a torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnArrow {
    /// The body on which the torque acts.
    pub on: BodyId,
    /// The centre of the circle, metres.
    pub at: Point,
    /// The torque, N·m, anticlockwise positive.
    pub torque: f64,
    /// The colour of the arrow.
    pub colour: Colour,
    /// The width of the shaft, metres.
    pub width: f64,
    /// The kind of torque that the arrow shows.
    pub kind: TurnKind,
}

/// All arrows of a frame in drawing order: forces on the blocks, block by block, then forces of robots, then missing
/// forces.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Marks {
    /// The arrows of forces.
    pub arrows: Vec<ForceArrow>,
    /// The arrows of torques.
    pub turns: Vec<TurnArrow>,
    /// The force whose arrow is one unit length long, N; 0 if there are no forces. The unit length is a typical size of
    /// the blocks.
    pub newtons_per_unit: f64,
}

/// Returns the smallest number with one significant digit that is at least `amount`. Returns `amount` itself if it is
/// not positive and finite.
pub(crate) fn round_above(amount: f64) -> f64 {
    if !(amount > 0.0 && amount.is_finite()) {
        return amount;
    }
    let power = libm::pow(10.0, libm::floor(libm::log10(amount)));
    let digit = (amount / power * (1.0 - 1e-12)).ceil();
    digit * power
}

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
    let solved @ SolvedFrame { scene, found: frame_analysis, .. } = analysis.at(frame);
    let frame = solved.frame();
    let edge = unit(scene, options.zoom);
    let near = options.zoom.map(|block| zoomed_view(scene, block));
    let shown = |at: Point| near.is_none_or(|near| near.contains(at));
    let is_source = options.normalisation == Normalisation::Source;
    let of_contact = |contact: &Contact| if is_source { Vec::new() } else { parts(contact, options.style) };
    let size = |acting: &ActingForce| match acting.kind {
        kind if is_source && kind.is_failure() => 0.0,
        ForceKind::Robot(_) if is_source => acting.force.amax().max(acting.torque.abs() / edge),
        _ => acting.force.norm().max(acting.torque.abs() / edge),
    };
    let forces = acting_forces(scene, frame, frame_analysis, of_contact);
    let contacts = frame_analysis.contacts.iter().filter(|contact| is_source && shown(contact.resultant.at));
    let forces = forces.iter().filter(|acting| shown(acting.at)).map(size);
    forces.chain(contacts.map(largest_unknown)).fold(0.0, f64::max)
}

/// Returns all arrows of frame `frame` (from 0). The arrow of a force of `newtons_per_unit` newtons is one unit length
/// long.
///
/// The unit length is the side of a lattice cell, or a typical size of a block. There are no arrows if the frame does
/// not exist or `newtons_per_unit` is not above 0.
pub fn marks(analysis: &Analysis, frame: usize, options: &Options, newtons_per_unit: f64) -> Marks {
    let mut marks = Marks { newtons_per_unit, ..Marks::default() };
    let Some(solved @ SolvedFrame { scene, found, .. }) = analysis.each().nth(frame) else { return marks };
    if newtons_per_unit.is_nan() || newtons_per_unit <= 0.0 {
        return marks;
    }
    let options = &options.for_scene(scene);
    let edge = unit(scene, options.zoom);
    let is_source = options.normalisation == Normalisation::Source;
    let largest = if is_source { largest_forces_on_blocks(solved) } else { Vec::new() };
    let mut place = vec![0; scene.blocks.len()];
    solved.frame().placed.iter().enumerate().for_each(|(number, block)| place[block.0] = number);
    let mut forces = acting_forces(scene, solved.frame(), found, |contact| parts(contact, options.style));
    let is_last = |kind: ForceKind| kind.robot().is_some() || kind.is_failure();
    forces.sort_by_key(|acting| if is_last(acting.kind) { usize::MAX } else { place[acting.on.0] });
    let maker = ArrowMaker { options, edge, metres_per_newton: edge / newtons_per_unit, place, largest };
    forces.into_iter().for_each(|acting| maker.add(&mut marks, acting));
    marks
}

/// Returns the forces of an interface on the blocks. `style` selects one resultant, or the normal force and the
/// friction force.
fn parts(contact: &Contact, style: ForceStyle) -> Vec<ActingForce> {
    match style {
        ForceStyle::Resultant => contact.acting(),
        ForceStyle::Components => contact.acting_parts(),
    }
}

/// Forces below this fraction of the largest force are not drawn, because they may be errors of the solver. Forces
/// have a relative accuracy of about 1e-9.
const FORCE_TOL: f64 = 1e-6;
/// With [`Normalisation::Drawn`], arrows shorter than this (in unit lengths) have a thinner shaft and a smaller head.
const FULL_WIDTH_LENGTH: f64 = 0.35;
/// Least width of a shaft, as a fraction of the full width. With the full width, arrows of small forces would only be
/// heads.
const MIN_WIDTH_SHARE: f64 = 0.65;

/// Length, in unit lengths, of the arrow of a missing force that is as large as the largest force on its block, at the
/// scale of the thesis.
const SOURCE_FAILURE_SCALE: f64 = 0.4;

/// Creates the arrows of one frame.
struct ArrowMaker<'a> {
    pub options: &'a Options,
    /// The unit length, metres.
    pub edge: f64,
    /// The length of the arrow of a force of 1 N, metres.
    pub metres_per_newton: f64,
    /// The place of each block in the order of placing, from 0.
    pub place: Vec<usize>,
    /// With [`Normalisation::Source`], the force in N that sets the scale of missing forces on each block; otherwise
    /// empty.
    pub largest: Vec<f64>,
}

impl ArrowMaker<'_> {
    /// Adds the arrows of a force and its torque. Arrows of missing forces begin at the points where the forces would
    /// act.
    fn add(&self, marks: &mut Marks, acting: ActingForce) {
        let theme = &self.options.theme;
        let own = (theme.arrow(self.place[acting.on.0] + 1), theme.widths.force);
        let look = match acting.kind {
            ForceKind::Load => (theme.load, theme.widths.robot),
            ForceKind::Robot(robot) => (theme.robot(robot.0), theme.widths.robot),
            kind if kind.is_failure() => (self.options.failure(), theme.widths.failure),
            _ => own,
        };
        let scale = match self.largest.get(acting.on.0) {
            Some(largest) if acting.kind.is_failure() && *largest > 0.0 => SOURCE_FAILURE_SCALE * self.edge / largest,
            _ => self.metres_per_newton,
        };
        self.straight(marks, &acting, scale, look);
        self.torque(marks, &acting, if acting.kind == ForceKind::Load { own } else { look });
    }

    /// Adds the arrow of a force, unless the force is so small that it may be an error of the solver. `scale` is the
    /// length of the arrow of a force of 1 N, metres. `look` is the colour of the arrow, and the width of its shaft in
    /// unit lengths.
    fn straight(&self, marks: &mut Marks, acting: &ActingForce, scale: f64, look: (Colour, f64)) {
        let ActingForce { on, kind, at, force, .. } = *acting;
        // Loads are part of the scene. Even a very small load is not an error of the solver.
        let least = if kind == ForceKind::Load { 0.0 } else { FORCE_TOL * marks.newtons_per_unit };
        if force.norm() > least {
            let (on, vector) = (BodyId::Block(on), force * scale);
            let (width, head) = (self.width(look.1, vector), self.head());
            marks.arrows.push(ForceArrow { on, at, vector, force, colour: look.0, width, head, kind });
        }
    }

    /// Returns the position of the heads of arrows: beyond the end of the vector in printed figures, otherwise within
    /// the vector.
    fn head(&self) -> Head {
        if self.options.printed() { Head::Beyond } else { Head::Within }
    }

    /// Returns the width of an arrow's shaft in metres. `full` is the width of a long arrow, in unit lengths. With
    /// [`Normalisation::Drawn`], short arrows are thinner. `vector` is the arrow in metres.
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

    /// Adds the arrow of a torque, unless the torque is so small that it may be an error of the solver. In the style of
    /// the thesis ([`Options::printed`]), the torque of a robot, or a missing torque, is drawn as two opposite vertical
    /// arrows, half a unit length to the left and to the right of its point.
    fn torque(&self, marks: &mut Marks, acting: &ActingForce, look: (Colour, f64)) {
        let ActingForce { on, kind, at, torque, .. } = *acting;
        if torque.abs() <= FORCE_TOL * marks.newtons_per_unit * self.edge {
            return;
        }
        let (turn, half) = match kind {
            ForceKind::Robot(robot) => (TurnKind::Robot(robot), Some(ForceKind::RobotTorque(robot))),
            ForceKind::MissingTorque(robot) => (TurnKind::Missing(robot), Some(kind)),
            _ => (TurnKind::Load, None),
        };
        if let Some(kind) = half.filter(|_| self.options.printed()) {
            for side in [1.0, -1.0] {
                let force = Vector::new(0.0, side * torque / self.edge);
                let at = at + Vector::new(side * self.edge / 2.0, 0.0);
                self.straight(marks, &ActingForce { kind, at, force, ..*acting }, self.metres_per_newton, look);
            }
        } else {
            let (on, width) = (BodyId::Block(on), look.1 * self.edge);
            marks.turns.push(TurnArrow { on, at, torque, colour: look.0, width, kind: turn });
        }
    }
}

/// Returns the largest of the normal forces and the friction force of an interface, N.
fn largest_unknown(contact: &Contact) -> f64 {
    contact.normal_forces.into_iter().fold(contact.friction_force.abs(), f64::max)
}

/// Returns, for each block, the largest of these values in N: its weight, the normal forces and the friction forces on
/// it, and the force components of its robots. The list is indexed by block. The thesis scales missing forces by these
/// values.
fn largest_forces_on_blocks(solved: SolvedFrame<'_>) -> Vec<f64> {
    let SolvedFrame { scene, found: frame_analysis, .. } = solved;
    let mut most: Vec<f64> = scene.blocks.iter().map(|b| b.weight).collect();
    fill::raise(&mut most, frame_analysis, largest_unknown);
    for robot in &frame_analysis.robots {
        most[robot.block.0] = most[robot.block.0].max(robot.force.amax());
    }
    most
}
