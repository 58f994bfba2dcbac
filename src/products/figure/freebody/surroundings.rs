//! Finds what a free body has around it: the bodies that touch it, the points at which forces act, and the shown part of
//! the scene. [`places`] lists the coordinates of these points.

use crate::geometry::{Bounds, Point, Vector, in_half_plane, quarter_turn};
use crate::mechanics::analysis::{Analysis, Contact};
use crate::mechanics::scene::{BlockId, BodyId, Scene};
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::pictures::drawing::text::NO_BREAK;
use crate::pictures::drawing::{Face, Item, PagePoint, PageRect, Text, Theme, text};

/// Returns the bodies that touch a block, without duplicates.
pub(super) fn neighbours(contacts: &[&Contact], block: BlockId) -> Vec<BodyId> {
    let mut bodies: Vec<BodyId> = Vec::new();
    for contact in contacts {
        let body = contact.other(BodyId::Block(block));
        if !bodies.contains(&body) {
            bodies.push(body);
        }
    }
    bodies
}

/// Returns the application points of a contact, metres: two points, or one if they coincide.
pub(super) fn distinct(contact: &Contact) -> Vec<Point> {
    let [a, b] = contact.application_points;
    if (b - a).norm() > 1e-9 * (1.0 + contact.interface.length()) { vec![a, b] } else { vec![a] }
}

/// Returns the part of the scene that the figure shows, metres: the whole block, and the nearby parts of the bodies
/// that touch it.
pub(super) fn view(analysis: &Analysis, block: BlockId, contacts: &[&Contact]) -> Bounds {
    let own = analysis.given().blocks[block.0].body.polygon.bounds();
    let near = own.grown(0.42 * own.diagonal());
    let mut view = own.grown(0.06 * own.diagonal());
    for body in neighbours(contacts, block) {
        let bounds = analysis.given().body(body).polygon.bounds();
        let bounds = bounds.grown(0.03 * own.diagonal());
        view = view.union(Bounds { min: bounds.min.sup(&near.min), max: bounds.max.inf(&near.max) });
    }
    view
}

/// The forces of an interface on the block at one of the two application points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// The application point, metres.
    pub at: Point,
    /// Normal force into the block, N.
    pub normal: f64,
    /// Friction force on the block, N. It is positive if it points to the left for a viewer who looks along the unit
    /// normal ŝ into the block.
    pub friction: f64,
}

impl Corner {
    /// Returns the force on the block at this application point, N: the sum of normal force and friction. `normal` is the
    /// unit normal into the block.
    pub(super) fn on_block(self, normal: Vector) -> Vector {
        normal * self.normal + quarter_turn(normal) * self.friction
    }
}

/// Returns the forces on the block at the two application points of an interface. The point to the left of the unit normal ŝ, which
/// points into the block, comes first, as in figures 1 and 2 of the thesis.
///
/// Only the sum of the two friction forces is known, because both act along the interface. The sum is divided in
/// proportion to the normal forces, so that both forces together act at the resultant of the interface. If
/// the two points coincide, the first of them has the whole force and the second none.
pub(super) fn corners(contact: &Contact, block: BlockId) -> [Corner; 2] {
    // Friction is positive along (−n_y, n_x) on the first body. On the second body, the tangent and the force both
    // change their sign, so the number stays the same.
    let friction = contact.friction_force;
    let pressed = contact.normal_force();
    let share = |k: usize| {
        if pressed > 0.0 { contact.normal_forces[k] / pressed } else { 0.5 }
    };
    let corner = |k: usize| Corner {
        at: contact.application_points[k],
        normal: contact.normal_forces[k],
        friction: friction * share(k),
    };
    let [mut first, mut second] = [corner(0), corner(1)];
    if distinct(contact).len() == 1 {
        (first.normal, first.friction) = (pressed, friction);
        (second.normal, second.friction) = (0.0, 0.0);
        return [first, second];
    }
    let left = quarter_turn(inward(contact, block));
    if (first.at - second.at).dot(&left) >= 0.0 { [first, second] } else { [second, first] }
}

/// Returns the unit normal of a contact that points into the block.
pub(super) fn inward(contact: &Contact, block: BlockId) -> Vector {
    if contact.interface.bodies[0] == BodyId::Block(block) {
        contact.interface.normal
    } else {
        -contact.interface.normal
    }
}

/// Returns the point at which the unit normal ŝ is drawn, metres: usually the middle of the interface. If the block has
/// only this interface (`single`), the point is on the outline of the touching body, `clear` metres beyond an end of
/// the interface, if there is space for the arrow.
pub(super) fn aside(scene: &Scene, contact: &Contact, block: BlockId, clear: f64, single: bool) -> Point {
    let interface = &contact.interface;
    let (inward, along) = (inward(contact, block), interface.tangent());
    if !single {
        return interface.middle();
    }
    let neighbour = contact.other(BodyId::Block(block));
    let tries = [interface.ends[1] + along * clear, interface.ends[0] - along * clear];
    let goes_on = |p: &Point| {
        let inside = |beyond: f64| *p + along * beyond - inward * (0.05 * clear);
        let polygon = &scene.body(neighbour).polygon;
        let own = &scene.blocks[block.0].body.polygon;
        [-0.2, 0.0, 0.2].iter().all(|b| polygon.contains(inside(b * clear)))
            && !polygon.contains(*p + inward * (0.05 * clear))
            && !own.contains(*p + inward * (0.05 * clear))
    };
    tries.into_iter().find(goes_on).unwrap_or(interface.middle())
}

/// Returns the part of a ring of points that lies in a rectangle. Parts that are apart may be joined by lines along the
/// edges of the rectangle.
pub(super) fn clipped(ring: &[PagePoint], rect: PageRect) -> Vec<PagePoint> {
    let (right, floor) = (rect.at.x + rect.width, rect.at.y + rect.height);
    // Each side as (a, b, c): a point is inside if a·x + b·y + c ≥ 0.
    let sides = [(1.0, 0.0, -rect.at.x), (-1.0, 0.0, right), (0.0, 1.0, -rect.at.y), (0.0, -1.0, floor)];
    let ring = ring.iter().map(|p| Point::new(p.x, p.y)).collect();
    let cut = |ring: Vec<Point>, (a, b, c): (f64, f64, f64)| in_half_plane(&ring, |p| -(a * p.x + b * p.y + c));
    sides.into_iter().fold(ring, cut).into_iter().map(|p| PagePoint::new(p.x, p.y)).collect()
}

/// Space between values in a row, pixels.
const VALUE_GAP: f64 = 26.0;

/// A part of a row: a symbol, a text or a gap.
#[derive(Clone)]
pub(super) enum Piece {
    Symbol(Symbol),
    Words(String),
    Gap,
}

impl Piece {
    fn width(&self, size: f64) -> f64 {
        match self {
            Piece::Symbol(symbol) => symbol.size(size).0,
            Piece::Words(words) => text::width(words, Face::Serif, size),
            Piece::Gap => VALUE_GAP,
        }
    }

    /// Draws a symbol or a text. `at` is the left end of its baseline, and `size` is the font size in pixels. Also
    /// returns its width in pixels.
    pub(super) fn draw(&self, at: PagePoint, size: f64, theme: &Theme) -> (Vec<Item>, f64) {
        let items = match self {
            Piece::Symbol(symbol) => {
                let (width, height) = symbol.size(size);
                let rect = PageRect { at: at.moved(0.0, -0.98 * size), width, height };
                vec![symbol.draw(rect, size, theme.ink).into()]
            }
            Piece::Words(words) => {
                vec![Text::new(at, words.as_str(), Face::Serif, size, theme.ink).into()]
            }
            Piece::Gap => Vec::new(),
        };
        (items, self.width(size))
    }

    /// Returns the symbol or text as plain text, for screen readers.
    pub(super) fn stated(&self) -> String {
        match self {
            Piece::Symbol(symbol) => symbol.stated(),
            Piece::Words(words) => words.replace(NO_BREAK, " "),
            Piece::Gap => " ".to_owned(),
        }
    }
}

/// Returns the width of a row of symbols and texts, in pixels. `size` is the font size in pixels.
pub(super) fn width(row: &[Piece], size: f64) -> f64 {
    row.iter().map(|p| p.width(size)).sum()
}

/// Distributes values over rows of at most `room` pixels. `size` is the font size in pixels.
pub(super) fn rows(values: &[Vec<Piece>], size: f64, room: f64) -> Vec<Vec<Piece>> {
    let mut rows: Vec<Vec<Piece>> = Vec::new();
    for value in values {
        match rows.last_mut() {
            Some(row) if width(row, size) + VALUE_GAP + width(value, size) <= room => {
                row.push(Piece::Gap);
                row.extend(value.iter().cloned());
            }
            _ => rows.push(value.clone()),
        }
    }
    rows
}

/// Returns the coordinates of the centroid and of the application points, and the components of the unit normals into
/// the block. Each value is a list of symbols and texts, such as `c = (1; 2) m`.
pub(super) fn places(analysis: &Analysis, block: BlockId, contacts: &[&Contact]) -> Vec<Vec<Piece>> {
    let is = |symbol: Symbol, words: String| {
        vec![Piece::Symbol(symbol), Piece::Words(format!("{NO_BREAK}={NO_BREAK}{words}"))]
    };
    let unit = analysis.given().units.length();
    let at = |x: f64, y: f64| {
        let [x, y] = [x, y].map(|v| coordinate(unit.value_from_si(v)));
        format!("({x}; {y}){NO_BREAK}{}", unit.symbol())
    };
    let c = analysis.given().blocks[block.0].centroid;
    let mut places = vec![is(Symbol::new("c", Accent::None, ""), at(c.x, c.y))];
    for contact in contacts {
        let count = distinct(contact).len();
        for (k, corner) in corners(contact, block).iter().enumerate().take(count) {
            let symbol = Symbol::new("p", Accent::None, &(k + 1).to_string());
            places.push(is(symbol, at(corner.at.x, corner.at.y)));
        }
        let s = inward(contact, block);
        let words = format!("({}; {})", coordinate(s.x), coordinate(s.y));
        places.push(is(Symbol::new("s", Accent::Hat, ""), words));
    }
    places
}

/// Formats a coordinate with at most three decimals, without trailing zeros.
fn coordinate(value: f64) -> String {
    crate::text::decimals(value, 3).replace('-', "−")
}
