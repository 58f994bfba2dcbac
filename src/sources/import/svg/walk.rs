//! [`SvgWalk`]: visits the elements of an SVG and adds the shapes to a draft.

use std::collections::BTreeMap;

use roxmltree::Node;
use simplecss::StyleSheet;

use super::context::{Context, UseElement};
use super::name::{self, Lines};
use super::remark::{MAX_LISTED_REMARKS, RemarkKind};
use super::style::{self, Style};
use super::viewport::{self, Viewport};
use super::xml::{SVG, is, is_never_drawn};
use super::{MAX_RULE_MATCHES, element, weight};
use crate::geometry::{Point, Vector};
use crate::sources::import::draft::{Draft, Part, PartGeometry, Role, Scale};
use crate::sources::import::naming::Naming;
use crate::sources::import::subpath::{Affine, Subpath};

const XLINK_NAMESPACE: &str = "http://www.w3.org/1999/xlink";
/// An outline is as large as the page if its corners are this close to those of the page, as a share of its diagonal.
const PAGE_TOL: f64 = 0.005;
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
    /// The number of remarks of each kind.
    pub(super) remarked: BTreeMap<RemarkKind, usize>,
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
        self.leave_page_out(map.point(Point::new(page.left, page.bottom)), page.viewport, scale);
        Ok(())
    }

    /// Leaves out rectangles of the size of the page without a role, the backgrounds and frames that design programs
    /// draw, unless there is nothing else. `corner` is the lower left corner of the page in metres.
    fn leave_page_out(&mut self, corner: Point, page: Viewport, scale: f64) {
        let size = Vector::new(page.width, page.height) * scale;
        if self.draft.parts.len() < 2 || !(size.x > 0.0 && size.y > 0.0) {
            return;
        }
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let corners = corners.map(|(x, y)| corner + Vector::new(x * size.x, y * size.y));
        let is_page = |part: &Part| {
            let PartGeometry::Subpaths(subpaths, _) = &part.form else { return false };
            let hull: Vec<Point> = subpaths.iter().flat_map(Subpath::hull).collect();
            part.kind == Role::Block
                && part.clips.is_empty()
                && (4..=5).contains(&hull.len())
                && !subpaths.iter().any(Subpath::has_curves)
                && corners.iter().all(|c| hull.iter().any(|p| (p - c).norm() <= PAGE_TOL * size.norm()))
        };
        let (pages, parts): (Vec<Part>, Vec<Part>) =
            std::mem::take(&mut self.draft.parts).into_iter().partition(is_page);
        self.draft.parts = parts;
        for page in pages {
            let why = "it is as large as the page, so it is a background";
            self.draft.notes.push(format!("{} is left out: {why}", page.element));
        }
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
            self.remark(RemarkKind::Mask, node, around, why, help);
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
                    self.remark(RemarkKind::ClipPath, node, around, why, "cut the outline itself");
                }
            }
        }
        self.draw(node, around, inner);
    }

    /// Returns the outline of the clip path of an element, in metres. `None` if the clip path does not consist of one
    /// closed outline in the coordinates of the element.
    fn clip(&mut self, node: Node<'a, 'd>, inner: &Context) -> Option<Subpath> {
        let clip = *self.ids.get(style::clip_reference(node, &self.sheet)?.as_str())?;
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

    /// Counts an element. Returns true if the element exceeds a limit: on the comparisons with style rules, for which the
    /// drawing is refused, or, with a remark, on the number of elements or on the nesting depth.
    fn is_beyond_limits(&mut self, node: Node<'a, 'd>, around: &Context) -> bool {
        self.seen += 1;
        self.styled = self.styled.saturating_add(self.comparisons.saturating_mul(weight(node, self.reads_all)));
        if self.styled > MAX_RULE_MATCHES {
            return true;
        }
        if self.seen > MAX_ELEMENTS {
            let why =
                format!("the drawing has more than {MAX_ELEMENTS} elements, copies included; this one is left out");
            self.remark(RemarkKind::TooManyElements, node, around, &why, "");
            return true;
        }
        if around.depth >= MAX_DEPTH {
            let why = format!("groups are nested more than {MAX_DEPTH} levels deep; left out");
            self.remark(RemarkKind::TooDeep, node, around, &why, "ungroup them");
            return true;
        }
        false
    }

    /// Reads an element and its children. `around` is the context around the element, and `inner` also has the
    /// element's own properties.
    fn draw(&mut self, node: Node<'a, 'd>, around: &Context, mut inner: Context) {
        let tag = node.tag_name().name();
        match tag {
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
            "text" | "flowRoot" => self.remark(
                RemarkKind::Text,
                node,
                around,
                "a text cannot become a block; left out",
                "convert it to paths if it should become blocks, or give its layer a name that begins with ignore",
            ),
            "image" => self.remark(
                RemarkKind::Image,
                node,
                around,
                "an image has no outlines; left out",
                "trace it, or give its layer a name that begins with ignore",
            ),
            "rect" | "circle" | "ellipse" | "polygon" | "polyline" | "path" | "line" => {
                self.shape(node, &inner);
            }
            _ => {
                let why = format!("<{tag}> is not a known element; left out");
                self.remark(RemarkKind::Unknown, node, around, &why, "");
            }
        }
    }

    /// Reads the element to which a `<use>` element refers.
    fn copy(&mut self, node: Node<'a, 'd>, mut inner: Context) {
        let Some(target) = self.copied(node) else {
            let why = format!("it copies {}, which does not exist; left out", reference(node).unwrap_or("nothing"));
            self.remark(RemarkKind::MissingCopy, node, &inner, &why, "");
            return;
        };
        if node == target || node.ancestors().any(|a| a == target) {
            self.remark(RemarkKind::MissingCopy, node, &inner, "it copies itself; left out", "");
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

    /// Adds a note that an element is left out, with the reason.
    pub(super) fn skip(&mut self, node: Node<'a, 'd>, around: &Context, why: &str) {
        let times = self.remarked.entry(RemarkKind::Skipped).or_default();
        *times += 1;
        if *times <= MAX_LISTED_REMARKS {
            let note = format!("{} is left out: {why}", self.element_label(node, around));
            self.draft.notes.push(note);
        }
    }

    /// Adds a remark about an element, up to a limit for its kind.
    pub(super) fn remark(&mut self, kind: RemarkKind, node: Node<'a, 'd>, around: &Context, message: &str, help: &str) {
        let times = self.remarked.entry(kind).or_default();
        *times += 1;
        if *times <= MAX_LISTED_REMARKS {
            let element = self.element_label(node, around);
            self.draft.remark(element, message, help);
        }
    }

    /// For each kind of remarks that are not all listed, adds a remark or note with the number of unlisted remarks.
    pub(super) fn count_unlisted(&mut self) {
        for (kind, times) in &self.remarked {
            let Some(more) = times.checked_sub(MAX_LISTED_REMARKS).filter(|more| *more > 0) else {
                continue;
            };
            match kind.plural() {
                None => {
                    let note = format!("{more} more elements are left out for the same reasons");
                    self.draft.notes.push(note);
                }
                Some(plural) => self.draft.remark("", format!("{more} more {plural}"), ""),
            }
        }
    }
}
