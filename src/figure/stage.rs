//! [`Stage`]: what all panels of a figure share: the unit edge, the view, colours, and each frame's arrows.

use super::arrow::Marks;
use super::fill::Fills;
use super::kind::Kind;
use super::option::{ArrowScale, Options};
use super::view;
use crate::analysis::Analysis;
use crate::geometry::{Bounds, Point};
use crate::scene::Scene;

/// Above so many blocks in a frame, blocks are drawn together by colour, without names.
pub(crate) const MANY: usize = 1000;

/// What all panels of a figure share.
pub(crate) struct Stage<'a> {
    pub analysis: &'a Analysis<'a>,
    pub kind: Kind,
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
}

impl<'a> Stage<'a> {
    pub fn of(analysis: &'a Analysis<'a>, kind: Kind, options: &'a Options) -> Stage<'a> {
        let scene = analysis.scene;
        let own: Vec<f64> = (0..analysis.frames.len())
            .map(|frame| kind.largest(analysis, frame, options))
            .collect();
        let shared = own.iter().copied().fold(0.0, f64::max);
        let reference = |own: f64| match options.scale {
            ArrowScale::Panel => own,
            ArrowScale::Strip => shared,
        };
        let marks: Vec<Marks> = own
            .iter()
            .enumerate()
            .map(|(i, own)| kind.marks(analysis, i, options, reference(*own)))
            .collect();
        let unit = unit(scene);
        let reach: Vec<Option<Bounds>> = (0..marks.len())
            .map(|frame| kind.reach(analysis, frame, unit, &marks[frame]))
            .collect();
        let shown = view::shown(scene, &marks, &reach, options.theme.widths.disc, unit);
        let nothing = Bounds {
            min: Point::origin(),
            max: Point::origin(),
        }
        .grown(unit);
        let view = shown
            .iter()
            .copied()
            .reduce(Bounds::union)
            .unwrap_or(nothing);
        Stage {
            analysis,
            kind,
            options,
            unit,
            shown,
            view,
            fills: Fills::of(analysis),
            marks,
        }
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

/// The unit edge in metres: the lattice's side, unless blocks are far larger than cells; off the lattice a typical size,
/// 0.6·√area of the middle block, which is about the edge of a regular hexagon of that area.
pub(crate) fn unit(scene: &Scene) -> f64 {
    let mut sizes: Vec<f64> = scene
        .blocks
        .iter()
        .map(|b| b.body.polygon.area().sqrt())
        .collect();
    sizes.sort_by(f64::total_cmp);
    let typical = 0.6 * sizes.get(sizes.len() / 2).copied().unwrap_or(1.0);
    match scene.lattice {
        Some(lattice) if typical < 1.5 * lattice.side => lattice.side,
        _ => typical,
    }
}
