//! [`joint_marks`] draws the symbols of a mechanism: a ring at each hinge, and two half-arrows at each sliding joint.

use super::super::description;
use super::super::joint::{Joint, joints};
use super::super::legend::Entry;
use super::super::pen::Pen;
use crate::geometry::{Point, Vector};
use crate::mechanics::analysis::{Analysis, Contact, Verdict};
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Group, Item, Outline, PagePoint, Path, Stroke, Theme};

/// Radius of the ring of a hinge, unit lengths.
const HINGE_RADIUS: f64 = 0.085;
/// Length of a half-arrow and its distance from the interface, unit lengths.
const SLIP_ARROW: (f64, f64) = (0.5, 0.11);
/// Length of the barb of a half-arrow, as a fraction of the arrow.
const BARB_LENGTH: f64 = 0.34;

/// Draws the symbols of the mechanism in `analysis`, and adds them to `ink`, so that labels do not cover them. Returns
/// a group for sliding joints and a group for hinges; both are empty if the frame does not fall. `pen` determines the
/// frame and where the blocks are drawn.
pub(crate) fn joint_marks(pen: &Pen<'_>, analysis: &Analysis, ink: &mut Ink) -> [Group; 2] {
    let mut slips = Group::with_class("slips");
    let mut hinges = Group::with_class("hinges");
    let frame_analysis = &analysis.frames[pen.number];
    if frame_analysis.verdict == Verdict::Unstable {
        for joint in joints(analysis, pen.number) {
            let contact = &frame_analysis.contacts[joint.contact];
            if joint.slip != 0.0 {
                slips.items.push(slip(pen, contact, &joint, ink));
            }
            if let Some(at) = joint.hinge {
                hinges.items.push(hinge(pen, contact, at, ink));
            }
        }
    }
    if pen.many() { [joined(slips), joined(hinges)] } else { [slips, hinges] }
}

/// Returns the legend entries for the symbols of these joints.
pub(crate) fn joint_entries(joints: &[Joint]) -> Vec<Entry> {
    let mut entries = Vec::new();
    if joints.iter().any(|j| j.hinge.is_some()) {
        entries.push(Entry::Symbol(ring_symbol, 10.0, "hinge".into()));
    }
    if joints.iter().any(|j| j.slip != 0.0) {
        let any = |is: fn(&Joint) -> bool| joints.iter().any(|j| j.slip != 0.0 && is(j));
        let slides = match (any(|j| j.lift != 0.0), any(|j| j.touch.is_some())) {
            (true, _) => "slides, and lifts by friction coefficient × sliding distance",
            (false, false) => "slides along its joint",
            (false, true) if any(|j| j.touch.is_none()) => "slides; some joints also tip",
            (false, true) => "slides on a corner, and tips",
        };
        entries.push(Entry::Symbol(slip_symbol, 26.0, slides.to_owned()));
    }
    entries
}

/// Joins many symbols of the same kind into a few paths, for frames with very many blocks. The n-th paths of all
/// symbols become one path.
fn joined(marks: Group) -> Group {
    let mut paths: Vec<Path> = Vec::new();
    for mark in marks.items {
        let Item::Group(mark) = mark else { continue };
        let shapes = mark.items.into_iter();
        let shapes = shapes.filter_map(|item| match item {
            Item::Path(path) => Some(path),
            _ => None,
        });
        for (number, path) in shapes.enumerate() {
            match paths.get_mut(number) {
                Some(first) => first.outline.extend(path.outline),
                None => paths.push(path),
            }
        }
    }
    Group { items: paths.into_iter().map(Item::from).collect(), ..Group::with_class(&marks.class) }
}

/// Returns the position at which a point of an interface is drawn after the displacement, metres: halfway between its
/// displaced positions on the two bodies.
fn between(pen: &Pen<'_>, contact: &Contact, at: Point) -> Point {
    let [a, b] = contact.interface.bodies.map(|body| displaced_point(pen, body, at));
    a + (b - a) * 0.5
}

/// Returns the displaced position of a point of a body, metres. The ground is not displaced.
fn displaced_point(pen: &Pen<'_>, body: BodyId, at: Point) -> Point {
    match body {
        BodyId::Ground(_) => at,
        BodyId::Block(id) => pen.moved(id, at),
    }
}

fn ring_radius(pen: &Pen<'_>) -> f64 {
    (HINGE_RADIUS * pen.unit()).clamp(2.6, 6.0)
}

/// Draws a ring at a hinge. `at` is the end of the interface that stays in contact.
fn hinge(pen: &Pen<'_>, contact: &Contact, at: Point, ink: &mut Ink) -> Item {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let (centre, radius) = (pen.camera.place(between(pen, contact, at)), ring_radius(pen));
    ink.disc(centre, radius + 1.0);
    let pair = description::pair(scene, contact.interface.bodies);
    Group::with_class("hinge").titled(format!("Hinge between {pair}")).with(ring(centre, radius, theme)).into()
}

fn ring(centre: PagePoint, radius: f64, theme: &Theme) -> Path {
    let stroke = Stroke::new(theme.ink, (0.36 * radius).max(0.9));
    Path::filled(Outline::circle(centre, radius), theme.page).with_stroke(stroke)
}

/// Draws a half-arrow on each side of a sliding interface. Each half-arrow shows the direction in which the body on its
/// side slides relative to the other body.
fn slip(pen: &Pen<'_>, contact: &Contact, joint: &Joint, ink: &mut Ink) -> Item {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let interface = &contact.interface;
    let unit = pen.context.unit;
    let length = match interface.length() {
        l if l > 0.0 && joint.touch.is_none() => f64::min(SLIP_ARROW.0 * unit, 0.8 * l),
        _ => SLIP_ARROW.0 * unit,
    };
    let middle = between(pen, contact, joint.at);
    let pair = description::pair(scene, interface.bodies);
    let how = match joint.touch {
        Some(_) => "Slip and tilt",
        None => "Slip",
    };
    let mut group = Group::with_class("slip").titled(format!("{how} between {pair}"));
    for (side, body) in [1.0, -1.0].into_iter().zip(interface.bodies) {
        let turned = |v: Vector| match body {
            BodyId::Block(id) => pen.displacement(id).map_or(v, |d| d.turned(v)),
            BodyId::Ground(_) => v,
        };
        let along = turned(interface.tangent()) * (side * joint.slip.signum() * length);
        let aside = turned(interface.normal) * (side * SLIP_ARROW.1 * unit);
        let from = middle + aside - along * 0.5;
        let (from, along, aside) = (pen.camera.place(from), pen.camera.turn(along), pen.camera.turn(aside));
        ink.line(from, from.moved(along.0, along.1), 4.0);
        let width = (0.035 * pen.unit()).clamp(0.8, 1.8);
        group.items.extend(half_arrow(from, along, aside, width, theme));
    }
    group.into()
}

/// Returns a half-arrow with its barb on the side to which `aside` points, and its border in the colour of the page.
/// All lengths are in pixels.
fn half_arrow(from: PagePoint, along: (f64, f64), aside: (f64, f64), width: f64, theme: &Theme) -> [Item; 2] {
    let tip = from.moved(along.0, along.1);
    let reach = libm::hypot(along.0, along.1) / libm::hypot(aside.0, aside.1).max(f64::MIN_POSITIVE);
    let barb =
        tip.moved(BARB_LENGTH * (0.55 * reach * aside.0 - along.0), BARB_LENGTH * (0.55 * reach * aside.1 - along.1));
    let line = Outline::line([from, tip, barb]);
    let seam = Stroke::new(theme.page, width + 2.0);
    [
        Path::stroked(line.clone(), seam).with_opacity(0.85).into(),
        Path::stroked(line, Stroke::new(theme.ink, width)).into(),
    ]
}

fn ring_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![ring(at.moved(5.0, 0.0), 4.5, theme).into()]
}

fn slip_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let mut items = Vec::new();
    items.extend(half_arrow(at.moved(2.0, -2.8), (22.0, 0.0), (0.0, -3.5), 1.4, theme));
    items.extend(half_arrow(at.moved(24.0, 2.8), (-22.0, 0.0), (0.0, 3.5), 1.4, theme));
    items
}
