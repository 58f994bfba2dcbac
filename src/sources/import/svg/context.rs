//! [`Context`]: the properties that an element of an SVG inherits.

use core::str::FromStr;

use roxmltree::Node;
use svgtypes::AspectRatio;

use super::style::Style;
use super::viewport::{Viewport, fitted, length, view_box};
use crate::sources::import::draft::Role;
use crate::sources::import::subpath::{Affine, Subpath};

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
    /// The clip paths around the element, in metres.
    pub(super) clips: Vec<Subpath>,
    pub(super) depth: usize,
}

/// The `<use>` element of a copy: its description and its name.
#[derive(Clone)]
pub(super) struct UseElement {
    pub(super) element: String,
    pub(super) name: Option<String>,
}

impl Context {
    /// Returns the context of the root element: a transform, a style and a viewport, but no role and no names.
    pub(super) fn of_page(map: Affine, style: Style, viewport: Viewport) -> Context {
        Context { map, style, viewport, kind: None, group: None, copy: None, clips: Vec::new(), depth: 0 }
    }

    /// Sets the transform and the viewport for the content of a nested `<svg>` or a `<symbol>`.
    pub(super) fn enter(&mut self, node: Node<'_, '_>) {
        let (copied_width, copied_height) = self.viewport.copied;
        let outer = self.viewport;
        let (mut x, mut y) = (0.0, 0.0);
        let mut size = (copied_width, copied_height);
        if node.tag_name().name() == "svg" {
            x = length(node, "x", outer.width).unwrap_or(0.0);
            y = length(node, "y", outer.height).unwrap_or(0.0);
            size.0 = size.0.or(length(node, "width", outer.width));
            size.1 = size.1.or(length(node, "height", outer.height));
        }
        let (width, height) = (size.0.unwrap_or(outer.width), size.1.unwrap_or(outer.height));
        self.map = self.map.after(&Affine::translation(x, y));
        self.viewport = Viewport { width, height, copied: (None, None) };
        if let Some(view) = view_box(node)
            && width > 0.0
            && height > 0.0
        {
            let ratio = node.attribute("preserveAspectRatio").and_then(|t| AspectRatio::from_str(t).ok());
            self.map = self.map.after(&fitted(view, width, height, ratio.unwrap_or_default()));
            self.viewport.width = view.w;
            self.viewport.height = view.h;
        }
    }
}
