//! [`arrows`]: creates the arrows of a free-body diagram: the forces on the block, or all forces that may act at its
//! corners, and the unit normals.

use super::super::load_arrows::Solids;
use super::super::option::{Corners, Options};
use super::super::parallel_arrows::{Lane, shifts};
use super::super::pen::SWEEP;
use super::super::unit::unit;
use super::around::{aside, corners, distinct, inward};
use super::arrow::{Arrow, MAX_LENGTH, SHAFT_WIDTH};
use super::force::{Detail, Force, detail, largest};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::analysis::{Analysis, Contact};
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::Camera;
use crate::pictures::drawing::symbol::{Accent, Symbol};

/// Length of an arrow that only names a force, pixels.
const NAMING_LENGTH: f64 = 52.0;
/// Largest length of a friction arrow that only names a force, pixels.
const FRICTION_LENGTH: f64 = 42.0;
/// Length and width of the arrow of a unit normal ŝ, pixels.
const UNIT_NORMAL_LENGTH: f64 = 30.0;
const UNIT_NORMAL_WIDTH: f64 = 1.2;
/// Largest length of a friction arrow that only names a force, as a fraction of the length of the interface. The
/// arrows of the two ends point towards each other.
const FRICTION_REACH: f64 = 0.30;
/// Least length of an arrow that shows a force, pixels. A shorter arrow would be a speck on the outline of the block.
const LEAST_LENGTH: f64 = 14.0;
/// Least length of the arrow of a missing force, pixels. It is longer because this arrow is wider.
const LEAST_MISSING_LENGTH: f64 = 20.0;
/// Forces of interfaces and robots below this fraction of the largest force may be errors of the solver, and have no
/// arrow.
pub(super) const NOISE: f64 = 1e-6;
/// Width of the shaft of a missing force, as a multiple of the width of other shafts.
const MISSING_WIDTH: f64 = 1.4;
/// Radius of a torque arrow, pixels.
const TURN_RADIUS: f64 = 24.0;
/// A block whose diagonal is at least this long on the page, pixels, has arrows of full length.
const FULL_LENGTH_DIAGONAL: f64 = 300.0;

/// Returns the length of the longest arrow of the diagram, in pixels. A small block has shorter arrows, because long
/// arrows would cross each other.
pub(super) fn longest(analysis: &Analysis, block: BlockId, camera: &Camera) -> f64 {
    length_factor(analysis, block, camera) * MAX_LENGTH
}

/// Returns the factor (0.5 to 1) for the lengths of all arrows. It is 1 for a block that is large on the page.
fn length_factor(analysis: &Analysis, block: BlockId, camera: &Camera) -> f64 {
    let bounds = analysis.scene.blocks[block.0].body.polygon.bounds();
    (camera.length(bounds.diagonal()) / FULL_LENGTH_DIAGONAL).clamp(0.5, 1.0)
}

/// Returns the least length of the arrow of a force, pixels.
pub(super) fn least_length(force: &Force) -> f64 {
    match force.is_missing() {
        true => LEAST_MISSING_LENGTH,
        false => LEAST_LENGTH,
    }
}

/// Returns the arrows of the diagram. Their lengths are proportional to the forces, but at least [`least_length`]. With
/// [`Corners::All`] there is an arrow for every force that may act. These arrows only name the forces, so all arrows of
/// one kind have the same length.
pub(super) fn arrows(
    analysis: &Analysis,
    (frame, block): (usize, BlockId),
    contacts: &[&Contact],
    forces: &[Force],
    camera: &Camera,
    options: &Options,
) -> Vec<Arrow> {
    let diagram = Diagram {
        analysis,
        frame,
        block,
        contacts,
        camera,
        options,
        detail: detail(contacts.len(), options),
        naming: options.corners == Corners::All,
        shorter: length_factor(analysis, block, camera),
    };
    let mut arrows = diagram.force_arrows(forces);
    for (number, contact) in contacts.iter().enumerate() {
        if diagram.naming {
            arrows.extend(diagram.corner_arrows(number, contact));
        }
        if diagram.naming || diagram.detail == Detail::Parts {
            arrows.push(diagram.unit_normal(number, contact));
        }
    }
    separate(&mut arrows, camera);
    arrows
}

/// Moves straight arrows that overlap on one line a little to their sides. Only the position of an arrow changes; the
/// list of forces keeps the line of action.
fn separate(arrows: &mut [Arrow], camera: &Camera) {
    let lane = |arrow: &Arrow| {
        let tail = camera.place(arrow.at);
        let along = if arrow.turn.is_none() { arrow.along } else { (0.0, 0.0) };
        Lane { tail: Point::new(tail.x, tail.y), reach: Vector::new(along.0, along.1), width: arrow.width }
    };
    let lanes: Vec<Lane> = arrows.iter().map(lane).collect();
    for (arrow, shift) in arrows.iter_mut().zip(shifts(&lanes)) {
        if shift.norm() > 0.0 {
            arrow.at = camera.back(camera.place(arrow.at).moved(shift.x, shift.y));
        }
    }
}

/// The data that all arrows of a diagram need.
struct Diagram<'a> {
    analysis: &'a Analysis,
    /// The index of the frame, from 0.
    frame: usize,
    block: BlockId,
    contacts: &'a [&'a Contact],
    camera: &'a Camera,
    options: &'a Options,
    detail: Detail,
    /// Whether arrows only name forces, so that their lengths do not show magnitudes.
    naming: bool,
    /// See [`length_factor`].
    shorter: f64,
}

impl Diagram<'_> {
    fn block_name(&self) -> &str {
        &self.analysis.scene.blocks[self.block.0].id
    }

    /// Converts a direction in the scene to a vector on the page. `length` is the length of the result in pixels.
    fn on_page(&self, direction: Vector, length: f64) -> (f64, f64) {
        let (x, y) = self.camera.turn(direction);
        let scale = length / libm::hypot(x, y).max(1e-300);
        (x * scale, y * scale)
    }

    /// Returns a straight arrow for each force, and a circular arrow for each torque. If arrows only name forces, the
    /// forces of interfaces are left out.
    fn force_arrows(&self, forces: &[Force]) -> Vec<Arrow> {
        let solids = Solids::new(&self.analysis.scene, self.frame);
        let edge = unit(&self.analysis.scene, None);
        let largest = largest(forces, edge, self.options);
        let mut arrows = Vec::new();
        for force in forces {
            // If arrows only name forces, `corner_arrows` makes the arrows of the interfaces.
            let of_interface = matches!(force.what, "Normal force" | "Friction force" | "Force")
                && force.colour == self.options.theme.ink;
            if self.naming && of_interface {
                continue;
            }
            let missing = force.is_missing();
            let straight = Arrow {
                symbol: Some(force.symbol.clone()),
                title: force.title(self.block_name(), self.analysis.scene.units),
                at: force.at,
                along: (0.0, 0.0),
                turn: None,
                width: if missing { MISSING_WIDTH * SHAFT_WIDTH } else { SHAFT_WIDTH },
                colour: force.colour,
                hollow: force.is_load(),
                missing,
            };
            if force.torque != 0.0 {
                let given = force.is_missing() || force.is_load();
                if given || force.torque.abs() > NOISE * largest * edge {
                    let turn = Some(SWEEP.copysign(force.torque));
                    arrows.push(Arrow { along: (TURN_RADIUS, 0.0), turn, ..straight });
                }
            } else if force.force.norm() > 0.0 {
                let length = if self.naming {
                    self.shorter * NAMING_LENGTH
                } else {
                    self.length(force, force.force.norm(), largest)
                };
                // A load pushes from outside or hangs from its point; other arrows begin at their points.
                let reach = force.force * (self.camera.metres(length) / force.force.norm());
                let pressed = force.is_load() && solids.pressed(force.at, reach);
                let at = if pressed { force.at - reach } else { force.at };
                arrows.push(Arrow { at, along: self.on_page(force.force, length), ..straight });
            }
        }
        arrows
    }

    /// Returns the length of the arrow of a force of `amount` newtons, pixels, at least [`least_length`]. The arrow of
    /// the force `largest` has the full length. The result is 0 for a very small force of an interface or a robot,
    /// because it may be an error of the solver.
    fn length(&self, force: &Force, amount: f64, largest: f64) -> f64 {
        let given = force.is_missing() || force.is_load() || force.what == "Weight";
        if !given && amount <= NOISE * largest {
            return 0.0;
        }
        let true_length = self.shorter * MAX_LENGTH * amount / largest.max(f64::MIN_POSITIVE);
        true_length.max(least_length(force))
    }

    /// Returns the arrows that name the forces at each corner of an interface: a normal force, and one friction force
    /// in each of the two directions. `number` is the index of the interface, from 0.
    fn corner_arrows(&self, number: usize, contact: &Contact) -> Vec<Arrow> {
        let normal = inward(contact, self.block);
        let left = quarter_turn(normal);
        let [a, b] = contact.application_points;
        let friction =
            (FRICTION_REACH * self.camera.length((b - a).norm())).clamp(14.0, self.shorter * FRICTION_LENGTH);
        let naming = self.shorter * NAMING_LENGTH;
        let mut arrows = Vec::new();
        let given = corners(contact, self.block);
        for (corner, k) in given.iter().take(distinct(contact).len()).zip(1..) {
            let parts = [
                (normal, naming, format!("s{k}"), "Normal force"),
                (left, friction, format!("fl{k}"), "Friction force"),
                (-left, friction, format!("fr{k}"), "Friction force"),
            ];
            for (part, (direction, length, below, what)) in parts.into_iter().enumerate() {
                let symbol = match self.detail {
                    Detail::Parts => Symbol::new("F", Accent::Arrow, &below),
                    _ => Symbol::new("x", Accent::None, &k.to_string()).raised(&format!("({})", number + 1)),
                };
                arrows.push(Arrow {
                    title: format!("{what} {} on block {}", symbol.stated(), self.block_name()),
                    // If several arrows belong to one unknown, only the first of them has the name.
                    symbol: (self.detail == Detail::Parts || part == 0).then_some(symbol),
                    at: corner.at,
                    along: self.on_page(direction, length),
                    turn: None,
                    width: SHAFT_WIDTH,
                    colour: self.options.theme.ink,
                    hollow: false,
                    missing: false,
                });
            }
        }
        arrows
    }

    /// Returns the arrow of the unit normal of an interface, which points into the block. `number` is the index of the
    /// interface, from 0.
    fn unit_normal(&self, number: usize, contact: &Contact) -> Arrow {
        let single = self.contacts.len() == 1;
        let below = if single { String::new() } else { (number + 1).to_string() };
        let symbol = Symbol::new("s", Accent::Hat, &below);
        let clear = FRICTION_LENGTH + 1.2 * self.shorter * UNIT_NORMAL_LENGTH;
        let clear = self.camera.metres(clear);
        Arrow {
            title: format!("Unit normal {} into block {}", symbol.stated(), self.block_name()),
            symbol: Some(symbol),
            at: aside(&self.analysis.scene, contact, self.block, clear, single),
            along: self.on_page(inward(contact, self.block), UNIT_NORMAL_LENGTH),
            turn: None,
            width: UNIT_NORMAL_WIDTH,
            colour: self.options.theme.faint,
            hollow: false,
            missing: false,
        }
    }
}
