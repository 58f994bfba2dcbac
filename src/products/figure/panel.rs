//! One frame's picture from its parts: ground, blocks, plans, robots, the arrows or a kind's own marks, and labels on top.

use super::context::FigureContext;
use super::label;
use super::pen::{MIN_READABLE_UNIT_EDGE, Pen};
use crate::drawing::placement::Ink;
use crate::drawing::{Camera, Group, Item};
use crate::geometry::Bounds;

/// The forces of a frame: what the camera sees of frame `number`; ground is cut at the edge of `view`.
pub(crate) fn picture(
    context: &FigureContext<'_>,
    number: usize,
    view: Bounds,
    camera: &Camera,
) -> Group {
    let pen = Pen::new(context, number, camera);
    let many = pen.many();
    let mut group = Group {
        camera: Some(*camera),
        clip: context.options.zoom.map(|_| camera.rect(view)),
        ..Group::with_class("picture")
    };
    group.items.push(pen.ground(view).into());
    group.items.push(pen.blocks().into());
    group.items.push(pen.plans().into());
    group.items.push(pen.discs().into());
    let too_small = context.arrows_too_small(camera.length(1.0));
    group.items.push(
        if too_small {
            pen.loads()
        } else if many {
            pen.arrows_by_colour()
        } else {
            pen.arrows(false)
        }
        .into(),
    );
    if !many && !too_small && pen.unit() >= MIN_READABLE_UNIT_EDGE {
        group.items.push(pen.heads().into());
    }
    group.items.push(pen.arrows(true).into());
    group
        .items
        .push(label::labels(&pen, view, || label::ink(&pen)).into());
    group.items.retain(
        |item| !matches!(item, Item::Group(g) if g.items.is_empty() && g.description.is_empty()),
    );
    group
}

/// A picture of plain parts: ground, these blocks, plans, robots, and the kind's own marks, labels clear of `ink`.
pub(crate) fn composed(
    pen: &Pen<'_>,
    view: Bounds,
    blocks: Group,
    marks: Vec<Group>,
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
    group.items.push(label::labels(pen, view, || ink).into());
    group.items.retain(
        |item| !matches!(item, Item::Group(g) if g.items.is_empty() && g.description.is_empty()),
    );
    group
}
