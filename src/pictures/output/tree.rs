//! [`read`]: reads an SVG with resvg, with all text laid out in the built-in and added fonts.
//!
//! What is drawn in pixels, written as PDF or turned into outlines all begins here, so that words stand in the same
//! places everywhere. Whatever fonts the machine has, none of them is looked at but those that were given. A character that
//! no font has shows as a question mark, never as an empty box.

use std::borrow::Cow;
use std::sync::{Arc, OnceLock};

use resvg::tiny_skia::Transform;
use resvg::usvg::{self, Group, Node, fontdb};

use super::fonts::Fonts;
use crate::drawing::Face;

/// Reads an SVG document as a tree of shapes and laid-out text.
///
/// # Errors
/// What resvg has against the text.
pub(super) fn read(svg: &str, more: &Fonts) -> Result<usvg::Tree, String> {
    let svg = &legible(svg, more);
    let options = usvg::Options {
        font_family: "Libertinus Serif".to_owned(),
        fontdb: database(more),
        // A drawing is self-contained: it loads no files and no images.
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_string: Box::new(|_, _| None),
            ..usvg::ImageHrefResolver::default()
        },
        ..usvg::Options::default()
    };
    usvg::Tree::from_str(svg, &options).map_err(|e| e.to_string())
}

/// The text with question marks for the characters that no font has.
fn legible<'s>(svg: &'s str, fonts: &Fonts) -> Cow<'s, str> {
    let lacking = fonts.lacking(svg);
    if lacking.is_empty() {
        return Cow::Borrowed(svg);
    }
    let shown = |c: char| if lacking.contains(&c) { '?' } else { c };
    Cow::Owned(svg.chars().map(shown).collect())
}

/// The built-in fonts, followed by the added ones.
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

/// Whether a glyph of a line of text comes from an added font.
pub(super) fn foreign(text: &usvg::Text) -> bool {
    let spans = text.layouted().iter();
    let mut glyphs = spans.flat_map(|span| &span.positioned_glyphs);
    glyphs.any(|glyph| face(glyph.font).is_none())
}

/// The texts of a tree in the order of drawing.
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

/// A glyph where it stands.
#[derive(Clone, Debug)]
pub(super) struct Placed {
    /// Its number in its font.
    pub glyph: u16,
    /// The characters it stands for.
    pub characters: String,
    /// Where it begins, pixels to the right and down.
    pub at: (f64, f64),
}

/// Glyphs of one face and size beside each other, in the order in which they stand.
#[derive(Clone, Debug)]
pub(super) struct Run {
    /// Their font.
    pub face: Face,
    /// Its size in pixels.
    pub size: f64,
    /// The glyphs.
    pub glyphs: Vec<Placed>,
}

/// The glyphs of a line of text, grouped by font.
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
            None => runs.push(Run {
                face,
                size: f64::from(glyph.font_size()),
                glyphs: vec![placed],
            }),
        }
    }
    runs
}

/// The built-in face of a font in the tree.
pub(super) fn face(id: fontdb::ID) -> Option<Face> {
    let known = &fonts().1;
    known
        .iter()
        .find(|(of, _)| *of == id)
        .map(|(_, face)| *face)
}

/// Our fonts, and the name under which resvg knows each.
type Ours = (Arc<fontdb::Database>, Vec<(fontdb::ID, Face)>);

fn fonts() -> &'static Ours {
    static FONTS: OnceLock<Ours> = OnceLock::new();
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
