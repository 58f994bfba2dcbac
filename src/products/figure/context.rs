//! [`FigureContext`]: the data that all panels of a figure share, such as the unit length, the view, the colours and
//! the arrows of each frame. The code in `content.rs` computes this data.

use core::cell::Cell;

use super::arrow::{ArrowKind, ForceArrow, MIN_VISIBLE_ARROW, Marks};
use super::displacement::Displacement;
use super::fill::{FillScale, Fills};
use super::option::Options;
use super::view;
use crate::geometry::{Bounds, Point, Vector};
use crate::mechanics::analysis::Analysis;

/// In frames with more blocks than this, shapes of one colour are drawn as one path without tooltips. Thousands of
/// elements would make a file slow to open.
pub(crate) const MANY_BLOCKS: usize = 1000;

/// If a unit length is shorter than this on the page, pixels (2.2 mm at 96 pixels per inch), arrows are too small to
/// read.
const MIN_UNIT_LENGTH: f64 = 8.4;
/// If every frame has fewer blocks than this, the figure always has arrows. A note counts the arrows that are too
/// short to be visible.
const MIN_CROWD: usize = 40;

/// If the fraction of visible arrows is smaller than this, the figure has no arrows, and only colours show the forces.
const MIN_VISIBLE_SHARE: f64 = 0.2;

/// The data that all panels of a figure share.
pub(crate) struct FigureContext<'a> {
    pub analysis: &'a Analysis,
    /// Whether the colour of a block shows the quantity that the option `fill` selects; otherwise blocks are plain.
    pub colours_show_amplitudes: bool,
    /// Whether lines are drawn across blocks. The letters of labels then have a border in the background colour.
    pub lines_cross_names: bool,
    pub options: &'a Options,
    /// The unit length (a typical size of a block), metres.
    pub unit: f64,
    /// For each frame, a box around everything that the frame shows, metres.
    pub shown: Vec<Bounds>,
    /// A box around all boxes of `shown`, metres.
    pub view: Bounds,
    pub fills: Fills,
    /// The arrows of each frame.
    pub marks: Vec<Marks>,
    /// For each frame, the displacements of the blocks, indexed by block. Empty if no block is displaced.
    pub displaced: Vec<Vec<Option<Displacement>>>,
    /// The text below the verdict of each frame.
    pub statements: Vec<String>,
    /// The sum of the penalties of badly placed labels so far. An amount, or a name that the text mentions, adds 100 if
    /// it has no free position. Another label adds 1 if it is left out, lies inside another block, or leaves its row.
    pub cramped: Cell<usize>,
}

impl<'a> FigureContext<'a> {
    /// Returns this context with more space around the content of each frame: `across` metres on the left and on the
    /// right, `up` metres above, and `down` metres below. No space is added below if ground is visible at the lower
    /// edge.
    pub fn with_room(mut self, across: f64, up: f64, down: f64) -> FigureContext<'a> {
        let down = match view::ground_shown(&self.analysis.scene, self.unit) {
            Some(ground) if ground.min.y <= self.view.min.y + self.unit => 0.0,
            _ => down,
        };
        let grown = |b: Bounds| Bounds { min: b.min - Vector::new(across, down), max: b.max + Vector::new(across, up) };
        self.shown.iter_mut().for_each(|b| *b = grown(*b));
        self.view = grown(self.view);
        self.cramped.set(0);
        self
    }

    /// True if arrows are too small to read at this scale (pixels per metre), so that only the colours of the blocks
    /// show the forces. False if every frame has fewer than 40 blocks, or in the style of the thesis. Also false if the
    /// colours of blocks show no quantity, or if the scene file gives the colour of every block.
    pub fn arrows_too_small(&self, scale: f64) -> bool {
        let has_plain_block = self.analysis.scene.blocks.iter().any(|b| b.body.fill.is_none());
        let frames = self.analysis.scene.frames.iter();
        let most = frames.map(|f| f.placed.len()).max().unwrap_or(0);
        most >= MIN_CROWD
            && (self.unit * scale < MIN_UNIT_LENGTH || self.few_arrows_visible(scale))
            && has_plain_block
            && !self.plain()
            && !self.options.printed()
    }

    /// True if fewer than 20 % of the arrows are long enough to be visible at this scale (pixels per metre). Arrows of
    /// loads and missing forces do not count. A figure with so few of its arrows would be misleading.
    fn few_arrows_visible(&self, scale: f64) -> bool {
        let arrows = || self.marks.iter().flat_map(|m| &m.arrows);
        let carried = |a: &&ForceArrow| !a.kind.is_failure() && a.kind != ArrowKind::Load;
        let seen = |a: &&ForceArrow| a.reach().norm() * scale >= MIN_VISIBLE_ARROW;
        let count = arrows().filter(carried).count();
        (arrows().filter(carried).filter(seen).count() as f64) < MIN_VISIBLE_SHARE * count as f64
    }

    /// True if the colours of blocks show no quantity.
    pub fn plain(&self) -> bool {
        !self.colours_show_amplitudes || self.fills.scale == FillScale::Plain
    }

    /// Returns the part of the scene, in metres, that the panels of one row show. Its width is the same for all rows,
    /// so that structures are aligned in columns. Its height is the height that the frames of this row need.
    pub fn row(&self, frames: &[usize]) -> Bounds {
        let rows = frames.iter().filter_map(|f| self.shown.get(*f)).copied();
        let row = rows.reduce(Bounds::union).unwrap_or(self.view);
        let (min, max) = (Point::new(self.view.min.x, row.min.y), Point::new(self.view.max.x, row.max.y));
        Bounds { min, max }
    }
}
