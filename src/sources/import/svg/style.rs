//! [`Style`]: the fill and visibility of an element, from presentation attributes, style sheets and `style`.
//!
//! Only the properties that matter for an import are read. The cascade follows CSS: attributes, then style rules by
//! specificity, then `style`, then `!important`.

use roxmltree::Node;
use simplecss::{AttributeOperator, DeclarationTokenizer, PseudoClass, StyleSheet};
use svgtypes::{Color, Paint, PaintFallback};

use crate::sources::import::draft::FillRule;

/// The style of an element. Most properties are inherited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub(super) fill: Fill,
    /// The `color` property, for `currentColor`.
    colour: Option<[u8; 3]>,
    pub(super) rule: FillRule,
    pub(super) visible: bool,
    /// False for `display: none`, which hides the element and all its children.
    pub(super) displayed: bool,
    pub(super) clipped: bool,
    pub(super) masked: bool,
}

/// The fill of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fill {
    /// Not specified; SVG then uses black.
    Unspecified,
    None,
    Colour([u8; 3]),
    /// A gradient or a pattern.
    Paint,
    /// A value that is not valid.
    Unknown,
}

impl Style {
    pub(super) const ROOT: Style = Style {
        fill: Fill::Unspecified,
        colour: None,
        rule: FillRule::NonZero,
        visible: true,
        displayed: true,
        clipped: false,
        masked: false,
    };

    /// Returns the style of a child element: inherited from this style, and changed by its own declarations.
    pub(super) fn of_child(&self, node: Node<'_, '_>, sheet: &StyleSheet<'_>) -> Style {
        let mut style = Style { displayed: true, clipped: false, masked: false, ..*self };
        let own = declarations(node, sheet);
        // Read `color` first, because `currentColor` in a fill refers to it, whatever the order of the declarations.
        for (name, value) in own.iter().filter(|d| d.0 == "color") {
            style.set(name, value, self);
        }
        for (name, value) in own.iter().filter(|d| d.0 != "color") {
            style.set(name, value, self);
        }
        style
    }

    fn set(&mut self, name: &str, value: &str, outer: &Style) {
        let value = value.trim();
        match name {
            "color" => {
                if let Ok(colour) = value.parse::<Color>() {
                    self.colour = Some(bytes(colour));
                }
            }
            "fill" => {
                self.fill = match Paint::from_str(value) {
                    Ok(Paint::None) => Fill::None,
                    Ok(Paint::Inherit) => outer.fill,
                    Ok(Paint::CurrentColor) => self.current(),
                    Ok(Paint::Color(colour)) => Fill::Colour(bytes(colour)),
                    Ok(Paint::FuncIRI(_, Some(PaintFallback::Color(colour)))) => Fill::Colour(bytes(colour)),
                    Ok(Paint::FuncIRI(_, _)) => Fill::Paint,
                    Ok(Paint::ContextFill | Paint::ContextStroke) => Fill::Unspecified,
                    Err(_) => Fill::Unknown,
                };
            }
            "fill-rule" => match value {
                "evenodd" => self.rule = FillRule::EvenOdd,
                "nonzero" => self.rule = FillRule::NonZero,
                _ => {}
            },
            "visibility" => match value {
                "visible" => self.visible = true,
                "hidden" | "collapse" => self.visible = false,
                _ => {}
            },
            "display" => self.displayed = value != "none",
            "clip-path" => self.clipped = value != "none",
            "mask" => self.masked = value != "none",
            _ => {}
        }
    }

    fn current(&self) -> Fill {
        self.colour.map_or(Fill::Unspecified, Fill::Colour)
    }
}

/// Returns the id of the clip path of an element; `None` if its clip path is not a reference.
pub(super) fn clip_reference<'v>(node: Node<'v, '_>, sheet: &'v StyleSheet<'_>) -> Option<&'v str> {
    let value = declared(node, sheet, "clip-path")?.trim();
    let id = value.strip_prefix("url(")?.strip_suffix(')')?.trim_matches(['"', '\'', ' ']);
    id.strip_prefix('#')
}

/// Returns the value of a property of an element.
pub(super) fn declared<'v>(node: Node<'v, '_>, sheet: &'v StyleSheet<'_>, name: &str) -> Option<&'v str> {
    declarations(node, sheet).iter().rev().find(|d| d.0 == name).map(|d| d.1)
}

fn bytes(colour: Color) -> [u8; 3] {
    [colour.red, colour.green, colour.blue]
}

/// Returns all declarations for an element, in increasing order of precedence.
fn declarations<'v>(node: Node<'v, '_>, sheet: &'v StyleSheet<'_>) -> Vec<(&'v str, &'v str)> {
    let mut plain: Vec<(&str, &str)> = node
        .attributes()
        .filter(|a| a.namespace().is_none() && a.name() != "style")
        .map(|a| (a.name(), a.value()))
        .collect();
    let mut important = Vec::new();
    let inline = node.attribute("style").unwrap_or("");
    let rules = sheet
        .rules
        .iter()
        .filter(|rule| rule.selector.matches(&Matched(node)))
        .flat_map(|rule| rule.declarations.iter().copied());
    for declaration in rules.chain(DeclarationTokenizer::from(inline)) {
        let list = if declaration.important { &mut important } else { &mut plain };
        list.push((declaration.name, declaration.value));
    }
    plain.extend(important);
    plain
}

struct Matched<'a, 'd>(Node<'a, 'd>);

impl simplecss::Element for Matched<'_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.0.parent_element().map(Matched)
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.0.prev_sibling_element().map(Matched)
    }

    fn has_local_name(&self, name: &str) -> bool {
        self.0.tag_name().name() == name
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        self.0.attribute(name).is_some_and(|value| operator.matches(value))
    }

    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        class == PseudoClass::FirstChild && self.0.prev_sibling_element().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style(element: &str, css: &str) -> Style {
        let text = format!("<svg fill='red' color='#010203'>{element}</svg>");
        let document = roxmltree::Document::parse(&text).expect("XML");
        let root = document.root_element();
        let sheet = StyleSheet::parse(css);
        let outer = Style::ROOT.of_child(root, &sheet);
        outer.of_child(root.first_element_child().expect("an element"), &sheet)
    }

    #[test]
    fn declarations_take_precedence_as_in_css() {
        let cases = [
            ("<g/>", "", [255, 0, 0]),
            ("<g fill='#0f0'/>", "", [0, 255, 0]),
            ("<g fill='#0f0' class='a'/>", ".a { fill: blue }", [0, 0, 255]),
            ("<g class='a' style='fill:#8b6b3d'/>", ".a { fill: blue }", [0x8b, 0x6b, 0x3d]),
            ("<g class='a' style='fill:#000'/>", ".a { fill: blue !important }", [0, 0, 255]),
            ("<g style='fill: inherit'/>", "", [255, 0, 0]),
            ("<g fill='currentColor'/>", "", [1, 2, 3]),
            ("<g fill='currentColor' style='color:rgb(4,5,6)'/>", "", [4, 5, 6]),
            ("<g fill='url(#a) #070809'/>", "", [7, 8, 9]),
        ];
        for (element, css, fill) in cases {
            assert_eq!(style(element, css).fill, Fill::Colour(fill), "{element}");
        }
        assert_eq!(style("<g fill='none'/>", "").fill, Fill::None);
        assert_eq!(style("<g fill='url(#a)'/>", "").fill, Fill::Paint);
        assert_eq!(style("<g fill='#zz'/>", "").fill, Fill::Unknown);
    }

    #[test]
    fn hidden_elements_are_recognised() {
        assert!(!style("<g style='display:none'/>", "").displayed);
        assert!(!style("<g visibility='hidden'/>", "").visible);
        assert!(style("<g clip-path='url(#c)'/>", "").clipped);
        assert!(style("<g mask='url(#m)'/>", "").masked);
        assert_eq!(style("<g fill-rule='evenodd'/>", "").rule, FillRule::EvenOdd);
    }
}
