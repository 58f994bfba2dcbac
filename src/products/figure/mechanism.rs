//! Draws the mechanism of a structure that falls: the displaced blocks, their present positions as dashed outlines,
//! hinges and sliding joints.
//!
//! Blocks move along their velocities in finite rigid motions, so they keep their shapes. The amplitude is chosen for
//! visibility, but blocks do not visibly overlap. For each part that falls one elementary mechanism is drawn
//! ([`Analysis::elementary`](crate::analysis::Analysis::elementary)). In the motion that proves a fall, a sliding
//! block also lifts, by μ per metre of sliding. If possible, the block is drawn sliding along its joint; otherwise
//! the legend states that it lifts. With a kernel, a block turns about an end of the safe part, and its corner moves
//! into its neighbour, because the analysis only allows contact forces in the safe part.

use super::arrow::Marks;
use super::collapse;
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::description;
use super::displacement::{Course, Displacement};
use super::joint::{Joint, joints};
use super::label;
use super::legend::{self, Entry};
use super::panel::composed;
use super::pen::{DISPLACED_OPACITY, MIN_READABLE_UNIT_LENGTH, Pen};
use super::thrust;
use super::verdict;
use super::words::quantity;
use crate::analysis::{Analysis, Contact, FrameAnalysis, MarginKind, Motion, Verdict};
use crate::drawing::placement::Ink;
use crate::drawing::{Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Theme};
use crate::geometry::{Bounds, Point, Vector};
use crate::scene::{BlockId, BodyId};
use crate::wording;

/// Radius of the ring of a hinge, unit lengths.
const HINGE_RADIUS: f64 = 0.085;
/// Length of a half-arrow and its distance from the interface, unit lengths.
const SLIP_ARROW: (f64, f64) = (0.5, 0.11);
/// Length of the barb of a half-arrow, as a fraction of the arrow.
const BARB_LENGTH: f64 = 0.34;

/// Returns a box around all displaced blocks, metres; `None` if no block is displaced.
pub(crate) fn reach(analysis: &Analysis, displaced: &[Option<Displacement>]) -> Option<Bounds> {
    let blocks = displaced.iter().zip(&analysis.scene.blocks);
    let moved = blocks.filter_map(|(displacement, block)| Some((displacement.as_ref()?, block)));
    Bounds::from_points(moved.flat_map(|(displacement, block)| {
        let outline = block.body.polygon.outline().iter();
        outline.map(|p| displacement.moved(*p))
    }))
}

/// The figure of a collapse mechanism.
pub(crate) struct Mechanism;

impl PanelContent for Mechanism {
    fn about(&self) -> About {
        About {
            name: "mechanism",
            help: "How the structure falls: blocks displaced along the mechanism, hinges and slips",
            title: "How a dry-laid structure falls",
            needs_elementary_mechanisms: true,
            ..About::default()
        }
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        let falls = |frame: &FrameAnalysis| frame.verdict == Verdict::Unstable;
        match analysis.frames.iter().any(falls) {
            true => &[MarginKind::LoadFactor, MarginKind::Friction],
            false => &[],
        }
    }

    fn course(&self, analysis: &Analysis, frame: usize, unit: f64) -> Course {
        Course::new(analysis, frame, unit)
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        let FrameSource {
            analysis, frame, ..
        } = of;
        thrust::load_scale(&analysis.scene, &analysis.scene.frames[frame], of.options)
    }

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        thrust::marks(of.analysis, of.frame, of.options, newtons_per_unit)
    }

    fn headline(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let frame_analysis = &context.analysis.frames[frame];
        wording::margin::falls_headline(&context.analysis.scene, frame_analysis)
            .unwrap_or_else(|| verdict::badge(frame_analysis).to_owned())
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let how = collapse::reason(context.analysis, frame);
        // Panels next to each other have no room for a longer text.
        let forces = match context.analysis.frames.len() {
            1 => collapse::forces(context.analysis, frame),
            _ => String::new(),
        };
        let parts = [how, forces].into_iter().filter(|part| !part.is_empty());
        parts.collect::<Vec<_>>().join("; ")
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, camera) = (pen.context, pen.camera);
        let mut ink = label::ink(pen);
        let mut blocks = pen.blocks();
        blocks.items.extend(ghosts(pen));
        blocks.items.extend(displaced(pen));
        for (id, _) in moved(pen) {
            for edge in context.analysis.scene.blocks[id.0].body.polygon.edges() {
                let [from, to] = [edge.from, edge.to].map(|p| camera.place(pen.moved(id, p)));
                ink.line(from, to, pen.line);
            }
        }
        let [slips, hinges] = joint_marks(pen, context.analysis, &mut ink);
        let loads = pen.arrows(false);
        composed(pen, view, blocks, vec![slips, hinges, loads], ink)
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        let analysis = context.analysis;
        let falling =
            (0..analysis.frames.len()).filter(|f| analysis.frames[*f].verdict == Verdict::Unstable);
        let mut entries = Vec::new();
        let joints: Vec<Joint> = falling.clone().flat_map(|f| joints(analysis, f)).collect();
        if falling
            .clone()
            .any(|f| !analysis.frames[f].mechanism.is_empty())
        {
            let stood = "where the blocks stand now".to_owned();
            entries.push(Entry::Symbol(ghost_symbol, SYMBOL_WIDTH, stood));
            let goes = "how the blocks begin to move, enlarged".to_owned();
            entries.push(Entry::Symbol(moved_symbol, SYMBOL_WIDTH, goes));
        }
        entries.extend(joint_entries(&joints));
        entries.extend(legend::loads(context));
        entries.extend(legend::robots(context));
        entries
    }
}

/// Draws the symbols of the mechanism in `analysis`: one group for sliding joints, one group for hinges. `pen`
/// determines where the blocks are drawn.
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
    match pen.many() {
        true => [joined(slips), joined(hinges)],
        false => [slips, hinges],
    }
}

/// Returns the legend entries for the symbols of these joints.
pub(crate) fn joint_entries(joints: &[Joint]) -> Vec<Entry> {
    let mut entries = Vec::new();
    if joints.iter().any(|j| j.hinge.is_some()) {
        entries.push(Entry::Symbol(ring_symbol, 10.0, "hinge".into()));
    }
    if joints.iter().any(|j| j.slip != 0.0) {
        let slides = if joints.iter().any(|j| j.lift != 0.0) {
            "slides, and lifts by friction coefficient × distance"
        } else {
            "slides along its joint"
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
    Group {
        items: paths.into_iter().map(Item::from).collect(),
        ..Group::with_class(&marks.class)
    }
}

/// Returns the blocks that are drawn in displaced positions, with their motions in the mechanism.
fn moved<'a>(pen: &'a Pen<'_>) -> impl Iterator<Item = (BlockId, &'a Motion)> {
    let motions = pen.context.analysis.frames[pen.number].mechanism.iter();
    motions
        .map(|m| (m.block, m))
        .filter(|m| pen.displacement(m.0).is_some())
}

/// Draws dashed outlines of the moving blocks in their present positions. Returns `None` if no block moves.
fn ghosts(pen: &Pen<'_>) -> Option<Item> {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let mut outline = Outline::default();
    for (id, _) in moved(pen) {
        outline.extend(pen.camera.polygon(&scene.blocks[id.0].body.polygon));
    }
    let width = pen.line.clamp(0.6, 1.1);
    let stroke = Stroke::new(theme.outline, width).dashed([3.6 * width, 2.8 * width]);
    // Small outlines are partly transparent, so that many of them do not hide the displaced blocks.
    let opacity = if pen.unit() < MIN_READABLE_UNIT_LENGTH {
        0.6
    } else {
        1.0
    };
    let path = Path::stroked(outline, stroke).with_opacity(opacity);
    let ghosts = Group::with_class("ghosts").titled("Where the blocks that move stand now");
    (!path.outline.segments.is_empty()).then(|| ghosts.with(path).into())
}

/// Draws the moving blocks in their displaced positions.
fn displaced(pen: &Pen<'_>) -> Vec<Item> {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let edge = theme.motion.mixed(theme.ink, 0.25);
    let drawn = |group: Group, outline: Outline| -> Item {
        let fill = Path::filled(outline.clone(), theme.motion).with_opacity(DISPLACED_OPACITY);
        let line = Path::stroked(outline, Stroke::new(edge, pen.line));
        group.with(fill).with(line).into()
    };
    let outline = |id: BlockId| {
        let mut outline = Outline::default();
        for ring in scene.blocks[id.0].body.polygon.rings() {
            let corners = ring.iter().map(|p| pen.camera.place(pen.moved(id, *p)));
            outline.extend(Outline::ring(corners));
        }
        outline
    };
    if pen.many() {
        let mut all = Outline::default();
        for (id, _) in moved(pen) {
            all.extend(outline(id));
        }
        let group = Group::with_class("displaced").titled("The blocks that move");
        return vec![drawn(group, all)];
    }
    moved(pen)
        .map(|(id, motion)| {
            let title = description::motion(scene, motion);
            let mut group = Group::with_class("displaced").titled(title);
            let weight = quantity(scene.blocks[id.0].weight, scene.units.force());
            group.description = format!("weight {weight}");
            drawn(group, outline(id))
        })
        .collect()
}

/// Returns the position at which a point of an interface is drawn after the displacement, metres: halfway between its
/// displaced positions on the two bodies.
fn between(pen: &Pen<'_>, contact: &Contact, at: Point) -> Point {
    let [a, b] = contact
        .interface
        .bodies
        .map(|body| displaced_point(pen, body, at));
    a + (b - a) * 0.5
}

/// Returns the displaced position of a point of a body, metres. Ground is not displaced.
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
    let (centre, radius) = (
        pen.camera.place(between(pen, contact, at)),
        ring_radius(pen),
    );
    ink.disc(centre, radius + 1.0);
    let pair = description::pair(scene, contact.interface.bodies);
    Group::with_class("hinge")
        .titled(format!("Hinge between {pair}"))
        .with(ring(centre, radius, theme))
        .into()
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
    let mut group = Group::with_class("slip").titled(format!("Slip between {pair}"));
    for (side, body) in [1.0, -1.0].into_iter().zip(interface.bodies) {
        let turned = |v: Vector| match body {
            BodyId::Block(id) => pen.displacement(id).map_or(v, |d| d.turned(v)),
            BodyId::Ground(_) => v,
        };
        let along = turned(interface.tangent()) * (side * joint.slip.signum() * length);
        let aside = turned(interface.normal) * (side * SLIP_ARROW.1 * unit);
        let from = middle + aside - along * 0.5;
        let (from, along, aside) = (
            pen.camera.place(from),
            pen.camera.turn(along),
            pen.camera.turn(aside),
        );
        ink.line(from, from.moved(along.0, along.1), 4.0);
        let width = (0.035 * pen.unit()).clamp(0.8, 1.8);
        group
            .items
            .extend(half_arrow(from, along, aside, width, theme));
    }
    group.into()
}

/// Returns a half-arrow with its barb on the side to which `aside` points, and its border in the colour of the page.
/// All lengths are in pixels.
fn half_arrow(
    from: PagePoint,
    along: (f64, f64),
    aside: (f64, f64),
    width: f64,
    theme: &Theme,
) -> [Item; 2] {
    let tip = from.moved(along.0, along.1);
    let reach =
        libm::hypot(along.0, along.1) / libm::hypot(aside.0, aside.1).max(f64::MIN_POSITIVE);
    let barb = tip.moved(
        BARB_LENGTH * (0.55 * reach * aside.0 - along.0),
        BARB_LENGTH * (0.55 * reach * aside.1 - along.1),
    );
    let line = Outline::line([from, tip, barb]);
    let seam = Stroke::new(theme.page, width + 2.0);
    [
        Path::stroked(line.clone(), seam).with_opacity(0.85).into(),
        Path::stroked(line, Stroke::new(theme.ink, width)).into(),
    ]
}

/// Width of the sign of a block in the legend, pixels.
const SYMBOL_WIDTH: f64 = 20.0;

fn ghost_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let stroke = Stroke::new(theme.outline, 1.2).dashed([4.0, 3.0]);
    vec![Path::stroked(Outline::rounded(swatch(at), 0.0), stroke).into()]
}

fn moved_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let outline = Outline::rounded(swatch(at), 0.0);
    let edge = Stroke::new(theme.motion.mixed(theme.ink, 0.25), 1.2);
    vec![
        Path::filled(outline.clone(), theme.motion)
            .with_opacity(DISPLACED_OPACITY)
            .into(),
        Path::stroked(outline, edge).into(),
    ]
}

fn swatch(at: PagePoint) -> PageRect {
    PageRect {
        at: at.moved(0.0, -6.5),
        width: SYMBOL_WIDTH,
        height: 13.0,
    }
}

fn ring_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![ring(at.moved(5.0, 0.0), 4.5, theme).into()]
}

fn slip_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let mut items = Vec::new();
    items.extend(half_arrow(
        at.moved(0.0, -3.5),
        (26.0, 0.0),
        (0.0, -3.5),
        1.6,
        theme,
    ));
    items.extend(half_arrow(
        at.moved(26.0, 3.5),
        (-26.0, 0.0),
        (0.0, 3.5),
        1.6,
        theme,
    ));
    items
}
