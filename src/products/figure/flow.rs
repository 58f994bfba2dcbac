//! Draws the force flow: the paths of the forces through the blocks. Each path is a band whose width is proportional to
//! the force.
//!
//! In each block, strands lead from the points where forces enter to the points where they leave; [`strands`] computes
//! them. A strand is drawn as a band. At a joint, the bands on both sides have the same total width and the same
//! direction.

mod curve;
mod key;
mod line;
mod ribbon;
mod strand;
mod words;

use strand::{Strand, StrandKind, strands};

use super::arrow::{ArrowKind, ForceArrow, Marks, TurnKind};
use super::bearing::bearings;
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::label::{self, Callout};
use super::largest::{self, largest_contact};
use super::legend::Entry;
use super::limit;
use super::mark;
use super::option::Options;
use super::panel::{composed_with, robot_limits};
use super::pen::Pen;
use super::unit::{LOAD_SHAFT, longest_load, unit};
use crate::geometry::Bounds;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, Verdict};
use crate::mechanics::scene::Scene;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Colour, Group, Item, Outline, PagePoint, PageRect, Path, Stroke, Theme};

/// The width of the band of the largest force in unit lengths, with its least and largest allowed width in pixels.
const LARGEST_BAND_WIDTH: (f64, f64, f64) = (0.5, 3.0, 20.0);
/// Least width of a band, pixels; a narrower band would not be visible.
const MIN_BAND_WIDTH: f64 = 0.4;
/// In frames with more blocks than this, all bands of one colour are drawn as one shape, and joints have no dots.
const MAX_SINGLE_STRANDS: usize = 150;

/// Least length of the arrow of a missing force, as a fraction of the length of the longest arrow of a load. A shorter
/// arrow would have no visible direction.
const LEAST_MISSING_ARROW: f64 = 0.35;
/// Width of the dashed edge of a band of missing forces, pixels.
const MISSING_EDGE: f64 = 0.9;
/// Width of the legend symbol for a band of missing forces, pixels.
const MISSING_SIGN: f64 = 26.0;

/// The figure of force flow.
pub(crate) struct ForceFlow;

impl PanelContent for ForceFlow {
    fn about(&self) -> About {
        About {
            name: "flow",
            help: "The paths of the forces through the blocks, as lines as wide as the forces",
            title: "The flow of forces in a dry-laid structure",
            draws_forces: true,
            lines_cross_names: true,
            ..About::default()
        }
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        let FrameSource { analysis, frame, options } = of;
        let edge = unit(&analysis.scene, options.zoom);
        largest_arrow(analysis, frame) * edge / longest_load(&analysis.scene, options.zoom)
    }

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        marks(of.analysis, of.frame, of.options, newtons_per_unit)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        Picture::new(pen).drawn(view)
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        key::entries(context, unit)
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        words::reason(context, frame)
    }
}

/// Returns the largest magnitude of a load or missing force in a frame, N. A torque counts as a force of torque / unit
/// length.
fn largest_arrow(analysis: &Analysis, frame: usize) -> f64 {
    let (scene, frame_analysis) = (&analysis.scene, &analysis.frames[frame]);
    let placed = &scene.frames[frame].placed;
    let edge = unit(scene, None);
    let loads = scene.loads.iter().filter(|l| placed.contains(&l.block));
    let loads = loads.map(|l| l.force.norm().max(l.torque.abs() / edge));
    let missing = frame_analysis.failures.iter();
    let missing = missing.map(|f| f.force().norm().max(f.torque().abs() / edge));
    loads.chain(missing).fold(0.0, f64::max)
}

/// Returns the straight arrows of loads and missing forces, and the circular arrows of loads and missing torques.
fn marks(analysis: &Analysis, frame: usize, options: &Options, newtons_per_unit: f64) -> Marks {
    let marks = mark::marks(analysis, frame, options, newtons_per_unit);
    let longest = longest_load(&analysis.scene, options.zoom);
    let width = LOAD_SHAFT * longest;
    let shown = |arrow: ForceArrow| match arrow.kind {
        ArrowKind::Load => Some(ForceArrow { width, ..arrow }),
        kind if kind.is_failure() => {
            let arrow = ForceArrow { width, ..arrow };
            Some(lengthened(arrow, LEAST_MISSING_ARROW * longest))
        }
        _ => None,
    };
    let turns = marks.turns.into_iter();
    let shown = Marks {
        arrows: marks.arrows.into_iter().filter_map(shown).collect(),
        turns: turns.filter(|turn| !matches!(turn.kind, TurnKind::Robot(_))).collect(),
        newtons_per_unit,
    };
    // If there are no arrows, return no scale either, so that the legend shows none.
    if shown.arrows.is_empty() && shown.turns.is_empty() { Marks::default() } else { shown }
}

/// Returns the arrow of a missing force with a length of at least `least` metres. For a pull, the tip of the arrow
/// stays in its place; for any other force, the tail stays.
fn lengthened(arrow: ForceArrow, least: f64) -> ForceArrow {
    let length = arrow.vector.norm();
    if length >= least || length <= 0.0 {
        return arrow;
    }
    let vector = arrow.vector * (least / length);
    let at = match arrow.kind {
        ArrowKind::MissingPull(_) => arrow.at + arrow.vector - vector,
        _ => arrow.at,
    };
    ForceArrow { at, vector, ..arrow }
}

/// Returns the magnitude of the largest force of a joint or a robot in any frame, N.
fn largest(context: &FigureContext<'_>) -> f64 {
    let frames = &context.analysis.frames;
    let contacts = frames.iter().filter_map(largest_contact);
    let contacts = contacts.map(|c| c.resultant.force.norm());
    let robots = frames.iter().flat_map(|f| &f.robots);
    contacts.chain(robots.map(|r| r.force.norm())).fold(0.0, f64::max)
}

/// Returns the width of the widest band, which shows the largest force, in pixels. `unit` is the unit length in pixels.
fn widest(unit: f64) -> f64 {
    let (width, least, most) = LARGEST_BAND_WIDTH;
    (width * unit).clamp(least, most)
}

/// Returns the colour of the bands of carried forces. In a frame that is not stable, it is mixed with the colour of
/// outlines.
fn carried(theme: &Theme, verdict: Verdict) -> Colour {
    match verdict {
        Verdict::Stable => theme.motion,
        _ => theme.motion.mixed(theme.outline, 0.6),
    }
}

/// Returns the colour of the bands of this kind in a frame with this verdict.
fn colour(theme: &Theme, verdict: Verdict, kind: StrandKind) -> Colour {
    let carried = carried(theme, verdict);
    match kind {
        StrandKind::Carried => carried,
        StrandKind::Weight => carried.mixed(theme.block, 0.55),
        StrandKind::Missing => theme.failure.mixed(theme.block, 0.5),
    }
}

/// The picture of a frame.
struct Picture<'a> {
    pen: &'a Pen<'a>,
    scene: &'a Scene,
    frame_analysis: &'a FrameAnalysis,
    theme: &'a Theme,
    strands: Vec<Strand>,
    /// Pixels per newton.
    scale: f64,
}

impl<'a> Picture<'a> {
    fn new(pen: &'a Pen<'a>) -> Picture<'a> {
        let (context, frame, camera) = (pen.context, pen.number, pen.camera);
        let (scene, frame_analysis) = (&*context.analysis.scene, &context.analysis.frames[frame]);
        let scale = widest(pen.unit()) / largest(context).max(f64::MIN_POSITIVE);
        let metres = camera.metres(scale);
        Picture {
            strands: strands(scene, &scene.frames[frame], frame_analysis, metres),
            pen,
            scene,
            frame_analysis,
            theme: &context.options.theme,
            scale,
        }
    }

    fn drawn(&self, view: Bounds) -> Group {
        let mut ink = label::ink(self.pen);
        let flow = self.flow(&mut ink);
        let dots = self.dots(&mut ink);
        let (forces, missing) = (self.pen.arrows(false), self.pen.arrows(true));
        let marks = vec![flow, dots, forces, missing];
        composed_with(self.pen, view, self.pen.blocks(), marks, self.callout(), ink)
    }

    /// True if the frame has more than [`MAX_SINGLE_STRANDS`] blocks. All bands of one colour are then drawn as one
    /// shape without tooltips, and joints have no dots.
    fn many(&self) -> bool {
        self.scene.frames[self.pen.number].placed.len() > MAX_SINGLE_STRANDS
    }

    /// Draws the bands in three layers: at the bottom the bands of weights, above them the bands of the forces that
    /// blocks transmit, and on top the bands of missing forces.
    fn flow(&self, ink: &mut Ink) -> Group {
        let mut group = Group::with_class("flow");
        let order = [StrandKind::Weight, StrandKind::Carried, StrandKind::Missing];
        for kind in order {
            let strands = self.strands.iter().filter(|s| s.kind == kind);
            let colour = colour(self.theme, self.frame_analysis.verdict, kind);
            let mut joined = Outline::default();
            for strand in strands {
                let outline = self.band(strand, ink);
                if self.many() {
                    joined.extend(outline);
                    continue;
                }
                let title = words::strand(self.scene, self.frame_analysis, strand);
                let band = Group::with_class("strand").titled(title);
                let band = band.with(filled(outline, colour, kind, self.theme));
                group.items.push(band.into());
            }
            if !joined.segments.is_empty() {
                let bands = filled(joined, colour, kind, self.theme);
                group.items.push(bands.into());
            }
        }
        group
    }

    /// Returns the outline of the band of a strand. Adds the band to the ink, so that no label covers it.
    fn band(&self, strand: &Strand, ink: &mut Ink) -> Outline {
        let camera = self.pen.camera;
        let width = |newtons: &f64| camera.metres((newtons * self.scale).max(MIN_BAND_WIDTH));
        let mut widths: Vec<f64> = strand.widths.iter().map(width).collect();
        let mut axis = strand.axis.clone();
        if self.many() && !strand.exact {
            // In a figure with many blocks, bends are not visible. Straight bands make the file smaller.
            axis = axis.first().into_iter().chain(axis.last()).copied().collect();
            widths = widths.first().into_iter().chain(widths.last()).copied().collect();
        }
        for (pair, width) in axis.windows(2).zip(&widths) {
            let [from, to] = [pair[0], pair[1]].map(|p| camera.place(p));
            ink.line(from, to, camera.length(*width) + 1.0);
        }
        ribbon::ribbon(&axis, &widths, camera)
    }

    /// Draws a dot at the point of action of the resultant of each joint with a force. A joint at its limit has a
    /// filled diamond instead of the dot, and a joint that [`limit::marked`] returns as the nearest to its limit has an
    /// open diamond. A robot at its limit also has a filled diamond. In a frame with many blocks, nothing is drawn.
    fn dots(&self, ink: &mut Ink) -> Group {
        let mut group = Group::with_class("resultants");
        if self.many() {
            return group;
        }
        let radius = dot(self.pen.unit());
        let marked = limit::marked(self.pen.context, self.pen.number);
        for (contact, bearing) in self.frame_analysis.contacts.iter().zip(bearings(self.scene, self.frame_analysis)) {
            if bearing.is_none() {
                continue;
            }
            let at = self.pen.camera.place(contact.resultant.at);
            let title = words::joint(self.scene, contact);
            let dot = Group::with_class("resultant").titled(title);
            let mark = marked.iter().find(|m| core::ptr::eq(m.contact, contact));
            let reach = mark.map_or(radius, |_| limit::reach(radius));
            ink.disc(at, reach + 1.0);
            let path = match mark {
                Some(mark) => mark.symbol(at, radius, self.theme),
                None => dot_at(at, radius, self.theme),
            };
            group.items.push(dot.with(path).into());
        }
        group.items.extend(robot_limits(self.pen, ink));
        group
    }

    /// Returns the label of the largest force of a joint, at the dot of this joint.
    fn callout(&self) -> Vec<Callout> {
        let force = largest_contact(self.frame_analysis).map(|c| c.resultant.force.norm());
        let clear = 0.5 * self.scale * force.unwrap_or(0.0) + 3.0;
        let colour = carried(self.theme, self.frame_analysis.verdict);
        largest::callout(self.pen, self.frame_analysis, clear, colour)
    }
}

/// Fills a band. A band of missing forces also has a dashed edge, because the colour of the band cannot be recognised
/// in a greyscale print.
fn filled(outline: Outline, colour: Colour, kind: StrandKind, theme: &Theme) -> Path {
    let band = Path::filled(outline, colour);
    match kind {
        StrandKind::Missing => band.with_stroke(Stroke::new(theme.failure, MISSING_EDGE).dashed([3.0, 2.0])),
        StrandKind::Carried | StrandKind::Weight => band,
    }
}

/// Draws a band of missing forces for the legend.
fn missing_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let rect = PageRect { at: at.moved(0.0, -2.5), width: MISSING_SIGN, height: 5.0 };
    let colour = colour(theme, Verdict::Unstable, StrandKind::Missing);
    let outline = Outline::rounded(rect, 0.0);
    vec![filled(outline, colour, StrandKind::Missing, theme).into()]
}

/// Returns the radius of the dot at a joint, in pixels. `unit` is the unit length in pixels.
fn dot(unit: f64) -> f64 {
    (0.06 * unit).clamp(1.1, 3.2)
}

fn dot_at(at: PagePoint, radius: f64, theme: &Theme) -> Path {
    Path::filled(Outline::circle(at, radius), theme.ink).cased(theme.page, 0.3 * radius)
}

fn dot_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![dot_at(at.moved(4.0, 0.0), 3.0, theme).into()]
}
