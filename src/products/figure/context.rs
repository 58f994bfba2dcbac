//! [`FigureContext`]: what all panels of a figure share: the unit edge, the view, colours, and each frame's arrows.

use core::cell::Cell;

use super::arrow::{ArrowKind, ForceArrow, LEAST_SEEN, Marks};
use super::displacement::Displacement;
use super::fill::{FillScale, Fills};
use super::option::Options;
use super::view;
use crate::analysis::Analysis;
use crate::geometry::{Bounds, Point, Vector};

/// Above so many blocks in a frame, blocks are drawn together by colour, without names.
pub(crate) const MANY: usize = 1000;

/// Where a unit edge is shorter than this, pixels, 2.2 mm, the arrows of a figure are dust.
const DUST: f64 = 8.4;
/// Fewer blocks than this are no crowd: their arrows stay, and what is too short to be seen is counted.
const CROWD: usize = 40;

/// Where in a crowd less than this share of the arrows can be seen, colours tell the forces instead.
const FEW_SEEN: f64 = 0.2;

/// What all panels of a figure share.
pub(crate) struct FigureContext<'a> {
    pub analysis: &'a Analysis,
    /// Whether blocks tell amplitudes by their colour; otherwise they are plain.
    pub colours_show_amplitudes: bool,
    /// Whether lines are drawn across the blocks, below their names.
    pub lines_cross_names: bool,
    pub options: &'a Options,
    /// The unit edge, metres.
    pub unit: f64,
    /// A box around all that each frame shows.
    pub shown: Vec<Bounds>,
    /// A box around all of them.
    pub view: Bounds,
    pub fills: Fills,
    /// One entry per frame.
    pub marks: Vec<Marks>,
    /// For each frame how each block is displaced, by its number; empty where all are drawn in their places.
    pub displaced: Vec<Vec<Option<Displacement>>>,
    /// What is written below each frame's verdict.
    pub statements: Vec<String>,
    /// How many labels, so far, had no room, or none but in another block.
    pub cramped: Cell<usize>,
}

impl<'a> FigureContext<'a> {
    /// With more room around what every frame shows, metres across and up.
    pub fn with_room(mut self, across: f64, up: f64) -> FigureContext<'a> {
        // Where ground is shown, it is the lower edge.
        let down = match view::ground_shown(&self.analysis.scene, self.unit) {
            Some(ground) if ground.min.y <= self.view.min.y + self.unit => 0.0,
            _ => up,
        };
        let grown = |b: Bounds| Bounds {
            min: b.min - Vector::new(across, down),
            max: b.max + Vector::new(across, up),
        };
        self.shown.iter_mut().for_each(|b| *b = grown(*b));
        self.view = grown(self.view);
        self.cramped.set(0);
        self
    }

    /// Whether arrows would be dust where a metre is so many pixels long, and colours tell the forces instead.
    pub fn dusty(&self, scale: f64) -> bool {
        let described = self
            .analysis
            .scene
            .blocks
            .iter()
            .any(|b| b.body.fill.is_none());
        let frames = self.analysis.scene.frames.iter();
        let most = frames.map(|f| f.placed.len()).max().unwrap_or(0);
        most >= CROWD
            && (self.unit * scale < DUST || self.faint(scale))
            && described
            && !self.plain()
            && !self.options.printed()
    }

    /// Whether nearly all arrows are too short to be seen, so that those that are left would tell of a few joints and
    /// hide what the others carry.
    fn faint(&self, scale: f64) -> bool {
        let arrows = || self.marks.iter().flat_map(|m| &m.arrows);
        let carried = |a: &&ForceArrow| !a.kind.is_failure() && a.kind != ArrowKind::Load;
        let seen = |a: &&ForceArrow| a.reach().norm() * scale >= LEAST_SEEN;
        let count = arrows().filter(carried).count();
        (arrows().filter(carried).filter(seen).count() as f64) < FEW_SEEN * count as f64
    }

    /// Whether blocks have one plain colour.
    pub fn plain(&self) -> bool {
        !self.colours_show_amplitudes || self.fills.scale == FillScale::Plain
    }

    /// What the panels of a row show: as wide as all frames need, so that structures stand one below the other, and as
    /// high as the frames of the row need.
    pub fn row(&self, frames: &[usize]) -> Bounds {
        let rows = frames.iter().filter_map(|f| self.shown.get(*f)).copied();
        let row = rows.reduce(Bounds::union).unwrap_or(self.view);
        let (min, max) = (
            Point::new(self.view.min.x, row.min.y),
            Point::new(self.view.max.x, row.max.y),
        );
        Bounds { min, max }
    }
}
