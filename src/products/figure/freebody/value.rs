//! [`places`]: lists the coordinates of the points at which forces act, and the components of the unit normals.

use super::surroundings::{corners, distinct, inward};
use crate::mechanics::analysis::{Analysis, Contact};
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::symbol::{Accent, Symbol};
use crate::pictures::drawing::text::NO_BREAK;
use crate::pictures::drawing::{Face, Item, PagePoint, PageRect, Text, Theme, text};

/// Space between values in a row, pixels.
const VALUE_GAP: f64 = 26.0;

/// A part of a row: a symbol, a text or a gap.
#[derive(Clone)]
pub(super) enum Piece {
    Symbol(Symbol),
    Words(String),
    Gap,
}

impl Piece {
    fn width(&self, size: f64) -> f64 {
        match self {
            Piece::Symbol(symbol) => symbol.size(size).0,
            Piece::Words(words) => text::width(words, Face::Serif, size),
            Piece::Gap => VALUE_GAP,
        }
    }

    /// Draws a symbol or a text. `at` is the left end of its baseline, and `size` is the font size in pixels. Also
    /// returns its width in pixels.
    pub(super) fn draw(&self, at: PagePoint, size: f64, theme: &Theme) -> (Vec<Item>, f64) {
        let items = match self {
            Piece::Symbol(symbol) => {
                let (width, height) = symbol.size(size);
                let rect = PageRect { at: at.moved(0.0, -0.98 * size), width, height };
                vec![symbol.draw(rect, size, theme.ink).into()]
            }
            Piece::Words(words) => {
                vec![Text::new(at, words.as_str(), Face::Serif, size, theme.ink).into()]
            }
            Piece::Gap => Vec::new(),
        };
        (items, self.width(size))
    }

    /// Returns the symbol or text as plain text, for screen readers.
    pub(super) fn stated(&self) -> String {
        match self {
            Piece::Symbol(symbol) => symbol.stated(),
            Piece::Words(words) => words.replace(NO_BREAK, " "),
            Piece::Gap => " ".to_owned(),
        }
    }
}

/// Returns the width of a row of symbols and texts, in pixels. `size` is the font size in pixels.
pub(super) fn width(row: &[Piece], size: f64) -> f64 {
    row.iter().map(|p| p.width(size)).sum()
}

/// Distributes values over rows of at most `room` pixels. `size` is the font size in pixels.
pub(super) fn rows(values: &[Vec<Piece>], size: f64, room: f64) -> Vec<Vec<Piece>> {
    let mut rows: Vec<Vec<Piece>> = Vec::new();
    for value in values {
        match rows.last_mut() {
            Some(row) if width(row, size) + VALUE_GAP + width(value, size) <= room => {
                row.push(Piece::Gap);
                row.extend(value.iter().cloned());
            }
            _ => rows.push(value.clone()),
        }
    }
    rows
}

/// Returns the coordinates of the centroid and of the application points, and the components of the unit normals into
/// the block. Each value is a list of symbols and texts, such as `c = (1; 2) m`.
pub(super) fn places(analysis: &Analysis, block: BlockId, contacts: &[&Contact]) -> Vec<Vec<Piece>> {
    let is = |symbol: Symbol, words: String| {
        vec![Piece::Symbol(symbol), Piece::Words(format!("{NO_BREAK}={NO_BREAK}{words}"))]
    };
    let unit = analysis.scene.units.length();
    let at = |x: f64, y: f64| {
        let [x, y] = [x, y].map(|v| coordinate(unit.value_from_si(v)));
        format!("({x}; {y}){NO_BREAK}{}", unit.symbol())
    };
    let c = analysis.scene.blocks[block.0].centroid;
    let mut places = vec![is(Symbol::new("c", Accent::None, ""), at(c.x, c.y))];
    for contact in contacts {
        let count = distinct(contact).len();
        for (k, corner) in corners(contact, block).iter().enumerate().take(count) {
            let symbol = Symbol::new("p", Accent::None, &(k + 1).to_string());
            places.push(is(symbol, at(corner.at.x, corner.at.y)));
        }
        let s = inward(contact, block);
        let words = format!("({}; {})", coordinate(s.x), coordinate(s.y));
        places.push(is(Symbol::new("s", Accent::Hat, ""), words));
    }
    places
}

/// Formats a coordinate with at most three decimals, without trailing zeros.
fn coordinate(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" | "" => "0".to_owned(),
        text => text.replace('-', "−"),
    }
}
