//! Draws dimension lines at the edges of a picture. The lines show the width and the height of the structure. In a
//! zoomed picture, they show the width and the height of the block in its centre.

use super::context::FigureContext;
use super::words::quantity;
use crate::geometry::Bounds;
use crate::mechanics::scene::BlockId;
use crate::pictures::drawing::{Anchor, Camera, Face, Group, Outline, PagePoint, Path, Stroke, Text, text};

/// Height of the space below a picture for the dimension of its width, pixels.
pub(crate) const SPACE_BELOW: f64 = 26.0;
/// Width of the space to the left of a picture for the dimension of its height, pixels. The same space on the right
/// keeps the picture in the middle of its panel.
pub(crate) const SPACE_LEFT: f64 = 58.0;
/// Half the length of the mark at each end, pixels.
const HALF_TICK: f64 = 4.0;

/// Draws the dimension lines below and to the left of the picture of a frame. `view` is the part of the scene that the
/// picture shows, in metres. The group is empty for a frame without blocks.
pub(crate) fn lines(context: &FigureContext<'_>, frame: usize, view: Bounds, camera: &Camera) -> Group {
    let group = Group::with_class("dimensions");
    let scene = &context.analysis.scene;
    let is_measured = |id: &&BlockId| context.options.zoom.is_none_or(|zoomed| zoomed == **id);
    let blocks = scene.frames[frame].placed.iter().filter(is_measured);
    let blocks = blocks.map(|id| scene.blocks[id.0].body.polygon.bounds());
    let Some(all) = blocks.reduce(Bounds::union) else {
        return group;
    };
    let theme = &context.options.theme;
    let (page, measured) = (camera.rect(view), camera.rect(all));
    let size = theme.sizes.reason;
    let stroke = || Stroke::new(theme.faint, 0.8);
    let words = |value: f64| quantity(value, scene.units.length());

    let y = page.at.y + page.height + 0.5 * SPACE_BELOW;
    let (left, right) = (measured.at.x, measured.at.x + measured.width);
    let mut across = Outline::line([PagePoint::new(left, y), PagePoint::new(right, y)]);
    for x in [left, right] {
        let ends = [PagePoint::new(x, y - HALF_TICK), PagePoint::new(x, y + HALF_TICK)];
        across.extend(Outline::line(ends));
    }
    let x = page.at.x - 10.0;
    let (top, bottom) = (measured.at.y, measured.at.y + measured.height);
    let mut up = Outline::line([PagePoint::new(x, top), PagePoint::new(x, bottom)]);
    for y in [top, bottom] {
        let ends = [PagePoint::new(x - HALF_TICK, y), PagePoint::new(x + HALF_TICK, y)];
        up.extend(Outline::line(ends));
    }
    let label =
        |at: PagePoint, value: f64, anchor| Text::new(at, words(value), Face::Sans, size, theme.faint).anchored(anchor);
    // Write the width below the middle of the line if the line is long enough, otherwise to the right of the line.
    let wide = text::width(&words(all.width()), Face::Sans, size);
    let below = if wide + 4.0 < measured.width {
        label(PagePoint::new((left + right) / 2.0, y + size + 1.0), all.width(), Anchor::Middle)
    } else {
        label(PagePoint::new(right + 7.0, y + 0.36 * size), all.width(), Anchor::Start)
    };
    let beside = PagePoint::new(x - 7.0, (top + bottom) / 2.0 + 0.36 * size);
    group.with(Path::stroked(across, stroke())).with(Path::stroked(up, stroke())).with(below).with(label(
        beside,
        all.height(),
        Anchor::End,
    ))
}
