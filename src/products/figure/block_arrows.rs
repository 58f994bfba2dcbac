//! Draws the forces of a structure as in the thesis: each force is an arrow on the block on which it acts, in the colour
//! of this block, and missing forces are thick and red. The colours of blocks show the quantity that the option `fill`
//! selects.

use std::rc::Rc;

use super::arrow::{self, ForceArrow, round_above};
use super::canvas::Canvas;
use super::design::{Key, Layer, Mark, unit};
use super::fill::Fills;
use super::option::ArrowScale;
use super::panel::{About, Figure};
use super::parallel_arrows::separate_parallel_arrows;
use super::placing::Label;
use super::{description, joint_forces, load, stage};
use crate::mechanics::analysis::ForceKind;
use crate::mechanics::scene::BodyId;
use crate::pictures::drawing::{self, Colour, Face, Outline, PagePoint, Path, Stroke, text};
use crate::products::wording::number::{quantity, round_below_in};

/// Least length of the arrow of the largest force, mm.
const LONGEST: f64 = 6.0;
/// This arrow is at most so many unit lengths long in frames of at most [`FEW_BLOCKS`] blocks, and of more blocks.
const MOST_UNITS: [f64; 2] = [3.0, 1.5];
const FEW_BLOCKS: usize = 40;
/// Least width of a shaft, mm.
const SHAFT: f64 = 0.4;
/// Least length of an arrow, mm.
const TICK: f64 = 0.9;
/// If unit lengths are shorter than this, weights begin without a circle, mm.
const READABLE_UNIT: f64 = 3.7;
/// Radius of the circle at the tail of a weight, in widths of its shaft.
const CENTROID_RADIUS: f64 = 1.25;
/// Two forces that differ by less than this share of the largest have no order.
const ORDER_STEP: f64 = 1e-3;
/// With more blocks than this, only the largest force has an amount, even on request.
const MAX_AMOUNT_BLOCKS: usize = 60;
/// Length of the bar of colours in the legend, mm.
const COLOURS_LENGTH: f64 = 14.0;

/// The figure of forces with arrows on each block.
pub(crate) struct BlockArrows;

impl Figure for BlockArrows {
    fn about(&self) -> About {
        joint_forces::about()
    }

    fn draw(&self, canvas: &mut Canvas<'_>) {
        let fills = Fills::new(canvas.analysis, canvas.options.fill);
        canvas.fills = fills.of(canvas.number, canvas.theme());
        stage::ground(canvas);
        stage::blocks(canvas);
        stage::listed_contacts(canvas);
        if fills.vary() {
            let symbol = stage::colour_bar(canvas, COLOURS_LENGTH, |share| fills.colour(canvas.theme(), share));
            let ([least, most], what) = fills.key();
            let words = format!("{least} to {most}: {what}");
            canvas.explain(Key::new(65, words, symbol, canvas.mm(COLOURS_LENGTH)));
        }
        if !canvas.look.is_strip && !canvas.options.printed() {
            joint_forces::collapse(canvas);
        }
        let largest = largest(canvas);
        if largest > 0.0 {
            arrows(canvas, largest);
        }
        stage::robots(canvas);
        load::loads(canvas);
        joint_forces::missing(canvas);
        if !canvas.found().failures.is_empty() {
            canvas.note(75, "arrows and colours show the balance with the missing forces");
        }
        if largest > 0.0 {
            scale(canvas, largest);
        }
        stage::names(canvas);
    }
}

/// Returns the force that sets the scale of the arrows of this panel, N: the largest in this frame or in all frames.
fn largest(canvas: &Canvas<'_>) -> f64 {
    let of = |frame| arrow::largest(canvas.analysis, frame, canvas.options);
    match canvas.options.scale {
        ArrowScale::Panel => of(canvas.number),
        ArrowScale::Strip => (0..canvas.analysis.frames.len()).map(of).fold(0.0, f64::max),
    }
}

/// Returns the outline of an arrow on the page, whose shaft is at least [`SHAFT`] wide. An arrow that would be shorter
/// than a tick is a tick, except in printed figures.
fn outline(canvas: &Canvas<'_>, from: PagePoint, reach: (f64, f64), width: f64) -> Outline {
    let length = libm::hypot(reach.0, reach.1);
    let tick = if canvas.options.printed() { 0.0 } else { canvas.mm(TICK) };
    let longer = (tick / length.max(f64::MIN_POSITIVE)).max(1.0);
    drawing::arrow::straight(from, (longer * reach.0, longer * reach.1), width.max(canvas.mm(SHAFT)))
}

/// Draws the arrows of weights and of forces of contacts, and in printed figures also those of robots and of missing
/// forces. `largest` is the force that sets the scale, N.
fn arrows(canvas: &mut Canvas<'_>, largest: f64) {
    let (scene, options, theme) = (canvas.scene(), canvas.options, canvas.theme());
    let (placed, printed) = (&canvas.frame().placed, options.printed());
    let unit = unit(scene, options.zoom);
    let pixels = canvas.camera.length(unit);
    let most = MOST_UNITS[usize::from(placed.len() > FEW_BLOCKS)];
    let stretch = if printed { 1.0 } else { (canvas.mm(LONGEST) / pixels).clamp(1.0, most) };
    canvas.scale = stretch * pixels / largest;
    let mut marks = arrow::marks(canvas.analysis, canvas.number, options, largest / stretch);
    marks.arrows.retain(|arrow| match arrow.kind {
        ForceKind::Load | ForceKind::RobotTorque(_) | ForceKind::MissingTorque(_) => false,
        kind => printed || kind == ForceKind::Weight || kind.is_contact(),
    });
    if !printed {
        let least = canvas.camera.metres(canvas.mm(SHAFT));
        marks.arrows.iter_mut().for_each(|arrow| arrow.width = (stretch.sqrt() * arrow.width).max(least));
        separate_parallel_arrows(&mut marks);
    }
    // The largest first, so that small arrows lie on top. Forces that differ only by rounding errors keep their order.
    let step = (ORDER_STEP * largest).max(f64::MIN_POSITIVE);
    marks.arrows.sort_by_key(|arrow| core::cmp::Reverse((arrow.force.norm() / step).round() as u64));
    let mut fills = vec![theme.block; scene.blocks.len()];
    for (place, id) in placed.iter().enumerate() {
        fills[id.0] = canvas.fill(place, *id);
    }
    let (forces, weights, ticks) = (force_key(canvas), weight_key(canvas), tick_key(canvas));
    for arrow in &marks.arrows {
        let on = if let BodyId::Block(id) = arrow.on { fills[id.0] } else { theme.ground };
        let from = canvas.place(arrow.at);
        let reach = canvas.camera.turn(arrow.reach());
        let (length, width) = (libm::hypot(reach.0, reach.1), canvas.camera.length(arrow.width));
        let casing = canvas.mm(0.13);
        let path = Path::filled(outline(canvas, from, reach, width), arrow.colour);
        let mut shapes = vec![path.cased(theme.casing_on(on, arrow.colour), casing)];
        if arrow.kind == ForceKind::Weight && !printed && pixels > canvas.mm(READABLE_UNIT) {
            shapes.push(circle(canvas, from, width, arrow.colour));
        }
        let layer = match arrow.kind {
            ForceKind::Robot(_) => Layer::Symbol,
            kind if kind.is_failure() => Layer::Missing,
            _ => Layer::Force,
        };
        let is_tick = length < 0.999 * canvas.mm(TICK) && !printed;
        let key = if arrow.kind == ForceKind::Weight && !printed { &weights } else { &forces };
        let title = description::arrow(scene, unit, arrow);
        let mark = Mark::new(layer, "force", shapes).titled(title).keyed(if is_tick { &ticks } else { key });
        let few = placed.len() <= FEW_BLOCKS;
        canvas.put(if is_tick && !few { mark } else { mark.avoided(0.15) });
    }
    let all = options.amounts && placed.len() <= MAX_AMOUNT_BLOCKS;
    if all || !printed {
        amounts(canvas, &marks.arrows, all);
    }
}

/// Asks for the amount of the largest force of a contact, or of all forces.
fn amounts(canvas: &mut Canvas<'_>, arrows: &[ForceArrow], all: bool) {
    let (theme, units) = (canvas.theme(), canvas.scene().units.force());
    let is_contact = |arrow: &&ForceArrow| arrow.kind.is_contact();
    let largest = arrows.iter().find(is_contact);
    let others = arrows.iter().filter(|arrow| all && largest.is_none_or(|most| !core::ptr::eq(most, *arrow)));
    for (arrow, rank) in largest.into_iter().map(|arrow| (arrow, 3)).chain(others.map(|arrow| (arrow, 4))) {
        let (from, reach) = (canvas.place(arrow.at), canvas.camera.turn(arrow.reach()));
        let anchors = [0.9, 0.5, 0.1].map(|share| from.moved(share * reach.0, share * reach.1)).to_vec();
        let ink = theme.letters_on(theme.page, Some(arrow.colour));
        stage::amount(canvas, quantity(arrow.force.norm(), units), ink, (anchors, rank), None);
    }
}

/// Draws the circle at the centroid from which a weight begins.
fn circle(canvas: &Canvas<'_>, at: PagePoint, width: f64, colour: Colour) -> Path {
    let width = width.max(canvas.mm(SHAFT));
    let outline = Outline::circle(at, CENTROID_RADIUS * width);
    Path::filled(outline, canvas.theme().page).with_stroke(Stroke::new(colour, 0.6 * width))
}

/// Draws an arrow for the legend that begins at x = `from`.
fn symbol(canvas: &Canvas<'_>, from: f64, length: f64, colour: Colour) -> Path {
    Path::filled(outline(canvas, PagePoint::new(from, 0.0), (length, 0.0), canvas.mm(0.55)), colour)
}

/// Returns the entry that explains the colours of arrows: an arrow of each colour.
fn force_key(canvas: &Canvas<'_>) -> Rc<Key> {
    let theme = canvas.theme();
    let mut colours: Vec<Colour> = Vec::new();
    for place in 1..=canvas.scene().blocks.len().min(theme.arrows.len()) {
        colours.push(theme.arrow(place));
    }
    let step = canvas.mm(2.6);
    let symbol = colours.iter().enumerate().map(|(n, colour)| symbol(canvas, n as f64 * step, 0.9 * step, *colour));
    let words = "one colour per block";
    Key::new(22, words, symbol.collect(), (colours.len() as f64 - 0.1) * step)
}

fn weight_key(canvas: &Canvas<'_>) -> Rc<Key> {
    let (colour, long) = (canvas.theme().arrow(1), canvas.mm(4.0));
    let start = canvas.mm(0.9);
    let circle = circle(canvas, PagePoint::new(start, 0.0), canvas.mm(0.45), colour);
    let symbol = vec![symbol(canvas, start, long - start, colour), circle];
    Key::new(30, "weight", symbol, long)
}

/// Returns the entry that explains the shortest arrows.
fn tick_key(canvas: &Canvas<'_>) -> Rc<Key> {
    let tick = canvas.mm(TICK);
    let words = if canvas.has_one_scale() {
        let newtons = round_above(tick / canvas.scale);
        format!("up to {}", canvas.newtons(newtons))
    } else {
        "a smaller force".to_owned()
    };
    Key::new(15, words, vec![symbol(canvas, 0.0, tick, canvas.theme().arrow(1))], tick)
}

/// Shows the scale of the arrows: in the legend if all panels share it, otherwise below the picture.
fn scale(canvas: &mut Canvas<'_>, largest: f64) {
    let ink = canvas.theme().faint;
    let units = canvas.scene().units.force();
    let newtons = round_below_in(largest, units);
    let (length, words) = (canvas.scale * newtons, quantity(newtons, units));
    if canvas.has_one_scale() {
        let symbol = vec![symbol(canvas, 0.0, length, ink)];
        canvas.explain(Key::new(12, format!("{words} on a block"), symbol, length));
    } else if canvas.options.keys {
        let size = canvas.label_size();
        let (all, gap, wide) = (canvas.extent(), canvas.mm(1.2), text::width(&words, Face::Sans, size));
        let left = canvas.structure.at.x + (canvas.structure.width - length - gap - wide) / 2.0;
        let at = PagePoint::new(left, all.at.y + all.height + canvas.mm(2.6));
        let path = Path::filled(outline(canvas, at, (length, 0.0), canvas.mm(0.45)), ink);
        canvas.put(Mark::new(Layer::Around, "scale", vec![path]).avoided(0.3));
        let middle = at.moved(length + gap + wide / 2.0, 0.0);
        canvas.label(Label::at(middle, words, ink, 0));
    }
}
