//! What elements are called: by people, by the programs that drew them, and in messages.

use roxmltree::Node;

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// The name a person gave an element: Inkscape's label or Illustrator's name; else its id, unless a program made that up.
pub(super) fn given(node: Node<'_, '_>) -> Option<String> {
    label(node).or_else(|| {
        let id = node.attribute("id").filter(|id| !is_made_up(node, id))?;
        Some(unescaped(id)).filter(|name| !name.is_empty())
    })
}

/// The best name there is, made up or not.
pub(super) fn any(node: Node<'_, '_>) -> Option<String> {
    given(node).or_else(|| {
        let id = node.attribute("id")?;
        Some(unescaped(id)).filter(|name| !name.is_empty())
    })
}

/// All names by which an element may say what it is.
pub(super) fn all(node: Node<'_, '_>) -> impl Iterator<Item = String> {
    let id = node.attribute("id").map(unescaped);
    label(node).into_iter().chain(id)
}

/// Whether a group is a layer, whose name is that of a place and not of a thing.
pub(super) fn is_layer(node: Node<'_, '_>) -> bool {
    node.attribute((INKSCAPE, "groupmode")) == Some("layer")
}

fn label(node: Node<'_, '_>) -> Option<String> {
    let label = node.attribute((INKSCAPE, "label"));
    let name = label.or_else(|| node.attribute("data-name"))?.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

/// Whether an id is the tag and a number, as Inkscape numbers what it draws.
fn is_made_up(node: Node<'_, '_>, id: &str) -> bool {
    id.strip_prefix(node.tag_name().name()).is_some_and(|rest| {
        !rest.is_empty() && rest.bytes().all(|b| b.is_ascii_digit() || b == b'-')
    })
}

/// An id without Illustrator's escapes: `_x30_` is a 0, and a number between underscores at the end tells twins apart.
fn unescaped(id: &str) -> String {
    let mut out = String::new();
    let mut rest = id.trim();
    if let Some(body) = rest.strip_suffix('_') {
        let name = body.trim_end_matches(|c: char| c.is_ascii_digit());
        if let Some(name) = name
            .strip_suffix('_')
            .filter(|n| !n.is_empty() && name.len() < body.len())
        {
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

/// Where lines begin, to tell the line of an element that has no name.
pub(super) struct Lines(Vec<usize>);

impl Lines {
    pub(super) fn new(text: &str) -> Lines {
        let ends = text.bytes().enumerate().filter(|b| b.1 == b'\n');
        Lines(std::iter::once(0).chain(ends.map(|e| e.0 + 1)).collect())
    }

    /// How a person finds an element: by its name, else by its line.
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
    fn illustrators_escapes_are_undone() {
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
    fn people_name_better_than_programs() {
        let text = "<svg xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'>\n\
            <path id='path12-3' inkscape:label='keystone'/><path id='path12'/><path id='arch'/>\n<path/></svg>";
        let document = roxmltree::Document::parse(text).expect("XML");
        let lines = Lines::new(text);
        let nodes: Vec<_> = document
            .root_element()
            .children()
            .filter(Node::is_element)
            .collect();
        let names: Vec<_> = nodes.iter().map(|n| (given(*n), any(*n))).collect();
        let some = |s: &str| Some(s.to_owned());
        assert_eq!(names[0], (some("keystone"), some("keystone")));
        assert_eq!(names[1], (None, some("path12")));
        assert_eq!(names[2], (some("arch"), some("arch")));
        assert_eq!(names[3], (None, None));
        assert_eq!(lines.element(nodes[0]), "path \"keystone\"");
        assert_eq!(lines.element(nodes[3]), "<path> in line 3");
    }
}
