//! Draws the utilisation of a structure: the used fraction of the available friction at each interface, and the used
//! fraction of the limits of each robot.
//!
//! The forces shown are one of many equilibrium states. In another state, some joints may use less friction, and other
//! joints more.

mod symbol;

use super::bearing::{Bearing, bearings};
use super::by_colour::ByColour;
use super::content::{About, PanelContent};
use super::context::FigureContext;
use super::description;
use super::joint_name::joint_name;
use super::label;
use super::legend::{self, Entry};
use super::limit;
use super::panel::composed;
use super::pen::Pen;
use super::verdict;
use super::words::{FULL_UTILISATION, counted, percent, quantity};
use crate::geometry::Bounds;
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, MarginKind, Verdict};
use crate::mechanics::scene::Scene;
use crate::mechanics::statics::interface::ContactKind;
use crate::pictures::drawing::{Colour, Group, Outline, PagePoint, Path, Stroke, Theme};
use crate::products::wording::margin::Parameter;
use symbol::{SYMBOL_WIDTH, full_symbol, idle_symbol, smooth_symbol};

/// The width of the line of an interface in unit lengths, with the least and the largest value of this width in pixels.
const LINE_WIDTH: (f64, f64, f64) = (0.11, 1.8, 6.0);
/// Length of the bar across an interface that uses all its friction, as a multiple of the width of its line.
const BAR_LENGTH: f64 = 3.2;

/// The figure of utilisation.
pub(crate) struct Utilisation;

impl PanelContent for Utilisation {
    fn about(&self) -> About {
        About {
            name: "utilisation",
            help: "The used share of the available friction at each interface",
            title: "Friction used in a dry-laid structure",
            ..About::default()
        }
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        if verdict::has_cheap_margins(analysis) { &[MarginKind::Friction] } else { &[] }
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame, camera) = (pen.context, pen.number, pen.camera);
        let frame_analysis = &context.analysis.frames[frame];
        let bold = bold(pen.unit());
        let mut ink = label::ink(pen);
        for contact in &frame_analysis.contacts {
            let [from, to] = contact.interface.ends.map(|p| camera.place(p));
            ink.line(from, to, bold + 2.0);
            if contact.friction_used >= FULL_UTILISATION {
                let [from, to] = across(pen, contact);
                ink.line(from, to, 3.0);
            }
        }
        let (idle, used) = interfaces(pen, frame_analysis);
        let robots = robots(pen, frame_analysis);
        let parts = vec![pen.arrows(false), idle, used, robots];
        composed(pen, view, pen.blocks(), parts, ink)
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        let scene = &context.analysis.scene;
        let frames = &context.analysis.frames;
        let all: Vec<Option<Bearing>> = frames.iter().flat_map(|f| bearings(scene, f)).collect();
        let robots = frames.iter().flat_map(|f| &f.robots).any(|r| limit::has_limits(scene, r.robot));
        let mut entries = Vec::new();
        let shared = all.iter().flatten().any(|b| b.friction.is_some());
        if shared || robots {
            let what = match (shared, robots) {
                (true, false) => "of the available friction",
                (false, _) => "of a robot's limits",
                (true, true) => "of the available friction; in discs, of a robot's limits",
            };
            let ends = ["0".to_owned(), "100 %".to_owned()];
            entries.push(Entry::Amplitudes(ends, what.into(), Theme::amplitude, legend::BAR_LENGTH));
        }
        let mut robots = frames.iter().flat_map(|f| &f.robots);
        let spent = robots.any(|r| r.limit_used >= FULL_UTILISATION);
        if spent || all.iter().flatten().any(uses_all_friction) {
            // In other equilibrium states, the same interface or robot may use less of its friction or limits.
            let all = "all of it in the forces shown".to_owned();
            entries.push(Entry::Symbol(full_symbol, SYMBOL_WIDTH, all));
        }
        if all.iter().flatten().any(|b| b.friction.is_none()) {
            let smooth = "no friction available".to_owned();
            entries.push(Entry::Symbol(smooth_symbol, SYMBOL_WIDTH, smooth));
        }
        if all.iter().any(Option::is_none) {
            entries.push(Entry::Symbol(idle_symbol, SYMBOL_WIDTH, "no force".into()));
        }
        entries.extend(legend::loads(context));
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let (scene, frame_analysis) = (&context.analysis.scene, &context.analysis.frames[frame]);

        if let Some(margin) = verdict::margin(scene, frame_analysis, Parameter::Friction) {
            return margin;
        }
        let used = most_used(scene, frame_analysis);
        match frame_analysis.verdict {
            Verdict::Stable => format!("in the forces shown, {used}"),
            Verdict::Unstable => format!("with the missing forces added, {used}"),
            Verdict::Undecided => format!("in the forces found, {used}; {}", verdict::reason(scene, frame_analysis)),
        }
    }
}

fn uses_all_friction(bearing: &Bearing) -> bool {
    bearing.friction.is_some_and(|share| share >= FULL_UTILISATION)
}

/// Describes the interface that uses the largest fraction of its friction, and the robot that uses the largest
/// fraction of its limits. If several interfaces use all their friction, states only their number.
fn most_used(scene: &Scene, frame_analysis: &FrameAnalysis) -> String {
    let mut stated = Vec::new();
    let bearings = bearings(scene, frame_analysis);
    let mut most: Option<(f64, &Contact)> = None;
    for (bearing, contact) in bearings.iter().zip(&frame_analysis.contacts) {
        let share = bearing.and_then(|b| b.friction);
        if let Some(share) = share.filter(|s| most.is_none_or(|m| *s > m.0)) {
            most = Some((share, contact));
        }
    }
    let sliding = bearings.iter().flatten().filter(|b| uses_all_friction(b)).count();
    match most {
        None => {}
        Some((share, _)) if share < 1e-6 => stated.push("no interface uses friction".to_owned()),
        Some(_) if sliding > 1 => {
            stated.push(format!("{sliding} interfaces use all of their friction"));
        }
        Some((share, contact)) => {
            let pair = joint_name(scene, frame_analysis, contact);
            let share = percent(share);
            stated.push(format!("the joint between {pair} uses the largest share of its friction, {share}"));
        }
    }
    stated.extend(most_used_robots(scene, frame_analysis));
    if stated.is_empty() {
        match frame_analysis.robots.is_empty() {
            true => "no loaded interface has friction".to_owned(),
            false => "no loaded interface has friction, and no robot has limits".to_owned(),
        }
    } else {
        stated.join("; ")
    }
}

/// Names the robot that uses the largest fraction of its limits, or states how many robots use it. `None` if no robot of
/// the frame has limits.
fn most_used_robots(scene: &Scene, frame_analysis: &FrameAnalysis) -> Option<String> {
    let robots = || frame_analysis.robots.iter().filter(|r| limit::has_limits(scene, r.robot));
    let most = robots().map(|r| r.limit_used).reduce(f64::max);
    // Robots that use the same percentage of their limits are reported together, so that rounding errors do not select
    // one of them.
    let equal = most.map(|most| robots().filter(move |r| percent(r.limit_used) == percent(most)));
    let most_used: Vec<_> = equal.into_iter().flatten().collect();
    match most_used.as_slice() {
        [] => None,
        [robot] => {
            let (id, share) = (&scene.robots[robot.robot.0].id, percent(robot.limit_used));
            Some(format!("robot\u{a0}{id} gives {share} of its limit"))
        }
        [robot, ..] => {
            Some(format!("{} give {} of their limits", counted(most_used.len(), "robot"), percent(robot.limit_used)))
        }
    }
}

/// Returns the width of the line of an interface, in pixels. `unit` is the unit length in pixels.
fn bold(unit: f64) -> f64 {
    let (width, least, most) = LINE_WIDTH;
    (width * unit).clamp(least, most)
}

/// Returns the colour of the line of an interface, which shows the used fraction of the available friction. The line
/// of an interface without available friction has the colour of the page.
fn colour(bearing: &Bearing, theme: &Theme) -> Colour {
    match bearing.friction {
        Some(share) => theme.amplitude(share),
        None => theme.page,
    }
}

/// Returns the colour of the borders of lines and discs.
fn edge(theme: &Theme) -> Colour {
    theme.ink
}

fn idle_stroke(theme: &Theme, bold: f64) -> Stroke {
    let width = (0.3 * bold).max(0.6);
    Stroke::new(theme.faint, width).dashed([3.0 * width, 2.4 * width])
}

/// Draws the interfaces as lines in two groups: interfaces without force, and interfaces with force.
fn interfaces(pen: &Pen<'_>, frame_analysis: &FrameAnalysis) -> (Group, Group) {
    let scene = &pen.context.analysis.scene;
    let (mut idle, mut used) = (Group::with_class("idle"), Group::with_class("interfaces"));
    let bearings = frame_analysis.contacts.iter().zip(bearings(scene, frame_analysis));
    if pen.many() {
        joined_interfaces(pen, bearings, &mut idle, &mut used);
        return (idle, used);
    }
    // Draw the dots of corner contacts last, because the line of an interface could cover them.
    let (corners, edges): (Vec<_>, Vec<_>) =
        bearings.partition(|(contact, _)| contact.interface.kind == ContactKind::Corner);
    for (contact, bearing) in edges.into_iter().chain(corners) {
        match bearing {
            Some(bearing) => used.items.push(used_interface(pen, contact, &bearing).into()),
            None => idle.items.push(idle_interface(pen, contact).into()),
        }
    }
    (idle, used)
}

/// Draws the interfaces of a frame with very many blocks: all lines of one colour are one path without a tooltip. Adds
/// interfaces without force to `idle`, and the others to `used`.
fn joined_interfaces<'c>(
    pen: &Pen<'_>,
    bearings: impl Iterator<Item = (&'c Contact, Option<Bearing>)>,
    idle: &mut Group,
    used: &mut Group,
) {
    let theme = &pen.context.options.theme;
    let bold = bold(pen.unit());
    let mut lines = ByColour::default();
    let (mut edges, mut bars, mut dashes) = (Outline::default(), Outline::default(), Outline::default());
    for (contact, bearing) in bearings {
        let line = line_of(pen, contact);
        let Some(bearing) = bearing else {
            dashes.extend(line);
            continue;
        };
        edges.extend(line.clone());
        lines.add(colour(&bearing, theme), line);
        if uses_all_friction(&bearing) {
            bars.extend(Outline::line(across(pen, contact)));
        }
    }
    if !dashes.segments.is_empty() {
        let path = Path::stroked(dashes, idle_stroke(theme, bold));
        idle.items.push(path.into());
    }
    if !edges.segments.is_empty() {
        used.items.push(rimmed(edges, bold, rim(bold), theme).into());
    }
    used.items.extend(lines.lines(bold));
    if !bars.segments.is_empty() {
        let path = Path::stroked(bars, Stroke::new(theme.ink, bar_width(bold)));
        used.items.push(path.into());
    }
}

fn line_of(pen: &Pen<'_>, contact: &Contact) -> Outline {
    Outline::line(contact.interface.ends.map(|p| pen.camera.place(p)))
}

/// Draws an interface without force as a thin dashed line.
fn idle_interface(pen: &Pen<'_>, contact: &Contact) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let pair = description::pair(scene, contact.interface.bodies);
    let path = Path::stroked(line_of(pen, contact), idle_stroke(theme, bold(pen.unit())));
    Group::with_class("interface").titled(format!("Between {pair}: no force")).with(path)
}

/// Draws an interface with force as a line whose colour shows the used fraction of the available friction. A bar
/// across the line shows that all friction is used.
fn used_interface(pen: &Pen<'_>, contact: &Contact, bearing: &Bearing) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let bold = bold(pen.unit());
    let pair = description::pair(scene, contact.interface.bodies);
    let pressed = quantity(bearing.pressed, scene.units.force());
    let title = match bearing.friction {
        Some(share) => format!(
            "Between {pair}: {} of the available friction, {} under {pressed}",
            percent(share),
            quantity(contact.friction_force.abs(), scene.units.force()),
        ),
        None => format!("Between {pair}: {pressed}, no friction available"),
    };
    let line = line_of(pen, contact);
    let coloured = Stroke::new(colour(bearing, theme), bold);
    let drawn = Group::with_class("interface")
        .titled(title)
        .with(rimmed(line.clone(), bold, rim(bold), theme))
        .with(Path::stroked(line, coloured));
    if !uses_all_friction(bearing) {
        return drawn;
    }
    let bar = Outline::line(across(pen, contact));
    drawn.with(Path::stroked(bar, Stroke::new(theme.ink, bar_width(bold))))
}

/// Returns the width of the border on each side of a line, in pixels. `bold` is the width of the line in pixels.
fn rim(bold: f64) -> f64 {
    (0.16 * bold).clamp(0.4, 0.9)
}

fn bar_width(bold: f64) -> f64 {
    (0.3 * bold).clamp(0.8, 1.6)
}

/// Returns a wider line below a line of width `bold`. It appears as a border of `rim` pixels on both sides, which makes
/// the line visible on blocks of any colour.
fn rimmed(line: Outline, bold: f64, rim: f64, theme: &Theme) -> Path {
    Path::stroked(line, Stroke::new(edge(theme), bold + 2.0 * rim))
}

/// Returns the two ends of the bar across an interface that uses all its friction.
fn across(pen: &Pen<'_>, contact: &Contact) -> [PagePoint; 2] {
    let middle = pen.camera.place(contact.interface.middle());
    let half = 0.5 * BAR_LENGTH * bold(pen.unit());
    // The page has the same scale in both directions, so a unit normal in the scene is also a unit normal on the page.
    let (x, y) = (contact.interface.normal.x * half, -contact.interface.normal.y * half);
    [middle.moved(-x, -y), middle.moved(x, y)]
}

/// Draws a disc at the grip of each robot that has limits. The colour of the disc shows the used fraction of these
/// limits.
fn robots(pen: &Pen<'_>, frame_analysis: &FrameAnalysis) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let mut group = Group::with_class("limits");
    for robot in frame_analysis.robots.iter().filter(|r| limit::has_limits(scene, r.robot)) {
        let at = pen.camera.place(robot.at);
        let radius = 0.64 * pen.disc();
        let title = format!("Robot {}: {} of its limit", scene.robots[robot.robot.0].id, percent(robot.limit_used));
        let rim = Stroke::new(edge(theme), (0.06 * pen.disc()).clamp(0.4, 1.0));
        let disc = Path::filled(Outline::circle(at, radius), theme.amplitude(robot.limit_used));
        let mut drawn = Group::with_class("limit").titled(title).with(disc.with_stroke(rim));
        if robot.limit_used >= FULL_UTILISATION {
            let bar = Outline::line([at.moved(0.0, -1.25 * radius), at.moved(0.0, 1.25 * radius)]);
            drawn = drawn.with(Path::stroked(bar, Stroke::new(theme.ink, 1.4)));
        }
        group.items.push(drawn.into());
    }
    group
}
