//! Draws the safe part of each interface, in which the resultant of the interface must act, and a mark at the position
//! of the resultant.

use std::rc::Rc;

use super::bearing::{Bearing, pressed};
use super::canvas::Canvas;
use super::design::{Key, Layer, Mark};
use super::option::Options;
use super::panel::{About, Figure};
use super::verdict;
use crate::geometry::Point;
use crate::mechanics::analysis::{Analysis, MarginKind, Verdict};
use crate::pictures::drawing::{Colour, Outline, PagePoint, Path, Stroke, Theme};
use crate::products::wording::failure::pair;
use crate::products::wording::number::{FULL_UTILISATION, percent, quantity};
use crate::products::wording::verdict::reason;

/// A resultant lies outside the safe part if its distance from the middle, divided by half the length of this part,
/// exceeds this value.
const KERNEL_TOL: f64 = 1.0 + 1e-6;
/// The width of the line of a safe part in unit lengths, with its least and largest width in mm.
const SAFE_LINE_WIDTH: (f64, f64, f64) = (0.085, 0.3, 0.85);
/// Length of a line in the legend, mm.
const KEY_LENGTH: f64 = 4.8;

/// The figure of kernels.
pub(crate) struct Kernel;

impl Figure for Kernel {
    fn about(&self) -> About {
        About::new(
            "kernel",
            "The safe part of each interface, and the position of the resultant in it",
            "Resultants in the safe parts of interfaces",
        )
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        if verdict::has_cheap_margins(analysis) { &[MarginKind::Kernel] } else { &[] }
    }

    fn words(&self, analysis: &Analysis, frame: usize, _options: &Options) -> Vec<String> {
        let (scene, found) = analysis.at(frame);
        match found.verdict {
            Verdict::Unstable => vec!["no resultants, because no forces balance the structure".into()],
            Verdict::Undecided => vec![format!("no resultants; {}", reason(scene, found))],
            Verdict::Stable if scene.kernel >= 1.0 => vec!["every safe part is a point".into()],
            Verdict::Stable => verdict::margin(scene, found, MarginKind::Kernel).into_iter().collect(),
        }
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        safe_parts(canvas);
        resultants(canvas);
    }
}

fn rest_stroke(theme: &Theme, bold: f64) -> Stroke {
    Stroke::new(theme.faint, 0.45 * bold).dashed([1.1 * bold, 0.9 * bold]).mitred()
}

/// Draws the safe part of each interface as a solid line, and the unsafe parts as dashed lines.
fn safe_parts(canvas: &mut Canvas<'_>) {
    let (scene, theme, bold) = (canvas.scene(), canvas.theme(), canvas.in_units(SAFE_LINE_WIDTH));
    let key = |rank: u8, words: String, stroke: Stroke| Key::line(rank, words, canvas.mm(KEY_LENGTH), stroke);
    // Where no forces balance the structure, nothing is safe.
    let (ink, words, state) = match canvas.found().verdict {
        Verdict::Stable => (theme.safe, "safe part of an interface", "safe"),
        _ => {
            (theme.faint, "part of an interface in which forces would have to act", "in which forces would have to act")
        }
    };
    let safe = Stroke::new(ink, bold).mitred();
    let safe_key = key(10, words.into(), safe.clone());
    let rest = rest_stroke(theme, bold);
    let rest_key = key(11, format!("unsafe part, for a kernel of {}", scene.kernel), rest.clone());
    for contact in &canvas.found().contacts {
        let place = |points: [Point; 2]| points.map(|p| canvas.place(p));
        let (ends, points) = (place(contact.interface.ends), place(contact.application_points));
        let length = contact.interface.length();
        let units = scene.units.length();
        let title = format!(
            "Between {}: {} of {} {state}",
            pair(scene, contact.interface.bodies),
            quantity((1.0 - scene.kernel) * length, units),
            quantity(length, units)
        );
        let mut shapes = Vec::new();
        if scene.kernel > 0.0 {
            let rests = Outline::lines([0, 1].map(|k| [ends[k], points[k]]));
            let casing = Stroke::new(theme.page, 0.45 * bold + canvas.mm(0.3));
            shapes.push(Path::stroked(rests.clone(), casing).with_opacity(0.8));
            shapes.push(Path::stroked(rests, rest.clone()));
            canvas.explain(Rc::clone(&rest_key));
        }
        // A safe part of length 0 is a point, which is drawn as a dot.
        shapes.push(if scene.kernel < 1.0 && length > 0.0 {
            Path::stroked(Outline::line(points), safe.clone())
        } else {
            Path::filled(Outline::circle(points[0], 0.9 * bold), ink)
        });
        let mark = Mark::new(Layer::Force, "interface", shapes).titled(title);
        canvas.put(mark.keyed(&safe_key).avoided(0.2));
    }
}

/// True if a resultant acts at an end of the safe part of its interface, or outside this part.
fn at_end(bearing: &Bearing) -> bool {
    bearing.eccentricity.is_some_and(|share| share >= FULL_UTILISATION)
}

/// Draws a mark at the point of action of each resultant, if the frame stands: a disc inside the safe part, a diamond at
/// an end of this part, and a red diamond outside it.
fn resultants(canvas: &mut Canvas<'_>) {
    let (scene, theme, found) = (canvas.scene(), canvas.theme(), canvas.found());
    if found.verdict != Verdict::Stable {
        return;
    }
    let radius = 0.5 * canvas.in_units(SAFE_LINE_WIDTH) + canvas.mm(0.25);
    let shape = |at: PagePoint, bearing: &Bearing| -> (Outline, Colour) {
        if !at_end(bearing) {
            return (Outline::circle(at, radius), theme.ink);
        }
        let r = 1.35 * radius;
        let diamond = Outline::ring([(0.0, -r), (r, 0.0), (0.0, r), (-r, 0.0)].map(|(x, y)| at.moved(x, y)));
        let outside = bearing.eccentricity.is_some_and(|share| share > KERNEL_TOL);
        (diamond, if outside { theme.falls } else { theme.ink })
    };
    let key = |rank: u8, words: &str, eccentricity: f64| {
        let sample = Bearing { pressed: 1.0, eccentricity: Some(eccentricity), friction: None };
        let (outline, ink) = shape(PagePoint::new(1.35 * radius, 0.0), &sample);
        let (words, symbol) = (words.to_owned(), vec![Path::filled(outline, ink)]);
        Key::new(rank, words, symbol, 2.7 * radius)
    };
    let within_key = key(20, "resultant", 0.0);
    let end_key = key(21, "resultant at an end of the safe part", 1.0);
    for (contact, bearing) in pressed(scene, found) {
        let (outline, ink) = shape(canvas.place(contact.resultant.at), &bearing);
        let pair = pair(scene, contact.interface.bodies);
        let amount = canvas.newtons(contact.amount());
        let place = bearing.eccentricity.map_or(String::new(), |share| {
            format!(", {} of the way from the middle to the end of the safe part", percent(share))
        });
        let path = Path::filled(outline, ink).cased(theme.page, 0.28 * radius);
        let mark = Mark::new(Layer::Force, "resultant", vec![path]);
        let mark = mark.titled(format!("Resultant between {pair}: {amount}{place}")).avoided(0.2);
        canvas.put(mark.keyed(if at_end(&bearing) { &end_key } else { &within_key }));
    }
}
