//! [`Stage`]: what all panels of a figure share: the unit edge, the view, colours, and each frame's arrows.

use super::arrow::Marks;
use super::fill::Fills;
use super::mark;
use super::option::{ArrowScale, Options};
use crate::analysis::Analysis;
use crate::drawing::arrow::{HEAD_LENGTH, HEAD_WIDTH};
use crate::geometry::{Bounds, Point, Vector};
use crate::scene::Scene;

/// Radius of a robot's disc in unit edges.
pub(crate) const DISC: f64 = 0.3;
/// Above so many blocks in a frame, blocks are drawn together by colour, without names.
pub(crate) const MANY: usize = 1000;

/// What all panels of a figure share.
pub(crate) struct Stage<'a> {
    pub analysis: &'a Analysis<'a>,
    pub options: &'a Options,
    /// The unit edge, metres.
    pub unit: f64,
    /// What every panel shows of the scene.
    pub view: Bounds,
    pub fills: Fills,
    /// One entry per frame.
    pub marks: Vec<Marks>,
}

impl<'a> Stage<'a> {
    pub fn of(analysis: &'a Analysis<'a>, options: &'a Options) -> Stage<'a> {
        let scene = analysis.scene;
        let own: Vec<f64> = scene
            .frames
            .iter()
            .zip(&analysis.frames)
            .map(|(frame, found)| mark::largest(scene, frame, found, options))
            .collect();
        let shared = own.iter().copied().fold(0.0, f64::max);
        let reference = |own: f64| match options.scale {
            ArrowScale::Panel => own,
            ArrowScale::Strip => shared,
        };
        let marks: Vec<Marks> = own
            .iter()
            .enumerate()
            .map(|(i, own)| mark::marks(analysis, i, options, reference(*own)))
            .collect();
        let unit = unit(scene);
        let view = view(scene, &marks, unit);
        Stage {
            analysis,
            options,
            unit,
            view,
            fills: Fills::of(analysis),
            marks,
        }
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

/// A box around everything that any frame shows. Ground that reaches far beyond the blocks is cut.
fn view(scene: &Scene, marks: &[Marks], unit: f64) -> Bounds {
    let placed = scene.frames.iter().flat_map(|frame| {
        let planned = frame.plans.iter().map(|plan| plan.block);
        frame.placed.iter().copied().chain(planned)
    });
    let mut seen = vec![false; scene.blocks.len()];
    for block in placed {
        seen[block.0] = true;
    }
    let blocks = scene
        .blocks
        .iter()
        .zip(&seen)
        .filter(|(_, seen)| **seen)
        .map(|(b, _)| b.body.polygon.bounds());
    let blocks = blocks.reduce(Bounds::union);
    let ground = scene.ground.iter().map(|g| g.body.polygon.bounds());
    let Some(blocks) = blocks.or_else(|| ground.clone().reduce(Bounds::union)) else {
        let at = Point::origin();
        return Bounds { min: at, max: at }.grown(unit);
    };
    let reach = blocks.diagonal().max(unit);
    let near = blocks.grown((0.12 * reach).max(1.0 * unit));
    let around = blocks.grown(reach);
    let mut view = blocks;
    for part in ground {
        let small = part.width() <= 3.0 * unit && part.height() <= 3.0 * unit;
        let shown = if small && around.meets(part) {
            Some(part)
        } else {
            common(near, part)
        };
        if let Some(shown) = shown {
            view = view.union(shown);
        }
    }
    for marks in marks {
        for arrow in &marks.arrows {
            let length = arrow.vector.norm();
            if length > 0.0 {
                let tip = arrow.at + arrow.vector * (1.0 + HEAD_LENGTH * arrow.width / length);
                let ends = Bounds::of([arrow.at, tip]);
                view = ends.map_or(view, |b| {
                    view.union(b.grown(HEAD_WIDTH * arrow.width / 2.0))
                });
            }
        }
        for turn in &marks.turns {
            view = view.union(
                Bounds {
                    min: turn.at,
                    max: turn.at,
                }
                .grown(0.7 * unit),
            );
        }
    }
    for hold in scene.frames.iter().flat_map(|f| &f.holds) {
        view = view.union(
            Bounds {
                min: hold.at,
                max: hold.at,
            }
            .grown(DISC * unit),
        );
    }
    view.grown(0.08 * unit)
}

/// What two boxes have in common, `None` where they are apart.
fn common(a: Bounds, b: Bounds) -> Option<Bounds> {
    let (min, max) = (a.min.sup(&b.min), a.max.inf(&b.max));
    let size: Vector = max - min;
    (size.x >= 0.0 && size.y >= 0.0).then_some(Bounds { min, max })
}
