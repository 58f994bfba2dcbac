//! Draws a collapse margin: the structure in its present position, and dashed lines that show how it would fall just
//! beyond the margin.
//!
//! The options choose the [parameter](Toward). The structure stands for an interval of values of this parameter. Dashed
//! outlines show how it would fall beyond the end that is nearer to the present state; for the load factor, beyond the
//! upper end. Hinges and slips are those of this collapse. If gravity is turned or a horizontal load is added, arrows
//! show the values at both ends ([`gravity`]). Loads are drawn with their present magnitudes.

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
use crate::mechanics::analysis::{Analysis, Toward, Verdict};
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
        let (ghost, edge) = falling_copy(analysis, frame, toward)?;
        let gravity = Gravity::new(analysis, frame, edge, toward);
        let gravity = gravity.and_then(|gravity| Some(Bounds::from_points(gravity.points())?.grown(0.1 * unit)));
        let reach = mechanism::reach(analysis, &Course::new(&ghost, frame, unit).at(1.0));
        reach.into_iter().chain(gravity).reduce(Bounds::union)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame) = (pen.context, pen.number);
        let mut ink = label::ink(pen);
        let toward = context.options.toward;
        let mut parts = Vec::new();
        if let Some((ghost, edge)) = falling_copy(context.analysis, frame, toward) {
            parts.push(ghosts(pen, &ghost));
            parts.extend(mechanism::joint_marks(pen, &ghost, &mut ink));
            let gravity = Gravity::new(context.analysis, frame, edge, toward);
            parts.extend(gravity.map(|gravity| gravity.draw(pen, &mut ink)));
        }
        parts.push(pen.arrows(false));
        composed(pen, view, pen.blocks(), parts, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        let mut entries = Vec::new();
        let toward = context.options.toward;
        let frames = 0..context.analysis.frames.len();
        let joints: Vec<Vec<Joint>> =
            frames.filter_map(|frame| Some(joints(&falling_copy(context.analysis, frame, toward)?.0, frame))).collect();
        if !joints.is_empty() {
            let ghost = "how it would begin to fall".to_owned();
            entries.push(Entry::Symbol(ghost_symbol, 20.0, ghost));
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

/// Returns a copy of the analysis in which the frame falls by the mechanism just beyond the end of the interval that is
/// nearer to the present state, and the value of the parameter at this end; for the load factor, the upper end. `None`
/// if the frame does not stand, or if no mechanism is known.
fn falling_copy(analysis: &Analysis, frame: usize, toward: Toward) -> Option<(Analysis, f64)> {
    if analysis.frames.get(frame)?.verdict != Verdict::Stable {
        return None;
    }
    let (edge, motions) = analysis.edges(frame, toward).into_iter().next()?;
    let mut copy = analysis.clone();
    copy.frames[frame].mechanism = motions;
    copy.frames[frame].verdict = Verdict::Unstable;
    Some((copy, edge))
}

/// Draws the outlines of the blocks of `copy` in their displaced positions. `copy` comes from [`falling_copy`].
fn ghosts(pen: &Pen<'_>, copy: &Analysis) -> Group {
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
    let path = ghost_path(outline, pen.line, &pen.context.options.theme);
    Group::with_class("ghosts").titled("How it would begin to fall").with(path)
}

fn ghost_path(outline: Outline, line: f64, theme: &Theme) -> Path {
    let edge = theme.motion.mixed(theme.ink, 0.25);
    Path::stroked(outline, Stroke::new(edge, line.max(0.9)).dashed([5.0, 3.5]))
}

fn ghost_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let swatch = PageRect { at: at.moved(0.0, -6.5), width: 20.0, height: 13.0 };
    vec![ghost_path(Outline::rounded(swatch, 0.0), 1.0, theme).into()]
}
