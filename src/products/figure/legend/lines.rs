//! [`draw`]: arranges the entries of a legend in lines, and draws them.

use super::entry::Entry;
use super::symbol::written;
use crate::pictures::drawing::{Face, Group, Item, PagePoint, Theme, text};

/// Distance between the text lines of an entry that needs several lines, as a multiple of the font size.
const WRAPPED_LINE_HEIGHT: f64 = 1.25;
/// Smallest width of the text of an entry, pixels.
const MIN_TEXT_WIDTH: f64 = 60.0;

/// An entry with its text broken into lines.
struct WrappedEntry<'e> {
    entry: &'e Entry,
    lines: Vec<String>,
    width: f64,
}

impl<'e> WrappedEntry<'e> {
    /// Breaks the text of an entry into lines, so that the entry is at most `room` pixels wide.
    fn new(entry: &'e Entry, room: f64, theme: &Theme) -> WrappedEntry<'e> {
        let (words, size) = (entry.words(), theme.sizes.key);
        let symbol = entry.symbol_width(theme);
        let left = (room - symbol).max(MIN_TEXT_WIDTH);
        let lines = text::sentence_lines(&words, Face::Sans, size, left, usize::MAX);
        let widths = lines.iter().map(|line| text::width(line, Face::Sans, size));
        let width = symbol + widths.fold(0.0, f64::max);
        WrappedEntry { entry, lines, width }
    }

    /// Returns the additional height of the entry, pixels, compared with an entry of one text line.
    fn extra_height(&self, theme: &Theme) -> f64 {
        self.lines.len().saturating_sub(1) as f64 * WRAPPED_LINE_HEIGHT * theme.sizes.key
    }

    /// Draws the entry with all its text lines. `at` is the middle of its left edge on the page.
    fn draw(&self, at: PagePoint, theme: &Theme) -> Vec<Item> {
        let mut items = self.entry.symbol(at, theme);
        let first = at.moved(self.entry.symbol_width(theme), -0.5 * self.extra_height(theme));
        for (number, line) in self.lines.iter().enumerate() {
            let down = number as f64 * WRAPPED_LINE_HEIGHT * theme.sizes.key;
            items.push(written(line, first.moved(0.0, down), theme));
        }
        items
    }
}

/// A line of the legend: entries next to each other.
#[derive(Default)]
struct KeyLine<'e> {
    entries: Vec<WrappedEntry<'e>>,
    width: f64,
}

/// Distributes the entries over lines: each entry goes into the first line that has space for it.  A line is at most `room` pixels wide, unless a single entry is wider.
/// `gap` is the space between two entries, pixels.
fn lines<'e>(entries: &'e [Entry], room: f64, gap: f64, theme: &Theme) -> Vec<KeyLine<'e>> {
    let mut lines: Vec<KeyLine<'e>> = Vec::new();
    for entry in entries {
        let laid = WrappedEntry::new(entry, room, theme);
        let fits = |line: &&mut KeyLine<'e>| line.width + gap + laid.width <= room;
        match lines.iter_mut().find(fits) {
            Some(line) => {
                line.width += gap + laid.width;
                line.entries.push(laid);
            }
            None => lines.push(KeyLine { width: laid.width, entries: vec![laid] }),
        }
    }
    lines
}

/// Draws the legend in lines of at most `room` pixels, and returns it with its height in pixels. The lines are centred
/// at the x coordinate `middle`, and the first line begins at the y coordinate `top`. `line` is the height of a line as
/// a multiple of the font size. `gap` is the space between two entries, pixels.
pub(crate) fn draw(
    entries: &[Entry],
    (middle, top): (f64, f64),
    room: f64,
    (line, gap): (f64, f64),
    theme: &Theme,
) -> (Group, f64) {
    let mut group = Group::with_class("key");
    let mut height = 0.0;
    let lines = lines(entries, room, gap, theme);
    for key_line in lines {
        let extra = key_line.entries.iter().map(|e| e.extra_height(theme));
        let high = line * theme.sizes.key + extra.fold(0.0, f64::max);
        let mut at = PagePoint::new(middle - key_line.width / 2.0, top + height + high / 2.0);
        for entry in &key_line.entries {
            group.items.extend(entry.draw(at, theme));
            at = at.moved(entry.width + gap, 0.0);
        }
        height += high;
    }
    (group, height)
}
