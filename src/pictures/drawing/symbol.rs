//! [`Symbol`]: a mathematical symbol of one or more letters. A letter can have an arrow or a hat, a subscript and a
//! superscript.

use super::arrow::HEAD_WIDTH;
use super::{Colour, Face, Group, Outline, PagePoint, PageRect, Path, Stroke, Text, text};

/// Font size of subscripts and superscripts, as a multiple of the symbol's font size.
const SCRIPT_SCALE: f64 = 0.68;
/// Distance of the baseline of a subscript below the baseline of its letter, as a multiple of the font size.
const SUBSCRIPT_DROP: f64 = 0.24;
/// Distance of the baseline of a superscript above the baseline of its letter, as a multiple of the font size.
const SUPERSCRIPT_RISE: f64 = 0.42;
/// Horizontal distance of a superscript from its letter, as a multiple of the font size. It leaves space for an arrow.
const SUPERSCRIPT_GAP: f64 = 0.2;
/// Height of a symbol above and below its baseline, as multiples of the font size.
const ASCENT_AND_DESCENT: (f64, f64) = (0.98, 0.42);

/// The sign above a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Accent {
    /// Nothing.
    None,
    /// An arrow: a vector.
    Arrow,
    /// A hat: a unit vector.
    Hat,
}

/// A letter of a symbol with its accent, subscript and superscript.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Letter {
    /// The letter, set in italics.
    pub letter: String,
    /// The sign above it.
    pub accent: Accent,
    /// The subscript; letters are italic, digits upright.
    pub below: String,
    /// The superscript.
    pub above: String,
}

/// A mathematical symbol.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its letters in order.
    pub letters: Vec<Letter>,
}

impl Symbol {
    /// Creates a symbol that consists of one letter with the subscript `below`. Letter and subscript may be empty.
    pub fn new(letter: &str, accent: Accent, below: &str) -> Symbol {
        let letter = Letter { letter: letter.to_owned(), accent, below: below.to_owned(), above: String::new() };
        Symbol { letters: vec![letter] }
    }

    /// Returns this symbol with `above` as the superscript of its last letter.
    pub fn raised(mut self, above: &str) -> Symbol {
        if let Some(last) = self.letters.last_mut() {
            above.clone_into(&mut last.above);
        }
        self
    }

    /// Appends the letters of `next` to the letters of this symbol.
    pub fn then(mut self, next: Symbol) -> Symbol {
        self.letters.extend(next.letters);
        self
    }

    /// Returns the symbol as plain text, such as `F_s1^(2)`.
    pub fn stated(&self) -> String {
        let one = |l: &Letter| {
            let mark = |sign: &str, words: &str| match words {
                "" => String::new(),
                words => format!("{sign}{words}"),
            };
            format!("{}{}{}", l.letter, mark("_", &l.below), mark("^", &l.above))
        };
        self.letters.iter().map(one).collect()
    }

    /// Returns the width and height of the symbol in pixels. `size` is the font size in pixels.
    pub fn size(&self, size: f64) -> (f64, f64) {
        let width = self.letters.iter().map(|l| wide(l, size)).sum();
        (width, (ASCENT_AND_DESCENT.0 + ASCENT_AND_DESCENT.1) * size)
    }

    /// Draws the symbol in the upper left corner of `rect`. `size` is the font size in pixels.
    pub fn draw(&self, rect: PageRect, size: f64, ink: Colour) -> Group {
        let mut group = Group::with_class("symbol");
        let mut at = rect.at.moved(0.0, ASCENT_AND_DESCENT.0 * size);
        for letter in &self.letters {
            group = group.with(Text::new(at, letter.letter.as_str(), Face::SerifItalic, size, ink));
            group.items.extend(accent(letter, at, size, ink).map(Into::into));
            let beside = at.moved(text::width(&letter.letter, Face::SerifItalic, size), 0.0);
            for (words, lean, down) in
                [(&letter.below, 0.04, SUBSCRIPT_DROP), (&letter.above, SUPERSCRIPT_GAP, -SUPERSCRIPT_RISE)]
            {
                let mut at = beside.moved(lean * size, down * size);
                for (run, face) in runs(words) {
                    group = group.with(Text::new(at, run.as_str(), face, SCRIPT_SCALE * size, ink));
                    at = at.moved(text::width(&run, face, SCRIPT_SCALE * size), 0.0);
                }
            }
            at = at.moved(wide(letter, size), 0.0);
        }
        group
    }
}

fn wide(letter: &Letter, size: f64) -> f64 {
    let small = |words: &str| -> f64 {
        let width = |(run, face): &(String, Face)| text::width(run, *face, SCRIPT_SCALE * size);
        runs(words).iter().map(width).sum()
    };
    let below = match small(&letter.below) {
        wide if wide > 0.0 => wide + 0.06 * size,
        _ => 0.0,
    };
    let above = match small(&letter.above) {
        wide if wide > 0.0 => wide + (SUPERSCRIPT_GAP + 0.02) * size,
        _ => 0.0,
    };
    text::width(&letter.letter, Face::SerifItalic, size) + below.max(above)
}

/// Splits a text into parts that are set in one face each. Letters are italic, all other characters are upright.
fn runs(words: &str) -> Vec<(String, Face)> {
    let mut runs: Vec<(String, Face)> = Vec::new();
    for c in words.chars() {
        let face = if c.is_alphabetic() { Face::SerifItalic } else { Face::Serif };
        match runs.last_mut() {
            Some((run, last)) if *last == face => run.push(c),
            _ => runs.push((c.to_string(), face)),
        }
    }
    runs
}

/// Returns the arrow or hat above a letter, or `None` if the letter has no accent. The left end of the letter's
/// baseline lies at `at`. `size` is the font size in pixels.
fn accent(letter: &Letter, at: PagePoint, size: f64, ink: Colour) -> Option<Path> {
    let tall = letter.letter.chars().any(|c| c.is_uppercase() || "bdfhklt".contains(c));
    let high = if tall { 0.76 } else { 0.58 } * size;
    let wide = text::width(&letter.letter, Face::SerifItalic, size);
    let stroke = Stroke::new(ink, 0.045 * size);
    // Italic letters are slanted to the right, so the accent is moved to the right of their middle.
    let middle = at.moved(0.5 * wide + 0.09 * size, -high);
    match letter.accent {
        Accent::None => None,
        Accent::Arrow => {
            let half = (0.5 * wide).clamp(0.2 * size, 0.3 * size);
            let (tip, head) = (middle.moved(half, 0.0), 0.028 * HEAD_WIDTH * size);
            let mut outline = Outline::line([middle.moved(-half, 0.0), tip]);
            outline.extend(Outline::line([tip.moved(-head, -head), tip, tip.moved(-head, head)]));
            Some(Path::stroked(outline, stroke))
        }
        Accent::Hat => {
            let (half, high) = (0.15 * size, 0.12 * size);
            let hat = [middle.moved(-half, 0.0), middle.moved(0.0, -high), middle.moved(half, 0.0)];
            Some(Path::stroked(Outline::line(hat), stroke))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pictures::drawing::Item;

    #[test]
    fn a_subscript_widens_a_symbol_and_a_superscript_is_above_the_subscript() {
        let plain = Symbol::new("F", Accent::Arrow, "");
        let below = Symbol::new("F", Accent::Arrow, "fl1");
        let both = below.clone().raised("(2)");
        let wide = |s: &Symbol| s.size(20.0).0;
        assert!(wide(&below) > wide(&plain) + 10.0);
        assert!(wide(&both) < wide(&plain) + 2.0 * (wide(&below) - wide(&plain)));
        assert_eq!(both.stated(), "F_fl1^(2)");
        let weight = Symbol::new("m", Accent::None, "").then(Symbol::new("g", Accent::Arrow, ""));
        assert_eq!(weight.stated(), "mg");
    }

    #[test]
    fn all_ink_lies_in_the_rectangle() {
        let symbol = Symbol::new("F", Accent::Arrow, "fl1").raised("(2)");
        let (width, height) = symbol.size(20.0);
        let rect = PageRect { at: PagePoint::new(3.0, 7.0), width, height };
        for item in symbol.draw(rect, 20.0, Colour::BLACK).items {
            match item {
                Item::Text(text) => {
                    let wide = text::width(&text.words, text.face, text.size);
                    assert!(text.at.x >= 3.0 && text.at.x + wide <= 3.0 + width + 0.5);
                    assert!(text.at.y - 0.7 * text.size >= 6.9, "{text:?}");
                    assert!(text.at.y + 0.25 * text.size <= 7.1 + height, "{text:?}");
                }
                Item::Path(path) => {
                    assert!(path.outline.points().all(|p| p.y >= 7.0 && p.x >= 3.0));
                }
                Item::Group(_) => {}
            }
        }
    }
}
