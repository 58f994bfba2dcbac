//! [`marks`]: computes the positions, lengths and colours of all arrows of a frame in the look of the thesis, in metres
//! and newtons, before they are drawn.
//!
//! An arrow shows a force *on* a block; no arrows are drawn on the ground. Weights and forces of interfaces have the
//! colour of the block on which they act. Two blocks in contact have opposite arrows. Both begin at the point where the
//! resultant of the interface acts: Σ N_k p_k / Σ N_k for the normal forces N_k at the points p_k
//! ([Vallat23](crate::doc::references) §2.0.9). Arrows of robots are wider. Arrows of missing forces are widest and
//! red. The length of an arrow is proportional to its force; [`Head`] states whether the head counts towards this length.

use super::design::{unit, zoomed_view};
use super::option::{ForceStyle, Normalisation, Options};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::analysis::{Analysis, Contact, Failure, FrameAnalysis};
use crate::mechanics::scene::{BlockId, BodyId, ForceCause, Frame, RobotId, Scene};
use crate::pictures::drawing::Colour;
use crate::pictures::drawing::arrow::HEAD_LENGTH;

/// What a straight arrow shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArrowKind {
    /// The weight of a block.
    Weight,
    /// A load on a block.
    Load,
    /// The sum of normal and friction force, exerted by this body.
    Contact(BodyId),
    /// The normal force of an interface, exerted by this body.
    Normal(BodyId),
    /// The friction force of an interface, exerted by this body.
    Friction(BodyId),
    /// A robot's force.
    Robot(RobotId),
    /// One of the two vertical arrows that show the torque of a robot, in the style of the thesis.
    RobotTorque(RobotId),
    /// A missing pull from this body: adhesion that the structure would need.
    MissingPull(BodyId),
    /// Missing friction from this body.
    MissingFriction(BodyId),
    /// A missing force of a robot: the part of the needed force that exceeds the robot's limits.
    MissingRobotForce(RobotId),
    /// One of the two vertical arrows that show a torque beyond a robot's limit, in the style of the thesis.
    MissingTorque(RobotId),
}

impl ArrowKind {
    /// Returns the body that exerts the force: a block or the ground. Returns `None` for weights, loads, and forces and
    /// torques of robots.
    pub fn partner(self) -> Option<BodyId> {
        match self {
            ArrowKind::Contact(from)
            | ArrowKind::Normal(from)
            | ArrowKind::Friction(from)
            | ArrowKind::MissingPull(from)
            | ArrowKind::MissingFriction(from) => Some(from),
            _ => None,
        }
    }

    /// True if the arrow shows a missing force or torque.
    pub fn is_failure(self) -> bool {
        matches!(
            self,
            ArrowKind::MissingPull(_)
                | ArrowKind::MissingFriction(_)
                | ArrowKind::MissingRobotForce(_)
                | ArrowKind::MissingTorque(_)
        )
    }
}

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
    pub kind: ArrowKind,
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
    let scene = analysis.scene_of(frame);
    let (frame, frame_analysis) = (&scene.frames[frame], &analysis.frames[frame]);
    let edge = unit(scene, options.zoom);
    let near = options.zoom.map(|block| zoomed_view(scene, block));
    let shown = |at: Point| near.is_none_or(|near| near.contains(at));
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
    let scene = analysis.scene_of(frame);
    let options = &options.for_scene(scene);
    let edge = unit(scene, options.zoom);
    let maker = ArrowMaker { scene, options, edge, metres_per_newton: edge / newtons_per_unit };
    maker.blocks(placed, frame_analysis, &mut marks);
    maker.robots(frame_analysis, &mut marks);
    maker.failures(frame_analysis, &mut marks);
    marks
}

/// A force of an interface on the first of its two bodies.
struct InterfaceForce {
    /// A function that returns the kind of the arrow. Its argument is the body that exerts the force.
    pub kind: fn(BodyId) -> ArrowKind,
    /// The force, N.
    pub force: Vector,
    /// The point where it acts, metres.
    pub at: Point,
}

/// Returns the forces of an interface on the first of its two bodies. `style` selects one resultant, or the normal
/// force and the friction force.
fn parts(contact: &Contact, style: ForceStyle) -> Vec<InterfaceForce> {
    let at = contact.resultant.at;
    let part = |kind, force| InterfaceForce { kind, force, at };
    match style {
        ForceStyle::Resultant => {
            let on_first = contact.resultant.on == contact.interface.bodies[0];
            let force = contact.resultant.force;
            vec![part(ArrowKind::Contact, if on_first { force } else { -force })]
        }
        ForceStyle::Components => {
            let normal = contact.interface.normal;
            let pressed: f64 = contact.normal_forces.iter().sum();
            vec![
                part(ArrowKind::Normal, normal * pressed),
                part(ArrowKind::Friction, quarter_turn(normal) * contact.friction_force),
            ]
        }
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

/// Creates the arrows of one frame.
struct ArrowMaker<'a> {
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
    fn straight(&self, marks: &mut Marks, kind: ArrowKind, on: BodyId, at: Point, force: Vector, look: (Colour, f64)) {
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

    /// Adds the arrow of a torque (N·m) on the body `on`, unless the torque is so small that it may be an error of the
    /// solver. In the style of the thesis ([`Options::printed`]), the torque of a robot, or a missing torque, is drawn
    /// as two opposite vertical arrows, half a unit length to the left and to the right of the point `at`.
    fn torque(&self, marks: &mut Marks, kind: TurnKind, on: BodyId, at: Point, torque: f64, look: (Colour, f64)) {
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
    fn blocks(&self, frame: &Frame, frame_analysis: &FrameAnalysis, marks: &mut Marks) {
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
    fn robots(&self, frame_analysis: &FrameAnalysis, marks: &mut Marks) {
        let theme = &self.options.theme;
        for robot in &frame_analysis.robots {
            let on = BodyId::Block(robot.block);
            let look = (theme.robot(robot.robot.0), theme.widths.robot);
            self.straight(marks, ArrowKind::Robot(robot.robot), on, robot.at, robot.force, look);
            self.torque(marks, TurnKind::Robot(robot.robot), on, robot.at, robot.torque, look);
        }
    }
}

/// Length, in unit lengths, of the arrow of a missing force that is as large as the largest force on its block, at the
/// scale of the thesis.
const SOURCE_FAILURE_SCALE: f64 = 0.4;

impl ArrowMaker<'_> {
    /// Adds the arrows of missing forces and torques to `marks`. Every arrow begins at the point where its force would
    /// act. With [`Normalisation::Source`], each block has its own scale of missing forces.
    fn failures(&self, frame_analysis: &FrameAnalysis, marks: &mut Marks) {
        let (colour, full) = (self.options.failure(), self.options.theme.widths.failure);
        let is_source = self.options.normalisation == Normalisation::Source;
        let largest = if is_source { largest_forces_on_blocks(self.scene, frame_analysis) } else { Vec::new() };
        for failure in &frame_analysis.failures {
            let at = failure.at();
            if let Failure::RobotTorque { robot, block, torque, .. } = *failure {
                let look = (colour, full);
                self.torque(marks, TurnKind::Missing(robot), BodyId::Block(block), at, torque, look);
            }
            for (kind, on, force) in missing_forces(failure) {
                let BodyId::Block(block) = on else { continue };
                if force.norm() <= FORCE_TOL * marks.newtons_per_unit {
                    continue;
                }
                let vector = match largest.get(block.0) {
                    Some(largest) if *largest > 0.0 => force * (SOURCE_FAILURE_SCALE * self.edge / largest),
                    _ => force * self.metres_per_newton,
                };
                let (width, head) = (self.width(full, vector), self.head());
                marks.arrows.push(ForceArrow { on, at, vector, force, colour, width, head, kind });
            }
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
