//! Composes the picture of one frame from its layers: ground, blocks, planned blocks, robots, arrows or other marks,
//! and labels on top.

use super::label::{self, Callout};
use super::pen::Pen;
use super::unit::unit;
use super::view;
use crate::geometry::{Bounds, Point};
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Group, Item};

/// Cuts off the ground of a picture beyond the right and the lower edge of [`view::ground_shown`], so that marks beyond
/// these edges do not seem to stand on the ground.
pub(crate) fn cut_ground(pen: &Pen<'_>, picture: &mut Group) {
    let scene = &pen.context.analysis.scene;
    let Some(shown) = view::ground_shown(scene, unit(scene, None)) else {
        return;
    };
    let corner = pen.camera.place(Point::new(shown.max.x, shown.min.y));
    for item in &mut picture.items {
        if let Item::Group(group) = item
            && group.class == "ground"
            && let Some(clip) = &mut group.clip
        {
            clip.width = clip.width.min(corner.x - clip.at.x).max(0.0);
            clip.height = clip.height.min(corner.y - clip.at.y).max(0.0);
        }
    }
}

/// Composes the picture of a frame: ground, `blocks`, planned blocks, robots, `marks`, and labels that do not cover
/// `ink`. `view` is the shown part of the scene in metres; ground outside it is cut off.
pub(crate) fn composed(pen: &Pen<'_>, view: Bounds, blocks: Group, marks: Vec<Group>, ink: Ink) -> Group {
    composed_with(pen, view, blocks, marks, Vec::new(), ink)
}

/// Like [`composed`], with additional texts (`callouts`), which are placed before other labels.
pub(crate) fn composed_with(
    pen: &Pen<'_>,
    view: Bounds,
    blocks: Group,
    marks: Vec<Group>,
    callouts: Vec<Callout>,
    ink: Ink,
) -> Group {
    let mut group = Group {
        camera: Some(*pen.camera),
        clip: pen.context.options.zoom.map(|_| pen.camera.rect(view)),
        ..Group::with_class("picture")
    };
    let parts = [pen.ground(view), blocks, pen.plans(), pen.discs()];
    let parts = parts.into_iter().chain(marks);
    group.items.extend(parts.map(Item::from));
    group.items.push(label::labels(pen, view, callouts, || ink).into());
    group.items.retain(|item| !matches!(item, Item::Group(g) if g.items.is_empty() && g.description.is_empty()));
    group
}
