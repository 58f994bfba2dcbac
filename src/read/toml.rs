//! Parses TOML to the same syntax tree as JSON, with the crate toml.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::tree::{Entry, List, Node, NodeKind, Object, Tree};

/// Parses a TOML text. The error lists every syntax error, with the range of its bytes and the parser's message.
pub fn parse(text: &str) -> Result<Tree<'_>, Vec<(Range<usize>, String)>> {
    let (table, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(errors.iter().map(|e| (e.span().unwrap_or_default(), e.message().to_owned())).collect());
    }
    let root = Node { range: 0..0, kind: NodeKind::Null };
    let mut tree = Tree { root, items: Vec::new(), entries: Vec::new() };
    let kind = tree.table(table.into_inner());
    tree.root = Node { range: 0..text.len(), kind };
    Ok(tree)
}

impl<'t> Tree<'t> {
    fn value(&mut self, value: Spanned<DeValue<'t>>) -> Node<'t> {
        let range = value.span();
        let kind = match value.into_inner() {
            DeValue::Boolean(flag) => NodeKind::Flag(flag),
            // An integer with a prefix, such as 0x1F, has another base than 10.
            DeValue::Integer(n) if n.radix() != 10 => {
                NodeKind::Number(i64::from_str_radix(n.as_str(), n.radix()).map_or(f64::INFINITY, |n| n as f64))
            }
            DeValue::Integer(n) => NodeKind::Number(n.as_str().parse().unwrap_or(f64::INFINITY)),
            DeValue::Float(x) => NodeKind::Number(x.as_str().parse().unwrap_or(f64::INFINITY)),
            DeValue::String(text) => NodeKind::Text(text),
            DeValue::Datetime(_) => NodeKind::Date,
            DeValue::Array(list) => {
                let items: Vec<Node<'t>> = list.into_iter().map(|item| self.value(item)).collect();
                let first = self.items.len();
                self.items.extend(items);
                NodeKind::List(List(first..self.items.len()))
            }
            DeValue::Table(table) => self.table(table),
        };
        Node { range, kind }
    }

    fn table(&mut self, table: DeTable<'t>) -> NodeKind<'t> {
        let entry = |(name, value): (Spanned<_>, _)| Entry {
            name_range: name.span(),
            name: name.into_inner(),
            value: self.value(value),
        };
        let mut entries: Vec<Entry<'t>> = table.into_iter().map(entry).collect();
        // The crate sorts the keys by name. Problems are reported in the order of the text.
        entries.sort_by_key(|entry| entry.name_range.start);
        let first = self.entries.len();
        self.entries.extend(entries);
        NodeKind::Object(Object(first..self.entries.len()))
    }
}
