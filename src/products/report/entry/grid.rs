//! [`Grid`]: a table, as words.

/// A table: heads, and lines of as many cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// What it lists.
    pub caption: String,
    /// The heads of its columns, and whether numbers stand below.
    pub heads: Vec<(String, bool)>,
    /// Its lines.
    pub lines: Vec<Line>,
}

/// A line of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The name of what it tells of, as the figure's marks bear it: `i3`, `r0`, `f2`; empty for none.
    pub mark: String,
    /// Its cells.
    pub cells: Vec<String>,
}

impl Grid {
    /// An empty table; columns of numbers begin with `#`.
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

    /// One line more, of something that the figure marks, or of nothing.
    pub fn add(&mut self, mark: impl Into<String>, cells: impl IntoIterator<Item = String>) {
        self.lines.push(Line {
            mark: mark.into(),
            cells: cells.into_iter().collect(),
        });
    }
}
