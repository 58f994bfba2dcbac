//! [`write()`] writes a drawing as an SVG document. The document only uses features that resvg and browsers draw in the
//! same way.
//!
//! Attributes have a fixed order, and one function formats all numbers, so the same drawing gives the same bytes. Ids
//! of elements begin with a mark that the options give, or otherwise with a hash of the drawing, so that several
//! figures can be on one page.

#[cfg(feature = "embed")]
mod font;
mod outline;
#[cfg(feature = "report")]
mod pair;
mod words;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::fmt::Write as _;

use outline::{number, steps};

use super::fonts::Fonts;
#[cfg(feature = "png")]
use super::tree;
use crate::pictures::drawing::{Drawing, Face, Group, Item, Join, PageRect, Path, Stroke};
use crate::text::xml;

/// The error for text that could not be laid out, or for a font that could not be subset.
#[derive(Debug, thiserror::Error)]
#[error("the text of the drawing cannot be written in this form: {0}")]
pub struct OutlineError(String);

/// How text is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Words {
    /// As text, with the names of the fonts. The file is small, but its look depends on the fonts of the reader.
    #[default]
    Names,
    /// As text, with the used glyphs embedded in the file; for browsers.
    #[cfg(feature = "embed")]
    Embedded,
    /// As outlines. The file looks the same everywhere, but its text cannot be searched or edited.
    #[cfg(feature = "png")]
    Outlines,
}

/// The options of an SVG file.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Width in print, mm; for `None` one pixel is 1/96 inch.
    pub width_mm: Option<f64>,
    /// How text is written.
    pub words: Words,
    /// The fonts for text that is embedded or written as outlines.
    pub fonts: Fonts,
    /// The prefix of the ids of all elements. It consists of letters and digits. For `None`, the prefix is a hash of
    /// the drawing and the options. If a page contains the same drawing twice, each copy needs a different prefix.
    pub mark: Option<String>,
}

impl Options {
    setters! {
        words: Words, "How text is written.";
        fonts: Fonts, "The fonts for text that is embedded or written as outlines.";
    }

    optional_setters! {
        width_mm: f64, "Width in print, mm.";
        mark: String, "The prefix of the ids of all elements, of letters and digits.";
    }
}

/// Writes a drawing as an SVG document. Text is written as text, not as outlines.
///
/// # Panics
/// Panics if a number of the drawing is not finite. No valid scene causes this.
///
/// # Example
/// ```
/// use drystone::drawing::{Colour, Drawing, Outline, PagePoint, Path};
/// let mark = Path::filled(Outline::circle(PagePoint::new(6.0, 2.5), 2.0), Colour::BLACK);
/// let drawing = Drawing {
///     width: 12.0,
///     height: 5.0,
///     title: "A dot & no more".into(),
///     description: String::new(),
///     background: None,
///     items: vec![mark.into()],
/// };
/// let svg = drystone::output::svg::write(&drawing);
/// assert!(svg.contains("viewBox=\"0 0 12 5\"") && svg.contains("A dot &amp; no more"));
/// ```
pub fn write(drawing: &Drawing) -> String {
    let mark = mark_of(drawing, &Options::default());
    document(drawing, None, &mark, Form::Names)
}

/// Like [`write()`], for a drawing that is converted to pixels. All ids begin with `d`, because no other figure is on
/// the same page. To save time, titles and descriptions are left out, and groups without a clip path are written
/// without a `<g>` element.
#[cfg(all(feature = "cli", feature = "png"))]
pub(crate) fn for_pixels(drawing: &Drawing) -> String {
    document(drawing, None, "d", Form::Pixels)
}

/// Like [`write()`], but each line of text has an id: `t` and its number in the order of drawing (`t1`, `t2` …).
#[cfg(feature = "png")]
pub(super) fn numbered(drawing: &Drawing) -> String {
    document(drawing, None, "", Form::Numbered)
}

/// Writes a drawing as an SVG document with options. The options can set the width in print, and can make text
/// independent of the fonts that a reader has installed.
///
/// # Errors
/// Returns [`OutlineError`] if the text of the drawing cannot be laid out or a font cannot be subset.
///
/// # Panics
/// See [`write()`].
///
/// # Example
/// ```
/// use drystone::drawing::{Colour, Drawing, Face, PagePoint, Text};
/// use drystone::output::svg::{Options, Words, write_with};
/// let words = Text::new(PagePoint::new(5.0, 20.0), "Keystone", Face::Serif, 14.0, Colour::BLACK);
/// let drawing = Drawing { width: 120.0, height: 30.0, title: "A word".into(), description: String::new(),
///     background: None, items: vec![words.into()] };
/// let svg = write_with(&drawing, &Options::default().width_mm(84.0).words(Words::Outlines))?;
/// assert!(svg.contains("width=\"84mm\" height=\"21mm\" viewBox=\"0 0 120 30\""));
/// assert!(!svg.contains("<text"));
/// # Ok::<(), drystone::output::svg::OutlineError>(())
/// ```
pub fn write_with(drawing: &Drawing, options: &Options) -> Result<String, OutlineError> {
    let mark = mark_of(drawing, options);
    match options.words {
        Words::Names => Ok(document(drawing, options.width_mm, &mark, Form::Names)),
        #[cfg(feature = "embed")]
        Words::Embedded => {
            let tree = laid_out(drawing, options)?;
            let texts = tree::texts(tree.root());
            let spans = texts.iter().flat_map(|text| text.layouted());
            let runs: Vec<tree::Run> = spans.flat_map(tree::runs).collect();
            let sheet = font::embedded(&runs, &mark).map_err(OutlineError)?;
            let form = Form::Embedded(&sheet);
            Ok(document(drawing, options.width_mm, &mark, form))
        }
        #[cfg(feature = "png")]
        Words::Outlines => {
            let tree = laid_out(drawing, options)?;
            let texts = tree::texts(tree.root());
            let outlines = texts.iter().filter_map(|t| outline::numbered(t)).collect();
            let form = Form::Outlines(&outlines);
            Ok(document(drawing, options.width_mm, &mark, form))
        }
    }
}

/// Writes a figure in a light and a dark theme as one SVG document, which follows the colours that a reader prefers. The
/// drawings may differ only in colours.
#[cfg(feature = "report")]
pub(crate) fn write_pair(light: &Drawing, dark: &Drawing, options: &Options) -> Result<String, OutlineError> {
    let mark = mark_of(light, options);
    let options = options.clone().mark(mark.clone());
    let [light, dark] = [write_with(light, &options)?, write_with(dark, &options)?];
    pair::merged(&light, &dark, &mark).ok_or_else(|| OutlineError("the themes differ in more than colours".into()))
}

/// Lays out all text of the drawing. Returns the drawing as a tree in which the lines of text have the ids `t1`, `t2` …
#[cfg(feature = "png")]
fn laid_out(drawing: &Drawing, options: &Options) -> Result<resvg::usvg::Tree, OutlineError> {
    tree::read(&numbered(drawing), &options.fonts).map_err(OutlineError)
}

/// Returns the prefix of all ids: [`Options::mark`], or a short hash of drawing and options if no mark is set. It is
/// very unlikely that two different drawings have the same hash.
fn mark_of(drawing: &Drawing, options: &Options) -> String {
    if let Some(mark) = &options.mark {
        return mark.clone();
    }
    let form = match options.words {
        Words::Names => "",
        #[cfg(feature = "embed")]
        Words::Embedded => "embedded",
        #[cfg(feature = "png")]
        Words::Outlines => "outlines",
    };
    let text = document(drawing, options.width_mm, "", Form::Names) + form;
    format!("d{:08x}", fold(&text))
}

/// How the text of a document is written.
#[derive(Clone, Copy)]
enum Form<'f> {
    /// As text, with the names of the fonts.
    Names,
    /// Like `Names`, without anything that is not visible.
    #[cfg(all(feature = "cli", feature = "png"))]
    Pixels,
    /// Like `Names`; each line of text has an id that contains its number: `t1`, `t2` …
    #[cfg(feature = "png")]
    Numbered,
    /// As text, in the fonts of this style sheet.
    #[cfg(feature = "embed")]
    Embedded(&'f str),
    /// As path data. The map has the path data of each line of text, by the number of the line.
    #[cfg_attr(not(feature = "png"), expect(dead_code, reason = "only used if text can be laid out"))]
    Outlines(&'f BTreeMap<usize, String>),
}

/// The face of most text. Only text with other font families has an attribute `font-family`.
const DEFAULT_FACE: Face = Face::Sans;

fn document(drawing: &Drawing, width_mm: Option<f64>, mark: &str, form: Form<'_>) -> String {
    let mut svg = Writer { text: String::new(), mark, form, clips: 0, texts: 0 };
    let (w, h) = (number(drawing.width), number(drawing.height));
    let (across, down) = match width_mm {
        None => (w.clone(), h.clone()),
        Some(mm) => (format!("{}mm", number(mm)), format!("{}mm", number(mm * drawing.height / drawing.width))),
    };
    // Write attributes that most shapes and texts share only once, at the root element.
    svg.put(&format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{across}\" height=\"{down}\" viewBox=\"0 0 {w} {h}\" \
         role=\"graphics-document document\" aria-labelledby=\"{mark}-title {mark}-desc\" \
         stroke-linejoin=\"round\" stroke-linecap=\"round\" paint-order=\"stroke\" font-family=\"{}\">\n",
        svg.families(DEFAULT_FACE)
    ));
    if !svg.is_bare() {
        svg.put(&format!("<title id=\"{mark}-title\">{}</title>\n", xml(&drawing.title)));
        svg.put(&format!("<desc id=\"{mark}-desc\">{}</desc>\n", xml(&drawing.description)));
    }
    #[cfg(feature = "embed")]
    if let Form::Embedded(sheet) = form {
        svg.put(&format!("<style>\n{sheet}</style>\n"));
    }
    if let Some(colour) = drawing.background {
        svg.put(&format!("<rect width=\"{w}\" height=\"{h}\" fill=\"{}\"/>\n", colour.css()));
    }
    for item in &drawing.items {
        svg.item(item);
    }
    svg.put("</svg>\n");
    svg.text
}

struct Writer<'m> {
    text: String,
    mark: &'m str,
    form: Form<'m>,
    clips: usize,
    texts: usize,
}

impl Writer<'_> {
    fn put(&mut self, text: &str) {
        self.text.push_str(text);
    }

    fn attribute(&mut self, name: &str, value: &str) {
        // Writing to a `String` cannot fail.
        let _ = write!(self.text, " {name}=\"{value}\"");
    }

    /// True if only visible items are written, without titles and descriptions.
    fn is_bare(&self) -> bool {
        match self.form {
            #[cfg(all(feature = "cli", feature = "png"))]
            Form::Pixels => true,
            _ => false,
        }
    }

    fn item(&mut self, item: &Item) {
        match item {
            Item::Path(path) => self.path(path),
            Item::Text(text) => self.words(text),
            Item::Group(group) => self.group(group),
        }
    }

    fn group(&mut self, group: &Group) {
        let clip = group.clip.map(|rect| self.clip_path(rect));
        if self.is_bare() {
            if let Some(id) = &clip {
                self.put(&format!("<g clip-path=\"url(#{id})\">"));
            }
            group.items.iter().for_each(|item| self.item(item));
            if clip.is_some() {
                self.put("</g>");
            }
            return;
        }
        self.put("<g");
        self.group_attributes(group, clip);
        self.put(">");
        if !group.title.is_empty() {
            self.put(&format!("<title>{}</title>", xml(&group.title)));
        }
        if !group.description.is_empty() {
            self.put(&format!("<desc>{}</desc>", xml(&group.description)));
        }
        self.put("\n");
        for item in &group.items {
            self.item(item);
        }
        self.put("</g>\n");
    }

    /// Writes a clip path for a rectangle, and returns the id of the clip path.
    fn clip_path(&mut self, rect: PageRect) -> String {
        self.clips += 1;
        let id = format!("{}-clip{}", self.mark, self.clips);
        self.put(&format!(
            "<clipPath id=\"{id}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
            number(rect.at.x),
            number(rect.at.y),
            number(rect.width),
            number(rect.height)
        ));
        id
    }

    /// Writes the attributes of a group: id, class, attributes for screen readers, clip path, and scale and origin of
    /// the scene.
    fn group_attributes(&mut self, group: &Group, clip: Option<String>) {
        if let Some(id) = &group.id {
            let id = format!("{}-{}", self.mark, xml(id));
            self.attribute("id", &id);
        }
        if !group.class.is_empty() {
            self.attribute("class", &xml(&group.class));
        }
        if !group.title.is_empty() {
            // Screen readers read the parts of a group that contains titles. They treat any other group as one image.
            let is_group = holds_titles(&group.items);
            self.attribute("role", if is_group { "group" } else { "img" });
        }
        if group.echo {
            self.attribute("aria-hidden", "true");
            self.attribute("pointer-events", "none");
        }
        if let Some(id) = clip {
            self.attribute("clip-path", &format!("url(#{id})"));
        }
        if let Some(camera) = &group.camera {
            // Write pixels per metre and the position of the origin, so that the scene can be read back.
            let origin = camera.origin();
            let scale = ten_digits(camera.length(1.0));
            self.attribute("data-drystone-scale", &scale.to_string());
            let (x, y) = (ten_digits(origin.x), ten_digits(origin.y));
            self.attribute("data-drystone-origin", &format!("{x} {y}"));
        }
    }

    fn path(&mut self, path: &Path) {
        if path.outline.segments.is_empty() {
            return;
        }
        self.put("<path d=\"");
        steps(&mut self.text, &path.outline);
        self.put("\"");
        let fill = path.fill.map_or_else(|| "none".to_owned(), |c| c.css());
        self.attribute("fill", &fill);
        if let Some(stroke) = &path.stroke {
            self.stroke(stroke);
            if path.fill.is_some() && !path.fill_last {
                self.attribute("paint-order", "normal");
            }
        }
        if path.opacity < 1.0 {
            self.attribute("opacity", &number(path.opacity));
        }
        self.put("/>\n");
    }

    fn stroke(&mut self, stroke: &Stroke) {
        self.attribute("stroke", &stroke.colour.css());
        self.attribute("stroke-width", &number(stroke.width));
        if stroke.join == Join::Miter {
            self.attribute("stroke-linejoin", "miter");
            self.attribute("stroke-linecap", "butt");
        }
        if !stroke.dash.is_empty() {
            let dash: Vec<String> = stroke.dash.iter().map(|d| number(*d)).collect();
            self.attribute("stroke-dasharray", &dash.join(" "));
        }
    }
}

fn holds_titles(items: &[Item]) -> bool {
    items.iter().any(|item| matches!(item, Item::Group(g) if !g.title.is_empty() || holds_titles(&g.items)))
}

/// Returns a 32-bit hash of a text: the exclusive or of the two halves of a 64-bit hash.
fn fold(text: &str) -> u32 {
    let hash = crate::text::hash(text.as_bytes());
    (hash ^ (hash >> 32)) as u32
}

/// Rounds a number to ten significant digits.
///
/// The scale and the origin of a figure can depend on the positions of displaced blocks, which a solver computes. The
/// last digits of these positions differ between a browser and the program, but both must write the same picture.
fn ten_digits(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}
