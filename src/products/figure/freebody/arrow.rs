//! [`Arrow`]: the position, shape and name of an arrow of a free body. [`Arrows`] makes them: the forces on the block,
//! or all forces that may act at its corners, and the unit normals.

use super::Body;
use super::force::{Detail, Force, detail};
use super::surroundings::{aside, corners, distinct, inward};
use crate::geometry::{Point, Vector, quarter_turn};
use crate::mechanics::analysis::Contact;
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::pictures::drawing::{Colour, PagePoint, Path};
use crate::products::figure::arrow::MIN_VISIBLE_ARROW;
use crate::products::figure::canvas::Canvas;
use crate::products::figure::design::{ArrowSize, along, unit};
use crate::products::figure::option::Corners;
use crate::products::figure::parallel_arrows::{Lane, shifts};
use crate::products::figure::{load, stage};

/// Length of the longest arrow, mm.
const MAX_LENGTH: f64 = 12.0;
/// Length of an arrow that only names a force, mm.
const NAMING_LENGTH: f64 = 9.7;
/// Largest length of a friction arrow that only names a force, mm.
const FRICTION_LENGTH: f64 = 7.8;
/// Length of the arrow of a unit normal ŝ, mm, and the width of its shaft as a multiple of other shafts.
const UNIT_NORMAL_LENGTH: f64 = 5.6;
const UNIT_NORMAL_WIDTH: f64 = 0.5;
/// Largest length of a friction arrow that only names a force, as a fraction of the length of the interface. The
/// arrows of the two ends point towards each other.
const FRICTION_REACH: f64 = 0.30;
/// Least length of an arrow that shows a force, mm. A shorter arrow would be a speck on the outline of the block.
const LEAST_LENGTH: f64 = 2.65;
/// Least length of the arrow of a missing force, mm. It is longer because this arrow is wider.
const LEAST_MISSING_LENGTH: f64 = 3.8;
/// Forces of interfaces and robots below this fraction of the largest force may be errors of the solver, and have no
/// arrow.
pub(super) const NOISE: f64 = 1e-6;
/// Width of the shaft of a missing force, as a multiple of the width of other shafts.
const MISSING_WIDTH: f64 = 1.4;
/// Radius and width of a torque arrow, and the distance of the arcs of several torques at one point, mm.
const TORQUE_SIZES: (f64, f64) = (4.2, 0.45);
const TORQUE_STEP: f64 = 1.8;
/// A block whose diagonal is at least this long on the page, mm, has arrows of full length.
const FULL_LENGTH_DIAGONAL: f64 = 56.0;

/// An arrow of a free body.
#[derive(Clone, Debug)]
pub(super) struct Arrow {
    /// The name next to the arrow; `None` if another arrow of the same unknown has the name.
    pub symbol: Option<Symbol>,
    /// The tooltip.
    pub title: String,
    /// The tail of the arrow, or the centre of a torque arrow.
    pub at: PagePoint,
    /// The unit vector from the tail to the tip on the page, and the length of the arrow or the radius of a torque arrow
    /// in pixels.
    pub u: (f64, f64),
    pub length: f64,
    /// The torque, N·m, anticlockwise positive; `None` for a straight arrow.
    pub torque: Option<f64>,
    /// The width of the shaft as a multiple of the usual width.
    pub width: f64,
    pub colour: Colour,
    /// Whether the arrow is hollow, like the arrows of loads.
    pub hollow: bool,
    /// Whether the arrow shows a missing force, which is drawn above all others.
    pub missing: bool,
}

/// Returns the sizes of an arrow of this length in pixels. `width` is a multiple of the usual width.
pub(super) fn size(canvas: &Canvas<'_>, length: f64, width: f64) -> ArrowSize {
    canvas.arrow(length, [0.45 * width, 1.6 * width, 1.9 * width], 0.62)
}

impl Arrow {
    /// True if the arrow is long enough to be seen.
    pub(super) fn is_seen(&self) -> bool {
        self.torque.is_some() || self.length >= MIN_VISIBLE_ARROW
    }

    /// Returns the shapes of the arrow.
    pub(super) fn shapes(&self, canvas: &Canvas<'_>) -> Vec<Path> {
        let page = canvas.theme().page;
        if let Some(torque) = self.torque {
            let sizes = (self.length / canvas.mm(1.0), self.width * TORQUE_SIZES.1);
            return stage::torque(canvas, self.at, torque, sizes, self.colour);
        }
        let outline = size(canvas, self.length, if self.hollow { 1.5 } else { self.width }).outline(self.at, self.u);
        if self.hollow {
            return vec![Path::filled(outline, page).with_stroke(canvas.pen(self.colour, 0.25).mitred())];
        }
        vec![Path::filled(outline, self.colour).cased(page, canvas.mm(0.15))]
    }

    /// Returns the points beside which the name may stand, the best first, and the direction in which it stands best.
    pub(super) fn anchors(&self) -> (Vec<PagePoint>, Option<(f64, f64)>) {
        if self.torque.is_some() {
            let far = self.length;
            return (
                [(1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)].map(|(x, y)| self.at.moved(far * x, far * y)).to_vec(),
                None,
            );
        }
        let at = |share: f64| along(self.at, self.u, share * self.length, 0.0);
        (vec![at(0.8), at(0.5), at(1.0), at(0.2)], None)
    }
}

/// Returns the length of the longest arrow, in pixels. A small block has shorter arrows, because long arrows would cross
/// each other.
pub(super) fn longest(canvas: &Canvas<'_>, block: BlockId) -> f64 {
    length_factor(canvas, block) * canvas.mm(MAX_LENGTH)
}

/// Returns the factor (0.5 to 1) for the lengths of all arrows. It is 1 for a block that is large on the page.
fn length_factor(canvas: &Canvas<'_>, block: BlockId) -> f64 {
    let bounds = canvas.scene().blocks[block.0].body.polygon.bounds();
    (canvas.camera.length(bounds.diagonal()) / canvas.mm(FULL_LENGTH_DIAGONAL)).clamp(0.5, 1.0)
}

/// Returns the least length of the arrow of a force, pixels.
pub(super) fn least_length(canvas: &Canvas<'_>, force: &Force) -> f64 {
    canvas.mm(if force.kind.is_failure() { LEAST_MISSING_LENGTH } else { LEAST_LENGTH })
}

/// Makes the arrows of a free body. Their lengths are proportional to the forces, but at least [`least_length`]. With
/// [`Corners::All`] there is an arrow for every force that may act. These arrows only name the forces, so all arrows of
/// one kind have the same length.
pub(super) struct Arrows<'c, 'a> {
    canvas: &'c Canvas<'a>,
    body: &'c Body<'a>,
    detail: Detail,
    /// Whether arrows only name forces, so that their lengths do not show magnitudes.
    naming: bool,
    /// See [`length_factor`].
    shorter: f64,
}

impl<'c, 'a> Arrows<'c, 'a> {
    pub(super) fn new(canvas: &'c Canvas<'a>, body: &'c Body<'a>) -> Arrows<'c, 'a> {
        let detail = detail(body.contacts.len(), canvas.options);
        let naming = canvas.options.corners == Corners::All;
        Arrows { canvas, body, detail, naming, shorter: length_factor(canvas, body.block) }
    }

    /// Returns all arrows. Arrows that overlap on one line are moved a little to their sides; the table keeps the line
    /// of action.
    pub(super) fn all(&self) -> Vec<Arrow> {
        let mut arrows = self.forces();
        for (number, contact) in self.body.contacts.iter().enumerate() {
            if self.naming {
                arrows.extend(self.corners(number, contact));
            }
            if self.naming || self.detail == Detail::Parts {
                arrows.push(self.unit_normal(number, contact));
            }
        }
        let lane = |arrow: &Arrow| {
            let length = if arrow.torque.is_none() { arrow.length } else { 0.0 };
            let reach = Vector::new(arrow.u.0 * length, arrow.u.1 * length);
            Lane { tail: Point::new(arrow.at.x, arrow.at.y), reach, width: self.canvas.mm(0.45 * arrow.width) }
        };
        let lanes: Vec<Lane> = arrows.iter().map(lane).collect();
        for (arrow, shift) in arrows.iter_mut().zip(shifts(&lanes)) {
            arrow.at = arrow.at.moved(shift.x, shift.y);
        }
        arrows
    }

    fn name(&self) -> &str {
        &self.canvas.scene().blocks[self.body.block.0].id
    }

    /// Returns the unit vector on the page of a direction in the scene.
    fn on_page(&self, direction: Vector) -> (f64, f64) {
        let (x, y) = self.canvas.camera.turn(direction);
        let length = libm::hypot(x, y).max(1e-300);
        (x / length, y / length)
    }

    fn black(&self, title: String, at: Point, direction: Vector, length: f64) -> Arrow {
        Arrow {
            symbol: None,
            title,
            at: self.canvas.place(at),
            u: self.on_page(direction),
            length,
            torque: None,
            width: 1.0,
            colour: self.canvas.theme().ink,
            hollow: false,
            missing: false,
        }
    }

    /// Returns a straight arrow for each force, and an arc for each torque. If arrows only name forces, the forces of
    /// interfaces are left out.
    fn forces(&self) -> Vec<Arrow> {
        let scene = self.canvas.scene();
        let edge = unit(scene, None);
        let largest = self.body.largest(self.canvas);
        let mut arrows = Vec::new();
        for force in &self.body.forces {
            // If arrows only name forces, `corners` makes the arrows of the interfaces.
            if self.naming && force.kind.is_contact() {
                continue;
            }
            let missing = force.kind.is_failure();
            let norm = force.force.norm();
            let is_given = missing || force.kind.is_applied();
            let straight = Arrow {
                symbol: Some(force.symbol.clone()),
                width: if missing { MISSING_WIDTH } else { 1.0 },
                colour: force.colour,
                hollow: force.is_load(),
                missing,
                ..self.black(force.title(self.name(), scene.units), force.at, force.force, 0.0)
            };
            if force.torque != 0.0 {
                if is_given || force.torque.abs() > NOISE * largest * edge {
                    let near =
                        |other: &&Arrow| other.torque.is_some() && other.at.distance(straight.at) < self.canvas.mm(1.0);
                    let here = arrows.iter().filter(near).count() as f64;
                    let length = self.canvas.mm(TORQUE_SIZES.0 + TORQUE_STEP * here);
                    arrows.push(Arrow { torque: Some(force.torque), hollow: false, length, ..straight });
                }
            } else if norm > 0.0 {
                let length = if self.naming {
                    self.shorter * self.canvas.mm(NAMING_LENGTH)
                } else if is_given || norm > NOISE * largest {
                    let share = norm / largest.max(f64::MIN_POSITIVE);
                    (longest(self.canvas, self.body.block) * share).max(least_length(self.canvas, force))
                } else {
                    // The force may be an error of the solver.
                    0.0
                };
                let mut arrow = Arrow { length, ..straight };
                if force.is_load() && self.pushes(force, length) {
                    arrow.at = along(arrow.at, arrow.u, -length, 0.0);
                }
                arrows.push(arrow);
            }
        }
        arrows
    }

    /// True if a load pushes from outside: the block lies rather after its point than before it. Otherwise its arrow
    /// begins at its point.
    fn pushes(&self, load: &Force, length: f64) -> bool {
        let rings = self.canvas.scene().blocks[self.body.block.0].body.polygon.rings();
        let way = load.force * (self.canvas.camera.metres(length) / load.force.norm());
        load::inside_length(rings, load.at, way * -1.0) <= load::inside_length(rings, load.at, way) + 1e-9 * way.norm()
    }

    /// Returns the arrows that name the forces at each corner of an interface: a normal force, and one friction force
    /// in each of the two directions. `number` is the index of the interface, from 0.
    fn corners(&self, number: usize, contact: &Contact) -> Vec<Arrow> {
        let canvas = self.canvas;
        let normal = inward(contact, self.body.block);
        let left = quarter_turn(normal);
        let [a, b] = contact.application_points;
        let room = FRICTION_REACH * canvas.camera.length((b - a).norm());
        let friction = room.clamp(canvas.mm(LEAST_LENGTH), self.shorter * canvas.mm(FRICTION_LENGTH));
        let naming = self.shorter * canvas.mm(NAMING_LENGTH);
        let mut arrows = Vec::new();
        let given = corners(contact, self.body.block);
        for (corner, k) in given.iter().take(distinct(contact).len()).zip(1..) {
            let parts = [
                (normal, naming, format!("s{k}"), "Normal force"),
                (left, friction, format!("fl{k}"), "Friction force"),
                (-left, friction, format!("fr{k}"), "Friction force"),
            ];
            for (part, (direction, length, below, what)) in parts.into_iter().enumerate() {
                let symbol = if self.detail == Detail::Parts {
                    Symbol::new("F", Accent::Arrow, &below)
                } else {
                    Symbol::new("x", Accent::None, &k.to_string()).raised(&format!("({})", number + 1))
                };
                let title = format!("{what} {} on block {}", symbol.stated(), self.name());
                // If several arrows belong to one unknown, only the first of them has the name.
                let symbol = (self.detail == Detail::Parts || part == 0).then_some(symbol);
                arrows.push(Arrow { symbol, ..self.black(title, corner.at, direction, length) });
            }
        }
        arrows
    }

    /// Returns the arrow of the unit normal of an interface, which points into the block. `number` is the index of the
    /// interface, from 0.
    fn unit_normal(&self, number: usize, contact: &Contact) -> Arrow {
        let (canvas, single) = (self.canvas, self.body.contacts.len() == 1);
        let below = if single { String::new() } else { (number + 1).to_string() };
        let symbol = Symbol::new("s", Accent::Hat, &below);
        let clear = canvas.mm(FRICTION_LENGTH + 1.2 * self.shorter * UNIT_NORMAL_LENGTH);
        let at = aside(canvas.scene(), contact, self.body.block, canvas.camera.metres(clear), single);
        let title = format!("Unit normal {} into block {}", symbol.stated(), self.name());
        let arrow = self.black(title, at, inward(contact, self.body.block), canvas.mm(UNIT_NORMAL_LENGTH));
        Arrow { symbol: Some(symbol), width: UNIT_NORMAL_WIDTH, colour: canvas.theme().faint, ..arrow }
    }
}
