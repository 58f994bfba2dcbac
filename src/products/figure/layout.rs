//! [`Layout`]: chooses the number of columns, the width and the scale of the panels of a figure.

use super::context::FigureContext;
use super::dimension;
use crate::pictures::drawing::{Face, text};

/// Largest margin around a figure, pixels.
pub(crate) const MAX_MARGIN: f64 = 36.0;
/// Largest gap between columns in pixels, and as a fraction of the page width. The fraction matters only if the
/// options set the page width.
const MAX_GAP: (f64, f64) = (44.0, 0.05);
/// Largest width of a row of panels if the options set no page width, pixels.
const MAX_ROW_WIDTH: f64 = 1028.0;
/// Least width of a panel, so that captions have space, pixels.
const MIN_PANEL_WIDTH: f64 = 240.0;
/// Least width of a panel if there are many panels, pixels. With wider panels the figure would be higher than a page.
const MIN_NARROW_PANEL_WIDTH: f64 = 120.0;
/// Largest number of columns, unless the options set another number.
const MAX_COLUMNS: usize = 8;
/// Largest ratio of height to width of all panels of a page together, so that title and legend fit on the page.
const MAX_PAGE_RATIO: f64 = 1.2;
/// Largest ratio of height to width of all panels together in a column of print.
const MAX_COLUMN_RATIO: f64 = 2.2;
/// Height of the verdict and its text below a panel, pixels.
const VERDICT_HEIGHT: f64 = 64.0;
/// Largest length of a unit length (a typical size of a block) on the page, pixels.
const MAX_UNIT_LENGTH: f64 = 72.0;
/// Least length of a unit length on the page, pixels, if a smaller number of columns can achieve it.
const MIN_UNIT_LENGTH: f64 = 30.0;

/// The part of a figure that has to fit on a page.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fit {
    /// The whole figure, if possible.
    Page,
    /// Each row of panels.
    Rows,
}

/// The arrangement of the panels of a figure: columns, widths and scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout {
    /// Margin around the figure, pixels.
    pub margin: f64,
    /// Panels per row.
    pub columns: usize,
    /// Gap between columns, pixels.
    pub gap: f64,
    /// Width of a panel, pixels.
    pub panel: f64,
    /// Width of all panels of a row with the gaps, pixels.
    pub content: f64,
    /// Pixels per metre.
    pub scale: f64,
}

impl Layout {
    /// Computes a layout for `count` panels that fits on one page if possible.
    pub fn new(context: &FigureContext<'_>, count: usize) -> Layout {
        Layout::with(context, count, Fit::Page)
    }

    /// Computes a layout for `count` panels whose rows may be distributed over several pages.
    pub fn roomy(context: &FigureContext<'_>, count: usize) -> Layout {
        Layout::with(context, count, Fit::Rows)
    }

    /// Returns lower bounds for the width and the height of the page, in pixels: the size of all pictures without
    /// texts.
    pub fn least(&self, context: &FigureContext<'_>) -> (f64, f64) {
        let frames: Vec<usize> = (0..context.marks.len()).collect();
        let rows = frames.chunks(self.columns.max(1));
        let high: f64 = rows.map(|row| context.row(row).height() * self.scale).sum();
        (self.content, high)
    }

    fn with(context: &FigureContext<'_>, count: usize, fit: Fit) -> Layout {
        let margin = context.options.width.map_or(MAX_MARGIN, margin);
        let across = context.options.width.map_or(MAX_ROW_WIDTH, |width| (width - 2.0 * margin).max(1.0));
        let gap = match context.options.width {
            Some(width) => MAX_GAP.0.min(MAX_GAP.1 * width),
            None => MAX_GAP.0,
        };
        let row = Row { context, count: count.max(1), across, gap };
        let columns = match context.options.columns {
            Some(columns) => columns.clamp(1, row.count),
            None => row.columns(fit),
        };
        let scale = row.scale(columns);
        let least = if row.count == 1 { 1.6 * MIN_PANEL_WIDTH } else { MIN_PANEL_WIDTH };
        let dimensions = dimensions(context);
        let panel = (context.view.width() * scale + dimensions).max(least.min(row.room(columns)));
        let between = (columns - 1) as f64 * gap;
        Layout { margin, columns, gap, panel, content: columns as f64 * panel + between, scale }
    }
}

/// A row of panels whose number of columns is not decided yet.
struct Row<'a> {
    context: &'a FigureContext<'a>,
    /// The number of panels of the figure.
    count: usize,
    /// The width of the row, pixels.
    across: f64,
    /// The gap between columns, pixels.
    gap: f64,
}

impl Row<'_> {
    /// Returns the width available for each panel in a row of `columns` panels, in pixels.
    fn room(&self, columns: usize) -> f64 {
        ((self.across - (columns - 1) as f64 * self.gap) / columns as f64).max(1.0)
    }

    /// Chooses the number of columns: the largest number up to 3 (for four panels, up to 2) for which the panels are
    /// not too small. If the whole figure should fit on one page but is too high, chooses the smallest larger number
    /// for which it fits, or the number with the least height if none fits.
    fn columns(&self, fit: Fit) -> usize {
        let (count, across) = (self.count, self.across);
        // If the rows may be distributed over several pages, panels may have a small scale, but they must not be
        // narrow.
        let fits = |columns: usize| {
            (fit == Fit::Rows || self.scale(columns) * self.context.unit >= MIN_UNIT_LENGTH)
                && self.room(columns) >= MIN_PANEL_WIDTH.min(across)
        };
        let most = match count {
            1..=3 => count,
            4 => 2,
            _ => 3,
        };
        let roomy = (1..=most).rev().find(|c| fits(*c)).unwrap_or(1);
        let page = if self.context.options.is_column() { MAX_COLUMN_RATIO } else { MAX_PAGE_RATIO };
        if fit == Fit::Rows || self.height(roomy) <= page * across {
            return roomy;
        }
        let more = roomy + 1..=count.min(MAX_COLUMNS);
        let more = more.filter(|c| self.room(*c) >= MIN_NARROW_PANEL_WIDTH);
        let more: Vec<usize> = more.collect();
        let high = |columns: &usize| self.height(*columns);
        let enough = more.iter().find(|c| high(c) <= page * across);
        let least = more.iter().min_by(|a, b| high(a).total_cmp(&high(b)));
        let least = least.filter(|c| high(c) < high(&roomy));
        enough.or(least).copied().unwrap_or(roomy)
    }

    /// Returns the height of all rows of panels together, pixels, if a row has `columns` panels.
    fn height(&self, columns: usize) -> f64 {
        let words = words(self.context, self.count, self.room(columns)) + VERDICT_HEIGHT;
        let panel = self.context.view.height() * self.scale(columns) + words;
        self.count.div_ceil(columns) as f64 * panel
    }

    /// Returns the scale of the panels in pixels per metre, if a row has `columns` panels.
    fn scale(&self, columns: usize) -> f64 {
        let (context, count) = (self.context, self.count);
        let room = self.room(columns);
        let rows = count.div_ceil(columns);
        let high = match (count, rows) {
            (1, _) => 640.0,
            (_, 1) => 460.0,
            _ => 360.0,
        };
        let high = f64::min(high, context.options.height.unwrap_or(f64::INFINITY));
        // If the page width is given or there are many columns, the available width limits the scale. Otherwise panels
        // are at least as wide as their captions need.
        let wide = match context.options.width {
            Some(_) => room,
            None if columns > 3 => room,
            None => room.max(MIN_PANEL_WIDTH),
        };
        let scale = ((wide - dimensions(context)).max(1.0) / context.view.width())
            .min(high / context.view.height())
            .min(MAX_UNIT_LENGTH / context.unit);
        // The scale is infinite if the size of the scene is 0 or tiny. Use 1 in this case.
        if scale.is_finite() { scale } else { 1.0 }
    }
}

/// Returns the total width of the spaces for dimension lines on both sides of a picture, pixels; 0 without dimension
/// lines.
fn dimensions(context: &FigureContext<'_>) -> f64 {
    if context.options.dimensions { 2.0 * dimension::SPACE_LEFT } else { 0.0 }
}

/// Returns the height of the caption with the most lines, pixels; 0 if there are no captions. `panel` is the width of a
/// panel in pixels.
fn words(context: &FigureContext<'_>, count: usize, panel: f64) -> f64 {
    let (scene, size) = (&context.analysis.scene, context.options.theme.sizes.caption);
    if !context.options.captions || count < 2 {
        return 0.0;
    }
    let lines = scene.frames.iter().map(|frame| {
        let words = format!("(a) {}", frame.title);
        text::wrap(&words, Face::Serif, size, panel).len()
    });
    lines.max().unwrap_or(0) as f64 * 1.3 * size
}

/// Returns the width of the margin around a figure on a page of this width, both in pixels.
fn margin(width: f64) -> f64 {
    (0.025 * width).min(MAX_MARGIN)
}
