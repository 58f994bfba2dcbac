//! [`write()`]: a drawing as a PDF page of its own size, in lines and in words that can be searched.
//!
//! It is made from the SVG, as the PNG is, so that they cannot disagree. The only file that names krilla. Our fonts are
//! embedded, cut down to the glyphs that are used. Nothing in it tells of a day or a machine: same drawing, same bytes.

use std::borrow::Cow;

use krilla::Document;
use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point, Transform};
use krilla::metadata::Metadata;
use krilla::num::NormalizedF32;
use krilla::page::PageSettings;
use krilla::paint::{Fill, FillRule, LineCap, LineJoin, Paint, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::tagging::{ContentTag, Tag, TagGroup, TagTree};
use krilla::text::{Font, GlyphId, KrillaGlyph};
use resvg::tiny_skia::PathSegment;
use resvg::usvg;

use super::fonts::Fonts;
use super::{MM_PER_INCH, PIXELS_PER_INCH, svg, tree};
use crate::drawing::{Drawing, Face, PagePoint};
use crate::text::line;

/// Why there is no PDF.
#[derive(Debug, thiserror::Error)]
pub enum PdfError {
    /// The page would be too large or too small.
    #[error(
        "a page of {width:.4} × {height:.4} mm is out of range; each side must be {MIN_SIDE_MM} to {MAX_SIDE_MM} mm long. \
         Choose another width"
    )]
    Size {
        /// Width asked for, mm.
        width: f64,
        /// Height that follows from it, mm.
        height: f64,
    },
    /// The drawing cannot be written so.
    #[error("the drawing cannot be written as PDF: {0}")]
    Write(String),
}

/// Shortest side of a page, mm.
pub const MIN_SIDE_MM: f64 = 2.0;
/// Longest side of a page, mm: readers open no page of more than 14 400 points.
pub const MAX_SIDE_MM: f64 = 5080.0;

/// Points per inch.
const POINTS_PER_INCH: f64 = 72.0;

/// A drawing as a PDF of one page, `width_mm` wide or, where nothing is given, a 96th of an inch per pixel.
///
/// # Errors
/// [`PdfError::Size`] where a side of the page would be shorter than [`MIN_SIDE_MM`] or longer than [`MAX_SIDE_MM`].
///
/// # Example
/// ```
/// use drystone::drawing::Drawing;
/// let drawing = Drawing { width: 800.0, height: 300.0, title: "Nothing".into(),
///     description: String::new(), background: None, items: Vec::new() };
/// let pdf = drystone::output::pdf::write(&drawing, Some(84.0))?;
/// assert!(pdf.starts_with(b"%PDF-"));
/// # Ok::<(), drystone::output::pdf::PdfError>(())
/// ```
pub fn write(drawing: &Drawing, width_mm: Option<f64>) -> Result<Vec<u8>, PdfError> {
    write_in(drawing, width_mm, &Fonts::default())
}

/// As [`write()`], with more fonts than ours. A line of words for which ours do not suffice is drawn as outlines.
///
/// # Errors
/// As [`write()`].
pub fn write_in(
    drawing: &Drawing,
    width_mm: Option<f64>,
    fonts: &Fonts,
) -> Result<Vec<u8>, PdfError> {
    let natural_mm = drawing.width * MM_PER_INCH / PIXELS_PER_INCH;
    let width = width_mm.unwrap_or(natural_mm);
    let sheet = Sheet {
        width: drawing.width,
        height: drawing.height,
        parts: vec![Inset {
            content: Content::Drawing(drawing),
            at: PagePoint::new(0.0, 0.0),
            scale: 1.0,
        }],
    };
    let heading = Heading {
        title: &drawing.title,
        description: &drawing.description,
    };
    document(&[sheet], width / drawing.width, &heading, fonts)
}

/// What is drawn on a page.
#[derive(Clone, Copy, Debug)]
pub enum Content<'d> {
    /// A drawing.
    Drawing(&'d Drawing),
    /// An SVG of ours, such as a chart, and what it shows.
    Svg(&'d str, &'d str),
}

/// A drawing or a chart in its place on a page.
#[derive(Clone, Copy, Debug)]
pub struct Inset<'d> {
    /// What is drawn.
    pub content: Content<'d>,
    /// Where its upper left corner lies, pixels of the page.
    pub at: PagePoint,
    /// Pixels of the page per pixel of the drawing.
    pub scale: f64,
}

/// A page and the drawings on it.
#[derive(Clone, Debug)]
pub struct Sheet<'d> {
    /// Width in pixels, 96 to the inch.
    pub width: f64,
    /// Height in pixels.
    pub height: f64,
    /// What is on it, the lowest first.
    pub parts: Vec<Inset<'d>>,
}

/// What a document says of itself.
#[derive(Clone, Copy, Debug)]
pub struct Heading<'t> {
    /// Its title.
    pub title: &'t str,
    /// What is in it, in sentences.
    pub description: &'t str,
}

/// Pages of several drawings as a PDF, a pixel being a 96th of an inch.
///
/// # Errors
/// As [`write()`], for any of its pages.
pub fn write_sheets(sheets: &[Sheet<'_>], heading: &Heading<'_>) -> Result<Vec<u8>, PdfError> {
    let natural = MM_PER_INCH / PIXELS_PER_INCH;
    document(sheets, natural, heading, &Fonts::default())
}

/// Width and height of an SVG of ours in pixels; `None` for what is no SVG.
pub fn svg_size(text: &str) -> Option<(f64, f64)> {
    let tree = tree::read(text, &Fonts::default()).ok()?;
    let size = tree.size();
    Some((f64::from(size.width()), f64::from(size.height())))
}

/// A document of pages, a pixel being so many millimetres.
fn document(
    sheets: &[Sheet<'_>],
    mm_per_pixel: f64,
    heading: &Heading<'_>,
    fonts: &Fonts,
) -> Result<Vec<u8>, PdfError> {
    let mut document = Document::new();
    document.set_metadata(
        Metadata::new()
            .title(line(heading.title))
            .description(heading.description.to_owned())
            .language("en".to_owned())
            .creator("drystone".to_owned())
            .producer("drystone".to_owned()),
    );
    let mut tags = TagTree::new();
    let mut known = Vec::new();
    for sheet in sheets {
        let (width, height) = (mm_per_pixel * sheet.width, mm_per_pixel * sheet.height);
        let fits = |side: f64| (MIN_SIDE_MM..=MAX_SIDE_MM).contains(&side);
        if !(fits(width) && fits(height)) {
            return Err(PdfError::Size { width, height });
        }
        let points = |mm: f64| (mm * POINTS_PER_INCH / MM_PER_INCH) as f32;
        let page = PageSettings::from_wh(points(width), points(height))
            .ok_or(PdfError::Size { width, height })?;
        let scale = points(width) / sheet.width as f32;
        let mut page = document.start_page_with(page);
        let mut surface = page.surface();
        for part in &sheet.parts {
            let (text, heading) = match part.content {
                Content::Drawing(drawing) => {
                    let words = [line(&drawing.title), line(&drawing.description)];
                    (Cow::Owned(svg::write(drawing)), words.join(". "))
                }
                Content::Svg(text, shows) => (Cow::Borrowed(text), line(shows)),
            };
            let tree = tree::read(&text, fonts).map_err(PdfError::Write)?;
            let figure = surface.start_tagged(ContentTag::Other);
            let (x, y) = (scale * part.at.x as f32, scale * part.at.y as f32);
            let own = scale * part.scale as f32;
            surface.push_transform(&Transform::from_row(own, 0.0, 0.0, own, x, y));
            let mut pen = PdfPainter {
                surface: &mut surface,
                fonts: std::mem::take(&mut known),
            };
            pen.group(tree.root());
            known = pen.fonts;
            surface.pop();
            surface.end_tagged();
            tags.push(TagGroup::with_children(
                Tag::Figure(Some(heading)),
                vec![figure.into()],
            ));
        }
        surface.finish();
        page.finish();
    }
    document.set_tag_tree(tags);
    document
        .finish()
        .map_err(|e| PdfError::Write(e.to_string()))
}

struct PdfPainter<'s, 'd> {
    surface: &'s mut Surface<'d>,
    fonts: Vec<(Face, Font)>,
}

impl PdfPainter<'_, '_> {
    fn group(&mut self, group: &usvg::Group) {
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
                // A drawing has none.
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
        // Of two paints PDF always puts the line on top, and we mostly want it below.
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
            let (fill, stroke) = (
                span.fill.as_ref().and_then(fill),
                span.stroke.as_ref().and_then(stroke),
            );
            for run in tree::runs(span) {
                let Some(font) = self.font(run.face) else {
                    continue;
                };
                for (fill, stroke) in passes(fill.clone(), stroke.clone(), span.paint_order) {
                    // The seam around letters is drawn as outlines, so that no word is there twice.
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
        self.surface
            .draw_glyphs(at, &glyphs, font, &words, size, outlined);
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

/// The paints in the order in which they are laid on: each once, the fill last where it is to lie over the line.
fn passes(
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
        // A drawing has plain colours only.
        _ => None,
    }
}

fn share(share: usvg::Opacity) -> NormalizedF32 {
    NormalizedF32::new(share.get()).unwrap_or(NormalizedF32::ONE)
}

fn fill(of: &usvg::Fill) -> Option<Fill> {
    Some(Fill {
        paint: paint(of.paint())?,
        opacity: share(of.opacity()),
        rule: match of.rule() {
            usvg::FillRule::NonZero => FillRule::NonZero,
            usvg::FillRule::EvenOdd => FillRule::EvenOdd,
        },
    })
}

fn stroke(of: &usvg::Stroke) -> Option<Stroke> {
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
        dash: of.dasharray().map(|array| StrokeDash {
            array: array.to_vec(),
            offset: of.dashoffset(),
        }),
    })
}

fn transform(t: usvg::Transform) -> Transform {
    Transform::from_row(t.sx, t.ky, t.kx, t.sy, t.tx, t.ty)
}

/// The outlines of all shapes of a group, as one.
fn outline_of(group: &usvg::Group) -> Option<Path> {
    let mut pen = PathBuilder::new();
    for node in group.children() {
        if let usvg::Node::Path(path) = node {
            put(&mut pen, path.data());
        }
    }
    pen.finish()
}

fn outline(data: &resvg::tiny_skia::Path) -> Option<Path> {
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
