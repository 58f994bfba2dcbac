//! Finds the names of SVG elements: names that users gave, ids that programs generated, and descriptions for messages.

use roxmltree::Node;

pub(super) const INKSCAPE_NAMESPACE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// Returns the name that the user gave to an element: the label of Inkscape, the name of Illustrator, or an id that
/// no program generated. `None` if there is no such name.
pub(super) fn user_name(node: Node<'_, '_>) -> Option<String> {
    label(node).or_else(|| {
        let id = node.attribute("id").filter(|id| !is_generated(node, id))?;
        Some(unescaped(id)).filter(|name| !name.is_empty())
    })
}

/// Returns the name that the user gave to an element, or else its generated id; `None` if it has neither.
pub(super) fn any_name(node: Node<'_, '_>) -> Option<String> {
    user_name(node).or_else(|| {
        let id = node.attribute("id")?;
        Some(unescaped(id)).filter(|name| !name.is_empty())
    })
}

/// Returns the label and the id of an element, from which its role may follow.
pub(super) fn all_names(node: Node<'_, '_>) -> impl Iterator<Item = String> {
    let id = node.attribute("id").map(unescaped);
    label(node).into_iter().chain(id)
}

/// True if a group is an Inkscape layer. A block without a name gets the name of its group, but not that of its layer.
pub(super) fn is_layer(node: Node<'_, '_>) -> bool {
    node.attribute((INKSCAPE_NAMESPACE, "groupmode")) == Some("layer")
}

fn label(node: Node<'_, '_>) -> Option<String> {
    let label = node.attribute((INKSCAPE_NAMESPACE, "label"));
    let name = label.or_else(|| node.attribute("data-name"))?.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

/// True if a program generated the id: Inkscape writes the tag and a number, such as `path12`.
fn is_generated(node: Node<'_, '_>, id: &str) -> bool {
    id.strip_prefix(node.tag_name().name())
        .is_some_and(|rest| !rest.is_empty() && rest.bytes().all(|b| b.is_ascii_digit() || b == b'-'))
}

/// Undoes the escapes of Illustrator: `_x30_` stands for the character 0, and `_2_` at the end marks the second object
/// with the same name.
fn unescaped(id: &str) -> String {
    let mut out = String::new();
    let mut rest = id.trim();
    if let Some(body) = rest.strip_suffix('_') {
        let name = body.trim_end_matches(|c: char| c.is_ascii_digit());
        if let Some(name) = name.strip_suffix('_').filter(|n| !n.is_empty() && name.len() < body.len()) {
            rest = name;
        }
    }
    while let Some(at) = rest.find("_x") {
        out += &rest[..at];
        let code = rest[at + 2..].split('_').next().unwrap_or("");
        let closed = rest[at + 2 + code.len()..].starts_with('_');
        let shape = (2..=6).contains(&code.len()) && code.bytes().all(|b| b.is_ascii_hexdigit());
        let letter = u32::from_str_radix(code, 16).ok().and_then(char::from_u32);
        match letter.filter(|c| closed && shape && !c.is_control()) {
            Some(letter) => {
                out.push(letter);
                rest = &rest[at + 3 + code.len()..];
            }
            None => {
                out += "_x";
                rest = &rest[at + 2..];
            }
        }
    }
    out + rest
}

/// The byte offsets at which lines begin, for the line numbers of elements without a name.
pub(super) struct Lines(Vec<usize>);

impl Lines {
    pub(super) fn new(text: &str) -> Lines {
        let ends = text.bytes().enumerate().filter(|b| b.1 == b'\n');
        Lines(std::iter::once(0).chain(ends.map(|e| e.0 + 1)).collect())
    }

    /// Returns the description of an element for messages: `path "arch"`, or `<rect> in line 12` without a name.
    pub(super) fn element(&self, node: Node<'_, '_>) -> String {
        let tag = node.tag_name().name();
        match label(node).or_else(|| node.attribute("id").map(str::to_owned)) {
            Some(name) => format!("{tag} \"{name}\""),
            None => {
                let line = self.0.partition_point(|start| *start <= node.range().start);
                format!("<{tag}> in line {line}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_escapes_of_illustrator_are_decoded() {
        for (id, name) in [
            ("_x30_1", "01"),
            ("key_x5F_stone", "key_stone"),
            ("robot_1_", "robot"),
            ("a_x20_b_2_", "a b"),
            ("_x_", "_x_"),
            ("_xyz_", "_xyz_"),
            ("_1_", "_1_"),
            ("block_12", "block_12"),
            ("_xD800_", "_xD800_"),
            ("_x", "_x"),
        ] {
            assert_eq!(unescaped(id), name, "{id}");
        }
    }

    #[test]
    fn names_by_users_take_precedence() {
        let text = "<svg xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'>\n\
            <path id='path12-3' inkscape:label='keystone'/><path id='path12'/><path id='arch'/>\n<path/></svg>";
        let document = roxmltree::Document::parse(text).expect("XML");
        let lines = Lines::new(text);
        let nodes: Vec<_> = document.root_element().children().filter(Node::is_element).collect();
        let names: Vec<_> = nodes.iter().map(|n| (user_name(*n), any_name(*n))).collect();
        let some = |s: &str| Some(s.to_owned());
        assert_eq!(names[0], (some("keystone"), some("keystone")));
        assert_eq!(names[1], (None, some("path12")));
        assert_eq!(names[2], (some("arch"), some("arch")));
        assert_eq!(names[3], (None, None));
        assert_eq!(lines.element(nodes[0]), "path \"keystone\"");
        assert_eq!(lines.element(nodes[3]), "<path> in line 3");
    }
}
