//! Draws the set of all forces that a block can carry, as a polygon at the loaded point. Small pictures below show how
//! the structure falls under forces just beyond the longest edges of the polygon.
//!
//! The polygon is the set of the tips of all forces that the block can carry, if each force is drawn with its tail at
//! the loaded point. A polygon that is small compared with its forces would look like a dot. In a figure with one
//! frame, it is therefore drawn next to the structure at a separate scale. Unbounded sets of forces are cut off at a
//! circle, which is not drawn.

mod plan;

use std::rc::Rc;

use plan::Plan;

use super::canvas::Canvas;
use super::design::{Key, Layer, Mark, along, moved_edge, unit};
use super::displacement::{Course, Displacement};
use super::fall::Fall;
use super::option::Options;
use super::panel::{About, Figure, Subject};
use super::placing::Label;
use crate::geometry::{Bounds, Point, in_half_plane};
use crate::mechanics::analysis::{Analysis, CapacityShape};
use crate::pictures::drawing::{Camera, Colour, Outline, PagePoint, Path, Theme};
use crate::products::wording;
use crate::products::wording::number::{quantity, round_below_in};

/// Opacity of the area of carried forces.
const AREA_OPACITY: f64 = 0.34;
/// Width of an edge with and without a number, mm.
const EDGE_WIDTHS: (f64, f64) = (0.45, 0.24);
/// Radius of the dot at the force 0, mm.
const DOT_RADIUS: f64 = 0.65;
/// Largest height of a small picture, and the gap between two of them, mm.
const SMALL_HEIGHT: f64 = 24.0;
const SMALL_GAP: f64 = 5.0;
/// Least length of the arrow in a small picture, mm.
const LEAST_ARROW: f64 = 3.2;
/// Largest length of the arrow that shows the scale, mm.
const MAX_SCALE_ARROW: f64 = 12.0;

/// The figure of the forces that a block can carry.
pub(crate) struct CarriedForces;

impl Figure for CarriedForces {
    fn about(&self) -> About {
        About {
            needs_capacity: true,
            ..About::new(
                "capacity",
                "All forces that a block can carry at a point, and how it falls beyond them; --capacity selects the block",
                "The forces that a block can carry",
            )
        }
    }

    fn subject(&self, analysis: &Analysis, options: &Options, frames: Option<&[usize]>) -> Subject {
        let subject = Subject::structure(analysis, options, frames);
        if subject.is_cut {
            return subject;
        }
        let plans = (0..analysis.frames.len()).filter_map(|frame| Plan::new(analysis, frame));
        let bounds = plans.filter_map(|plan| Bounds::from_points(plan.ring)).fold(subject.bounds, Bounds::union);
        Subject { bounds, ..subject }
    }

    fn words(&self, analysis: &Analysis, frame: usize, _: &Options) -> Vec<String> {
        let found = &analysis.frames[frame];
        match &found.capacity {
            Some(capacity) => wording::capacity::clauses(analysis.given(), found.verdict, capacity),
            None if analysis.frames.iter().any(|f| f.capacity.is_some()) => {
                vec!["the block is not placed in this step".to_owned()]
            }
            None => vec!["the forces that a block can carry were not computed".to_owned()],
        }
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        canvas.mentioned.extend(canvas.found().capacity.iter().map(|capacity| capacity.block));
        if let Some(plan) = Plan::new(canvas.analysis, canvas.number) {
            let before = canvas.number.checked_sub(1);
            if let Some(before) = before.and_then(|frame| Plan::new(canvas.analysis, frame)) {
                earlier(canvas, &before);
            }
            polygon(canvas, &plan);
            small_pictures(canvas, &plan);
        }
    }
}

fn colour(theme: &Theme) -> Colour {
    theme.safe.mixed(theme.ink, 0.15)
}

fn dot(canvas: &Canvas<'_>, at: PagePoint) -> Path {
    let edge = canvas.pen(canvas.theme().ink, 0.28);
    canvas.disc(at, DOT_RADIUS, canvas.theme().page).with_stroke(edge)
}

fn arrow(canvas: &Canvas<'_>, from: PagePoint, to: PagePoint) -> Path {
    let (x, y) = (to.x - from.x, to.y - from.y);
    let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
    let size = canvas.arrow(length, [0.4, 1.4, 1.5], 0.6);
    Path::filled(size.outline(from, (x / length, y / length)), colour(canvas.theme()))
}

/// Draws the polygon of carried forces: its area and its edges with their numbers. If the polygon is at the loaded
/// point, a dot marks the force 0. Otherwise a dotted line leads to it from the loaded point.
fn polygon(canvas: &mut Canvas<'_>, plan: &Plan<'_>) {
    let (theme, ink) = (canvas.theme(), colour(canvas.theme()));
    let words = wording::capacity::ranges(canvas.scene(), plan.capacity);
    let ring: Vec<PagePoint> = plan.ring.iter().map(|p| canvas.place(*p)).collect();
    let mut shapes = Vec::new();
    let area = Path::filled(Outline::ring(ring.clone()), theme.safe).with_opacity(AREA_OPACITY);
    let has_area = ring.len() > 2;
    let ends: Vec<PagePoint> = plan.capacity.at.iter().map(|p| canvas.place(*p)).collect();
    let loaded = Path::stroked(Outline::line(ends.clone()), canvas.pen(ink, 0.6));
    if !plan.is_apart && ends.len() > 1 {
        shapes.push(loaded.clone());
    }
    for side in &plan.sides {
        let [from, to] = side.ends.map(|p| canvas.place(p));
        let width = if side.number.is_some() { EDGE_WIDTHS.0 } else { EDGE_WIDTHS.1 };
        shapes.push(Path::stroked(Outline::line([from, to]), canvas.pen(ink, width)));
        for (end, other, is_open) in [(from, to, side.is_open[0]), (to, from, side.is_open[1])] {
            if is_open {
                shapes.push(Path::filled(open_end(canvas, end, other), ink));
                canvas.explain(open_key(canvas));
            }
        }
        if let Some(number) = side.number {
            let u = (side.outward.x, -side.outward.y);
            let middle = PagePoint::new(0.5 * (from.x + to.x), 0.5 * (from.y + to.y));
            let anchors = vec![along(middle, u, canvas.mm(0.3), 0.0)];
            let label = Label::new(number.to_string(), ink, anchors, number.min(9) as u8);
            canvas.label(Label { bold: true, away: Some(u), ..label });
        }
    }
    if plan.capacity.shape() == CapacityShape::Point {
        let at = canvas.place(plan.zero + plan.capacity.vertices[0].force * plan.scale);
        shapes.push(canvas.disc(at, DOT_RADIUS, ink));
    }
    let key = area_key(canvas, plan);
    let titled = |mark: Mark| mark.titled(format!("Carried forces: {words}")).keyed(&key);
    // Labels may lie on the area, but not on its edges.
    let edges = if has_area {
        canvas.put(titled(Mark::new(Layer::Force, "capacity", vec![area])));
        Mark::new(Layer::Force, "edges", shapes)
    } else {
        titled(Mark::new(Layer::Force, "capacity", shapes))
    };
    canvas.put(edges.avoided(0.1));
    canvas.explain(scale_key(canvas, plan));
    let point = canvas.place(plan.point);
    if plan.is_apart {
        // A dotted line leads from the loaded point to the nearest corner of the polygon.
        let far = |p: &PagePoint| p.distance(point);
        let to = ring.iter().copied().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(point);
        let dotted = canvas.dashes(theme.faint, 0.2, [0.3, 0.6]);
        let place = if ends.len() > 1 { loaded } else { dot(canvas, point) };
        let shapes = vec![Path::stroked(Outline::line([point, to]), dotted), place];
        canvas.put(Mark::new(Layer::Symbol, "leader", shapes).avoided(0.1));
        return;
    }
    let zero = canvas.place(plan.zero);
    if !plan.capacity.contains([0.0, 0.0]) {
        // The block cannot carry the force 0. The arrow from the dot to the middle of the polygon shows that the tails
        // of all forces are at the dot.
        let long = canvas.mm(4.8);
        let symbol = vec![arrow(canvas, PagePoint::new(0.0, 0.0), PagePoint::new(long, 0.0))];
        let words = "example of a carried force";
        let key = Key::new(12, words, symbol, long);
        let shapes = vec![arrow(canvas, zero, canvas.place(plan.middle()))];
        canvas.put(Mark::new(Layer::Symbol, "example", shapes).keyed(&key).avoided(0.1));
    }
    canvas.put(Mark::new(Layer::Symbol, "zero", vec![dot(canvas, zero)]).avoided(0.2));
}

/// Draws the polygon of carried forces of the previous step as a dashed outline.
fn earlier(canvas: &mut Canvas<'_>, plan: &Plan<'_>) {
    let stroke = canvas.dashes(canvas.theme().faint, 0.2, [0.75, 0.55]);
    let key = Key::line(14, "in the previous step", canvas.mm(4.8), stroke.clone());
    let ring = plan.ring.iter().map(|p| canvas.place(*p));
    let mark = Mark::new(Layer::Force, "before", vec![Path::stroked(Outline::ring(ring), stroke)]).keyed(&key);
    canvas.put(mark.titled("The forces that the block could carry in the previous step"));
}

fn area_key(canvas: &Canvas<'_>, plan: &Plan<'_>) -> Rc<Key> {
    let edge = canvas.pen(colour(canvas.theme()), EDGE_WIDTHS.1);
    let drawn = |small: Outline| {
        let area = Path::filled(small.clone(), canvas.theme().safe).with_opacity(AREA_OPACITY);
        vec![area, Path::stroked(small, edge)]
    };
    let words =
        if plan.is_apart { "tips of the carried forces" } else { "tips of the carried forces, tails at the dot" };
    Key::block(10, words, canvas.look, drawn)
}

/// Returns the entry with the scale of the forces.
fn scale_key(canvas: &Canvas<'_>, plan: &Plan<'_>) -> Rc<Key> {
    let units = canvas.scene().units.force();
    let pixels = canvas.camera.length(plan.scale);
    let newtons = round_below_in(canvas.mm(MAX_SCALE_ARROW) / pixels, units);
    let width = newtons * pixels;
    let symbol = vec![arrow(canvas, PagePoint::new(0.0, 0.0), PagePoint::new(width, 0.0))];
    Key::new(13, quantity(newtons, units), symbol, width)
}

fn open_key(canvas: &Canvas<'_>) -> Rc<Key> {
    let (start, end) = (PagePoint::new(0.0, 0.0), PagePoint::new(canvas.mm(3.6), 0.0));
    let ink = colour(canvas.theme());
    let symbol = vec![
        Path::stroked(Outline::line([start, end]), canvas.pen(ink, EDGE_WIDTHS.1)),
        Path::filled(open_end(canvas, end, start), ink),
    ];
    Key::new(15, "without limit", symbol, canvas.mm(4.8))
}

/// Returns a small triangle at `end`, which shows that the edge from `other` continues beyond `end` without limit.
fn open_end(canvas: &Canvas<'_>, end: PagePoint, other: PagePoint) -> Outline {
    let (x, y) = (end.x - other.x, end.y - other.y);
    let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
    let (u, size) = ((x / length, y / length), canvas.mm(1.15));
    Outline::ring(
        [(size, 0.0), (0.0, 0.5 * size), (0.0, -0.5 * size)].map(|(ahead, aside)| along(end, u, ahead, aside)),
    )
}

/// Draws, in a row below the structure, how it falls under forces beyond the numbered edges of the polygon.
fn small_pictures(canvas: &mut Canvas<'_>, plan: &Plan<'_>) {
    let (analysis, frame, scene) = (canvas.analysis, canvas.number, canvas.scene());
    let numbered = &plan.numbers;
    if numbered.is_empty() {
        return;
    }
    let unit = unit(scene, None);
    let courses = canvas.own().courses.get_or_init(|| {
        let course = |edge: &usize| {
            let motions = analysis.edge_mechanism(frame, plan.capacity, *edge);
            // In a small picture, only larger displacements are visible.
            Course::new(&Fall::with(analysis, frame, &motions), 2.0 * unit)
        };
        numbered.iter().map(course).collect()
    });
    let Some(view) = scene.bounds(&scene.frames[frame].placed) else { return };
    let view = view.grown((0.09 * view.diagonal()).max(0.4 * unit));
    let below = canvas.extent();
    let room = if canvas.look.panel.is_finite() { canvas.look.panel } else { below.width };
    let (count, gap) = (numbered.len() as f64, canvas.mm(SMALL_GAP));
    let scale = ((room - count * gap) / count / view.width()).min(canvas.mm(SMALL_HEIGHT) / view.height());
    let scale = scale.min(0.5 * canvas.camera.length(1.0));
    let wide = scale * view.width();
    let left = below.at.x + (below.width - count * wide - (count - 1.0) * gap) / 2.0;
    let top = below.at.y + below.height + canvas.mm(1.5);
    let ink = colour(canvas.theme());
    canvas.note(16, "1, 2, …: falls beyond this edge");
    let size = canvas.label_size();
    for (k, (edge, course)) in numbered.iter().zip(courses).enumerate() {
        let corner = PagePoint::new(left + k as f64 * (wide + gap), top);
        let camera = Camera::new(view, corner, scale);
        let mut shapes = small_picture(canvas, view, &camera, &course.at(1.0));
        // The loaded point begins to move in the direction of the outward normal of the edge.
        let moved = course.at(1.0).get(plan.capacity.block.0).copied().flatten();
        let from = camera.place(moved.map_or(plan.point, |displacement| displacement.moved(plan.point)));
        let normal = plan.capacity.edges[*edge].normal;
        let long = (0.2 * scale * view.width().min(view.height())).max(canvas.mm(LEAST_ARROW));
        shapes.push(arrow(canvas, from, from.moved(normal.x * long, -normal.y * long)));
        let number = k + 1;
        let mark = Mark::new(Layer::Symbol, "mechanism", shapes).avoided(0.0);
        canvas.put(mark.titled(format!("How the structure begins to fall beyond edge {number}")));
        let at = corner.moved(-0.9 * size, scale * view.height() / 2.0);
        canvas.label(Label { bold: true, ..Label::at(at, number.to_string(), ink, 0) });
    }
}

/// Draws the ground and the blocks of a small picture.
fn small_picture(canvas: &Canvas<'_>, view: Bounds, camera: &Camera, moved: &[Option<Displacement>]) -> Vec<Path> {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let mut ground = Outline::default();
    for ring in scene.ground.iter().flat_map(|ground| ground.body.polygon.rings()) {
        let Bounds { min, max } = view;
        let ring = in_half_plane(ring, |p: &Point| min.x - p.x);
        let ring = in_half_plane(&ring, |p: &Point| p.x - max.x);
        let ring = in_half_plane(&ring, |p: &Point| min.y - p.y);
        let ring = in_half_plane(&ring, |p: &Point| p.y - max.y);
        if ring.len() > 2 {
            ground.extend(Outline::ring(ring.iter().map(|p| camera.place(*p))));
        }
    }
    let (mut rest, mut was, mut goes) = (Outline::default(), Outline::default(), Outline::default());
    for id in &canvas.frame().placed {
        let polygon = &scene.blocks[id.0].body.polygon;
        match moved.get(id.0).and_then(Option::as_ref) {
            None => rest.extend(camera.polygon(polygon)),
            Some(displacement) => {
                was.extend(camera.polygon(polygon));
                goes.extend(camera.polygon(&displacement.polygon(polygon)));
            }
        }
    }
    /// Width of the edges of blocks, mm.
    const LINE: f64 = 0.13;
    let dashed = canvas.dashes(theme.rule, LINE, [0.4, 0.3]);
    let fill = theme.page.mixed(theme.motion, 0.38);
    vec![
        Path::filled(ground, theme.ground.mixed(theme.page, 0.6)),
        Path::stroked(was, dashed),
        Path::filled(rest, theme.block).with_stroke(canvas.pen(theme.outline, LINE)),
        Path::filled(goes, fill).with_stroke(canvas.pen(moved_edge(theme), LINE)),
    ]
}
