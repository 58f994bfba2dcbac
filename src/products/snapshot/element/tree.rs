//! [`Element`]: an SVG element with the properties that are compared. No other file of this folder uses roxmltree.

use roxmltree::{Document, Node};

/// The largest nesting depth; deeper files could overflow the stack.
const MAX_DEPTH: usize = 200;

/// The reason why a text is not SVG.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SvgParseError {
    /// The file is empty.
    #[error("it is empty (0 bytes)")]
    Empty,
    /// A Git LFS pointer in place of the file.
    #[error("it is a Git LFS pointer and not the drawing; fetch it with `git lfs pull`")]
    Pointer,
    /// A file with merge conflicts.
    #[error("line {0} is a mark of a merge conflict; resolve it, or accept the drawing again")]
    Conflict(usize),
    /// Text that is not XML, or not SVG.
    #[error("it is not SVG: {0}")]
    Xml(String),
}

/// An element.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Element {
    /// The tag: `g`, `path`, `text`.
    pub tag: String,
    /// The class of the element; empty if it has no class.
    pub class: String,
    /// The text of its `<title>`, or its `aria-label`; empty if it has neither.
    pub title: String,
    /// The text of its `<desc>`; empty if it has none.
    pub description: String,
    /// The text of a `<text>` or `<style>` element; empty for all other elements.
    pub words: String,
    /// Attributes for position and size.
    pub shape: Vec<(String, String)>,
    /// All other attributes, in the order of the file.
    pub attributes: Vec<(String, String)>,
    /// The child elements.
    pub children: Vec<Element>,
}

/// Attributes for position and size.
const SHAPE_ATTRIBUTES: [&str; 13] =
    ["d", "points", "x", "y", "x1", "y1", "x2", "y2", "cx", "cy", "r", "width", "height"];
/// Attributes that are ignored: drystone derives them from the content of the whole drawing.
const IGNORED_ATTRIBUTES: [&str; 2] = ["id", "aria-labelledby"];

impl Element {
    /// Returns the value of an attribute that does not describe position or size; `None` if the element does not have
    /// it.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(n, _)| n == name);
        found.map(|(_, value)| value.as_str())
    }

    /// Returns the value of an attribute that describes position or size; `None` if the element does not have it.
    pub(super) fn place_of(&self, name: &str) -> Option<&str> {
        let found = self.shape.iter().find(|(n, _)| n == name);
        found.map(|(_, value)| value.as_str())
    }

    /// Returns the width and height of the element, for messages: `300 × 200`.
    pub(super) fn size(&self) -> String {
        let side = |name: &str| self.place_of(name).unwrap_or("?").to_owned();
        format!("{} × {}", side("width"), side("height"))
    }

    /// Returns the title up to the first colon with a space after it. The rest of the title contains numbers.
    pub(super) fn label(&self) -> &str {
        self.title.split(": ").next().unwrap_or_default()
    }

    /// Returns a name of the element for messages, such as `text "word 0"` or `path in the page`. `within` describes
    /// its parent element.
    pub(super) fn called(&self, within: &str) -> String {
        let what = if self.class.is_empty() { &self.tag } else { &self.class };
        if self.tag == "svg" {
            "the page".into()
        } else if !self.title.is_empty() {
            format!("{what} \"{}\"", self.label())
        } else if !self.words.is_empty() {
            format!("{what} \"{}\"", self.words)
        } else {
            format!("{what} in {within}")
        }
    }

    /// Returns the words with which messages locate the children of this element. These are its own name if it is the
    /// page or has a title. Otherwise they are `within`, the words that locate the element itself.
    pub(super) fn place(&self, within: &str) -> String {
        if self.tag == "svg" || !self.title.is_empty() { self.called(within) } else { within.to_owned() }
    }
}

/// Reads SVG text into a tree of elements.
pub(super) fn read(text: &str) -> Result<Element, SvgParseError> {
    if text.trim().is_empty() {
        return Err(SvgParseError::Empty);
    }
    if text.starts_with("version https://git-lfs") {
        return Err(SvgParseError::Pointer);
    }
    if let Some(line) = text.lines().position(crate::text::is_conflict_mark) {
        return Err(SvgParseError::Conflict(line + 1));
    }
    let document = Document::parse(text).map_err(|e| SvgParseError::Xml(e.to_string()))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let name = crate::text::heading(root.tag_name().name(), 40);
        return Err(SvgParseError::Xml(format!("its outermost element is {name}")));
    }
    element(root, 0)
}

fn element(node: Node<'_, '_>, depth: usize) -> Result<Element, SvgParseError> {
    if depth > MAX_DEPTH {
        return Err(SvgParseError::Xml(format!("elements are nested more than {MAX_DEPTH} levels deep")));
    }
    let mut found = Element { tag: crate::text::line(node.tag_name().name()), ..Element::default() };
    for attribute in node.attributes() {
        let (name, value) = (attribute.name(), crate::text::line(attribute.value()));
        match name {
            "class" => found.class = value,
            "aria-label" => found.title = value,
            _ if IGNORED_ATTRIBUTES.contains(&name) => {}
            _ if SHAPE_ATTRIBUTES.contains(&name) => found.shape.push((name.to_owned(), value)),
            // Ignore the id after `#`, because it depends on the content of the whole drawing. The element with this
            // id is compared separately.
            _ if value.starts_with("url(#") => found.attributes.push((name.to_owned(), "url".into())),
            _ => found.attributes.push((name.to_owned(), value)),
        }
    }
    let words = |node: Node<'_, '_>| {
        let text: String = node.descendants().filter_map(|n| n.text().filter(|_| n.is_text())).collect();
        crate::text::heading(&text, 2000)
    };
    if found.tag == "text" || found.tag == "style" {
        found.words = words(node);
        return Ok(found);
    }
    for child in node.children().filter(Node::is_element) {
        match child.tag_name().name() {
            "title" => found.title = words(child),
            "desc" => found.description = words(child),
            _ => found.children.push(element(child, depth + 1)?),
        }
    }
    Ok(found)
}
