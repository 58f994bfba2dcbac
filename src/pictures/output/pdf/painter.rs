//! [`PdfPainter`]: draws an SVG image on a page of a PDF. Its input is the tree of shapes that resvg has parsed.

use krilla::geom::Point;
use krilla::paint::FillRule;
use krilla::surface::Surface;
use krilla::text::{Font, GlyphId, KrillaGlyph};
use resvg::usvg;

use super::super::tree;
use super::paint::{fill, outline, outline_of, passes, share, stroke, transform};
use crate::pictures::drawing::Face;

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
