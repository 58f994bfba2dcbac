//! Draws the force polygon next to the structure: the external forces on the structure as arrows, each of which begins
//! at the tip of the previous arrow.
//!
//! Its first sides are weights and loads, block by block. Then come the forces of the ground and the robots, and
//! finally missing forces from the ground and from robots, which are hollow and dashed. The polygon is closed if the
//! structure is in equilibrium. Forces that are missing between two blocks are no sides, because they act in opposite
//! pairs. If no other forces are missing, the polygon of a structure that falls is closed too. Each arrow has the same
//! colour and force as on the structure. The polygon has its own scale, which the legend shows.

mod closure;
mod symbol;

use super::arrow::{ArrowKind, ForceArrow, Marks};
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::description;
use super::label;
use super::legend::{self, Entry};
use super::mark;
use super::panel::{composed, cut_ground};
use super::pen::Pen;
use super::unit::unit;
use super::verdict;
use super::view;
use super::words::{letter, listed, quantity, round_below, round_below_in};
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::{Analysis, Verdict};
use crate::mechanics::scene::{BodyId, Unit};
use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Group, Item, Outline, Path, Stroke};
use symbol::{JOIN_SYMBOL, join_stroke, join_symbol, missing, missing_symbol};

/// Largest width and height of the polygon, as a fraction of the larger side of the structure.
const POLYGON_SIZE: f64 = 0.75;
/// Largest height of the polygon as a fraction of the structure's width. If the structure is higher than this, the
/// height of the structure is the limit.
const POLYGON_HEIGHT: f64 = 0.4;
/// Longest arrow that shows the scale of a polygon in the legend, pixels.
const SCALE_ARROW: f64 = 64.0;
/// Gap between structure and polygon as a fraction of the structure's diagonal, and the least gap in unit lengths.
const POLYGON_GAP: (f64, f64) = (0.12, 1.0);
/// A polygon is closed if its gap is at most this fraction of the sum of the magnitudes of all forces. Rounding errors
/// are far smaller, and missing forces are far larger.
const CLOSURE_TOL: f64 = 1e-6;

/// True if a force acts on the structure from outside: a weight, a load, or a force of the ground or a robot. Such a
/// force is a side of the polygon.
fn outside(arrow: &ForceArrow) -> bool {
    !matches!(arrow.kind.partner(), Some(BodyId::Block(_)))
}

/// Returns the forces that are sides of the force polygon of a frame, in drawing order.
fn outer(marks: &Marks) -> impl Iterator<Item = &ForceArrow> {
    marks.arrows.iter().filter(|arrow| outside(arrow))
}

/// The figure of the force polygon.
pub(crate) struct ForcePolygon;

impl PanelContent for ForcePolygon {
    fn about(&self) -> About {
        About {
            name: "polygon",
            help: "The external forces on the structure, and their force polygon next to it",
            title: "The force polygon of a dry-laid structure",
            draws_forces: true,
            stretches_arrows: true,
            ..About::default()
        }
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        mark::largest(of.analysis, of.frame, of.options)
    }

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        let FrameSource { analysis, frame, options } = of;
        let marks = mark::marks(analysis, frame, options, newtons_per_unit);
        let shown = |arrow: &ForceArrow| outside(arrow) || arrow.kind.is_failure();
        let mut arrows: Vec<ForceArrow> = marks.arrows.into_iter().filter(shown).collect();
        arrows.sort_by_key(|arrow| match arrow.kind {
            ArrowKind::Weight | ArrowKind::Load => 0,
            kind if kind.is_failure() => 2,
            _ => 1,
        });
        Marks { arrows, ..marks }
    }

    fn extent(&self, of: FrameSource<'_>, unit: f64, marks: &Marks) -> Option<Bounds> {
        let chain = chain(of.analysis, marks)?;
        let own = Bounds::from_points(chain.sides.into_iter().flatten())?;
        Some(own.grown(0.3 * unit))
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let scene = &pen.context.analysis.scene;
        let mut ink = label::ink(pen);
        let polygon = drawn_polygon(pen, &mut ink);
        let parts = vec![pen.arrows(false), pen.arrows(true), polygon];
        // Keep labels out of the area to the right of the shown ground, where the ground is cut off.
        if let Some(shown) = view::ground_shown(scene, unit(scene, None)) {
            let mut beyond = pen.camera.rect(shown);
            let right = beyond.at.x + beyond.width;
            let page = pen.camera.rect(view);
            beyond.at.x = right;
            beyond.width = (page.at.x + page.width - right).max(0.0);
            ink.rect(beyond);
        }
        let mut picture = composed(pen, view, pen.blocks(), parts, ink);
        // Cut the ground, so that the polygon does not seem to rest on it.
        cut_ground(pen, &mut picture);
        picture
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let mut entries = legend::entries(context, unit);
        // In this figure, the colours of blocks show no quantity, and joints at their limit have no mark.
        entries.retain(|entry| !matches!(entry, Entry::Amplitudes(..)) && !legend::is_limit(entry));
        let mut sides = context.marks.iter().flat_map(outer);
        if sides.any(|arrow| arrow.kind.is_failure()) {
            let what = "side of the polygon that shows a missing force".to_owned();
            entries.push(Entry::Symbol(missing_symbol, 26.0, what));
        }
        let frames = context.marks.iter().enumerate();
        let mut joined = false;
        let scales = frames.filter_map(|(frame, marks)| {
            let chain = chain(context.analysis, marks)?;
            joined |= !chain.joins.is_empty();
            Some((frame, chain.scale * unit / context.unit))
        });
        let scales: Vec<(usize, f64)> = scales.collect();
        if joined {
            let what = "the same corner of the force polygon, drawn at two places".to_owned();
            entries.push(Entry::Symbol(join_symbol, JOIN_SYMBOL, what));
        }
        entries.extend(scale_entries(&scales, context.analysis.scene.units.force()));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let scene = &context.analysis.scene;
        let frame_analysis = &context.analysis.frames[frame];
        let why = verdict::reason(scene, frame_analysis);
        let marks = &context.marks[frame];
        if outer(marks).next().is_none() {
            return why;
        }
        let (how, why) = match (frame_analysis.verdict, closed(outer(marks))) {
            (_, false) => ("the force polygon is open".to_owned(), why),
            (Verdict::Stable, true) => ("the force polygon is closed".to_owned(), why),
            (Verdict::Unstable, true) => closure::reason(scene, frame_analysis, marks),
            (Verdict::Undecided, true) => {
                let how = "the force polygon of the forces found is closed".to_owned();
                (how, why)
            }
        };
        if why.is_empty() { how } else { format!("{how}; {why}") }
    }
}

/// Draws the force polygon of a frame. If actions (weights and loads) and reactions are drawn apart, dashed lines
/// connect the two positions of each common corner. If the polygon is open, a dashed line closes the gap.
fn drawn_polygon(pen: &Pen<'_>, ink: &mut Ink) -> Group {
    let (context, camera) = (pen.context, pen.camera);
    let theme = &context.options.theme;
    let marks = &context.marks[pen.number];
    let mut polygon = Group::with_class("polygon").titled("Force polygon");
    let Some(chain) = chain(context.analysis, marks) else {
        return polygon;
    };
    for (arrow, ends) in outer(marks).zip(&chain.sides) {
        let from = camera.place(ends[0]);
        let along = camera.turn(ends[1] - ends[0]);
        ink.arrow(from, along, pen.width(arrow));
        let outline = straight(from, along, pen.width(arrow));
        let path = if arrow.kind.is_failure() {
            missing(outline, arrow.colour, theme)
        } else {
            Path::filled(outline, arrow.colour)
        };
        let title = description::arrow(context, arrow);
        let drawn = Group::with_class("force").titled(title).with(path);
        polygon.items.push(drawn.into());
    }
    let dashed = |class, title, ends: [Point; 2], stroke| -> Item {
        let line = Outline::line(ends.map(|p| camera.place(p)));
        let drawn = Group::with_class(class).titled(title);
        drawn.with(Path::stroked(line, stroke)).into()
    };
    // If actions and reactions are drawn apart, two dashed lines each connect two positions of the same corner. In an
    // open polygon, the second line would look like the line of the gap, so it is left out.
    let closed = closed(outer(marks));
    for join in chain.joins.iter().take(if closed { 2 } else { 1 }) {
        let title = "The same corner of the force polygon, drawn at two places";
        let stroke = join_stroke(theme);
        polygon.items.push(dashed("join", title, *join, stroke));
    }
    let ends = (chain.sides.last(), chain.sides.first());
    if let ((Some(last), Some(first)), false) = (ends, closed) {
        let stroke = Stroke::new(theme.failure, 1.4).dashed([5.0, 4.0]);
        let title = "The force that is missing for equilibrium";
        let gap = [last[1], first[0]];
        polygon.items.push(dashed("gap", title, gap, stroke));
    }
    polygon
}

/// If two points of a reaction are nearer to an action (a weight or a load) than this fraction of the polygon's size,
/// all reactions are moved sideways, so that they do not cover the actions.
const OVERLAP_SHARE: f64 = 0.03;
/// Distance by which reactions are moved sideways, as a fraction of the polygon's size.
const REACTION_OFFSET: f64 = 0.09;

/// The polygon of a frame: the ends of each arrow in the scene, metres, and the scale.
struct Chain {
    sides: Vec<[Point; 2]>,
    /// Pairs of positions of the same corner, if actions and reactions are drawn apart; otherwise empty.
    joins: Vec<[Point; 2]>,
    /// Metres per newton.
    scale: f64,
}

/// True if sides of reactions would cover sides of actions, because they lie on the same line. `acting` are the corners
/// at the ends of all actions (weights and loads), `answering` those at the ends of all reactions. `size` is the size
/// of the polygon, in the unit of these corners.
fn covers(acting: &[Point], answering: &[Point], size: f64) -> bool {
    let pair = |ends: &[Point]| [ends[0], ends[1]];
    let (acting, answering): (Vec<_>, Vec<_>) =
        (acting.windows(2).map(pair).collect(), answering.windows(2).map(pair).collect());
    // Two sides overlap if the midpoint and the first quarter point of one of them both lie close to the other.
    let from = |[a, b]: [Point; 2], p: Point| {
        let along = b - a;
        let length = along.norm_squared();
        let share = if length > 0.0 { ((p - a).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
        (p - (a + along * share)).norm()
    };
    let lies_on = |short: &[Point; 2], long: &[Point; 2]| {
        let middle = nalgebra::center(&short[0], &short[1]);
        let quarter = nalgebra::center(&short[0], &middle);
        [middle, quarter].iter().all(|p| from(*long, *p) < OVERLAP_SHARE * size)
    };
    acting.iter().any(|a| {
        let mut others = answering.iter();
        others.any(|b| lies_on(a, b) || lies_on(b, a))
    })
}

/// Computes the force polygon of a frame from the external forces among the arrows in `marks`. The polygon is placed to
/// the right of the structure. Returns `None` if no frame has a block, if this frame has fewer than two external
/// forces, or if all of them are 0.
fn chain(analysis: &Analysis, marks: &Marks) -> Option<Chain> {
    let scene = &analysis.scene;
    let blocks = scene.frames.iter().flat_map(|frame| &frame.placed);
    let structure = blocks.map(|id| scene.blocks[id.0].body.polygon.bounds()).reduce(Bounds::union)?;
    // The corners of the polygon, N.
    let mut at = Point::origin();
    let mut corners = vec![at];
    for arrow in outer(marks) {
        at += arrow.force;
        corners.push(at);
    }
    let own = Bounds::from_points(corners.iter().copied()).filter(|_| corners.len() > 2)?;
    let size = own.width().max(own.height());
    if size.is_nan() || size <= 0.0 {
        return None;
    }
    let scale = scale(structure, own, analysis.frames.len() > 1);
    if scale <= 0.0 || !scale.is_finite() {
        return None;
    }
    let answers = |arrow: &ForceArrow| !matches!(arrow.kind, ArrowKind::Weight | ArrowKind::Load);
    let acting = outer(marks).position(answers);
    let acting = acting.unwrap_or(corners.len() - 1);
    let aside = if covers(&corners[..=acting], &corners[acting..], size) { REACTION_OFFSET * size } else { 0.0 };
    let (share, least) = POLYGON_GAP;
    let apart = (share * structure.diagonal()).max(least * unit(scene, None));
    // Place the polygon to the right of the structure and its ground, at the height of the middle of the structure.
    let right = view::ground_shown(scene, unit(scene, None)).map_or(structure.max.x, |g| structure.max.x.max(g.max.x));
    let middle = 0.5 * (structure.min.y + structure.max.y);
    let shift = Vector::new(right + apart - scale * own.min.x, middle - 0.5 * scale * (own.min.y + own.max.y));
    let place = |p: Point, aside: f64| Point::from((p.coords + Vector::new(aside, 0.0)) * scale + shift);
    let side = |(number, ends): (usize, &[Point])| {
        let aside = if number < acting { 0.0 } else { aside };
        [place(ends[0], aside), place(ends[1], aside)]
    };
    let ends = [corners[acting], at];
    let ends = ends.into_iter().zip([corners[acting], corners[0]]);
    let joins = ends.map(|(answer, act)| [place(act, 0.0), place(answer, aside)]);
    Some(Chain {
        sides: corners.windows(2).enumerate().map(side).collect(),
        joins: if aside > 0.0 { joins.collect() } else { Vec::new() },
        scale,
    })
}

/// Returns the scale of a polygon, metres per newton. `structure` is in metres, `own` is the box around the polygon in
/// newtons. In figures of several frames the scale is rounded down, so that polygons of similar size have the same
/// scale.
fn scale(structure: Bounds, own: Bounds, is_one_of_several: bool) -> f64 {
    let size = POLYGON_SIZE * structure.width().max(structure.height());
    let high = structure.height().max(POLYGON_HEIGHT * structure.width());
    let high = high.min(size);
    let scale = (size / own.width()).min(high / own.height());
    match is_one_of_several {
        true => round_below(scale),
        false => scale,
    }
}

/// True if the sum of the forces is zero, except for rounding.
fn closed<'a>(arrows: impl Iterator<Item = &'a ForceArrow>) -> bool {
    let sides = arrows.fold((Vector::zeros(), 0.0), |(sum, all), arrow| (sum + arrow.force, all + arrow.force.norm()));
    sides.0.norm() <= CLOSURE_TOL * sides.1
}

/// Returns a legend entry for each different scale of the polygons: an arrow of a round force. `scales` lists the index
/// of each frame with its scale, pixels per newton.
fn scale_entries(scales: &[(usize, f64)], unit: Unit) -> Vec<Entry> {
    let mut groups: Vec<(f64, Vec<String>)> = Vec::new();
    for (frame, scale) in scales {
        let named = format!("({})", letter(*frame));
        match groups.iter_mut().find(|group| group.0 == *scale) {
            Some(group) => group.1.push(named),
            None => groups.push((*scale, vec![named])),
        }
    }
    let is_only = groups.len() == 1;
    let entry = |(scale, frames): (f64, Vec<String>)| {
        let amount = round_below_in(SCALE_ARROW / scale, unit);
        let amount_words = quantity(amount, unit);
        let words = match (is_only, frames.len()) {
            (true, 1) => format!("arrow of {amount_words} in the force polygon"),
            (true, _) => format!("arrow of {amount_words} in the force polygons"),
            (false, 1) => format!("{amount_words} in the polygon of {}", listed(&frames)),
            (false, _) => format!("{amount_words} in the polygons of {}", listed(&frames)),
        };
        (amount > 0.0).then_some(Entry::Scale(amount * scale, SCALE_WIDTH, words))
    };
    groups.into_iter().filter_map(entry).collect()
}

/// Width of the arrow that shows the scale of a polygon, pixels.
const SCALE_WIDTH: f64 = 2.4;

#[cfg(test)]
mod tests;
