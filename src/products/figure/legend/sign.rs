//! Signs of the legend for weights, loads and forces that are too small for an arrow. Each is drawn from the middle of
//! its left end.

use crate::drawing::arrow::straight;
use crate::drawing::{Item, Outline, PagePoint, Path, Stroke, Theme};
use crate::figure::pen::{CENTROID_RADIUS, DOT_RADIUS};

/// Length of a sample arrow, pixels.
pub(super) const SAMPLE: f64 = 26.0;

pub(super) fn weight_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let (colour, from) = (theme.arrow(1), at.moved(4.0, 0.0));
    let arrow = straight(from, (SAMPLE - 4.0, 0.0), 2.6);
    let ring = Outline::circle(from, CENTROID_RADIUS * 2.6);
    vec![
        Path::filled(arrow, colour).into(),
        Path::filled(ring, theme.page)
            .with_stroke(Stroke::new(colour, 1.2))
            .into(),
    ]
}

pub(super) fn load_sign(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let arrow = straight(at, (SAMPLE, 0.0), 3.4);
    vec![
        Path::filled(arrow, theme.page)
            .with_stroke(Stroke::new(theme.load, 1.2))
            .into(),
    ]
}

pub(super) fn load_dot(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let dot = Path::filled(
        Outline::circle(at.moved(DOT_RADIUS, 0.0), DOT_RADIUS),
        theme.page,
    );
    vec![dot.with_stroke(Stroke::new(theme.load, 1.2)).into()]
}

pub(super) fn missing_dot(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let dot = Outline::circle(at.moved(DOT_RADIUS, 0.0), DOT_RADIUS);
    vec![Path::filled(dot, theme.failure).into()]
}
