//! Draws the joints that give way in a collapse: a ring at a hinge, and two half arrows at a joint that slides.

use super::canvas::Canvas;
use super::design::{Key, Layer, Mark, along};
use super::fall::{Fall, Joint};
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::Contact;
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path, Stroke};
use crate::products::wording::failure::pair;

/// The ranks of the two entries of the legend.
const HINGE_RANK: u8 = 60;
const SLIP_RANK: u8 = 61;
/// Half the length of the arrows of a slip, and their distance from a force, mm.
const SLIP_REACH: f64 = 1.6;
const CLEAR: f64 = 1.5;

/// A joint of a collapse.
pub(crate) struct Gives<'a> {
    pub contact: &'a Contact,
    pub how: How,
}

/// How a joint gives way.
pub(crate) enum How {
    /// The joint opens about this point.
    Hinge(Point),
    /// The joint slides: the sliding speed of the first body along the tangent, and the corner on which it also tips.
    Slip(f64, Option<Point>),
}

/// Draws the hinges and the slips of a fall. The legend explains the slips of the joints `all`.
pub(crate) fn draw_fall(canvas: &mut Canvas<'_>, fall: &Fall<'_>, all: &[Joint]) {
    draw(canvas, &of_fall(fall), ["hinge".to_owned(), slip_words(all).to_owned()], Place::On);
}

/// Returns the hinges and the slips of a fall, the fastest first. A connected surface that slides has one mark.
pub(crate) fn of_fall<'a>(fall: &Fall<'a>) -> Vec<Gives<'a>> {
    let one = |joint: &Joint| {
        let how = match joint.hinge {
            Some(at) => How::Hinge(at),
            None if joint.slip != 0.0 => How::Slip(joint.slip, joint.touch),
            None => return None,
        };
        Some((joint.speed, Gives { contact: &fall.found.contacts[joint.contact], how }))
    };
    let mut joints: Vec<(f64, Gives<'a>)> = fall.joints.iter().filter_map(one).collect();
    joints.sort_by(|a, b| b.0.total_cmp(&a.0));
    one_per_surface(joints.into_iter().map(|joint| joint.1).collect(), fall.found.length)
}

/// Keeps the middle one of the slips whose joints are connected to one surface.
fn one_per_surface(joints: Vec<Gives<'_>>, length: f64) -> Vec<Gives<'_>> {
    let slides = |joint: &Gives<'_>| matches!(joint.how, How::Slip(_, None));
    let joins = |a: &Gives<'_>, b: &Gives<'_>| {
        let [one, other] = [a, b].map(|joint| &joint.contact.interface);
        let meet = one.ends.iter().any(|p| other.ends.iter().any(|q| (p - q).norm() < 1e-6 * length));
        meet && one.tangent().dot(&other.tangent()).abs() > 0.99
    };
    // The surface of each joint: the index of its first joint.
    let mut surface: Vec<usize> = (0..joints.len()).collect();
    for (i, joint) in joints.iter().enumerate().filter(|(_, joint)| slides(joint)) {
        for j in (0..i).filter(|j| slides(&joints[*j]) && joins(joint, &joints[*j])) {
            let (from, to) = (surface[i].max(surface[j]), surface[i].min(surface[j]));
            surface.iter_mut().filter(|own| **own == from).for_each(|own| *own = to);
        }
    }
    let middle = |first: usize| {
        let own: Vec<usize> = (0..joints.len()).filter(|i| surface[*i] == first).collect();
        let at = |i: usize| joints[i].contact.interface.middle().coords;
        let mean = own.iter().map(|i| at(*i)).sum::<Vector>() / own.len().max(1) as f64;
        own.into_iter().min_by(|a, b| (at(*a) - mean).norm().total_cmp(&(at(*b) - mean).norm()))
    };
    let kept: Vec<usize> = (0..joints.len()).filter_map(|i| middle(surface[i]).filter(|middle| *middle == i)).collect();
    joints.into_iter().enumerate().filter(|(i, _)| kept.contains(i)).map(|(_, joint)| joint).collect()
}

/// Where the marks of a collapse stand.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// On the joints, above everything else.
    On,
    /// Below the forces of the joints, and slips beside them.
    Beside,
}

/// Returns what the legend says about the slips of these joints.
fn slip_words(joints: &[Joint]) -> &'static str {
    let slides = || joints.iter().filter(|joint| joint.slip != 0.0);
    let tips = slides().filter(|joint| joint.touch.is_some()).count();
    match () {
        () if slides().any(|joint| joint.lift != 0.0) => "slides; the gap is part of the model, not real",
        () if tips == 0 => "slides along its joint",
        () if tips < slides().count() => "slides; some joints also tip",
        () => "slides on a corner, and tips",
    }
}

/// Draws the hinges and slips of a collapse, on the bodies where these are drawn. `words` explain a hinge and
/// a slip.
pub(crate) fn draw(canvas: &mut Canvas<'_>, joints: &[Gives<'_>], words: [String; 2], stand: Place) {
    let [hinge_words, slip_words] = words;
    let start = PagePoint::new(0.0, 0.0);
    let symbol = ring(canvas, start.moved(canvas.mm(0.95), 0.0));
    let hinge_key = Key::new(HINGE_RANK, hinge_words, symbol, canvas.mm(1.9));
    let reach = canvas.mm(SLIP_REACH);
    let symbol = half_arrows(canvas, start.moved(reach, 0.0), [(1.0, 0.0); 2], reach);
    let slip_key = Key::new(SLIP_RANK, slip_words, symbol, 2.0 * reach);
    for Gives { contact, how } in joints {
        let interface = &contact.interface;
        // A point of a joint is drawn halfway between its positions on the two bodies.
        let place = |at: Point| {
            let [a, b] = interface.bodies.map(|body| canvas.place_on(body, at));
            a.moved((b.x - a.x) / 2.0, (b.y - a.y) / 2.0)
        };
        let pair = pair(canvas.scene(), interface.bodies);
        let (class, shapes, key, title) = match *how {
            How::Hinge(at) => ("hinge", ring(canvas, place(at)), &hinge_key, format!("Hinge between {pair}")),
            How::Slip(speed, touch) => {
                let tangents = interface.bodies.map(|body| canvas.turn_on(body, interface.tangent()));
                let long = canvas.camera.length(interface.length());
                let reach = canvas.mm(SLIP_REACH);
                let reach = if touch.is_none() && long > 0.0 { reach.min(0.4 * long) } else { reach };
                let at = place(touch.unwrap_or(interface.middle()));
                let at = if stand == Place::Beside { beside(canvas, contact, at) } else { at };
                let shapes = half_arrows(canvas, at, tangents, reach * speed.signum());
                let what = if touch.is_some() { "Slip and tilt" } else { "Slip" };
                ("slip", shapes, &slip_key, format!("{what} between {pair}"))
            }
        };
        // A mark below the forces comes before them in their layer.
        let layer = if stand == Place::Beside { Layer::Force } else { Layer::Symbol };
        let mark = Mark::new(layer, class, shapes).titled(title).keyed(key);
        canvas.put(mark.avoided(0.15));
    }
}

/// Returns the point on the line of a joint where the mark of a slip does not cover its force: in the joint if it is long
/// enough, otherwise beyond its end that is farther from the force.
fn beside(canvas: &Canvas<'_>, contact: &Contact, at: PagePoint) -> PagePoint {
    let [from, to] = contact.interface.ends.map(|end| canvas.place(end));
    let force = canvas.place(contact.resultant.at);
    let (length, clear) = (from.distance(to), canvas.mm(SLIP_REACH + CLEAR));
    if at.distance(force) >= clear || length <= 0.0 {
        return at;
    }
    let (end, other) = if from.distance(force) > to.distance(force) { (from, to) } else { (to, from) };
    let u = ((end.x - other.x) / length, (end.y - other.y) / length);
    let inner = along(end, u, -canvas.mm(SLIP_REACH), 0.0);
    if inner.distance(force) >= clear { inner } else { along(end, u, canvas.mm(SLIP_REACH) + canvas.mm(CLEAR), 0.0) }
}

/// Draws the ring of a hinge.
fn ring(canvas: &Canvas<'_>, at: PagePoint) -> Vec<Path> {
    let (theme, edge) = (canvas.theme(), canvas.mm(0.34));
    vec![canvas.disc(at, 0.85, theme.page).with_stroke(Stroke::new(theme.ink, edge))]
}

/// Draws the two half arrows of a slip. The tangents of the joint on the two bodies are unit vectors on the page, with
/// the first body to their right. `reach` is half the length of an arrow, negative if the first body slides against its
/// tangent.
fn half_arrows(canvas: &Canvas<'_>, at: PagePoint, tangents: [(f64, f64); 2], reach: f64) -> Vec<Path> {
    let theme = canvas.theme();
    // The arrows at short joints are small.
    let small = (reach.abs() / canvas.mm(SLIP_REACH)).clamp(0.45, 1.0);
    let line = |(side, t): (f64, (f64, f64))| {
        let at = |forward: f64, aside: f64| along(at, t, forward * side, canvas.mm(small * (0.55 + aside)) * side);
        let back = (reach.abs() - canvas.mm(0.8 * small)) * reach.signum();
        Outline::line([at(-reach, 0.0), at(reach, 0.0), at(back, 0.6)])
    };
    let lines = [1.0, -1.0].into_iter().zip(tangents).map(line);
    let drawn = |width: f64, ink: Colour| {
        let stroke = canvas.pen(ink, width).mitred();
        lines.clone().map(move |line| Path::stroked(line, stroke.clone())).collect::<Vec<Path>>()
    };
    [drawn(0.8, theme.page), drawn(0.3, theme.ink)].concat()
}
