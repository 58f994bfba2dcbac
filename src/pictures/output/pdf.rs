//! [`write()`] writes a drawing as a PDF of one page, and [`write_sheets`] writes a PDF of several pages. Both use
//! vector graphics and searchable text.
//!
//! The PDF is made from the SVG, as the PNG is, so all show the same picture. Only this file and its folder use
//! krilla. The built-in fonts are embedded, reduced to the glyphs that are used. The file contains no date and no
//! data of the machine: the same drawing gives the same bytes.

mod painter;

use std::borrow::Cow;
use std::num::NonZeroU16;

use krilla::Document;
use krilla::annotation::{Annotation, LinkAnnotation, Target};
use krilla::destination::{Destination, XyzDestination};
use krilla::embed::{AssociationKind, EmbeddedFile, MimeType};
use krilla::geom::{Point, Rect, Transform};
use krilla::metadata::Metadata;
use krilla::outline::{Outline, OutlineNode};
use krilla::page::PageSettings;
use krilla::surface::Surface;
use krilla::tagging::{Artifact, ArtifactType, ContentTag, Node, TableHeaderScope, Tag, TagGroup, TagTree};
use krilla::text::Font;
use resvg::usvg;

use painter::PdfPainter;

use super::fonts::Fonts;
use super::{MM_PER_INCH, PIXELS_PER_INCH, svg, tree};
use crate::pictures::drawing::{Drawing, Face, PagePoint, PageRect};
use crate::text::line;

/// Why a PDF could not be written.
#[derive(Debug, thiserror::Error)]
pub enum PdfError {
    /// The page would be too large or too small.
    #[error(
        "a page of {width:.4} × {height:.4} mm is out of range; each side must be {MIN_SIDE_MM} to {MAX_SIDE_MM} mm long. \
         Choose another width"
    )]
    Size {
        /// Requested width, mm.
        width: f64,
        /// Height for this width, mm.
        height: f64,
    },
    /// The PDF writer failed.
    #[error("the drawing cannot be written as PDF: {0}")]
    Write(String),
}

/// Shortest side of a page, mm.
pub const MIN_SIDE_MM: f64 = 2.0;
/// Longest side of a page, mm. PDF viewers do not open pages of more than 14 400 points.
pub const MAX_SIDE_MM: f64 = 5080.0;

/// Points per inch.
const POINTS_PER_INCH: f64 = 72.0;

/// Writes a drawing as a PDF of one page. `width_mm` is the width of the page in millimetres. If it is `None`, one
/// pixel of the drawing is 1/96 inch.
///
/// # Errors
/// Returns [`PdfError::Size`] if a side of the page would be shorter than [`MIN_SIDE_MM`] or longer than
/// [`MAX_SIDE_MM`]; returns [`PdfError::Write`] if the PDF writer fails.
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
    write_in(drawing, width_mm, &Fonts::default(), None)
}

/// Like [`write()`], with additional fonts. A line of text that needs an additional font is drawn as outlines. The scene
/// file `source` becomes the attachment `scene.json`.
///
/// # Errors
/// See [`write()`].
pub fn write_in(
    drawing: &Drawing,
    width_mm: Option<f64>,
    fonts: &Fonts,
    source: Option<&[u8]>,
) -> Result<Vec<u8>, PdfError> {
    let natural_mm = drawing.width * MM_PER_INCH / PIXELS_PER_INCH;
    let width = width_mm.unwrap_or(natural_mm);
    let sheet = Sheet {
        width: drawing.width,
        height: drawing.height,
        parts: vec![Inset { content: Content::Drawing(drawing), at: PagePoint::new(0.0, 0.0), scale: 1.0 }],
        links: Vec::new(),
    };
    let heading = Heading { title: &drawing.title, description: &drawing.description };
    document(&[sheet], width / drawing.width, &heading, &[], fonts, source)
}

/// The content of an inset.
#[derive(Clone, Copy, Debug)]
pub enum Content<'d> {
    /// A drawing.
    Drawing(&'d Drawing),
    /// An SVG of this crate, such as a chart, and a description for screen readers.
    Svg(&'d str, &'d str),
    /// A drawing of groups with the ids `e0`, `e1`, …, and the role of each group.
    Tagged(&'d Drawing, &'d [Role]),
}

/// The role of a group on a page, for screen readers.
#[derive(Clone, Debug, PartialEq)]
pub enum Role {
    /// An item that screen readers skip: a line or a page number.
    Artifact,
    /// A heading with its level, from 1, and its text.
    Heading(u8, String),
    /// A paragraph.
    Paragraph,
    /// A cell of a table.
    Cell {
        /// The number of the table. Neighbouring tables must have different numbers.
        table: usize,
        /// The number of the row in the table.
        row: usize,
        /// Whether it is a column header.
        head: bool,
    },
}

/// A link to a page of the same document.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// The area of the link, pixels.
    pub place: PageRect,
    /// The page, counted from 0.
    pub page: usize,
    /// A description of its target.
    pub words: String,
}

/// An entry in the list of bookmarks of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Bookmark {
    /// The level of the bookmark. A bookmark is part of the last bookmark before it that has a lower level.
    pub level: u8,
    /// Its title.
    pub title: String,
    /// The page, counted from 0.
    pub page: usize,
    /// The position on the page, pixels from the top.
    pub y: f64,
}

/// A drawing or a chart at its position on a page.
#[derive(Clone, Copy, Debug)]
pub struct Inset<'d> {
    /// The drawing or chart.
    pub content: Content<'d>,
    /// The position of its upper left corner, pixels of the page.
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
    /// The drawings on it, the lowest first.
    pub parts: Vec<Inset<'d>>,
    /// Its links.
    pub links: Vec<Link>,
}

/// The metadata of a document.
#[derive(Clone, Copy, Debug)]
pub struct Heading<'t> {
    /// Its title.
    pub title: &'t str,
    /// A description in sentences.
    pub description: &'t str,
}

/// Writes a PDF with several pages. One pixel is 1/96 inch. `heading` is the metadata of the document.
///
/// # Errors
/// See [`write()`]; each page is checked.
pub fn write_sheets(sheets: &[Sheet<'_>], heading: &Heading<'_>, bookmarks: &[Bookmark]) -> Result<Vec<u8>, PdfError> {
    let natural = MM_PER_INCH / PIXELS_PER_INCH;
    document(sheets, natural, heading, bookmarks, &Fonts::default(), None)
}

/// Returns the width and height of an SVG in pixels, or `None` if the text is not a valid SVG.
pub fn svg_size(text: &str) -> Option<(f64, f64)> {
    let tree = tree::read(text, &Fonts::default()).ok()?;
    let size = tree.size();
    Some((f64::from(size.width()), f64::from(size.height())))
}

/// Writes a PDF with several pages. `mm_per_pixel` is the length of a pixel in millimetres. `source` is a scene file, which
/// is attached.
fn document(
    sheets: &[Sheet<'_>],
    mm_per_pixel: f64,
    heading: &Heading<'_>,
    bookmarks: &[Bookmark],
    fonts: &Fonts,
    source: Option<&[u8]>,
) -> Result<Vec<u8>, PdfError> {
    let mut document = Document::new();
    if let Some(file) = source {
        document.embed_file(EmbeddedFile {
            path: "scene.json".into(),
            mime_type: MimeType::new("application/json"),
            description: None,
            association_kind: AssociationKind::Source,
            data: file.to_vec().into(),
            modification_date: None,
            compress: Some(true),
            location: None,
        });
    }
    document.set_metadata(
        Metadata::new()
            .title(line(heading.title))
            .description(heading.description.to_owned())
            .language("en".to_owned())
            .creator("drystone".to_owned())
            .producer("drystone".to_owned()),
    );
    let mut tags = Vec::new();
    let mut known = Vec::new();
    for sheet in sheets {
        let (width, height) = (mm_per_pixel * sheet.width, mm_per_pixel * sheet.height);
        let fits = |side: f64| (MIN_SIDE_MM..=MAX_SIDE_MM).contains(&side);
        if !(fits(width) && fits(height)) {
            return Err(PdfError::Size { width, height });
        }
        let settings = PageSettings::from_wh(points(width), points(height)).ok_or(PdfError::Size { width, height })?;
        let scale = points(width) / sheet.width as f32;
        let mut page = document.start_page_with(settings);
        let mut surface = page.surface();
        for part in &sheet.parts {
            inset(&mut surface, part, scale, fonts, &mut known, &mut tags)?;
        }
        surface.finish();
        for link in &sheet.links {
            let id = page.add_tagged_annotation(annotation(link, scale));
            let tag = TagGroup::with_children(Tag::Link, vec![id.into()]);
            tags.push((None, tag.into()));
        }
        page.finish();
    }
    let mut tree = TagTree::new();
    grouped(tags).into_iter().for_each(|node| tree.push(node));
    document.set_tag_tree(tree);
    let scale = points(mm_per_pixel);
    if !bookmarks.is_empty() {
        document.set_outline(outline(bookmarks, scale));
    }
    document.finish().map_err(|e| PdfError::Write(e.to_string()))
}

fn points(mm: f64) -> f32 {
    (mm * POINTS_PER_INCH / MM_PER_INCH) as f32
}

fn annotation(link: &Link, scale: f32) -> Annotation {
    let PageRect { at, width, height } = link.place;
    let (x, y) = (scale * at.x as f32, scale * at.y as f32);
    let (wide, high) = (scale * width as f32, scale * height as f32);
    // Make each side of the link at least one point long, because krilla does not accept an empty rectangle.
    let area = Rect::from_xywh(x, y, wide.max(1.0), high.max(1.0));
    let top = XyzDestination::new(link.page, Point::from_xy(0.0, 0.0));
    let target = Target::Destination(Destination::Xyz(top));
    let area = area.unwrap_or_else(|| Rect::from_xywh(0.0, 0.0, 1.0, 1.0).expect("an area of one point is not empty"));
    Annotation::new_link(LinkAnnotation::new(area, target), Some(line(&link.words)))
}

/// The tagged contents of a document in reading order, each with its role if it has one.
type Tags = Vec<(Option<Role>, Node)>;

/// Draws a drawing or chart on a page, and appends its tags for screen readers to `tags`. `scale` is in points per
/// pixel. `known` contains the fonts that are already in the document; further fonts are added to it.
fn inset(
    surface: &mut Surface<'_>,
    part: &Inset<'_>,
    scale: f32,
    fonts: &Fonts,
    known: &mut Vec<(Face, Font)>,
    tags: &mut Tags,
) -> Result<(), PdfError> {
    let drawn = |drawing: &Drawing| {
        let words = [line(&drawing.title), line(&drawing.description)];
        (Cow::Owned(svg::write(drawing)), words.join(". "))
    };
    let (text, shows) = match part.content {
        Content::Drawing(drawing) | Content::Tagged(drawing, _) => drawn(drawing),
        Content::Svg(text, shows) => (Cow::Borrowed(text), line(shows)),
    };
    let tree = tree::read(&text, fonts).map_err(PdfError::Write)?;
    let (x, y) = (scale * part.at.x as f32, scale * part.at.y as f32);
    let own = scale * part.scale as f32;
    let place = Transform::from_row(own, 0.0, 0.0, own, x, y);
    let mut tagged = |content: &mut dyn FnMut(&mut PdfPainter<'_, '_>), tag: ContentTag<'_>| {
        let id = surface.start_tagged(tag);
        surface.push_transform(&place);
        let mut pen = PdfPainter { surface: &mut *surface, fonts: std::mem::take(known) };
        content(&mut pen);
        *known = pen.fonts;
        surface.pop();
        surface.end_tagged();
        id
    };
    let Content::Tagged(_, roles) = part.content else {
        let figure = tagged(&mut |pen| pen.group(tree.root()), ContentTag::Other);
        let group = TagGroup::with_children(Tag::Figure(Some(shows)), vec![figure.into()]);
        tags.push((None, group.into()));
        return Ok(());
    };
    for node in tree.root().children() {
        let usvg::Node::Group(group) = node else {
            continue;
        };
        let number = group.id().rsplit("-e").next().and_then(|n| n.parse::<usize>().ok());
        let role = number.and_then(|n| roles.get(n)).unwrap_or(&Role::Artifact);
        let tag = match role {
            Role::Artifact => ContentTag::Artifact(Artifact::with_kind(ArtifactType::Layout)),
            _ => ContentTag::Other,
        };
        let id = tagged(&mut |pen| pen.group(group), tag);
        if *role != Role::Artifact {
            tags.push((Some(role.clone()), id.into()));
        }
    }
    Ok(())
}

/// The rows of a table: the number and the cells of each.
type Rows = Vec<(usize, Vec<Node>)>;

/// Builds the tag tree of a document: joins consecutive cells into rows, and rows into tables.
fn grouped(tags: Tags) -> Vec<Node> {
    let mut nodes = Vec::new();
    // The table whose cells are being collected: the number of the table, and its rows with their numbers.
    let mut open: Option<(usize, Rows)> = None;
    for (role, content) in tags {
        if let Some(Role::Cell { table, row, head }) = role {
            let cell: Node = if head {
                TagGroup::with_children(Tag::TH(TableHeaderScope::Column), vec![content]).into()
            } else {
                TagGroup::with_children(Tag::TD, vec![content]).into()
            };
            if open.as_ref().is_none_or(|o| o.0 != table) {
                nodes.extend(open.take().map(table_of));
                open = Some((table, Vec::new()));
            }
            if let Some((_, rows)) = &mut open {
                match rows.last_mut() {
                    Some((number, cells)) if *number == row => cells.push(cell),
                    _ => rows.push((row, vec![cell])),
                }
            }
            continue;
        }
        nodes.extend(open.take().map(table_of));
        nodes.push(match role {
            Some(Role::Heading(level, words)) => {
                let level = NonZeroU16::new(u16::from(level)).unwrap_or(NonZeroU16::MIN);
                TagGroup::with_children(Tag::Hn(level, Some(words)), vec![content]).into()
            }
            Some(_) => TagGroup::with_children(Tag::P, vec![content]).into(),
            None => content,
        });
    }
    nodes.extend(open.take().map(table_of));
    nodes
}

fn table_of((_, rows): (usize, Vec<(usize, Vec<Node>)>)) -> Node {
    let rows = rows.into_iter().map(|(_, cells)| TagGroup::with_children(Tag::TR, cells).into());
    TagGroup::with_children(Tag::Table, rows.collect()).into()
}

/// Builds the tree of bookmarks from the list of bookmarks and their levels. `scale` is in points per pixel.
fn outline(bookmarks: &[Bookmark], scale: f32) -> Outline {
    let mut outline = Outline::new();
    let mut rest = bookmarks;
    while let Some((node, after)) = branch(rest, scale) {
        outline.push_child(node);
        rest = after;
    }
    outline
}

/// Returns the node of the first bookmark, with all bookmarks of its subtree, and the remaining bookmarks. Returns
/// `None` for an empty list. `scale` is in points per pixel.
fn branch(bookmarks: &[Bookmark], scale: f32) -> Option<(OutlineNode, &[Bookmark])> {
    let (first, mut rest) = bookmarks.split_first()?;
    let place = Point::from_xy(0.0, scale * first.y as f32);
    let mut node = OutlineNode::new(first.title.clone(), XyzDestination::new(first.page, place));
    while rest.first().is_some_and(|next| next.level > first.level) {
        let (child, after) = branch(rest, scale)?;
        node.push_child(child);
        rest = after;
    }
    Some((node, rest))
}
