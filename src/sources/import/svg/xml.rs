//! Tests the tags of SVG elements, and reads their text.

use roxmltree::Node;

/// The SVG namespace.
pub(super) const SVG: &str = "http://www.w3.org/2000/svg";

/// True if a node is an SVG element with this tag.
pub(super) fn is(node: Node<'_, '_>, tag: &str) -> bool {
    node.is_element() && node.tag_name().name() == tag && node.tag_name().namespace().is_none_or(|n| n == SVG)
}

/// True for tags such as `defs` and `clipPath`, whose content is never drawn directly.
pub(super) fn is_never_drawn(tag: &str) -> bool {
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

/// Returns the text of an element, without the text of its children.
pub(super) fn words(node: Node<'_, '_>) -> String {
    let text: String = node.children().filter_map(|c| c.text()).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
