//! Draws the joints: at each of them its segment, the part in which its resultant must lie, the position of the
//! resultant, and in colour the used share of the available friction.
//!
//! The forces are one of many sets that balance the structure. In another set, some joints use less friction, and others
//! more; the line of the verdict therefore states margins, which hold for all. With the option `central`, the forces are
//! those of the largest kernel, and each joint shows the part in which they lie. Where no forces balance a structure,
//! nothing is safe: what fails is red, and no joint has a colour of its friction.

use std::borrow::Cow;
use std::rc::Rc;

use super::bearing::{Bearing, bearings, has_limits};
use super::canvas::Canvas;
use super::design::{Key, Layer, Mark};
use super::option::Options;
use super::panel::{About, Figure};
use super::{stage, verdict};
use crate::geometry::Point;
use crate::mechanics::analysis::{Analysis, Contact, FrameAnalysis, MarginKind, SolvedFrame, ThrustState, Verdict};
use crate::mechanics::statics::interface::ContactKind;
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path, Stroke};
use crate::products::wording::failure::pair;
use crate::products::wording::margin::{confirmed, governing, stated};
use crate::products::wording::number::{FULL_UTILISATION, digits, percent, quantity, three_down, three_up};
use crate::products::wording::question::factored_friction;
use crate::products::wording::verdict::reason;

/// The width of the line of a joint in unit lengths, with its least and largest width in mm.
const LINE_WIDTH: (f64, f64, f64) = (0.12, 0.4, 1.3);
/// Length of the bar across a joint that uses all its friction, as a multiple of the width of its line.
const BAR_LENGTH: f64 = 3.2;
/// Length of a line in the legend, and of the bar of colours, mm.
const KEY_LENGTH: f64 = 4.8;
const COLOURS_LENGTH: f64 = 16.0;
/// The radius and the width of the ring that shows the limits of a robot, mm.
const RING: (f64, f64) = (1.9, 0.6);

/// The figure of joints.
pub(crate) struct Joints;

impl Figure for Joints {
    fn about(&self) -> About {
        About::new(
            "joints",
            "Where the resultant of each joint lies, and its used friction; --margin kernel keeps the resultants farthest from the ends",
            "The joints of a dry-laid structure",
        )
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        if verdict::has_cheap_margins(analysis) {
            &[MarginKind::Friction, MarginKind::FrictionFactor, MarginKind::Kernel]
        } else {
            &[]
        }
    }

    fn words(&self, analysis: &Analysis, frame: usize, options: &Options) -> Vec<String> {
        let solved @ SolvedFrame { found, .. } = analysis.at(frame);
        match found.verdict {
            Verdict::Unstable if options.verdict_margin => governing(solved).words,
            Verdict::Unstable => Vec::new(),
            Verdict::Undecided => vec![format!("no resultants; {}", reason(solved))],
            Verdict::Stable if !options.verdict_margin => Vec::new(),
            Verdict::Stable if options.central => kernel_words(solved).into_iter().collect(),
            Verdict::Stable => friction_words(solved).into_iter().chain(kernel_words(solved)).collect(),
        }
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        let analysis = canvas.analysis;
        let central = canvas.options.central && canvas.found().verdict == Verdict::Stable;
        let state = canvas.own().central.get_or_init(|| central.then(|| analysis.central(canvas.number)).flatten());
        let drawing = Drawing::new(canvas, state.as_ref());
        if drawing.stands {
            drawing.joints(canvas);
        } else {
            drawing.unbalanced(canvas);
        }
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        if canvas.found().verdict == Verdict::Stable {
            robots(canvas);
        }
    }
}

/// States the friction that the structure needs: `needs friction 0.337, has 0.6`.
fn friction_words(solved: SolvedFrame<'_>) -> Option<String> {
    let SolvedFrame { scene, .. } = solved;
    let margins = stated(solved);
    let of = |kind: MarginKind| margins.iter().find(|margin| margin.kind == kind);
    let needed = |kind| of(kind).and_then(|margin| confirmed(margin.interval.low()?));
    let present = of(MarginKind::Friction).and_then(|margin| margin.present);
    match (needed(MarginKind::Friction), present) {
        (Some(0.0), _) => Some("needs no friction".to_owned()),
        (Some(needed), Some((least, most))) if least == most && scene.factored_sets().next().is_none() => {
            Some(format!("needs friction {}, has {}", three_up(needed), digits(most)))
        }
        _ => needed(MarginKind::FrictionFactor)
            .map(|factor| format!("needs {} × {}", three_up(factor), factored_friction(scene))),
    }
}

/// States which part of each joint may be lost: `0.384 of each joint may be lost`.
fn kernel_words(solved: SolvedFrame<'_>) -> Option<String> {
    let SolvedFrame { scene, found, .. } = solved;
    let margins = stated(solved);
    let kernel = margins.iter().find(|margin| margin.kind == MarginKind::Kernel);
    let kernel = kernel.and_then(|margin| margin.interval.high()).map(|end| confirmed(end).unwrap_or(1.0));
    let has_length = found.contacts.iter().any(|contact| contact.interface.length() > 0.0);
    match kernel.filter(|_| has_length) {
        Some(kernel) if kernel >= 1.0 => Some("every force can act in the middle of its joint".to_owned()),
        Some(kernel) => Some(format!("{} of each joint may be lost", three_down(kernel))),
        None if scene.kernel >= 1.0 => Some("every safe part is a point".to_owned()),
        None => None,
    }
}

/// The forces that are drawn, the widths of the lines, and the entries of the legend.
struct Drawing<'a> {
    found: Cow<'a, FrameAnalysis>,
    stands: bool,
    /// The part of each joint in which no force of the picture may act.
    kernel: f64,
    /// The width of the line of a joint, pixels.
    bold: f64,
    colours: Rc<Key>,
    full: Rc<Key>,
    smooth: Rc<Key>,
    idle: Rc<Key>,
    resultant: Rc<Key>,
    rest: Rc<Key>,
}

impl<'a> Drawing<'a> {
    fn new(canvas: &Canvas<'a>, central: Option<&'a ThrustState>) -> Drawing<'a> {
        let (theme, scene) = (canvas.theme(), canvas.scene());
        let bold = canvas.in_units(LINE_WIDTH);
        let (start, long) = (PagePoint::new(0.0, 0.0), canvas.mm(KEY_LENGTH));
        let of_key = canvas.mm(0.9);
        let line = || Key::piece(long);
        let bar = Outline::line([-1.2, 1.2].map(|y| start.moved(long / 2.0, canvas.mm(y))));
        let full = rimmed_line(canvas, line(), of_key, Some(1.0)).into_iter();
        let full = full.chain([Path::stroked(bar, canvas.pen(theme.ink, 0.26))]).collect();
        let largest = canvas.found().margins_alone().and_then(|margins| margins.most(MarginKind::Kernel));
        let kernel = central.and(largest).unwrap_or(scene.kernel);
        let (resultant, rest) = if central.is_some() {
            ("resultant, as far from the ends as possible", "part that may be lost".to_owned())
        } else {
            ("resultant in one possible balance", format!("not safe, for a kernel of {}", scene.kernel))
        };
        let radius = of_key / 2.0;
        Drawing {
            found: Cow::Borrowed(central.map_or(canvas.found(), |state| &state.frame)),
            stands: canvas.found().verdict == Verdict::Stable,
            kernel,
            bold,
            colours: colours_key(canvas),
            full: Key::new(11, "all of it", full, long),
            smooth: Key::new(12, "no friction available", rimmed_line(canvas, line(), of_key, None).to_vec(), long),
            idle: Key::line(13, "no force", long, idle_stroke(canvas, of_key)),
            resultant: Key::new(9, resultant, dot(canvas, start.moved(radius, 0.0), of_key), 2.0 * radius),
            rest: Key::line(14, rest, long, rest_stroke(canvas, of_key)),
        }
    }

    /// Draws each joint as a line whose colour shows the used share of the available friction, with a dot where the
    /// resultant acts. The line is as long as the part in which the resultant may act.
    fn joints(&self, canvas: &mut Canvas<'_>) {
        let bearings = bearings(canvas.solved().with_results(&self.found));
        let all = self.found.contacts.iter().zip(bearings);
        // The dots of corner contacts come last, because the line of a joint could cover them.
        let (corners, edges): (Vec<_>, Vec<_>) =
            all.partition(|(contact, _)| contact.interface.kind == ContactKind::Corner);
        let all: Vec<_> = edges.into_iter().chain(corners).collect();
        for (contact, bearing) in &all {
            self.line(canvas, contact, bearing.as_ref());
        }
        for (contact, bearing) in &all {
            if let Some(bearing) = bearing {
                self.resultant(canvas, contact, bearing);
            }
        }
    }

    fn line(&self, canvas: &mut Canvas<'_>, contact: &Contact, bearing: Option<&Bearing>) {
        let (scene, theme) = (canvas.scene(), canvas.theme());
        let place = |points: [_; 2]| points.map(|p| canvas.place(p));
        let (ends, points) = (place(contact.interface.ends), place(contact.application_points));
        let pair = pair(scene, contact.interface.bodies);
        let length = contact.interface.length();
        let units = scene.units;
        let safe = if self.kernel > 0.0 {
            let metres = |metres: f64| quantity(metres, units.length());
            format!("; {} of {} safe", metres((1.0 - self.kernel) * length), metres(length))
        } else {
            String::new()
        };
        let mut shapes = Vec::new();
        if self.kernel > 0.0 && length > 0.0 {
            let rests = Outline::lines([0, 1].map(|k| [ends[k], points[k]]));
            shapes.push(Path::stroked(rests, rest_stroke(canvas, self.bold)));
            canvas.explain(Rc::clone(&self.rest));
        }
        let is_point = length <= 0.0 || self.kernel >= 1.0;
        let line = if is_point { Outline::circle(points[0], 0.25 * self.bold) } else { Outline::line(points) };
        let Some(bearing) = bearing else {
            shapes.push(Path::stroked(line, idle_stroke(canvas, self.bold)));
            let mark = Mark::new(Layer::Stone, "interface", shapes);
            canvas.put(mark.titled(format!("Between {pair}: no force{safe}")).keyed(&self.idle));
            return;
        };
        let pressed = canvas.newtons(bearing.pressed);
        let pressure = contact.pressure(scene.thickness).map_or(String::new(), |[first, second]| {
            let stress = |pressure: f64| quantity(pressure, units.stress());
            format!(", pressure {} to {}", stress(first.min(second)), stress(first.max(second)))
        });
        let title = match bearing.friction {
            Some(share) => format!(
                "Between {pair}: {} of the available friction, {} under {pressed}{pressure}{safe}",
                percent(share),
                canvas.newtons(contact.friction_force.abs()),
            ),
            None => format!("Between {pair}: {pressed}{pressure}, no friction available{safe}"),
        };
        shapes.extend(rimmed_line(canvas, line, self.bold, bearing.friction));
        if bearing.friction.is_some_and(|share| share >= FULL_UTILISATION) {
            let width = (0.3 * self.bold).clamp(canvas.mm(0.15), canvas.mm(0.3));
            shapes.push(Path::stroked(Outline::line(self.across(canvas, contact)), Stroke::new(theme.ink, width)));
            canvas.explain(Rc::clone(&self.full));
        }
        let key = if bearing.friction.is_some() { &self.colours } else { &self.smooth };
        canvas.put(Mark::new(Layer::Force, "interface", shapes).titled(title).keyed(key).avoided(0.2));
    }

    /// Returns the two ends of the bar across a joint that uses all its friction.
    fn across(&self, canvas: &Canvas<'_>, contact: &Contact) -> [PagePoint; 2] {
        let (middle, half) = (canvas.place(contact.interface.middle()), 0.5 * BAR_LENGTH * self.bold);
        // The page has the same scale in both directions, so a unit normal in the scene is also one on the page.
        let (x, y) = (contact.interface.normal.x * half, -contact.interface.normal.y * half);
        [middle.moved(-x, -y), middle.moved(x, y)]
    }

    fn resultant(&self, canvas: &mut Canvas<'_>, contact: &Contact, bearing: &Bearing) {
        let place = bearing.eccentricity.map_or(String::new(), |share| {
            format!(", {} of the way from the middle to the end of the safe part", percent(share))
        });
        let (pair, amount) = (pair(canvas.scene(), contact.interface.bodies), canvas.newtons(contact.amount()));
        let mark = Mark::new(Layer::Symbol, "resultant", dot(canvas, canvas.place(contact.resultant.at), self.bold));
        let mark = mark.titled(format!("Resultant between {pair}: {amount}{place}")).avoided(0.2);
        canvas.put(mark.keyed(&self.resultant));
    }

    /// Draws the joints of a structure that no forces balance: those that lack a force in red, the others as thin lines.
    fn unbalanced(&self, canvas: &mut Canvas<'_>) {
        let (scene, theme, found) = (canvas.scene(), canvas.theme(), canvas.found());
        let (bold, ink) = (self.bold, canvas.options.failure());
        let failing = |contact: &Contact| {
            let [a, b] = contact.interface.bodies;
            let [from, to] = contact.interface.ends;
            let is_on = |at: Point| (at - from).norm() + (to - at).norm() - (to - from).norm() < 1e-6 * found.length;
            found.failures.iter().any(|failure| failure.bodies() == (a, Some(b)) && is_on(failure.at()))
        };
        let long = canvas.mm(KEY_LENGTH);
        let red = Stroke::new(ink, bold).mitred();
        let key = Key::line(20, "lacks a force", long, Stroke::new(ink, canvas.mm(0.9)).mitred());
        let mut all: Vec<(&Contact, bool)> = found.contacts.iter().map(|contact| (contact, failing(contact))).collect();
        all.sort_by_key(|(_, fails)| *fails);
        for (contact, fails) in all {
            let ends = contact.interface.ends.map(|p| canvas.place(p));
            let pair = pair(scene, contact.interface.bodies);
            let line = Outline::line(ends);
            let mark = if fails {
                let casing = Stroke::new(theme.page, bold + canvas.mm(0.3));
                let shapes = match contact.interface.length() {
                    length if length > 0.0 => {
                        vec![Path::stroked(line.clone(), casing), Path::stroked(line, red.clone())]
                    }
                    _ => vec![Path::filled(Outline::circle(ends[0], bold), ink)],
                };
                let mark = Mark::new(Layer::Missing, "fails", shapes).keyed(&key);
                mark.titled(format!("Between {pair}: a force is missing")).avoided(0.2)
            } else {
                let path = Path::stroked(line, canvas.pen(theme.faint, 0.3));
                Mark::new(Layer::Force, "interface", vec![path]).titled(format!("Between {pair}"))
            };
            canvas.put(mark);
        }
        for failure in found.failures.iter().filter(|failure| failure.robot().is_some()) {
            let path = Path::stroked(Outline::circle(canvas.place(failure.at()), canvas.mm(RING.0)), red.clone());
            let mark = Mark::new(Layer::Missing, "fails", vec![path]).keyed(&key);
            canvas.put(mark.titled("The robot lacks a force or a torque").avoided(0.2));
        }
    }
}

/// Returns the entry of the legend with the colours of shares.
fn colours_key(canvas: &Canvas<'_>) -> Rc<Key> {
    let theme = canvas.theme();
    let long = canvas.mm(COLOURS_LENGTH);
    let mut symbol = stage::colour_bar(canvas, COLOURS_LENGTH, |share| theme.amplitude(share));
    let ticks =
        Outline::lines([0.0, 0.5, 1.0].map(|share| [-0.9, 1.3].map(|y| PagePoint::new(share * long, canvas.mm(y)))));
    symbol.push(Path::stroked(ticks, canvas.pen(theme.faint, 0.16)));
    let ticks = vec![(0.0, "0"), (0.5 * long, "50"), (long, "100\u{a0}%")];
    Rc::new(Key { rank: 10, words: "of the friction is used".to_owned(), symbol, width: long, ticks })
}

/// Returns the mark of a resultant on a line of this width.
fn dot(canvas: &Canvas<'_>, at: PagePoint, bold: f64) -> Vec<Path> {
    let (theme, rim) = (canvas.theme(), (0.28 * bold).clamp(canvas.mm(0.11), canvas.mm(0.26)));
    let radius = (0.62 * bold).max(canvas.mm(0.32));
    vec![Path::filled(Outline::circle(at, radius), theme.page).with_stroke(Stroke::new(theme.ink, rim))]
}

fn rest_stroke(canvas: &Canvas<'_>, bold: f64) -> Stroke {
    let width = (0.4 * bold).max(canvas.mm(0.15));
    Stroke::new(canvas.theme().faint, width).dashed([2.2 * width, 1.6 * width]).mitred()
}

fn idle_stroke(canvas: &Canvas<'_>, bold: f64) -> Stroke {
    let width = (0.3 * bold).max(canvas.mm(0.11));
    Stroke::new(canvas.theme().faint, width).dashed([3.0 * width, 2.4 * width])
}

/// Returns a line with a border, which makes it visible on blocks of any colour. `share` is the used share of the
/// available friction; without friction, the line has the colour of the page.
fn rimmed_line(canvas: &Canvas<'_>, line: Outline, bold: f64, share: Option<f64>) -> [Path; 2] {
    let theme = canvas.theme();
    let rim = (0.16 * bold).clamp(canvas.mm(0.07), canvas.mm(0.17));
    let colour = share.map_or(theme.page, |share| theme.amplitude(share));
    let stroke = |ink: Colour, width: f64| Path::stroked(line.clone(), Stroke::new(ink, width).mitred());
    [stroke(theme.ink, bold + 2.0 * rim), stroke(colour, bold)]
}

/// Draws a ring around each robot that has limits. Its colour shows the used share of them.
fn robots(canvas: &mut Canvas<'_>) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let ring = |canvas: &Canvas<'_>, at: PagePoint, radius: f64, used: f64| {
        let circle =
            |ink: Colour, width: f64| Path::stroked(Outline::circle(at, canvas.mm(radius)), canvas.pen(ink, width));
        vec![circle(theme.ink, RING.1 + 0.24), circle(theme.amplitude(used), RING.1)]
    };
    let symbol = ring(canvas, PagePoint::new(canvas.mm(1.2), 0.0), 0.8, 0.5);
    let key = Key::new(15, "the same of a robot's limits", symbol, canvas.mm(2.4));
    for robot in canvas.found().robots.iter().filter(|robot| has_limits(scene, robot.robot)) {
        let title = format!("Robot {}: {} of its limit", scene.robots[robot.robot.0].id, percent(robot.limit_used));
        let mark = Mark::new(Layer::Symbol, "limit", ring(canvas, canvas.place(robot.at), RING.0, robot.limit_used));
        canvas.explain(colours_key(canvas));
        canvas.put(mark.titled(title).keyed(&key).avoided(0.2));
    }
}
