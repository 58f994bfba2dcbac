//! [`SvgWalk`]: visits the elements of an SVG and adds the shapes to a draft.

use std::collections::BTreeMap;

use roxmltree::Node;
use simplecss::StyleSheet;

use super::context::{Context, UseElement};
use super::name::{self, Lines};
use super::style::{self, Style};
use super::viewport;
use super::xml::{SVG, is, is_never_drawn};
use super::{MAX_RULE_MATCHES, element, weight};
use crate::geometry::{Bounds, Point, Vector};
use crate::sources::import::draft::{Draft, Role, Scale};
use crate::sources::import::naming::Naming;
use crate::sources::import::subpath::{Affine, Subpath};

const XLINK_NAMESPACE: &str = "http://www.w3.org/1999/xlink";
/// The largest nesting depth of groups and copies; deeper files could overflow the stack.
pub(super) const MAX_DEPTH: usize = 100;
/// The largest number of corners of clip paths, each as often as it clips.
pub(super) const MAX_CLIP_CORNERS: usize = 500_000;
/// The largest number of elements, copies included. Copies of copies can grow exponentially.
const MAX_ELEMENTS: usize = 500_000;

/// Returns the reference of a `<use>` element.
fn reference<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute("href").or_else(|| node.attribute((XLINK_NAMESPACE, "href")))
}

/// The state of a walk over the elements of an SVG.
pub(super) struct SvgWalk<'a, 'd> {
    pub(super) sheet: StyleSheet<'a>,
    pub(super) naming: &'a Naming<'a>,
    pub(super) ids: BTreeMap<&'a str, Node<'a, 'd>>,
    pub(super) lines: Lines,
    pub(super) draft: Draft,
    /// The largest number of comparisons of one element with the style rules.
    pub(super) comparisons: usize,
    /// Whether style rules have transforms.
    pub(super) moves: bool,
    /// Whether selectors read all attributes.
    pub(super) reads_all: bool,
    /// The number of visited elements.
    pub(super) seen: usize,
    /// The number of comparisons of style rules with these elements.
    pub(super) styled: usize,
    /// The number of shapes beyond the limit.
    pub(super) more: usize,
    /// The number of corners of all clip paths, each as often as it clips.
    pub(super) clip_corners: usize,
}

impl<'a, 'd> SvgWalk<'a, 'd> {
    /// Reads an SVG that is not a figure of drystone.
    pub(super) fn drawing(&mut self, root: Node<'a, 'd>, scale: Scale) -> Result<(), String> {
        let page = viewport::page(root);
        let (scale, note) = scale.of(page.unit, "it has no size in mm, cm, in or pt")?;
        self.draft.notes.push(note);
        self.draft.unit = scale;
        // The lower left corner of the page becomes the origin, as in the rulers of Inkscape.
        let map = Affine([scale, 0.0, 0.0, -scale, -scale * page.left, scale * page.bottom]);
        let style = Style::ROOT.of_child(root, &self.sheet);
        let around = Context::of_page(map, style, page.viewport);
        self.children(root, &around);
        let corner = map.point(Point::new(page.left, page.bottom));
        let size = Vector::new(page.viewport.width, page.viewport.height) * scale;
        self.draft.page = Some(Bounds { min: corner, max: corner + size });
        Ok(())
    }

    fn children(&mut self, node: Node<'a, 'd>, around: &Context) {
        for child in node.children().filter(Node::is_element) {
            self.element(child, around);
        }
    }

    fn element(&mut self, node: Node<'a, 'd>, around: &Context) {
        if node.tag_name().namespace().is_some_and(|n| n != SVG) {
            return;
        }
        let tag = node.tag_name().name();
        if is_never_drawn(tag) || (tag == "symbol" && around.copy.is_none()) {
            return;
        }
        if self.is_beyond_limits(node, around) {
            return;
        }
        let style = around.style.of_child(node, &self.sheet);
        let kind = name::all_names(node).find_map(|n| self.naming.role(&n)).or(around.kind);
        if !style.displayed {
            self.skip(node, around, "it is hidden");
            return;
        }
        if kind == Some(Role::Ignored) {
            self.skip(node, around, self.naming.why_ignored());
            return;
        }
        if style.masked {
            let why = "masks are not supported; the whole outline is imported";
            let help = "cut the outline itself";
            self.remark(node, around, why, help);
        }
        let mut inner = Context {
            map: around.map.after(&self.transform(node, around)),
            style,
            kind,
            depth: around.depth + 1,
            ..around.clone()
        };
        if style.clipped {
            match self.clip(node, &inner) {
                Some(clip) => inner.clips.push(clip),
                None => {
                    let why = "its clip path is not a single outline; the whole outline is imported";
                    self.remark(node, around, why, "cut the outline itself");
                }
            }
        }
        self.draw(node, around, inner);
    }

    /// Returns the outline of the clip path of an element, in metres. `None` if the clip path does not consist of one
    /// closed outline in the coordinates of the element.
    fn clip(&mut self, node: Node<'a, 'd>, inner: &Context) -> Option<Subpath> {
        let clip = *self.ids.get(style::clip_reference(node, &self.sheet)?)?;
        let in_box = clip.attribute("clipPathUnits") == Some("objectBoundingBox");
        if !is(clip, "clipPath") || in_box || clip.has_attribute("clip-path") {
            return None;
        }
        let mut shapes = clip.children().filter(Node::is_element);
        let (mut shape, None) = (shapes.next()?, shapes.next()) else {
            return None;
        };
        let mut map = inner.map.after(&self.transform(clip, inner)).after(&self.transform(shape, inner));
        if is(shape, "use") {
            shape = self.copied(shape).filter(|target| target.children().all(|c| !c.is_element()))?;
            map = map.after(&self.transform(shape, inner));
        }
        let subpaths = element::subpaths(shape, inner.viewport).ok()?;
        let [subpath] = subpaths.as_slice() else { return None };
        (subpath.segments.len() > 1 || subpath.has_curves()).then(|| Subpath { closed: true, ..subpath.mapped(&map) })
    }

    /// Returns the element to which a `<use>` element refers; `None` if there is none.
    fn copied(&self, node: Node<'a, 'd>) -> Option<Node<'a, 'd>> {
        reference(node).and_then(|r| r.trim().strip_prefix('#')).and_then(|id| self.ids.get(id).copied())
    }

    /// True if an element draws letters as outlines: a group with an id such as `text_3`, as matplotlib writes it, or a copy
    /// of a letter, with an id such as `glyph-0-1`, as cairo writes it.
    fn is_text(&self, node: Node<'a, 'd>) -> bool {
        let is_count = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        let has_id = |node: Node<'_, '_>, is: &dyn Fn(&str) -> bool| node.attribute("id").is_some_and(is);
        (is(node, "g") && has_id(node, &|id| id.strip_prefix("text_").is_some_and(is_count)))
            || (is(node, "use")
                && self.copied(node).is_some_and(|letter| has_id(letter, &|id| id.starts_with("glyph"))))
    }

    /// Counts an element. Returns true if the element exceeds a limit: on the comparisons with style rules, for which the
    /// drawing is refused, or, with a remark, on the number of elements or on the nesting depth.
    fn is_beyond_limits(&mut self, node: Node<'a, 'd>, around: &Context) -> bool {
        self.seen += 1;
        self.styled = self.styled.saturating_add(self.comparisons.saturating_mul(weight(node, self.reads_all)));
        if self.styled > MAX_RULE_MATCHES {
            return true;
        }
        if self.seen > MAX_ELEMENTS {
            let why = format!("the drawing has more than {MAX_ELEMENTS} elements, copies included");
            self.lose("element", node, around, &why, "");
            return true;
        }
        if around.depth >= MAX_DEPTH {
            let why = format!("groups are nested more than {MAX_DEPTH} levels deep");
            self.lose("element", node, around, &why, "ungroup them");
            return true;
        }
        false
    }

    /// Reads an element and its children. `around` is the context around the element, and `inner` also has the
    /// element's own properties.
    fn draw(&mut self, node: Node<'a, 'd>, around: &Context, mut inner: Context) {
        let tag = node.tag_name().name();
        match tag {
            _ if self.is_text(node) => {
                let help = "if it should become blocks, give it another id";
                self.lose("text", node, around, "a text cannot become a block", help);
            }
            "g" | "a" | "switch" | "svg" | "symbol" => {
                if let Some(name) = name::user_name(node).filter(|_| !name::is_layer(node)) {
                    inner.group = Some(name);
                }
                match tag {
                    "svg" | "symbol" => {
                        inner.enter(node);
                        self.children(node, &inner);
                    }
                    "switch" => {
                        let first = node.children().find(|c| {
                            c.is_element() && !is(*c, "foreignObject") && c.attribute("requiredExtensions").is_none()
                        });
                        first.into_iter().for_each(|c| self.element(c, &inner));
                    }
                    _ => self.children(node, &inner),
                }
            }
            "use" => self.copy(node, inner),
            "text" | "flowRoot" => self.lose(
                "text",
                node,
                around,
                "a text cannot become a block",
                "convert it to paths if it should become blocks, or give its layer a name that begins with ignore",
            ),
            "image" => self.lose(
                "image",
                node,
                around,
                "an image has no outlines",
                "trace it, or give its layer a name that begins with ignore",
            ),
            "rect" | "circle" | "ellipse" | "polygon" | "polyline" | "path" | "line" => {
                self.shape(node, &inner);
            }
            _ => {
                self.lose("element", node, around, &format!("<{tag}> is not a known element"), "");
            }
        }
    }

    /// Reads the element to which a `<use>` element refers.
    fn copy(&mut self, node: Node<'a, 'd>, mut inner: Context) {
        let Some(target) = self.copied(node) else {
            let why = format!("it copies {}, which does not exist", reference(node).unwrap_or("nothing"));
            self.lose("element", node, &inner, &why, "");
            return;
        };
        if node == target || node.ancestors().any(|a| a == target) {
            self.lose("element", node, &inner, "it copies itself", "");
            return;
        }
        let (x, y) =
            (viewport::length(node, "x", inner.viewport.width), viewport::length(node, "y", inner.viewport.height));
        inner.map = inner.map.after(&Affine::translation(x.unwrap_or(0.0), y.unwrap_or(0.0)));
        if inner.copy.is_none() {
            inner.copy = Some(UseElement { element: self.lines.element(node), name: name::user_name(node) });
        }
        if matches!(target.tag_name().name(), "svg" | "symbol") {
            // A `<use>` element may set the size of the symbol that it copies.
            inner.viewport.copied = (
                viewport::length(node, "width", inner.viewport.width),
                viewport::length(node, "height", inner.viewport.height),
            );
        }
        self.element(target, &inner);
    }

    /// Returns the description of an element for messages. For a copy, this is the description of its `<use>` element.
    pub(super) fn element_label(&self, node: Node<'a, 'd>, around: &Context) -> String {
        match &around.copy {
            Some(copy) => copy.element.clone(),
            None => self.lines.element(node),
        }
    }

    /// Notes that an element is left out on purpose, with the reason.
    pub(super) fn skip(&mut self, node: Node<'a, 'd>, around: &Context, why: &str) {
        let element = self.element_label(node, around);
        self.draft.skip(why, element);
    }

    /// Reports an element that is left out, and counts it as one `what`.
    pub(super) fn lose(&mut self, what: &'static str, node: Node<'a, 'd>, around: &Context, why: &str, help: &str) {
        let element = self.element_label(node, around);
        self.draft.lose(what, &element, why, help);
    }

    /// Adds a remark about an element that is imported, but not exactly as drawn.
    pub(super) fn remark(&mut self, node: Node<'a, 'd>, around: &Context, message: &str, help: &str) {
        let element = self.element_label(node, around);
        self.draft.remark(element, message, help);
    }
}
