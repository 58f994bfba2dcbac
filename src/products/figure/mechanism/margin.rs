//! The margin beyond which a structure falls: its interval in words, and for a tilt or a horizontal load arrows that show
//! the values at both ends.

use crate::geometry::{Vector, quarter_turn, sin_cos_degrees};
use crate::mechanics::analysis::{End, MarginKind, SolvedFrame};
use crate::pictures::drawing::{Colour, Face, Outline, PagePoint, Path, text};
use crate::products::figure::canvas::Canvas;
use crate::products::figure::design::{Key, Layer, Mark, around, direction};
use crate::products::figure::placing::Label;
use crate::products::wording::margin::{end, stated};

/// Length of the longest of the arrows that show gravity or a horizontal load, mm.
const GRAVITY_LENGTH: f64 = 10.0;
/// Distance between these arrows and the structure, mm.
const GRAVITY_DISTANCE: f64 = 3.0;

/// Says with which values of the parameter the frame stands.
pub(super) fn words(solved: SolvedFrame<'_>, toward: MarginKind) -> String {
    let SolvedFrame { found, .. } = solved;
    let margins = stated(solved);
    match (margins.iter().find(|margin| margin.kind == toward), toward) {
        (Some(margin), _) => format!("{}: {}", margin.name, margin.stands()),
        (None, _) if found.margins.is_none() => "its margins were not computed".to_owned(),
        (None, MarginKind::LoadFactor) => "it has no loads that could grow".to_owned(),
        (None, _) => "its margin was not computed".to_owned(),
    }
}

/// Draws the arrows to the left of the structure: a dashed line in the present direction of gravity, and the turned
/// gravity or the additional horizontal load at which the structure begins to fall. A pale arrow shows the value at the
/// other end of the interval, if it is known. `edge` is the value of the parameter at the margin.
pub(super) fn arrows(canvas: &mut Canvas<'_>, toward: MarginKind, edge: f64) {
    let theme = canvas.theme();
    let down = canvas.scene().down();
    // The vector of an arrow, as a multiple of gravity.
    let arrow = |value: f64| match toward {
        MarginKind::HorizontalLoad => quarter_turn(down) * value,
        _ => {
            let (sin, cos) = sin_cos_degrees(value);
            Vector::new(cos * down.x - sin * down.y, sin * down.x + cos * down.y)
        }
    };
    let meaning = match toward {
        MarginKind::Tilt => "gravity at the limits",
        MarginKind::HorizontalLoad => "horizontal load at the limits",
        _ => return,
    };
    // The nearer end of the interval is dark, the other one is pale.
    let values = [Some((edge, theme.ink)), other_end(canvas, toward, edge).map(|other| (other, theme.faint))];
    let values: Vec<(f64, Colour)> = values.into_iter().flatten().collect();
    let vectors: Vec<Vector> = values.iter().map(|(value, _)| arrow(*value)).chain([down]).collect();
    let longest = vectors.iter().map(|v| v.norm()).fold(0.0, f64::max);
    let scale = canvas.mm(GRAVITY_LENGTH) / longest.max(f64::MIN_POSITIVE);
    let tip = |from: PagePoint, v: Vector| from.moved(scale * v.x, -scale * v.y);
    let start = PagePoint::new(0.0, 0.0);
    let Some(own) = around(vectors.iter().map(|v| tip(start, *v)).chain([start])) else { return };
    // The amounts stand below the arrows.
    let size = canvas.label_size();
    let words: Vec<String> = values.iter().map(|(value, _)| end(toward, *value, *value >= 0.0)).collect();
    let wide = words.iter().map(|words| text::width(words, Face::Sans, size)).fold(own.width, f64::max);
    let left = canvas.extent().at.x - canvas.mm(GRAVITY_DISTANCE) - wide;
    let from = PagePoint::new(left + (wide - own.width) / 2.0 - own.at.x, canvas.structure.at.y - own.at.y);
    let mut below = PagePoint::new(left + wide / 2.0, from.y + own.at.y + own.height + canvas.mm(1.0) + 0.5 * size);
    let shape = |canvas: &Canvas<'_>, from: PagePoint, v: Vector, scale: f64, ink: Colour| {
        let (long, u) = (scale * v.norm(), direction(v));
        Path::filled(canvas.arrow(long, [0.42, 1.5, 1.6], 0.6).outline(from, u), ink)
    };
    let now = |canvas: &Canvas<'_>, from: PagePoint, to: PagePoint| {
        let dashed = canvas.dashes(theme.faint, 0.2, [0.8, 0.6]);
        Path::stroked(Outline::line([from, to]), dashed)
    };
    let long = canvas.mm(4.4);
    let (symbol_from, right) = (start.moved(0.0, canvas.mm(-0.7)), start.moved(0.0, canvas.mm(0.7)));
    let symbol = vec![
        now(canvas, symbol_from, symbol_from.moved(long, 0.0)),
        shape(canvas, right, Vector::new(1.0, 0.0), long, theme.ink),
    ];
    let key = Key::new(12, meaning, symbol, long);
    let mut shapes = vec![now(canvas, from, tip(from, down))];
    for (value, ink) in values.iter().rev() {
        if arrow(*value).norm() * scale > canvas.mm(0.3) {
            shapes.push(shape(canvas, from, arrow(*value), scale, *ink));
        }
    }
    let title = match toward {
        MarginKind::HorizontalLoad => format!("In addition to gravity, {} of each weight", words[0]),
        _ => format!("Gravity turned by {}", words[0]),
    };
    canvas.put(Mark::new(Layer::Missing, "gravity", shapes).titled(title).keyed(&key).avoided(0.2));
    for (words, (_, ink)) in words.into_iter().zip(values) {
        if canvas.states_amounts() {
            canvas.label(Label::at(below, words, ink, 0));
        }
        below = below.moved(0.0, 1.2 * size);
    }
}

/// Returns the end of the interval whose sign is opposite to that of `edge`, in the unit of the parameter. Returns
/// `None` if there is no such end or its value is not known.
fn other_end(canvas: &Canvas<'_>, toward: MarginKind, edge: f64) -> Option<f64> {
    let margins = stated(canvas.solved());
    let margin = margins.iter().find(|margin| margin.kind == toward)?;
    let ends = [margin.interval.low(), margin.interval.high()].into_iter().flatten();
    ends.filter_map(End::value).find(|other| *other != edge && other * edge <= 0.0)
}
