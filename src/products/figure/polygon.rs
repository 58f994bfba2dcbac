//! Draws the force polygon next to the structure: the external forces on the structure as arrows, each of which begins
//! at the tip of the previous arrow.
//!
//! Its first sides are weights and loads, block by block. Then come the forces of the ground and the robots, and
//! finally missing forces, which are hollow and dashed. The polygon is closed if the structure is in equilibrium. If it
//! falls, the polygon only closes with the missing forces, outside or inside the structure; the text below says so.
//! Each arrow has the same colour and force as on the structure; only its scale differs, by a round factor in the
//! legend.

use super::arrow::{ArrowKind, ForceArrow, Marks};
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::description;
use super::label;
use super::legend::{self, Entry};
use super::mark;
use super::panel::composed;
use super::pen::Pen;
use super::unit::unit;
use super::verdict;
use super::view;
use super::words::{letter, listed, round_below};
use crate::analysis::{Analysis, Verdict};
use crate::drawing::arrow::straight;
use crate::drawing::placement::Ink;
use crate::drawing::{Colour, Group, Item, Outline, PagePoint, Path, Stroke, Theme};
use crate::geometry::{Bounds, Point, Vector};
use crate::scene::BodyId;

/// Size of the polygon, as a share of the structure's size.
const POLYGON_SIZE: f64 = 0.75;
/// Gap between structure and polygon: a share of the structure's diagonal, and the least number of unit edges.
const POLYGON_GAP: (f64, f64) = (0.12, 1.0);
/// A polygon is closed if its gap is at most this share of the sum of all forces. Rounding errors are far smaller, and
/// missing forces are far larger.
const CLOSURE_TOL: f64 = 1e-6;

/// True if a force acts on the structure from outside. Such a force is a side of the polygon.
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
            ..About::default()
        }
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        mark::largest(of.analysis, of.frame, of.options)
    }

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        let FrameSource {
            analysis,
            frame,
            options,
        } = of;
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
        let FrameSource {
            analysis, frame, ..
        } = of;
        let chain = chain(analysis, frame, marks)?;
        let own = Bounds::from_points(chain.sides.into_iter().flatten())?;
        Some(own.grown(0.3 * unit))
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let scene = &pen.context.analysis.scene;
        let mut ink = label::ink(pen);
        let polygon = drawn_polygon(pen, &mut ink);
        let parts = vec![pen.arrows(false), pen.arrows(true), polygon];
        // Cut off the ground to the left of the polygon. Otherwise the polygon would seem to stand on the ground.
        let Some(shown) = view::ground_shown(scene, unit(scene, None)) else {
            return composed(pen, view, pen.blocks(), parts, ink);
        };
        let mut beyond = pen.camera.rect(shown);
        let right = beyond.at.x + beyond.width;
        let page = pen.camera.rect(view);
        beyond.at.x = right;
        beyond.width = (page.at.x + page.width - right).max(0.0);
        ink.rect(beyond);
        let mut picture = composed(pen, view, pen.blocks(), parts, ink);
        for item in &mut picture.items {
            if let Item::Group(group) = item
                && group.class == "ground"
                && let Some(clip) = &mut group.clip
            {
                let right = pen.camera.place(Point::new(shown.max.x, shown.max.y)).x;
                clip.width = clip.width.min(right - clip.at.x).max(0.0);
            }
        }
        picture
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let mut entries = legend::entries(context, unit);
        // In this figure, the colours of blocks show no quantity, so the legend does not explain them.
        entries.retain(|entry| !matches!(entry, Entry::Amplitudes(..)));
        let mut sides = context.marks.iter().flat_map(outer);
        if sides.any(|arrow| arrow.kind.is_failure()) {
            let what = "missing force as a side of the polygon".to_owned();
            entries.push(Entry::Sign(missing_sign, 26.0, what));
        }
        let frames = context.marks.iter().enumerate();
        let times: Vec<(usize, f64)> = frames
            .filter_map(|(frame, marks)| {
                Some((frame, chain(context.analysis, frame, marks)?.times))
            })
            .collect();
        entries.extend(scales(&times).map(Entry::Note));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let why = verdict::reason(&context.analysis.scene, &context.analysis.frames[frame]);
        let marks = &context.marks[frame];
        let lacks = outer(marks).any(|a| a.kind.is_failure());
        if outer(marks).next().is_none() {
            return why;
        }
        let how = match (context.analysis.frames[frame].verdict, closed(marks)) {
            (_, false) => "the force polygon stays open",
            (Verdict::Stable, true) => "the force polygon is closed",
            (Verdict::Unstable, true) if lacks => {
                "the force polygon closes only with the missing forces"
            }
            (Verdict::Unstable, true) => {
                "the force polygon closes only with the forces that are missing inside the structure"
            }
            (Verdict::Undecided, true) => "the force polygon of the forces found is closed",
        };
        if why.is_empty() {
            how.to_owned()
        } else {
            format!("{how}; {why}")
        }
    }
}

/// Draws the force polygon of a frame. If actions and reactions are drawn apart, dashed lines connect their ends. If
/// the polygon is open, a dashed line closes the gap.
fn drawn_polygon(pen: &Pen<'_>, ink: &mut Ink) -> Group {
    let (context, camera) = (pen.context, pen.camera);
    let theme = &context.options.theme;
    let marks = &context.marks[pen.number];
    let mut polygon = Group::with_class("polygon").titled("Force polygon");
    let Some(chain) = chain(context.analysis, pen.number, marks) else {
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
    // If actions and reactions are drawn apart, two dashed lines connect positions that stand for the same point. In an
    // open polygon, the second line would look like the line of the gap, so it is left out.
    let closed = closed(marks);
    for join in chain.joins.iter().take(if closed { 2 } else { 1 }) {
        let stroke = Stroke::new(theme.faint, 0.8).dashed([2.0, 2.0]);
        let title = "The same point, drawn at two positions";
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

/// If the distance of reactions from actions is smaller than this share of the polygon's size, reactions are drawn next
/// to the actions.
const OVERLAP_SHARE: f64 = 0.03;
/// Distance of reactions that are drawn next to the actions, as a share of the polygon's size.
const REACTION_OFFSET: f64 = 0.09;

/// The polygon of a frame: the ends of each arrow in the scene, metres, and the scale relative to the arrows on the
/// structure.
struct Chain {
    sides: Vec<[Point; 2]>,
    /// Pairs of positions that are the same point, if actions and reactions are drawn apart.
    joins: Vec<[Point; 2]>,
    times: f64,
}

/// True if sides of reactions would cover sides of actions, because they lie on the same line. `acting` and `answering`
/// are the corners of the actions (weights and loads) and of the reactions. `size` is the size of the polygon, in the
/// same unit.
fn covers(acting: &[Point], answering: &[Point], size: f64) -> bool {
    let pair = |ends: &[Point]| [ends[0], ends[1]];
    let (acting, answering): (Vec<_>, Vec<_>) = (
        acting.windows(2).map(pair).collect(),
        answering.windows(2).map(pair).collect(),
    );
    // Two sides overlap if the middle and the first quarter point of one side both nearly lie on the other side.
    let from = |[a, b]: [Point; 2], p: Point| {
        let along = b - a;
        let length = along.norm_squared();
        let share = if length > 0.0 {
            ((p - a).dot(&along) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (p - (a + along * share)).norm()
    };
    let lies_on = |short: &[Point; 2], long: &[Point; 2]| {
        let middle = nalgebra::center(&short[0], &short[1]);
        let quarter = nalgebra::center(&short[0], &middle);
        [middle, quarter]
            .iter()
            .all(|p| from(*long, *p) < OVERLAP_SHARE * size)
    };
    acting.iter().any(|a| {
        let mut others = answering.iter();
        others.any(|b| lies_on(a, b) || lies_on(b, a))
    })
}

/// Computes the force polygon of a frame from the external forces among the arrows in `marks`. The polygon is placed to
/// the right of the structure. Returns `None` if the frame has no block, if there are fewer than two external forces, or
/// if all of them are 0.
fn chain(analysis: &Analysis, frame: usize, marks: &Marks) -> Option<Chain> {
    let scene = &analysis.scene;
    let blocks = scene.frames[frame].placed.iter();
    let structure = blocks
        .map(|id| scene.blocks[id.0].body.polygon.bounds())
        .reduce(Bounds::union)?;
    let mut at = Point::origin();
    let mut corners = vec![at];
    for arrow in outer(marks) {
        at += arrow.vector;
        corners.push(at);
    }
    let own = Bounds::from_points(corners.iter().copied()).filter(|_| corners.len() > 2)?;
    let size = own.width().max(own.height());
    if size.is_nan() || size <= 0.0 {
        return None;
    }
    let times = round_below(POLYGON_SIZE * structure.width().max(structure.height()) / size);
    if times <= 0.0 {
        return None;
    }
    let answers = |arrow: &ForceArrow| !matches!(arrow.kind, ArrowKind::Weight | ArrowKind::Load);
    let acting = outer(marks).position(answers);
    let acting = acting.unwrap_or(corners.len() - 1);
    let aside = if covers(&corners[..=acting], &corners[acting..], size) {
        REACTION_OFFSET * size
    } else {
        0.0
    };
    let (share, least) = POLYGON_GAP;
    let apart = (share * structure.diagonal()).max(least * unit(scene, None));
    // Place the polygon to the right of the structure and its ground, at the height of the middle of the structure.
    let right = view::ground_shown(scene, unit(scene, None))
        .map_or(structure.max.x, |g| structure.max.x.max(g.max.x));
    let middle = 0.5 * (structure.min.y + structure.max.y);
    let shift = Vector::new(
        right + apart - times * own.min.x,
        middle - 0.5 * times * (own.min.y + own.max.y),
    );
    let place =
        |p: Point, aside: f64| Point::from((p.coords + Vector::new(aside, 0.0)) * times + shift);
    let side = |(number, ends): (usize, &[Point])| {
        let aside = if number < acting { 0.0 } else { aside };
        [place(ends[0], aside), place(ends[1], aside)]
    };
    let ends = [corners[acting], at];
    let ends = ends.into_iter().zip([corners[acting], corners[0]]);
    let joins = ends.map(|(answer, act)| [place(act, 0.0), place(answer, aside)]);
    Some(Chain {
        sides: corners.windows(2).enumerate().map(side).collect(),
        joins: if aside > 0.0 {
            joins.collect()
        } else {
            Vec::new()
        },
        times,
    })
}

/// Formats a scale factor as a whole number or as a fraction: `3` or `1/3`.
fn larger(times: f64) -> String {
    if times >= 1.0 {
        format!("{times:.0}")
    } else {
        format!("1/{:.0}", 1.0 / times)
    }
}

/// True if the sum of the external forces is zero, except for rounding.
fn closed(marks: &Marks) -> bool {
    let sum: Vector = outer(marks).map(|a| a.force).sum();
    let all: f64 = outer(marks).map(|a| a.force.norm()).sum();
    sum.norm() <= CLOSURE_TOL * all
}

/// Returns the path of a missing force in the polygon: a hollow arrow with a dashed outline.
fn missing(outline: Outline, colour: Colour, theme: &Theme) -> Path {
    let edge = Stroke::new(colour, 1.2).dashed([3.0, 2.0]);
    Path::filled(outline, theme.page).with_stroke(edge)
}

fn missing_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let outline = straight(at, (26.0, 0.0), 4.0);
    vec![missing(outline, theme.failure, theme).into()]
}

/// Describes how much larger arrows are in the force polygons than on the structure. `times` lists each frame with its
/// scale factor. Returns `None` if the list is empty.
fn scales(times: &[(usize, f64)]) -> Option<String> {
    let mut groups: Vec<(f64, Vec<String>)> = Vec::new();
    for (frame, times) in times {
        let named = format!("({})", letter(*frame));
        match groups.iter_mut().find(|group| group.0 == *times) {
            Some(group) => group.1.push(named),
            None => groups.push((*times, vec![named])),
        }
    }
    let how = |times: f64| match times {
        1.0 => "at the same scale".to_owned(),
        times => format!("{} times as large", larger(times)),
    };
    let what = "the same forces, tip to tail";
    match &groups[..] {
        [] => None,
        [(times, _)] => Some(format!("force polygon: {what}, {}", how(*times))),
        groups => {
            let each = groups.iter();
            let each = each.map(|(times, frames)| format!("{} in {}", how(*times), listed(frames)));
            let each: Vec<String> = each.collect();
            Some(format!("force polygons: {what}; {}", each.join("; ")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_key_tells_the_scale_of_every_polygon_by_its_panel() {
        assert_eq!(scales(&[]), None);
        let one = "force polygon: the same forces, tip to tail, 5 times as large";
        assert_eq!(scales(&[(0, 5.0), (2, 5.0)]).as_deref(), Some(one));
        let several = "force polygons: the same forces, tip to tail; 2 times as large in (a), (c) and (d); at the same scale in (b)";
        let times = [(0, 2.0), (1, 1.0), (2, 2.0), (3, 2.0)];
        assert_eq!(scales(&times).as_deref(), Some(several));
    }
}
