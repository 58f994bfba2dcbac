//! Draws the set of all forces that a block can carry, as a polygon at the loaded point. Small pictures show how the
//! structure falls under forces just beyond the longest edges of the polygon.
//!
//! The polygon is the set of the tips of all forces that the block can carry, if each force is drawn with its tail at
//! the loaded point. A polygon that is small compared with its forces would look like a dot. In a figure with one
//! frame, it is therefore drawn next to the structure at a separate scale. Unbounded sets of forces are cut off at a
//! circle, which is not drawn.

mod plan;

use super::arrow::Marks;
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::displacement::Course;
use super::fall::Fall;
use super::label::{self, Callout};
use super::legend::{self, Entry};
use super::panel::{composed_with, cut_ground};
use super::pen::{DISPLACED_OPACITY, Pen};
use super::words::{quantity, round_below_in};
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::CapacityShape;
use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Anchor, Face, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme};
use crate::products::wording;
use plan::{Plan, SmallPicture};

/// Opacity of the area of carried forces.
const AREA_OPACITY: f64 = 0.34;
/// Width of an edge with and without a number, pixels.
const EDGE_WIDTHS: (f64, f64) = (2.4, 1.3);
/// Radius of the dot at the force 0, pixels.
const DOT_RADIUS: f64 = 3.2;

/// The figure of the forces that a block can carry.
pub(crate) struct CarriedForces;

impl PanelContent for CarriedForces {
    fn about(&self) -> About {
        About {
            name: "capacity",
            help: "All forces that a block can carry at a point, and how it falls beyond them; --capacity selects the block",
            title: "The forces that a block can carry",
            needs_capacity: true,
            lines_cross_names: true,
            ..About::default()
        }
    }

    fn extent(&self, of: FrameSource<'_>, unit: f64, _marks: &Marks) -> Option<Bounds> {
        let plan = Plan::new(of.analysis, of.frame, unit)?;
        Some(plan.bounds()?.grown(0.3 * unit))
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame) = (pen.context, pen.number);
        let mut ink = label::ink(pen);
        let (mut parts, mut callouts) = (Vec::new(), Vec::new());
        if let Some(plan) = Plan::new(context.analysis, frame, context.unit) {
            let before = frame.checked_sub(1);
            let before = before.and_then(|f| Plan::new(context.analysis, f, context.unit));
            parts.extend(before.map(|before| earlier(pen, &before)));
            parts.push(polygon(pen, &plan, &mut ink, &mut callouts));
            for small in &plan.pictures {
                parts.push(picture_of(pen, &plan, small, &mut ink));
            }
        }
        parts.push(pen.arrows(false));
        let mut picture = composed_with(pen, view, pen.blocks(), parts, callouts, ink);
        cut_ground(pen, &mut picture);
        picture
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let analysis = context.analysis;
        let frames = 0..analysis.frames.len();
        let plans = frames.filter_map(|frame| Plan::new(analysis, frame, context.unit));
        let plans: Vec<Plan> = plans.collect();
        let mut entries = Vec::new();
        let Some(first) = plans.first() else {
            return legend::robots(context);
        };
        let area = if first.is_apart {
            "tips of the forces that the block can carry"
        } else {
            "tips of the forces that the block can carry; all tails are at the dot"
        };
        entries.push(Entry::Symbol(area_symbol, 20.0, area.into()));
        if !first.is_apart {
            entries.push(Entry::Symbol(dot_symbol, 10.0, "no force".into()));
        }
        if plans.iter().any(needs_force) {
            let words = "example of a carried force; without one, the structure falls";
            entries.push(Entry::Symbol(force_symbol, 26.0, words.into()));
        }
        if plans.iter().any(|p| !p.capacity.rays.is_empty()) {
            entries.push(Entry::Symbol(open_symbol, 26.0, "continues without limit".into()));
        }
        if plans.len() > 1 {
            entries.push(Entry::Symbol(before_symbol, 26.0, "in the previous step".into()));
        }
        if plans.iter().any(|p| !p.pictures.is_empty()) {
            entries.push(Entry::Symbol(
                number_symbol,
                14.0,
                "how the structure begins to fall just beyond this edge, enlarged".into(),
            ));
        }
        // The legend shows the scale of the forces: an arrow of at most 64 pixels for a round number of newtons.
        let pixels_per_newton = first.scale * unit / context.unit;
        let force = analysis.scene.units.force();
        let newtons = round_below_in(64.0 / pixels_per_newton, force);
        if newtons > 0.0 && newtons.is_finite() {
            let length = newtons * pixels_per_newton;
            entries.push(Entry::Scale(length, 2.6, quantity(newtons, force)));
        }
        entries.extend(legend::loads(context));
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let frame_analysis = &context.analysis.frames[frame];
        match &frame_analysis.capacity {
            Some(capacity) => {
                let scene = &context.analysis.scene;
                wording::capacity::sentences(scene, frame_analysis.verdict, capacity)
            }
            None if context.analysis.frames.iter().any(|f| f.capacity.is_some()) => {
                "the block is not placed in this step".into()
            }
            None => "the forces that a block can carry were not computed".into(),
        }
    }
}

/// Draws the polygon of carried forces: its area and its edges with their numbers. If the polygon is at the loaded
/// point, a dot marks the force 0.
fn polygon(pen: &Pen<'_>, plan: &Plan<'_>, ink: &mut Ink, callouts: &mut Vec<Callout>) -> Group {
    let theme = &pen.context.options.theme;
    let words = wording::capacity::ranges(&pen.context.analysis.scene, plan.capacity);
    let mut group = Group::with_class("capacity").titled(format!("Carried forces: {words}"));
    let ring: Vec<PagePoint> = plan.ring.iter().map(|p| pen.camera.place(*p)).collect();
    if plan.is_apart {
        group = group.with(leader(pen, plan, ink));
    } else if let [first, second] = plan.capacity.at[..] {
        let ends = [first, second].map(|p| pen.camera.place(p));
        ink.line(ends[0], ends[1], 3.2);
        let stroke = Stroke::new(edge_colour(theme), 3.2);
        group = group.with(Path::stroked(Outline::line(ends), stroke));
    }
    if ring.len() > 2 {
        let area = Path::filled(Outline::ring(ring.clone()), theme.safe);
        group = group.with(area.with_opacity(AREA_OPACITY));
    }
    let colour = edge_colour(theme);
    for side in &plan.sides {
        let [from, to] = side.ends.map(|p| pen.camera.place(p));
        let width = if side.number.is_some() { EDGE_WIDTHS.0 } else { EDGE_WIDTHS.1 };
        ink.line(from, to, width);
        let stroke = Stroke::new(colour, width);
        group = group.with(Path::stroked(Outline::line([from, to]), stroke));
        for (end, other, is_open) in [(from, to, side.is_open[0]), (to, from, side.is_open[1])] {
            if is_open {
                group = group.with(Path::filled(open_end(end, other), colour));
            }
        }
        if let Some(number) = side.number {
            let middle = PagePoint::new(0.5 * (from.x + to.x), 0.5 * (from.y + to.y));
            let (x, y) = pen.camera.turn(side.outward * 1.0);
            let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
            callouts.push(Callout {
                at: middle.moved(3.0 * x / length, 3.0 * y / length),
                clear: 3.0,
                words: number.to_string(),
                colour,
            });
        }
    }
    if plan.capacity.shape() == CapacityShape::Point {
        let at = pen.camera.place(plan.zero + plan.capacity.vertices[0].force * plan.scale);
        ink.disc(at, DOT_RADIUS);
        group = group.with(Path::filled(Outline::circle(at, DOT_RADIUS), colour));
    }
    if !plan.is_apart {
        group = with_zero(group, pen, plan, ink);
    }
    group
}

/// True if the polygon is drawn at the loaded point, and the structure falls if no force acts on this point.
fn needs_force(plan: &Plan<'_>) -> bool {
    !plan.is_apart && !plan.capacity.contains([0.0, 0.0])
}

/// Adds a dot for the force 0 to `group`. If the structure falls without a force, also adds an arrow: an example of a
/// force that the block can carry.
fn with_zero(mut group: Group, pen: &Pen<'_>, plan: &Plan<'_>, ink: &mut Ink) -> Group {
    let theme = &pen.context.options.theme;
    let at = pen.camera.place(plan.zero);
    if needs_force(plan) {
        // The block cannot carry the force 0. The arrow from the dot to the middle of the polygon shows that the tails
        // of all forces are at the dot.
        let to = pen.camera.place(plan.middle());
        let along = (to.x - at.x, to.y - at.y);
        ink.arrow(at, along, 2.0);
        group = group.with(Path::filled(straight(at, along, 2.0), edge_colour(theme)));
    }
    ink.disc(at, DOT_RADIUS + 1.0);
    group.with(dot(at, theme))
}

/// Draws a dotted line from the loaded point to a polygon that is drawn apart from it. Marks the loaded point, or the
/// segment between the two loaded points.
fn leader(pen: &Pen<'_>, plan: &Plan<'_>, ink: &mut Ink) -> Group {
    let theme = &pen.context.options.theme;
    let from = pen.camera.place(plan.point);
    let nearest = plan.ring.iter().min_by(|a, b| a.x.total_cmp(&b.x));
    let to = nearest.map_or(from, |p| pen.camera.place(*p));
    ink.line(from, to, 1.0);
    let dotted = Stroke::new(theme.faint, 1.0).dashed([1.5, 3.0]);
    let mut group = Group::with_class("leader");
    group = group.with(Path::stroked(Outline::line([from, to]), dotted));
    let ends: Vec<PagePoint> = plan.capacity.at.iter().map(|p| pen.camera.place(*p)).collect();
    if ends.len() > 1 {
        let stroke = Stroke::new(edge_colour(theme), 3.2);
        group = group.with(Path::stroked(Outline::line(ends), stroke));
    } else {
        group = group.with(dot(from, theme));
    }
    group
}

/// Draws the polygon of carried forces of the previous step as a dashed outline. `plan` is the plan of that step.
fn earlier(pen: &Pen<'_>, plan: &Plan<'_>) -> Group {
    let theme = &pen.context.options.theme;
    let ring = plan.ring.iter().map(|p| pen.camera.place(*p));
    let path = Path::stroked(Outline::ring(ring), before_stroke(theme));
    Group::with_class("before").titled("The forces that the block could carry in the previous step").with(path)
}

fn before_stroke(theme: &Theme) -> Stroke {
    Stroke::new(theme.faint, 1.0).dashed([4.0, 3.0])
}

/// Draws a small picture of the mechanism beyond an edge of the polygon. The picture shows the number of the edge, and
/// an arrow in the direction in which the loaded point begins to move.
fn picture_of(pen: &Pen<'_>, plan: &Plan<'_>, small: &SmallPicture, ink: &mut Ink) -> Group {
    let (analysis, theme) = (pen.context.analysis, &pen.context.options.theme);
    let scene = &analysis.scene;
    let place = |point: Point| pen.camera.place(small.place(point));
    let shown = pen.camera.rect(small.bounds());
    ink.rect(shown);
    let fall = Fall::with(analysis, pen.number, &small.mechanism);
    let moved = Course::new(&fall, pen.context.unit / small.scale.sqrt()).at(1.0);
    let line = Stroke::new(theme.outline, (0.6 * pen.line).max(0.5));
    let mut group = Group::with_class("mechanism");
    group = group.titled(format!("How the structure begins to fall beyond edge {}", small.number));
    group = group.with(small_ground(pen, shown, &place));
    let (mut rest, mut was, mut goes) = (Outline::default(), Outline::default(), Outline::default());
    for id in &scene.frames[pen.number].placed {
        let displaced = moved.get(id.0).and_then(Option::as_ref);
        for ring in scene.blocks[id.0].body.polygon.rings() {
            let here = Outline::ring(ring.iter().map(|p| place(*p)));
            match displaced {
                None => rest.extend(here),
                Some(d) => {
                    was.extend(here);
                    goes.extend(Outline::ring(ring.iter().map(|p| place(d.moved(*p)))));
                }
            }
        }
    }
    let dashed = Stroke::new(theme.rule, 0.7).dashed([2.0, 1.6]);
    group = group.with(Path::stroked(was, dashed)).with(Path::filled(rest, theme.block).with_stroke(line.clone()));
    let fill = theme.page.mixed(theme.motion, DISPLACED_OPACITY);
    let edge = theme.motion.mixed(theme.ink, 0.25);
    group = group.with(Path::filled(goes, fill).with_stroke(Stroke::new(edge, line.width)));
    // The loaded point begins to move in the direction of the outward normal of the edge. The arrow has this direction.
    let own = moved.get(plan.capacity.block.0).and_then(Option::as_ref);
    let from = place(own.map_or(plan.point, |d| d.moved(plan.point)));
    // An arrow shorter than 17 pixels would have no visible shaft on a narrow page.
    let length = (0.2 * shown.width.min(shown.height)).max(17.0);
    let along = (small.outward.x * length, -small.outward.y * length);
    group = group.with(Path::filled(straight(from, along, 1.6), edge_colour(theme)));
    // Write the number to the left of the picture, because a low and wide picture has no free corner.
    let at = PagePoint::new(shown.at.x - 1.0, shown.at.y + 0.5 * shown.height + 0.36 * theme.sizes.amount);
    ink.disc(at.moved(-3.0, -0.36 * theme.sizes.amount), 4.0);
    let number = Text::new(at, small.number.to_string(), Face::SansBold, theme.sizes.amount, edge_colour(theme));
    group.with(number.anchored(Anchor::End))
}

/// Draws the ground in a small picture. `place` converts a point of the scene to a point of the page.
fn small_ground(pen: &Pen<'_>, shown: PageRect, place: &impl Fn(Point) -> PagePoint) -> Group {
    let mut ground = Group { clip: Some(shown), ..Group::with_class("ground") };
    for body in &pen.context.analysis.scene.ground {
        let mut outline = Outline::default();
        for ring in body.body.polygon.rings() {
            outline.extend(Outline::ring(ring.iter().map(|p| place(*p))));
        }
        ground = ground.with(Path::filled(outline, pen.context.options.theme.ground));
    }
    ground
}

fn edge_colour(theme: &Theme) -> crate::pictures::drawing::Colour {
    theme.safe.mixed(theme.ink, 0.15)
}

fn dot(at: PagePoint, theme: &Theme) -> Path {
    Path::filled(Outline::circle(at, DOT_RADIUS), theme.page).with_stroke(Stroke::new(theme.ink, 1.5))
}

/// Returns a small triangle at `end`, which shows that the edge from `other` continues beyond `end` without limit.
fn open_end(end: PagePoint, other: PagePoint) -> Outline {
    let (x, y) = (end.x - other.x, end.y - other.y);
    let length = libm::hypot(x, y).max(f64::MIN_POSITIVE);
    let (x, y) = (x / length, y / length);
    let size = 6.0;
    Outline::ring([
        end.moved(size * x, size * y),
        end.moved(-0.5 * size * y, 0.5 * size * x),
        end.moved(0.5 * size * y, -0.5 * size * x),
    ])
}

fn area_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let swatch = PageRect { at: at.moved(0.0, -6.5), width: 20.0, height: 13.0 };
    let outline = Outline::rounded(swatch, 0.0);
    vec![
        Path::filled(outline.clone(), theme.safe).with_opacity(AREA_OPACITY).into(),
        Path::stroked(outline, Stroke::new(edge_colour(theme), EDGE_WIDTHS.1)).into(),
    ]
}

fn force_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![Path::filled(straight(at, (26.0, 0.0), 2.0), edge_colour(theme)).into()]
}

fn dot_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![dot(at.moved(5.0, 0.0), theme).into()]
}

fn open_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let end = at.moved(19.0, 0.0);
    let stroke = Stroke::new(edge_colour(theme), EDGE_WIDTHS.1);
    vec![
        Path::stroked(Outline::line([at, end]), stroke).into(),
        Path::filled(open_end(end, at), edge_colour(theme)).into(),
    ]
}

fn before_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(26.0, 0.0)]);
    vec![Path::stroked(line, before_stroke(theme)).into()]
}

fn number_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let size = theme.sizes.amount;
    let at = at.moved(2.0, 0.36 * size);
    vec![Text::new(at, "1", Face::SansBold, size, edge_colour(theme)).into()]
}
