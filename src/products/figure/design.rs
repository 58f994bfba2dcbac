//! What a picture is made of: sizes ([`Look`], [`unit()`]), layers, marks and their keys, and arrows.

use std::rc::Rc;

use super::option::Options;
use crate::geometry::{Bounds, Vector};
use crate::mechanics::scene::{Block, BlockId, Rgb, Scene};
use crate::pictures::drawing::{Colour, Outline, PagePoint, PageRect, Path, Stroke, Theme};
use crate::pictures::output::page_width;

/// The size of small text on paper, mm: 6.6 pt.
const PRINTED_TEXT: f64 = 6.6 * 25.4 / 72.0;
/// The size of the same text in the themes, pixels. It is the size on a screen, where no width of the page is given.
const SCREEN_TEXT: f64 = 12.5;
/// The margin around pages of symbols and of shapes, pixels.
pub(crate) const SCREEN_MARGIN: f64 = 36.0;

/// The sizes in which a figure is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look {
    /// Pixels of a millimetre of the design.
    pub pixels: f64,
    /// Factor on the font sizes of the theme.
    pub text: f64,
    /// Whether the blocks are so large that marks are larger, and weights are drawn.
    pub large: bool,
    /// Whether the figure has several panels.
    pub is_strip: bool,
    /// Whether the blocks are large enough for their names.
    pub names: bool,
    /// The width of a panel, pixels. Labels beside it would lie in the next panel or be cut.
    pub panel: f64,
}

impl Look {
    /// Returns the sizes for the screen, or for paper if the options set the width of the page.
    pub fn new(options: &Options, is_strip: bool) -> Look {
        let printed = page_width(1.0);
        let text = if options.width.is_some() { PRINTED_TEXT * printed / SCREEN_TEXT } else { 1.0 };
        let pixels = SCREEN_TEXT * text / PRINTED_TEXT;
        Look { pixels, text, large: false, is_strip, names: false, panel: f64::INFINITY }
    }

    /// Converts millimetres of the design to pixels.
    pub fn mm(&self, length: f64) -> f64 {
        length * self.pixels
    }
}

/// The layers of a picture, the lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Layer {
    Ground,
    /// Stones. Labels avoid their edges and their inside.
    Stone,
    /// Marks of the forces inside the structure.
    Force,
    /// Weights, robots and hinges.
    Symbol,
    Load,
    Missing,
    /// Dimension lines around the picture.
    Around,
}

impl Layer {
    pub const ALL: [(Layer, &'static str); 7] = [
        (Layer::Ground, "ground"),
        (Layer::Stone, "blocks"),
        (Layer::Force, "forces"),
        (Layer::Symbol, "symbols"),
        (Layer::Load, "loads"),
        (Layer::Missing, "failures"),
        (Layer::Around, "around"),
    ];
}

/// An entry of the legend: a symbol and its meaning.
#[derive(Clone, Debug)]
pub(crate) struct Key {
    /// Entries are printed in this order. Entries of several panels with the same rank are the same entry.
    pub rank: u8,
    /// The meaning of the symbol.
    pub words: String,
    /// The symbol, which begins at (0, 0) and is centred on the horizontal axis; empty for a note.
    pub symbol: Vec<Path>,
    /// The width of the symbol, pixels.
    pub width: f64,
    /// Numbers below the symbol, each with its place along it, pixels.
    pub ticks: Vec<(f64, &'static str)>,
}

impl Key {
    pub fn new(rank: u8, words: impl Into<String>, symbol: Vec<Path>, width: f64) -> Rc<Key> {
        Rc::new(Key { rank, words: words.into(), symbol, width, ticks: Vec::new() })
    }

    /// The entry for a line, of which it shows a piece of this length, pixels.
    pub fn line(rank: u8, words: impl Into<String>, length: f64, stroke: Stroke) -> Rc<Key> {
        Key::new(rank, words, vec![Path::stroked(Key::piece(length), stroke)], length)
    }

    /// The entry for blocks: `drawn` draws a small one.
    pub fn block(rank: u8, words: &str, look: Look, drawn: impl FnOnce(Outline) -> Vec<Path>) -> Rc<Key> {
        let (wide, half) = (look.mm(3.6), look.mm(1.1));
        let corners = [(0.0, -half), (wide, -half), (wide, half), (0.0, half)];
        Key::new(rank, words, drawn(Outline::ring(corners.map(|(x, y)| PagePoint::new(x, y)))), wide)
    }

    /// Returns the line from (0, 0) to the right.
    pub fn piece(length: f64) -> Outline {
        Outline::line([0.0, length].map(|x| PagePoint::new(x, 0.0)))
    }
}

/// Shapes that belong together and have one meaning.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    pub layer: Layer,
    /// The class of its group, such as `force`.
    pub class: &'static str,
    /// The text on mouse hover; empty for none.
    pub title: String,
    /// A longer text for screen readers; may be empty.
    pub description: String,
    pub shapes: Vec<Path>,
    /// The entry of the legend that explains the mark.
    pub key: Option<Rc<Key>>,
    /// The clear space that labels leave around the mark, mm; `None` if labels may lie on it.
    pub avoid: Option<f64>,
}

impl Mark {
    pub fn new(layer: Layer, class: &'static str, shapes: Vec<Path>) -> Mark {
        Mark { layer, class, title: String::new(), description: String::new(), shapes, key: None, avoid: None }
    }

    pub fn titled(self, title: impl Into<String>) -> Mark {
        Mark { title: title.into(), ..self }
    }

    pub fn keyed(self, key: &Rc<Key>) -> Mark {
        Mark { key: Some(Rc::clone(key)), ..self }
    }

    /// Labels leave this much clear space around the mark, mm.
    pub fn avoided(self, clear: f64) -> Mark {
        Mark { avoid: Some(clear), ..self }
    }
}

/// Converts a colour of a scene file to a colour of a drawing.
pub(crate) fn colour(rgb: Rgb) -> Colour {
    Colour(rgb.0)
}

/// Returns the smallest rectangle around the points; `None` if there are none.
pub(crate) fn around(points: impl IntoIterator<Item = PagePoint>) -> Option<PageRect> {
    let mut ends: Option<[f64; 4]> = None;
    for p in points {
        let [left, top, right, bottom] = ends.unwrap_or([p.x, p.y, p.x, p.y]);
        ends = Some([left.min(p.x), top.min(p.y), right.max(p.x), bottom.max(p.y)]);
    }
    let [left, top, right, bottom] = ends?;
    Some(PageRect { at: PagePoint::new(left, top), width: right - left, height: bottom - top })
}

/// True if two rectangles overlap, or are less than `by` pixels apart.
pub(crate) fn overlaps(a: PageRect, b: PageRect, by: f64) -> bool {
    a.at.x < b.at.x + b.width + by
        && b.at.x - by < a.at.x + a.width
        && a.at.y < b.at.y + b.height + by
        && b.at.y - by < a.at.y + a.height
}

/// Returns the direction of a force on the page, where y points down, as a unit vector.
pub(crate) fn direction(force: Vector) -> (f64, f64) {
    let norm = force.norm();
    (force.x / norm, -force.y / norm)
}

/// Returns the point `forward` pixels along the unit vector `u` from `p`, and `aside` pixels to the right of it on the
/// page.
pub(crate) fn along(p: PagePoint, u: (f64, f64), forward: f64, aside: f64) -> PagePoint {
    p.moved(u.0 * forward - u.1 * aside, u.1 * forward + u.0 * aside)
}

/// The sizes of an arrow, pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArrowSize {
    pub length: f64,
    /// Width of the shaft.
    pub shaft: f64,
    /// Width and length of the head.
    pub head: (f64, f64),
}

impl ArrowSize {
    /// Returns the corners of an arrow that begins at `p` and points along the unit vector `u`.
    pub fn corners(self, p: PagePoint, u: (f64, f64)) -> [PagePoint; 7] {
        let (neck, half, head) = (self.length - self.head.1, self.shaft / 2.0, self.head.0 / 2.0);
        [(0.0, -half), (neck, -half), (neck, -head), (self.length, 0.0), (neck, head), (neck, half), (0.0, half)]
            .map(|(forward, aside)| along(p, u, forward, aside))
    }

    /// Returns the outline of the arrow.
    pub fn outline(self, p: PagePoint, u: (f64, f64)) -> Outline {
        Outline::ring(self.corners(p, u))
    }

    /// Returns the outline of a mark with two heads. `self` is each of its halves, which begin at `p`.
    pub fn two_headed(self, p: PagePoint, u: (f64, f64)) -> Outline {
        let [front, back] = [u, (-u.0, -u.1)].map(|u| self.corners(p, u));
        Outline::ring(front[1..6].iter().chain(&back[1..6]).copied())
    }
}

/// Returns the colour of the edges of displaced blocks.
pub(crate) fn moved_edge(theme: &Theme) -> Colour {
    theme.motion.mixed(theme.ink, 0.25)
}

/// Blocks differ much in size if √(mean area) is more than this multiple of √area of the median block.
const UNEVEN_RATIO: f64 = 3.0;

/// Returns the unit length in metres: 0.6·√A, about the edge of a regular hexagon of area A. On a lattice, it is the
/// side of a cell, unless 0.6·√A is at least 1.5 times this side. A is the median area of the blocks, or the mean area
/// if its root is more than [`UNEVEN_RATIO`] times the root of the median area. In a picture zoomed to a block, A is
/// the area of the smallest block in the zoomed view.
pub(crate) fn unit(scene: &Scene, zoom: Option<BlockId>) -> f64 {
    let near = zoom.map(|block| zoomed_view(scene, block));
    let shown = |b: &&Block| near.is_none_or(|near| near.intersects(b.body.polygon.bounds()));
    let mut sizes: Vec<f64> = scene.blocks.iter().filter(shown).map(|b| b.body.polygon.area().sqrt()).collect();
    sizes.sort_by(f64::total_cmp);
    let squares: f64 = sizes.iter().map(|s| s * s).sum();
    let mean = libm::sqrt(squares / sizes.len().max(1) as f64);
    // A zoomed picture uses its smallest block, because small blocks must be visible next to large neighbours.
    let middle = if zoom.is_some() { 0 } else { sizes.len() / 2 };
    let middle = sizes.get(middle).copied().unwrap_or(1.0);
    // If there are small blocks next to a very large block, arrows as long as a small block would be nearly invisible.
    let uneven = zoom.is_none() && mean > UNEVEN_RATIO * middle;
    let typical = 0.6 * if uneven { mean } else { middle };
    match scene.lattice {
        Some(lattice) if typical < 1.5 * lattice.side => lattice.side,
        _ => typical,
    }
}

/// Distance from a block to the edge of its zoomed view, as a fraction of the block's larger side.
const ZOOM_PADDING: f64 = 0.5;

/// Returns a box around a block, in metres: the bounding box of the block, enlarged on all sides by half of its longer
/// side.
pub(crate) fn zoomed_view(scene: &Scene, block: BlockId) -> Bounds {
    let bounds = scene.blocks[block.0].body.polygon.bounds();
    bounds.grown(ZOOM_PADDING * bounds.width().max(bounds.height()))
}
