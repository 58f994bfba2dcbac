//! Draws a line of thrust, the interfaces, and a dot at the point of each interface where its resultant acts.

use super::super::bearing::bearings;
use super::super::by_colour::ByColour;
use super::super::description;
use super::super::funicular::{ForceOrigin, ThrustSegment};
use super::super::pen::Pen;
use super::super::words::{force, quantity};
use super::largest;
use super::leaving::left_at;
use crate::mechanics::analysis::{FrameAnalysis, Verdict};
use crate::mechanics::scene::{BodyId, Scene};
use crate::pictures::drawing::{Colour, Group, Item, Outline, PagePoint, Path, Stroke, Theme};

/// The width of the line of thrust for the largest force in unit lengths, with the least and the largest value of this
/// width in pixels.
const LARGEST_FORCE_WIDTH: (f64, f64, f64) = (0.13, 1.8, 6.5);
/// Width of the line for a force of zero, as a fraction of the width for the largest force.
const MIN_WIDTH_SHARE: f64 = 0.22;
/// Number of different line widths in frames with very many blocks, in which all lines of one width are one path.
const WIDTH_STEPS: f64 = 8.0;

/// Returns the colour of the line of thrust.
pub(super) fn colour(theme: &Theme) -> Colour {
    theme.motion
}

/// Returns the colour of the schematic parts of the line of thrust.
pub(super) fn schematic_colour(theme: &Theme) -> Colour {
    theme.page.mixed(theme.motion, 0.45)
}

/// Returns the colour of the line in a frame that does not stand: a grey that is visible in print. A line of thrust in
/// equilibrium has the colour [`colour`].
pub(super) fn carried_colour(theme: &Theme) -> Colour {
    theme.block.mixed(theme.faint, 0.7)
}

/// Returns the width of the line where it carries the largest force, in pixels. `unit` is the unit length in pixels.
pub(super) fn widest(unit: f64) -> f64 {
    let (width, least, most) = LARGEST_FORCE_WIDTH;
    (width * unit).clamp(least, most)
}

/// Returns the drawn width of a segment of the line of thrust, in pixels. A larger force has a wider line.
pub(super) fn width(pen: &Pen<'_>, segment: &ThrustSegment) -> f64 {
    let share = segment.force.norm() / largest(pen.context).max(f64::MIN_POSITIVE);
    let share = share.min(1.0);
    widest(pen.unit()) * (MIN_WIDTH_SHARE + (1.0 - MIN_WIDTH_SHARE) * share)
}

/// Draws all interfaces as lines of the same width.
pub(super) fn seams(pen: &Pen<'_>, frame_analysis: &FrameAnalysis) -> Group {
    let theme = &pen.context.options.theme;
    let mut outline = Outline::default();
    for contact in &frame_analysis.contacts {
        outline.extend(Outline::line(contact.interface.ends.map(|p| pen.camera.place(p))));
    }
    let stroke = Stroke::new(theme.outline.mixed(theme.ink, 0.4), 1.3 * pen.line);
    let seams = Group::with_class("interfaces").titled("Interfaces");
    if outline.segments.is_empty() {
        return Group::default();
    }
    seams.with(Path::stroked(outline, stroke))
}

/// Draws the line of thrust: first its schematic parts, then the true lines of action on top of them.
pub(super) fn lines(pen: &Pen<'_>, scene: &Scene, frame_analysis: &FrameAnalysis, segments: &[ThrustSegment]) -> Group {
    let mut group = Group::with_class("thrust");
    for through in [false, true] {
        let mut alike = segments.iter().filter(|s| s.through == through).peekable();
        if alike.peek().is_none() {
            continue;
        }
        if pen.many() {
            let (out, inside): (Vec<_>, Vec<_>) = alike.partition(|s| s.leaves);
            group.items.extend(joined_lines(pen, frame_analysis, inside));
            group.items.extend(joined_lines(pen, frame_analysis, out));
            continue;
        }
        for segment in alike {
            let class = if through { "force" } else { "schematic" };
            let line = Outline::line([segment.from, segment.to].map(|p| pen.camera.place(p)));
            let drawn = Group::with_class(class).titled(title(scene, frame_analysis, segment)).with(stroked(
                pen,
                frame_analysis,
                segment,
                line,
                width(pen, segment),
            ));
            group.items.push(drawn.into());
        }
    }
    group
}

/// Returns the path of an outline in the colour of a segment of the line of thrust, `width` pixels wide. The colour is
/// that of missing forces where the line leaves the stone, and grey elsewhere in a frame that does not stand. In a frame
/// that stands, a schematic line is pale.
fn stroked(
    pen: &Pen<'_>,
    frame_analysis: &FrameAnalysis,
    segment: &ThrustSegment,
    outline: Outline,
    width: f64,
) -> Path {
    let theme = &pen.context.options.theme;
    let colour = match frame_analysis.verdict {
        _ if segment.leaves => theme.failure,
        Verdict::Stable if segment.through => colour(theme),
        Verdict::Stable => schematic_colour(theme),
        _ => carried_colour(theme),
    };
    Path::stroked(outline, Stroke::new(colour, width))
}

/// Draws the segments of the line for frames with very many blocks: all segments of about the same width are one path.
fn joined_lines(pen: &Pen<'_>, frame_analysis: &FrameAnalysis, segments: Vec<&ThrustSegment>) -> Vec<Item> {
    let Some(first) = segments.first().copied() else {
        return Vec::new();
    };
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
            stroked(pen, frame_analysis, first, outline, width).into()
        })
        .collect()
}

/// Describes a segment of the line of thrust: its block, what exerts the force along the segment, and the magnitude of
/// this force.
fn title(scene: &Scene, frame_analysis: &FrameAnalysis, segment: &ThrustSegment) -> String {
    let on = &scene.blocks[segment.on.0].id;
    let by = match segment.origin {
        ForceOrigin::Contact(number) => {
            let [a, b] = frame_analysis.contacts[number].interface.bodies;
            let other = if a == BodyId::Block(segment.on) { b } else { a };
            description::named(scene, other)
        }
        ForceOrigin::Robot(robot) => format!("robot {}", scene.robots[robot.0].id),
        ForceOrigin::Load(_) => "a load".to_owned(),
        ForceOrigin::Resultant => "a joint, combined with loads".to_owned(),
    };
    let force = force(segment.force, scene.units);
    if segment.through {
        format!("Force on block {on} from {by}: {force}")
    } else {
        format!("Schematic path of the force from {by} through block {on}: {force}")
    }
}

/// Draws a dot at the point where the resultant of each interface acts. Calls `ink` with the position of each dot and
/// its radius in pixels.
pub(super) fn dots(pen: &Pen<'_>, frame_analysis: &FrameAnalysis, ink: &mut dyn FnMut(PagePoint, f64)) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let radius = (0.06 * pen.unit()).clamp(1.1, 3.6);
    let mut group = Group::with_class("resultants");
    let mut joined = ByColour::default();
    for (contact, bearing) in frame_analysis.contacts.iter().zip(bearings(scene, frame_analysis)) {
        if bearing.is_none() {
            continue;
        }
        let at = pen.camera.place(contact.resultant.at);
        ink(at, radius);
        if let Some(end) = left_at(contact) {
            let pair = description::pair(scene, contact.interface.bodies);
            let out = Outline::line([pen.camera.place(end), at]);
            let ring = Path::filled(Outline::circle(at, 1.5 * radius), theme.page);
            let mark = Group::with_class("leaves")
                .titled(format!("The line of thrust leaves the joint between {pair}"))
                .with(Path::stroked(out, Stroke::new(theme.failure, 0.6 * radius)))
                .with(ring.with_stroke(Stroke::new(theme.failure, 0.8 * radius)));
            group.items.push(mark.into());
            continue;
        }
        if pen.many() {
            joined.add(theme.ink, Outline::circle(at, radius));
            continue;
        }
        let pair = description::pair(scene, contact.interface.bodies);
        let amount = quantity(contact.resultant.force.norm(), scene.units.force());
        let dot = Group::with_class("resultant").titled(format!("Between {pair}: {amount}"));
        group.items.push(dot.with(dot_at(at, radius, theme)).into());
    }
    group.items.extend(joined.paths(None));
    group
}

fn dot_at(at: PagePoint, radius: f64, theme: &Theme) -> Path {
    Path::filled(Outline::circle(at, radius), theme.ink).cased(theme.page, 0.3 * radius)
}

/// Draws the symbol of a resultant outside its joint for the legend: a ring.
pub(super) fn left_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let ring = Path::filled(Outline::circle(at.moved(5.0, 0.0), 4.0), theme.page);
    vec![ring.with_stroke(Stroke::new(theme.failure, 2.0)).into()]
}

/// Draws the symbol of a resultant for the legend: a dot.
pub(super) fn dot_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    vec![dot_at(at.moved(4.0, 0.0), 3.2, theme).into()]
}
