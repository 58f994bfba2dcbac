//! [`read`] reads an SVG with the resvg library. Text is laid out with the built-in fonts and the fonts that a user
//! adds.
//!
//! Pixel images, PDF and text outlines are all made from this tree, so text has the same position in all of them. Only
//! the built-in and the added fonts are used, never those of the machine. A character that no font has is drawn as a
//! question mark.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::Transform;
use resvg::usvg::{self, Group, Node, fontdb};

use super::fonts::Fonts;
use crate::pictures::drawing::Face;

/// Reads an SVG document as a tree of shapes and laid-out text.
///
/// # Errors
/// Returns the message of resvg if it cannot read the SVG.
pub(super) fn read(svg: &str, more: &Fonts) -> Result<usvg::Tree, String> {
    let svg = &legible(svg, more);
    let options = usvg::Options {
        font_family: "Libertinus Serif".to_owned(),
        fontdb: database(more),
        // Never load files or images: a drawing contains everything that it shows.
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_string: Box::new(|_, _| None),
            ..usvg::ImageHrefResolver::default()
        },
        ..usvg::Options::default()
    };
    usvg::Tree::from_str(svg, &options).map_err(|e| e.to_string())
}

/// Replaces characters that none of the fonts has by question marks.
fn legible<'s>(svg: &'s str, fonts: &Fonts) -> Cow<'s, str> {
    let lacking = fonts.lacking(svg);
    if lacking.is_empty() {
        return Cow::Borrowed(svg);
    }
    let shown = |c: char| if lacking.contains(&c) { '?' } else { c };
    Cow::Owned(svg.chars().map(shown).collect())
}

/// Returns a font database with the built-in fonts, followed by the added fonts.
fn database(more: &Fonts) -> Arc<fontdb::Database> {
    let ours = &fonts().0;
    if more.more().is_empty() {
        return Arc::clone(ours);
    }
    let mut all = fontdb::Database::clone(ours);
    for data in more.more() {
        all.load_font_data(data.as_ref().clone());
    }
    Arc::new(all)
}

/// True if any glyph of a line of text comes from an added font.
pub(super) fn foreign(text: &usvg::Text) -> bool {
    let spans = text.layouted().iter();
    let mut glyphs = spans.flat_map(|span| &span.positioned_glyphs);
    glyphs.any(|glyph| face(glyph.font).is_none())
}

/// Returns the lines of text in a group and its subgroups, in the order of drawing.
pub(super) fn texts(group: &Group) -> Vec<&usvg::Text> {
    let mut found = Vec::new();
    for node in group.children() {
        match node {
            Node::Group(group) => found.extend(texts(group)),
            Node::Text(text) => found.push(text.as_ref()),
            Node::Path(_) | Node::Image(_) => {}
        }
    }
    found
}

/// A glyph and its position.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// The index of the glyph in its font.
    pub glyph: u16,
    /// The characters that it represents.
    pub characters: String,
    /// Its origin, pixels to the right and down.
    pub at: (f64, f64),
}

/// Consecutive glyphs of one face and size, in their order.
#[derive(Clone, Debug)]
pub(super) struct Run {
    /// The face of the glyphs.
    pub face: Face,
    /// The font size in pixels.
    pub size: f64,
    /// The glyphs.
    pub glyphs: Vec<Placed>,
}

/// Returns the glyphs of a span of text as runs of glyphs of one face. Glyphs from added fonts are left out.
pub(super) fn runs(span: &usvg::layout::Span) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for glyph in &span.positioned_glyphs {
        let Some(face) = face(glyph.font) else {
            continue;
        };
        let mut origin = resvg::tiny_skia::Point::zero();
        let transform: Transform = glyph.transform();
        transform.map_point(&mut origin);
        let placed = Placed {
            glyph: u16::try_from(glyph.id.0).unwrap_or_default(),
            characters: glyph.text.clone(),
            at: (f64::from(origin.x), f64::from(origin.y)),
        };
        match runs.last_mut().filter(|run| run.face == face) {
            Some(run) => run.glyphs.push(placed),
            None => runs.push(Run { face, size: f64::from(glyph.font_size()), glyphs: vec![placed] }),
        }
    }
    runs
}

/// Returns the face of the built-in font with this id, or `None` for an added font.
pub(super) fn face(id: fontdb::ID) -> Option<Face> {
    let known = &fonts().1;
    known.iter().find(|(of, _)| *of == id).map(|(_, face)| *face)
}

/// The built-in fonts, and the id of each font in the font database.
type BuiltInFonts = (Arc<fontdb::Database>, Vec<(fontdb::ID, Face)>);

fn fonts() -> &'static BuiltInFonts {
    static FONTS: OnceLock<BuiltInFonts> = OnceLock::new();
    FONTS.get_or_init(|| {
        let mut fonts = fontdb::Database::new();
        let mut known = Vec::new();
        for face in Face::ALL {
            let source = fontdb::Source::Binary(Arc::new(face.data()));
            known.extend(fonts.load_font_source(source).iter().map(|id| (*id, face)));
        }
        fonts.set_serif_family("Libertinus Serif");
        fonts.set_sans_serif_family("Inter");
        (Arc::new(fonts), known)
    })
}
