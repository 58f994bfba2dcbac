//! [`Element`]: an element of an SVG with what can be compared of it. The only file that names roxmltree here.

use roxmltree::{Document, Node};

/// Elements may lie so deep in each other.
const DEEPEST: usize = 200;

/// A text that is no SVG.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SvgParseError {
    /// No bytes at all.
    #[error("it is empty (0 bytes)")]
    Empty,
    /// What Git LFS leaves where the file itself was not fetched.
    #[error("it is a Git LFS pointer and not the drawing; fetch it with `git lfs pull`")]
    Pointer,
    /// Two versions of it in one file.
    #[error("line {0} is a mark of a merge conflict; settle it, or accept the drawing anew")]
    Conflict(usize),
    /// No XML, or none that ends.
    #[error("it is no SVG: {0}")]
    Xml(String),
}

/// An element.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Element {
    /// `g`, `path`, `text`.
    pub tag: String,
    /// Its class; empty for none.
    pub class: String,
    /// The words of its title, or its label.
    pub title: String,
    /// The words of its description.
    pub description: String,
    /// Its words where it is text.
    pub words: String,
    /// What says where it is: path data, and the numbers that are places and sizes.
    pub shape: Vec<(String, String)>,
    /// Everything else that is drawn, in the file's order.
    pub attributes: Vec<(String, String)>,
    /// What is in it.
    pub children: Vec<Element>,
}

/// Attributes that say where an element is.
const SHAPE: [&str; 13] = [
    "d", "points", "x", "y", "x1", "y1", "x2", "y2", "cx", "cy", "r", "width", "height",
];
/// Attributes that hold names made from a drawing's content.
const LEFT_OUT: [&str; 2] = ["id", "aria-labelledby"];

impl Element {
    /// An attribute that is no place.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(n, _)| n == name);
        found.map(|(_, value)| value.as_str())
    }

    /// A place or size.
    pub(super) fn place_of(&self, name: &str) -> Option<&str> {
        let found = self.shape.iter().find(|(n, _)| n == name);
        found.map(|(_, value)| value.as_str())
    }

    /// Width and height of the page.
    pub(super) fn size(&self) -> String {
        let side = |name: &str| self.place_of(name).unwrap_or("?").to_owned();
        format!("{} × {}", side("width"), side("height"))
    }

    /// Its title without the numbers that stand behind a colon.
    pub(super) fn label(&self) -> &str {
        self.title.split(": ").next().unwrap_or_default()
    }

    /// What a person would call it.
    pub(super) fn called(&self, within: &str) -> String {
        let what = if self.class.is_empty() {
            &self.tag
        } else {
            &self.class
        };
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

    /// What a person would call the place that things in it are in.
    pub(super) fn place(&self, within: &str) -> String {
        if self.tag == "svg" || !self.title.is_empty() {
            self.called(within)
        } else {
            within.to_owned()
        }
    }
}

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
        return Err(SvgParseError::Xml(format!(
            "its outermost element is {name}"
        )));
    }
    element(root, 0)
}

fn element(node: Node<'_, '_>, depth: usize) -> Result<Element, SvgParseError> {
    if depth > DEEPEST {
        return Err(SvgParseError::Xml(format!(
            "its elements lie more than {DEEPEST} deep"
        )));
    }
    let mut found = Element {
        tag: crate::text::line(node.tag_name().name()),
        ..Element::default()
    };
    for attribute in node.attributes() {
        let (name, value) = (attribute.name(), crate::text::line(attribute.value()));
        match name {
            "class" => found.class = value,
            "aria-label" => found.title = value,
            _ if LEFT_OUT.contains(&name) => {}
            _ if SHAPE.contains(&name) => found.shape.push((name.to_owned(), value)),
            // A name made from the content again; what it names is compared itself.
            _ if value.starts_with("url(#") => {
                found.attributes.push((name.to_owned(), "url".into()))
            }
            _ => found.attributes.push((name.to_owned(), value)),
        }
    }
    let words = |node: Node<'_, '_>| {
        let text: String = node
            .descendants()
            .filter_map(|n| n.text().filter(|_| n.is_text()))
            .collect();
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
