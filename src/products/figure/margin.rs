//! Draws a collapse margin: the structure in its present position, and dashed lines that show how it would fall just
//! beyond the margin.
//!
//! The options choose the [parameter](Toward). The figure shows the end of the interval that is nearer to the present
//! state. If gravity is turned, a dashed line shows its present direction, and an arrow shows its direction at the
//! margin. If a horizontal load is added, the arrow shows this load. A pale arrow shows the other end of the
//! interval. If loads grow, they are drawn with their present magnitudes. The blocks are drawn in their present
//! positions.

mod reason;

use reason::percent_of;

use super::arrow::Marks;
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::displacement::{Course, Displacement};
use super::joint::{Joint, joints};
use super::label;
use super::legend::{self, Entry};
use super::mechanism;
use super::panel::composed;
use super::pen::Pen;
use super::thrust;
use super::words::degrees;
use crate::analysis::{Analysis, End, Motion, Toward, Verdict};
use crate::drawing::arrow::straight;
use crate::drawing::{Group, Outline, PagePoint, PageRect, Path, Stroke, Theme};
use crate::geometry::{Bounds, Point, Vector, quarter_turn, sin_cos_degrees};

/// Length of the arrow of gravity, as a fraction of the diagonal of the structure.
const GRAVITY_LENGTH: f64 = 0.16;
/// Distance of the arrow of gravity from the structure, as a fraction of the diagonal of the structure.
const GRAVITY_DISTANCE: f64 = 0.12;

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

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        let FrameSource {
            analysis,
            frame,
            options,
        } = of;
        // Loads are drawn in the same way as in a figure of the line of thrust.
        thrust::marks(analysis, frame, options, newtons_per_unit)
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        let FrameSource {
            analysis,
            frame,
            options,
        } = of;
        let scene = &analysis.scene;
        let frame = &scene.frames[frame];

        match options.toward {
            Toward::LoadFactor => thrust::load_scale(scene, frame, options),
            _ => 0.0,
        }
    }

    fn extent(&self, of: FrameSource<'_>, unit: f64, _marks: &Marks) -> Option<Bounds> {
        let FrameSource {
            analysis,
            frame,
            options,
        } = of;
        let (displaced, edge) = displacements_beyond_margin(analysis, frame, unit, options.toward)?;
        let ghosts = mechanism::reach(analysis, &displaced);
        let gravity = gravity(analysis, frame, edge, options.toward)
            .and_then(|g| Some(Bounds::from_points(g.points())?.grown(0.1 * unit)));
        ghosts.into_iter().chain(gravity).reduce(Bounds::union)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame, camera) = (pen.context, pen.number, pen.camera);
        let mut ink = label::ink(pen);
        let (scene, theme) = (&context.analysis.scene, &context.options.theme);
        let mut parts = Vec::new();
        let toward = context.options.toward;
        if let Some((ghost, edge)) = falling_copy(context.analysis, frame, toward) {
            let displaced = Course::new(&ghost, frame, context.unit).at(1.0);
            let mut outline = Outline::default();
            for (block, displacement) in scene.blocks.iter().zip(&displaced) {
                let Some(displacement) = displacement else {
                    continue;
                };
                for ring in block.body.polygon.rings() {
                    let corners = ring.iter().map(|p| camera.place(displacement.moved(*p)));
                    outline.extend(Outline::ring(corners));
                }
            }
            let ghosts = Group::with_class("ghosts").titled("How it would begin to fall");
            parts.push(ghosts.with(ghost_path(outline, pen.line, theme)));
            parts.extend(mechanism::joint_marks(pen, &ghost, &mut ink));
            if let Some(gravity) = gravity(context.analysis, frame, edge, toward) {
                let [from, now, there] =
                    [gravity.from, gravity.now, gravity.there].map(|p| camera.place(p));
                let along = (there.x - from.x, there.y - from.y);
                let group = Group::with_class("gravity").titled(match toward {
                    Toward::HorizontalLoad => {
                        format!(
                            "In addition to gravity, a horizontal load of {} of each weight",
                            percent_of(edge)
                        )
                    }
                    _ => format!("Gravity turned by {}", degrees(edge.abs())),
                });
                let dashed = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
                let long = libm::hypot(now.x - from.x, now.y - from.y);
                let width = (0.04 * long).clamp(1.2, 3.0);
                let arrow = Path::filled(straight(from, along, width), theme.ink);
                ink.line(from, now, 1.2);
                ink.arrow(from, along, width);
                let mut group = group.with(Path::stroked(Outline::line([from, now]), dashed));
                if let Some(other) = gravity.other.map(|p| camera.place(p)) {
                    let along = (other.x - from.x, other.y - from.y);
                    ink.arrow(from, along, 0.7 * width);
                    let pale = straight(from, along, 0.7 * width);
                    group = group.with(Path::filled(pale, theme.faint.mixed(theme.page, 0.4)));
                }
                parts.push(group.with(arrow));
            }
        }
        parts.push(pen.arrows(false));
        composed(pen, view, pen.blocks(), parts, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        let mut entries = Vec::new();
        let toward = context.options.toward;
        let frames = 0..context.analysis.frames.len();
        let ghosts = frames.filter_map(|f| Some((f, falling_copy(context.analysis, f, toward)?.0)));
        let joints: Vec<Vec<Joint>> = ghosts.map(|(f, ghost)| joints(&ghost, f)).collect();
        if !joints.is_empty() {
            let ghost = "how it would begin to fall".to_owned();
            entries.push(Entry::Symbol(ghost_symbol, 20.0, ghost));
            entries.extend(mechanism::joint_entries(&joints.concat()));
            match toward {
                Toward::Tilt => {
                    let gravity =
                        "direction of gravity at the margin; pale: at its other end".to_owned();
                    entries.push(Entry::Symbol(gravity_symbol, 26.0, gravity));
                }
                Toward::HorizontalLoad => {
                    let push =
                        "largest additional load perpendicular to gravity; pale: the other way"
                            .to_owned();
                    entries.push(Entry::Symbol(push_symbol, 26.0, push));
                }
                Toward::LoadFactor => {}
            }
        }
        if toward == Toward::LoadFactor {
            entries.extend(legend::loads(context));
        }
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        reason::sentence(context.analysis, frame, context.options.toward)
    }
}

/// Returns the value of the parameter at the margin, and the mechanism just beyond the margin. `toward` selects the
/// parameter. Returns `None` if the frame does not stand or if no margin was found.
fn mechanism_beyond_margin(
    analysis: &Analysis,
    frame: usize,
    toward: Toward,
) -> Option<(f64, Vec<Motion>)> {
    let stands = analysis.frames.get(frame)?.verdict == Verdict::Stable;
    analysis.edge(frame, toward).filter(|_| stands)
}

/// Returns a copy of the analysis in which the frame falls by the mechanism just beyond its margin, and the value of
/// the parameter at the margin. Returns `None` if there is no margin.
fn falling_copy(analysis: &Analysis, frame: usize, toward: Toward) -> Option<(Analysis, f64)> {
    let (edge, motions) = mechanism_beyond_margin(analysis, frame, toward)?;
    let mut ghost = analysis.clone();
    let frame_analysis = ghost.frames.get_mut(frame)?;
    frame_analysis.mechanism = motions;
    frame_analysis.verdict = Verdict::Unstable;
    Some((ghost, edge))
}

/// Returns how the blocks are displaced by the mechanism just beyond the margin, indexed by block, and the value of the
/// parameter at the margin. Returns `None` if there is no margin. `unit` is the unit length in metres.
fn displacements_beyond_margin(
    analysis: &Analysis,
    frame: usize,
    unit: f64,
    toward: Toward,
) -> Option<(Vec<Option<Displacement>>, f64)> {
    let (ghost, edge) = falling_copy(analysis, frame, toward)?;
    Some((Course::new(&ghost, frame, unit).at(1.0), edge))
}

/// The points, in metres, of an arrow of gravity or of a horizontal load: the tail, the tip of gravity at present,
/// and the tip at the margin.
struct Gravity {
    from: Point,
    now: Point,
    there: Point,
    /// The tip at the other end of the interval; `None` if this end has no known value.
    other: Option<Point>,
}

impl Gravity {
    fn points(&self) -> impl Iterator<Item = Point> {
        [self.from, self.now, self.there]
            .into_iter()
            .chain(self.other)
    }
}

/// Returns the end of the interval whose sign is opposite to that of `edge`, in the unit of the parameter. Returns
/// `None` if this end has no known value, and for the load factor.
fn other_end(analysis: &Analysis, frame: usize, edge: f64, toward: Toward) -> Option<f64> {
    let intervals = &analysis.frames[frame].margins.as_ref()?.intervals;
    let interval = match toward {
        Toward::Tilt => intervals.tilt.as_ref()?,
        Toward::HorizontalLoad => intervals.horizontal_load.as_ref()?,
        Toward::LoadFactor => return None,
    };
    let ends = [interval.low(), interval.high()].into_iter().flatten();
    let mut ends = ends.filter_map(End::value);
    ends.find(|other| other * edge < 0.0)
}

/// Returns the arrows to the left of the structure: gravity at present, and gravity or the horizontal load at the
/// margin and, if it is known, at the other end of the interval. `edge` is the value of the
/// parameter at the margin. Returns `None` for the load factor, and for a frame without blocks.
fn gravity(analysis: &Analysis, frame: usize, edge: f64, toward: Toward) -> Option<Gravity> {
    let scene = &analysis.scene;
    let blocks = scene.frames[frame].placed.iter();
    let structure = blocks
        .map(|id| scene.blocks[id.0].body.polygon.bounds())
        .reduce(Bounds::union)?;
    let diagonal = structure.diagonal();
    let down = scene.down() * (GRAVITY_LENGTH * diagonal);
    let arrow = |edge: f64| match toward {
        Toward::Tilt => {
            let (sin, cos) = sin_cos_degrees(edge);
            let turned = Vector::new(cos * down.x - sin * down.y, sin * down.x + cos * down.y);
            Some(turned)
        }
        // The lengths of the two arrows have the ratio of the horizontal load to the weight.
        Toward::HorizontalLoad => Some(quarter_turn(down) * edge),
        Toward::LoadFactor => None,
    };
    let there = arrow(edge)?;
    let other = other_end(analysis, frame, edge, toward).and_then(arrow);
    // All arrows share one tail. If one of them extends far to the right, move the tail to the left by the same
    // distance, so that no arrow touches the structure.
    let beyond = other.map_or(there.x, |other| other.x.max(there.x));
    let beyond = down.x.max(beyond).max(0.0);
    let left = structure.min.x
        - GRAVITY_DISTANCE * diagonal
        - if beyond > 0.5 * GRAVITY_LENGTH * diagonal {
            beyond
        } else {
            0.0
        };
    let from = Point::new(left, structure.max.y);
    Some(Gravity {
        from,
        now: from + down,
        there: from + there,
        other: other.map(|other| from + other),
    })
}

fn ghost_path(outline: Outline, line: f64, theme: &Theme) -> Path {
    let edge = theme.motion.mixed(theme.ink, 0.25);
    let stroke = Stroke::new(edge, line.max(0.9)).dashed([5.0, 3.5]);
    Path::stroked(outline, stroke)
}

fn ghost_symbol(at: PagePoint, theme: &Theme) -> Vec<crate::drawing::Item> {
    let swatch = PageRect {
        at: at.moved(0.0, -6.5),
        width: 20.0,
        height: 13.0,
    };
    vec![ghost_path(Outline::rounded(swatch, 0.0), 1.0, theme).into()]
}

fn gravity_symbol(at: PagePoint, theme: &Theme) -> Vec<crate::drawing::Item> {
    let from = at.moved(8.0, -8.0);
    let now = Outline::line([from, from.moved(0.0, 16.0)]);
    let dashed = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
    vec![
        Path::stroked(now, dashed).into(),
        Path::filled(straight(from, (9.0, 14.0), 1.6), theme.ink).into(),
    ]
}

fn push_symbol(at: PagePoint, theme: &Theme) -> Vec<crate::drawing::Item> {
    let from = at.moved(4.0, -8.0);
    let now = Outline::line([from, from.moved(0.0, 16.0)]);
    let dashed = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
    vec![
        Path::stroked(now, dashed).into(),
        Path::filled(straight(from, (18.0, 0.0), 1.6), theme.ink).into(),
    ]
}
