//! Composes the picture of one frame from its layers: ground, blocks, planned blocks, robots, arrows or other marks,
//! and labels on top.

use super::label::{self, Callout};
use super::pen::Pen;
use crate::geometry::Bounds;
use crate::pictures::drawing::placement::Ink;
use crate::pictures::drawing::{Group, Item};

/// Composes the picture of a frame: ground, `blocks`, planned blocks, robots, `marks`, and labels that do not cover
/// `ink`; additional texts (`callouts`) are placed before other labels. `view` is the shown part of the scene in metres;
/// ground outside it is cut off.
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
