//! How far from the edge: the structure as it stands, and as a ghost how it would fall if gravity turned far enough.
//!
//! Gravity turns to the side on which less is needed: a dashed line shows where it points now, an arrow where it would
//! point. Nothing falls here; the blocks stand in their places.

use super::displacement::{self, Displacement};
use super::label;
use super::legend::{self, Entry};
use super::mechanism;
use super::panel::Pen;
use super::stage::Stage;
use super::words::degrees;
use crate::analysis::{Analysis, Verdict};
use crate::drawing::arrow::straight;
use crate::drawing::{Camera, Group, Outline, PagePoint, PageRect, Path, Stroke, Theme};
use crate::geometry::{Bounds, Point, Vector, sin_cos_degrees};

/// Length of the arrow of gravity, as a share of the structure's diagonal.
const LONG: f64 = 0.16;
/// Its distance from the structure, as a share of the same.
const APART: f64 = 0.12;

/// The frame's analysis with the mechanism at the edge in place of its own, and how far gravity turns, degrees.
fn ghost<'s>(analysis: &Analysis<'s>, frame: usize) -> Option<(Analysis<'s>, f64)> {
    let (turn, motions) = analysis.tilted(frame)?;
    let mut ghost = analysis.clone();
    let found = ghost.frames.get_mut(frame)?;
    found.mechanism = motions;
    found.verdict = Verdict::Unstable;
    Some((ghost, turn))
}

/// Where the blocks of a frame would go, by their numbers, and how far gravity turns.
fn gone(
    analysis: &Analysis<'_>,
    frame: usize,
    unit: f64,
) -> Option<(Vec<Option<Displacement>>, f64)> {
    let (ghost, turn) = ghost(analysis, frame)?;
    Some((displacement::displacements(&ghost, frame, unit, 1.0), turn))
}

/// Where gravity's arrow begins and ends, metres.
struct Gravity {
    from: Point,
    now: Point,
    turned: Point,
}

fn gravity(analysis: &Analysis<'_>, frame: usize, turn: f64) -> Option<Gravity> {
    let scene = analysis.scene;
    let blocks = scene.frames[frame].placed.iter();
    let structure = blocks
        .map(|id| scene.blocks[id.0].body.polygon.bounds())
        .reduce(Bounds::union)?;
    let diagonal = structure.diagonal();
    let down = scene.down() * (LONG * diagonal);
    let (sin, cos) = sin_cos_degrees(turn);
    let turned = Vector::new(cos * down.x - sin * down.y, sin * down.x + cos * down.y);
    let from = Point::new(structure.min.x - APART * diagonal, structure.max.y);
    Some(Gravity {
        from,
        now: from + down,
        turned: from + turned,
    })
}

/// A box around ghosts and gravity.
pub(crate) fn reach(analysis: &Analysis<'_>, frame: usize, unit: f64) -> Option<Bounds> {
    let (displaced, turn) = gone(analysis, frame, unit)?;
    let gravity = gravity(analysis, frame, turn)?;
    let arrow = Bounds::of([gravity.from, gravity.now, gravity.turned])?.grown(0.1 * unit);
    let ghosts = mechanism::reach(analysis, &displaced);
    Some(ghosts.map_or(arrow, |ghosts| ghosts.union(arrow)))
}

/// What the camera sees of a frame, its ghost and gravity.
pub(crate) fn picture(stage: &Stage<'_>, frame: usize, view: Bounds, camera: &Camera) -> Group {
    let pen = Pen::of(stage, frame, camera);
    let ink = label::ink(&pen);
    let (scene, theme) = (stage.analysis.scene, &stage.options.theme);
    let mut parts = Vec::new();
    if let Some((displaced, turn)) = gone(stage.analysis, frame, stage.unit) {
        let mut outline = Outline::default();
        for (block, displacement) in scene.blocks.iter().zip(&displaced) {
            let Some(displacement) = displacement else {
                continue;
            };
            for ring in block.body.polygon.rings() {
                let corners = ring.iter().map(|p| camera.place(displacement.moved(*p)));
                outline.extend(Outline::ring(corners));
            }
        }
        let ghosts = Group::of_class("ghosts").titled("How it would begin to fall");
        parts.push(ghosts.with(ghost_path(outline, pen.line, theme)));
        if let Some(gravity) = gravity(stage.analysis, frame, turn) {
            let [from, now, turned] =
                [gravity.from, gravity.now, gravity.turned].map(|p| camera.place(p));
            let along = (turned.x - from.x, turned.y - from.y);
            let group = Group::of_class("gravity")
                .titled(format!("Gravity turned by {}", degrees(turn.abs())));
            let dashed = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
            let width = (0.04 * libm::hypot(along.0, along.1)).clamp(1.2, 3.0);
            let arrow = Path::filled(straight(from, along, width), theme.ink);
            parts.push(
                group
                    .with(Path::stroked(Outline::line([from, now]), dashed))
                    .with(arrow),
            );
        }
    }
    pen.picture(view, pen.blocks(), parts, ink)
}

fn ghost_path(outline: Outline, line: f64, theme: &Theme) -> Path {
    let edge = theme.motion.mixed(theme.ink, 0.25);
    let stroke = Stroke::new(edge, line.max(0.9)).dashed([5.0, 3.5]);
    Path::stroked(outline, stroke)
}

/// What the signs mean.
pub(crate) fn entries(stage: &Stage<'_>) -> Vec<Entry> {
    let mut entries = Vec::new();
    let frames = 0..stage.analysis.frames.len();
    if frames
        .into_iter()
        .any(|f| stage.analysis.tilted(f).is_some())
    {
        let ghost = "how it would begin to fall".to_owned();
        entries.push(Entry::Sign(ghost_sign, 20.0, ghost));
        let gravity = "gravity turned as far as it may".to_owned();
        entries.push(Entry::Sign(gravity_sign, 26.0, gravity));
    }
    entries.extend(legend::robots(stage));
    entries
}

/// What is said below a frame's verdict.
pub(crate) fn reason(analysis: &Analysis<'_>, frame: usize) -> String {
    let found = &analysis.frames[frame];
    if found.verdict != Verdict::Stable {
        return "there is no margin: it does not stand as it is".to_owned();
    }
    match analysis.tilted(frame) {
        Some((turn, _)) => {
            let side = if turn > 0.0 { "right" } else { "left" };
            format!(
                "falls once gravity is turned by {} to the {side}",
                degrees(turn.abs())
            )
        }
        None if found.margins.is_none() => "its margins were not asked for".to_owned(),
        None => "no turn of gravity makes it fall".to_owned(),
    }
}

fn ghost_sign(at: PagePoint, theme: &Theme) -> Vec<crate::drawing::Item> {
    let swatch = PageRect {
        at: at.moved(0.0, -6.5),
        width: 20.0,
        height: 13.0,
    };
    vec![ghost_path(Outline::rounded(swatch, 0.0), 1.0, theme).into()]
}

fn gravity_sign(at: PagePoint, theme: &Theme) -> Vec<crate::drawing::Item> {
    let from = at.moved(8.0, -8.0);
    let now = Outline::line([from, from.moved(0.0, 16.0)]);
    let dashed = Stroke::new(theme.faint, 1.2).dashed([4.0, 3.0]);
    vec![
        Path::stroked(now, dashed).into(),
        Path::filled(straight(from, (9.0, 14.0), 1.6), theme.ink).into(),
    ]
}
