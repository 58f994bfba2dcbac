//! Draws a collapse margin: the structure in its present position, and dashed lines that show how it would fall just
//! beyond the margin.
//!
//! The options choose the [parameter](Toward). The structure stands for an interval of values of this parameter. Dashed
//! outlines show how it would fall beyond the end that is nearer to the present state; for the load factor, beyond the
//! upper end. Pale dashed outlines show how it would fall beyond the other end. If gravity is turned or a horizontal
//! load is added, arrows show the values at both ends ([`gravity`]). Loads are drawn with their present magnitudes.

mod gravity;
mod reason;

use gravity::{Gravity, gravity_symbol, push_symbol};

use super::arrow::Marks;
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::displacement::Course;
use super::joint::{Joint, joints};
use super::label;
use super::legend::{self, Entry};
use super::mechanism;
use super::panel::composed;
use super::pen::Pen;
use crate::geometry::Bounds;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, Toward, Verdict};
use crate::pictures::drawing::{Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Theme};

/// The figure of a margin.
pub(crate) struct CollapseMargin;

impl PanelContent for CollapseMargin {
    fn about(&self) -> About {
        About {
            name: "margin",
            help: "The structure, and how it falls just beyond its margin; --margin selects the margin",
            title: "How far a dry-laid structure is from falling",
            needs_margins: true,
            lines_cross_names: true,
            ..About::default()
        }
    }

    fn extent(&self, of: FrameSource<'_>, unit: f64, _marks: &Marks) -> Option<Bounds> {
        let FrameSource { analysis, frame, options } = of;
        let toward = options.toward;
        let copies = falling_copies(analysis, frame, toward);
        let gravity = copies.first().and_then(|(_, edge)| {
            let gravity = Gravity::new(analysis, frame, *edge, toward)?;
            Some(Bounds::from_points(gravity.points())?.grown(0.1 * unit))
        });
        let ghosts =
            copies.iter().filter_map(|(ghost, _)| mechanism::reach(analysis, &Course::new(ghost, frame, unit).at(1.0)));
        ghosts.chain(gravity).reduce(Bounds::union)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame) = (pen.context, pen.number);
        let mut ink = label::ink(pen);
        let toward = context.options.toward;
        let copies = falling_copies(context.analysis, frame, toward);
        let mut parts = Vec::new();
        // The outlines for the farther end are drawn first, so that they lie below the outlines for the nearer end.
        for (number, (ghost, _)) in copies.iter().enumerate().rev() {
            parts.push(ghosts(pen, ghost, GHOSTS[number.min(1)]));
        }
        if let Some((ghost, edge)) = copies.first() {
            parts.extend(mechanism::joint_marks(pen, ghost, &mut ink));
            let gravity = Gravity::new(context.analysis, frame, *edge, toward);
            parts.extend(gravity.map(|gravity| gravity.draw(pen, &mut ink)));
        }
        parts.push(pen.arrows(false));
        composed(pen, view, pen.blocks(), parts, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        let mut entries = Vec::new();
        let toward = context.options.toward;
        let frames = 0..context.analysis.frames.len();
        let copies: Vec<(usize, Vec<(Analysis, f64)>)> =
            frames.map(|frame| (frame, falling_copies(context.analysis, frame, toward))).collect();
        let nearer = copies.iter().filter_map(|(f, ends)| Some((*f, ends.first()?)));
        let joints: Vec<Vec<Joint>> = nearer.map(|(f, (ghost, _))| joints(ghost, f)).collect();
        if !joints.is_empty() {
            let ghost = "how it would begin to fall".to_owned();
            entries.push(Entry::Symbol(ghost_symbol, 20.0, ghost));
            if copies.iter().any(|(_, ends)| ends.len() > 1) {
                let other = "how it would begin to fall at the other end".to_owned();
                entries.push(Entry::Symbol(other_ghost_symbol, 20.0, other));
            }
            entries.extend(mechanism::joint_entries(&joints.concat()));
            entries.extend(parameter_entry(toward));
        }
        entries.extend(legend::loads(context));
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        reason::sentence(context.analysis, frame, context.options.toward)
    }
}

/// Returns the legend entry for the arrows that show the value of the parameter; `None` for the load factor, which has
/// no such arrows.
fn parameter_entry(toward: Toward) -> Option<Entry> {
    let entry =
        |symbol: fn(PagePoint, &Theme) -> Vec<Item>, words: &str| Some(Entry::Symbol(symbol, 26.0, words.to_owned()));
    match toward {
        Toward::Tilt => entry(gravity_symbol, "direction of gravity at the margin; pale: at its other end"),
        Toward::HorizontalLoad => {
            entry(push_symbol, "largest additional load perpendicular to gravity; pale: the other way")
        }
        Toward::LoadFactor => None,
    }
}

/// Returns a pair for each end of the interval at which a mechanism is known: a copy of the analysis in which the frame
/// falls by the mechanism just beyond this end, and the value of the parameter at this end. The end nearer to the
/// present state comes first; for the load factor, the upper end. The list is empty if the frame does not stand.
fn falling_copies(analysis: &Analysis, frame: usize, toward: Toward) -> Vec<(Analysis, f64)> {
    let stands = |found: &FrameAnalysis| found.verdict == Verdict::Stable;
    if !analysis.frames.get(frame).is_some_and(stands) {
        return Vec::new();
    }
    let copy = |(edge, motions)| {
        let mut copy = analysis.clone();
        copy.frames[frame].mechanism = motions;
        copy.frames[frame].verdict = Verdict::Unstable;
        (copy, edge)
    };
    let edges = analysis.edges(frame, toward).into_iter();
    edges.map(copy).collect()
}

/// How the displaced blocks for one end of the interval are drawn.
#[derive(Clone, Copy)]
struct GhostStyle {
    /// The tooltip of the outlines.
    title: &'static str,
    /// How much of the colour of the page the outlines contain, from 0 to 1.
    paleness: f64,
    /// The lengths of a dash and of the gap after it, pixels.
    dashes: [f64; 2],
}

/// The styles of the displaced blocks for the nearer and for the farther end of the interval.
const GHOSTS: [GhostStyle; 2] = [
    GhostStyle { title: "How it would begin to fall", paleness: 0.0, dashes: [5.0, 3.5] },
    GhostStyle {
        title: "How it would begin to fall at the other end of the margin",
        paleness: 0.5,
        dashes: [1.8, 2.2],
    },
];

/// Draws the outlines of the blocks of `copy` in their displaced positions. `copy` comes from [`falling_copies`].
fn ghosts(pen: &Pen<'_>, copy: &Analysis, style: GhostStyle) -> Group {
    let displaced = Course::new(copy, pen.number, pen.context.unit).at(1.0);
    let mut outline = Outline::default();
    for (block, displacement) in copy.scene.blocks.iter().zip(&displaced) {
        let Some(displacement) = displacement else {
            continue;
        };
        for ring in block.body.polygon.rings() {
            let corners = ring.iter().map(|p| pen.camera.place(displacement.moved(*p)));
            outline.extend(Outline::ring(corners));
        }
    }
    let path = ghost_path(outline, pen.line, style, &pen.context.options.theme);
    Group::with_class("ghosts").titled(style.title).with(path)
}

fn ghost_path(outline: Outline, line: f64, style: GhostStyle, theme: &Theme) -> Path {
    let edge = theme.motion.mixed(theme.ink, 0.25);
    let edge = edge.mixed(theme.page, style.paleness);
    let stroke = Stroke::new(edge, line.max(0.9)).dashed(style.dashes);
    Path::stroked(outline, stroke)
}

fn ghost_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    ghost_swatch(at, GHOSTS[0], theme)
}

fn other_ghost_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    ghost_swatch(at, GHOSTS[1], theme)
}

fn ghost_swatch(at: PagePoint, style: GhostStyle, theme: &Theme) -> Vec<Item> {
    let swatch = PageRect { at: at.moved(0.0, -6.5), width: 20.0, height: 13.0 };
    vec![ghost_path(Outline::rounded(swatch, 0.0), 1.0, style, theme).into()]
}
