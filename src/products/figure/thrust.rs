//! Draws the line of thrust: the path of the compressive forces through the blocks, from interface to interface.
//!
//! [`segments`] computes the line in each block, along true lines of action. If there is no single line of action in a
//! block, a lighter line joins the joints; the legend calls it schematic. So the line runs from support to support
//! without gaps. The tips of load arrows are at the points where loads act, and their lengths have one scale.

mod chain;
mod fan;

use fan::Fans;

use super::arrow::{ArrowKind, ForceArrow, Marks, TurnKind};
use super::bearing::bearings;
use super::by_colour::ByColour;
use super::content::{About, FrameSource, PanelContent};
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
use crate::analysis::{
    Analysis, Contact, FrameAnalysis, MarginKind, ThrustState, ThrustStates, Verdict,
};
use crate::drawing::placement::Ink;
use crate::drawing::{Colour, Group, Item, Outline, PagePoint, Path, Stroke, Theme};
use crate::geometry::Bounds;
use crate::interface::ContactKind;
use crate::scene::{BodyId, Frame, Scene};

/// Width of the line of the largest force, unit edges; its least and its largest width, pixels.
const LARGEST_WIDTH: (f64, f64, f64) = (0.13, 1.8, 6.5);
/// Width of the line of a force of zero, as a share of the largest width.
const MIN_WIDTH_SHARE: f64 = 0.22;
/// Number of widths if lines of many blocks are joined into few paths.
const WIDTH_STEPS: f64 = 8.0;

/// Width of the lines of least and of greatest thrust, pixels, and their dashes.
const THIN: f64 = 1.3;
const LEAST_DASHES: [f64; 2] = [7.0, 3.0];
const GREATEST_DASHES: [f64; 2] = [2.0, 2.4];

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
        match frames.any(|frame| analysis.thrust_states(frame).least.is_some()) {
            true => &[MarginKind::Kernel],
            false => &[],
        }
    }

    fn largest_force(&self, of: FrameSource<'_>) -> f64 {
        let FrameSource {
            analysis, frame, ..
        } = of;
        largest_load(&analysis.scene, &analysis.scene.frames[frame])
    }

    fn marks(&self, of: FrameSource<'_>, newtons_per_unit: f64) -> Marks {
        marks(of.analysis, of.frame, of.options, newtons_per_unit)
    }

    fn extent(&self, of: FrameSource<'_>, unit: f64, _marks: &Marks) -> Option<Bounds> {
        let FrameSource {
            analysis,
            frame,
            options,
        } = of;
        if !options.with_polygon {
            return None;
        }
        let states = analysis.thrust_states(frame);
        Some(fans(analysis, frame, &states, unit)?.bounds)
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame, camera) = (pen.context, pen.number, pen.camera);
        let scene = &context.analysis.scene;
        let found = &context.analysis.frames[frame];
        let family = context.thrust_states(frame);
        // Show the most central state if it is known.
        let found = family.central.as_ref().map_or(found, |state| &state.frame);
        let segments = segments(scene, &scene.frames[frame], found);
        let mut ink = label::ink(pen);
        for segment in &segments {
            let [from, to] = [segment.from, segment.to].map(|p| camera.place(p));
            ink.line(from, to, width(pen, segment) + 1.0);
        }
        let seams = seams(pen, found);
        let [least, greatest] = limits(pen, family, &mut ink);
        let dots = dots(pen, found, &mut |at, radius| ink.disc(at, radius + 1.0));
        let lines = lines(pen, scene, found, &segments);
        let loads = pen.arrows(false);
        let fans = match context.options.with_polygon {
            true => fans(context.analysis, frame, family, context.unit),
            false => None,
        };
        let theme = &context.options.theme;
        let polygon = fans.map(|fans| fans.draw(scene, found, camera, theme, &mut ink));
        let marks = [seams, least, greatest, lines, dots, loads];
        let marks = marks.into_iter().chain(polygon).collect();
        composed(pen, view, pen.blocks(), marks, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, unit: f64) -> Vec<Entry> {
        let (scene, theme) = (&context.analysis.scene, &context.options.theme);
        let frames = scene.frames.iter().zip(&context.analysis.frames);
        let (mut stands, mut schematic, mut falls) = (false, false, false);
        for (frame, found) in frames {
            let segments = segments(scene, frame, found);
            match found.verdict {
                Verdict::Stable => {
                    stands |= !segments.is_empty();
                    schematic |= segments.iter().any(|s| !s.through);
                }
                _ => falls |= !segments.is_empty(),
            }
        }
        let mut entries = Vec::new();
        if context.options.scale == ArrowScale::Strip {
            entries.extend(legend::shared_scale(context, unit));
        }
        let largest = quantity(largest(context), "N");
        if stands {
            let line = match central(context) {
                Some(thrust) => format!("most central line{thrust}; this thick for {largest}"),
                None => format!("line of thrust, this thick for {largest}"),
            };
            entries.push(Entry::Line(colour(theme), widest(unit), line));
        }
        if falls {
            let line = format!("what is carried where it falls, this thick for {largest}");
            entries.push(Entry::Line(carried_colour(theme), widest(unit), line));
        }
        if stands || falls {
            let dot = "where a joint's resultant acts".to_owned();
            entries.push(Entry::Sign(dot_sign, 8.0, dot));
            entries.extend(limit_entries(context));
        }
        if schematic {
            let what = "schematic: no single line of action runs through the block".to_owned();
            entries.push(Entry::Line(schematic_colour(theme), widest(unit), what));
        }
        if context.options.with_polygon {
            entries.push(Entry::Note(polygon_note(context).to_owned()));
        }
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let (scene, found) = (&context.analysis.scene, &context.analysis.frames[frame]);

        let why = verdict::reason(scene, found);
        match found.verdict {
            Verdict::Stable => {
                let state = other_figures(context, frame).or_else(|| one_of_many(context, frame));
                let parts = [Some(why).filter(|why| !why.is_empty()), state];
                parts.into_iter().flatten().collect::<Vec<_>>().join("; ")
            }
            Verdict::Unstable => "what is carried is no line of equilibrium".into(),
            Verdict::Undecided => format!("no line of equilibrium is proved; {why}"),
        }
    }
}

/// Returns the loads of a frame as arrows whose tips are at the points where they act. An arrow of `newtons_per_unit` N
/// is one unit edge long.
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
    // Without arrows the legend needs no scale.
    if loads.arrows.is_empty() && loads.turns.is_empty() {
        Marks::default()
    } else {
        loads
    }
}

/// Returns the largest force of the listed loads of a frame, N; weights are not included.
pub(crate) fn largest_load(scene: &Scene, frame: &Frame) -> f64 {
    let loads = scene
        .loads
        .iter()
        .filter(|l| frame.placed.contains(&l.block));
    loads.map(|l| l.force.norm()).fold(0.0, f64::max)
}

/// Returns the largest force of all panels, N.
fn largest(context: &FigureContext<'_>) -> f64 {
    let given = context.analysis.frames.iter().enumerate();
    let frames = given.map(|(number, found)| {
        let central = context.thrust_states(number).central.as_ref();
        central.map_or(found, |state| &state.frame)
    });
    let frames: Vec<&FrameAnalysis> = frames.collect();
    let contacts = frames.iter().flat_map(|f| &f.contacts);
    let robots = frames.iter().flat_map(|f| &f.robots);
    let forces = contacts
        .map(|c| c.resultant.force)
        .chain(robots.map(|r| r.force));
    forces.map(|f| f.norm()).fold(0.0, f64::max)
}

/// The force polygon of the state that the figure shows; `None` if no chain of blocks has a thrust, or nothing stands.
fn fans(analysis: &Analysis, frame: usize, states: &ThrustStates, unit: f64) -> Option<Fans> {
    let scene = &analysis.scene;
    let found = &analysis.frames[frame];
    let shown = states.central.as_ref().map_or(found, |state| &state.frame);
    (found.verdict == Verdict::Stable)
        .then(|| Fans::new(scene, &scene.frames[frame], shown, unit))
        .flatten()
}

/// What the legend says about the force polygon.
fn polygon_note(context: &FigureContext<'_>) -> &'static str {
    let mut frames = 0..context.analysis.frames.len();
    let any = frames.any(|frame| {
        let states = context.thrust_states(frame);
        fans(context.analysis, frame, states, context.unit).is_some()
    });
    match any {
        true => {
            "force polygon: each ray from the pole O is the force in the joint of the same number"
        }
        false => "no force polygon: no chain of blocks that stands has a thrust",
    }
}

fn colour(theme: &Theme) -> Colour {
    theme.motion
}

/// Returns the colour of schematic lines.
fn schematic_colour(theme: &Theme) -> Colour {
    theme.page.mixed(theme.motion, 0.45)
}

/// Returns the colour of what a frame that does not stand carries: weaker than a line of equilibrium, visible in print.
fn carried_colour(theme: &Theme) -> Colour {
    theme.block.mixed(theme.faint, 0.7)
}

fn widest(unit: f64) -> f64 {
    let (width, least, most) = LARGEST_WIDTH;
    (width * unit).clamp(least, most)
}

/// Returns the width of a segment, pixels.
fn width(pen: &Pen<'_>, segment: &ThrustSegment) -> f64 {
    let share = segment.force.norm() / largest(pen.context).max(f64::MIN_POSITIVE);
    let share = share.min(1.0);
    widest(pen.unit()) * (MIN_WIDTH_SHARE + (1.0 - MIN_WIDTH_SHARE) * share)
}

/// Formats the horizontal thrust of a state (N): `, horizontal thrust 28.3 kN`. Empty for several frames, whose thrusts
/// differ.
fn amount_in_words(context: &FigureContext<'_>, thrust: f64) -> String {
    if context.analysis.frames.len() == 1 {
        format!(", horizontal thrust {}", quantity(thrust, "N"))
    } else {
        String::new()
    }
}

/// Returns the thrust states of all frames.
fn families<'c>(context: &'c FigureContext<'_>) -> impl Iterator<Item = &'c ThrustStates> {
    (0..context.analysis.frames.len()).map(|frame| context.thrust_states(frame))
}

/// Returns the text of the legend on the thrust of the most central line; `None` if no frame shows this line.
fn central(context: &FigureContext<'_>) -> Option<String> {
    let state = families(context).find_map(|family| family.central.as_ref())?;
    Some(amount_in_words(context, state.thrust))
}

/// Returns the legend entries for the lines of least and greatest thrust.
fn limit_entries(context: &FigureContext<'_>) -> Vec<Entry> {
    let least = families(context).find_map(|family| family.least.as_ref());
    let greatest = families(context).find_map(|family| family.greatest.as_ref());
    let entry = |state: Option<&ThrustState>, sign: fn(PagePoint, &Theme) -> Vec<Item>, name| {
        let words = amount_in_words(context, state?.thrust);
        let words = words.replace(", horizontal thrust", "");
        Some(Entry::Sign(sign, 26.0, format!("{name}{words}")))
    };
    [
        entry(least, least_sign, "least thrust"),
        entry(greatest, greatest_sign, "greatest thrust"),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// Returns a note that other figures show another state of the frame; `None` if no states of least thrust are known.
fn other_figures(context: &FigureContext<'_>, frame: usize) -> Option<String> {
    let family = context.thrust_states(frame);
    family.least.as_ref()?;
    let present = quantity(family.present, "N");
    Some(format!(
        "other figures show the forces of least sum, with a horizontal thrust of {present}"
    ))
}

/// Names the state that a frame without a family of lines shows; `None` if balance alone fixes all forces.
fn one_of_many(context: &FigureContext<'_>, frame: usize) -> Option<String> {
    let (scene, found) = (&context.analysis.scene, &context.analysis.frames[frame]);
    let unknowns = |contact: &Contact| match contact.interface.kind {
        ContactKind::Corner => 2,
        _ => 3,
    };
    let contacts: usize = found.contacts.iter().map(unknowns).sum();
    let unknowns = contacts + 3 * found.robots.len();
    (unknowns > 3 * scene.frames[frame].placed.len())
        .then(|| "the line shown is that of the forces of least sum".to_owned())
}

/// Draws thin lines of least and of greatest thrust.
fn limits(pen: &Pen<'_>, family: &ThrustStates, ink: &mut Ink) -> [Group; 2] {
    let scene = &pen.context.analysis.scene;
    let states = [
        (&family.least, "thrust-least", "Least thrust", LEAST_DASHES),
        (
            &family.greatest,
            "thrust-greatest",
            "Greatest thrust",
            GREATEST_DASHES,
        ),
    ];
    states.map(|(state, class, name, dashes)| {
        let Some(state) = state else {
            return Group::default();
        };
        let mut outline = Outline::default();
        for piece in segments(scene, &scene.frames[pen.number], &state.frame) {
            let [from, to] = [piece.from, piece.to].map(|p| pen.camera.place(p));
            ink.line(from, to, THIN);
            outline.extend(Outline::line([from, to]));
        }
        let thrust = quantity(state.thrust, "N");
        let title = format!("{name}: {thrust} horizontally");
        let group = Group::with_class(class).titled(title);
        group.with(thin(outline, dashes, &pen.context.options.theme))
    })
}

fn thin(outline: Outline, dashes: [f64; 2], theme: &Theme) -> Path {
    let colour = colour(theme).mixed(theme.ink, 0.45);
    Path::stroked(outline, Stroke::new(colour, THIN).dashed(dashes))
}

fn least_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(26.0, 0.0)]);
    vec![thin(line, LEAST_DASHES, theme).into()]
}

fn greatest_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(26.0, 0.0)]);
    vec![thin(line, GREATEST_DASHES, theme).into()]
}

/// Draws every interface as a line.
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

/// Draws the line of thrust: first its schematic parts, above them its true lines of action.
fn lines(pen: &Pen<'_>, scene: &Scene, found: &FrameAnalysis, segments: &[ThrustSegment]) -> Group {
    let mut group = Group::with_class("thrust");
    for through in [false, true] {
        let mut alike = segments.iter().filter(|s| s.through == through).peekable();
        if alike.peek().is_none() {
            continue;
        }
        if pen.many() {
            group.items.extend(joined_lines(pen, found, alike, through));
            continue;
        }
        for segment in alike {
            let class = if through { "force" } else { "schematic" };
            let line = Outline::line([segment.from, segment.to].map(|p| pen.camera.place(p)));
            let drawn = Group::with_class(class)
                .titled(title(scene, found, segment))
                .with(stroked(pen, found, line, width(pen, segment), through));
            group.items.push(drawn.into());
        }
    }
    group
}

/// Returns a line of this width in pixels, grey if the frame does not stand. `through` is false for schematic lines.
fn stroked(
    pen: &Pen<'_>,
    found: &FrameAnalysis,
    outline: Outline,
    width: f64,
    through: bool,
) -> Path {
    let theme = &pen.context.options.theme;
    let colour = match found.verdict {
        Verdict::Stable if through => colour(theme),
        Verdict::Stable => schematic_colour(theme),
        _ => carried_colour(theme),
    };
    Path::stroked(outline, Stroke::new(colour, width))
}

/// Draws the segments of very many blocks as few paths: one for all segments of about the same width.
fn joined_lines<'s>(
    pen: &Pen<'_>,
    found: &FrameAnalysis,
    segments: impl Iterator<Item = &'s ThrustSegment>,
    through: bool,
) -> Vec<Item> {
    let mut steps: Vec<Outline> = vec![Outline::default(); WIDTH_STEPS as usize + 1];
    let most = widest(pen.unit());
    for segment in segments {
        let step = (WIDTH_STEPS * width(pen, segment) / most).round() as usize;
        let line = Outline::line([segment.from, segment.to].map(|p| pen.camera.place(p)));
        steps[step.min(WIDTH_STEPS as usize)].extend(line);
    }
    let drawn = steps.into_iter().enumerate();
    let drawn = drawn.filter(|(_, outline)| !outline.segments.is_empty());
    drawn
        .map(|(step, outline)| {
            let width = most * step as f64 / WIDTH_STEPS;
            stroked(pen, found, outline, width, through).into()
        })
        .collect()
}

/// Describes a segment of the line: the block, the origin of the force and its magnitude.
fn title(scene: &Scene, found: &FrameAnalysis, segment: &ThrustSegment) -> String {
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
    let force = force(segment.force);
    if segment.through {
        format!("Force on block {on} from {by}: {force}")
    } else {
        format!("Schematic path through block {on} of the force from {by}: {force}")
    }
}

/// Draws a dot at the point of action of each interface's resultant. Calls `ink` with the position and the radius in
/// pixels of each dot.
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
