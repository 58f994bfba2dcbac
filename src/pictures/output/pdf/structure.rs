//! Builds the structure of a PDF for screen readers: bookmarks, and tags for headings, paragraphs and tables.

use std::num::NonZeroU16;

use krilla::destination::XyzDestination;
use krilla::geom::Point;
use krilla::outline::{Outline, OutlineNode};
use krilla::tagging::{Node, TableHeaderScope, Tag, TagGroup};

use super::{Bookmark, Role, Tags};

/// The rows of a table: the number and the cells of each.
type Rows = Vec<(usize, Vec<Node>)>;

/// Builds the tag tree of a document: joins consecutive cells into rows, and rows into tables.
pub(super) fn grouped(tags: Tags) -> Vec<Node> {
    let mut nodes = Vec::new();
    // The table whose cells are being collected: the number of the table, and its rows with their numbers.
    let mut open: Option<(usize, Rows)> = None;
    for (role, content) in tags {
        if let Some(Role::Cell { table, row, head }) = role {
            let cell: Node = if head {
                TagGroup::with_children(Tag::TH(TableHeaderScope::Column), vec![content]).into()
            } else {
                TagGroup::with_children(Tag::TD, vec![content]).into()
            };
            if open.as_ref().is_none_or(|o| o.0 != table) {
                nodes.extend(open.take().map(table_of));
                open = Some((table, Vec::new()));
            }
            if let Some((_, rows)) = &mut open {
                match rows.last_mut() {
                    Some((number, cells)) if *number == row => cells.push(cell),
                    _ => rows.push((row, vec![cell])),
                }
            }
            continue;
        }
        nodes.extend(open.take().map(table_of));
        nodes.push(match role {
            Some(Role::Heading(level, words)) => {
                let level = NonZeroU16::new(u16::from(level)).unwrap_or(NonZeroU16::MIN);
                TagGroup::with_children(Tag::Hn(level, Some(words)), vec![content]).into()
            }
            Some(_) => TagGroup::with_children(Tag::P, vec![content]).into(),
            None => content,
        });
    }
    nodes.extend(open.take().map(table_of));
    nodes
}

fn table_of((_, rows): (usize, Vec<(usize, Vec<Node>)>)) -> Node {
    let rows = rows.into_iter().map(|(_, cells)| TagGroup::with_children(Tag::TR, cells).into());
    TagGroup::with_children(Tag::Table, rows.collect()).into()
}

/// Builds the tree of bookmarks from the list of bookmarks and their levels. `scale` is in points per pixel.
pub(super) fn outline(bookmarks: &[Bookmark], scale: f32) -> Outline {
    let mut outline = Outline::new();
    let mut rest = bookmarks;
    while let Some((node, after)) = branch(rest, scale) {
        outline.push_child(node);
        rest = after;
    }
    outline
}

/// Returns the node of the first bookmark, with all bookmarks of its subtree, and the remaining bookmarks. Returns
/// `None` for an empty list. `scale` is in points per pixel.
fn branch(bookmarks: &[Bookmark], scale: f32) -> Option<(OutlineNode, &[Bookmark])> {
    let (first, mut rest) = bookmarks.split_first()?;
    let place = Point::from_xy(0.0, scale * first.y as f32);
    let mut node = OutlineNode::new(first.title.clone(), XyzDestination::new(first.page, place));
    while rest.first().is_some_and(|next| next.level > first.level) {
        let (child, after) = branch(rest, scale)?;
        node.push_child(child);
        rest = after;
    }
    Some((node, rest))
}
