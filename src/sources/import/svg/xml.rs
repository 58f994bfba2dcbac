//! Tests the tags of SVG elements, and reads their text.

use roxmltree::Node;

/// The SVG namespace.
pub(super) const SVG: &str = "http://www.w3.org/2000/svg";

/// The largest number of bytes to which entities may expand a text.
const MAX_EXPANDED_BYTES: usize = 8_000_000;

/// The largest sum of squares of the numbers of attributes of all elements. The parser compares each attribute of an
/// element with the others.
const MAX_ATTRIBUTE_PAIRS: usize = 200_000_000;

/// Refuses a text that would take a parser of XML very long.
///
/// # Errors
/// What is too large, and what to do.
pub(super) fn check_cost(text: &str) -> Result<(), String> {
    let values = text.split("<!ENTITY").skip(1).filter_map(|declared| {
        let start = declared.find(['"', '\''])?;
        declared[start + 1..].split(declared[start..].chars().next()?).next()
    });
    let values: Vec<&str> = values.collect();
    if values.iter().any(|value| value.replace("&#", "").contains(['<', '&'])) {
        return Err("an entity contains elements or other entities; save the drawing without entities".into());
    }
    let longest = values.iter().map(|value| value.len()).max().unwrap_or(0);
    let expanded = longest.saturating_mul(text.matches('&').count());
    if expanded > MAX_EXPANDED_BYTES {
        return Err(format!(
            "its entities may expand to {expanded} bytes, at most {MAX_EXPANDED_BYTES} are read; save the drawing without \
             entities"
        ));
    }
    // An attribute has one sign `=` outside of its value.
    let pairs: usize =
        text.split('<').map(|tag| tag.matches('=').count().saturating_pow(2)).fold(0, usize::saturating_add);
    if pairs > MAX_ATTRIBUTE_PAIRS {
        return Err("its elements have too many attributes; remove those that no other program reads".into());
    }
    Ok(())
}

/// True if a node is an SVG element with this tag.
pub(super) fn is(node: Node<'_, '_>, tag: &str) -> bool {
    node.is_element() && node.tag_name().name() == tag && node.tag_name().namespace().is_none_or(|n| n == SVG)
}

/// True for tags such as `defs` and `clipPath`, whose content is never drawn directly.
pub(super) fn is_never_drawn(tag: &str) -> bool {
    let never = "defs title desc metadata style script clipPath mask linearGradient radialGradient pattern marker filter font \
        font-face cursor view foreignObject animate animateTransform animateMotion set";
    never.split(' ').any(|known| known == tag)
}

/// Returns the text of an element, without the text of its children.
pub(super) fn words(node: Node<'_, '_>) -> String {
    let text: String = node.children().filter_map(|c| c.text()).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
