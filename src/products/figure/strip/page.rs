//! [`page`]: draws a page of panels below a heading, with one legend below all panels.

use super::super::layout::Layout;
use super::super::legend::{self, Entry};
use super::super::option::Options;
use super::super::title;
use super::Strip;
use super::panel::PanelPosition;
use crate::geometry::{Bounds, Point};
use crate::pictures::drawing::{Anchor, Drawing, Item, Outline, PagePoint, Path, Stroke, Text};

/// Largest number of frames in the description of a figure.
const MAX_DESCRIBED_FRAMES: usize = 30;
/// Least width of a page without its margins, pixels, so that short words do not need several lines.
const MIN_INNER_WIDTH: f64 = 300.0;
/// Largest width of a page that the legend requires, pixels. Longer entries are broken into lines.
const MAX_LEGEND_WIDTH: f64 = 640.0;
/// Gap between rows of panels, pixels.
const ROW_GAP: f64 = 30.0;

/// Gaps between the parts of a page, pixels.
struct Gaps {
    below_title: f64,
    above_rule: f64,
    below_rule: f64,
    /// The part of the legend's last line that reaches into the margin of the page.
    below_key: f64,
    /// Height of a line of the legend, as a multiple of its font size.
    key_line: f64,
    /// Gap between the entries of a line of the legend.
    key_entries: f64,
}

impl Gaps {
    /// Returns the gaps between the parts of a page. The gaps are smaller in a column of print, because title and
    /// legend need more lines there.
    fn new(options: &Options) -> Gaps {
        if options.is_column() {
            Gaps {
                below_title: 10.0,
                above_rule: 9.0,
                below_rule: 3.0,
                below_key: 6.0,
                key_line: legend::NARROW_LINE_HEIGHT,
                key_entries: legend::NARROW_ENTRY_GAP,
            }
        } else {
            Gaps {
                below_title: 18.0,
                above_rule: 20.0,
                below_rule: 8.0,
                below_key: 10.0,
                key_line: legend::LINE_HEIGHT,
                key_entries: legend::ENTRY_GAP,
            }
        }
    }
}

/// Draws a page of panels with one legend below them. `order` lists the panels: the index of the strip and the index of
/// the frame. All strips have the same layout. All panels of a row show the same vertical range of their scenes.
pub(crate) fn page(strips: &[&Strip<'_>], order: &[(usize, usize)], heading: &str) -> Drawing {
    let Some(first) = strips.first() else {
        return Drawing::default();
    };
    let (options, layout) = (first.context.options, first.layout);
    let theme = &options.theme;
    let entries = legend::joined(strips.iter().map(|strip| strip.entries()).collect(), theme);
    let inner = inner_width(options, &layout, &entries);
    let column = options.is_column();
    let fitted = |entry: Entry| entry.fitted(inner, column, theme);
    let entries: Vec<Entry> = entries.into_iter().map(fitted).collect();
    let mut page =
        PageWriter { strips, options, layout, gaps: Gaps::new(options), inner, y: layout.margin, items: Vec::new() };
    if options.titles && !heading.is_empty() {
        page.heading(heading);
    }
    for (number, row) in order.chunks(layout.columns).enumerate() {
        if number > 0 {
            page.y += ROW_GAP;
        }
        page.row(row);
    }
    if !entries.is_empty() {
        page.legend(&entries);
    }
    let described = order.iter().take(MAX_DESCRIBED_FRAMES);
    let described: Vec<String> = described.map(|(strip, frame)| strips[*strip].described(*frame)).collect();
    Drawing {
        width: page.width().ceil(),
        height: (page.y + layout.margin).ceil(),
        title: [heading, first.content.about().title][usize::from(heading.is_empty())].to_owned(),
        description: described.join(" "),
        background: Some(theme.page),
        items: page.items,
    }
}

/// Returns the width of a page without its margins, in pixels. If the options set no width, the page is at least as
/// wide as the widest legend entry, up to [`MAX_LEGEND_WIDTH`].
fn inner_width(options: &Options, layout: &Layout, entries: &[Entry]) -> f64 {
    match options.width {
        Some(width) => (width - 2.0 * layout.margin).max(1.0),
        None => layout.content.max(legend::widest(entries, &options.theme).min(MAX_LEGEND_WIDTH)).max(MIN_INNER_WIDTH),
    }
}

/// A page that is written from top to bottom.
struct PageWriter<'a> {
    strips: &'a [&'a Strip<'a>],
    options: &'a Options,
    layout: Layout,
    gaps: Gaps,
    /// Width of the page without its margins, pixels.
    inner: f64,
    /// The y coordinate below all parts that are already written, pixels.
    y: f64,
    items: Vec<Item>,
}

impl PageWriter<'_> {
    fn width(&self) -> f64 {
        self.inner + 2.0 * self.layout.margin
    }

    /// Returns the x coordinate of the middle of the page, in pixels.
    fn middle(&self) -> f64 {
        self.width() / 2.0
    }

    /// Writes the title of the page and moves `y` below it.
    fn heading(&mut self, heading: &str) {
        let theme = &self.options.theme;
        let (lines, size) = title::lines(heading, self.inner, theme);
        for line in lines {
            let below = size * 5.0 / 22.0;
            self.y += size;
            let at = PagePoint::new(self.middle(), self.y - below);
            let words = Text::new(at, line, title::FACE, size, theme.ink);
            self.items.push(words.anchored(Anchor::Middle).into());
            self.y += below;
        }
        self.y += self.gaps.below_title;
    }

    /// Draws a row of panels, each given by its strip and its frame, and moves `y` below the row. All panels of the row
    /// show the same vertical range of the scene. Their verdicts are on the same line, below the longest caption.
    fn row(&mut self, row: &[(usize, usize)]) {
        let views = row.iter();
        let views = views.map(|(strip, frame)| self.strips[*strip].shows(*frame));
        let views: Vec<Bounds> = views.collect();
        let low = views.iter().map(|v| v.min.y).fold(f64::INFINITY, f64::min);
        let high = views.iter().map(|v| v.max.y);
        let high = high.fold(f64::NEG_INFINITY, f64::max);
        let captions = row.iter();
        let captions = captions.map(|(strip, frame)| self.strips[*strip].caption_lines(*frame));
        let captions = captions.map(|lines| lines.len()).max().unwrap_or(0);
        let left = self.middle() - self.layout.content / 2.0;
        let mut bottom = self.y;
        for (column, ((strip, frame), view)) in row.iter().zip(views).enumerate() {
            let view = Bounds { min: Point::new(view.min.x, low), max: Point::new(view.max.x, high) };
            let x = left + column as f64 * (self.layout.panel + self.layout.gap);
            let place = PanelPosition { at: PagePoint::new(x, self.y), view, captions };
            let (mut panel, end) = self.strips[*strip].panel(*frame, place);
            if self.strips.len() > 1 {
                let id = panel.id.take();
                panel.id = id.map(|id| format!("{}-{id}", strip + 1));
            }
            self.items.push(panel.into());
            bottom = f64::max(bottom, end);
        }
        self.y = bottom;
    }

    /// Draws a thin horizontal line and the legend below it, and moves `y` below the legend.
    fn legend(&mut self, entries: &[Entry]) {
        let theme = &self.options.theme;
        self.y += self.gaps.above_rule;
        let (middle, half) = (self.middle(), self.inner / 2.0);
        let rule = Outline::line([PagePoint::new(middle - half, self.y), PagePoint::new(middle + half, self.y)]);
        self.items.push(Path::stroked(rule, Stroke::new(theme.rule, 1.0)).into());
        self.y += self.gaps.below_rule;
        let top = (middle, self.y);
        let gaps = (self.gaps.key_line, self.gaps.key_entries);
        let (key, height) = legend::draw(entries, top, self.inner, gaps, theme);
        self.items.push(key.into());
        self.y += height - self.gaps.below_key;
    }
}
