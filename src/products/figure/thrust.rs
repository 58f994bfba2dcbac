//! The line of thrust: how pressure runs through the blocks, from interface to interface.
//!
//! What the line is in each block, [`segments`] says: it runs along true lines of action only, and where there is no
//! single line it stops at the joints. Loads are arrows that end where they act; between them lengths compare.

use super::arrow::{ArrowKind, ForceArrow, Marks, TurnKind};
use super::bearing::bearings;
use super::by_colour::ByColour;
use super::content::PanelContent;
use super::context::FigureContext;
use super::description;
use super::funicular::{ForceOrigin, ThrustSegment, segments};
use super::label;
use super::legend::{self, Entry};
use super::mark;
use super::option::{ArrowScale, Options};
use super::panel::composed;
use super::pen::Pen;
use super::verdict;
use super::words::{force, quantity};
use crate::analysis::{Analysis, FrameAnalysis, Verdict};
use crate::drawing::{Camera, Colour, Group, Item, Outline, PagePoint, Path, Stroke, Theme};
use crate::geometry::Bounds;
use crate::scene::{BodyId, Frame, Scene};

/// Width of the line of the largest force, unit edges; its least and its largest width, pixels.
const LARGEST_WIDTH: (f64, f64, f64) = (0.13, 1.8, 6.5);
/// Width of the line of the smallest force, as a share of the widest.
const MIN_WIDTH_SHARE: f64 = 0.22;
/// Where lines of many blocks are joined into one path, their widths are rounded to this many steps.
const WIDTH_STEPS: f64 = 8.0;
/// Opacity of a line that is not one of equilibrium.
const FAINT_OPACITY: f64 = 0.35;

/// The figure of the line of thrust.
pub(crate) struct ThrustLine;

impl PanelContent for ThrustLine {
    fn name(&self) -> &'static str {
        "thrust"
    }

    fn help(&self) -> &'static str {
        "The line of thrust through the blocks"
    }

    fn title(&self) -> &'static str {
        "The line of thrust in a dry-laid structure"
    }

    fn largest_force(&self, analysis: &Analysis, frame: usize, _: &Options) -> f64 {
        largest_load(&analysis.scene, &analysis.scene.frames[frame])
    }

    fn marks(
        &self,
        analysis: &Analysis,
        frame: usize,
        options: &Options,
        newtons_per_unit: f64,
    ) -> Marks {
        marks(analysis, frame, options, newtons_per_unit)
    }

    fn picture(
        &self,
        context: &FigureContext<'_>,
        frame: usize,
        view: Bounds,
        camera: &Camera,
    ) -> Group {
        let pen = Pen::new(context, frame, camera);
        let scene = &context.analysis.scene;
        let found = &context.analysis.frames[frame];
        let segments = segments(scene, &scene.frames[frame], found, context.unit);
        let mut ink = label::ink(&pen);
        for segment in &segments {
            let [from, to] = [segment.from, segment.to].map(|p| camera.place(p));
            ink.line(from, to, width(&pen, segment) + 1.0);
        }
        let seams = seams(&pen, found);
        let dots = dots(&pen, found, &mut |at, radius| ink.disc(at, radius + 1.0));
        let lines = lines(&pen, scene, found, &segments);
        let loads = pen.arrows(false);
        composed(
            &pen,
            view,
            pen.blocks(),
            vec![seams, lines, dots, loads],
            ink,
        )
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let (scene, theme) = (&context.analysis.scene, &context.options.theme);
        let frames = scene.frames.iter().zip(&context.analysis.frames);
        let (mut through, mut stopped) = (false, false);
        for (frame, found) in frames {
            let segments = segments(scene, frame, found, context.unit);
            through |= segments.iter().any(|s| s.through);
            stopped |= segments.iter().any(|s| !s.through);
        }
        let mut entries = Vec::new();
        if context.options.scale == ArrowScale::Strip {
            let newtons = context.marks.iter().map(|m| m.newtons_per_unit);
            let newtons = newtons.fold(0.0, f64::max);
            entries.extend(legend::scale(newtons, unit, context.options));
        }
        if through || stopped {
            let largest = quantity(largest(context), "N");
            let line = format!("line of thrust, this thick for {largest}");
            entries.push(Entry::Line(colour(theme), widest(unit), line));
            let dot = "where a joint's resultant acts".to_owned();
            entries.push(Entry::Sign(dot_sign, 8.0, dot));
        }
        if stopped {
            let what = "ends where no single line runs through a block".to_owned();
            entries.push(Entry::Sign(end_sign, 26.0, what));
        }
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let (scene, found) = (&context.analysis.scene, &context.analysis.frames[frame]);

        let why = verdict::reason(scene, found);
        match found.verdict {
            Verdict::Stable => why,
            Verdict::Unstable => "faint, what is carried: it is no line of equilibrium".into(),
            Verdict::Undecided => format!("no line of equilibrium is proved; {why}"),
        }
    }
}

/// The loads of a frame as arrows that end where they act; `newtons_per_unit` N are one unit edge long.
pub(crate) fn marks(
    analysis: &Analysis,
    frame: usize,
    options: &Options,
    newtons_per_unit: f64,
) -> Marks {
    let marks = mark::marks(analysis, frame, options, newtons_per_unit);
    let loads = marks.arrows.into_iter();
    let loads = loads.filter(|arrow| arrow.kind == ArrowKind::Load);
    let ended = loads.map(|arrow| ForceArrow {
        at: arrow.at - arrow.vector,
        ..arrow
    });
    let turns = marks.turns.into_iter();
    let turns = turns.filter(|turn| turn.kind == TurnKind::Load);
    let loads = Marks {
        arrows: ended.collect(),
        turns: turns.collect(),
        newtons_per_unit,
    };
    // Without loads there are no arrows, and nothing to give a scale for.
    if loads.arrows.is_empty() && loads.turns.is_empty() {
        Marks::default()
    } else {
        loads
    }
}

/// The largest load on the blocks of a frame, N.
pub(crate) fn largest_load(scene: &Scene, frame: &Frame) -> f64 {
    let loads = scene
        .loads
        .iter()
        .filter(|l| frame.placed.contains(&l.block));
    loads.map(|l| l.force.norm()).fold(0.0, f64::max)
}

/// The largest force of all panels, N.
fn largest(context: &FigureContext<'_>) -> f64 {
    let frames = &context.analysis.frames;
    let contacts = frames.iter().flat_map(|f| &f.contacts);
    let robots = frames.iter().flat_map(|f| &f.robots);
    let forces = contacts
        .map(|c| c.resultant.force)
        .chain(robots.map(|r| r.force));
    forces.map(|f| f.norm()).fold(0.0, f64::max)
}

fn colour(theme: &Theme) -> Colour {
    theme.motion
}

fn widest(unit: f64) -> f64 {
    let (width, least, most) = LARGEST_WIDTH;
    (width * unit).clamp(least, most)
}

/// Width of a segment, pixels.
fn width(pen: &Pen<'_>, segment: &ThrustSegment) -> f64 {
    let share = segment.force.norm() / largest(pen.context).max(f64::MIN_POSITIVE);
    let share = share.min(1.0);
    widest(pen.unit()) * (MIN_WIDTH_SHARE + (1.0 - MIN_WIDTH_SHARE) * share)
}

/// Every interface as a line.
fn seams(pen: &Pen<'_>, found: &FrameAnalysis) -> Group {
    let theme = &pen.context.options.theme;
    let mut outline = Outline::default();
    for contact in &found.contacts {
        outline.extend(Outline::line(
            contact.interface.ends.map(|p| pen.camera.place(p)),
        ));
    }
    let stroke = Stroke::new(theme.outline.mixed(theme.ink, 0.4), 1.3 * pen.line);
    let seams = Group::with_class("interfaces").titled("Interfaces");
    if outline.segments.is_empty() {
        return Group::default();
    }
    seams.with(Path::stroked(outline, stroke))
}

fn lines(pen: &Pen<'_>, scene: &Scene, found: &FrameAnalysis, segments: &[ThrustSegment]) -> Group {
    let theme = &pen.context.options.theme;
    let opacity = match found.verdict {
        Verdict::Stable => 1.0,
        _ => FAINT_OPACITY,
    };
    let mut group = Group::with_class("thrust");
    let line = |s: &ThrustSegment| Outline::line([s.from, s.to].map(|p| pen.camera.place(p)));
    let path = |outline, width| {
        let stroke = Stroke::new(colour(theme), width);
        Path::stroked(outline, stroke).with_opacity(opacity)
    };
    if pen.many() {
        let mut steps: Vec<Outline> = vec![Outline::default(); WIDTH_STEPS as usize + 1];
        let most = widest(pen.unit());
        for segment in segments {
            let step = (WIDTH_STEPS * width(pen, segment) / most).round() as usize;
            steps[step.min(WIDTH_STEPS as usize)].extend(line(segment));
        }
        for (step, outline) in steps.into_iter().enumerate() {
            if !outline.segments.is_empty() {
                let width = most * step as f64 / WIDTH_STEPS;
                group.items.push(path(outline, width).into());
            }
        }
        return group;
    }
    for segment in segments {
        let on = &scene.blocks[segment.on.0].id;
        let by = match segment.origin {
            ForceOrigin::Contact(number) => {
                let [a, b] = found.contacts[number].interface.bodies;
                let other = if a == BodyId::Block(segment.on) { b } else { a };
                description::named(scene, other)
            }
            ForceOrigin::Robot(robot) => format!("robot {}", scene.robots[robot.0].id),
            ForceOrigin::Load(_) => "a load".to_owned(),
            ForceOrigin::Resultant => "a joint and its loads together".to_owned(),
        };
        let title = format!("Force on block {on} from {by}: {}", force(segment.force));
        let drawn = Group::with_class("force").titled(title);
        let drawn = drawn.with(path(line(segment), width(pen, segment)));
        group.items.push(drawn.into());
    }
    group
}

/// A dot where each interface's resultant sits, and where a robot grips.
fn dots(pen: &Pen<'_>, found: &FrameAnalysis, ink: &mut dyn FnMut(PagePoint, f64)) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let radius = (0.06 * pen.unit()).clamp(1.1, 3.6);
    let mut group = Group::with_class("resultants");
    let mut joined = ByColour::default();
    for (contact, bearing) in found.contacts.iter().zip(bearings(scene, found)) {
        if bearing.is_none() {
            continue;
        }
        let at = pen.camera.place(contact.resultant.at);
        ink(at, radius);
        if pen.many() {
            joined.add(theme.ink, Outline::circle(at, radius));
            continue;
        }
        let pair = description::pair(scene, contact.interface.bodies);
        let amount = quantity(contact.resultant.force.norm(), "N");
        let dot = Group::with_class("resultant").titled(format!("Between {pair}: {amount}"));
        group.items.push(dot.with(dot_at(at, radius, theme)).into());
    }
    group.items.extend(joined.paths(None));
    group
}

fn dot_at(at: PagePoint, radius: f64, theme: &Theme) -> Path {
    Path::filled(Outline::circle(at, radius), theme.ink).cased(theme.page, 0.3 * radius)
}

fn dot_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![dot_at(at.moved(4.0, 0.0), 3.2, theme).into()]
}

/// A joint with a short piece on either side.
fn end_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let dot = at.moved(13.0, 0.0);
    let piece = Outline::line([at.moved(3.0, 0.0), at.moved(23.0, 0.0)]);
    vec![
        Path::stroked(piece, Stroke::new(colour(theme), 2.6)).into(),
        dot_at(dot, 3.2, theme).into(),
    ]
}
