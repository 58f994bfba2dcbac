//! [`Layout`]: how many panels stand beside each other, how wide they are and at what scale.

use super::stage::Stage;

/// Most room around a figure, pixels.
pub(crate) const MARGIN: f64 = 36.0;
/// Room between panels beside each other, pixels.
pub(crate) const GAP: f64 = 44.0;
/// Most room across for all panels of a row, pixels.
const ACROSS: f64 = 1028.0;
/// Least width of a panel, so that captions have room, pixels.
const LEAST: f64 = 240.0;
/// A unit edge is drawn at most this long in a strip, pixels.
const LARGEST_UNIT: f64 = 72.0;
/// A unit edge is drawn at least this long, if fewer columns can help it, pixels.
const SMALLEST_UNIT: f64 = 30.0;

/// Where panels go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout {
    /// Room around the figure, pixels.
    pub margin: f64,
    /// Panels beside each other.
    pub columns: usize,
    /// Width of a panel, pixels.
    pub panel: f64,
    /// Width of all panels of a row with the gaps, pixels.
    pub content: f64,
    /// Pixels per metre.
    pub scale: f64,
}

impl Layout {
    /// For `count` panels.
    pub fn of(stage: &Stage<'_>, count: usize) -> Layout {
        let margin = stage.options.width.map_or(MARGIN, margin);
        let across = stage
            .options
            .width
            .map_or(ACROSS, |width| (width - 2.0 * margin).max(1.0));
        let count = count.max(1);
        let scale = |columns| Layout::scale(stage, across, columns, count);
        let columns = match stage.options.columns {
            Some(columns) => columns.clamp(1, count),
            None => {
                let most = match count {
                    1..=3 => count,
                    4 => 2,
                    _ => 3,
                };
                let fits = |columns: usize| {
                    scale(columns) * stage.unit >= SMALLEST_UNIT
                        && room(across, columns) >= LEAST.min(across)
                };
                (1..=most).rev().find(|c| fits(*c)).unwrap_or(1)
            }
        };
        let scale = scale(columns);
        let least = if count == 1 { 1.6 * LEAST } else { LEAST };
        let panel = (stage.view.width() * scale).max(least.min(room(across, columns)));
        let between = (columns - 1) as f64 * GAP;
        Layout {
            margin,
            columns,
            panel,
            content: columns as f64 * panel + between,
            scale,
        }
    }

    fn scale(stage: &Stage<'_>, across: f64, columns: usize, count: usize) -> f64 {
        let rows = count.div_ceil(columns);
        let high = match (count, rows) {
            (1, _) => 640.0,
            (_, 1) => 460.0,
            _ => 360.0,
        };
        // A page of its own width fixes the scale; otherwise panels are as wide as their captions need.
        let wide = match stage.options.width {
            Some(_) => room(across, columns),
            None => room(across, columns).max(LEAST),
        };
        let scale = (wide / stage.view.width())
            .min(high / stage.view.height())
            .min(LARGEST_UNIT / stage.unit);
        // A scene too small for its own coordinates to tell its places apart has no scale.
        if scale.is_finite() { scale } else { 1.0 }
    }
}

/// Room around a figure on a page of this width, pixels.
fn margin(width: f64) -> f64 {
    (0.025 * width).min(MARGIN)
}

/// Room for one of several panels beside each other, pixels.
fn room(across: f64, columns: usize) -> f64 {
    ((across - (columns - 1) as f64 * GAP) / columns as f64).max(1.0)
}
