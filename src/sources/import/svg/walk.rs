//! [`Walk`]: visits the elements of an SVG and adds the shapes to a draft.

use std::collections::BTreeMap;

use roxmltree::Node;
use simplecss::StyleSheet;
use svgtypes::{TransformListParser, TransformListToken};

use super::name::{self, Lines};
use super::remark::RemarkKind;
use super::style::{Fill, Style};
use super::viewport::{self, Viewport};
use super::xml::{SVG, is, is_never_drawn};
use super::{MAX_RULE_MATCHES, element};
use crate::import::affine::Affine;
use crate::import::draft::{Draft, Form, Part, Role, Values};
use crate::import::limit::MAX_BODIES;
use crate::import::scene_file;

const XLINK: &str = "http://www.w3.org/1999/xlink";
/// The largest nesting depth of groups and copies; deeper files could overflow the stack.
const MAX_DEPTH: usize = 100;
/// The largest number of elements, copies included. Copies of copies can grow exponentially.
const MAX_ELEMENTS: usize = 500_000;

/// The properties that an element inherits from the elements around it.
#[derive(Clone)]
pub(super) struct Context {
    pub(super) map: Affine,
    pub(super) style: Style,
    pub(super) viewport: Viewport,
    pub(super) kind: Option<Role>,
    /// The name of the innermost named group, for elements without a name.
    pub(super) group: Option<String>,
    /// The `<use>` element that draws this copy, if any.
    pub(super) copy: Option<UseElement>,
    pub(super) depth: usize,
}

/// The `<use>` element of a copy: its description and its name.
#[derive(Clone)]
pub(super) struct UseElement {
    pub(super) element: String,
    pub(super) name: Option<String>,
}

/// The state of a walk over the elements of an SVG.
pub(super) struct Walk<'a, 'd> {
    pub(super) sheet: StyleSheet<'a>,
    pub(super) ids: BTreeMap<&'a str, Node<'a, 'd>>,
    pub(super) lines: Lines,
    pub(super) draft: Draft,
    /// The number of visited elements.
    pub(super) seen: usize,
    /// The number of style rules that were compared with them.
    pub(super) styled: usize,
    /// The number of shapes beyond the limit.
    pub(super) more: usize,
    /// The number of remarks of each kind.
    pub(super) remarked: BTreeMap<RemarkKind, usize>,
}

impl<'a, 'd> Walk<'a, 'd> {
    /// Reads a drawing that is not a figure by drystone.
    pub(super) fn drawing(&mut self, root: Node<'a, 'd>, scale: Option<f64>) {
        let page = viewport::page(root);
        let scale = match (scale, page.unit) {
            (Some(scale), _) => {
                let note = format!("a unit of the drawing is {scale} m (from --scale)");
                self.draft.notes.push(note);
                scale
            }
            (None, Some((unit, stated))) => {
                let note = format!(
                    "a unit of the drawing is {} m, because it is {stated}",
                    scene_file::six_digits(unit)
                );
                self.draft.notes.push(note);
                unit
            }
            (None, None) => {
                let note = "a unit of the drawing is 1 m, because it has no size in mm, cm, in or pt; --scale sets another unit";
                self.draft.notes.push(note.into());
                1.0
            }
        };
        // The lower left corner of the page becomes the origin, as in the rulers of Inkscape.
        let map = Affine([
            scale,
            0.0,
            0.0,
            -scale,
            -scale * page.left,
            scale * page.bottom,
        ]);
        let around = Context {
            map,
            style: Style::ROOT.of_child(root, &self.sheet),
            viewport: page.viewport,
            kind: None,
            group: None,
            copy: None,
            depth: 0,
        };
        self.children(root, &around);
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
        self.seen += 1;
        self.styled = self.styled.saturating_add(self.sheet.rules.len());
        if self.seen > MAX_ELEMENTS || self.styled > MAX_RULE_MATCHES {
            let why = format!(
                "the drawing has more than {} elements, copies included; this one is left out",
                self.seen - 1
            );
            self.remark(RemarkKind::TooManyElements, node, around, &why, "");
            return;
        }
        if around.depth >= MAX_DEPTH {
            let why = format!("groups are nested more than {MAX_DEPTH} levels deep; left out");
            self.remark(RemarkKind::TooDeep, node, around, &why, "ungroup them");
            return;
        }
        let style = around.style.of_child(node, &self.sheet);
        let kind = name::all_names(node)
            .find_map(|n| Role::from_name(&n))
            .or(around.kind);
        if !style.displayed {
            self.skip(node, around, "it is hidden");
            return;
        }
        if kind == Some(Role::Ignored) {
            self.skip(node, around, "its name begins with ignore or guide");
            return;
        }
        if style.clipped {
            let why = "clip paths are not supported; the whole outline is imported";
            self.remark(
                RemarkKind::ClipPath,
                node,
                around,
                why,
                "cut the outline itself",
            );
        }
        if style.masked {
            let why = "masks are not supported; the whole outline is imported";
            self.remark(
                RemarkKind::Mask,
                node,
                around,
                why,
                "cut the outline itself",
            );
        }
        let inner = Context {
            map: around.map.after(&self.transform(node, around)),
            style,
            kind,
            depth: around.depth + 1,
            ..around.clone()
        };
        self.draw(node, around, inner);
    }

    /// Draws an element and its children, whose context is `inner`.
    fn draw(&mut self, node: Node<'a, 'd>, around: &Context, mut inner: Context) {
        let tag = node.tag_name().name();
        match tag {
            "g" | "a" | "switch" | "svg" | "symbol" => {
                if let Some(name) = name::user_name(node).filter(|_| !name::is_layer(node)) {
                    inner.group = Some(name);
                }
                match tag {
                    "svg" | "symbol" => {
                        viewport::enter(node, &mut inner);
                        self.children(node, &inner);
                    }
                    "switch" => {
                        let first = node.children().find(|c| {
                            c.is_element()
                                && !is(*c, "foreignObject")
                                && c.attribute("requiredExtensions").is_none()
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
                "convert it to paths if it should become blocks, or rename its layer to ignore",
            ),
            "image" => self.remark(
                RemarkKind::Image,
                node,
                around,
                "an image has no outlines; left out",
                "trace it, or rename its layer to ignore",
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

    /// Draws the element that a `<use>` element refers to.
    fn copy(&mut self, node: Node<'a, 'd>, mut inner: Context) {
        let reference = node
            .attribute("href")
            .or_else(|| node.attribute((XLINK, "href")));
        let target = reference
            .and_then(|r| r.trim().strip_prefix('#'))
            .and_then(|id| self.ids.get(id).copied());
        let Some(target) = target else {
            let why = format!(
                "it copies {}, which does not exist; left out",
                reference.unwrap_or("nothing")
            );
            self.remark(RemarkKind::MissingCopy, node, &inner, &why, "");
            return;
        };
        if node == target || node.ancestors().any(|a| a == target) {
            self.remark(
                RemarkKind::MissingCopy,
                node,
                &inner,
                "it copies itself; left out",
                "",
            );
            return;
        }
        let (x, y) = (
            viewport::length(node, "x", inner.viewport.width),
            viewport::length(node, "y", inner.viewport.height),
        );
        inner.map = inner
            .map
            .after(&Affine::translation(x.unwrap_or(0.0), y.unwrap_or(0.0)));
        if inner.copy.is_none() {
            inner.copy = Some(UseElement {
                element: self.lines.element(node),
                name: name::user_name(node),
            });
        }
        if matches!(target.tag_name().name(), "svg" | "symbol") {
            // A `<use>` element may set the size of a symbol.
            inner.viewport.copied = (
                viewport::length(node, "width", inner.viewport.width),
                viewport::length(node, "height", inner.viewport.height),
            );
        }
        self.element(target, &inner);
    }

    fn shape(&mut self, node: Node<'a, 'd>, around: &Context) {
        if !around.style.visible {
            self.skip(node, around, "it is hidden");
            return;
        }
        let subpaths = match element::subpaths(node, around.viewport) {
            Ok(subpaths) => subpaths,
            Err(why) => {
                self.remark(
                    RemarkKind::BrokenOutline,
                    node,
                    around,
                    &format!("{why}; left out"),
                    "",
                );
                return;
            }
        };
        let fill = match around.style.fill {
            Fill::Colour(fill) => Some(fill),
            Fill::Paint => {
                let why =
                    "a gradient or pattern cannot become a material; the fill is not imported";
                self.remark(RemarkKind::Gradient, node, around, why, "use one colour");
                None
            }
            Fill::Unknown => {
                let why = "its fill is not a valid colour; it is not imported";
                self.remark(
                    RemarkKind::BadFill,
                    node,
                    around,
                    why,
                    "write it as #rrggbb",
                );
                None
            }
            Fill::Unspecified | Fill::None => None,
        };
        let copied = around.copy.as_ref().and_then(|c| c.name.clone());
        let name = copied
            .or_else(|| name::user_name(node))
            .or_else(|| around.group.clone())
            .or_else(|| name::any_name(node))
            .unwrap_or_default();
        if self.draft.parts.len() >= MAX_BODIES {
            self.more += 1;
            return;
        }
        let mapped = subpaths.iter().map(|t| t.mapped(&around.map)).collect();
        let part = Part {
            kind: around.kind.unwrap_or(Role::Block),
            name,
            element: self.element_label(node, around),
            form: Form::Subpaths(mapped, around.style.rule),
            fill,
            values: Values::default(),
        };
        self.draft.parts.push(part);
    }

    pub(super) fn transform(&mut self, node: Node<'a, 'd>, around: &Context) -> Affine {
        let mut map = Affine::IDENTITY;
        for token in TransformListParser::from(node.attribute("transform").unwrap_or("")) {
            let Ok(token) = token else {
                let why =
                    "its transform cannot be read completely; the part before the error is used";
                self.remark(RemarkKind::BadTransform, node, around, why, "");
                break;
            };
            map = map.after(&match token {
                TransformListToken::Matrix { a, b, c, d, e, f } => Affine([a, b, c, d, e, f]),
                TransformListToken::Translate { tx, ty } => Affine::translation(tx, ty),
                TransformListToken::Scale { sx, sy } => Affine::scale(sx, sy),
                TransformListToken::Rotate { angle } => Affine::rotation(angle),
                TransformListToken::SkewX { angle } => {
                    Affine([1.0, 0.0, libm::tan(angle.to_radians()), 1.0, 0.0, 0.0])
                }
                TransformListToken::SkewY { angle } => {
                    Affine([1.0, libm::tan(angle.to_radians()), 0.0, 1.0, 0.0, 0.0])
                }
            });
        }
        map
    }

    /// A description of an element for messages; for a copy, that of its `<use>` element.
    pub(super) fn element_label(&self, node: Node<'a, 'd>, around: &Context) -> String {
        match &around.copy {
            Some(copy) => copy.element.clone(),
            None => self.lines.element(node),
        }
    }
}
