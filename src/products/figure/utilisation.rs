//! Draws the utilisation of a structure: the used fraction of the available friction at each interface, and the used
//! fraction of the limits of each robot.
//!
//! The forces shown are one of many equilibrium states. In another state, some joints may use less friction, and other
//! joints more. The line of the verdict therefore states the margin of the friction coefficient, which holds for all.

use std::rc::Rc;

use super::bearing::{Bearing, bearings, has_limits};
use super::canvas::Canvas;
use super::design::{Key, Layer, Mark};
use super::option::Options;
use super::panel::{About, Figure};
use super::{stage, verdict};
use crate::mechanics::analysis::{Analysis, Contact, MarginKind, Verdict};
use crate::mechanics::statics::interface::ContactKind;
use crate::pictures::drawing::{Outline, PagePoint, Path, Stroke};
use crate::products::wording::failure::pair;
use crate::products::wording::number::{FULL_UTILISATION, percent};
use crate::products::wording::verdict::reason;

/// The width of the line of an interface in unit lengths, with its least and largest width in mm.
const LINE_WIDTH: (f64, f64, f64) = (0.11, 0.34, 1.1);
/// Length of the bar across an interface that uses all its friction, as a multiple of the width of its line.
const BAR_LENGTH: f64 = 3.2;
/// Length of a line in the legend, and of the bar of colours, mm.
const KEY_LENGTH: f64 = 4.8;
const COLOURS_LENGTH: f64 = 14.0;

/// The figure of utilisation.
pub(crate) struct Utilisation;

impl Figure for Utilisation {
    fn about(&self) -> About {
        About::new(
            "utilisation",
            "The used share of the available friction at each interface",
            "Friction used in a dry-laid structure",
        )
    }

    fn stated_margins(&self, analysis: &Analysis) -> &'static [MarginKind] {
        if verdict::has_cheap_margins(analysis) { &[MarginKind::Friction, MarginKind::FrictionFactor] } else { &[] }
    }

    fn words(&self, analysis: &Analysis, frame: usize, _options: &Options) -> Vec<String> {
        let (scene, found) = analysis.at(frame);
        let mut words: Vec<String> = [MarginKind::FrictionFactor, MarginKind::Friction]
            .into_iter()
            .find_map(|kind| verdict::margin(scene, found, kind))
            .into_iter()
            .collect();
        if found.verdict == Verdict::Undecided {
            words.push(reason(scene, found));
        }
        words
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        let look = Lines::new(canvas);
        if canvas.found().verdict == Verdict::Unstable {
            canvas.note(70, "colours show the balance with the missing forces added");
        }
        look.interfaces(canvas);
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        Lines::new(canvas).robots(canvas);
    }
}

/// The widths of the lines, pixels, and the entries of the legend.
struct Lines {
    /// The width of the line of an interface.
    bold: f64,
    colours: Rc<Key>,
    full: Rc<Key>,
    smooth: Rc<Key>,
    idle: Rc<Key>,
    limits: Rc<Key>,
}

impl Lines {
    fn new(canvas: &Canvas<'_>) -> Lines {
        let theme = canvas.theme();
        let bold = canvas.in_units(LINE_WIDTH);
        let (start, long) = (PagePoint::new(0.0, 0.0), canvas.mm(KEY_LENGTH));
        let line = || Key::piece(long);
        let key = |rank: u8, words: &str, symbol: Vec<Path>| Key::new(rank, words, symbol, long);
        let of_key = canvas.mm(0.8);
        let rimmed = |share: f64| rimmed_line(canvas, line(), of_key, Some(share)).to_vec();
        let bar = Outline::line([start.moved(long / 2.0, -canvas.mm(1.2)), start.moved(long / 2.0, canvas.mm(1.2))]);
        let full = rimmed(1.0).into_iter().chain([Path::stroked(bar, canvas.pen(theme.ink, 0.26))]);
        let disc = canvas.disc(start.moved(canvas.mm(0.9), 0.0), 0.9, theme.amplitude(0.5));
        let disc = vec![disc.with_stroke(canvas.pen(theme.ink, 0.12))];
        let words = "of a robot's limits";
        let limits = Key::new(14, words, disc, canvas.mm(1.8));
        let symbol = stage::colour_bar(canvas, COLOURS_LENGTH, |share| theme.amplitude(share));
        let words = "0 to 100\u{a0}% of the available friction";
        Lines {
            bold,
            limits,
            colours: Key::new(10, words, symbol, canvas.mm(COLOURS_LENGTH)),
            // In other equilibrium states, the same interface or robot may use less of its friction or limits.
            full: key(11, "all of it in the forces shown", full.collect()),
            smooth: key(12, "no friction available", rimmed_line(canvas, line(), of_key, None).to_vec()),
            idle: key(13, "no force", vec![Path::stroked(line(), idle_stroke(canvas, of_key))]),
        }
    }

    /// Draws each interface as a line whose colour shows the used fraction of the available friction. A bar across the
    /// line shows that all friction is used. An interface without force is a thin dashed line.
    fn interfaces(&self, canvas: &mut Canvas<'_>) {
        let (scene, found) = (canvas.scene(), canvas.found());
        let all = found.contacts.iter().zip(bearings(scene, found));
        // Draw the dots of corner contacts last, because the line of an interface could cover them.
        let (corners, edges): (Vec<_>, Vec<_>) =
            all.partition(|(contact, _)| contact.interface.kind == ContactKind::Corner);
        for (contact, bearing) in edges.into_iter().chain(corners) {
            let line = Outline::line(contact.interface.ends.map(|p| canvas.place(p)));
            let pair = pair(scene, contact.interface.bodies);
            let Some(bearing) = bearing else {
                let path = Path::stroked(line, idle_stroke(canvas, self.bold));
                let mark = Mark::new(Layer::Stone, "interface", vec![path]);
                canvas.put(mark.titled(format!("Between {pair}: no force")).keyed(&self.idle));
                continue;
            };
            let pressed = canvas.newtons(bearing.pressed);
            let title = match bearing.friction {
                Some(share) => format!(
                    "Between {pair}: {} of the available friction, {} under {pressed}",
                    percent(share),
                    canvas.newtons(contact.friction_force.abs()),
                ),
                None => format!("Between {pair}: {pressed}, no friction available"),
            };
            let mut shapes = rimmed_line(canvas, line, self.bold, bearing.friction).to_vec();
            if uses_all_friction(&bearing) {
                let width = (0.3 * self.bold).clamp(canvas.mm(0.15), canvas.mm(0.3));
                let bar = Outline::line(self.across(canvas, contact));
                shapes.push(Path::stroked(bar, Stroke::new(canvas.theme().ink, width)));
                canvas.explain(Rc::clone(&self.full));
            }
            let key = if bearing.friction.is_some() { &self.colours } else { &self.smooth };
            canvas.put(Mark::new(Layer::Force, "interface", shapes).titled(title).keyed(key).avoided(0.2));
        }
    }

    /// Returns the two ends of the bar across an interface that uses all its friction.
    fn across(&self, canvas: &Canvas<'_>, contact: &Contact) -> [PagePoint; 2] {
        let (middle, half) = (canvas.place(contact.interface.middle()), 0.5 * BAR_LENGTH * self.bold);
        // The page has the same scale in both directions, so a unit normal in the scene is also one on the page.
        let (x, y) = (contact.interface.normal.x * half, -contact.interface.normal.y * half);
        [middle.moved(-x, -y), middle.moved(x, y)]
    }

    /// Draws a disc at the grip of each robot that has limits. Its colour shows the used fraction of these limits.
    fn robots(&self, canvas: &mut Canvas<'_>) {
        let (scene, theme) = (canvas.scene(), canvas.theme());
        for robot in canvas.found().robots.iter().filter(|robot| has_limits(scene, robot.robot)) {
            let (at, radius) = (canvas.place(robot.at), canvas.mm(0.9));
            let (id, used) = (&scene.robots[robot.robot.0].id, robot.limit_used);
            let rim = canvas.pen(theme.ink, 0.12);
            let mut shapes = vec![Path::filled(Outline::circle(at, radius), theme.amplitude(used)).with_stroke(rim)];
            if used >= FULL_UTILISATION {
                let bar = Outline::line([at.moved(0.0, -1.25 * radius), at.moved(0.0, 1.25 * radius)]);
                shapes.push(Path::stroked(bar, canvas.pen(theme.ink, 0.26)));
                canvas.explain(Rc::clone(&self.full));
            }
            canvas.explain(Rc::clone(&self.colours));
            let mark = Mark::new(Layer::Symbol, "limit", shapes).keyed(&self.limits);
            canvas.put(mark.titled(format!("Robot {id}: {} of its limit", percent(used))));
        }
    }
}

fn uses_all_friction(bearing: &Bearing) -> bool {
    bearing.friction.is_some_and(|share| share >= FULL_UTILISATION)
}

fn idle_stroke(canvas: &Canvas<'_>, bold: f64) -> Stroke {
    let width = (0.3 * bold).max(canvas.mm(0.11));
    Stroke::new(canvas.theme().faint, width).dashed([3.0 * width, 2.4 * width])
}

/// Returns a line with a border, which makes it visible on blocks of any colour. `share` is the used fraction of the
/// available friction; without friction, the line has the colour of the page.
fn rimmed_line(canvas: &Canvas<'_>, line: Outline, bold: f64, share: Option<f64>) -> [Path; 2] {
    let theme = canvas.theme();
    let rim = (0.16 * bold).clamp(canvas.mm(0.07), canvas.mm(0.17));
    let colour = share.map_or(theme.page, |share| theme.amplitude(share));
    [
        Path::stroked(line.clone(), Stroke::new(theme.ink, bold + 2.0 * rim)),
        Path::stroked(line, Stroke::new(colour, bold)),
    ]
}
