//! Draws the force flow: the paths of the forces through the blocks. Each path is a band whose width is proportional to
//! the force.
//!
//! In each block, strands lead from the points where forces enter to the points where they leave; [`strands`] computes
//! them. A strand is drawn as a band. At a joint, the bands on both sides have the same total width and the same
//! direction.

mod path;
mod strand;

use std::rc::Rc;
use std::sync::Arc;

use path::ribbon;
use strand::{Strand, StrandKind, strands};

use super::bearing::pressed;
use super::canvas::Canvas;
use super::description::exerted_by;
use super::design::{Key, Layer, Look, Mark};
use super::panel::{About, Figure, View};
use super::{joint_forces, stage};
use crate::mechanics::analysis::{ForceKind, FrameAnalysis, Verdict};
use crate::pictures::drawing::{Colour, Outline, PagePoint, PageRect, Path, Theme};
use crate::products::wording::failure::pair;
use crate::products::wording::number::{quantity, round_below_in};

/// The width of the band of the largest force in unit lengths, with its least and largest allowed width in mm.
const LARGEST_BAND_WIDTH: (f64, f64, f64) = (0.5, 0.6, 3.7);
/// Least width of a band, mm; a narrower band would not be visible.
const MIN_BAND_WIDTH: f64 = 0.08;
/// In frames with more blocks than this, all bands of one colour are drawn as one shape, and joints have no dots.
const MAX_SINGLE_STRANDS: usize = 150;
/// Length of the arrow of the largest load or missing force, mm.
const LONGEST_ARROW: f64 = 6.0;
/// Width of the dashed edge of a band of missing forces, mm.
const MISSING_EDGE: f64 = 0.17;
/// Length of a band in the legend, mm.
const KEY_LENGTH: f64 = 4.8;

/// The figure of force flow.
pub(crate) struct ForceFlow;

impl Figure for ForceFlow {
    fn about(&self) -> About {
        About {
            states_margin: true,
            ..About::new(
                "flow",
                "The paths of the forces through the blocks, as lines as wide as the forces",
                "The flow of forces in a dry-laid structure",
            )
        }
    }

    /// Returns the scale of loads and missing forces, which have one scale.
    fn scale(&self, view: &View<'_>, look: Look) -> f64 {
        let loads = view.analysis.each().flat_map(|solved| &solved.scene.loads).map(|load| load.force.norm());
        let missing = view.analysis.frames.iter().flat_map(|frame| &frame.failures).map(|f| f.force().norm());
        look.mm(LONGEST_ARROW) / loads.chain(missing).fold(f64::MIN_POSITIVE, f64::max)
    }

    fn below(&self, canvas: &mut Canvas<'_>) {
        let bands = Bands::new(canvas);
        bands.draw(canvas);
        if !bands.joined {
            dots(canvas);
        }
        label(canvas);
    }

    fn above(&self, canvas: &mut Canvas<'_>) {
        stage::robot_limits(canvas);
        joint_forces::missing(canvas);
    }
}

/// Returns the magnitude of the largest force of a joint or a robot in any frame, N.
fn largest(frames: &[Arc<FrameAnalysis>]) -> f64 {
    frames.iter().map(|frame| frame.largest_force()).fold(0.0, f64::max)
}

/// Returns the colour of the bands of this kind in a frame with this verdict. Forces of a frame that does not stand are
/// greyer.
fn colour(theme: &Theme, verdict: Verdict, kind: StrandKind) -> Colour {
    let carried = if verdict == Verdict::Stable { theme.motion } else { theme.motion.mixed(theme.outline, 0.6) };
    match kind {
        StrandKind::Carried => carried,
        StrandKind::Weight => carried.mixed(theme.block, 0.55),
        StrandKind::Missing => theme.failure.mixed(theme.block, 0.5),
    }
}

/// The bands of a frame.
struct Bands {
    strands: Vec<Strand>,
    /// Pixels per newton.
    scale: f64,
    /// Least width of a band, pixels.
    least: f64,
    /// Whether all bands of one colour are one shape.
    joined: bool,
}

impl Bands {
    fn new(canvas: &Canvas<'_>) -> Bands {
        let scale = canvas.in_units(LARGEST_BAND_WIDTH) / largest(&canvas.analysis.frames).max(f64::MIN_POSITIVE);
        let strands = strands(canvas.solved(), canvas.camera.metres(scale));
        let joined = canvas.frame().placed.len() > MAX_SINGLE_STRANDS;
        Bands { strands, scale, least: canvas.mm(MIN_BAND_WIDTH), joined }
    }

    /// Draws the bands in three layers: at the bottom the bands of weights, above them the bands of the forces that
    /// blocks transmit, and on top the bands of missing forces.
    fn draw(&self, canvas: &mut Canvas<'_>) {
        for kind in [StrandKind::Weight, StrandKind::Carried, StrandKind::Missing] {
            let key = self.key(canvas, kind);
            let mut joined = Outline::default();
            for strand in self.strands.iter().filter(|strand| strand.kind == kind) {
                let outline = self.band(canvas, strand);
                if self.joined {
                    joined.extend(outline);
                    continue;
                }
                let mark = Mark::new(Layer::Force, "strand", vec![self.filled(canvas, outline, kind)]);
                canvas.put(mark.titled(title(canvas, strand)).keyed(&key).avoided(0.1));
            }
            if !joined.segments.is_empty() {
                canvas.put(Mark::new(Layer::Force, "flow", vec![self.filled(canvas, joined, kind)]).keyed(&key));
            }
        }
        let thin = self.least / self.scale;
        if self.strands.iter().any(|strand| strand.widths.iter().any(|width| *width < thin)) {
            let words = canvas.newtons(thin);
            canvas.note(70, &format!("all forces under {words} have the same width"));
        }
        if self.strands.iter().any(|strand| !strand.exact) {
            canvas.note(71, "paths inside blocks are schematic, widths to scale");
        }
    }

    /// Returns the outline of the band of a strand.
    fn band(&self, canvas: &Canvas<'_>, strand: &Strand) -> Outline {
        let width = |newtons: &f64| canvas.camera.metres((newtons * self.scale).max(self.least));
        let mut widths: Vec<f64> = strand.widths.iter().map(width).collect();
        let mut axis = strand.axis.clone();
        if self.joined && !strand.exact {
            // In a figure with many blocks, bends are not visible. Straight bands make the file smaller.
            axis = axis.first().into_iter().chain(axis.last()).copied().collect();
            widths = widths.first().into_iter().chain(widths.last()).copied().collect();
        }
        ribbon(&axis, &widths, &canvas.camera)
    }

    /// Fills a band. A band of missing forces also has a dashed edge, because the colour of the band cannot be recognised
    /// in a greyscale print.
    fn filled(&self, canvas: &Canvas<'_>, outline: Outline, kind: StrandKind) -> Path {
        let band = Path::filled(outline, colour(canvas.theme(), canvas.found().verdict, kind));
        match kind {
            StrandKind::Missing => {
                let edge = canvas.pen(canvas.theme().failure, MISSING_EDGE);
                band.with_stroke(edge.dashed([canvas.mm(0.55), canvas.mm(0.37)]))
            }
            StrandKind::Carried | StrandKind::Weight => band,
        }
    }

    /// Returns the entry of the legend for the bands of this kind. That of carried forces shows their scale.
    fn key(&self, canvas: &Canvas<'_>, kind: StrandKind) -> Rc<Key> {
        let units = canvas.scene().units.force();
        let newtons = round_below_in(largest(&canvas.analysis.frames), units);
        let (rank, words, width) = match kind {
            StrandKind::Carried => {
                let what = if canvas.found().verdict == Verdict::Stable { "force" } else { "carried force" };
                (10, format!("{what} of {}", quantity(newtons, units)), newtons * self.scale)
            }
            StrandKind::Weight => (12, "weight".to_owned(), canvas.mm(0.5)),
            StrandKind::Missing => (52, "force that cannot be carried".to_owned(), canvas.mm(0.9)),
        };
        let wide = canvas.mm(KEY_LENGTH);
        let rect = PageRect { at: PagePoint::new(0.0, -width / 2.0), width: wide, height: width };
        let symbol = vec![self.filled(canvas, Outline::rounded(rect, 0.0), kind)];
        Key::new(rank, words, symbol, wide)
    }
}

/// Describes a band: `In block a: 5 N from a load, 6 N to block b`.
fn title(canvas: &Canvas<'_>, strand: &Strand) -> String {
    let scene = canvas.scene();
    let name = |kind: ForceKind| match kind {
        ForceKind::Load => "a load".to_owned(),
        kind if kind.is_failure() => "a missing force".to_owned(),
        kind => exerted_by(scene, kind).unwrap_or("its weight".to_owned()),
    };
    let [from, to] = strand.amounts.map(|newtons| canvas.newtons(newtons));
    let block = &scene.blocks[strand.on.0].id;
    format!("In block {block}: {from} from {}, {to} to {}", name(strand.from), name(strand.to))
}

/// Draws a dot at the point of action of the resultant of each joint with a force.
fn dots(canvas: &mut Canvas<'_>) {
    let (scene, theme) = (canvas.scene(), canvas.theme());
    let radius = canvas.in_units((0.06, 0.2, 0.6));
    let dot = |at: PagePoint, radius: f64| {
        vec![Path::filled(Outline::circle(at, radius), theme.ink).cased(theme.page, 0.3 * radius)]
    };
    let of_key = canvas.mm(0.5);
    let symbol = dot(PagePoint::new(of_key, 0.0), of_key);
    let words = "resultant of a joint";
    let key = Key::new(24, words, symbol, 2.0 * of_key);
    for (contact, _) in pressed(canvas.solved()) {
        let pair = pair(scene, contact.interface.bodies);
        let amount = canvas.newtons(contact.amount());
        let shapes = dot(canvas.place(contact.resultant.at), radius);
        let mark = Mark::new(Layer::Force, "resultant", shapes).titled(format!("Between {pair}: {amount}"));
        canvas.put(mark.keyed(&key).avoided(0.2));
    }
}

/// Asks for the amount of the largest force of a joint, beside this joint.
fn label(canvas: &mut Canvas<'_>) {
    let contacts = canvas.found().contacts.iter();
    let largest = contacts.reduce(|most, contact| {
        // Forces that differ only by rounding errors have no order.
        let (force, least) = (contact.amount(), most.amount());
        if force > (1.0 + 1e-6) * least { contact } else { most }
    });
    if let Some(contact) = largest.filter(|contact| contact.amount() > 0.0) {
        let theme = canvas.theme();
        let words = canvas.newtons(contact.amount());
        let ink = theme.letters_on(theme.page, Some(colour(theme, canvas.found().verdict, StrandKind::Carried)));
        let at = canvas.place(contact.resultant.at);
        stage::amount(canvas, words, ink, (vec![at], 3), None);
    }
}
