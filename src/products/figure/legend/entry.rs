//! [`Entry`]: an entry of the legend, which consists of a symbol and a text.

use super::symbol::{self, LINE_LENGTH, ON_BLOCK, SYMBOL_GAP, written};
use crate::pictures::drawing::{Colour, Face, Item, PagePoint, Theme, text};

const COLOURS_TEXT: &str = "the forces on a block share a colour";
const PLANNED_TEXT: &str = "planned block";
const MISSING_TEXT: &str = "missing force, without which it falls";
/// The text for missing forces in a column of print.
const SHORT_MISSING_TEXT: &str = "missing force";
/// Least length of a bar of colours, pixels.
const SHORTEST_BAR: f64 = 56.0;

/// The text of the legend entry for missing forces.
#[derive(Clone, Copy)]
pub(crate) enum MissingWords {
    /// What a missing force is.
    Usual,
    /// Only its name, for a column of print.
    Short,
}

/// An entry of the legend.
pub(crate) enum Entry {
    /// Arrow colours, each with the name of its block.
    Blocks(Vec<(Colour, String)>),
    /// Only the arrow colours, without the names of blocks, and whether they are drawn close together.
    Colours(Vec<Colour>, bool),
    /// The disc of a robot: its colour and its name.
    Robot(Colour, String),
    /// The outline of a planned block.
    Planned(Colour),
    /// Missing forces.
    Missing(MissingWords),
    /// A bar of amplitude colours: the labels of its ends, the name of the quantity, the function that converts a
    /// position on the colour scale (0 to 1) to a colour, and the length of the bar in pixels.
    Amplitudes([String; 2], String, fn(&Theme, f64) -> Colour, f64),
    /// The scale of arrows: the length of an arrow from tail to tip and the width of its shaft in pixels, and its
    /// force.
    Scale(f64, f64, String),
    /// A line: its colour, its width in pixels, and its meaning.
    Line(Colour, f64, String),
    /// A scale bar: its length in pixels, and the length that it shows.
    Metres(f64, String),
    /// A note, such as on labels that are left out.
    Note(String),
    /// A symbol: the function that draws it, its width in pixels, and its meaning. The function gets the middle of the
    /// left edge.
    Symbol(fn(PagePoint, &Theme) -> Vec<Item>, f64, String),
}

impl Entry {
    /// Returns the entry in a form that fits into `room` pixels, if possible. `column` is true on a page as narrow as a
    /// column of print, where some entries are always shorter. If the names of blocks do not fit, the result shows only
    /// the colours of their arrows. A bar of colours is shortened so that its text needs one line, unless the bar would
    /// be shorter than [`SHORTEST_BAR`].
    pub(crate) fn fitted(self, room: f64, column: bool, theme: &Theme) -> Entry {
        let over = self.width(theme) - room;
        match self {
            Entry::Blocks(_) if over > 0.0 => Entry::Colours(theme.arrows.clone(), column),
            Entry::Colours(colours, _) => Entry::Colours(colours, column),
            Entry::Missing(MissingWords::Usual) if column => Entry::Missing(MissingWords::Short),
            Entry::Amplitudes(ends, what, ramp, bar) if over > 0.0 && bar - over > SHORTEST_BAR => {
                Entry::Amplitudes(ends, what, ramp, bar - over - 1.0)
            }
            entry => entry,
        }
    }

    /// True if a legend needs only one of the two entries. Two entries for missing forces, for planned blocks, or for
    /// arrow colours without names always count as the same. Two other entries must be of the same kind and have the
    /// same text. For some kinds, the symbols must be the same too, such as the colours of two robots.
    pub(super) fn same(&self, other: &Entry) -> bool {
        match (self, other) {
            (Entry::Blocks(a), Entry::Blocks(b)) => a == b,
            (Entry::Colours(..), Entry::Colours(..))
            | (Entry::Planned(_), Entry::Planned(_))
            | (Entry::Missing(_), Entry::Missing(_)) => true,
            (Entry::Robot(a, name), Entry::Robot(b, other)) => (a, name) == (b, other),
            (Entry::Amplitudes(a, what, ..), Entry::Amplitudes(b, other, ..)) => (a, what) == (b, other),
            (Entry::Line(_, a, what), Entry::Line(_, b, other)) => (a, what) == (b, other),
            (Entry::Scale(a, _, what), Entry::Scale(b, _, other)) => (a, what) == (b, other),
            (Entry::Metres(a, what), Entry::Metres(b, other)) => (a, what) == (b, other),
            (Entry::Note(a), Entry::Note(b)) | (Entry::Symbol(_, _, a), Entry::Symbol(_, _, b)) => a == b,
            _ => false,
        }
    }

    /// Returns the width of the symbol to the left of the text, including the gap between symbol and text, in pixels.
    pub(super) fn symbol_width(&self, theme: &Theme) -> f64 {
        let wide = |words: &str| text::width(words, Face::Sans, theme.sizes.key);
        match self {
            Entry::Blocks(blocks) => {
                blocks.iter().map(|b| 8.0 + 22.0 + 5.0 + wide(&b.1)).fold(wide(ON_BLOCK), |sum, block| sum + block)
            }
            Entry::Colours(colours, short) => symbol::colour_pitch(*short) * colours.len() as f64,
            Entry::Robot(..) | Entry::Planned(_) => 2.0 * SYMBOL_GAP + 7.0,
            Entry::Missing(_) => 34.0 + 7.0,
            Entry::Amplitudes([low, high], _, _, bar) => wide(low) + 7.0 + bar + 7.0 + wide(high) + 8.0,
            Entry::Scale(length, ..) | Entry::Metres(length, _) => length + 7.0,
            Entry::Line(..) => LINE_LENGTH + 7.0,
            Entry::Note(_) => 0.0,
            Entry::Symbol(_, width, _) => width + 7.0,
        }
    }

    /// Returns the text to the right of the symbol.
    pub(super) fn words(&self) -> String {
        match self {
            Entry::Blocks(_) => String::new(),
            Entry::Colours(..) => COLOURS_TEXT.to_owned(),
            Entry::Robot(_, id) => robot(id),
            Entry::Planned(_) => PLANNED_TEXT.to_owned(),
            Entry::Missing(MissingWords::Usual) => MISSING_TEXT.to_owned(),
            Entry::Missing(MissingWords::Short) => SHORT_MISSING_TEXT.to_owned(),
            Entry::Amplitudes(_, words, ..)
            | Entry::Scale(_, _, words)
            | Entry::Line(_, _, words)
            | Entry::Metres(_, words)
            | Entry::Note(words)
            | Entry::Symbol(_, _, words) => words.clone(),
        }
    }

    /// Returns the width of the entry, pixels, if its text is written in one line.
    pub(super) fn width(&self, theme: &Theme) -> f64 {
        let words = text::width(&self.words(), Face::Sans, theme.sizes.key);
        self.symbol_width(theme) + words
    }

    /// Draws the entry in one line: its symbol and its text. `at` is the middle of its left edge on the page.
    pub(super) fn draw(&self, at: PagePoint, theme: &Theme) -> Vec<Item> {
        let mut items = self.symbol(at, theme);
        let words = self.words();
        if !words.is_empty() {
            items.push(written(&words, at.moved(self.symbol_width(theme), 0.0), theme));
        }
        items
    }

    /// Draws the symbol of the entry. `at` is the middle of the left edge of the symbol on the page.
    pub(super) fn symbol(&self, at: PagePoint, theme: &Theme) -> Vec<Item> {
        match self {
            Entry::Blocks(blocks) => symbol::blocks(blocks, at, theme),
            Entry::Colours(colours, short) => symbol::colours(colours, *short, at),
            Entry::Robot(colour, _) => vec![symbol::robot(*colour, at, theme)],
            Entry::Planned(colour) => vec![symbol::planned(*colour, at)],
            Entry::Missing(_) => vec![symbol::arrow(at, (34.0, 4.0), theme.failure)],
            Entry::Amplitudes(ends, _, ramp, bar) => symbol::amplitudes(ends, (*ramp, *bar), at, theme),
            Entry::Line(colour, width, _) => vec![symbol::line(*colour, *width, at)],
            Entry::Metres(length, _) => vec![symbol::metres(*length, at, theme)],
            Entry::Note(_) => Vec::new(),
            Entry::Symbol(symbol, ..) => symbol(at, theme),
            Entry::Scale(length, width, _) => {
                vec![symbol::arrow(at, (*length, *width), theme.faint)]
            }
        }
    }
}

/// Returns the text for a robot in the legend: `robot` followed by its name, or only its name if this begins with
/// `robot`.
fn robot(id: &str) -> String {
    if id.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("robot")) {
        id.to_owned()
    } else {
        format!("robot {id}")
    }
}
