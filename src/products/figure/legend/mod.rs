//! The legend of a figure: explains the colours and symbols that occur in it.

mod content;
mod entry;
mod lines;
mod symbol;

pub(crate) use content::{entries, loads, metres, robots, scale, shared_scale};
pub(crate) use entry::Entry;
pub(crate) use lines::draw;

use crate::pictures::drawing::{Item, PagePoint, Theme};

/// Height of a line of the legend, as a multiple of its font size.
pub(crate) const LINE_HEIGHT: f64 = 2.08;
/// Height of a line of the legend on a page as wide as a column of print, as a multiple of its font size.
pub(crate) const NARROW_LINE_HEIGHT: f64 = 1.5;
/// Gap between the entries of a line of the legend, pixels.
pub(crate) const ENTRY_GAP: f64 = 28.0;
/// Gap between the entries of a line on a page as wide as a column of print, pixels.
pub(crate) const NARROW_ENTRY_GAP: f64 = 16.0;

/// Joins several legends into one without duplicate entries. If the legends have different entries for the colours of
/// arrows, the result shows all arrow colours of the theme without the names of blocks.
pub(crate) fn joined(keys: Vec<Vec<Entry>>, theme: &Theme) -> Vec<Entry> {
    let mut all: Vec<Entry> = Vec::new();
    for entry in keys.into_iter().flatten() {
        if all.iter().any(|known| known.same(&entry)) {
            continue;
        }
        let blocks = |e: &Entry| matches!(e, Entry::Blocks(_) | Entry::Colours(..));
        match all.iter_mut().find(|known| blocks(known) && blocks(&entry)) {
            Some(known) => *known = Entry::Colours(theme.arrows.clone(), false),
            None => all.push(entry),
        }
    }
    all
}

/// Draws a single legend entry in one line. `at` is the middle of its left edge on the page.
pub(crate) fn single(entry: &Entry, at: PagePoint, theme: &Theme) -> Vec<Item> {
    entry.draw(at, theme)
}

/// Returns the width of the widest of these legend entries, in pixels.
pub(crate) fn widest(entries: &[Entry], theme: &Theme) -> f64 {
    let widths = entries.iter().map(|entry| entry.width(theme));
    widths.fold(0.0, f64::max)
}
