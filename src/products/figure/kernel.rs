//! Draws the safe part of each interface, in which the resultant of the interface must act, and a mark at the position
//! of the resultant.

use super::bearing::{Bearing, bearings};
use super::by_colour::ByColour;
use super::content::{About, PanelContent};
use super::context::FigureContext;
use super::description;
use super::joint_name::joint_name;
use super::label;
use super::legend::{self, Entry};
use super::panel::composed;
use super::pen::Pen;
use super::verdict;
use super::words::{FULL_UTILISATION, percent, quantity};
use crate::geometry::{Bounds, Point};
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, MarginKind, Verdict};
use crate::pictures::drawing::{Colour, Group, Item, Outline, PagePoint, Path, Stroke, Theme};
use crate::products::wording::margin::Parameter;

/// A resultant lies outside the safe part if its distance from the middle, divided by half the length of this part,
/// exceeds this value.
const KERNEL_TOL: f64 = 1.0 + 1e-6;
/// The width of the line of a safe part in unit lengths, with its least and largest allowed width in pixels.
const SAFE_LINE_WIDTH: (f64, f64, f64) = (0.085, 1.6, 4.6);

/// The figure of kernels.
pub(crate) struct Kernel;

impl PanelContent for Kernel {
    fn about(&self) -> About {
        About {
            name: "kernel",
            help: "The safe part of each interface, and the position of the resultant in it",
            title: "Resultants in the safe parts of interfaces",
            ..About::default()
        }
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        if verdict::has_cheap_margins(analysis) { &[MarginKind::Kernel] } else { &[] }
    }

    fn picture(&self, pen: &Pen<'_>, view: Bounds) -> Group {
        let (context, frame, camera) = (pen.context, pen.number, pen.camera);
        let frame_analysis = &context.analysis.frames[frame];
        let bold = bold(pen.unit());
        let mut ink = label::ink(pen);
        for contact in &frame_analysis.contacts {
            let [from, to] = contact.interface.ends.map(|p| camera.place(p));
            ink.line(from, to, bold + 1.0);
        }
        let stretches = stretches(pen, frame_analysis);
        let dots = dots(pen, frame_analysis, &mut |at| ink.disc(at, dot(pen.unit()) + 1.0));
        composed(pen, view, pen.blocks(), vec![pen.arrows(false), stretches, dots], ink)
    }

    fn entries(&self, context: &FigureContext<'_>, _unit: f64) -> Vec<Entry> {
        let scene = &context.analysis.scene;
        let frames = &context.analysis.frames;
        let mut entries = Vec::new();
        if frames.iter().any(|f| !f.contacts.is_empty()) {
            let safe = "safe part of an interface".to_owned();
            entries.push(Entry::Symbol(safe_symbol, SYMBOL_WIDTH, safe));
            if scene.kernel > 0.0 {
                let rest = format!("unsafe part, for a kernel of {}", scene.kernel);
                entries.push(Entry::Symbol(rest_symbol, SYMBOL_WIDTH, rest));
            }
        }
        let standing = frames.iter().filter(|f| f.verdict == Verdict::Stable);
        let bearings: Vec<Bearing> = standing.flat_map(|f| bearings(scene, f)).flatten().collect();
        let (ends, within): (Vec<&Bearing>, Vec<&Bearing>) = bearings.iter().partition(|b| at_end(b));
        if !within.is_empty() {
            entries.push(Entry::Symbol(within_symbol, 9.0, "resultant".into()));
        }
        if !ends.is_empty() {
            let what = "resultant at an end of the safe part".to_owned();
            entries.push(Entry::Symbol(end_symbol, 11.0, what));
        }
        entries.extend(legend::loads(context));
        entries.extend(legend::robots(context));
        entries
    }

    fn reason(&self, context: &FigureContext<'_>, frame: usize) -> String {
        let (scene, frame_analysis) = (&context.analysis.scene, &context.analysis.frames[frame]);

        match frame_analysis.verdict {
            Verdict::Stable => {}
            Verdict::Unstable => {
                return "no resultants, because no forces balance the structure".into();
            }
            Verdict::Undecided => {
                return format!("no resultants; {}", verdict::reason(scene, frame_analysis));
            }
        }
        if frame_analysis.contacts.is_empty() {
            return "no interfaces".into();
        }
        if let Some(margin) = verdict::margin(scene, frame_analysis, Parameter::Kernel) {
            return margin;
        }
        let bearings = bearings(scene, frame_analysis);
        let share = |b: &Option<Bearing>| b.and_then(|b| b.eccentricity);
        let mut nearest: Option<(f64, &Contact)> = None;
        for (bearing, contact) in bearings.iter().zip(&frame_analysis.contacts) {
            if let Some(share) = share(bearing).filter(|s| nearest.is_none_or(|n| *s > n.0)) {
                nearest = Some((share, contact));
            }
        }
        let Some((most, contact)) = nearest else {
            return match bearings.iter().all(Option::is_none) {
                true => "no interface carries a force".into(),
                false => "every safe part is a point".into(),
            };
        };
        let at_end = bearings.iter().filter_map(share).filter(|s| *s >= FULL_UTILISATION).count();
        if at_end > 1 {
            return format!("in the forces shown, {at_end} resultants act at an end of the safe part");
        }
        let pair = joint_name(scene, frame_analysis, contact);
        if at_end == 1 {
            return format!("in the forces shown, the resultant between {pair} acts at an end of the safe part");
        }
        if most < 0.005 {
            return "in the forces shown, every resultant acts in the middle".into();
        }
        let most = percent(most);
        format!("farthest from the middle: the resultant between {pair}, {most} of the way to the end of its safe part")
    }
}

/// True if a resultant acts at an end of the safe part of its interface, or outside this part.
fn at_end(bearing: &Bearing) -> bool {
    bearing.eccentricity.is_some_and(|share| share >= FULL_UTILISATION)
}

/// Returns the width of the line of a safe part, in pixels. `unit` is the unit length in pixels.
fn bold(unit: f64) -> f64 {
    let (width, least, most) = SAFE_LINE_WIDTH;
    (width * unit).clamp(least, most)
}

/// Returns the radius of the dot of a resultant, in pixels. `unit` is the unit length in pixels.
fn dot(unit: f64) -> f64 {
    0.5 * bold(unit) + (0.045 * unit).clamp(0.8, 2.4)
}

fn rest_stroke(theme: &Theme, bold: f64) -> Stroke {
    Stroke::new(theme.faint, 0.45 * bold).dashed([1.1 * bold, 0.9 * bold]).mitred()
}

/// Draws the safe part of each interface as a solid line, and the unsafe parts as dashed lines.
fn stretches(pen: &Pen<'_>, frame_analysis: &FrameAnalysis) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let bold = bold(pen.unit());
    let mut group = Group::with_class("interfaces");
    let (mut all_safe, mut all_rests) = (Outline::default(), Outline::default());
    let casing =
        |outline: Outline| Path::stroked(outline, Stroke::new(theme.page, 0.45 * bold + 2.0)).with_opacity(0.8);
    for contact in &frame_analysis.contacts {
        let place = |points: [Point; 2]| points.map(|p| pen.camera.place(p));
        let ends = place(contact.interface.ends);
        let points = place(contact.application_points);
        let mut rests = Outline::default();
        if scene.kernel > 0.0 {
            for (end, point) in ends.into_iter().zip(points) {
                rests.extend(Outline::line([end, point]));
            }
        }
        if pen.many() {
            all_safe.extend(Outline::line(points));
            all_rests.extend(rests);
            continue;
        }
        let length = contact.interface.length();
        let pair = description::pair(scene, contact.interface.bodies);
        let title = format!(
            "Between {pair}: {} of {} safe",
            quantity((1.0 - scene.kernel) * length, scene.units.length()),
            quantity(length, scene.units.length())
        );
        let mut drawn = Group::with_class("interface").titled(title);
        if !rests.segments.is_empty() {
            drawn = drawn.with(casing(rests.clone())).with(Path::stroked(rests, rest_stroke(theme, bold)));
        }
        // A safe part of length 0 is a point, which is drawn as a dot.
        let path = if scene.kernel < 1.0 && length > 0.0 {
            let stroke = Stroke::new(theme.safe, bold).mitred();
            Path::stroked(Outline::line(points), stroke)
        } else {
            Path::filled(Outline::circle(points[0], 0.9 * bold), theme.safe)
        };
        group.items.push(drawn.with(path).into());
    }
    if !all_rests.segments.is_empty() {
        let path = Path::stroked(all_rests, rest_stroke(theme, bold));
        group.items.push(path.into());
    }
    if !all_safe.segments.is_empty() {
        let path = Path::stroked(all_safe, Stroke::new(theme.safe, bold));
        group.items.push(path.into());
    }
    group
}

/// Draws a mark at the point of action of each resultant, if the frame stands. Calls `ink` with the position of each
/// mark on the page.
fn dots(pen: &Pen<'_>, frame_analysis: &FrameAnalysis, ink: &mut dyn FnMut(PagePoint)) -> Group {
    let (scene, theme) = (&pen.context.analysis.scene, &pen.context.options.theme);
    let mut group = Group::with_class("resultants");
    if frame_analysis.verdict != Verdict::Stable {
        return group;
    }
    let radius = dot(pen.unit());
    let mut joined = ByColour::default();
    for (contact, bearing) in frame_analysis.contacts.iter().zip(bearings(scene, frame_analysis)) {
        let Some(bearing) = bearing else { continue };
        let at = pen.camera.place(contact.resultant.at);
        ink(at);
        let (fill, outline) = resultant_symbol(&bearing, at, radius, theme);
        if pen.many() {
            joined.add(fill, outline);
            continue;
        }
        let pair = description::pair(scene, contact.interface.bodies);
        let amount = quantity(contact.resultant.force.norm(), scene.units.force());
        let place = bearing.eccentricity.map_or(String::new(), |share| {
            let share = percent(share);
            format!(", {share} of the way from the middle to the end of the safe part")
        });
        let title = format!("Resultant between {pair}: {amount}{place}");
        let path = Path::filled(outline, fill).cased(theme.page, 0.28 * radius);
        group.items.push(Group::with_class("resultant").titled(title).with(path).into());
    }
    group.items.extend(joined.paths(None));
    group
}

/// Returns the colour and the outline of the mark of a resultant: a disc for a resultant inside the safe part, a
/// diamond at an end of this part, and a red diamond outside it.
fn resultant_symbol(bearing: &Bearing, at: PagePoint, radius: f64, theme: &Theme) -> (Colour, Outline) {
    if at_end(bearing) {
        let r = 1.35 * radius;
        let corners = [(0.0, -r), (r, 0.0), (0.0, r), (-r, 0.0)];
        let diamond = Outline::ring(corners.map(|(x, y)| at.moved(x, y)));
        let outside = bearing.eccentricity.is_some_and(|share| share > KERNEL_TOL);
        return (if outside { theme.falls } else { theme.ink }, diamond);
    }
    (theme.ink, Outline::circle(at, radius))
}

/// Width of the symbol of an interface in the legend, pixels.
const SYMBOL_WIDTH: f64 = 26.0;

fn safe_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(SYMBOL_WIDTH, 0.0)]);
    vec![Path::stroked(line, Stroke::new(theme.safe, 4.0)).into()]
}

fn rest_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(SYMBOL_WIDTH, 0.0)]);
    vec![Path::stroked(line, rest_stroke(theme, 4.0)).into()]
}

fn within_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let outline = Outline::circle(at.moved(4.5, 0.0), 3.6);
    vec![Path::filled(outline, theme.ink).into()]
}

fn end_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let end = Bearing { pressed: 1.0, eccentricity: Some(1.0), friction: None };
    let (fill, outline) = resultant_symbol(&end, at.moved(5.5, 0.0), 3.8, theme);
    vec![Path::filled(outline, fill).into()]
}
