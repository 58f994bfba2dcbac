//! Draws the symbols of the legend. In each function, `at` is the middle of the left edge of the symbol on the page.

use crate::pictures::drawing::arrow::straight;
use crate::pictures::drawing::{Colour, Face, Item, Outline, PagePoint, PageRect, Path, Stroke, Text, Theme, text};
use crate::products::figure::pen::{CENTROID_RADIUS, DOT_RADIUS};

/// Length of a sample arrow, pixels.
pub(super) const SAMPLE_LENGTH: f64 = 26.0;
/// Distance of the centre of a disc or hexagon from the left end of the symbol, pixels.
pub(super) const SYMBOL_GAP: f64 = 9.0;
/// Length of a line in the legend, pixels.
pub(super) const LINE_LENGTH: f64 = 26.0;
/// Usual length of a bar of colours, pixels.
pub(crate) const BAR_LENGTH: f64 = 120.0;
/// The text before the arrows that show, for each block, the colour of the forces on this block.
pub(super) const ON_BLOCK: &str = "force on block";
/// Length and width of the shaft of an arrow in one of the colours of blocks, pixels.
const COLOUR_ARROW: (f64, f64) = (22.0, 2.6);
/// Gap between two of the arrows of [`colours`], pixels.
const COLOUR_GAP: f64 = 8.0;

/// Returns a text of the legend as a drawing item. `at` is the left end of the text, at half the height of its line.
pub(super) fn written(words: &str, at: PagePoint, theme: &Theme) -> Item {
    let size = theme.sizes.key;
    let at = at.moved(0.0, 0.36 * size);
    Text::new(at, words, Face::Sans, size, theme.faint).into()
}

/// Draws an arrow from `at` to the right. `size` is its length and the width of its shaft, pixels.
pub(super) fn arrow(at: PagePoint, size: (f64, f64), colour: Colour) -> Item {
    Path::filled(straight(at, (size.0, 0.0), size.1), colour).into()
}

/// Draws one arrow for each block in the colour of the forces on this block, followed by the name of the block.
pub(super) fn blocks(blocks: &[(Colour, String)], at: PagePoint, theme: &Theme) -> Vec<Item> {
    let wide = |words: &str| text::width(words, Face::Sans, theme.sizes.key);
    let mut items = vec![written(ON_BLOCK, at, theme)];
    let mut x = wide(ON_BLOCK);
    for (colour, id) in blocks {
        x += 8.0;
        items.push(arrow(at.moved(x, 0.0), COLOUR_ARROW, *colour));
        x += COLOUR_ARROW.0 + 5.0;
        items.push(written(id, at.moved(x, 0.0), theme));
        x += wide(id);
    }
    items
}

/// Draws one arrow in each of the colours that forces on blocks can have. If `short` is true, the arrows are shorter,
/// for a page as narrow as a column of print.
pub(super) fn colours(colours: &[Colour], short: bool, at: PagePoint) -> Vec<Item> {
    let (pitch, colours) = (colour_pitch(short), colours.iter().enumerate());
    let size = (pitch - COLOUR_GAP, COLOUR_ARROW.1);
    let arrows = colours.map(|(i, colour)| arrow(at.moved(pitch * i as f64, 0.0), size, *colour));
    arrows.collect()
}

/// Returns the distance between the tails of two arrows of [`colours`], pixels.
pub(super) fn colour_pitch(short: bool) -> f64 {
    if short { 22.0 } else { 30.0 }
}

/// Draws the disc that marks the grip of a robot.
pub(super) fn robot(colour: Colour, at: PagePoint, theme: &Theme) -> Item {
    let disc = Outline::circle(at.moved(SYMBOL_GAP, 0.0), 0.8 * SYMBOL_GAP);
    let edge = Stroke::new(colour.mixed(theme.ink, 0.35), 0.8);
    Path::filled(disc, colour).with_stroke(edge).into()
}

/// Draws the symbol of a planned block: the outline of a hexagon.
pub(super) fn planned(colour: Colour, at: PagePoint) -> Item {
    let hexagon = [(-1.0, 0.0), (-0.5, -0.87), (0.5, -0.87), (1.0, 0.0), (0.5, 0.87), (-0.5, 0.87)];
    let corner = |(x, y): (f64, f64)| at.moved(SYMBOL_GAP + 0.85 * SYMBOL_GAP * x, 0.85 * SYMBOL_GAP * y);
    let outline = Outline::ring(hexagon.map(corner));
    Path::stroked(outline, Stroke::new(colour, 1.8)).into()
}

/// Draws a bar with all colours of a colour scale. `low` and `high` are the texts at its left and right end. `ramp`
/// converts a position on the scale (0 to 1) to a colour. `bar` is the length of the bar in pixels.
pub(super) fn amplitudes(
    [low, high]: &[String; 2],
    (ramp, bar): (fn(&Theme, f64) -> Colour, f64),
    at: PagePoint,
    theme: &Theme,
) -> Vec<Item> {
    let start = text::width(low, Face::Sans, theme.sizes.key) + 7.0;
    let mut items = vec![written(low, at, theme)];
    let parts = 64;
    for part in 0..parts {
        // Each part extends to the right end of the bar, and the next part covers most of it. So there are no gaps
        // between the parts.
        let x = bar * f64::from(part) / f64::from(parts);
        let rect = PageRect { at: at.moved(start + x, -5.0), width: bar - x, height: 10.0 };
        let fill = ramp(theme, (f64::from(part) + 0.5) / f64::from(parts));
        items.push(Path::filled(Outline::rounded(rect, 0.0), fill).into());
    }
    let end = at.moved(start + bar + 7.0, 0.0);
    items.push(written(high, end, theme));
    items
}

/// Draws a short horizontal line of this width (pixels).
pub(super) fn line(colour: Colour, width: f64, at: PagePoint) -> Item {
    let line = Outline::line([at, at.moved(LINE_LENGTH, 0.0)]);
    Path::stroked(line, Stroke::new(colour, width).mitred()).into()
}

/// Draws a scale bar of this length (pixels).
pub(super) fn metres(length: f64, at: PagePoint, theme: &Theme) -> Item {
    let mut bar = Outline::line([at, at.moved(length, 0.0)]);
    for x in [0.0, length] {
        bar.extend(Outline::line([at.moved(x, -4.0), at.moved(x, 4.0)]));
    }
    Path::stroked(bar, Stroke::new(theme.faint, 1.4)).into()
}

pub(super) fn weight_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let (colour, from) = (theme.arrow(1), at.moved(4.0, 0.0));
    let arrow = straight(from, (SAMPLE_LENGTH - 4.0, 0.0), 2.6);
    let ring = Outline::circle(from, CENTROID_RADIUS * 2.6);
    vec![
        Path::filled(arrow, colour).into(),
        Path::filled(ring, theme.page).with_stroke(Stroke::new(colour, 1.2)).into(),
    ]
}

pub(super) fn load_symbol(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let arrow = straight(at, (SAMPLE_LENGTH, 0.0), 3.4);
    vec![Path::filled(arrow, theme.page).with_stroke(Stroke::new(theme.load, 1.2)).into()]
}

pub(super) fn missing_dot(at: PagePoint, theme: &Theme) -> Vec<Item> {
    let dot = Outline::circle(at.moved(DOT_RADIUS, 0.0), DOT_RADIUS);
    vec![Path::filled(dot, theme.failure).into()]
}
