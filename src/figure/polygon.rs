//! The force polygon: the forces on a structure from outside, tip to tail beside it.
//!
//! Weights and loads follow each other block by block, then what the ground and the robots give, and at last what is
//! missing: where the structure is in balance the polygon is closed. Each arrow has the colour and the number of newtons
//! that it has on the structure beside it; only the scale is larger, by a whole number that the key tells.

use super::arrow::{ArrowKind, ForceArrow, Marks};
use super::label;
use super::legend::{self, Entry};
use super::mark;
use super::option::Options;
use super::panel::Pen;
use super::stage::{Stage, unit};
use super::told;
use super::verdict;
use super::words::round_below;
use crate::analysis::Analysis;
use crate::drawing::arrow::straight;
use crate::drawing::{Camera, Group, Outline, Path, Stroke};
use crate::geometry::{Bounds, Point, Vector};
use crate::scene::BodyId;

/// The polygon is about as large as this share of the structure.
const SIZE: f64 = 0.75;
/// Room between structure and polygon, as a share of the structure's diagonal, and at least so many unit edges.
const APART: (f64, f64) = (0.12, 1.0);
/// A polygon whose last tip misses its first tail by at most this share of the sum of all forces is closed.
const CLOSED: f64 = 1e-6;

/// What acts on a frame's structure from outside: weights, loads, what ground and robots give, and what is missing there.
pub(crate) fn marks(
    analysis: &Analysis<'_>,
    frame: usize,
    options: &Options,
    newtons_per_unit: f64,
) -> Marks {
    let marks = mark::marks(analysis, frame, options, newtons_per_unit);
    let outside = |arrow: &ForceArrow| match arrow.kind.partner() {
        Some(BodyId::Block(_)) => false,
        Some(BodyId::Ground(_)) | None => true,
    };
    let mut arrows: Vec<ForceArrow> = marks.arrows.into_iter().filter(outside).collect();
    arrows.sort_by_key(|arrow| match arrow.kind {
        ArrowKind::Weight | ArrowKind::Load => 0,
        kind if kind.is_failure() => 2,
        _ => 1,
    });
    Marks { arrows, ..marks }
}

/// A frame's polygon in the scene: its corners, and how many times as large as on the structure forces are.
struct Chain {
    corners: Vec<Point>,
    times: f64,
}

/// The forces of `marks` tip to tail, to the right of the blocks of a frame.
fn chain(analysis: &Analysis<'_>, frame: usize, marks: &Marks) -> Option<Chain> {
    let scene = analysis.scene;
    let blocks = scene.frames[frame].placed.iter();
    let structure = blocks
        .map(|id| scene.blocks[id.0].body.polygon.bounds())
        .reduce(Bounds::union)?;
    let mut at = Point::origin();
    let mut corners = vec![at];
    for arrow in &marks.arrows {
        at += arrow.vector;
        corners.push(at);
    }
    let own = Bounds::of(corners.iter().copied()).filter(|_| marks.arrows.len() > 1)?;
    let size = own.width().max(own.height());
    if size.is_nan() || size <= 0.0 {
        return None;
    }
    let times = round_below(SIZE * structure.width().max(structure.height()) / size);
    if times <= 0.0 {
        return None;
    }
    let (share, least) = APART;
    let apart = (share * structure.diagonal()).max(least * unit(scene));
    // Its left edge beside the structure, its middle as high as the structure's.
    let middle = 0.5 * (structure.min.y + structure.max.y);
    let shift = Vector::new(
        structure.max.x + apart - times * own.min.x,
        middle - 0.5 * times * (own.min.y + own.max.y),
    );
    let place = |p: &Point| Point::from(p.coords * times + shift);
    Some(Chain {
        corners: corners.iter().map(place).collect(),
        times,
    })
}

/// How many times as large forces are, in words.
fn larger(times: f64) -> String {
    if times >= 1.0 {
        format!("{times:.0}")
    } else {
        format!("1/{:.0}", 1.0 / times)
    }
}

/// A box around the polygon of a frame, arrows of so many newtons per unit edge.
pub(crate) fn reach(analysis: &Analysis<'_>, frame: usize, marks: &Marks) -> Option<Bounds> {
    let chain = chain(analysis, frame, marks)?;
    let own = Bounds::of(chain.corners)?;
    Some(own.grown(0.3 * unit(analysis.scene)))
}

/// What the camera sees of a frame: the structure with the forces on it from outside, and their polygon.
pub(crate) fn picture(stage: &Stage<'_>, frame: usize, view: Bounds, camera: &Camera) -> Group {
    let pen = Pen::of(stage, frame, camera);
    let marks = &stage.marks[frame];
    let mut ink = label::ink(&pen);
    let mut polygon = Group::of_class("polygon").titled("Force polygon");
    if let Some(chain) = chain(stage.analysis, frame, marks) {
        let theme = &stage.options.theme;
        for (arrow, ends) in marks.arrows.iter().zip(chain.corners.windows(2)) {
            let from = camera.place(ends[0]);
            let along = camera.turn(ends[1] - ends[0]);
            ink.arrow(from, along, pen.width(arrow));
            let path = Path::filled(straight(from, along, pen.width(arrow)), arrow.colour);
            let title = told::arrow(stage, arrow);
            let drawn = Group::of_class("force").titled(title).with(path);
            polygon.items.push(drawn.into());
        }
        let (first, last) = (chain.corners.first(), chain.corners.last());
        if let (Some(first), Some(last), false) = (first, last, closed(marks)) {
            let gap = Outline::line([*last, *first].map(|p| camera.place(p)));
            let stroke = Stroke::new(theme.failure, 1.4).dashed([5.0, 4.0]);
            let drawn = Group::of_class("gap").titled("What is missing for a balance");
            polygon
                .items
                .push(drawn.with(Path::stroked(gap, stroke)).into());
        }
    }
    let parts = vec![pen.arrows(false), pen.arrows(true), polygon];
    pen.picture(view, pen.blocks(), parts, ink)
}

/// Whether the forces add up to nothing.
fn closed(marks: &Marks) -> bool {
    let sum: Vector = marks.arrows.iter().map(|a| a.force).sum();
    let all: f64 = marks.arrows.iter().map(|a| a.force.norm()).sum();
    sum.norm() <= CLOSED * all
}

/// What the signs of a force polygon mean.
pub(crate) fn entries(stage: &Stage<'_>, unit: f64) -> Vec<Entry> {
    let mut entries = legend::entries(stage, unit);
    // Blocks are plain here: no colour tells an amplitude.
    entries.retain(|entry| !matches!(entry, Entry::Amplitudes(..)));
    let frames = stage.marks.iter().enumerate();
    let mut times: Vec<f64> = frames
        .filter_map(|(frame, marks)| Some(chain(stage.analysis, frame, marks)?.times))
        .collect();
    times.dedup();
    if let [one] = times[..] {
        let what = match one {
            1.0 => "force polygon: the same forces tip to tail, to the same scale".to_owned(),
            t => format!(
                "force polygon: the same forces tip to tail, drawn {} times as large",
                larger(t)
            ),
        };
        entries.push(Entry::Note(what));
    } else if !times.is_empty() {
        let all: Vec<String> = times.iter().map(|t| larger(*t)).collect();
        let what = format!(
            "force polygons: the same forces tip to tail, drawn {} times as large, in the order of the panels",
            all.join(", ")
        );
        entries.push(Entry::Note(what));
    }
    entries
}

/// What is said below a frame's verdict.
pub(crate) fn reason(stage: &Stage<'_>, frame: usize) -> String {
    let why = verdict::reason(stage.analysis.scene, &stage.analysis.frames[frame]);
    let marks = &stage.marks[frame];
    let how = match (marks.arrows.is_empty(), closed(marks)) {
        (true, _) => return why,
        (_, true) => "the force polygon is closed",
        _ => "the force polygon stays open",
    };
    if why.is_empty() {
        how.to_owned()
    } else {
        format!("{how}; {why}")
    }
}
