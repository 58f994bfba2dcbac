//! Draws the symbols of interfaces in the legend of a utilisation figure.

use super::{idle_stroke, rimmed};
use crate::pictures::drawing::{Item, Outline, PagePoint, Path, Stroke, Theme};

/// Length of the line of a symbol, pixels.
pub(super) const SYMBOL_WIDTH: f64 = 26.0;

/// Draws the legend symbol of an interface that uses all its friction.
pub(super) fn full_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(SYMBOL_WIDTH, 0.0)]);
    let middle = at.moved(SYMBOL_WIDTH / 2.0, 0.0);
    let bar = Outline::line([middle.moved(0.0, -7.0), middle.moved(0.0, 7.0)]);
    vec![
        rimmed(line.clone(), 4.5, 0.7, theme).into(),
        Path::stroked(line, Stroke::new(theme.amplitude(1.0), 4.5)).into(),
        Path::stroked(bar, Stroke::new(theme.ink, 1.4)).into(),
    ]
}

/// Draws the legend symbol of an interface at which no friction is available.
pub(super) fn smooth_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(SYMBOL_WIDTH, 0.0)]);
    vec![rimmed(line.clone(), 4.5, 0.7, theme).into(), Path::stroked(line, Stroke::new(theme.page, 4.5)).into()]
}

/// Draws the legend symbol of an interface without force.
pub(super) fn idle_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let line = Outline::line([at, at.moved(SYMBOL_WIDTH, 0.0)]);
    vec![Path::stroked(line, idle_stroke(theme, 4.5)).into()]
}
