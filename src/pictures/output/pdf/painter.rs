//! [`PdfPainter`]: draws an SVG image on a page of a PDF. Its input is the tree of shapes that resvg has parsed. Colours,
//! outlines and transforms are converted to the types of the PDF library krilla.

use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point, Transform};
use krilla::num::NormalizedF32;
use krilla::paint::{Fill, FillRule, LineCap, LineJoin, Paint, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, GlyphId, KrillaGlyph};
use resvg::tiny_skia::PathSegment;
use resvg::usvg;

use crate::pictures::drawing::Face;
use crate::pictures::output::tree;

/// Paints the nodes of an SVG on a page.
pub(super) struct PdfPainter<'s, 'd> {
    pub surface: &'s mut Surface<'d>,
    /// The fonts that were added to the document so far.
    pub fonts: Vec<(Face, Font)>,
}

impl PdfPainter<'_, '_> {
    /// Paints all items of a group, with the transform, clip path and opacity of the group.
    pub(super) fn group(&mut self, group: &usvg::Group) {
        let mut pushed = 0;
        if !group.transform().is_identity() {
            self.surface.push_transform(&transform(group.transform()));
            pushed += 1;
        }
        if let Some(clip) = group.clip_path().and_then(|c| outline_of(c.root())) {
            self.surface.push_clip_path(&clip, &FillRule::NonZero);
            pushed += 1;
        }
        if group.opacity().get() < 1.0 {
            self.surface.push_opacity(share(group.opacity()));
            pushed += 1;
        }
        for node in group.children() {
            match node {
                usvg::Node::Group(group) => self.group(group),
                usvg::Node::Path(path) => self.path(path),
                usvg::Node::Text(text) => self.text(text),
                // The drawings of this crate contain no images.
                usvg::Node::Image(_) => {}
            }
        }
        for _ in 0..pushed {
            self.surface.pop();
        }
    }

    fn path(&mut self, path: &usvg::Path) {
        let Some(outline) = outline(path.data()) else {
            return;
        };
        let (fill, stroke) = (path.fill().and_then(fill), path.stroke().and_then(stroke));
        // PDF draws the stroke above the fill. Most figures need the stroke below the fill, so draw both separately.
        for (fill, stroke) in passes(fill, stroke, path.paint_order()) {
            self.surface.set_fill(fill);
            self.surface.set_stroke(stroke);
            self.surface.draw_path(&outline);
        }
    }

    fn text(&mut self, text: &usvg::Text) {
        if tree::foreign(text) {
            self.group(text.flattened());
            return;
        }
        for span in text.layouted() {
            let (fill, stroke) = (span.fill.as_ref().and_then(fill), span.stroke.as_ref().and_then(stroke));
            for run in tree::runs(span) {
                let Some(font) = self.font(run.face) else {
                    continue;
                };
                for (fill, stroke) in passes(fill.clone(), stroke.clone(), span.paint_order) {
                    // Draw the halo around the letters as outlines. As text, it would be in the document a second time.
                    let outlined = fill.is_none();
                    self.surface.set_fill(fill);
                    self.surface.set_stroke(stroke);
                    self.run(&run, font.clone(), outlined);
                }
            }
        }
    }

    fn run(&mut self, run: &tree::Run, font: Font, outlined: bool) {
        let mut words = String::new();
        let mut glyphs = Vec::with_capacity(run.glyphs.len());
        let Some(first) = run.glyphs.first() else {
            return;
        };
        for (number, placed) in run.glyphs.iter().enumerate() {
            let begin = words.len();
            words.push_str(&placed.characters);
            let next = run.glyphs.get(number + 1).map(|n| n.at.0 - placed.at.0);
            glyphs.push(KrillaGlyph::new(
                GlyphId::new(u32::from(placed.glyph)),
                (next.unwrap_or(0.0) / run.size) as f32,
                0.0,
                ((first.at.1 - placed.at.1) / run.size) as f32,
                0.0,
                begin..words.len(),
                None,
            ));
        }
        let at = Point::from_xy(first.at.0 as f32, first.at.1 as f32);
        let size = run.size as f32;
        self.surface.draw_glyphs(at, &glyphs, font, &words, size, outlined);
    }

    fn font(&mut self, face: Face) -> Option<Font> {
        if let Some((_, font)) = self.fonts.iter().find(|(of, _)| *of == face) {
            return Some(font.clone());
        }
        let font = Font::new(face.data().into(), 0)?;
        self.fonts.push((face, font.clone()));
        Some(font)
    }
}

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
