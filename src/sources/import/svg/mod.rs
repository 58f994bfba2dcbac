//! SVG as Inkscape, Illustrator and people write it, into a [`Draft`].
//!
//! Walks the tree with what each element inherits: its place, its looks, and what the names around it say it is. What is
//! drawn and cannot be a body is reported, once each; what is not drawn is passed over.

mod element;
mod figure;
mod name;
mod path;
mod style;
mod viewport;

use std::collections::BTreeMap;

use roxmltree::{Document, Node, ParsingOptions};
use simplecss::StyleSheet;
use svgtypes::{TransformListParser, TransformListToken};

use self::name::Lines;
use self::style::{Fill, Style};
use self::viewport::Viewport;
use super::affine::Affine;
use super::crowd::{MOST_BODIES, too_many};
use super::draft::{Draft, Form, Part, Role, Values};
use super::entry;

const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
/// Groups and copies nest at most so deep.
const DEEPEST: usize = 100;
/// So many elements are looked at, copies included: copies of copies can make any number.
const MOST: usize = 500_000;
/// So many rules are held against elements, once for each rule and element.
const MOST_MATCHES: usize = 150_000_000;
/// So many elements of one kind are listed one by one.
const MOST_LISTED: usize = 20;

/// What an SVG draws, in metres, y up.
///
/// # Errors
/// Why it cannot be read at all.
pub(super) fn read(text: &str, scale: Option<f64>, frame: Option<usize>) -> Result<Draft, String> {
    let options = ParsingOptions {
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options).map_err(|e| e.to_string())?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let found = root.tag_name().name();
        return Err(format!("its outermost element is <{found}> and not <svg>"));
    }
    let mut css = String::new();
    for node in document.descendants().filter(|n| is(*n, "style")) {
        for piece in node.children().filter_map(|c| c.text()) {
            css += piece;
            css.push('\n');
        }
    }
    let sheet = StyleSheet::parse(&css);
    let elements = document.descendants().filter(Node::is_element).count();
    let rules = sheet.rules.len();
    if rules.saturating_mul(elements) > MOST_MATCHES {
        return Err(format!(
            "its {rules} style rules and {elements} elements are more than can be matched; simplify its styles"
        ));
    }
    let mut ids = BTreeMap::new();
    for node in document.descendants() {
        if let Some(id) = node.attribute("id") {
            ids.entry(id).or_insert(node);
        }
    }
    let mut walk = Walk {
        sheet,
        styled: 0,
        ids,
        lines: Lines::new(text),
        draft: Draft::default(),
        seen: 0,
        more: 0,
        remarked: BTreeMap::new(),
    };
    if let Some(title) = root.children().find(|n| is(*n, "title")) {
        walk.draft.title = words(title);
    }
    if let Some(pictures) = figure::pictures(root) {
        walk.figure(&pictures, scale, frame)?;
    } else if frame.is_some() {
        return Err("only a figure that drystone drew has frames".into());
    } else {
        walk.drawing(root, scale);
    }
    walk.count_untold();
    if walk.more > 0 {
        return Err(too_many(walk.draft.parts.len() + walk.more).message);
    }
    Ok(walk.draft)
}

/// What an element has from those around it.
#[derive(Clone)]
struct Around {
    map: Affine,
    style: Style,
    viewport: Viewport,
    kind: Option<Role>,
    /// The name of the innermost named group, for what has none of its own.
    group: Option<String>,
    /// The copy that draws it, where it is one.
    copy: Option<Copy>,
    depth: usize,
}

#[derive(Clone)]
struct Copy {
    element: String,
    name: Option<String>,
}

struct Walk<'a, 'd> {
    sheet: StyleSheet<'a>,
    ids: BTreeMap<&'a str, Node<'a, 'd>>,
    lines: Lines,
    draft: Draft,
    /// Elements looked at.
    seen: usize,
    /// Style rules held against them.
    styled: usize,
    /// Shapes that were not taken any more.
    more: usize,
    /// How often each thing was remarked on.
    remarked: BTreeMap<&'static str, usize>,
}

impl<'a, 'd> Walk<'a, 'd> {
    /// A drawing by a person.
    fn drawing(&mut self, root: Node<'a, 'd>, scale: Option<f64>) {
        let page = viewport::page(root);
        let scale = match (scale, page.unit) {
            (Some(scale), _) => {
                let note = format!("a unit of the drawing is {scale} m, as --scale says");
                self.draft.notes.push(note);
                scale
            }
            (None, Some((unit, stated))) => {
                let note = format!(
                    "a unit of the drawing is {} m, since it is {stated}",
                    entry::digits(unit)
                );
                self.draft.notes.push(note);
                unit
            }
            (None, None) => {
                let note = "a unit of the drawing is 1 m, since it tells no size in mm, cm, in or pt; --scale tells another";
                self.draft.notes.push(note.into());
                1.0
            }
        };
        // The lower left corner of the page becomes the origin, as in Inkscape's rulers.
        let map = Affine([
            scale,
            0.0,
            0.0,
            -scale,
            -scale * page.left,
            scale * page.bottom,
        ]);
        let around = Around {
            map,
            style: Style::ROOT.of(root, &self.sheet),
            viewport: page.viewport,
            kind: None,
            group: None,
            copy: None,
            depth: 0,
        };
        self.children(root, &around);
    }

    fn children(&mut self, node: Node<'a, 'd>, around: &Around) {
        for child in node.children().filter(Node::is_element) {
            self.element(child, around);
        }
    }

    fn element(&mut self, node: Node<'a, 'd>, around: &Around) {
        if node.tag_name().namespace().is_some_and(|n| n != SVG) {
            return;
        }
        let tag = node.tag_name().name();
        if is_never_drawn(tag) || (tag == "symbol" && around.copy.is_none()) {
            return;
        }
        self.seen += 1;
        self.styled = self.styled.saturating_add(self.sheet.rules.len());
        if self.seen > MOST || self.styled > MOST_MATCHES {
            let why = format!(
                "there are more than {} elements, copies included; left out",
                self.seen - 1
            );
            self.remark("many", node, around, &why, "");
            return;
        }
        if around.depth >= DEEPEST {
            let why = format!("groups lie more than {DEEPEST} deep in each other; left out");
            self.remark("deep", node, around, &why, "ungroup them");
            return;
        }
        let style = around.style.of(node, &self.sheet);
        let kind = name::all(node)
            .find_map(|n| Role::from_name(&n))
            .or(around.kind);
        if !style.displayed {
            self.skip(node, around, "is hidden");
            return;
        }
        if kind == Some(Role::Ignored) {
            self.skip(node, around, "asks for it by its name");
            return;
        }
        if style.clipped {
            let why = "its clip path is not followed: it is taken whole";
            self.remark("clip", node, around, why, "cut the outline itself");
        }
        if style.masked {
            let why = "its mask is not followed: it is taken whole";
            self.remark("mask", node, around, why, "cut the outline itself");
        }
        let mut inner = Around {
            map: around.map.after(&self.transform(node, around)),
            style,
            kind,
            depth: around.depth + 1,
            ..around.clone()
        };
        match tag {
            "g" | "a" | "switch" | "svg" | "symbol" => {
                if let Some(name) = name::given(node).filter(|_| !name::is_layer(node)) {
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
            "use" => self.copied(node, inner),
            "text" | "flowRoot" => self.remark(
                "text",
                node,
                around,
                "a text is no block; left out",
                "turn it into paths if it is meant to be blocks, or name its layer ignore",
            ),
            "image" => self.remark(
                "image",
                node,
                around,
                "an image has no outlines; left out",
                "trace it, or name its layer ignore",
            ),
            "rect" | "circle" | "ellipse" | "polygon" | "polyline" | "path" | "line" => {
                self.shape(node, &inner);
            }
            _ => {
                let why = format!("<{tag}> is nothing that is known here; left out");
                self.remark("unknown", node, around, &why, "");
            }
        }
    }

    /// `<use>`: what it refers to, moved.
    fn copied(&mut self, node: Node<'a, 'd>, mut inner: Around) {
        let reference = node
            .attribute("href")
            .or_else(|| node.attribute((XLINK, "href")));
        let target = reference
            .and_then(|r| r.trim().strip_prefix('#'))
            .and_then(|id| self.ids.get(id).copied());
        let Some(target) = target else {
            let why = format!(
                "it copies {}, which is not there; left out",
                reference.unwrap_or("nothing")
            );
            self.remark("copy", node, &inner, &why, "");
            return;
        };
        if node == target || node.ancestors().any(|a| a == target) {
            self.remark("copy", node, &inner, "it copies itself; left out", "");
            return;
        }
        let (x, y) = (
            viewport::length(node, "x", inner.viewport.width),
            viewport::length(node, "y", inner.viewport.height),
        );
        inner.map = inner
            .map
            .after(&Affine::moving(x.unwrap_or(0.0), y.unwrap_or(0.0)));
        if inner.copy.is_none() {
            inner.copy = Some(Copy {
                element: self.lines.element(node),
                name: name::given(node),
            });
        }
        if matches!(target.tag_name().name(), "svg" | "symbol") {
            // A copy may give the size that a symbol has.
            inner.viewport.copied = (
                viewport::length(node, "width", inner.viewport.width),
                viewport::length(node, "height", inner.viewport.height),
            );
        }
        self.element(target, &inner);
    }

    fn shape(&mut self, node: Node<'a, 'd>, around: &Around) {
        if !around.style.visible {
            self.skip(node, around, "is hidden");
            return;
        }
        let tracks = match element::tracks(node, around.viewport) {
            Ok(tracks) => tracks,
            Err(why) => {
                self.remark("broken", node, around, &format!("{why}; left out"), "");
                return;
            }
        };
        let fill = match around.style.fill {
            Fill::Colour(fill) => Some(fill),
            Fill::Picture => {
                let why = "a gradient or pattern is no material; the fill is not taken";
                self.remark("gradient", node, around, why, "fill it with one colour");
                None
            }
            Fill::Unknown => {
                let why = "its fill is no colour; not taken";
                self.remark("fill", node, around, why, "write it as #rrggbb");
                None
            }
            Fill::Unsaid | Fill::None => None,
        };
        let copied = around.copy.as_ref().and_then(|c| c.name.clone());
        let name = copied
            .or_else(|| name::given(node))
            .or_else(|| around.group.clone())
            .or_else(|| name::any(node))
            .unwrap_or_default();
        if self.draft.parts.len() >= MOST_BODIES {
            self.more += 1;
            return;
        }
        let mapped = tracks.iter().map(|t| t.mapped(&around.map)).collect();
        let part = Part {
            kind: around.kind.unwrap_or(Role::Block),
            name,
            element: self.element_label(node, around),
            form: Form::Tracks(mapped, around.style.rule),
            fill,
            values: Values::default(),
        };
        self.draft.parts.push(part);
    }

    fn transform(&mut self, node: Node<'a, 'd>, around: &Around) -> Affine {
        let mut map = Affine::IDENTITY;
        for token in TransformListParser::from(node.attribute("transform").unwrap_or("")) {
            let Ok(token) = token else {
                let why = "its transform cannot be read; taken as far as it goes";
                self.remark("transform", node, around, why, "");
                break;
            };
            map = map.after(&match token {
                TransformListToken::Matrix { a, b, c, d, e, f } => Affine([a, b, c, d, e, f]),
                TransformListToken::Translate { tx, ty } => Affine::moving(tx, ty),
                TransformListToken::Scale { sx, sy } => Affine::scaling(sx, sy),
                TransformListToken::Rotate { angle } => Affine::turning(angle),
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

    /// How a person finds what is drawn here: a copy by the copy.
    fn element_label(&self, node: Node<'a, 'd>, around: &Around) -> String {
        match &around.copy {
            Some(copy) => copy.element.clone(),
            None => self.lines.element(node),
        }
    }

    fn skip(&mut self, node: Node<'a, 'd>, around: &Around, why: &str) {
        let times = self.remarked.entry("skip").or_default();
        *times += 1;
        if *times <= MOST_LISTED {
            let note = format!("{} is left out: it {why}", self.element_label(node, around));
            self.draft.notes.push(note);
        }
    }

    fn remark(
        &mut self,
        sort: &'static str,
        node: Node<'a, 'd>,
        around: &Around,
        message: &str,
        help: &str,
    ) {
        let times = self.remarked.entry(sort).or_default();
        *times += 1;
        if *times <= MOST_LISTED {
            let element = self.element_label(node, around);
            self.draft.remark(element, message, help);
        }
    }

    /// What was remarked on too often to be told each time is counted.
    fn count_untold(&mut self) {
        for (sort, times) in &self.remarked {
            if *times > MOST_LISTED && *sort == "skip" {
                self.draft.notes.push(format!(
                    "{} more elements are left out likewise",
                    times - MOST_LISTED
                ));
            } else if *times > MOST_LISTED {
                let message = match *sort {
                    "deep" => "groups too deep in each other",
                    "many" => "elements too many",
                    "clip" => "clip paths",
                    "mask" => "masks",
                    "text" => "texts",
                    "image" => "images",
                    "copy" => "copies of what is not there",
                    "gradient" => "gradients and patterns",
                    "fill" => "fills that are no colours",
                    "transform" => "transforms that cannot be read",
                    "broken" => "outlines that cannot be read",
                    _ => "unknown elements",
                };
                let message = format!("{} more {message}", times - MOST_LISTED);
                self.draft.remark("", message, "");
            }
        }
    }
}

fn is(node: Node<'_, '_>, tag: &str) -> bool {
    node.is_element()
        && node.tag_name().name() == tag
        && node.tag_name().namespace().is_none_or(|n| n == SVG)
}

fn is_never_drawn(tag: &str) -> bool {
    matches!(
        tag,
        "defs"
            | "title"
            | "desc"
            | "metadata"
            | "style"
            | "script"
            | "clipPath"
            | "mask"
            | "linearGradient"
            | "radialGradient"
            | "pattern"
            | "marker"
            | "filter"
            | "font"
            | "font-face"
            | "cursor"
            | "view"
            | "foreignObject"
            | "animate"
            | "animateTransform"
            | "animateMotion"
            | "set"
    )
}

/// The words in an element, without those of elements within.
fn words(node: Node<'_, '_>) -> String {
    let text: String = node.children().filter_map(|c| c.text()).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
