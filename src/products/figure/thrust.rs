//! Draws the line of thrust: the path of the compressive forces through the blocks, from interface to interface.
//!
//! [`segments`] computes the line in each block, along true lines of action. If there is no single line of action in a
//! block, a lighter line connects the joints; the legend calls it schematic. The line therefore runs from support to
//! support without gaps. Of a frame that falls, the line is that of the forces with the missing forces; where a joint
//! would have to pull, it leaves the stone.

mod chain;
mod fan;
mod leaving;
mod line;
mod state;

use std::borrow::Cow;

use fan::Fans;
use leaving::{left_at, with_missing_forces};
use line::{carried_colour, colour, dot_symbol, dots, left_symbol, lines, schematic_colour, seams, widest, width};
use state::{central_thrust_text, has_many_lines, limit_entries, limits, other_figures_note, uniqueness_note};

use super::arrow::Marks;
use super::content::{About, FrameSource, PanelContent};
use super::context::FigureContext;
use super::funicular::segments;
use super::label;
use super::legend::{self, Entry};
use super::option::ArrowScale;
use super::panel::composed;
use super::pen::Pen;
use super::verdict;
use super::words::quantity;
use crate::geometry::Bounds;
use crate::mechanics::analysis::{Analysis, FrameAnalysis, MarginKind, ThrustStates, Verdict};
use crate::pictures::drawing::Group;

/// The figure of the line of thrust.
pub(crate) struct ThrustLine;

impl PanelContent for ThrustLine {
    fn about(&self) -> About {
        About {
            name: "thrust",
            help: "The line of thrust through the blocks",
            title: "The line of thrust in a dry-laid structure",
            ..About::default()
        }
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        let mut frames = 0..analysis.frames.len();
        if frames.any(|frame| analysis.thrust_states(frame).least.is_some()) { &[MarginKind::Kernel] } else { &[] }
    }

    fn extent(&self, of: FrameSource<'_>, unit: f64, _marks: &Marks) -> Option<Bounds> {
        let FrameSource { analysis, frame, options } = of;
        if analysis.frames[frame].verdict == Verdict::Unstable {
            let scene = &analysis.scene;
            let segments = segments(scene, &scene.frames[frame], &with_missing_forces(&analysis.frames[frame]));
            return Some(Bounds::from_points(segments.iter().flat_map(|s| [s.from, s.to]))?.grown(0.2 * unit));
        }
        if !options.with_polygon {
            return None;
        }
        let states = analysis.thrust_states(frame);
        Some(fans(analysis, frame, &states, unit)?.bounds)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame, camera) = (pen.context, pen.number, pen.camera);
        let scene = &context.analysis.scene;
        let frame_analysis = &context.analysis.frames[frame];
        let family = context.thrust_states(frame);
        let frame_analysis = &*shown(family, frame_analysis);
        let segments = segments(scene, &scene.frames[frame], frame_analysis);
        let mut ink = label::ink(pen);
        for segment in &segments {
            let [from, to] = [segment.from, segment.to].map(|p| camera.place(p));
            ink.line(from, to, width(pen, segment) + 1.0);
        }
        let seams = seams(pen, frame_analysis);
        let [least, greatest] = limits(pen, family, &mut ink);
        let dots = dots(pen, frame_analysis, &mut |at, radius| ink.disc(at, radius + 1.0));
        let lines = lines(pen, scene, frame_analysis, &segments);
        let loads = pen.arrows(false);
        let fans =
            if context.options.with_polygon { fans(context.analysis, frame, family, context.unit) } else { None };
        let theme = &context.options.theme;
        let polygon = fans.map(|fans| fans.draw(scene, frame_analysis, camera, theme, &mut ink));
        let marks = [seams, least, greatest, lines, dots, loads];
        let marks = marks.into_iter().chain(polygon).collect();
        composed(pen, view, pen.blocks(), marks, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let (scene, theme) = (&context.analysis.scene, &context.options.theme);
        let frames = scene.frames.iter().zip(&context.analysis.frames);
        let (mut through, mut schematic, mut falls, mut leaves) = (false, false, false, false);
        for (number, (frame, frame_analysis)) in frames.enumerate() {
            let state = shown(context.thrust_states(number), frame_analysis);
            let segments = segments(scene, frame, &state);
            leaves |= state.contacts.iter().any(|contact| left_at(contact).is_some());
            match frame_analysis.verdict {
                Verdict::Stable => {
                    through |= segments.iter().any(|s| s.through);
                    schematic |= segments.iter().any(|s| !s.through);
                }
                _ => falls |= !segments.is_empty(),
            }
        }
        let mut entries = Vec::new();
        if context.options.scale == ArrowScale::Strip {
            entries.extend(legend::shared_scale(context, unit));
        }
        let largest = quantity(largest(context), context.analysis.scene.units.force());
        if through {
            let line = line_text(context, &largest);
            entries.push(Entry::Line(colour(theme), widest(unit), line));
        }
        if falls {
            let mut frames = context.analysis.frames.iter();
            let any_falls = frames.any(|frame| frame.verdict == Verdict::Unstable);
            let line = if any_falls { "line of thrust with the missing forces" } else { "forces found" };
            let line = format!("{line}; this width shows {largest}");
            entries.push(Entry::Line(carried_colour(theme), widest(unit), line));
        }
        if through || schematic || falls {
            let dot = if context.options.is_column() { "resultant" } else { "where a joint's resultant acts" };
            entries.push(Entry::Symbol(dot_symbol, 8.0, dot.to_owned()));
            entries.extend(limit_entries(context));
        }
        if leaves {
            entries.push(Entry::Symbol(left_symbol, 10.0, "the line leaves the stone".to_owned()));
        }
        if schematic {
            // Only one entry of the legend explains what the width of the line means.
            let width = (!through && !falls).then_some(&*largest);
            let what = schematic_text(context, width);
            entries.push(Entry::Line(schematic_colour(theme), widest(unit), what));
        }
        if context.options.with_polygon {
            entries.push(Entry::Note(polygon_note(context).to_owned()));
        }
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let (scene, frame_analysis) = (&context.analysis.scene, &context.analysis.frames[frame]);

        let why = verdict::reason(scene, frame_analysis);
        match frame_analysis.verdict {
            Verdict::Stable => {
                let state =
                    other_figures_note(context, frame).or_else(|| uniqueness_note(context, frame).map(str::to_owned));
                let parts = [Some(why).filter(|why| !why.is_empty()), state];
                parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
            }
            Verdict::Unstable => {
                let state = shown(context.thrust_states(frame), frame_analysis);
                match state.contacts.iter().filter(|contact| left_at(contact).is_some()).count() {
                    0 => "the line of thrust needs the missing forces".into(),
                    1 => "the line of thrust leaves the stone at one joint".into(),
                    count => format!("the line of thrust leaves the stone at {count} joints"),
                }
            }
            Verdict::Undecided => format!("no line of thrust is proved; {why}"),
        }
    }
}

/// Returns the text of the legend for schematic lines. `largest` is the force that the width of the thickest line shows;
/// `None` if another entry states it.
fn schematic_text(context: &FigureContext<'_>, largest: Option<&str>) -> String {
    let shows = largest.map_or_else(String::new, |largest| format!(" (this width shows {largest})"));
    if context.options.is_column() {
        format!("schematic{shows}: no single line of action in the block")
    } else {
        format!("schematic{shows}: no single line of action runs through the block")
    }
}

/// Returns the text of the legend for the line of thrust of frames that stand: which forces it shows, and the force
/// that the thickest line shows (`largest`).
fn line_text(context: &FigureContext<'_>, largest: &str) -> String {
    let mut frames = 0..context.analysis.frames.len();
    match central_thrust_text(context) {
        Some(thrust) if thrust.is_empty() => format!("most central line; this width shows {largest}"),
        Some(thrust) => format!("most central line, {thrust}; this width shows {largest}"),
        None if frames.any(|frame| has_many_lines(context, frame)) => {
            format!("line of thrust of the forces of least sum; this width shows {largest}")
        }
        None => format!("line of thrust; this width shows {largest}"),
    }
}

/// Returns the forces whose line of thrust the figure shows: the most central forces, those farthest from the ends of
/// the joints, if they are known. Otherwise returns the forces that the analysis found, for a frame that falls with its
/// missing forces.
fn shown<'a>(states: &'a ThrustStates, found: &'a FrameAnalysis) -> Cow<'a, FrameAnalysis> {
    match &states.central {
        _ if found.verdict == Verdict::Unstable => Cow::Owned(with_missing_forces(found)),
        Some(state) => Cow::Borrowed(&state.frame),
        None => Cow::Borrowed(found),
    }
}

/// Returns the magnitude of the largest force of a joint or a robot in any panel, N.
fn largest(context: &FigureContext<'_>) -> f64 {
    let given = context.analysis.frames.iter().enumerate();
    let frames = given.map(|(number, frame_analysis)| shown(context.thrust_states(number), frame_analysis));
    let frames: Vec<Cow<'_, FrameAnalysis>> = frames.collect();
    let contacts = frames.iter().flat_map(|f| &f.contacts);
    let robots = frames.iter().flat_map(|f| &f.robots);
    let forces = contacts.map(|c| c.resultant.force).chain(robots.map(|r| r.force));
    forces.map(|f| f.norm()).fold(0.0, f64::max)
}

/// Returns the force polygon for the line of thrust that the figure shows. Returns `None` if the frame does not stand,
/// or if no chain of blocks has a horizontal thrust. `unit` is the unit length in metres.
fn fans(analysis: &Analysis, frame: usize, states: &ThrustStates, unit: f64) -> Option<Fans> {
    let scene = &analysis.scene;
    let frame_analysis = &analysis.frames[frame];
    let shown = shown(states, frame_analysis);
    (frame_analysis.verdict == Verdict::Stable).then(|| Fans::new(scene, &scene.frames[frame], &shown, unit)).flatten()
}

/// Returns the note in the legend that explains the force polygon, or why there is none.
fn polygon_note(context: &FigureContext<'_>) -> &'static str {
    let mut frames = 0..context.analysis.frames.len();
    let any = frames.any(|frame| {
        let states = context.thrust_states(frame);
        fans(context.analysis, frame, states, context.unit).is_some()
    });
    if any {
        "force polygon: each ray from the pole O is the force in the joint with the same number"
    } else {
        "no force polygon: no chain of blocks in a standing frame has a horizontal thrust"
    }
}
