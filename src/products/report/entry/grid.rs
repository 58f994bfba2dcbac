//! [`Grid`]: a table of text cells.

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The caption.
    pub caption: String,
    /// The column heads, and whether the column contains numbers.
    pub heads: Vec<(String, bool)>,
    /// The rows.
    pub lines: Vec<Line>,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The id of the mark in the figure that belongs to this row: `i3`, `r0`, `f2`; empty for none.
    pub mark: String,
    /// The cells.
    pub cells: Vec<String>,
}

impl Grid {
    /// An empty table. A `#` at the beginning of a head marks a column of numbers.
    pub fn new(caption: impl Into<String>, heads: &[&str]) -> Grid {
        let head = |head: &&str| match head.strip_prefix('#') {
            Some(rest) => (rest.to_owned(), true),
            None => ((*head).to_owned(), false),
        };
        Grid {
            caption: caption.into(),
            heads: heads.iter().map(head).collect(),
            lines: Vec::new(),
        }
    }

    /// Adds a row. `mark` is the id of a mark in the figure, or empty.
    pub fn add(&mut self, mark: impl Into<String>, cells: impl IntoIterator<Item = String>) {
        self.lines.push(Line {
            mark: mark.into(),
            cells: cells.into_iter().collect(),
        });
    }
}
