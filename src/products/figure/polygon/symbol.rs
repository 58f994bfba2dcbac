//! Draws missing forces, and lines between corners of a force polygon that are drawn twice, in the polygon and in the
//! legend.

use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::{Colour, Item, Outline, PagePoint, Path, Stroke, Theme};

/// Returns the stroke of a line that connects the two places at which the same corner of a force polygon is drawn.
pub(super) fn join_stroke(theme: &Theme) -> Stroke {
    Stroke::new(theme.faint, 0.8).dashed([2.0, 2.0])
}

/// Width of the legend symbol of the lines that connect the two places of a corner, pixels.
pub(super) const JOIN_SYMBOL: f64 = 26.0;

pub(super) fn join_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(JOIN_SYMBOL, 0.0)]);
    vec![Path::stroked(line, join_stroke(theme)).into()]
}

/// Returns the path of a missing force in the polygon: a hollow arrow with a dashed outline.
pub(super) fn missing(outline: Outline, colour: Colour, theme: &Theme) -> Path {
    let edge = Stroke::new(colour, 1.2).dashed([3.0, 2.0]);
    Path::filled(outline, theme.page).with_stroke(edge)
}

pub(super) fn missing_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let outline = straight(at, (26.0, 0.0), 4.0);
    vec![missing(outline, theme.failure, theme).into()]
}
