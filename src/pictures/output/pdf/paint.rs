//! Converts colours, outlines and transforms of an SVG to the types of the PDF library krilla.

use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Transform};
use krilla::num::NormalizedF32;
use krilla::paint::{Fill, FillRule, LineCap, LineJoin, Paint, Stroke, StrokeDash};
use resvg::tiny_skia::PathSegment;
use resvg::usvg;

/// Returns the passes in which a shape is drawn, in order. Each pass has either a fill or a stroke. `order` determines
/// whether the fill or the stroke comes first.
pub(super) fn passes(
    fill: Option<Fill>,
    stroke: Option<Stroke>,
    order: usvg::PaintOrder,
) -> Vec<(Option<Fill>, Option<Stroke>)> {
    match (fill, stroke) {
        (None, None) => Vec::new(),
        (Some(fill), Some(stroke)) => {
            let mut both = vec![(Some(fill), None), (None, Some(stroke))];
            if order == usvg::PaintOrder::StrokeAndFill {
                both.reverse();
            }
            both
        }
        one => vec![one],
    }
}

fn paint(paint: &usvg::Paint) -> Option<Paint> {
    match paint {
        usvg::Paint::Color(c) => Some(rgb::Color::new(c.red, c.green, c.blue).into()),
        // A drawing has neither gradients nor patterns.
        _ => None,
    }
}

/// Converts an opacity (0 to 1) to the type of krilla.
pub(super) fn share(share: usvg::Opacity) -> NormalizedF32 {
    NormalizedF32::new(share.get()).unwrap_or(NormalizedF32::ONE)
}

/// Converts a fill to the type of krilla. Returns `None` if the paint is not a plain colour.
pub(super) fn fill(of: &usvg::Fill) -> Option<Fill> {
    Some(Fill {
        paint: paint(of.paint())?,
        opacity: share(of.opacity()),
        rule: match of.rule() {
            usvg::FillRule::NonZero => FillRule::NonZero,
            usvg::FillRule::EvenOdd => FillRule::EvenOdd,
        },
    })
}

/// Converts a stroke to the type of krilla. Returns `None` if the paint is not a plain colour.
pub(super) fn stroke(of: &usvg::Stroke) -> Option<Stroke> {
    Some(Stroke {
        paint: paint(of.paint())?,
        width: of.width().get(),
        miter_limit: of.miterlimit().get(),
        line_cap: match of.linecap() {
            usvg::LineCap::Butt => LineCap::Butt,
            usvg::LineCap::Round => LineCap::Round,
            usvg::LineCap::Square => LineCap::Square,
        },
        line_join: match of.linejoin() {
            usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => LineJoin::Miter,
            usvg::LineJoin::Round => LineJoin::Round,
            usvg::LineJoin::Bevel => LineJoin::Bevel,
        },
        opacity: share(of.opacity()),
        dash: of.dasharray().map(|array| StrokeDash { array: array.to_vec(), offset: of.dashoffset() }),
    })
}

/// Converts an affine transform to the type of krilla.
pub(super) fn transform(t: usvg::Transform) -> Transform {
    Transform::from_row(t.sx, t.ky, t.kx, t.sy, t.tx, t.ty)
}

/// Joins the outlines of a group's own shapes, without those of nested groups, into one path. Returns `None` if there
/// are none.
pub(super) fn outline_of(group: &usvg::Group) -> Option<Path> {
    let mut pen = PathBuilder::new();
    for node in group.children() {
        if let usvg::Node::Path(path) = node {
            put(&mut pen, path.data());
        }
    }
    pen.finish()
}

/// Converts the outline of a shape to a path of krilla. Returns `None` if it is empty.
pub(super) fn outline(data: &resvg::tiny_skia::Path) -> Option<Path> {
    let mut pen = PathBuilder::new();
    put(&mut pen, data);
    pen.finish()
}

fn put(pen: &mut PathBuilder, data: &resvg::tiny_skia::Path) {
    for segment in data.segments() {
        match segment {
            PathSegment::MoveTo(p) => pen.move_to(p.x, p.y),
            PathSegment::LineTo(p) => pen.line_to(p.x, p.y),
            PathSegment::QuadTo(a, p) => pen.quad_to(a.x, a.y, p.x, p.y),
            PathSegment::CubicTo(a, b, p) => pen.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y),
            PathSegment::Close => pen.close(),
        }
    }
}
