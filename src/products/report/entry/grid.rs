//! [`Grid`]: a table of cells.

use super::{MarginBar, Thumbnail};

/// A table.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// The caption; empty if the heading above the table is sufficient.
    pub caption: String,
    /// The column heads. The flag is true if the column contains numbers.
    pub heads: Vec<(String, bool)>,
    /// The rows.
    pub lines: Vec<Line>,
    /// Whether the last row is the sum of the other rows.
    pub has_sum: bool,
}

/// A row of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The id of the mark in the figure that belongs to this row: `i3` for a joint, `r0` for a robot, `f2` for a
    /// failure. Empty for a row without a mark.
    pub mark: String,
    /// The cells.
    pub cells: Vec<TableCell>,
}

/// A cell of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TableCell {
    /// The text.
    pub words: String,
    /// A margin that is drawn as a bar. The text of the cell then describes the bar.
    pub bar: Option<MarginBar>,
    /// A small picture, which is drawn instead of the text.
    pub picture: Option<Thumbnail>,
    /// The number of the scene to which the text links, from 1.
    pub scene: Option<usize>,
    /// Whether the text is emphasised.
    pub strong: bool,
}

impl<S: Into<String>> From<S> for TableCell {
    fn from(words: S) -> TableCell {
        TableCell { words: words.into(), ..TableCell::default() }
    }
}

impl TableCell {
    /// Makes a cell with a small picture and without text.
    pub fn picture(picture: Thumbnail) -> TableCell {
        TableCell { picture: Some(picture), ..TableCell::default() }
    }

    /// Makes a cell with a bar that shows a margin.
    pub fn bar(bar: MarginBar) -> TableCell {
        TableCell { words: bar.words.clone(), bar: Some(bar), ..TableCell::default() }
    }

    /// Makes a cell with this text, which is emphasised if `strong` is true.
    pub fn strong_if(strong: bool, words: impl Into<String>) -> TableCell {
        TableCell { strong, ..words.into().into() }
    }
}

impl Grid {
    /// Makes a table without rows. A `#` at the beginning of a head marks a column of numbers; the `#` is not shown.
    pub fn new<H: AsRef<str>>(caption: impl Into<String>, heads: &[H]) -> Grid {
        let head = |head: &H| match head.as_ref().strip_prefix('#') {
            Some(rest) => (rest.to_owned(), true),
            None => (head.as_ref().to_owned(), false),
        };
        Grid { caption: caption.into(), heads: heads.iter().map(head).collect(), lines: Vec::new(), has_sum: false }
    }

    /// Adds a row. `mark` is the id of a mark in the figure, or empty for a row without a mark.
    pub fn add<C: Into<TableCell>>(&mut self, mark: impl Into<String>, cells: impl IntoIterator<Item = C>) {
        self.lines.push(Line { mark: mark.into(), cells: cells.into_iter().map(Into::into).collect() });
    }
}
